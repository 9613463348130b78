//! Why a machine has no steady cycle, in sentences.

use crate::list::simulation;
use jred_analysis::steady::{Level, SteadyError};
use jred_file::model::coordinate::Coordinate;
use jred_file::number::rounding::{rounded, short};
use jred_file::problem;
use jred_file::text::problem::{Problem, quoted};
use jred_file::units::RPM;

/// The reason and its cure.
pub fn problem(error: &SteadyError) -> Problem {
    use SteadyError as E;
    match error {
        E::Machine(error) => problem!("{error}; {}", error.cure()),
        E::Stroke(coordinate, [from, to]) => problem!(
            help = "a steady cycle is that of a drive link that turns round and round; use `jred simulate` for the motion on a stroke",
            "the drive link moves on a stroke, {} to {}: it has no steady cycle of whole turns",
            coordinate.place(*from),
            coordinate.place(*to)
        ),
        E::Scheduled(part) => problem!(
            help = format!(
                "{}, for this command; `jred simulate` and `jred size` contain it",
                part.cure
            ),
            "{part}: that goes by [motion], which a steady cycle does not follow"
        ),
        E::NotWhole {
            title,
            turns,
            of_first,
        } => problem!(
            help = "name the slowest machine first, or give --turns: the others must make whole turns in a cycle. `jred simulate` takes any ratio",
            "the machine \"{title}\" makes {} turns while the drive link of the first one makes {of_first}, and that is a cycle",
            short(*turns)
        ),
        E::NoMotor => problem!(
            help = "give --torque \"20 N m\", or torque, torque_speed, dc_motor or induction_motor in [simulation]",
            "[simulation] gives no motor"
        ),
        E::NoTorque => problem!(
            help = "give a torque other than zero: --torque \"20 N m\", or torque, torque_speed, dc_motor or induction_motor in [simulation]",
            "the motor gives no torque at rest, nor at any other speed of its characteristic, and no load drives the machine"
        ),
        E::WrongSign { torque, speed } => problem!(
            help = "change the sign of the torque or of start_speed, or remove start_speed: the machine then turns the way the motor drives it. Where the \
                    process should drive it against the motor, check the signs of its loads",
            "the motor torque at rest, {} N m, drives the drive link against its start_speed, {}, and the loads do not drive it that way",
            short(*torque),
            rpm(*speed)
        ),
        E::NoLevel { by, speed } => problem!(
            help = "choose another mean speed, or give a motor or a load that does work at this one: `jred reduce --over time` shows what acts",
            "no {} keeps the machine turning at {}",
            match by {
                Level::Motor => "torque of the motor".to_owned(),
                Level::Load(name) => format!("size of the load \"{name}\""),
            },
            rpm(*speed)
        ),
        E::NoLoad { name, names } => problem!(
            help = format!("the loads of the machine are {}", quoted(names)),
            "no load is called \"{name}\""
        ),
        E::Turns { own, asked } => problem!(
            help = format!("give a multiple of {own} as --turns, or leave it out"),
            "the loads repeat after {own} turns, and a cycle of {asked} does not"
        ),
        E::Surplus { speed, surplus } => problem!(
            help = "use a torque that falls with the speed (torque_speed, dc_motor or induction_motor in [simulation]), or add the friction \
                    of the machine as a load, such as viscous_moment",
            "there is no steady cycle: motor and loads have a surplus at every speed; at {} still {} J a turn, so that the machine runs away",
            rpm(*speed),
            short(*surplus)
        ),
        E::Indifferent(speed) => problem!(
            help = "add the friction of the machine as a load, such as viscous_moment or opposing_moment",
            "there is no single steady cycle: at {} motor, loads and losses do no work in a turn, so that the machine keeps every speed from \
             there on",
            rpm(*speed)
        ),
        E::Stuck(at) => problem!(
            help = "use a stronger motor or a higher ratio, or a flywheel that carries the machine over this position: --delta gives its \
                    inertia, as far as the motor covers the work of a turn",
            "there is no steady cycle: the motor cannot keep the machine turning. It comes to rest at {}, where the motor gives {} N m and \
             {} N m would be needed: {} N m are missing",
            Coordinate::Angle.place(at.phi),
            short(at.given),
            short(at.needed),
            short((at.needed - at.given).abs())
        ),
        E::Dying(speed) => problem!(
            help = "use a stronger motor, or less load",
            "there is no steady cycle: the speed falls from turn to turn, below {}",
            rpm(*speed)
        ),
        E::NoFlywheel {
            delta,
            inertia,
            reached,
            torque,
        } => no_flywheel([*delta, *inertia, *torque], *reached),
        E::Integrator => problem!(
            help = "the machine follows its motor or its friction almost at once, against its inertia: check rotor_inertia in [simulation], the masses, \
                    viscous friction and how steep the characteristic is, and how near the mechanism comes to a dead point (jred check)",
            "one turn of the machine needs too many integration steps"
        ),
        E::Parted(error) => simulation::problem(error),
    }
}

fn no_flywheel([delta, inertia, torque]: [f64; 3], reached: Option<f64>) -> Problem {
    problem!(
        help = "use a motor that gives more than this at its speed, or another --delta",
        "no flywheel up to {} kg m^2 makes the fluctuation δ = {}: {}; a slow turn asks for {} N m of the motor on average",
        short(inertia),
        short(delta),
        reached.map_or_else(
            || "the machine stops".to_owned(),
            |delta| format!("it is {}", short(delta))
        ),
        short(torque)
    )
}

fn rpm(omega: f64) -> String {
    format!("{} rpm", rounded(omega / RPM))
}
