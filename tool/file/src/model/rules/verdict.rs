//! The finding of a rule, and its verdict.

use serde::Serialize;

/// A value and its rating, in the same unit (SI).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finding {
    /// The figure.
    pub value: f64,
    /// The rating; NaN without data.
    pub rating: f64,
}

impl Finding {
    /// A figure and its rating.
    pub const fn new(value: f64, rating: f64) -> Self {
        Self { value, rating }
    }

    /// A figure whose rating, if any, may be missing.
    pub fn against(value: f64, rating: Option<f64>) -> Self {
        Self::new(value, rating.unwrap_or(f64::NAN))
    }

    /// No data: neither value nor rating.
    pub const UNKNOWN: Self = Self::new(f64::NAN, f64::NAN);

    /// Whether both figure and rating are known. An infinite rating means no limit and is known.
    pub const fn is_known(&self) -> bool {
        !(self.value.is_nan() || self.rating.is_nan())
    }
}

/// Verdict of a rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[schemars(rename = "Verdict")]
pub enum RuleVerdict {
    /// Not checked by this rule set.
    Off,
    /// The rule is satisfied.
    Pass,
    /// The rule is satisfied, but its warning limit is exceeded.
    Warn,
    /// The catalogue lacks data that the rule needs.
    NotChecked,
    /// The rule is violated.
    Fail,
}

impl RuleVerdict {
    /// One word for tables.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Off => "off",
            Self::Pass => "ok",
            Self::Warn => "warning",
            Self::NotChecked => "not checked",
            Self::Fail => "FAIL",
        }
    }
}
