//! Sort key of drives.

use super::Candidate;
use crate::catalogue::Drive;
use crate::judge::Outcome;

/// Place in the catalogue: by the index of the motor, then in the order of its drives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Place(u64);

impl Place {
    pub(super) const fn new(motor: usize, drive: usize) -> Self {
        Self((motor as u64) << u32::BITS | drive as u64)
    }

    /// Index of the motor.
    pub(super) const fn motor(self) -> usize {
        (self.0 >> u32::BITS) as usize
    }
}

/// Sort key of drives: suitable ones by power, warnings and the largest use of a limit; refused ones by the number of limits
/// of zero that they exceed, then by the largest use. Equal ones stay in the order of the catalogue, so that the result does
/// not depend on the division of the work.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Order {
    /// Of those that fit the bits of the power, then one for a warning; of those refused the number of limits.
    first: u64,
    /// The bits of the share: of figures that are not negative they are in the order of the figures.
    share: u64,
    pub(super) place: Place,
}

impl Order {
    pub(super) fn of(candidate: &Candidate) -> Self {
        Self::from(&candidate.drive, &candidate.outcome, candidate.place)
    }

    /// The order of a drive with this outcome. It does not fall when shares of limits or their number grow: what is known of an
    /// outcome so far bounds it from below.
    pub(super) fn from(drive: &Drive, outcome: &Outcome, place: Place) -> Self {
        let first = if outcome.fails() {
            u64::from(outcome.beyond_all_limits)
        } else {
            let power = drive.motor.rated_power().unwrap_or(f64::INFINITY);
            // The sign's bit is free.
            power.abs().to_bits() << 1 | u64::from(outcome.warnings > 0)
        };
        Self {
            first,
            share: outcome.worst_use.to_bits(),
            place,
        }
    }
}
