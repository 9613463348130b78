//! A machine as the tool knows it: what a machine file describes, in SI units, checked.

use jred::mechanism::{SliderCrank, Train};
use jred::{Domain, Error, Frame, Link, Load, Machine, Mechanism};

use crate::motion::Motion;
use crate::rules::Rules;

/// A mechanism that a machine file can name.
#[expect(clippy::large_enum_variant, reason = "a run has one machine")]
#[derive(Clone, Debug)]
pub enum AnyMechanism {
    /// `type = "slider-crank"`
    SliderCrank(SliderCrank),
    /// `type = "gear-train"` or `"belt"`
    Train(Train),
}

impl AnyMechanism {
    fn inner(&self) -> &dyn Mechanism {
        match self {
            Self::SliderCrank(m) => m,
            Self::Train(m) => m,
        }
    }

    /// The names of the links, as loads and reports use them.
    pub fn link_names(&self) -> Vec<String> {
        match self {
            Self::SliderCrank(_) => ["crank", "rod", "slider"].map(String::from).into(),
            Self::Train(t) => (1..=t.links().len())
                .map(|k| format!("shaft-{k}"))
                .collect(),
        }
    }
}

impl Mechanism for AnyMechanism {
    fn links(&self) -> &[Link] {
        self.inner().links()
    }
    fn domain(&self) -> Domain {
        self.inner().domain()
    }
    fn frames(&self, phi: f64) -> Result<heapless::Vec<Frame, 16>, Error> {
        self.inner().frames(phi)
    }
}

/// A load with the name that reports use.
#[derive(Clone, Debug)]
pub struct NamedLoad {
    /// Name from the file, or made from what the load does.
    pub name: String,
    /// The load.
    pub load: Load,
}

/// Everything that a machine file says.
#[derive(Clone, Debug)]
pub struct MachineFile {
    /// Title for reports.
    pub title: String,
    /// The mechanism with gravity, loads and flywheel, *without* the drive train.
    pub machine: Machine<AnyMechanism>,
    /// Inertia of the flywheel on the drive link (kg·m²), contained in `machine`.
    pub flywheel: f64,
    /// The loads, in the order of the machine's.
    pub loads: Vec<NamedLoad>,
    /// Fixed drive train between the motor's gearbox (or the motor) and the drive link; empty if there is none.
    pub drive_train: Train,
    /// The prescribed motion, if the file has one.
    pub motion: Option<Motion>,
    /// What `jred simulate` runs, if the file says.
    pub simulation: Option<Simulation>,
    /// Sizing rules, defaults unless the file overrides them.
    pub rules: Rules,
}

/// Where a torque acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shaft {
    /// At the motor, in front of the drive train.
    Motor,
    /// At the drive link.
    DriveLink,
}

/// A free motion under a motor torque.
#[derive(Clone, Debug)]
pub struct Simulation {
    /// φ at the start (rad).
    pub start_angle: f64,
    /// ω of the drive link at the start (rad/s).
    pub start_speed: f64,
    /// Length (s).
    pub duration: f64,
    /// Distance of the output points (s).
    pub output_step: f64,
    /// (speed (rad/s), torque (N·m)) at `at`, speeds rising; one point means a constant torque. Between points
    /// straight lines, beyond the ends the end's torque.
    pub torque: Vec<(f64, f64)>,
    /// Where the torque acts.
    pub at: Shaft,
    /// Inertia of the motor's rotor, at the motor shaft (kg·m²).
    pub rotor_inertia: f64,
    /// Relative tolerance of the integrator.
    pub tolerance: f64,
}

impl MachineFile {
    /// The machine with its drive train reduced to the drive link: what the motor's gearbox has to move.
    ///
    /// # Errors
    /// None for a machine file that was read without error.
    pub fn with_drive_train(&self) -> Result<Machine<AnyMechanism>, Error> {
        let ratio = self.drive_train.ratio();
        let train = self.drive_train.inertia_at_input() * ratio * ratio;
        self.machine.clone().with_flywheel(train)
    }
}
