//! The free motion of a machine under a drive of the catalogue: torque within its envelope, with rotor, gearbox and losses.
//!
//! ```text
//! T = c·x,   x = (i·α, τ₊, τ₋, i·ω, sgn ω)          the motor, in front of the drive train ([`Coefficients`])
//! −T_brake(n) ≤ T ≤ T_drive(n)                     its envelope, in the direction in which it turns
//! ```
//!
//! Without a controller the motor gives its full torque up to its largest speed, and keeps that speed. Where the envelope drops, at the largest speed
//! and between two pieces, the torque falls over the last thousandth of the speed. Beyond the largest speed the motor brakes, with full braking
//! torque from a thousandth above. This keeps the equations continuous, and the largest motor speed is a steady state.

use jred_analysis::simulate::{
    CoupledMachines, MotorPoint, MotorState, Observer, SimulationError, SimulationResult,
    simulate_under,
};
use jred_file::model::machine::MachineFile;
use jred_file::model::motor::{Coefficients, Motor};
use jred_file::model::simulation::{Shaft, Simulation};
use jred_file::number::columns::{Column, ColumnQuantity};
use jred_file::units::RPM;
use jred_sizing::catalogue::{Drive, MotorKind};
use jred_sizing::motor::envelope::{Limit, MotorLimits};
use jred_sizing::thermal::loss_curve::LossCurve;
use jred_sizing::thermal::network::{Network, Rise};
use jred_sizing::thermal::{Model, allowed_rise};

use crate::path_dynamics::Actuator;

/// Share of the speed over which the torque falls where the envelope drops.
pub const EASE: f64 = 1e-3;

/// Why a drive cannot be simulated.
#[derive(Debug)]
pub enum UnfitDrive {
    /// Its peak torque is missing.
    NoPeak,
    /// Its gearbox locks itself.
    SelfLocking {
        /// The gearbox.
        gearbox: String,
    },
    /// The machines cannot start.
    Start(SimulationError),
}

impl From<SimulationError> for UnfitDrive {
    fn from(error: SimulationError) -> Self {
        Self::Start(error)
    }
}

/// A motion under a drive.
#[derive(Debug)]
pub struct DriveSimulation {
    /// The motion.
    pub simulated: SimulationResult,
    /// Loads on the drive.
    pub loads: Loads,
}

/// The largest value of a load on the drive, and its limit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Peak {
    /// Its time (s).
    pub time: f64,
    /// Its position (rad, or m, of the drive link).
    pub phi: f64,
    /// The value.
    pub value: f64,
    /// The limit, if there is one.
    pub allowed: Option<f64>,
}

impl Peak {
    fn see(&mut self, time: f64, phi: f64, value: f64) {
        if value > self.value {
            *self = Self {
                time,
                phi,
                value,
                ..*self
            };
        }
    }

    /// Whether the value exceeds its limit.
    pub fn exceeds(&self) -> bool {
        self.allowed.is_some_and(|allowed| self.value > allowed)
    }
}

/// Loads on a drive over a motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Loads {
    /// Torque of the gearbox output (N·m), against its acceleration torque.
    pub gearbox_torque: Option<Peak>,
    /// Speed of the motor (rad/s), against the largest input speed of the gearbox.
    pub motor_speed: Peak,
    /// Temperature rise of the winding, or of the motor as a whole, from a cold start: above the surroundings (K), or as a share of the rated rise.
    pub heat: Option<Heat>,
}

/// Heating of the motor from a cold start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heat {
    /// The largest rise above the surroundings (K), or as a share of the rated rise.
    pub hottest: Peak,
    /// Whether rises are shares of the rated rise.
    pub relative: bool,
}

struct DriveMotor<'a> {
    actuator: &'a Actuator,
    /// +1 or −1: the direction in which it drives without a controller.
    sense: f64,
}

/// The largest driving torque (N·m) at a speed (not negative). It falls over the last part of each piece that drops.
fn eased(limit: &Limit, speed: f64) -> f64 {
    let pieces = limit.pieces();
    let Some(k) = pieces.iter().position(|piece| speed <= piece.to) else {
        return 0.0;
    };
    let piece = &pieces[k];
    let next = pieces.get(k + 1).map_or(0.0, |next| next.torque(next.from));
    let from = piece.from.max(piece.to * (1.0 - EASE));
    if !piece.to.is_finite() || speed <= from || piece.torque(piece.to) <= next {
        return piece.torque(speed);
    }
    let share = (speed - from) / (piece.to - from);
    piece.torque(from) * (1.0 - share) + next * share
}

