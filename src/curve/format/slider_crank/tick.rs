//! The sums of a tick of a slider-crank.

use super::coefficient::{COEFFICIENTS, Coefficient as C};
use crate::Phase;
use crate::curve::curves::{self, CurveSet, has};
use crate::curve::format::harmonic::Circular as _;
use crate::curve::{TableError, Usage};

/// Numbers of places in the proof of a positive inertia: at first, and at most.
const PLACES: [u32; 2] = [64, 4096];
/// Largest (r + |e|)/l.
pub const STEEPEST: f32 = 0.95;
/// Rounding of J, relative to the sum of the magnitudes of its parts.
const ROUNDINGS: f32 = 32.0 * f32::EPSILON;

/// The coefficients of a table, zero where absent.
#[derive(Clone, Copy, Debug)]
pub struct Crank {
    of: [f32; COEFFICIENTS],
}

/// All curves at one phase.
#[derive(Clone, Copy, Debug)]
pub(super) struct Values {
    pub(super) inertia: f32,
    /// J′
    pub(super) slope: f32,
    pub(super) load: f32,
    pub(super) viscous: f32,
    pub(super) coulomb: f32,
}

/// 1/√w for w from 1 − [`STEEPEST`]² to 1: three steps of Newton's iteration reduce `micromath`'s error of 3.5 % to rounding.
#[inline(always)]
fn inverse_root(w: f32) -> f32 {
    let half = 0.5 * w;
    let step = |q: f32| q * (1.5 - half * q * q);
    // Not a loop: the compiler would keep it when optimising for size.
    step(step(step(micromath::F32(w).invsqrt().0)))
}

#[inline(always)]
const fn size(x: f32) -> f32 {
    x.abs()
}

impl Crank {
    pub(super) fn new(words: &[f32], set: CurveSet) -> Self {
        let mut given = words.iter().copied();
        let of = C::ALL.map(|c| {
            let there = c.is_in(set);
            there.then(|| given.next()).flatten().unwrap_or(0.0)
        });
        Self { of }
    }

    #[inline(always)]
    fn get(&self, coefficient: C) -> f32 {
        // Length and index are known: the check is optimised away.
        self.of
            .get(coefficient as usize)
            .copied()
            .unwrap_or_default()
    }

    /// All curves. With τ = ±sin ψ, q = 1/|cos ψ|:
    ///
    /// ```text
    /// X = sin φ − τ·q·cos φ = −x′/r      Ψ = q·cos φ = −ψ′/λ
    /// X′ = cos φ + τ·q·sin φ + λ·q·Ψ²
    /// J = J₀ + X·y,  y = a·X + s·sin φ + c·cos φ,  J′ = X′·(y + a·X) + X·(s·cos φ − c·sin φ)
    /// ```
    #[inline(always)]
    pub(super) fn at(&self, set: CurveSet, phase: Phase) -> Values {
        let (sin, cos) = f32::sin_cos_of(phase);
        let ratio = self.get(C::Ratio);
        let tau = self.get(C::Offset) - ratio * sin;
        let q = inverse_root(1.0 - tau * tau);
        let tan = tau * q;
        let psi = q * cos;
        let x = sin - tan * cos;
        let dx = cos + tan * sin + ratio * q * (psi * psi);
        let square = self.get(C::InertiaSquare) * x;
        let mut y = square + self.get(C::InertiaSin) * sin;
        let mut dy = self.get(C::InertiaSin) * cos;
        if C::InertiaCos.is_in(set) {
            y += self.get(C::InertiaCos) * cos;
            dy -= self.get(C::InertiaCos) * sin;
        }
        let mut load = self.get(C::Load) * x;
        let mut add = |part: C, of: f32| {
            if part.is_in(set) {
                load += self.get(part) * of;
            }
        };
        add(C::LoadSin, sin);
        add(C::LoadCos, cos);
        add(C::LoadRod, psi);
        add(C::LoadConstant, 1.0);
        let mut viscous = self.get(C::ViscousSquare) * x;
        if C::ViscousSin.is_in(set) {
            viscous += self.get(C::ViscousSin) * sin;
        }
        if C::ViscousCos.is_in(set) {
            viscous += self.get(C::ViscousCos) * cos;
        }
        viscous *= x;
        if C::Viscous.is_in(set) {
            viscous += self.get(C::Viscous);
        }
        let mut coulomb = self.get(C::Coulomb) * size(x);
        if C::CoulombRod.is_in(set) {
            coulomb += self.get(C::CoulombRod) * size(psi);
        }
        if C::CoulombConstant.is_in(set) {
            coulomb += self.get(C::CoulombConstant);
        }
        Values {
            inertia: self.get(C::Inertia) + x * y,
            slope: dx * (y + square) + x * dy,
            load,
            viscous: if has(set, curves::VISCOUS) {
                viscous
            } else {
                self.get(C::Viscous)
            },
            coulomb: if has(set, curves::COULOMB) {
                coulomb
            } else {
                self.get(C::CoulombConstant)
            },
        }
    }

