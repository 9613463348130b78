//! Sizing: every drive of a catalogue, judged and ranked.

use std::cmp::Ordering;

use rayon::prelude::*;

use crate::catalogue::{Catalogue, Prepared};
use crate::check::Verdict;
use crate::cycle::Cycle;
use crate::drive::{Drive, Judged};
use crate::judge::{Context, Outcome};
use crate::rules::RuleSet;
use crate::site::Site;

/// How drives are ranked, in words for reports.
pub const RANKING: &str = "drives that break no rule, the smallest motor first (rated torque times rated speed), \
     among equal motors without warnings first, then by the largest share of a limit used";

/// How many of the refused drives are put in order, those that miss by least: [`Selection::refused`].
pub const NEAREST: usize = 64;

/// Motors whose drives a thread takes at a time.
const SHARE: usize = 16;

/// A drive and how it came out, in numbers: small enough (48 bytes) to keep every one of a large catalogue.
#[derive(Clone, Copy, Debug)]
pub struct Candidate<'c> {
    /// The drive.
    pub drive: Drive<'c>,
    /// What is known of its motor's limits.
    pub motor: &'c Prepared,
    /// How it came out.
    pub outcome: Outcome,
}

/// All drives, judged.
#[derive(Clone, Debug)]
pub struct Selection<'c> {
    /// The prepared duty.
    pub cycle: &'c Cycle,
    /// Where the drives are to stand.
    pub site: &'c Site,
    /// The rules they were judged by.
    pub rules: &'c RuleSet,
    /// How the drives that fit are ranked, in words; [`RANKING`] unless something else was asked for.
    pub ranking: &'static str,
    /// Drives that hold every rule, best first; see [`RANKING`].
    pub fit: Vec<Candidate<'c>>,
    /// Drives that break a rule. The first [`NEAREST`] are those that miss by least, in this order; the others follow in the
    /// order of the catalogue: of a large one nearly all are refused, and sorting them would take as long as judging them.
    /// [`Selection::refused_in_order`] has them all in order.
    pub refused: Vec<Candidate<'c>>,
}

impl<'c> Selection<'c> {
    /// Judges every drive of the catalogue on this thread. The time for a drive does not depend on the number of the cycle's
    /// instants, but for rules that follow time: docs/performance.md.
    pub fn new(
        catalogue: &'c Catalogue,
        motors: &'c [Prepared],
        cycle: &'c Cycle,
        site: &'c Site,
        rules: &'c RuleSet,
    ) -> Self {
        Self::among(catalogue.drives(), motors, cycle, site, rules)
    }

