//! Sizing: checks and ranks every drive of a catalogue.

use std::cmp::Ordering;
use std::collections::HashSet;

use crate::catalogue::{Catalogue, Drive, DriveId, Resistor};
use crate::cycle::Cycle;
use crate::judge::Assessment;
use crate::judge::check::Check;
use crate::judge::{Context, Outcome, Screen};
use crate::motor::envelope::MotorLimits;
use crate::threads;
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleSet;
use jred_file::model::site::Site;
use jred_file::units::{Sentence, Vocabulary};

mod group;
mod order;
mod survey;

pub use group::{FIRST, Group};
pub use order::{Certainty, Order};

/// Default ranking of drives.
fn by_size(Vocabulary { torque, .. }: &Vocabulary) -> String {
    format!(
        "the smallest motor first (rated {torque} times rated speed, then rated {torque}); equal motors: without warnings first, then the smallest \
         amplifier (rated current), the smallest gearbox (rated {torque}), the lightest, the cheapest"
    )
}

/// The first criterion of every ranking.
const FIRST_OF_ALL: &str = "drives with the makers' own figures first, then with figures from others, then those for \
                            which the catalogue lacks the amplifier, a brake that is needed or a limit of the gearbox, then with an amplifier that no source pairs with the motor, then of unknown voltage; within each group ";

/// Smallest number of motors per unit of parallel work.
const SHARE: usize = 16;

/// A drive and its result in numbers.
#[derive(Clone, Copy, Debug)]
pub struct Candidate<'c> {
    /// The drive.
    pub drive: Drive<'c>,
    /// Limits of its motor.
    pub motor: &'c MotorLimits,
    /// Result.
    pub outcome: Outcome,
    /// Identifies it in the catalogue; breaks ties.
    id: DriveId,
}

impl Candidate<'_> {
    /// How certain it is that the drive can be bought as it is; `None` if it is refused.
    pub fn certainty(&self) -> Option<Certainty> {
        (!self.outcome.fails()).then(|| Certainty::of(&self.drive, &self.outcome))
    }

    /// Identifies the drive in the catalogue.
    pub const fn id(&self) -> DriveId {
        self.id
    }

    /// Whether both are the same drive of the catalogue.
    pub fn is_same_drive(&self, other: &Candidate) -> bool {
        self.id == other.id
    }
}

/// The suitable drives of one certainty.
#[derive(Clone, Copy, Debug)]
pub struct Class<'c> {
    /// Their certainty.
    pub certainty: Certainty,
    /// Number of drives.
    pub count: usize,
    /// Rank of the first of them.
    pub rank: usize,
    /// The first of them: the smallest, unless another ranking applies.
    pub first: Candidate<'c>,
}

/// A rule that is not checked for some of the suitable drives.
#[derive(Clone, Debug)]
pub struct Gap {
    /// The rule.
    pub rule: Rule,
    /// Number of drives.
    pub count: usize,
    /// The rule's check of one of them.
    pub example: Check,
}

/// A rule that refused drives violate.
#[derive(Clone, Copy, Debug)]
pub struct Violation<'c> {
    /// The rule.
    pub rule: Rule,
    /// Number of drives.
    pub count: usize,
    /// Number of those that violate nothing else.
    pub alone: usize,
    /// The one of them that violates its limits least.
    pub closest: Candidate<'c>,
}

/// All drives with their results.
///
/// Every drive is checked against every rule. The sort keys are computed only for the first [`FIRST`] suitable and refused drives, which is a small
/// part of the work for a large catalogue. [`Selection::complete`] computes them for all.
#[derive(Clone, Debug)]
pub struct Selection<'c> {
    /// The prepared duty.
    pub cycle: &'c Cycle,
    /// Site of the drives.
    pub site: &'c Site,
    /// The rules that they were checked against.
    pub rules: &'c RuleSet,
    /// The ranking of the suitable drives, if not by the size of their motors.
    pub ranking: Option<Sentence>,
    /// Drives that violate no rule, best first: see [`Selection::ranking()`].
    pub fit: Group<'c>,
    /// Drives that violate a rule, closest first.
    pub refused: Group<'c>,
    motors: &'c [MotorLimits],
    /// Brake resistors to choose from.
    resistors: &'c [Resistor],
}

