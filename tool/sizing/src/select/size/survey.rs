//! What the suitable drives have in common, all of them: how many are how certain, and which rules are not checked for how many.

use super::group::{Placed, Unranked};
use super::order::Certainty;
use crate::judge::Outcome;
use jred_machine::model::rule::Rule;

/// Drives that there is room for at once.
const AT_ONCE: usize = 192;

/// Counts of drives that fit, kept while drives are checked.
#[derive(Clone, Debug)]
pub(super) struct Survey<'c> {
    classes: [Class<'c>; Certainty::ALL.len()],
    gaps: [Gap<'c>; Rule::COUNT],
    partly_checked: usize,
}

/// Drives of one certainty.
#[derive(Clone, Debug, Default)]
pub(super) struct Class<'c> {
    pub(super) count: usize,
    /// Smallest size of motor.
    least: Option<u64>,
    /// Those of the smallest size: the first in order is among them.
    pub(super) smallest: Vec<Placed<'c>>,
}

/// Drives for which a rule is not checked.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Gap<'c> {
    pub(super) count: usize,
    /// One of them, always the same.
    pub(super) example: Option<Unranked<'c>>,
}

impl<'c> Survey<'c> {
    /// Of no drive, without allocation.
    pub(super) const EMPTY: Self = Self {
        classes: [const {
            Class {
                count: 0,
                least: None,
                smallest: Vec::new(),
            }
        }; Certainty::ALL.len()],
        gaps: [Gap {
            count: 0,
            example: None,
        }; Rule::COUNT],
        partly_checked: 0,
    };

    /// Adds a drive that fits.
    pub(super) fn add(&mut self, drive: &Unranked<'c>, outcome: &Outcome) {
        let class = &mut self.classes[Certainty::of(&drive.drive, outcome) as usize];
        class.count += 1;
        class.offer(drive.bound.size(), &[drive.placed()]);
        self.partly_checked += usize::from(!outcome.not_checked.is_empty());
        for rule in outcome.not_checked.iter() {
            self.gaps[rule as usize].add(drive);
        }
    }

    pub(super) fn join(&mut self, other: Self) {
        for (class, other) in self.classes.iter_mut().zip(other.classes) {
            class.count += other.count;
            if let Some(size) = other.least {
                class.offer(size, &other.smallest);
            }
        }
        for (gap, other) in self.gaps.iter_mut().zip(other.gaps) {
            gap.join(other);
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
    fn offer(&mut self, size: u64, drives: &[Placed<'c>]) {
        if self.least.is_none_or(|least| size < least) {
            self.least = Some(size);
            self.smallest.clear();
        }
        if self.least == Some(size) {
            // As many as the gearboxes that a motor has in most catalogues, at once.
            if self.smallest.capacity() == 0 {
                self.smallest.reserve(AT_ONCE.max(drives.len()));
            }
            self.smallest.extend_from_slice(drives);
        }
    }
}

impl<'c> Gap<'c> {
    /// The example is the first in the catalogue, however the work is divided.
    fn add(&mut self, drive: &Unranked<'c>) {
        self.count += 1;
        if self
            .example
            .is_none_or(|first| drive.bound.id() < first.bound.id())
        {
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
