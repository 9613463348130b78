//! A rotation at constant kinetic energy.

use jred::error::Error;
use jred::machine::motion::{End, Polynomial};
use jred_file::model::motion::Phase;
use jred_file::number::numerics::gauss;

use crate::collocation::torque::Torque;
use crate::moves::Move;
use crate::path_dynamics::PathDynamics;

/// Parts of a turn at constant kinetic energy.
const PARTS: usize = 512;

/// ω ∝ 1/√J, where J includes rotor, gearbox and drive train, because one torque moves them all.
pub(super) fn constant_energy(dynamics: &PathDynamics, step: &Move) -> Result<Vec<Phase>, Error> {
    let distance = step.to - step.from;
    // Inertia and its slope along the path.
    let inertia = |share: f64| -> Result<[f64; 2], Error> {
        let place = dynamics.place(step.from + distance * share)?;
        let torque = Torque::exact(dynamics, &place, 0.0, 0.0);
        Ok([torque.by_acceleration, torque.by_load * place.inertia_slope])
    };
    let mut times = Vec::with_capacity(PARTS);
    let mut ends = Vec::with_capacity(PARTS + 1);
    for k in 0..=PARTS {
        ends.push(inertia(k as f64 / PARTS as f64)?);
    }
    for k in 0..PARTS {
        let root = |share: f64| Ok::<_, Error>(inertia(share)?[0].sqrt());
        let ends = [k, k + 1].map(|k| k as f64 / PARTS as f64);
        let time = distance.abs() * gauss(&root, ends)?;
        times.push(time);
    }
    let scale = step.duration / times.iter().sum::<f64>();
    let state = |[whole, slope]: [f64; 2]| {
        let speed = 1.0 / (scale * whole.sqrt());
        let acceleration = -0.5 * speed * speed * slope / whole;
        End::new(distance.signum() * speed, distance.signum() * acceleration)
    };
    let phases = times.iter().zip(ends.windows(2)).map(|(time, ends)| Phase {
        duration: scale * time,
        polynomial: Polynomial::between(
            distance / PARTS as f64,
            scale * time,
            state(ends[0]),
            state(ends[1]),
        ),
    });
    Ok(phases.collect())
}