impl DriveMotor<'_> {
    /// Least and largest torque along a motion (speed not negative).
    fn along(&self, speed: f64) -> [f64; 2] {
        let envelope = &self.actuator.envelope;
        let braking = envelope.limit(true);
        [
            -braking.torque(speed.min(braking.end())),
            eased(envelope.limit(false), speed),
        ]
    }
}

impl Motor for DriveMotor<'_> {
    fn coefficients(&self) -> Coefficients {
        self.actuator.coefficients
    }

    fn ratio(&self) -> f64 {
        self.actuator.ratio
    }

    fn torque(&self, speed: f64) -> f64 {
        let along = speed * self.sense;
        let end = self.actuator.envelope.limit(false).end();
        let [least, most] = self.along(along.abs());
        let torque = if along < 0.0 {
            -least
        } else if along <= end {
            most
        } else {
            least * ((along - end) / (EASE * end)).min(1.0)
        };
        torque * self.sense
    }

    fn limits(&self, speed: f64) -> [f64; 2] {
        let [least, most] = self.along(speed.abs());
        if speed < 0.0 {
            [-most, -least]
        } else {
            [least, most]
        }
    }

    fn bends(&self) -> Vec<f64> {
        let envelope = &self.actuator.envelope;
        let limits = [true, false].map(|braking| envelope.limit(braking));
        let ends = limits.iter().flat_map(|limit| limit.pieces());
        let ends = ends.map(|piece| piece.to).filter(|to| to.is_finite());
        let speeds = ends.flat_map(|to| [to * (1.0 - EASE), to, to * (1.0 + EASE)]);
        let speeds = speeds.filter(|speed| *speed > 0.0);
        speeds.flat_map(|speed| [speed, -speed]).collect()
    }
}

/// Observes the loads on the drive.
struct LoadObserver<'a> {
    drive: Drive<'a>,
    prepared: &'a MotorLimits,
    loads: Loads,
    warming: Option<MotorHeating>,
    ambient: f64,
}

/// A motor that heats up.
struct MotorHeating {
    model: Model,
    network: Network,
    rise: Rise,
    relative: bool,
    /// Whether the housing has a temperature of its own.
    housing: bool,
}

impl<'a> LoadObserver<'a> {
    fn new(drive: Drive<'a>, prepared: &'a MotorLimits, file: &MachineFile, duration: f64) -> Self {
        let surroundings = &file.site.surroundings;
        let model = Model::of(drive.motor, prepared, surroundings, duration).ok();
        let warming = model.and_then(|model| {
            let network = model.network()?;
            let (relative, housing) = match model {
                Model::Bodies {
                    follows_housing, ..
                } => (false, follows_housing && network.has_housing()),
                Model::Steady { .. } | Model::Relative { .. } => (true, false),
            };
            Some(MotorHeating {
                model,
                network,
                rise: [0.0; 2],
                relative,
                housing,
            })
        });
        let heat = warming.as_ref().map(|warming| Heat {
            hottest: Peak {
                allowed: allowed_rise(drive.motor, surroundings, warming.relative),
                ..Peak::default()
            },
            relative: warming.relative,
        });
        let gearbox_torque = drive.gearbox.map(|gearbox| Peak {
            allowed: gearbox.peak_torque,
            ..Peak::default()
        });
        let motor_speed = Peak {
            allowed: drive.gearbox.and_then(|gearbox| gearbox.max_speed),
            ..Peak::default()
        };
        Self {
            drive,
            prepared,
            loads: Loads {
                gearbox_torque,
                motor_speed,
                heat,
            },
            warming,
            ambient: surroundings.ambient,
        }
    }

    fn see(&mut self, at: &MotorPoint) {
        let MotorPoint { t, motor } = at;
        if let Some(peak) = &mut self.loads.gearbox_torque {
            peak.see(*t, motor.phi, motor.input_torque.abs());
        }
        let speed = motor.speed.abs();
        self.loads.motor_speed.see(*t, motor.phi, speed);
    }
}

