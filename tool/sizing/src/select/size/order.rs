//! Sort key of drives.

use super::Candidate;
use crate::catalogue::{Drive, DriveId};
use crate::judge::Outcome;

/// What has to be cleared up before a drive that fits can be bought: nothing, figures of others than the makers, a voltage that
/// nobody states, or both. Less comes first, whatever else drives are ranked by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::select) struct Doubt(u8);

impl Doubt {
    pub(in crate::select) fn of(drive: &Drive, outcome: &Outcome) -> Self {
        Self(u8::from(outcome.voltage_unknown) << 1 | u8::from(!drive.from_makers()))
    }
}

/// Sort key of drives: suitable ones by what is in doubt, power, warnings and the largest use of a limit; refused ones by the number of limits
/// of zero that they exceed, then by the largest use. Equal ones stay in the order of the catalogue, so that the result does
/// not depend on the division of the work.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Order {
    /// Of those refused none.
    doubt: Doubt,
    /// Of those that fit the bits of the power, then one for a warning; of those refused the number of limits.
    first: u64,
    /// The bits of the share: of figures that are not negative they are in the order of the figures.
    share: u64,
    pub(super) id: DriveId,
}

impl Order {
    pub(super) fn of(candidate: &Candidate) -> Self {
        Self::from(&candidate.drive, &candidate.outcome, candidate.id)
    }

    /// The order of a drive with this outcome. It does not fall when shares of limits or their number grow: what is known of an
    /// outcome so far bounds it from below.
    pub(super) fn from(drive: &Drive, outcome: &Outcome, id: DriveId) -> Self {
        let mut doubt = Doubt(0);
        let first = if outcome.fails() {
            u64::from(outcome.beyond_all_limits)
        } else {
            doubt = Doubt::of(drive, outcome);
            let power = drive.motor.rated_power().unwrap_or(f64::INFINITY);
            // The sign's bit is free.
            power.abs().to_bits() << 1 | u64::from(outcome.warnings > 0)
        };
        Self {
            doubt,
            first,
            share: outcome.worst_use.to_bits(),
            id,
        }
    }
}
