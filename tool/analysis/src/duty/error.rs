//! Why no duty can be computed.

use jred_file::text::problem::Problem;
use std::fmt;

use jred::error::Error;

use jred_file::number::rounding::short;

/// Largest error that a message proposes.
const LARGER: f64 = 1e-6;

/// Why a duty is rejected: its error must be known to be small enough.
#[derive(Clone, Debug, PartialEq)]
pub enum DutyError {
    /// An error of the machine.
    Machine(Error),
    /// The integrals need more instants than fit into memory.
    Fine {
        /// Time up to which they were computed (s).
        until: f64,
        /// The length of the motion (s).
        duration: f64,
        /// The tolerance.
        tolerance: f64,
        /// Largest number of instants.
        most: usize,
        /// Whether the turns alone need them, at any tolerance.
        of_turns: bool,
    },
    /// The integrals do not reach the tolerance, even with the smallest steps.
    Rough {
        /// The stretch of time with the largest error (s).
        span: [f64; 2],
        /// The error reached, as a share of the quantity.
        reached: f64,
        /// The tolerance.
        tolerance: f64,
    },
    /// Energy appears or vanishes.
    Unbalanced {
        /// Work at the input of the drive train (J).
        work: f64,
        /// Change of energy, loads and losses (J).
        spent: f64,
        /// The difference, as a share of the exchanged energy.
        share: f64,
        /// The stretch of time with the largest difference (s).
        span: [f64; 2],
    },
}

impl<E: Into<Error>> From<E> for DutyError {
    fn from(error: E) -> Self {
        Self::Machine(error.into())
    }
}

impl DutyError {
    /// The cure; empty for errors without one.
    pub fn cure(&self) -> String {
        match self {
            Self::Machine(error) => error.cure().to_string(),
            Self::Fine {
                tolerance,
                of_turns,
                ..
            } => {
                let cure = "describe one cycle that repeats, with fewer turns or rows, and smooth a noisy recording (`smoothing` in [motion])";
                if *of_turns || *tolerance >= LARGER {
                    cure.to_owned()
                } else {
                    format!("{cure}; or allow a larger error, such as --tolerance {LARGER:e}")
                }
            }
            Self::Rough { reached, .. } => format!(
                "look at the motion and the loads at that time: a segment far shorter than the cycle is lost in the rounding of the \
                 time; or allow a larger error, --tolerance {}",
                short(2.0 * reached)
            ),
            Self::Unbalanced { .. } => {
                "look at the motion at that time: its position, speed and acceleration must belong \
                 together; if they do, please report the machine file as a fault of this program"
                    .to_owned()
            }
        }
    }
}

impl fmt::Display for DutyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Machine(error) => error.fmt(f),
            Self::Fine {
                until,
                duration,
                tolerance,
                most,
                ..
            } => write!(
                f,
                "the load of the cycle needs more than {most} instants at a tolerance of {tolerance:e}: they reach to {} s of {} s",
                short(*until),
                short(*duration)
            ),
            Self::Rough {
                span: [from, to],
                reached,
                tolerance,
            } => write!(
                f,
                "the integrals over the cycle reach an error of {} of themselves, not {tolerance:e}: most of it arises between {from} s and \
                 {to} s",
                short(*reached)
            ),
            Self::Unbalanced {
                work,
                spent,
                share,
                span: [from, to],
            } => write!(
                f,
                "the energy of the cycle does not balance: the work at the input is {} J, but the gain of energy, losses and process work \
                 are {} J; they differ by {} of the energy moved, most of it between {from} s and {to} s",
                short(*work),
                short(*spent),
                short(*share)
            ),
        }
    }
}

impl std::error::Error for DutyError {}

impl miette::Diagnostic for DutyError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        let cure = self.cure();
        (!cure.is_empty()).then(|| Box::new(cure) as Box<dyn fmt::Display>)
    }
}

impl From<DutyError> for Problem {
    fn from(fault: DutyError) -> Self {
        Self::new(fault.to_string()).help(fault.cure())
    }
}