impl Observer for LoadObserver<'_> {
    fn columns(&self) -> Vec<Column> {
        let (unit, whole) = match self.drive.motor.kind {
            MotorKind::Rotary => ("rpm", "motor speed"),
            MotorKind::Linear => ("m/s", "motor speed"),
        };
        let mut columns = vec![Column::new(ColumnQuantity::MotorSpeed, whole, unit)];
        if self.drive.gearbox.is_some() {
            columns.push(Column::new(
                ColumnQuantity::GearboxTorque,
                "gearbox torque",
                "N m",
            ));
        }
        let warm = |name: &str, unit: &str| Column::new(ColumnQuantity::Temperature, name, unit);
        match &self.warming {
            Some(warming) if warming.relative => columns.push(warm("rated rise", "%")),
            Some(warming) => {
                let whole = !warming.network.has_housing();
                let name = if whole { "motor" } else { "winding" };
                columns.push(warm(name, "degC"));
                if warming.housing {
                    columns.push(warm("housing", "degC"));
                }
            }
            None => {}
        }
        columns
    }

    fn pass(&mut self, from: MotorPoint, to: MotorPoint) {
        self.see(&from);
        self.see(&to);
        let Some(warming) = &mut self.warming else {
            return;
        };
        let length = to.t - from.t;
        let point = |t: f64, working: &MotorState| {
            let state = [working.torque, working.speed];
            (warming.model).point(self.drive.motor, self.prepared, t, state)
        };
        let course = LossCurve::new(&[point(0.0, &from.motor), point(length, &to.motor)], length);
        let (hottest, now) = course.follow(&warming.network, warming.rise, length);
        warming.rise = now;
        if let Some(heat) = &mut self.loads.heat {
            heat.hottest.see(to.t, to.motor.phi, hottest[0]);
        }
    }

    fn figures(&self, now: &MotorState) -> Vec<f64> {
        let per = match self.drive.motor.kind {
            MotorKind::Rotary => RPM,
            MotorKind::Linear => 1.0,
        };
        let mut figures = vec![now.speed / per];
        if self.drive.gearbox.is_some() {
            figures.push(now.input_torque);
        }
        if let Some(warming) = &self.warming {
            let [winding, housing] = warming.rise;
            if warming.relative {
                figures.push(100.0 * winding);
            } else {
                figures.push(self.ambient + winding);
                if warming.housing {
                    figures.push(self.ambient + housing);
                }
            }
        }
        figures
    }
}

/// Simulates machines with a drive in place of the first machine's motor, which starts at the temperature of the surroundings.
///
/// Without a controller the drive gives its full torque. Its direction is that of the file's own motor, else of `start_speed`, else towards growing
/// positions. With a controller the drive limits the controller's torque.
///
/// Accuracy: as [`simulate_under`]; the temperature uses a linear torque between quarters of the integrator's steps.
///
/// # Errors
/// The drive cannot be simulated, or the machines cannot start.
pub fn driven(
    machines: &CoupledMachines,
    simulation: &Simulation,
    drive: Drive<'_>,
) -> Result<DriveSimulation, UnfitDrive> {
    let file = machines.first;
    let prepared = MotorLimits::new(drive.motor, drive.amplifier, &file.site);
    let actuator = Actuator::new(&drive, prepared.envelope.clone());
    let limits = [true, false].map(|braking| actuator.envelope.limit(braking));
    let known = |limit: &&Limit| {
        let pieces = limit.pieces();
        !pieces.is_empty()
            && pieces
                .iter()
                .all(|piece| piece.torque(piece.from).is_finite())
    };
    if !limits.iter().all(known) {
        return Err(UnfitDrive::NoPeak);
    }
    if let Some(gearbox) = drive
        .gearbox
        .filter(|gearbox| gearbox.back_efficiency < 0.0)
    {
        return Err(UnfitDrive::SelfLocking {
            gearbox: gearbox.key.clone(),
        });
    }
    let motor = DriveMotor {
        actuator: &actuator,
        sense: sense(file, simulation),
    };
    let at_motor = Simulation {
        at: Shaft::Motor,
        ..simulation.clone()
    };
    let mut observer = LoadObserver::new(drive, &prepared, file, simulation.duration);
    let simulated = simulate_under(machines, &at_motor, &motor, &mut observer)?;
    Ok(DriveSimulation {
        simulated,
        loads: observer.loads,
    })
}

/// The direction of the motor without a controller.
fn sense(file: &MachineFile, simulation: &Simulation) -> f64 {
    let ratio = file.drive_train.ratio().signum();
    let own = simulation.torque.as_ref().map(|own| own.torque(0.0));
    match (own.filter(|torque| *torque != 0.0), simulation.at) {
        (Some(torque), Shaft::Motor) => torque.signum(),
        (Some(torque), Shaft::DriveLink) => torque.signum() * ratio,
        (None, _) if simulation.start_speed < 0.0 => -ratio,
        (None, _) => ratio,
    }
}
