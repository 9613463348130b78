//! Why a simulation ended early.

use jred::error::Error;

use crate::contact::Separation;
use jred_file::model::axis::Axis;
use jred_file::model::by_motion::ByMotion;
use jred_file::number::numerics::dormand_prince::IntegrationError;

/// Why a simulation ended early. Times are in s.
#[derive(Debug)]
pub enum SimulationError {
    /// The machine cannot be placed.
    Machine(Error),
    /// No motor is given.
    NoMotor,
    /// A part behind a variator is scheduled by the motion of the file.
    Scheduled(ByMotion),
    /// Stops are requested, but the file has no stop.
    NoStop,
    /// There is no whole cycle before the stop.
    NoCycle,
    /// A machine cannot run on one shaft with others.
    NotBeside {
        /// Its title.
        title: String,
        /// The reason.
        why: NotBeside,
    },
    /// The drive link has passed the end of its stroke, where the machine has no end stop.
    EndOfStroke {
        /// Time reached.
        t: f64,
        /// Coordinate of the stroke.
        axis: Axis,
        /// The end of the drive link's stroke (rad, or m), up to rounding.
        end: f64,
        /// Speed there, without sign (rad/s, or m/s).
        speed: f64,
    },
    /// The integrator stopped.
    Integrator {
        /// Time reached.
        t: f64,
        /// The reason.
        why: IntegratorStop,
    },
    /// A constant slip in a contact whose power has reversed.
    PowerFlowsBack {
        /// Time.
        t: f64,
        /// Power that the contact would generate (W).
        power: f64,
    },
    /// A follower has left its cam, or a rope is slack.
    Parted {
        /// Time.
        t: f64,
        /// The contact.
        separation: Separation,
    },
}

/// Why a machine cannot run on one shaft with others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotBeside {
    /// The motor of the first machine acts at the drive link.
    MotorAtDriveLink,
    /// One drive train begins with a rotation, the other with a translation.
    TurnsAndSlides,
    /// A machine has a variator.
    Variator,
    /// The drive link has a stroke.
    Stroke,
}

/// Why the integrator stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IntegratorStop {
    /// Too many steps would be needed.
    Steps,
    /// The step size has become too small for double precision.
    StepSize,
    /// The drive link turns round too often within an output step.
    Reversals,
    /// The motion of the file has too many corners within an output step.
    Corners,
}

impl<E: Into<Error>> From<E> for SimulationError {
    fn from(error: E) -> Self {
        Self::Machine(error.into())
    }
}

/// Why the integrator stopped, for times counted from `t`.
pub(super) fn stopped(t: f64, error: IntegrationError<Error>) -> SimulationError {
    let (x, why) = match error {
        IntegrationError::Function(error) => return error.into(),
        IntegrationError::TooManySteps { x } => (x, IntegratorStop::Steps),
        IntegrationError::StepTooSmall { x } => (x, IntegratorStop::StepSize),
    };
    SimulationError::Integrator { t: t + x, why }
}