impl<'c> Selection<'c> {
    /// Judges every drive of the catalogue on this thread. The time for a drive does not depend on the number of the cycle's instants, except for
    /// rules that follow time: docs/performance.md.
    pub fn new(
        catalogue: &'c Catalogue,
        motors: &'c [MotorLimits],
        cycle: &'c Cycle,
        site: &'c Site,
        rules: &'c RuleSet,
    ) -> Self {
        let all = catalogue.drives();
        Self::among(all, catalogue, motors, cycle, site, rules)
    }

    /// Judges these drives of the catalogue only, motor by motor.
    pub fn among(
        drives: impl Iterator<Item = (DriveId, Drive<'c>)>,
        catalogue: &'c Catalogue,
        motors: &'c [MotorLimits],
        cycle: &'c Cycle,
        site: &'c Site,
        rules: &'c RuleSet,
    ) -> Self {
        let mut selection = Self::empty(catalogue, motors, cycle, site, rules);
        let screen = selection.screen(catalogue);
        selection.judge(&screen, drives);
        selection.in_order()
    }

    /// The same as [`Selection::new`] on all cores: the same drives in the same order.
    pub fn parallel(
        catalogue: &'c Catalogue,
        motors: &'c [MotorLimits],
        cycle: &'c Cycle,
        site: &'c Site,
        rules: &'c RuleSet,
    ) -> Self {
        let empty = || Self::empty(catalogue, motors, cycle, site, rules);
        let screen = empty().screen(catalogue);
        let judge = |mut part: Self, index| {
            part.judge(&screen, catalogue.drives_of(index..index + 1));
            part
        };
        let judged = threads::fold(catalogue.motors.len(), SHARE, empty, judge, Self::join);
        judged.in_order()
    }

    /// The first of all drives that fit; `None`: none fits. Drives that would rank after one that fits are not judged.
    pub fn best(
        catalogue: &'c Catalogue,
        motors: &'c [MotorLimits],
        cycle: &'c Cycle,
        site: &'c Site,
        rules: &'c RuleSet,
    ) -> Option<Candidate<'c>> {
        let selection = Self::empty(catalogue, motors, cycle, site, rules);
        let screen = selection.screen(catalogue);
        // The order affects the time only: small motors of known voltage are likely first.
        let motors = &catalogue.motors;
        let late = |k: &usize| (motors[*k].made_for().is_none(), motors[*k].rated_power());
        let mut likely: Vec<usize> = (0..motors.len()).collect();
        likely.sort_by(|a, b| late(a).partial_cmp(&late(b)).unwrap_or(Ordering::Equal));
        let mut best: Option<Candidate> = None;
        let drives = likely
            .into_iter()
            .flat_map(|k| catalogue.drives_of(k..k + 1));
        for (id, drive) in drives {
            let first = |bound: &Order| best.is_none_or(|best| *bound < Order::of(&best));
            if !first(&Order::from(drive, &Outcome::NOTHING, id)) {
                continue;
            }
            let (order, outcome) = selection.bound(&screen, id, drive);
            if !outcome.fails() && first(&order) {
                best = Some(selection.in_full(&order));
            }
        }
        best
    }

    fn empty(
        catalogue: &'c Catalogue,
        motors: &'c [MotorLimits],
        cycle: &'c Cycle,
        site: &'c Site,
        rules: &'c RuleSet,
    ) -> Self {
        Self {
            cycle,
            site,
            rules,
            ranking: None,
            fit: Group::none(),
            refused: Group::none(),
            motors,
            resistors: &catalogue.resistors,
        }
    }