    /// Judges these drives only, each with the index of its motor's limits in `motors`.
    pub fn among(
        drives: impl Iterator<Item = (usize, Drive<'c>)>,
        motors: &'c [Prepared],
        cycle: &'c Cycle,
        site: &'c Site,
        rules: &'c RuleSet,
    ) -> Self {
        Self::judge(drives, motors, cycle, site, rules).in_order()
    }

    /// The same as [`Selection::new`] on all cores: the same drives in the same order.
    pub fn parallel(
        catalogue: &'c Catalogue,
        motors: &'c [Prepared],
        cycle: &'c Cycle,
        site: &'c Site,
        rules: &'c RuleSet,
    ) -> Self {
        let count = catalogue.motors.len();
        let parts: Vec<Self> = (0..count.div_ceil(SHARE))
            .into_par_iter()
            .map(|part| {
                let drives = catalogue.drives_of(part * SHARE..((part + 1) * SHARE).min(count));
                Self::judge(drives, motors, cycle, site, rules)
            })
            .collect();
        let mut selection = Self::empty(cycle, site, rules);
        for part in parts {
            selection.fit.extend(part.fit);
            selection.refused.extend(part.refused);
        }
        selection.in_order()
    }

    fn judge(
        drives: impl Iterator<Item = (usize, Drive<'c>)>,
        motors: &'c [Prepared],
        cycle: &'c Cycle,
        site: &'c Site,
        rules: &'c RuleSet,
    ) -> Self {
        let mut selection = Self::empty(cycle, site, rules);
        for (index, drive) in drives {
            let motor = &motors[index];
            let outcome = Context::new(cycle, site, drive, motor).outcome(rules);
            let candidate = Candidate {
                drive,
                motor,
                outcome,
            };
            if outcome.verdict == Verdict::Fail {
                selection.refused.push(candidate);
            } else {
                selection.fit.push(candidate);
            }
        }
        selection
    }

    const fn empty(cycle: &'c Cycle, site: &'c Site, rules: &'c RuleSet) -> Self {
        Self {
            cycle,
            site,
            rules,
            ranking: RANKING,
            fit: Vec::new(),
            refused: Vec::new(),
        }
    }

    /// Puts those that fit and the nearest of those refused in order. Equal ones stay in the order of the catalogue, so that the
    /// result does not depend on how the work was shared out.
    fn in_order(mut self) -> Self {
        let power = |c: &Candidate| c.drive.motor.rated_power().unwrap_or(f64::INFINITY);
        let of_fit = |c: &Candidate| {
            (
                power(c),
                u8::from(c.outcome.warnings > 0),
                c.outcome.worst_use,
            )
        };
        let fit = Places::of(&self.fit, of_fit);
        self.fit = fit.sorted().map(|k| self.fit[k]).collect();
        let mut refused = Places::of(&self.refused, missed);
        if refused.0.len() > NEAREST {
            refused.0.select_nth_unstable_by(NEAREST, Place::order);
            refused.0[..NEAREST].sort_unstable_by(Place::order);
            // The rest as they were.
            refused.0[NEAREST..].sort_unstable_by_key(|place| place.index);
            self.refused = refused.indices().map(|k| self.refused[k]).collect();
        } else {
            self.refused = refused.sorted().map(|k| self.refused[k]).collect();
        }
        self
    }

    /// All drives that break a rule, those that miss by least first.
    pub fn refused_in_order(&self) -> Vec<Candidate<'c>> {
        let sorted = Places::of(&self.refused, missed).sorted();
        sorted.map(|k| self.refused[k]).collect()
    }

    /// A candidate by every rule, in words.
    pub fn judged(&self, candidate: &Candidate<'c>) -> Judged<'c> {
        let context = Context::new(self.cycle, self.site, candidate.drive, candidate.motor);
        Judged::new(&context, self.rules)
    }

    /// How many of the drives that fit have a rule that could not be checked.
    pub fn partly_checked(&self) -> usize {
        let open = |c: &&Candidate| c.outcome.not_checked > 0;
        self.fit.iter().filter(open).count()
    }
}

/// By how much a drive misses: rules whose limit is zero first, then the largest share.
fn missed(candidate: &Candidate) -> (f64, u8, f64) {
    let outcome = &candidate.outcome;
    (f64::from(outcome.beyond_all_limits), 0, outcome.worst_use)
}

/// Where a candidate is, and what it is sorted by: smaller than the candidate itself.
struct Place {
    key: (f64, u8, f64),
    index: usize,
}

impl Place {
    fn order(a: &Self, b: &Self) -> Ordering {
        (a.key.0.total_cmp(&b.key.0))
            .then_with(|| a.key.1.cmp(&b.key.1))
            .then_with(|| a.key.2.total_cmp(&b.key.2))
            .then_with(|| a.index.cmp(&b.index))
    }
}

struct Places(Vec<Place>);

impl Places {
    fn of(candidates: &[Candidate], key: impl Fn(&Candidate) -> (f64, u8, f64)) -> Self {
        let place = |(index, candidate)| Place {
            key: key(candidate),
            index,
        };
        Self(candidates.iter().enumerate().map(place).collect())
    }

    fn sorted(mut self) -> impl Iterator<Item = usize> {
        self.0.sort_unstable_by(Place::order);
        self.indices()
    }

    fn indices(self) -> impl Iterator<Item = usize> {
        self.0.into_iter().map(|place| place.index)
    }
}
