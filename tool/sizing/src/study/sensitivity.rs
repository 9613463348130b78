//! How the rules of a drive depend on the quantities of the machine file: the derivative of each use of a limit, and how far each quantity may change
//! until a rule is violated.
//!
//! Every number with a unit, and every plain number, is changed by a relative ε with all others fixed; the machine is read and judged again. The
//! derivative of a rule's share of its limit u is the central difference (u(ε) − u(−ε))/(2ε), extrapolated from ε and ε/2 to (4·D(ε/2) − D(ε))/3,
//! whose error grows with ε⁴. The difference of two such values is given as its uncertainty.
//!
//! A count, such as a number of teeth, is changed by one: its derivative is (u(n + 1) − u(n − 1))·n/2, its uncertainty half the difference of the two
//! steps. A quantity that is zero has no relative change, and some quantities cannot be changed alone (the moves of a cycle add up to whole turns).
//! These are listed with the reason.

use crate::judge::Findings;
use crate::judge::broken;
use crate::study::chosen::ChosenDrive;
use crate::study::common::Study;
use crate::study::edge::{Grid, Trial};
use crate::study::edit::Edit;
use crate::threads;
use jred_file::model::rule::Rule;
use jred_file::model::rules::{Limit, RuleSet};
use jred_file::text::problem::{Problem, Result};

/// One rule's dependence on one quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slope {
    /// The rule.
    pub rule: Rule,
    /// Whether it can refuse a drive, or only warns.
    pub refuses: bool,
    /// Change of its share of the limit per relative change of the quantity: du/dε.
    pub slope: f64,
    /// Difference of the two estimates of the slope.
    pub uncertainty: f64,
}

/// How far a quantity may change in one direction.
#[derive(Debug)]
pub enum Room {
    /// No violation within the search range: this relative change.
    AtLeast(f64),
    /// Up to this relative change; beyond it, the rule is violated.
    UpTo(f64, Rule),
    /// Up to this relative change; beyond it, the machine file is invalid for this reason.
    Refused(f64, Problem),
    /// A rule is already violated.
    Broken,
}

impl Room {
    /// The allowed relative change.
    pub const fn change(&self) -> f64 {
        match self {
            Self::AtLeast(change) | Self::UpTo(change, _) | Self::Refused(change, _) => *change,
            Self::Broken => 0.0,
        }
    }
}

/// Why a quantity is not varied.
#[derive(Debug)]
pub enum Fixed {
    /// Zero has no relative change.
    Zero,
    /// The machine file with a changed quantity is invalid.
    Refused(Problem),
    /// The machine file with a count one less is invalid.
    OneLess(Problem),
    /// The machine file with a count one more is invalid.
    OneMore(Problem),
}

/// Dependence on one quantity.
#[derive(Debug)]
pub struct Dependence {
    /// Index of the quantity in the document.
    pub quantity: usize,
    /// Whether it is a count, which is changed by one.
    pub whole: bool,
    /// The slopes of the rules that can be checked.
    pub slopes: Vec<Slope>,
    /// Room to smaller and to larger values.
    pub room: [Room; 2],
}

impl Dependence {
    /// Whether it affects no rule, and no rule limits its change.
    pub fn is_idle(&self) -> bool {
        let still = self.slopes.iter().all(|slope| slope.slope == 0.0);
        still
            && self
                .room
                .iter()
                .all(|room| matches!(room, Room::AtLeast(_) | Room::Broken))
    }

