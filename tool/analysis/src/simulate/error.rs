//! Why a simulation ended early.

use jred::error::Error;

use jred_file::number::numerics::dormand_prince::IntegrationError;

/// Why a simulation ended early.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum SimulationError {
    /// The machine cannot be placed.
    #[error("{error}; {cure}", error = .0, cure = .0.cure())]
    Machine(Error),
    /// No motor is given.
    #[error("[simulation] gives no motor")]
    #[diagnostic(help(
        "give torque, torque_speed, dc_motor or induction_motor in [simulation] (force or force_speed of a link that slides), or a drive of \
         the catalogue: --drive MOTOR+GEARBOX"
    ))]
    NoMotor,
    /// A part behind a variator is scheduled by the motion of the file.
    #[error("{what}: that goes by [motion], and is not simulated behind a [variator]")]
    #[diagnostic(help(
        "{cure}, for this command; `jred reduce --over time` and `jred size` contain it"
    ))]
    Scheduled {
        /// The load, payload or carriage.
        what: String,
        /// How to simulate without it.
        cure: String,
    },
    /// Stops are requested, but the file has no stop.
    #[error("[simulation] has no `stop` whose instant could be moved")]
    #[diagnostic(help(
        "add stop = {{ time = \"3 s\", brake_torque = \"80 N m\", brake_delay = \"40 ms\" }}"
    ))]
    NoStop,
    /// There is no whole cycle before the stop.
    #[error("there is no whole cycle before the `stop`")]
    #[diagnostic(help(
        "give the stop a later time, after a turn of the drive link or a cycle of [motion] under a controller"
    ))]
    NoCycle,
    /// A machine cannot run on one shaft with others.
    #[error("the machine \"{title}\" cannot run on one shaft with others: {why}")]
    #[diagnostic(help(
        "simulate it alone, or refer it to the shaft of another machine as a [[drive_train.branch]]"
    ))]
    NotBeside {
        /// The machine.
        title: String,
        /// The reason.
        why: &'static str,
    },
    /// The drive link has passed the end of its stroke.
    #[error("the drive link hits the end of its stroke, {end}, at t = {t:.6} s, at {speed}")]
    #[diagnostic(help(
        "the machine has no end stop: add end_stops to [simulation], reduce its `duration`, start elsewhere, or add a spring or damper as a \
         buffer and a longer stroke"
    ))]
    EndOfStroke {
        /// Time reached (s).
        t: f64,
        /// The end that was passed.
        end: String,
        /// Speed there.
        speed: String,
    },
    /// The integrator stopped.
    #[error("the integrator stopped at t = {t} s: {reason}")]
    #[diagnostic(help(
        "look for what is stiff or grows without limit: viscous friction that is large for the inertia, a steep characteristic of the motor, \
         a controller's gain, a winding's L/R; soften it, or shorten `duration`. A larger `tolerance` in [simulation] may help"
    ))]
    Integrator {
        /// Time reached (s).
        t: f64,
        /// Message of the integrator.
        reason: &'static str,
    },
    /// A constant slip in a contact whose power has reversed.
    #[error(
        "at t = {t:.6} s power flows through the variator against its `power_flow`: with a constant slip, the contact \
         would generate {power:.3e} W, which is impossible"
    )]
    #[diagnostic(help(
        "use a slip that follows the load: creep = {{ slip = \"2 %\", torque = \"80 N m\" }} instead of `slip`; or \
         reverse `power_flow`"
    ))]
    PowerFlowsBack {
        /// Time (s).
        t: f64,
        /// Power that the contact would generate (W).
        power: f64,
    },
    /// A follower has left its cam, or a rope is slack.
    #[error("at t = {t:.6} s {what}: at {state}")]
    #[diagnostic(help("{cure}"))]
    Parted {
        /// Time (s).
        t: f64,
        /// The contact that separates.
        what: String,
        /// Position and speed.
        state: String,
        /// Cure.
        cure: String,
    },
}

impl<E: Into<Error>> From<E> for SimulationError {
    fn from(error: E) -> Self {
        Self::Machine(error.into())
    }
}

/// Why the integrator stopped, for times counted from `t`.
pub(super) fn stopped(t: f64, error: IntegrationError<Error>) -> SimulationError {
    let (x, reason) = match error {
        IntegrationError::Function(error) => return error.into(),
        IntegrationError::TooManySteps { x } => (x, "too many steps would be needed"),
        IntegrationError::StepTooSmall { x } => {
            (x, "the step size has become too small for double precision")
        }
    };
    SimulationError::Integrator { t: t + x, reason }
}
