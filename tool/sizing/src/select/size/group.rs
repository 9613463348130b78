//! Drives of one kind, suitable or refused, of which the first are sorted.

use super::Candidate;
use super::order::Order;
use super::survey::Survey;
use crate::catalogue::Drive;
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
    near: Vec<Order<'c>>,
    /// Lower bound on the rank of every drive in `rest`; `None` if `rest` is empty.
    limit: Option<Order<'c>>,
    /// Of suitable drives their keys, of refused ones lower bounds.
    pub(super) rest: Vec<Order<'c>>,
    /// Counts over all suitable drives; for refused ones nothing is counted.
    survey: Survey<'c>,
}

impl<'c> Group<'c> {
    /// All drives of one kind, in order.
    pub(crate) fn of(all: Vec<Candidate<'c>>) -> Self {
        let mut group = Self::none();
        for candidate in &all {
            group.count(&Order::of(candidate), &candidate.outcome);
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
    pub(super) fn add(&mut self, drive: Order<'c>, outcome: &Outcome) {
        self.count(&drive, outcome);
        self.put(drive);
    }

    fn count(&mut self, drive: &Order<'c>, outcome: &Outcome) {
        if !outcome.fails() {
            self.survey.add(drive, outcome);
        }
    }

    fn put(&mut self, drive: Order<'c>) {
        if self.limit.is_some_and(|limit| drive >= limit) {
            self.rest.push(drive);
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
        let (_, next, _) = self.near.select_nth_unstable(count);
        self.limit = Some(*next);
        self.rest.extend(self.near.drain(count..));
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

    /// Sorts the first drives, evaluating fully only those whose bounds allow them to be among the first.
    pub(super) fn rank(&mut self, judge: impl Fn(&Order<'c>) -> Candidate<'c>) {
        loop {
            self.near.sort_unstable();
            let mut judged = 0;
            while let Some(next) = self.near.get(judged) {
                let last = self.first.get(FIRST - 1).map(Order::of);
                if last.is_some_and(|last| last <= *next) {
                    self.limit = Some(*next);
                    break;
                }
                let share = self.near[judged..].iter().take(FIRST);
                self.first.extend(share.map(&judge));
                self.first.sort_unstable_by_key(Order::of);
                judged += FIRST;
            }
            self.rest.extend(self.near.drain(..).skip(judged));
            let last = self.first.get(FIRST - 1).map(Order::of);
            if (self.limit).is_none_or(|limit| last.is_some_and(|last| last <= limit)) {
                break;
            }
            // The bounds were not close enough: continue with many more drives.
            self.near = std::mem::take(&mut self.rest);
            let more = 4 * self.first.len();
            self.limit = None;
            if more < self.near.len() {
                self.keep_near(more);
            }
        }
        // Beyond the limit, drives that are not evaluated may rank between those that are.
        if let Some(limit) = self.limit {
            let known = self.first.partition_point(|c| Order::of(c) <= limit);
            let far = self.first.drain(known..).map(|c| Order::of(&c));
            self.rest.extend(far);
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
        first.chain(self.rest.iter().map(|order| order.drive))
    }

    /// Counts over the suitable drives.
    pub(super) const fn survey(&self) -> &Survey<'c> {
        &self.survey
    }
}
