//! Forces and speeds of the belts, screws and pinions between motor and machine.

use jred::machine::{Body, Mechanism as _};
use jred::mechanism::{Stage, TrainOutput};

use crate::duty::Instant;
use jred_file::model::drive_element::{DriveElement, ElementKind};
use jred_file::model::machine::MachineFile;
use jred_file::model::schedule::ScheduleInstant;

/// An element with its largest load in a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct ElementLoad {
    /// The element.
    pub element: DriveElement,
    /// Largest magnitude of the effective force of a belt, of the axial force of a screw, or of the tangential force of a pinion (N).
    pub force: f64,
    /// Largest speed of its driving shaft (rad/s).
    pub speed: f64,
}

/// Factors on parts of the machine and its motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alteration {
    /// Of the cycle time.
    pub time: f64,
    /// Of the moving masses and inertias, flywheel included.
    pub mass: f64,
    /// Of the process loads.
    pub process: f64,
}

impl Default for Alteration {
    fn default() -> Self {
        Self {
            time: 1.0,
            mass: 1.0,
            process: 1.0,
        }
    }
}

impl ElementLoad {
    /// The loads of all elements of a file over the instants of a duty.
    pub fn all(file: &MachineFile, instants: &[Instant], by: Alteration) -> Vec<Self> {
        let each = file.drive_elements.iter().map(|element| {
            let forces = instants.iter().map(|i| force(file, element, i, by).abs());
            let omega = instants.iter().map(|i| i.omega.abs()).fold(0.0, f64::max);
            let before = element.stage.unwrap_or(file.drive_train.stages().len());
            let ratio = (file.drive_train.stages().iter())
                .skip(before)
                .map(|stage| stage.ratio().abs());
            Self {
                force: forces.fold(0.0, f64::max),
                speed: omega * ratio.product::<f64>(),
                element: element.clone(),
            }
        });
        each.collect()
    }
}

/// Force in an element (N) at an instant: of a stage from the torque that it delivers, of a mechanism from the torque at its drive link without the
/// share of that link itself.
///
/// The losses of a belt are between its teeth and its driving pulley, so that they add to the force where power flows to the machine.
pub(in crate::duty) fn force(
    file: &MachineFile,
    element: &DriveElement,
    instant: &Instant,
    by: Alteration,
) -> f64 {
    let torque = instant.terms.total();
    let Some(number) = element.stage else {
        let carried = by.mass * element.carried * instant.alpha;
        return (torque - own_torque(file, instant, by) + carried) / element.arm;
    };
    let train = &file.drive_train;
    let output = TrainOutput {
        torque,
        torque_per_alpha: 0.0,
        omega: instant.omega,
        alpha: instant.alpha,
        direction: instant.direction,
    };
    let delivered = train.delivered(&output);
    let stages = train.stages();
    let Some((delivered, stage)) = delivered.get(number).zip(stages.get(number)) else {
        return 0.0;
    };
    let behind: f64 = stages.iter().skip(number + 1).map(Stage::ratio).product();
    let flows_back = delivered * instant.direction * behind < 0.0;
    let loss = match element.kind {
        ElementKind::Belt(..) if !flows_back => stage.efficiency(),
        _ => 1.0,
    };
    let travel = instant.alpha * behind * element.arm;
    delivered / element.arm / loss + element.carried * travel
}

/// The torque (N·m) that the drive link needs for itself: its inertia with the flywheel, its weight, and the loads and springs at it.
fn own_torque(file: &MachineFile, instant: &Instant, by: Alteration) -> f64 {
    let now = ScheduleInstant::of(instant.t / by.time, instant.omega);
    let phi = instant.phi;
    // Positions in which the mechanism cannot be placed were refused before.
    let Ok(machine) = file.machine_at(&now, phi) else {
        return 0.0;
    };
    let Ok(frames) = machine.mechanism().frames(phi) else {
        return 0.0;
    };
    let Some((link, frame)) = machine.mechanism().links().first().zip(frames.first()) else {
        return 0.0;
    };
    let [inertia, ..] = link.reduced_inertia(frame);
    let [_, weight] = link.potential_energy(frame, machine.gravity());
    let mut torque = by.mass * ((inertia + machine.flywheel()) * instant.alpha + weight);
    for load in machine.loads().iter().filter(|load| load.link() == 0) {
        let curves = load.reduce(frame, phi);
        let friction = curves.coulomb * jred_file::number::numerics::sign(instant.direction);
        torque += friction + curves.viscous * instant.omega - by.process * curves.process;
    }
    for element in machine.elements() {
        let wrenches = element.wrenches(&frames, instant.omega);
        for wrench in wrenches.into_iter().flatten() {
            if wrench.body == Body::Link(0) {
                let [x, y] = frame.point([0.0; 2]).map(|at| at.value);
                torque -= wrench.moment_about([x, y]);
            }
        }
    }
    torque
}