    /// The rule that depends on it most: of the rules that can refuse the drive, or else of those that only warn.
    pub fn steepest(&self) -> Option<Slope> {
        let slopes = self.slopes.iter().copied();
        let key = |slope: &Slope| (slope.refuses && slope.slope != 0.0, slope.slope.abs());
        slopes.max_by(|a, b| {
            let (a, b) = (key(a), key(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        })
    }
}

/// Result of a sensitivity analysis.
#[derive(Debug)]
pub struct Sensitivity {
    /// The original shares of the limits.
    pub shares: Vec<(Rule, f64)>,
    /// By quantity; the one that affects a rule most comes first.
    pub dependences: Vec<Dependence>,
    /// Quantities that were not changed, and why.
    pub fixed: Vec<(usize, Fixed)>,
    /// Number of quantities in `[simulation]` and `[tolerance]`, which are omitted because no rule depends on them.
    pub left_out: usize,
}

/// Settings of a sensitivity analysis.
#[derive(Clone, Copy, Debug)]
pub struct Reach {
    /// Relative change of the differences.
    pub change: f64,
    /// Largest relative change in the search for the first violation.
    pub most: f64,
}

/// Share of the limit (or of the warning limit, if there is no other) of every rule that has a limit and can be checked, except where the limit is
/// zero.
pub fn shares(rules: &RuleSet, findings: &Findings) -> Vec<(Rule, f64)> {
    let known = findings
        .iter()
        .filter(|(rule, finding)| finding.is_known() && rules.limit(*rule) != Limit::default());
    let used = known.map(|(rule, finding)| (rule, rules.use_shown(rule, finding)));
    used.filter(|(_, used)| used.is_finite()).collect()
}

/// A quantity of a study, to be changed.
struct Mover<'a> {
    study: &'a Study,
    one: &'a ChosenDrive,
    quantity: usize,
    number: f64,
    unit: &'a str,
    /// The largest share of a limit for the original file.
    load: f64,
}

/// A drive in a machine with one quantity changed.
struct LimitUse {
    /// Shares of the limits.
    shares: Vec<(Rule, f64)>,
    /// The violated rule.
    broken: Option<Rule>,
    /// The largest share of a limit that can refuse the drive; above one it is refused.
    load: f64,
}

impl Room {
    /// The room up to a change, from the drive after a larger one.
    fn before(held: f64, stopped: Result<LimitUse>) -> Self {
        match stopped {
            Ok(LimitUse {
                broken: Some(rule), ..
            }) => Self::UpTo(held, rule),
            Err(why) => Self::Refused(held, why),
            Ok(LimitUse { broken: None, .. }) => Self::AtLeast(held),
        }
    }
}

fn of_rule(all: &[(Rule, f64)], rule: Rule) -> Option<f64> {
    Some(all.iter().find(|(other, _)| *other == rule)?.1)
}

impl Mover<'_> {
    /// The drive after a relative change of the quantity.
    fn at(&self, change: f64) -> Result<LimitUse> {
        let number = self.number * (1.0 + change);
        // A count changed by its own step is whole except for rounding.
        let whole = number.round();
        let edit = Edit {
            quantity: self.quantity,
            number: if (number - whole).abs() <= 1e-9 * whole.abs() {
                whole
            } else {
                number
            },
            unit: self.unit,
        };
        let machine = self.study.machine(&[edit])?;
        let findings = self.one.findings(&machine);
        let rules = &machine.file.rules;
        Ok(LimitUse {
            shares: shares(rules, &findings),
            broken: broken(rules, &findings),
            load: load(rules, &findings),
        })
    }

    /// The slopes for `change`, and the drive at both ends, downwards and upwards.
    fn slopes(&self, change: f64) -> Result<(Vec<Slope>, [LimitUse; 2])> {
        // Upwards first: if both ends are refused, its reason is given.
        let ends = |step: f64| -> Result<[LimitUse; 2]> {
            let above = self.at(step)?;
            Ok([self.at(-step)?, above])
        };
        let outer = ends(change)?;
        let coarse = differences(&outer, change);
        let [half, quarter] = [0.5 * change, 0.25 * change];
        let middle = differences(&ends(half)?, half);
        let fine = differences(&ends(quarter)?, quarter);
        let slope = |(rule, fine): &(Rule, f64)| {
            let (coarse, middle) = (of_rule(&coarse, *rule)?, of_rule(&middle, *rule)?);
            let extrapolated = |d: f64, half: f64| (4.0 * half - d) / 3.0;
            let (first, second) = (extrapolated(coarse, middle), extrapolated(middle, *fine));
            Some(Slope {
                rule: *rule,
                refuses: self.study.nominal.rules.limit(*rule).fail.is_some(),
                slope: second,
                uncertainty: (second - first).abs(),
            })
        };
        Ok((fine.iter().filter_map(slope).collect(), outer))
    }

