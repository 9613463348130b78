//! Fourier coefficients of a machine's curves from equally spaced samples.
//!
//! ```text
//! aₖ = 2/N·Σ f(φⱼ)·cos kφⱼ,   bₖ = 2/N·Σ f(φⱼ)·sin kφⱼ,   φⱼ = 2π·j/N
//! ```
//!
//! The trapezoidal rule: for a periodic curve its only error is that aₖ also contains a₍N±k₎, a₍2N±k₎ and so on, which fall like a geometric series
//! (L. N. Trefethen, J. A. C. Weideman, *SIAM Review* 56, 2014). The sums are direct: N is some tens, and no available transform works in `f64`
//! without an allocator.

use crate::CurveSet;
use crate::machine::error::PoseError;
use crate::number::error::RangeError;
use core::f64::consts::TAU;

use crate::curve::Curve;
use crate::curve::unfold;
use crate::error::Error;
use crate::machine::reducible::Reducible;
use crate::math;
use crate::number::error::finite;

/// Initial number of samples; also the least memory for them.
pub(super) const FIRST: usize = 32;

/// Greatest number of samples for up to `harmonics`: twice the number that separates them from their aliases, doubled again to observe the decay of
/// the terms after them.
pub(super) const fn most_samples(harmonics: u32) -> usize {
    let most = (8 * harmonics as usize).next_power_of_two();
    if most < 2 * FIRST { 2 * FIRST } else { most }
}

/// Samples of the four curves, and their coefficients.
pub(super) struct Spectrum<'s> {
    /// cos 2πj/most.
    circle: &'s mut [f64],
    /// Samples of each curve, starting at multiples of `most`.
    values: &'s mut [f64],
    /// aₖ of each curve at k, bₖ at most − k.
    coefficients: &'s mut [f64],
    most: usize,
    samples: usize,
    /// Constant part of the Coulomb friction; `None` if not in the machine's set.
    constant: Option<f64>,
}

impl<'s> Spectrum<'s> {
    /// Numbers of scratch for up to `harmonics`.
    pub(super) const fn scratch_len(harmonics: u32) -> usize {
        9 * most_samples(harmonics)
    }

    /// An empty spectrum for a machine with this set of curves.
    pub(super) fn new(
        scratch: &'s mut [f64],
        harmonics: u32,
        set: CurveSet,
    ) -> Result<Self, Error> {
        let (needed, given) = (Self::scratch_len(harmonics), scratch.len());
        let most = most_samples(harmonics);
        let scratch = scratch.get_mut(..needed);
        let (circle, rest) = scratch
            .and_then(|s| s.split_at_mut_checked(most))
            .ok_or(RangeError::BufferTooShort { needed, given })?;
        let (values, coefficients) = rest.split_at_mut(4 * most);
        for (j, cos) in circle.iter_mut().enumerate() {
            *cos = math::sin_cos(TAU * j as f64 / most as f64).1;
        }
        Ok(Self {
            circle,
            values,
            coefficients,
            most,
            samples: 0,
            constant: Curve::Constant.is_in(set).then_some(0.0),
        })
    }

    /// Number of samples N.
    pub(super) const fn samples(&self) -> usize {
        self.samples
    }

    /// Whether the memory suffices for twice the samples.
    pub(super) const fn can_grow(&self) -> bool {
        self.samples < self.most
    }

    /// Samples the machine between the known places, and computes the coefficients.
    pub(super) fn grow(&mut self, machine: &impl Reducible) -> Result<(), Error> {
        let known = self.samples;
        self.samples = if known == 0 { FIRST } else { 2 * known };
        for curve in self.values.chunks_mut(self.most) {
            for j in (1..known).rev() {
                if let Some(value) = curve.get(j).copied() {
                    curve[2 * j] = value;
                }
            }
        }
        let step = if known == 0 { 1 } else { 2 };
        for j in (step - 1..self.samples).step_by(step) {
            let phi = TAU * j as f64 / self.samples as f64;
            let point = machine.reduction(phi)?;
            if finite("reduced inertia", point.inertia)? <= 0.0 {
                return Err(PoseError::NoInertia { phi }.into());
            }
            let coulomb = finite("Coulomb friction", point.coulomb)?;
            if known == 0 && j == 0 {
                self.constant = self.constant.map(|_| coulomb);
            }
            let curves = [
                point.inertia,
                finite("load", point.load_torque())?,
                finite("viscous coefficient", point.viscous)?,
                coulomb - self.constant.unwrap_or_default(),
            ];
            for (value, curve) in curves.into_iter().zip(self.values.chunks_mut(self.most)) {
                if let Some(slot) = curve.get_mut(j) {
                    *slot = value;
                }
            }
        }
        let friction = self.values.chunks_mut(self.most).last();
        if let Some(friction) = friction.and_then(|f| f.get_mut(..self.samples)) {
            unfold(friction, true);
        }
        self.transform();
        Ok(())
    }

    fn transform(&mut self) {
        let (most, samples) = (self.most, self.samples);
        let stride = most / samples;
        let curves = self.values.chunks(most);
        for (values, out) in curves.zip(self.coefficients.chunks_mut(most)) {
            let values = || values.iter().take(samples).copied();
            let mean = values().sum::<f64>() / samples as f64;
            out.fill(0.0);
            if let Some(slot) = out.first_mut() {
                *slot = mean;
            }
            // The coefficients of a constant curve are zero, not the rounding of its mean.
            if values().all(|value| Some(value) == values().next()) {
                continue;
            }
            for k in 1..=samples / 2 {
                let (mut place, mut cosine, mut sine) = (0, 0.0, 0.0);
                for value in values() {
                    let at = |place: usize| self.circle.get(place).copied().unwrap_or_default();
                    cosine += (value - mean) * at(place);
                    // sin x = cos (x − π/2)
                    sine += (value - mean) * at((place + most - most / 4) & (most - 1));
                    place = (place + k * stride) & (most - 1);
                }
                // At half the number of samples the sine is zero at all of them, and the cosine ±1.
                let twice = if 2 * k == samples { 1.0 } else { 2.0 } / samples as f64;
                if let Some(slot) = out.get_mut(k) {
                    *slot = twice * cosine;
                }
                if let Some(slot) = out.get_mut(most - k).filter(|_| 2 * k < samples) {
                    *slot = twice * sine;
                }
            }
        }
    }

    /// aₖ and bₖ of a curve, k up to half the samples; the mean and 0 for k = 0.
    pub(super) fn coefficient(&self, curve: Curve, k: usize) -> [f64; 2] {
        if curve == Curve::Constant {
            let constant = self.constant.filter(|_| k == 0);
            return [constant.unwrap_or_default(), 0.0];
        }
        let start = curve as usize * self.most;
        let at = |place: usize| self.coefficients.get(start + place).copied();
        let sine = if k == 0 || 2 * k == self.samples {
            None
        } else {
            at(self.most - k)
        };
        [at(k).unwrap_or_default(), sine.unwrap_or_default()]
    }

    /// Largest magnitude of a sample of a curve that varies.
    pub(super) fn size(&self, curve: Curve) -> f64 {
        let values = self.values.chunks(self.most).nth(curve as usize);
        let values = values.unwrap_or_default().iter().take(self.samples);
        values.fold(0.0, |most, value| math::abs(*value).max(most))
    }
}
