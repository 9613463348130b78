//! One sizing rule applied to one drive: figure, limit, verdict.

use serde::Serialize;

use crate::judge::Words;
use jred_file::model::rule::{Rule, Sense};
use jred_file::model::rules::{Finding, RuleSet, RuleVerdict};
use jred_file::number::rounding::{cleared, short, told_apart};

/// A rule with its value, limit and verdict.
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
pub struct Check {
    /// Name of the rule.
    pub rule: &'static str,
    /// The rule.
    pub id: Rule,
    /// The value, in `unit`; `None` if unknown.
    pub value: Option<f64>,
    /// Its limit, in `unit`; `None` without data in the catalogue.
    pub limit: Option<f64>,
    /// Unit of figure and limit.
    pub unit: &'static str,
    /// The used share of the limit; zero without a limit, infinite for a limit of zero. JSON has it as the margin.
    #[serde(skip)]
    pub used: f64,
    /// Margin as a share of the limit; `None` without a limit, or for a yes-or-no rule.
    pub margin: Option<f64>,
    /// Verdict.
    pub verdict: RuleVerdict,
    /// How the limit is computed, or the missing data.
    pub note: String,
    /// Source of the limit.
    pub source: String,
}

impl Check {
    /// Describes a finding under a rule set.
    pub fn new(rules: &RuleSet, rule: Rule, finding: Finding, words: Words) -> Self {
        let verdict = rules.verdict(rule, finding);
        let limit = rules.limit(rule);
        let Words {
            unit,
            scale,
            rating,
            place,
        } = words;
        let share = limit.fail.or(limit.warn);
        let used = rules.use_shown(rule, finding);
        let shown = |x: f64| x / scale;
        let bound = share.map(|share| share * finding.rating);
        let bound = bound.filter(|bound| finding.is_known() && bound.is_finite());
        let mut note = match share {
            None if rules.is_off(rule) => "switched off".to_owned(),
            _ if !finding.is_known() => format!("no data: {rating}"),
            None => "no limit given".to_owned(),
            Some(_) if !finding.rating.is_finite() => format!("no limit: {rating}"),
            Some(share) if unit.is_empty() => {
                format!("{} {rating}", short(share * shown(finding.rating)))
            }
            Some(share) if unit == "%" => {
                format!("{} % of the {rating}", short(share * shown(finding.rating)))
            }
            Some(share) => {
                let share = if rule.is_ratio() {
                    format!("{} times", short(share))
                } else {
                    format!("{:.0} % of", share * 100.0)
                };
                let shown = short(shown(finding.rating));
                format!("{share} {shown} {unit}, the {rating}")
            }
        };
        if verdict == RuleVerdict::Warn
            && let Some(warn) = limit.warn.filter(|_| limit.fail.is_some())
        {
            let beyond = match rule.sense() {
                Sense::AtMost => "above",
                Sense::AtLeast => "below",
            };
            let warn = short(shown(warn * finding.rating));
            note += format!("; warning {beyond} {warn} {unit}").trim_end();
        }
        if !place.is_empty() {
            note += ", ";
            note += &place;
        }
        let margin = bound.is_some() && used.is_finite() && !rule.is_yes_or_no();
        Self {
            rule: rule.name(),
            id: rule,
            value: Some(shown(finding.value)).filter(|v| v.is_finite()),
            limit: bound.map(shown),
            unit,
            used,
            margin: margin.then_some(match verdict {
                RuleVerdict::Fail => 1.0 - used,
                _ => cleared(1.0 - used, 1.0),
            }),
            verdict,
            note,
            source: rules.source(rule).to_owned(),
        }
    }

    fn with_unit(&self, figure: &str) -> String {
        format!("{figure} {}", self.unit).trim_end().to_owned()
    }

    /// Figure and limit with four digits; with more digits where those would not show that the limit is exceeded.
    fn figures(&self) -> Option<[String; 2]> {
        let pair = [self.value?, self.limit?];
        Some(if self.verdict == RuleVerdict::Fail {
            told_apart(pair)
        } else {
            pair.map(short)
        })
    }

    /// Use of the limit as text.
    pub fn used(&self) -> String {
        match self.used * 100.0 {
            _ if self.limit.is_none() || self.id.is_yes_or_no() => String::new(),
            percent if self.verdict == RuleVerdict::Fail && percent > 100.0 && percent < 100.5 => {
                "> 100 %".to_owned()
            }
            percent if percent <= 1000.0 => format!("{percent:.0} %"),
            _ => "> 1000 %".to_owned(),
        }
    }

    /// The figure with its unit, or a dash.
    pub fn figure(&self) -> String {
        let text = match self.figures() {
            Some([value, _]) => Some(value),
            None => self.value.map(short),
        };
        text.map_or("–".to_owned(), |text| self.with_unit(&text))
    }

    /// Its limit with its unit; `None` without a limit.
    pub fn bound(&self) -> Option<String> {
        let text = match self.figures() {
            Some([_, limit]) => limit,
            None => short(self.limit?),
        };
        Some(self.with_unit(&text))
    }

    /// Figure and limit: "4219 rpm, limit 4500 rpm".
    pub fn against(&self) -> String {
        let bound = self.bound();
        let limit = bound.map_or_else(String::new, |limit| format!(", limit {limit}"));
        format!("{}{limit}", self.figure())
    }

    /// Figure, limit and the limit's description, as one sentence.
    pub fn sentence(&self) -> String {
        let against = format!("{} {}", self.rule, self.against());
        if self.limit.is_some() {
            format!("{against} ({})", self.note)
        } else {
            format!("{against}: {}", self.note)
        }
    }
}