    /// ½·J′·ω²
    #[inline(always)]
    pub(super) fn velocity(values: &Values, omega: f32) -> f32 {
        values.slope * (0.5 * omega * omega)
    }

    /// ½·J′·ω² − load + b·ω, with the machine's curves.
    #[inline(always)]
    pub(super) fn resisting(values: &Values, set: CurveSet, omega: f32) -> f32 {
        let mut sum = Self::velocity(values, omega);
        if has(set, curves::LOAD) {
            sum -= values.load;
        }
        if has(set, curves::VISCOUS | curves::CONSTANT_VISCOUS) {
            sum += values.viscous * omega;
        }
        sum
    }

    /// Checks that the rod is long enough for a full turn, with a margin: below it, the root loses its digits.
    pub(super) fn check_lengths(&self) -> Result<(), TableError> {
        if size(self.get(C::Ratio)) + size(self.get(C::Offset)) <= STEEPEST {
            Ok(())
        } else {
            Err(TableError::ShortRod)
        }
    }

    /// Bounds of |X| (and q and |Ψ|), and of |X′|.
    fn reach(&self) -> [f32; 2] {
        let steepest = size(self.get(C::Ratio)) + size(self.get(C::Offset));
        // X² ≤ 1 + tan²ψ, Ψ² ≤ 1/cos²ψ
        let most = 1.0001 * inverse_root(1.0 - steepest * steepest);
        [most, most + size(self.get(C::Ratio)) * most * most * most]
    }

    /// Bounds of |y| and |y′|.
    fn bounds(&self) -> [f32; 2] {
        let [most, slope] = self.reach();
        let rest = size(self.get(C::InertiaSin)) + size(self.get(C::InertiaCos));
        let square = size(self.get(C::InertiaSquare));
        [square * most + rest, square * slope + rest]
    }

    /// Bounds of the curves' magnitudes.
    pub(super) fn usage(&self) -> Usage {
        let ([most, slope], [y, dy]) = (self.reach(), self.bounds());
        let of = |parts: &[(C, f32)]| -> f32 {
            parts
                .iter()
                .map(|(part, by)| size(self.get(*part)) * by)
                .sum()
        };
        let mut usage = Usage {
            inertia: size(self.get(C::Inertia)) + most * y,
            velocity: 0.5 * (slope * y + most * dy),
            load: of(&[
                (C::Load, most),
                (C::LoadSin, 1.0),
                (C::LoadCos, 1.0),
                (C::LoadConstant, 1.0),
                (C::LoadRod, most),
            ]),
            viscous: of(&[
                (C::ViscousSquare, most * most),
                (C::ViscousSin, most),
                (C::ViscousCos, most),
                (C::Viscous, 1.0),
            ]),
            coulomb: of(&[
                (C::Coulomb, most),
                (C::CoulombRod, most),
                (C::CoulombConstant, 1.0),
            ]),
            torque: 0.0,
        };
        usage.torque = usage.inertia + usage.velocity + usage.load + usage.viscous + usage.coulomb;
        usage
    }

    /// Proves that J is positive everywhere: its least value at 64 places must exceed the possible decrease by J′ up to the middle between two of
    /// them, and the rounding. Otherwise the number of places doubles, up to 4096.
    pub(super) fn check_inertia(&self, set: CurveSet) -> Result<(), TableError> {
        let usage = self.usage();
        let rounding = ROUNDINGS * usage.inertia;
        let [first, last] = PLACES;
        let mut places = first;
        // |J′|·π/places
        let mut falls = 2.0 * usage.velocity * (core::f32::consts::PI / first as f32);
        loop {
            let (mut least, mut place) = (f32::MAX, Phase::default());
            for k in 0..places {
                let phase = Phase::from_bits(k * (u32::MAX / places + 1));
                let inertia = self.at(set, phase).inertia;
                if inertia <= 0.0 {
                    return Err(TableError::NoInertiaAt { phase });
                }
                if inertia < least {
                    (least, place) = (inertia, phase);
                }
            }
            if least > falls + rounding {
                return Ok(());
            }
            if places >= last {
                return Err(TableError::InertiaNotShown { phase: place });
            }
            places *= 2;
            falls *= 0.5;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{STEEPEST, inverse_root};

    /// Newton's step takes a relative error δ to 1.5·δ²: 3.5 % to 1.8e-3, 5e-6, 4e-11. The roundings of the last step remain: two of 2⁻²⁴ count
    /// fully, the rounding of the difference near 1 by half.
    #[test]
    fn the_inverse_root_is_exact_but_for_roundings() {
        let least = 1.0 - STEEPEST * STEEPEST;
        let (mut rough, mut worst) = (0.0f64, 0.0f64);
        for k in 0..=100_000 {
            let w = least + (1.0 - least) * (k as f32 / 100_000.0);
            let off = |q: f32| (f64::from(q) * f64::from(w).sqrt() - 1.0).abs();
            rough = rough.max(off(micromath::F32(w).invsqrt().0));
            worst = worst.max(off(inverse_root(w)));
        }
        assert!((0.034..0.035).contains(&rough), "{rough:e}");
        assert!((5e-8..1.6e-7).contains(&worst), "{worst:e}");
    }
}
