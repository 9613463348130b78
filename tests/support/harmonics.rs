//! Shared by the tests of harmonics: machines that are short Fourier series, the example press, and ways to fit them.

use jred::mechanism::SliderCrankDimensions;
use std::f64::consts::TAU;

use jred::error::Error;
use jred::harmonic::{Circular, Fit, fit, scratch_len, terms_in_use};
use jred::machine::{Action, Link, Load, Machine, Reducible, Reduction};
use jred::mechanism::{Branch, SliderCrank};
use jred::number::Number;
use jred::table::{Format, Shape, Table, TableError, words_len};
use jred::tabulate::Request;
use jred::{CurveSet, Domain, Harmonic, Model, Phase};
use proptest::prelude::*;

use super::largest;

/// J and load with any harmonics, b and c constant.
#[derive(Clone, Debug)]
pub(crate) struct Waves {
    pub(crate) inertia: Vec<[f64; 2]>,
    pub(crate) load: Vec<[f64; 2]>,
    pub(crate) viscous: f64,
    pub(crate) coulomb: f64,
}

/// Value, first and second derivative of Σ aₖ·cos kφ + bₖ·sin kφ from k = 0.
pub(crate) fn series(coefficients: &[[f64; 2]], phi: f64) -> [f64; 3] {
    let mut sums = [0.0; 3];
    for (k, [a, b]) in coefficients.iter().enumerate() {
        let k = k as f64;
        let (sin, cos) = (k * phi).sin_cos();
        let wave = a * cos + b * sin;
        for (sum, part) in sums
            .iter_mut()
            .zip([wave, k * (b * cos - a * sin), -k * k * wave])
        {
            *sum += part;
        }
    }
    sums
}

impl Reducible for Waves {
    fn domain(&self) -> Domain {
        Domain::Turn
    }
    fn reduction(&self, phi: f64) -> Result<Reduction, jred::machine::PoseError> {
        Ok(Reduction::new(series(&self.inertia, phi))
            .with_process(series(&self.load, phi)[0])
            .with_viscous(self.viscous)
            .with_coulomb(self.coulomb))
    }
}

/// Every coefficient in the order of the words, all terms of J and load.
pub(crate) fn words_of(waves: &Waves) -> Vec<f64> {
    let mut words = vec![
        waves.inertia[0][0],
        waves.load[0][0],
        waves.viscous,
        waves.coulomb,
    ];
    for (j, l) in waves.inertia.iter().zip(&waves.load).skip(1) {
        words.extend([j[0], j[1], l[0], l[1]]);
    }
    words
}

prop_compose! {
    /// Amplitudes that fall like a geometric series; J positive.
    pub(crate) fn waves()(
        raw in prop::collection::vec([-1.0f64..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0], 2..12),
        fall in 0.3f64..0.9, swing in 0.01f64..0.45, viscous in 0.0..0.5, coulomb in 0.0..5.0,
    ) -> Waves {
        let size = |k: usize| fall.powi(k as i32);
        let total: f64 = raw.iter().enumerate().map(|(k, r)| size(k) * (r[0].abs() + r[1].abs())).sum();
        let part = |k: usize, [a, b]: [f64; 2], scale: f64| [scale * size(k) * a, scale * size(k) * b];
        let mut inertia = vec![[1.0, 0.0]];
        let mut load = vec![[3.0, 0.0]];
        for (k, r) in raw.iter().enumerate() {
            inertia.push(part(k, [r[0], r[1]], 2.0 * swing / total));
            load.push(part(k, [r[2], r[3]], 10.0));
        }
        Waves { inertia, load, viscous, coulomb }
    }
}

/// The example press: crank 50 mm, λ = 0.25, a ram of 10 kg that slides vertically, J max/min 5.25.
pub(crate) fn press() -> Machine<SliderCrank> {
    let massless = Link::MASSLESS;
    let ram = Link::point_mass(10.0).unwrap();
    let links = [massless, massless, ram];
    let bare = Machine::new(
        SliderCrank::new(
            SliderCrankDimensions {
                crank: 0.05,
                rod: 0.2,
                offset: 0.0,
            },
            Branch::Right,
            links,
        )
        .unwrap(),
    );
    let swing = largest((0..4096).map(|k| {
        let reduced = bare.bare_reduction(TAU * f64::from(k) / 4096.0);
        reduced.unwrap().inertia
    }));
    bare.with_gravity([9.81, 0.0])
        .and_then(|m| m.with_flywheel(swing / 4.25))
        .unwrap()
}

pub(crate) const OMEGA: f64 = 60.0;
pub(crate) const ALPHA: f64 = 400.0;

pub(crate) fn request(torque_error: f64, max_cells: u32) -> Request {
    Request::new(torque_error)
        .with_max_speed(OMEGA)
        .with_max_acceleration(ALPHA)
        .with_max_cells(max_cells)
}

/// Largest drive torque at full speed and acceleration.
pub(crate) fn peak(machine: &impl Reducible) -> f64 {
    largest((0..1024).flat_map(|k| {
        let reduced = machine.reduction(TAU * f64::from(k) / 1024.0).unwrap();
        [-1.0, 1.0].map(|sign| reduced.torque(OMEGA, sign * ALPHA).total())
    }))
}

pub(crate) fn fitted<T, const SET: CurveSet>(
    machine: &impl Reducible,
    request: &Request,
) -> Result<(Fit, Vec<T>), Error>
where
    T: Circular + Number,
    Harmonic<T>: Format<Number = T, Word = T, Constants = ()>,
{
    let mut scratch = vec![0.0; scratch_len(request.max_cells)];
    let mut words = vec![T::default(); words_len::<Harmonic<T>>(request.max_cells, SET)];
    let found = fit(machine, SET, request, &mut scratch, &mut words)?;
    words.truncate(found.words);
    Ok((found, words))
}

/// The model with as many harmonics as there are words for.
pub(crate) fn model<T, const SET: CurveSet>(
    words: &[T],
) -> Result<Model<'_, Harmonic<T>, SET>, TableError>
where
    T: Circular + Number,
    Harmonic<T>: Format<Number = T, Word = T, Constants = ()>,
{
    let row = words_len::<Harmonic<T>>(1, SET) - words_len::<Harmonic<T>>(0, SET);
    let more = words.len().saturating_sub(words_len::<Harmonic<T>>(0, SET));
    let harmonics = more.checked_div(row).unwrap_or(0) as u32;
    Model::new(Table::new(words, Shape::harmonics(harmonics, SET))?)
}

pub(crate) fn phases(count: u32) -> impl Iterator<Item = Phase> {
    (0..count).map(move |k| Phase::from_bits(k.wrapping_mul((u32::MAX / count) | 1)))
}

pub(crate) fn terms_of(machine: &impl Reducible, set: CurveSet) -> Result<CurveSet, Error> {
    terms_in_use(machine, set, 16, &mut vec![0.0; scratch_len(16)])
}

/// Friction of the ram in its guide, 100 N: F·|x′|.
pub(crate) fn rubbing() -> Machine<SliderCrank> {
    let ram = Load::new(SliderCrank::SLIDER, Action::OpposingForce(100.0)).unwrap();
    press().with_load(ram).unwrap()
}
