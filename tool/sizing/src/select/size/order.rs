//! Sort key of drives.

use super::Candidate;
use crate::catalogue::{Drive, DriveId};
use crate::judge::Outcome;

jred_machine::words! {
    /// How certain it is that a drive that violates no rule can be bought as it is. The more certain come first, whatever else
    /// drives are ranked by.
    #[derive(PartialOrd, Ord, Hash)]
    pub enum Certainty {
        /// The voltage is stated, and all figures are the makers' own.
        Makers = "makers-figures",
        /// The voltage is stated, but not all figures are from the makers' own documents.
        Others = "other-figures",
        /// Nobody states what voltage the motor or the amplifier is made for.
        Voltage = "voltage-unknown",
    }
}

impl Certainty {
    /// All, the most certain first.
    pub const ALL: [Self; 3] = [Self::Makers, Self::Others, Self::Voltage];

    /// That of a drive with this outcome.
    pub fn of(drive: &Drive, outcome: &Outcome) -> Self {
        if outcome.voltage_unknown {
            Self::Voltage
        } else if drive.from_makers() {
            Self::Makers
        } else {
            Self::Others
        }
    }
}

/// Sort key of drives: suitable ones by certainty, power, warnings and the largest use of a limit; refused ones by the number of limits
/// of zero that they exceed, then by the largest use. Equal ones stay in the order of the catalogue, so that the result does
/// not depend on the division of the work.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Order {
    /// Of those refused none.
    certainty: Option<Certainty>,
    /// Of those that fit the bits of the power, then one for a warning; of those refused the number of limits.
    first: u64,
    /// The bits of the share: of figures that are not negative they are in the order of the figures.
    share: u64,
    pub(super) id: DriveId,
}

impl Order {
    /// That of a candidate.
    pub fn of(candidate: &Candidate) -> Self {
        Self::from(&candidate.drive, &candidate.outcome, candidate.id)
    }

    /// Whether a drive that fits is as certain as another one that does, its motor no larger and without more warnings, whatever margin it leaves.
    pub fn is_as_good_as(&self, other: &Self) -> bool {
        (self.certainty, self.first) <= (other.certainty, other.first)
    }

    /// Which drive.
    pub(super) const fn id(&self) -> DriveId {
        self.id
    }

    /// The size of the motor of a drive that fits, and whether there is a warning.
    pub(super) const fn size(&self) -> u64 {
        self.first
    }

    /// The order of a drive with this outcome. It does not fall when shares of limits or their number grow: what is known of an
    /// outcome so far bounds it from below.
    pub(super) fn from(drive: &Drive, outcome: &Outcome, id: DriveId) -> Self {
        let mut certainty = None;
        let first = if outcome.fails() {
            u64::from(outcome.beyond_all_limits)
        } else {
            certainty = Some(Certainty::of(drive, outcome));
            let power = drive.motor.rated_power().unwrap_or(f64::INFINITY);
            // The sign's bit is free.
            power.abs().to_bits() << 1 | u64::from(outcome.warnings > 0)
        };
        Self {
            certainty,
            first,
            share: outcome.worst_use.to_bits(),
            id,
        }
    }
}
