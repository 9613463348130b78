//! Counts over all suitable drives: by certainty, and by rules that are not checked.

use super::order::{Certainty, Order};
use crate::judge::Outcome;
use jred_file::model::rule::Rule;

/// Counts of suitable drives, updated while drives are checked.
#[derive(Clone, Debug)]
pub(super) struct Survey<'c> {
    classes: [Class<'c>; Certainty::ALL.len()],
    gaps: [Gap<'c>; Rule::COUNT],
    partly_checked: usize,
}

/// Drives of one certainty.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Class<'c> {
    pub(super) count: usize,
    /// The first in order: the rank of a suitable drive does not depend on the shares of its limits.
    pub(super) first: Option<Order<'c>>,
}

/// Drives for which a rule is not checked.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Gap<'c> {
    pub(super) count: usize,
    /// One of them, independent of the division of the work.
    pub(super) example: Option<Order<'c>>,
}

impl<'c> Survey<'c> {
    /// Counts of no drive, without allocation.
    pub(super) const EMPTY: Self = Self {
        classes: [const {
            Class {
                count: 0,
                first: None,
            }
        }; Certainty::ALL.len()],
        gaps: [Gap {
            count: 0,
            example: None,
        }; Rule::COUNT],
        partly_checked: 0,
    };

    /// Adds a suitable drive.
    pub(super) fn add(&mut self, drive: &Order<'c>, outcome: &Outcome) {
        let class = &mut self.classes[Certainty::of(&drive.drive, outcome) as usize];
        class.count += 1;
        class.offer(drive);
        self.partly_checked += usize::from(!outcome.not_checked.is_empty());
        for rule in outcome.not_checked.iter() {
            self.gaps[rule as usize].add(drive);
        }
    }

    pub(super) fn join(&mut self, other: &Self) {
        for (class, other) in self.classes.iter_mut().zip(&other.classes) {
            class.count += other.count;
            if let Some(first) = &other.first {
                class.offer(first);
            }
        }
        for (gap, other) in self.gaps.iter_mut().zip(&other.gaps) {
            gap.join(*other);
        }
        self.partly_checked += other.partly_checked;
    }

    /// Number of drives that are not fully checked.
    pub(super) const fn partly_checked(&self) -> usize {
        self.partly_checked
    }

    /// The drives of one certainty.
    pub(super) fn class(&self, certainty: Certainty) -> &Class<'c> {
        &self.classes[certainty as usize]
    }

    /// The rules that are not checked for some drives.
    pub(super) fn gaps(&self) -> impl Iterator<Item = (Rule, Gap<'c>)> {
        let all = Rule::ALL.into_iter().zip(self.gaps);
        all.filter(|(_, gap)| gap.count > 0)
    }
}

impl<'c> Class<'c> {
    fn offer(&mut self, drive: &Order<'c>) {
        if (self.first.as_ref()).is_none_or(|first| drive < first) {
            self.first = Some(*drive);
        }
    }
}

impl<'c> Gap<'c> {
    /// The example is the first in the catalogue, regardless of how the work is divided.
    fn add(&mut self, drive: &Order<'c>) {
        self.count += 1;
        if self.example.is_none_or(|first| drive.id < first.id) {
            self.example = Some(*drive);
        }
    }

    fn join(&mut self, other: Self) {
        if let Some(drive) = &other.example {
            self.add(drive);
            self.count += other.count - 1;
        }
    }
}
