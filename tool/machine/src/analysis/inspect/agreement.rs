//! Independent checks: d'Alembert's principle against the reduced equation, work against energy.

use jred::machine::Mechanism as _;
use jred::{Error, Machine, Reducible as _};
use serde::Serialize;

use crate::analysis::duty;
use crate::model::coordinate::whole_range;
use crate::model::machine::MachineFile;
use crate::model::mechanism::AnyMechanism;
use crate::model::motion::Motion;
use crate::number::numerics;

/// Positions or instants that are compared.
const STEPS: usize = 360;

/// Parts of the motion that its work is integrated over, each halved where it must be.
const PANELS: u32 = 96;

/// Tolerance of the work, as a share of the energy that the drive moves.
const SHARE: f64 = 1e-11;

/// The moving masses.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Inertia {
    /// J_red (or m_red): smallest, mean over the range, largest, flywheel and drive train included.
    pub reduced: [f64; 3],
    /// Flywheel and drive train, contained in it.
    pub flywheel: f64,
    /// Mass of all links (kg).
    pub mass: f64,
}

/// Agreement of the two methods, for the machine with its drive train.
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

/// Of a machine with its drive train.
pub(super) fn inertia(machine: &Machine<AnyMechanism>) -> Result<Inertia, Error> {
    let values = whole_range(machine.domain(), STEPS)
        .map(|phi| Ok(machine.bare_reduction(phi)?.inertia))
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

/// Of a machine file, and its machine with the drive train.
pub(super) fn agreement(
    file: &MachineFile,
    machine: &Machine<AnyMechanism>,
) -> Result<Agreement, Error> {
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
        Some(motion) => Some(balance(file, machine, motion)?),
        None => None,
    };
    Ok(Agreement {
        dalembert: share,
        of_motion: file.motion.is_some(),
        energy,
    })
}

/// The energy balance over the motion.
fn balance(
    file: &MachineFile,
    machine: &Machine<AnyMechanism>,
    motion: &Motion,
) -> Result<f64, Error> {
    let drive = |t: f64| -> Result<f64, Error> {
        let state = motion.at(t);
        let drive = machine.forces(state.phi, state.omega, state.alpha)?.drive;
        Ok(drive * state.omega)
    };
    // What loads and losses leave of the drive's power.
    let power = |t: f64| -> Result<f64, Error> {
        let state = motion.at(t);
        let point = machine.bare_reduction(state.phi)?;
        let loads = point.reduced_torque(state.omega) + point.potential_slope;
        Ok(drive(t)? + loads * state.omega)
    };
    let stretches = duty::smooth_stretches(file, motion, STEPS);
    let panels = |from: f64, to: f64| {
        let share = (f64::from(PANELS) * (to - from) / motion.duration()).ceil();
        share.max(2.0) as u32
    };
    let mut moved = 0.0;
    for &(from, to) in &stretches {
        let to_and_fro = |t: f64| Ok::<f64, Error>(drive(t)?.abs());
        // Only a scale: the rule without halvings.
        moved += numerics::integral(to_and_fro, [from, to], panels(from, to), f64::INFINITY)?;
    }
    let mut work = 0.0;
    for &(from, to) in &stretches {
        let tolerance = SHARE * moved * (to - from) / motion.duration();
        work += numerics::integral(power, [from, to], panels(from, to), tolerance)?;
    }
    let energy = |t: f64| -> Result<f64, Error> {
        let state = motion.at(t);
        let point = machine.bare_reduction(state.phi)?;
        let kinetic = 0.5 * point.inertia * state.omega * state.omega;
        Ok(kinetic + point.potential_energy)
    };
    let gain = energy(motion.duration())? - energy(0.0)?;
    let off = (work - gain).abs();
    Ok(if moved > 0.0 { off / moved } else { off })
}
