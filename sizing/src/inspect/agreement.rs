//! Two ways to every figure: d'Alembert's principle against the reduced equation, work against energy.

use jred::{Error, Mechanism as _, Reducible as _};
use serde::Serialize;

use crate::coordinate::whole_range;
use crate::machine::MachineFile;
use crate::motion::Motion;

/// Positions or instants that are compared.
const STEPS: usize = 360;

/// Intervals of Simpson's rule over a motion.
const INTERVALS: usize = 2000;

/// What moves.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Inertia {
    /// J_red (or m_red): smallest, mean over the range, largest, flywheel and drive train included.
    pub reduced: [f64; 3],
    /// Flywheel and drive train, contained in it.
    pub flywheel: f64,
    /// Mass of all links (kg).
    pub mass: f64,
}

/// How well the two ways agree.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Agreement {
    /// Largest difference of the two drive torques as a share of their largest term.
    pub dalembert: f64,
    /// Whether that is at the states of the motion; else at unit speed and acceleration.
    pub of_motion: bool,
    /// |work of the drive + work of loads and losses − gain of energy| as a share of the energy that the drive moves to
    /// and fro. The work is that of the forces by d'Alembert.
    pub energy: Option<f64>,
}

pub(super) fn inertia(file: &MachineFile) -> Result<Inertia, Error> {
    let machine = file.with_drive_train()?;
    let values = whole_range(machine.domain(), STEPS)
        .map(|phi| Ok(machine.bare_reduction(phi)?.inertia[0]))
        .collect::<Result<Vec<f64>, Error>>()?;
    // The trapezoidal rule: over a turn both ends are the same position.
    let ends = values
        .first()
        .zip(values.last())
        .map_or(0.0, |(a, b)| 0.5 * (a + b));
    let mean = (values.iter().sum::<f64>() - ends) / STEPS as f64;
    Ok(Inertia {
        reduced: [
            values.iter().copied().fold(f64::INFINITY, f64::min),
            mean,
            values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        ],
        flywheel: machine.flywheel(),
        mass: machine
            .mechanism()
            .links()
            .iter()
            .map(jred::Link::mass)
            .sum(),
    })
}

pub(super) fn agreement(file: &MachineFile) -> Result<Agreement, Error> {
    let machine = &file.machine;
    let states: Vec<[f64; 3]> = match &file.motion {
        Some(motion) => (0..=STEPS)
            .map(|k| motion.at(motion.duration() * k as f64 / STEPS as f64))
            .map(|s| [s.phi, s.omega, s.alpha])
            .collect(),
        None => whole_range(machine.domain(), STEPS)
            .zip([[1.0, 1.0], [-1.0, 0.5], [1.0, -1.0]].into_iter().cycle())
            .map(|(phi, [omega, alpha])| [phi, omega, alpha])
            .collect(),
    };
    let (mut worst, mut largest) = (0.0f64, 0.0f64);
    for [phi, omega, alpha] in states {
        let terms = machine.bare_reduction(phi)?.torque(omega, alpha);
        let found = machine.forces(phi, omega, alpha)?.drive;
        worst = worst.max((found - terms.total()).abs());
        largest = terms
            .values()
            .into_iter()
            .map(f64::abs)
            .fold(largest, f64::max);
    }
    let share = if largest > 0.0 {
        worst / largest
    } else {
        worst
    };
    let energy = match &file.motion {
        Some(motion) => Some(balance(file, motion)?),
        None => None,
    };
    Ok(Agreement {
        dalembert: share,
        of_motion: file.motion.is_some(),
        energy,
    })
}

/// The energy balance over the motion.
fn balance(file: &MachineFile, motion: &Motion) -> Result<f64, Error> {
    const INSIDE: f64 = 1e-9;
    let machine = &file.machine;
    let (mut work, mut moved) = (0.0, 0.0);
    for (from, to) in motion.stretches() {
        let span = to - from;
        let share = (INTERVALS as f64 * span / motion.duration() / 2.0).ceil();
        let n = 2 * (share.max(16.0) as usize);
        for k in 0..=n {
            let weight = match k {
                _ if k == 0 || k == n => 1.0,
                _ if k % 2 == 1 => 4.0,
                _ => 2.0,
            } * span
                / (3.0 * n as f64);
            let place = (k as f64 / n as f64).clamp(INSIDE, 1.0 - INSIDE);
            let state = motion.at(from + place * span);
            let point = machine.bare_reduction(state.phi)?;
            let drive = machine.forces(state.phi, state.omega, state.alpha)?.drive;
            let loads = point.reduced_torque(state.omega) + point.potential_energy[1];
            work += weight * (drive + loads) * state.omega;
            moved += weight * (drive * state.omega).abs();
        }
    }
    let energy = |t: f64| -> Result<f64, Error> {
        let state = motion.at(t);
        let point = machine.bare_reduction(state.phi)?;
        let kinetic = 0.5 * point.inertia[0] * state.omega * state.omega;
        Ok(kinetic + point.potential_energy[0])
    };
    let gain = energy(motion.duration())? - energy(0.0)?;
    let off = (work - gain).abs();
    Ok(if moved > 0.0 { off / moved } else { off })
}
