//! Changes to a rule set: by a set based on another one, or by a machine file.

use std::fmt;
use std::ops::Range;

use crate::model::rule::{Rule, Sense};

use super::{InertiaOf, Limit, MeanTorque, Moves, RuleSet};

/// The change.
#[derive(Clone, Debug, PartialEq)]
pub enum RuleSetting {
    /// The limit beyond which the rule is violated.
    Fail(Rule, f64),
    /// The limit beyond which a warning is given.
    Warn(Rule, f64),
    /// The rule is not checked.
    Off(Rule),
    /// Both limits together, so that no limit of the base set remains.
    Both(Rule, Limit),
    /// The choice of λ to check.
    InertiaOf(InertiaOf),
    /// Limits of λ by moves per minute.
    InertiaByMoves(Vec<Moves>),
    /// Exponent of the mean torque of a gearbox.
    MeanTorque(MeanTorque),
}

impl RuleSetting {
    /// The rule that it changes.
    pub const fn rule(&self) -> Rule {
        match self {
            Self::Fail(rule, _) | Self::Warn(rule, _) | Self::Off(rule) | Self::Both(rule, _) => {
                *rule
            }
            Self::InertiaOf(_) | Self::InertiaByMoves(_) => Rule::InertiaRatio,
            Self::MeanTorque(_) => Rule::GearboxCubicMean,
        }
    }
}

/// One change, with its source and its position in the text.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// The change.
    pub what: RuleSetting,
    /// Source.
    pub source: String,
    /// Position in the text.
    pub place: Range<usize>,
}

/// Changes in the order of the text.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Changes(pub Vec<Change>);

/// Two contradictory limits.
#[derive(Clone, Debug, PartialEq)]
pub struct Contradiction {
    /// Message.
    pub message: String,
    /// Cure.
    pub help: String,
    /// The changes that contradict each other.
    pub places: Vec<Range<usize>>,
}

impl fmt::Display for Contradiction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}; {}", self.message, self.help)
    }
}

impl Changes {
    fn places(&self, rule: Rule) -> Vec<Range<usize>> {
        let own = self.0.iter().filter(|change| change.what.rule() == rule);
        own.map(|change| change.place.clone()).collect()
    }
}

impl RuleSet {
    /// This set with changes.
    ///
    /// # Errors
    /// A rule is off and has a limit, or its warning lies beyond its limit.
    pub fn with(mut self, changes: &Changes) -> Result<Self, Contradiction> {
        for Change { what, source, .. } in &changes.0 {
            let index = what.rule() as usize;
            match what {
                RuleSetting::InertiaOf(of) => {
                    self.choices.inertia_ratio_of = *of;
                    continue;
                }
                RuleSetting::MeanTorque(exponent) => {
                    self.choices.gearbox_mean_exponent = *exponent;
                    continue;
                }
                RuleSetting::Fail(_, share) => self.limits[index].fail = Some(*share),
                RuleSetting::Warn(_, share) => self.limits[index].warn = Some(*share),
                RuleSetting::Both(_, limit) => self.limits[index] = *limit,
                RuleSetting::Off(_) => self.limits[index] = Limit::default(),
                RuleSetting::InertiaByMoves(bands) => {
                    self.choices.inertia_ratio_by_moves.clone_from(bands);
                    self.limits[index] = Limit {
                        fail: Some(1.0),
                        warn: None,
                    };
                }
            }
            self.off[index] = matches!(what, RuleSetting::Off(_));
            self.sources[index].clone_from(source);
            if matches!(
                what,
                RuleSetting::Fail(Rule::InertiaRatio, _) | RuleSetting::Both(Rule::InertiaRatio, _)
            ) {
                self.choices.inertia_ratio_by_moves.clear();
            }
        }
        self.check(changes)?;
        Ok(self)
    }

    /// This set with the changes of a machine file, which are kept for [`Self::based_on`].
    ///
    /// # Errors
    /// As [`Self::with`].
    pub fn with_own(self, changes: Changes) -> Result<Self, Contradiction> {
        let mut set = self.with(&changes)?;
        set.own = changes;
        Ok(set)
    }

    /// Another set with the changes of the machine file to this one.
    ///
    /// # Errors
    /// As [`Self::with`].
    pub fn based_on(&self, other: Self) -> Result<Self, Contradiction> {
        other.with_own(self.own.clone())
    }

    /// Whether the machine file changes the set.
    pub const fn is_changed(&self) -> bool {
        !self.own.0.is_empty()
    }

    fn check(&self, changes: &Changes) -> Result<(), Contradiction> {
        for rule in Rule::ALL {
            let (key, warning) = (rule.key(), rule.warning_key());
            let limited = |what: &RuleSetting| {
                matches!(
                    what,
                    RuleSetting::Fail(..) | RuleSetting::Warn(..) | RuleSetting::Both(..)
                )
            };
            let own = || changes.0.iter().filter(|change| change.what.rule() == rule);
            let fault = |message: String, help: String| Contradiction {
                message,
                help,
                places: changes.places(rule),
            };
            let off = own().any(|change| matches!(change.what, RuleSetting::Off(_)));
            if off && own().any(|change| limited(&change.what)) {
                return Err(fault(
                    format!("`{key}` is \"off\", but the rule also has a limit"),
                    "a rule that is off has no limit and no warning: remove one of the two"
                        .to_owned(),
                ));
            }
            let by_moves =
                rule == Rule::InertiaRatio && !self.choices.inertia_ratio_by_moves.is_empty();
            let Limit { fail, warn } = self.limit(rule);
            if by_moves && warn.is_some() {
                return Err(fault(
                    format!(
                        "`{warning}` is given, but the limits of the set depend on the moves per minute"
                    ),
                    format!("also give `{key}`: it replaces the limits by moves per minute"),
                ));
            }
            let (Some(fail), Some(warn)) = (fail, warn) else {
                continue;
            };
            let (late, side) = match rule.sense() {
                Sense::AtMost => (warn > fail, "above"),
                Sense::AtLeast => (warn < fail, "below"),
            };
            if late {
                return Err(fault(
                    format!(
                        "`{warning}` is {}, {side} `{key}`, which is {}",
                        shown(rule, warn),
                        shown(rule, fail)
                    ),
                    format!(
                        "the warning must be reached before the limit: give both, such as {key} = {}",
                        example(rule)
                    ),
                ));
            }
        }
        Ok(())
    }
}

/// A limit as machine files write it.
pub fn shown(rule: Rule, share: f64) -> String {
    if rule.is_ratio() {
        crate::number::rounding::figure(share)
    } else {
        format!("{} %", crate::number::rounding::figure(share * 100.0))
    }
}

fn example(rule: Rule) -> String {
    let warning = rule.warning_key();
    match rule {
        Rule::InertiaRatio => format!("10 and {warning} = 5"),
        Rule::NaturalFrequency => format!("5 and {warning} = 10"),
        Rule::BrakeResistance => format!("\"100 %\" and {warning} = \"110 %\""),
        _ => format!("\"90 %\" and {warning} = \"80 %\""),
    }
}
