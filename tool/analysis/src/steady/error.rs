//! Why a machine has no steady cycle.

use jred::error::Error;
use serde::{Serialize, Serializer};

use crate::simulate::SimulationError;

/// Why a machine has no steady cycle, or no flywheel for a fluctuation.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum SteadyError {
    /// The machine cannot be placed.
    #[error("{error}; {cure}", error = .0, cure = .0.cure())]
    Machine(Error),
    /// The drive link has a stroke.
    #[error("the drive link moves on a stroke, {range}: it has no steady cycle of whole turns")]
    #[diagnostic(help(
        "a steady cycle is that of a drive link that turns round and round; use `jred simulate` for the motion on a stroke"
    ))]
    Stroke {
        /// Description of the stroke.
        range: String,
    },
    /// A part is scheduled by the motion of the file, which a steady cycle does not follow.
    #[error("{what}: that goes by [motion], which a steady cycle does not follow")]
    #[diagnostic(help("{cure}, for this command; `jred simulate` and `jred size` contain it"))]
    Scheduled {
        /// The load, payload or carriage.
        what: String,
        /// How to do without it.
        cure: String,
    },
    /// Machines on one shaft that do not repeat together.
    #[error(
        "the machine \"{title}\" makes {turns} turns while the drive link of the first one makes {of_first}, and that is a cycle"
    )]
    #[diagnostic(help(
        "name the slowest machine first, or give --turns: the others must make whole turns in a cycle. `jred simulate` takes any ratio"
    ))]
    NotWhole {
        /// The machine.
        title: String,
        /// Its turns.
        turns: String,
        /// Turns of the first machine in a cycle.
        of_first: u32,
    },
    /// No motor is given.
    #[error("[simulation] gives no motor")]
    #[diagnostic(help(
        "give --torque \"20 N m\", or torque, torque_speed, dc_motor or induction_motor in [simulation]"
    ))]
    NoMotor,
    /// The motor has no torque.
    #[error(
        "the motor gives no torque at rest, nor at any other speed of its characteristic, and no load drives the machine"
    )]
    #[diagnostic(help(
        "give a torque other than zero: --torque \"20 N m\", or torque, torque_speed, dc_motor or induction_motor in [simulation]"
    ))]
    NoTorque,
    /// The motor drives in the other direction.
    #[error(
        "the motor torque at rest, {torque}, drives the drive link against its start_speed, {speed}, and the loads do not drive it that way"
    )]
    #[diagnostic(help(
        "change the sign of the torque or of start_speed, or remove start_speed: the machine then turns the way the motor drives it. Where the \
         process should drive it against the motor, check the signs of its loads"
    ))]
    WrongSign {
        /// Torque of the motor at rest.
        torque: String,
        /// The speed of the file.
        speed: String,
    },
    /// No scaling of a motor or a load gives the mean speed.
    #[error("no {what} keeps the machine turning at {speed}")]
    #[diagnostic(help(
        "choose another mean speed, or give a motor or a load that does work at this one: `jred reduce --over time` shows what acts"
    ))]
    NoLevel {
        /// The scaled quantity.
        what: std::borrow::Cow<'static, str>,
        /// The speed.
        speed: String,
    },
    /// No load has the name.
    #[error("no load is called \"{name}\"")]
    #[diagnostic(help("the loads of the machine are {names}"))]
    NoLoad {
        /// The name.
        name: String,
        /// The existing names.
        names: String,
    },
    /// A cycle of this number of turns does not repeat.
    #[error("the loads repeat after {own} turns, and a cycle of {asked} does not")]
    #[diagnostic(help("give a multiple of {own} as --turns, or leave it out"))]
    Turns {
        /// Turns after which the loads repeat.
        own: u32,
        /// Turns of the cycle.
        asked: u32,
    },
    /// The machine gains energy in each turn at every speed.
    #[error(
        "there is no steady cycle: motor and loads have a surplus at every speed; at {speed} still {surplus} J a turn, so that \
         the machine runs away"
    )]
    #[diagnostic(help(
        "use a torque that falls with the speed (torque_speed, dc_motor or induction_motor in [simulation]), or add the friction \
         of the machine as a load, such as viscous_moment"
    ))]
    Surplus {
        /// The highest evaluated speed.
        speed: String,
        /// Energy gained in a turn there (J).
        surplus: String,
    },
    /// The speed is indeterminate.
    #[error(
        "there is no single steady cycle: at {speed} motor, loads and losses do no work in a turn, so that the machine keeps every \
         speed from there on"
    )]
    #[diagnostic(help(
        "add the friction of the machine as a load, such as viscous_moment or opposing_moment"
    ))]
    Indifferent {
        /// The speed.
        speed: String,
    },
    /// The machine stops.
    #[error(
        "there is no steady cycle: the motor cannot keep the machine turning. It comes to rest at {place}, where the motor gives \
         {given} and {needed} would be needed: {missing} are missing"
    )]
    #[diagnostic(help(
        "use a stronger motor or a higher ratio, or a flywheel that carries the machine over this position: --delta gives its \
         inertia, as far as the motor covers the work of a turn"
    ))]
    Stuck {
        /// Where it comes to rest.
        place: String,
        /// Motor torque there.
        given: String,
        /// Motor torque needed there.
        needed: String,
        /// Their difference.
        missing: String,
    },
    /// The speed falls without end.
    #[error("there is no steady cycle: the speed falls from turn to turn, below {speed}")]
    #[diagnostic(help("use a stronger motor, or less load"))]
    Dying {
        /// The lowest evaluated speed.
        speed: String,
    },
    /// No flywheel gives the requested fluctuation.
    #[error(
        "no flywheel up to {inertia} kg m^2 makes the fluctuation δ = {delta}: {why}; a slow turn asks for {torque} N m of the motor on average"
    )]
    #[diagnostic(help("use a motor that gives more than this at its speed, or another --delta"))]
    NoFlywheel {
        /// The requested fluctuation.
        delta: String,
        /// The largest inertia tried.
        inertia: String,
        /// The result with it.
        why: String,
        /// Mean motor torque of a slow turn (N·m).
        torque: String,
    },
    /// The integrator stopped.
    #[error("one turn of the machine needs too many integration steps")]
    #[diagnostic(help(
        "the machine follows its motor or its friction almost at once, against its inertia: check rotor_inertia in [simulation], the masses, \
         viscous friction and how steep the characteristic is, and how near the mechanism comes to a dead point (jred check)"
    ))]
    Integrator,
    /// A contact separates in the steady cycle.
    #[error("{}", parted(.0)[0])]
    #[diagnostic(help("{}", parted(.0)[1]))]
    Parted(SimulationError),
}

fn parted(error: &SimulationError) -> [String; 2] {
    let SimulationError::Parted { t, separation } = error else {
        return [format!("{error:?}"), String::new()];
    };
    let what = format!(
        "at t = {t:.6} s {}: at {}",
        separation.what, separation.state
    );
    [what, separation.cure.clone()]
}

impl<E: Into<Error>> From<E> for SteadyError {
    fn from(error: E) -> Self {
        Self::Machine(error.into())
    }
}

impl SteadyError {
    /// Whether more inertia may help.
    pub(super) const fn is_standstill(&self) -> bool {
        matches!(self, Self::Stuck { .. } | Self::Dying { .. })
    }
}

impl Serialize for SteadyError {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
