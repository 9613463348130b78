//! One quantity of the machine file, changed, with the drive judged again.

use super::{Dependence, Fixed, Reach, Room, Slope, shares};
use crate::judge::{Findings, broken};
use crate::study::chosen::ChosenDrive;
use crate::study::common::Study;
use crate::study::edge::{Grid, Trial};
use crate::study::edit::Edit;
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleSet;
use jred_file::text::problem::Result;

/// A quantity of a study, to be changed.
pub(super) struct Mover<'a> {
    pub(super) study: &'a Study,
    pub(super) one: &'a ChosenDrive,
    pub(super) quantity: usize,
    pub(super) number: f64,
    pub(super) unit: &'a str,
    /// The largest share of a limit for the original file.
    pub(super) load: f64,
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
    pub(super) fn dependence(&self, reach: Reach, holds: bool) -> Result<Dependence, Fixed> {
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
pub(super) fn load(rules: &RuleSet, findings: &Findings) -> f64 {
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