    /// Description of the ranking, for a kind of motor.
    pub fn ranking(&self, words: &Vocabulary) -> String {
        FIRST_OF_ALL.to_owned() + &self.ranking.unwrap_or(by_size)(words)
    }

    fn screen(&self, catalogue: &'c Catalogue) -> Screen<'c> {
        let any = catalogue.motors.first().zip(self.motors.first());
        let screen = Screen::new(self.cycle, self.site, self.rules, &catalogue.gearboxes, any);
        screen.with_resistors(self.resistors)
    }

    fn judge(&mut self, screen: &Screen<'c>, drives: impl Iterator<Item = (DriveId, Drive<'c>)>) {
        drives.for_each(|(id, drive)| {
            let (unranked, outcome) = self.bound(screen, id, drive);
            let group = if outcome.fails() {
                &mut self.refused
            } else {
                &mut self.fit
            };
            group.add(unranked, &outcome);
        });
    }

    /// The sort key of a suitable drive; of a refused one a lower bound.
    fn bound(&self, screen: &Screen<'c>, id: DriveId, drive: Drive<'c>) -> (Order<'c>, Outcome) {
        let outcome = screen.judge(id, drive, &self.motors[id.motor()]);
        (Order::from(drive, &outcome, id), outcome)
    }

    fn join(mut self, other: Self) -> Self {
        self.fit.join(other.fit);
        self.refused.join(other.refused);
        self
    }

    fn in_order(mut self) -> Self {
        let mut groups =
            [&mut self.fit, &mut self.refused].map(|group| std::mem::replace(group, Group::none()));
        for group in &mut groups {
            group.rank(|drive| self.in_full(drive));
        }
        [self.fit, self.refused] = groups;
        self
    }

    /// Judges every drive in full and sorts all.
    pub fn complete(&mut self) {
        self.fit = self.completed(&self.fit);
        self.refused = self.completed(&self.refused);
    }

    fn completed(&self, group: &Group<'c>) -> Group<'c> {
        if group.rest.is_empty() {
            // Perhaps sorted differently.
            return group.clone();
        }
        let mut all = group.known().to_vec();
        all.extend(threads::map(&group.rest, |order| self.in_full(order)));
        threads::sort_by_key(&mut all, Order::of);
        Group::of(all)
    }

    fn in_full(&self, order: &Order<'c>) -> Candidate<'c> {
        let Order { drive, id, .. } = *order;
        let motor = &self.motors[id.motor()];
        Candidate {
            drive,
            motor,
            outcome: self.context_of(drive, motor).outcome(self.rules),
            id,
        }
    }

    /// The first `count` drives that fit, best first.
    pub fn first_fit(&self, count: usize) -> Vec<Candidate<'c>> {
        self.first(&self.fit, count)
    }

    /// The first suitable drive of each motor, with its rank among all suitable drives: the first `count`.
    pub fn first_of_motors(&self, count: usize) -> Vec<(usize, Candidate<'c>)> {
        let known = self.fit.known();
        let mut rest = self.fit.rest.clone();
        rest.sort_unstable();
        let known = known.iter().map(|drive| (drive.id, Ok(*drive)));
        let all = known.chain(rest.iter().map(|order| (order.id, Err(order))));
        let mut seen = HashSet::new();
        let first = (1..)
            .zip(all)
            .filter(|(_, (id, _))| seen.insert(id.motor()));
        let first = first.take(count);
        let first = first.map(|(rank, (_, drive))| {
            let drive = drive.unwrap_or_else(|order| self.in_full(order));
            (rank, drive)
        });
        first.collect()
    }

    /// The rules that refused drives violate, the most frequent first. As in the ranking, rules that follow time are judged only if all others are
    /// satisfied.
    pub fn violations(&self) -> Vec<Violation<'c>> {
        let all = self.first_refused(usize::MAX);
        let of = |rule: Rule| {
            let violate = all.iter().filter(|c| c.outcome.violated.has(rule));
            let alone = violate.clone().filter(|c| c.outcome.violated.count() == 1);
            Some(Violation {
                rule,
                count: violate.clone().count(),
                alone: alone.count(),
                closest: *violate.clone().next()?,
            })
        };
        let mut found: Vec<_> = Rule::ALL.into_iter().filter_map(of).collect();
        found.sort_by_key(|violation| std::cmp::Reverse(violation.count));
        found
    }

