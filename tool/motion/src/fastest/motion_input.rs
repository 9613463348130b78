//! The motion to optimise: one move, or the motion of the file.

use jred_file::model::machine::MachineFile;
use jred_file::number::rounding::short;
use jred_file::problem;
use jred_file::text::problem::Result;

use super::cycle::{Cycle, cycle, endless, single};
use super::{MoveLimits, NoMotion, Rms, Task};
use crate::moves::{Chain, NoMoves, Part, chain};
use crate::path_dynamics::Actuator;

/// The motion to optimise.
#[derive(Debug)]
pub enum MotionInput {
    /// One move.
    Move(Box<Task>),
    /// The motion of the file.
    Chain(Chain),
}

impl MotionInput {
    /// The parts of the file's motion.
    pub const fn chain(&self) -> Option<&Chain> {
        match self {
            Self::Move(_) => None,
            Self::Chain(chain) => Some(chain),
        }
    }

    /// The fastest motion.
    ///
    /// # Errors
    /// Why a move has no motion, with its number.
    pub fn fastest(
        &self,
        file: &MachineFile,
        actuator: &Actuator,
        limits: &MoveLimits,
        rms: Option<Rms>,
    ) -> Result<Cycle, (Option<usize>, NoMotion)> {
        match self {
            Self::Move(task) => {
                let task = Task {
                    limits: *limits,
                    ..**task
                };
                single(file, actuator, task, rms).map_err(|why| (None, why))
            }
            Self::Chain(chain) => {
                let mut moves = chain.parts.iter().filter_map(Part::step);
                if let Some((step, _)) = moves.next().filter(|_| chain.endless) {
                    return endless(file, actuator, *limits, &step).map_err(|why| (None, why));
                }
                let several = moves.next().is_some();
                cycle(file, actuator, *limits, rms, &chain.parts)
                    .map_err(|(index, why)| (several.then_some(index + 1), why))
            }
        }
    }
}

/// The moves of the file's motion.
///
/// # Errors
/// The file has no motion, or one without moves from rest to rest.
pub fn of_motion(file: &MachineFile, limits: &MoveLimits, rms: Option<Rms>) -> Result<MotionInput> {
    let motion = file.motion_or("give --from and --to, or ")?;
    let chain = chain(motion, &file.process()).map_err(|why| match why {
        NoMoves::Still => problem!(
            help = "give --from and --to, or a [motion] with a move",
            "nothing moves in the motion of {}",
            file.name
        ),
        NoMoves::NotAtRest { speed, at_end } => {
            let end = if at_end { "ends" } else { "begins" };
            let axis = file.axis();
            let unit = axis.coordinate.speed_unit();
            problem!(
                help = "give --from and --to, or begin and end the cycle of [motion] at a position where the machine is at rest",
                "the motion of {} {end} with {} {unit}, so its moves are not known",
                file.name,
                short(axis.rate(speed.abs()))
            )
        }
        NoMoves::AllKept => problem!(
            help = "give --from and --to, or a [motion] with moves in addition to the constant speed",
            "{} moves at constant speed only, which is kept: there is nothing to optimise",
            file.name
        ),
    })?;
    if chain.endless && (limits.has_rates() || rms.is_some()) {
        return Err(problem!(
            help = "leave them out, or give one move with --from and --to",
            "the motion of {} turns endlessly: --max-jerk, --max-torque-rate and --max-rms are for moves from rest to rest",
            file.name
        ));
    }
    Ok(MotionInput::Chain(chain))
}
