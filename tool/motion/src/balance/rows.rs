//! The quantity to minimise, at each sample, as a linear function of the unknowns.

use jred::machine::{Element, Frames, Link, MassProperties, Mechanism as _, Reducible as _};
use jred_analysis::duty::{Duty, Instant, Sampling};
use jred_file::model::coordinate::positions;
use jred_file::model::machine::MachineFile;

use super::{
    BalanceError, BalanceGoal, BalanceRequest, Counterweight, POSITIONS, ROUNDING, largest,
};

/// How much finer the motion is sampled for the peak. With other bodies the peak moves, also between the instants, where it is higher by the square
/// of a step.
const FINER: usize = 10;

/// The quantity to minimise, at each sample: a base and a column for each unknown.
pub(super) struct DesignMatrix {
    /// Weights of the samples in the mean.
    pub(super) weights: Vec<f64>,
    /// Without the unknowns.
    pub(super) base: Vec<f64>,
    /// Effect of one unit of each unknown: of each counterweight m, S_u, S_v, Θ; of each spring k and k·l₀.
    pub(super) columns: Vec<Vec<f64>>,
    /// Longest length of each spring.
    pub(super) longest: Vec<f64>,
    /// Largest magnitude of the existing torques, springs included.
    pub(super) largest: f64,
}

/// A sample: a position and the motion of the machine there.
struct MotionSample {
    weight: f64,
    phi: f64,
    omega: f64,
    alpha: f64,
    value: f64,
}

impl DesignMatrix {
    pub(super) fn new(file: &MachineFile, request: &BalanceRequest) -> Result<Self, BalanceError> {
        let places = places(file, request)?;
        let mechanism = file.machine.mechanism();
        let elements: Vec<&Element> = (request.springs.iter())
            .filter_map(|k| file.elements.get(*k).map(|named| &named.element))
            .collect();
        let count = 4 * request.counterweights.len() + 2 * elements.len();
        let mut rows = Self {
            weights: Vec::with_capacity(places.len()),
            base: Vec::with_capacity(places.len()),
            columns: vec![Vec::with_capacity(places.len()); count],
            longest: vec![0.0; elements.len()],
            largest: places
                .iter()
                .fold(0.0, |most, p| f64::max(most, p.value.abs())),
        };
        for place in &places {
            let frames = mechanism.frames(place.phi)?;
            let mut columns = rows.columns.iter_mut();
            let mut put = |value: f64| {
                if let Some(column) = columns.next() {
                    column.push(value);
                }
            };
            for counterweight in &request.counterweights {
                let parts = parts(file, request.goal, counterweight.link, &frames, place)?;
                parts.into_iter().for_each(&mut put);
            }
            let mut base = place.value;
            for (element, longest) in elements.iter().zip(&mut rows.longest) {
                let length = element.length(&frames);
                *longest = longest.max(length.value.abs());
                let [stiffness, free] = element.spring_rate().unwrap_or_default();
                base -= stiffness * (length.value - free) * length.d1;
                put(length.value * length.d1);
                put(-length.d1);
            }
            rows.base.push(base);
            rows.weights.push(place.weight);
        }
        if request.goal == BalanceGoal::Inertia {
            rows.deviate();
        }
        rows.forget_roundings(request);
        Ok(rows)
    }

    /// Clears columns in which even the largest counterweight changes nothing beyond rounding.
    fn forget_roundings(&mut self, request: &BalanceRequest) {
        let units = request.counterweights.iter().flat_map(Counterweight::most);
        for (column, unit) in self.columns.iter_mut().zip(units) {
            if largest(column) * unit <= ROUNDING * self.largest {
                column.fill(0.0);
            }
        }
    }

    /// Replaces the values by their deviations from the mean.
    fn deviate(&mut self) {
        let Self {
            weights,
            base,
            columns,
            ..
        } = self;
        for column in columns.iter_mut().chain([base]) {
            let mean: f64 = column.iter().zip(&*weights).map(|(v, w)| v * w).sum();
            for value in column.iter_mut() {
                *value -= mean;
            }
        }
    }
}

/// Weighted mean of the products.
pub(super) fn product(weights: &[f64], a: &[f64], b: &[f64]) -> f64 {
    let all = weights.iter().zip(a).zip(b);
    all.map(|((w, a), b)| w * a * b).sum()
}

/// The samples at which the machine is evaluated.
fn places(file: &MachineFile, request: &BalanceRequest) -> Result<Vec<MotionSample>, BalanceError> {
    if matches!(request.goal, BalanceGoal::Rms | BalanceGoal::Peak) {
        let motion = file.motion.as_ref().ok_or(BalanceError::NoMotion)?;
        let finer = if request.goal == BalanceGoal::Peak {
            FINER
        } else {
            1
        };
        let sampling = Sampling {
            steps: finer * request.sampling.steps,
            ..request.sampling
        };
        let duty = Duty::new(file, motion, sampling)?;
        let train = file.train_inertia();
        let place = |i: &Instant| MotionSample {
            weight: i.weight / duty.duration,
            phi: i.phi,
            omega: i.omega,
            alpha: i.alpha,
            value: i.terms.total() + train * i.alpha,
        };
        return Ok(duty.instants.iter().map(place).collect());
    }
    let domain = file.machine.domain();
    let place = |phi: f64| {
        let reduction = file.machine.bare_reduction(phi)?;
        Ok(MotionSample {
            weight: 1.0 / POSITIONS as f64,
            phi,
            omega: 0.0,
            alpha: 0.0,
            value: match request.goal {
                BalanceGoal::Inertia => reduction.inertia,
                _ => -reduction.load_torque(),
            },
        })
    };
    positions(domain, POSITIONS).map(place).collect()
}

/// Effect of one unit of m, S_u, S_v and Θ of a body on a link.
fn parts(
    file: &MachineFile,
    goal: BalanceGoal,
    link: usize,
    frames: &Frames,
    place: &MotionSample,
) -> Result<[f64; 4], BalanceError> {
    let Some(frame) = frames.get(link) else {
        return Ok([0.0; 4]);
    };
    let of = |mass: f64, com: [f64; 2], inertia: f64| -> Result<f64, BalanceError> {
        let body = if mass == 0.0 {
            Link::rotor(inertia)
        } else {
            Link::new(MassProperties { mass, inertia, com })
        };
        let body = body?;
        let [j, slope, _] = body.reduced_inertia(frame);
        let [_, potential_slope] = body.potential_energy(frame, file.machine.gravity());
        Ok(match goal {
            BalanceGoal::Inertia => j,
            BalanceGoal::Holding => potential_slope,
            BalanceGoal::Rms | BalanceGoal::Peak => {
                j * place.alpha + 0.5 * slope * place.omega * place.omega + potential_slope
            }
        })
    };
    // A point mass of 1 kg 1 m away has moments and an inertia of 1 as well.
    let (mass, inertia) = (of(1.0, [0.0, 0.0], 0.0)?, of(0.0, [0.0, 0.0], 1.0)?);
    let along = of(1.0, [1.0, 0.0], 0.0)? - mass - inertia;
    let across = of(1.0, [0.0, 1.0], 0.0)? - mass - inertia;
    Ok([mass, along, across, inertia])
}