    /// The first `count` refused drives, those closest to their limits first.
    pub fn first_refused(&self, count: usize) -> Vec<Candidate<'c>> {
        self.first(&self.refused, count)
    }

    fn first(&self, group: &Group<'c>, count: usize) -> Vec<Candidate<'c>> {
        let count = count.min(group.len());
        let known = group.known();
        match known.get(..count) {
            Some(first) => first.to_vec(),
            None => self.completed(group).known()[..count].to_vec(),
        }
    }

    /// A fully evaluated drive of the selection; the first one if there are several.
    pub fn find(&self, wanted: impl Fn(&Drive<'c>) -> bool) -> Option<Candidate<'c>> {
        [&self.fit, &self.refused].into_iter().find_map(|group| {
            let known = group.known().iter().find(|c| wanted(&c.drive)).copied();
            known.or_else(|| {
                let found = group.rest.iter().filter(|order| wanted(&order.drive));
                let found = found.map(|order| self.in_full(order));
                found.min_by_key(Order::of)
            })
        })
    }

    /// The suitable drives of each certainty that occurs, in the order of the ranking (the most certain first).
    pub fn classes(&self) -> Vec<Class<'c>> {
        let mut rank = 1;
        let mut classes = Vec::new();
        for certainty in Certainty::ALL {
            let class = self.fit.survey().class(certainty);
            let known = self.fit.known().get(rank - 1).copied();
            let first = known.or_else(|| Some(self.in_full(&class.first?)));
            if let Some(first) = first.filter(|_| class.count > 0) {
                classes.push(Class {
                    certainty,
                    count: class.count,
                    rank,
                    first,
                });
            }
            rank += class.count;
        }
        classes
    }

    /// The rules that are not checked for some of the suitable drives.
    pub fn gaps(&self) -> Vec<Gap> {
        let gaps = self.fit.survey().gaps().filter_map(|(rule, gap)| {
            let example = gap.example?;
            let context = self.context_of(example.drive, &self.motors[example.id.motor()]);
            Some(Gap {
                rule,
                count: gap.count,
                example: context.check_of(self.rules, rule)?,
            })
        });
        gaps.collect()
    }

    /// The refused drive with the next smaller rated power below all suitable motors; if there are several, the one closest to its limits. `None` if
    /// no drive is suitable, or no power is smaller.
    pub fn next_smaller(&self) -> Option<Candidate<'c>> {
        let power = |drive: Drive<'c>| drive.motor.rated_power();
        let least = self.fit.drives().filter_map(power).reduce(f64::min)?;
        let smaller = self.refused.drives().filter_map(power);
        let next = smaller.filter(|power| *power < least).reduce(f64::max)?;
        // No suitable drive has this power.
        self.find(|drive| drive.motor.rated_power() == Some(next))
    }

    /// Number of suitable drives that are not fully checked.
    pub fn partly_checked(&self) -> usize {
        self.fit.survey().partly_checked()
    }

    /// A candidate checked against every rule.
    pub fn judged(&self, candidate: &Candidate<'c>) -> Assessment<'c> {
        Assessment::new(&self.context(candidate), self.rules)
    }

    /// The context for judging a candidate.
    pub fn context(&self, candidate: &Candidate<'c>) -> Context<'c> {
        self.context_of(candidate.drive, candidate.motor)
    }

    fn context_of(&self, drive: Drive<'c>, motor: &'c MotorLimits) -> Context<'c> {
        Context::new(self.cycle, self.site, drive, motor).with_resistors(self.resistors)
    }
}
