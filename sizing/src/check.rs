//! One sizing rule applied to one drive: figure, limit, verdict.

use serde::Serialize;

use crate::output::short;

/// How a rule came out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// The rule holds.
    Pass,
    /// The rule holds, but its warning limit is passed.
    Warn,
    /// The catalogue does not hold the figure that the rule needs.
    NotChecked,
    /// The rule is violated.
    Fail,
}

impl Verdict {
    /// One word for tables.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Pass => "ok",
            Self::Warn => "warning",
            Self::NotChecked => "not checked",
            Self::Fail => "FAIL",
        }
    }
}

/// A rule, what it judged, and how it came out.
#[derive(Clone, Debug, Serialize)]
pub struct Check {
    /// Name of the rule.
    pub rule: &'static str,
    /// The figure judged, in `unit`.
    pub value: f64,
    /// Its limit, in `unit`; `None` if the catalogue does not hold what it is made of.
    pub limit: Option<f64>,
    /// Unit of figure and limit.
    pub unit: &'static str,
    /// How it came out.
    pub verdict: Verdict,
    /// What the limit is made of, or what is missing.
    pub note: String,
}

impl Check {
    /// `value` must not be above `share` of `rating`.
    pub fn share(
        rule: &'static str,
        value: f64,
        rating: Option<f64>,
        share: f64,
        unit: &'static str,
        what: &str,
    ) -> Self {
        let Some(rating) = rating else {
            return Self {
                rule,
                value,
                limit: None,
                unit,
                verdict: Verdict::NotChecked,
                note: format!("the catalogue has no {what}"),
            };
        };
        Self {
            rule,
            value,
            limit: Some(share * rating),
            unit,
            verdict: if value <= share * rating {
                Verdict::Pass
            } else {
                Verdict::Fail
            },
            note: format!(
                "{:.0} % of {} {unit}, the {what}",
                share * 100.0,
                short(rating)
            ),
        }
    }

    /// The figure as a share of its limit; zero if there is no limit.
    pub fn use_of_limit(&self) -> f64 {
        match self.limit {
            Some(limit) if limit > 0.0 => self.value / limit,
            Some(_) if self.value > 0.0 => f64::INFINITY,
            _ => 0.0,
        }
    }

    /// Four digits and the unit.
    pub fn with_unit(&self, figure: f64) -> String {
        format!("{} {}", short(figure), self.unit)
            .trim_end()
            .to_owned()
    }

    /// How much of the limit is used, in words.
    pub fn used(&self) -> String {
        match self.use_of_limit() * 100.0 {
            _ if self.limit.is_none() => String::new(),
            percent if percent < 1000.0 => format!("{percent:.0} %"),
            _ => "> 1000 %".to_owned(),
        }
    }

    /// Figure, limit and what the limit is, as one sentence.
    pub fn sentence(&self) -> String {
        let value = self.with_unit(self.value);
        match self.limit {
            Some(limit) => format!(
                "{} {value} against {} ({})",
                self.rule,
                self.with_unit(limit),
                self.note
            ),
            None => format!("{} {value}: {}", self.rule, self.note),
        }
    }
}