    /// The dependence on the quantity: by a small relative change; for a count, where that is impossible, by one.
    fn dependence(&self, reach: Reach, holds: bool) -> Result<Dependence, Fixed> {
        let dependence = |whole: bool, slopes: Vec<Slope>, room: [Room; 2]| Dependence {
            quantity: self.quantity,
            whole,
            slopes,
            room,
        };
        let broken = [Room::Broken, Room::Broken];
        match self.slopes(reach.change) {
            Ok((slopes, _)) if !holds => Ok(dependence(false, slopes, broken)),
            Ok((slopes, [below, above])) => {
                let room = [self.room(-1.0, reach, below), self.room(1.0, reach, above)];
                Ok(dependence(false, slopes, room))
            }
            Err(_) if self.counts() => {
                let slopes = self.slopes_by_one()?;
                let room = if holds {
                    [-1.0, 1.0].map(|sign| self.room_by_one(sign, reach))
                } else {
                    broken
                };
                Ok(dependence(true, slopes, room))
            }
            Err(why) => Err(Fixed::Refused(why)),
        }
    }

    /// Whether it is a count, and not an entry of a list that refers to something by its number.
    fn counts(&self) -> bool {
        let quantity = self.study.document.quantities().get(self.quantity);
        quantity.is_some_and(|quantity| {
            let last = quantity.path.rsplit('.').next().unwrap_or_default();
            quantity.is_whole() && self.number >= 1.0 && last.parse::<f64>().is_err()
        })
    }

    /// The drive with the count increased by `by`.
    fn more(&self, by: f64) -> Result<LimitUse> {
        self.at(by / self.number)
    }

    fn slopes_by_one(&self) -> Result<Vec<Slope>, Fixed> {
        let below = self.more(-1.0).map_err(Fixed::OneLess)?;
        let same = self.more(0.0).map_err(Fixed::Refused)?;
        let above = self.more(1.0).map_err(Fixed::OneMore)?;
        let slope = |(rule, above): &(Rule, f64)| {
            let [below, same] = [
                of_rule(&below.shares, *rule)?,
                of_rule(&same.shares, *rule)?,
            ];
            Some(Slope {
                rule: *rule,
                refuses: self.study.nominal.rules.limit(*rule).fail.is_some(),
                slope: 0.5 * self.number * (above - below),
                uncertainty: 0.5 * self.number * (above - 2.0 * same + below).abs(),
            })
        };
        Ok(above.shares.iter().filter_map(slope).collect())
    }

    /// Room of a count in the direction of `sign`: by doubling steps, then by bisection of the last.
    fn room_by_one(&self, sign: f64, reach: Reach) -> Room {
        let share = |by: f64| sign * by / self.number;
        let most = (reach.most * self.number).floor().max(1.0);
        let most = if sign < 0.0 {
            most.min(self.number - 1.0)
        } else {
            most
        };
        let holds = |tried: &Result<LimitUse>| matches!(tried, Ok(LimitUse { broken: None, .. }));
        let (mut held, mut step) = (0.0, 1.0f64);
        let mut stopped = loop {
            let by = step.min(most);
            if held >= most {
                return Room::AtLeast(share(held));
            }
            let tried = self.more(sign * by);
            if !holds(&tried) {
                break (by, tried);
            }
            (held, step) = (by, 2.0 * step);
        };
        while stopped.0 - held > 1.0 {
            let by = (0.5 * (held + stopped.0)).floor();
            let tried = self.more(sign * by);
            if holds(&tried) {
                held = by;
            } else {
                stopped = (by, tried);
            }
        }
        Room::before(share(held), stopped.1)
    }

