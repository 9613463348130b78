//! What drives are ordered by.

use std::cmp::Ordering;

use super::Candidate;
use crate::drive::Drive;
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

/// What drives are ordered by: those that fit by power, warnings and the largest share of a limit used; those refused by the
/// number of limits of zero that they pass, then by that share. Equal ones stay in the order of the catalogue, so that the
/// result does not depend on how the work was shared out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Order {
    first: f64,
    second: u8,
    third: f64,
    pub(super) place: Place,
}

impl Order {
    pub(super) fn of(candidate: &Candidate) -> Self {
        Self::from(&candidate.drive, &candidate.outcome, candidate.place)
    }

    /// The order of a drive with this outcome. It does not fall when shares of limits or their number grow: what is known of an
    /// outcome so far bounds it from below.
    pub(super) fn from(drive: &Drive, outcome: &Outcome, place: Place) -> Self {
        let (first, second) = if outcome.fails() {
            (f64::from(outcome.beyond_all_limits), 0)
        } else {
            let power = drive.motor.rated_power().unwrap_or(f64::INFINITY);
            (power, u8::from(outcome.warnings > 0))
        };
        Self {
            first,
            second,
            third: outcome.worst_use,
            place,
        }
    }
}

impl Eq for Order {}

impl Ord for Order {
    fn cmp(&self, other: &Self) -> Ordering {
        (self.first.total_cmp(&other.first))
            .then_with(|| self.second.cmp(&other.second))
            .then_with(|| self.third.total_cmp(&other.third))
            .then_with(|| self.place.cmp(&other.place))
    }
}

impl PartialOrd for Order {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
