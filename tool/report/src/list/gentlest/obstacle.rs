//! Why there is no gentlest motion, in sentences.

use jred_file::model::machine::MachineFile;
use jred_file::number::rounding::short;
use jred_file::problem;
use jred_file::text::problem::Problem;
use jred_motion::gentlest::Fault;
use jred_motion::gentlest::cycle::Obstacle;
use jred_motion::moves::{Move, NoMoves};

/// Why there is no motion.
pub fn problem(obstacle: &Obstacle, file: &MachineFile, motor: Option<&str>) -> Problem {
    let name = &file.name;
    match obstacle {
        Obstacle::Duty(fault) => Problem::from(fault.clone()),
        Obstacle::NoMoves(NoMoves::Still) => problem!(
            help = "give a motion with at least one move",
            "nothing moves in the motion of {name}"
        ),
        Obstacle::NoMoves(NoMoves::AllKept) => problem!(
            help = "give a motion with moves in addition to the constant speed",
            "{name} moves at constant speed only, which is kept: there is nothing to optimise"
        ),
        Obstacle::NoMoves(NoMoves::NotAtRest { speed, at_end }) => {
            let axis = file.axis();
            let unit = axis.coordinate.speed_unit();
            problem!(
                help = "a motion that is to be made anew begins and ends at rest; or it is cyclic and turns on with the speed that it \
                        begins with",
                "the motion of {name} {} at {} {unit}",
                if *at_end { "ends" } else { "begins" },
                short(axis.rate(speed.abs()))
            )
        }
        Obstacle::NoCopper => match motor {
            None => problem!(
                help = "name the drive: --drive MOTOR+GEARBOX",
                "the energy contains the copper loss of a motor, and no motor is given"
            ),
            Some(motor) => problem!(
                help = "fill in resistance and torque constant in the catalogue (docs/catalogue.md), or use --objective rms",
                "the copper loss of {motor:?} is not known: the catalogue does not state its resistance or its torque constant"
            ),
        },
        Obstacle::Move(number, step, fault) => of_move(*number, step, fault, file),
    }
}

fn of_move(number: usize, step: &Move, fault: &Fault, file: &MachineFile) -> Problem {
    let axis = file.axis();
    let place = format!(
        "move {number} of the motion, from {} to {} in {} s",
        axis.place(step.from),
        axis.place(step.to),
        short(step.duration)
    );
    match fault {
        Fault::Machine(error) => Problem::of(*error),
        Fault::Figure(what, value) => problem!(
            help =
                "give a move with a distance and a duration that are not extremely small or large",
            "{place}: the {what} {value} cannot be used"
        ),
        Fault::NoInertia => problem!(
            help = "give the links a mass or an inertia",
            "{place}: nothing that moves has inertia"
        ),
        Fault::NotFound => problem!(
            help = "shorten it: in a long time the machine nearly stops somewhere, which the search does not find; write a pause between moves instead. Or try other --ends, or another --objective",
            "{place}: the search for the gentlest motion did not converge"
        ),
    }
}
