//! Why a simulation ended early, in sentences.

use jred_analysis::simulate::{IntegratorStop, NotBeside, SimulationError};
use jred_file::number::rounding::short;
use jred_file::problem;
use jred_file::text::problem::Problem;

/// The reason and its cure.
pub fn problem(error: &SimulationError) -> Problem {
    use SimulationError as E;
    match error {
        E::Machine(error) => problem!("{error}; {}", error.cure()),
        E::NoMotor => problem!(
            help = "give torque, torque_speed, dc_motor or induction_motor in [simulation] (force or force_speed of a link that slides), or a drive of \
                    the catalogue: --drive MOTOR+GEARBOX",
            "[simulation] gives no motor"
        ),
        E::Scheduled(part) => problem!(
            help = format!(
                "{}, for this command; `jred reduce --over time` and `jred size` contain it",
                part.cure
            ),
            "{part}: that goes by [motion], and is not simulated behind a [variator]"
        ),
        E::NoStop => problem!(
            help =
                "add stop = { time = \"3 s\", brake_torque = \"80 N m\", brake_delay = \"40 ms\" }",
            "[simulation] has no `stop` whose instant could be moved"
        ),
        E::NoCycle => problem!(
            help = "give the stop a later time, after a turn of the drive link or a cycle of [motion] under a controller",
            "there is no whole cycle before the `stop`"
        ),
        E::NotBeside { title, why } => problem!(
            help = "simulate it alone, or refer it to the shaft of another machine as a [[drive_train.branch]]",
            "the machine \"{title}\" cannot run on one shaft with others: {}",
            not_beside(*why)
        ),
        E::EndOfStroke {
            t,
            axis,
            end,
            speed,
        } => problem!(
            help = "the machine has no end stop: add end_stops to [simulation], reduce its `duration`, start elsewhere, or add a spring or damper as a \
                    buffer and a longer stroke",
            "the drive link hits the end of its stroke, {}, at t = {t:.6} s, at {} {}",
            axis.place(*end),
            short(axis.rate(*speed)),
            axis.coordinate.speed_unit()
        ),
        E::Integrator { t, why } => problem!(
            help = "look for what is stiff or grows without limit: viscous friction that is large for the inertia, a steep characteristic of the motor, \
                    a controller's gain, a winding's L/R; soften it, or shorten `duration`. A larger `tolerance` in [simulation] may help",
            "the integrator stopped at t = {t} s: {}",
            stopped(*why)
        ),
        E::PowerFlowsBack { t, power } => problem!(
            help = "use a slip that follows the load: creep = { slip = \"2 %\", torque = \"80 N m\" } instead of `slip`; or \
                    reverse `power_flow`",
            "at t = {t:.6} s power flows through the variator against its `power_flow`: with a constant slip, the contact \
             would generate {power:.3e} W, which is impossible"
        ),
        E::Parted { t, separation } => problem!(
            help = separation.cure().as_str(),
            "at t = {t:.6} s {}: at {}",
            separation.what(),
            separation.state()
        ),
    }
}

const fn not_beside(why: NotBeside) -> &'static str {
    match why {
        NotBeside::MotorAtDriveLink => {
            "the motor of the first machine acts at its drive link: write at = \"motor\""
        }
        NotBeside::TurnsAndSlides => {
            "one drive train begins at a motor that turns, the other at one that slides"
        }
        NotBeside::Variator => "machines with a [variator] run alone",
        NotBeside::Stroke => "its drive link has a stroke, and only the first machine may have one",
    }
}

const fn stopped(why: IntegratorStop) -> &'static str {
    match why {
        IntegratorStop::Steps => "too many steps would be needed",
        IntegratorStop::StepSize => "the step size has become too small for double precision",
        IntegratorStop::Reversals => "the drive link turns round again and again",
        IntegratorStop::Corners => {
            "too much changes within one output step by the clock of [motion]"
        }
    }
}
