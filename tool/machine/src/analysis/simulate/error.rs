//! Why a simulation did not come to its end.

use jred::Error;

use crate::number::numerics::dormand_prince::Stopped;

/// Why a simulation did not come to its end.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum SimulationError {
    /// The machine cannot be placed.
    #[error(transparent)]
    Machine(#[from] Error),
    /// The drive link has passed the end of its stroke.
    #[error(
        "the drive link runs against the end of its stroke, {end}, before t = {t:.6} s, at {speed}"
    )]
    #[diagnostic(help(
        "what stops it there is not in the machine file: shorten `duration` in [simulation], start elsewhere, or give a \
         spring or a damper as a buffer and a longer stroke"
    ))]
    EndOfStroke {
        /// Time reached (s).
        t: f64,
        /// The end that was passed.
        end: String,
        /// Speed there.
        speed: String,
    },
    /// The integrator gave up.
    #[error("the integrator stopped at t = {t} s: {reason}")]
    #[diagnostic(help(
        "loosen `tolerance` in [simulation], or look for a torque that grows without bound"
    ))]
    Integrator {
        /// Time reached (s).
        t: f64,
        /// What the integrator says.
        reason: &'static str,
    },
    /// A constant slip in a contact whose power has turned round.
    #[error(
        "at t = {t:.6} s power flows through the variator against its `power_flow`: a constant slip would give {power:.3e} W \
         there, which no contact does"
    )]
    #[diagnostic(help(
        "let the slip turn round with the load: creep = {{ slip = \"2 %\", torque = \"80 N m\" }} instead of `slip`; or turn \
         `power_flow` round"
    ))]
    PowerFlowsBack {
        /// When (s).
        t: f64,
        /// Power that the contact would give (W).
        power: f64,
    },
    /// A follower has left its cam, or a rope is slack.
    #[error("at t = {t:.6} s {what}: at {state}")]
    #[diagnostic(help("{cure}"))]
    Parted {
        /// When (s).
        t: f64,
        /// What lets go.
        what: String,
        /// Position and speed.
        state: String,
        /// What helps.
        cure: String,
    },
}

/// Why the integrator stopped, for times counted from `t`.
pub(super) fn stopped(t: f64, error: Stopped<Error>) -> SimulationError {
    let (x, reason) = match error {
        Stopped::Function(error) => return error.into(),
        Stopped::TooManySteps { x } => (x, "too many steps would be needed"),
        Stopped::StepTooSmall { x } => (x, "the step has become too small for the numbers"),
    };
    SimulationError::Integrator { t: t + x, reason }
}
