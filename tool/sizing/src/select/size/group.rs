//! Drives of one kind, suitable or refused, of which the first are sorted.

use super::Candidate;
use super::order::Order;
use super::survey::Survey;
use crate::catalogue::{Drive, DriveId};
use crate::judge::Outcome;

/// Number of suitable and of refused drives that are fully evaluated and sorted; see [`Selection`](super::Selection).
pub const FIRST: usize = 64;

/// Number of smallest bounds kept separately while drives are checked; they usually contain the first.
const NEAR: usize = 2 * FIRST;

/// Drives of one kind.
#[derive(Clone, Debug)]
pub struct Group<'c> {
    first: Vec<Candidate<'c>>,
    /// Candidates for the first ranks while drives are checked.
    near: Vec<RankBound<'c>>,
    /// Lower bound on the rank of every drive in `rest`; `None` if `rest` is empty.
    limit: Option<Order<'c>>,
    pub(super) rest: Vec<DriveWithId<'c>>,
    /// Counts over all suitable drives; for refused ones nothing is counted.
    survey: Survey<'c>,
}

/// A drive and its id; small, because this is all that is stored for most drives of a large catalogue.
#[derive(Clone, Copy, Debug)]
pub(super) struct DriveWithId<'c> {
    pub(super) drive: Drive<'c>,
    pub(super) id: DriveId,
}

/// A drive that is not fully evaluated, and a lower bound on its rank.
#[derive(Clone, Copy, Debug)]
pub(super) struct RankBound<'c> {
    pub(super) drive: Drive<'c>,
    pub(super) bound: Order<'c>,
}

impl<'c> RankBound<'c> {
    fn of(candidate: &Candidate<'c>) -> Self {
        Self {
            drive: candidate.drive,
            bound: Order::of(candidate),
        }
    }

    pub(super) const fn placed(&self) -> DriveWithId<'c> {
        DriveWithId {
            drive: self.drive,
            id: self.bound.id,
        }
    }
}

impl<'c> Group<'c> {
    /// All drives of one kind, in order.
    pub(crate) fn of(all: Vec<Candidate<'c>>) -> Self {
        let mut group = Self::none();
        for candidate in &all {
            group.count(&RankBound::of(candidate), &candidate.outcome);
        }
        group.first = all;
        group
    }

    /// An empty group, without allocation.
    pub(super) const fn none() -> Self {
        Self {
            first: Vec::new(),
            near: Vec::new(),
            limit: None,
            rest: Vec::new(),
            survey: Survey::EMPTY,
        }
    }

    /// Adds a drive that is not fully evaluated, and its outcome as far as known.
    pub(super) fn add(&mut self, drive: RankBound<'c>, outcome: &Outcome) {
        self.count(&drive, outcome);
        self.put(drive);
    }

    fn count(&mut self, drive: &RankBound<'c>, outcome: &Outcome) {
        if !outcome.fails() {
            self.survey.add(drive, outcome);
        }
    }

    fn put(&mut self, drive: RankBound<'c>) {
        if self.limit.is_some_and(|limit| drive.bound >= limit) {
            self.rest.push(drive.placed());
            return;
        }
        self.near.push(drive);
        if self.near.len() == 4 * NEAR {
            // The limit is no higher than before: all drives in `near` lie below the former one.
            self.keep_near(NEAR);
        }
    }

    /// Keeps the `count` drives with the lowest bounds near; the others join the rest.
    fn keep_near(&mut self, count: usize) {
        let (_, next, _) = self.near.select_nth_unstable_by_key(count, |d| d.bound);
        self.limit = Some(next.bound);
        let far = self.near.drain(count..).map(|d| d.placed());
        self.rest.extend(far);
    }

    /// Joins two unsorted groups.
    pub(super) fn join(&mut self, other: Self) {
        self.survey.join(&other.survey);
        for drive in other.near {
            self.put(drive);
        }
        self.limit = [self.limit, other.limit].into_iter().flatten().min();
        self.rest.extend(other.rest);
    }

    /// Sorts the first drives, evaluating fully only those whose bounds allow them to be among the first. The bounds of the rest are recomputed if
    /// necessary.
    pub(super) fn rank(
        &mut self,
        judge: impl Fn(&DriveWithId<'c>) -> Candidate<'c>,
        bound: impl Fn(&DriveWithId<'c>) -> RankBound<'c>,
    ) {
        loop {
            let near = self.near.drain(..).map(|drive| judge(&drive.placed()));
            self.first.extend(near);
            self.first.sort_unstable_by_key(Order::of);
            let last = self.first.get(FIRST - 1).map(Order::of);
            if (self.limit).is_none_or(|limit| last.is_some_and(|last| last <= limit)) {
                break;
            }
            // The bounds were not close enough: continue with many more drives.
            self.near = self.rest.drain(..).map(|drive| bound(&drive)).collect();
            let more = 4 * self.first.len();
            self.limit = None;
            if more < self.near.len() {
                self.keep_near(more);
            }
        }
        // Beyond the limit, drives that are not evaluated may rank between those that are.
        if let Some(limit) = self.limit {
            let known = self.first.partition_point(|c| Order::of(c) <= limit);
            self.rest
                .extend(self.first.drain(known..).map(|c| DriveWithId {
                    drive: c.drive,
                    id: c.id,
                }));
        }
    }

    /// Number of drives.
    pub const fn len(&self) -> usize {
        self.first.len() + self.rest.len()
    }

    /// Whether it is empty.
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The best drive.
    pub fn first(&self) -> Option<&Candidate<'c>> {
        self.first.first()
    }

    /// The first drives in order, at least [`FIRST`] or all; after [`Selection::complete`](super::Selection::complete) all.
    pub fn known(&self) -> &[Candidate<'c>] {
        &self.first
    }

    /// All drives; those beyond [`Group::known`] are unordered.
    pub fn drives(&self) -> impl Iterator<Item = Drive<'c>> {
        let first = self.first.iter().map(|c| c.drive);
        first.chain(self.rest.iter().map(|u| u.drive))
    }

    /// Counts over the suitable drives.
    pub(super) const fn survey(&self) -> &Survey<'c> {
        &self.survey
    }
}