    /// Room of the quantity in the direction of `sign`, by doubling steps, then on a [`Grid`] of the last one; `first` is the drive after the first
    /// step.
    fn room(&self, sign: f64, reach: Reach, first: LimitUse) -> Room {
        let (mut held, mut tried) = ((0.0, self.load), reach.change);
        let mut there = Ok(first);
        let stopped = loop {
            match there {
                Ok(LimitUse {
                    broken: None, load, ..
                }) => held = (tried, load),
                stopped => break stopped,
            }
            if tried >= reach.most {
                return Room::AtLeast(sign * tried);
            }
            tried = (2.0 * tried).min(reach.most);
            there = self.at(sign * tried);
        };
        let trial = |what: Result<LimitUse>| Trial {
            holds: matches!(what, Ok(LimitUse { broken: None, .. })),
            // Without a file there is no share: the step is halved.
            height: what.as_ref().map_or(f64::NAN, |judged| judged.load - 1.0),
            what,
        };
        let grid = Grid {
            from: held.0,
            to: tried,
        };
        let at = |change: f64| trial(self.at(sign * change));
        let (held, stopped) = grid.last_held(held.1 - 1.0, trial(stopped), at);
        Room::before(sign * held, stopped)
    }
}

/// The largest share of a limit that can refuse a drive.
fn load(rules: &RuleSet, findings: &Findings) -> f64 {
    let uses = findings
        .iter()
        .map(|(rule, finding)| rules.use_of_limit(rule, finding));
    uses.fold(0.0, f64::max)
}

/// (u(ε) − u(−ε))/(2ε) of every rule.
fn differences([below, above]: &[LimitUse; 2], change: f64) -> Vec<(Rule, f64)> {
    let pairs = above.shares.iter().filter_map(|(rule, above)| {
        let below = of_rule(&below.shares, *rule)?;
        Some((*rule, (above - below) / (2.0 * change)))
    });
    pairs.collect()
}

impl Sensitivity {
    /// Changes every quantity of the study's machine file; `progress` is called for each.
    ///
    /// # Errors
    /// The original machine is refused.
    pub fn new(
        study: &Study,
        one: &ChosenDrive,
        reach: Reach,
        progress: impl Fn() + Sync,
    ) -> Result<Self> {
        let machine = study.machine(&[])?;
        let findings = one.findings(&machine);
        let rules = &machine.file.rules;
        let holds = broken(rules, &findings).is_none();
        let load = load(rules, &findings);
        // The free motion of `[simulation]` and the scatter of `[tolerance]` do not affect sizing.
        let apart = |path: &str| {
            ["simulation.", "tolerance."]
                .iter()
                .any(|at| path.starts_with(at))
        };
        let quantities = study.document.quantities().iter().enumerate();
        let quantities: Vec<_> = quantities.filter(|(_, q)| !apart(&q.path)).collect();
        let left_out = study.document.quantities().len() - quantities.len();
        let found: Vec<(usize, Result<Dependence, Fixed>)> =
            threads::map(&quantities, |&(index, quantity)| {
                let mover = Mover {
                    study,
                    one,
                    quantity: index,
                    number: quantity.number(),
                    unit: quantity.unit(),
                    load,
                };
                let dependence = if quantity.number() == 0.0 {
                    Err(Fixed::Zero)
                } else {
                    mover.dependence(reach, holds)
                };
                progress();
                (index, dependence)
            });
        let (mut dependences, mut fixed) = (Vec::new(), Vec::new());
        for (index, dependence) in found {
            match dependence {
                Ok(dependence) => dependences.push(dependence),
                Err(why) => fixed.push((index, why)),
            }
        }
        let steepest = |d: &Dependence| d.steepest().map_or(0.0, |slope| slope.slope.abs());
        dependences.sort_by(|a, b| steepest(b).total_cmp(&steepest(a)));
        Ok(Self {
            shares: shares(rules, &findings),
            dependences,
            fixed,
            left_out,
        })
    }

    /// Whether the original drive already violates a rule, so that there is no room.
    pub fn is_broken(&self) -> bool {
        let mut all = self.dependences.iter();
        all.any(|d| matches!(d.room, [Room::Broken, _] | [_, Room::Broken]))
    }

    /// The quantity with the smallest change that violates a rule, and its room.
    pub fn first_to_break(&self) -> Option<(usize, &Room)> {
        let rooms = self
            .dependences
            .iter()
            .flat_map(|d| d.room.iter().map(|room| (d.quantity, room)));
        let breaking = rooms.filter(|(_, room)| matches!(room, Room::UpTo(..)));
        breaking.min_by(|a, b| a.1.change().abs().total_cmp(&b.1.change().abs()))
    }
}
