//! Choices between values that a rule may check.

use serde::Serialize;

use crate::number::figures::Figures;

/// The λ of the cycle that is checked. With J(φ) the inertia ratio is a curve.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum InertiaOf {
    /// The smallest.
    Min,
    /// The mean over time.
    Mean,
    /// The root mean square over time.
    Rms,
    /// The largest.
    #[default]
    Max,
}

impl InertiaOf {
    /// Words for machine files.
    pub const WORDS: [&'static str; 4] = ["max", "mean", "rms", "min"];

    /// The choice for a word.
    pub fn of(word: &str) -> Option<Self> {
        match word {
            "max" => Some(Self::Max),
            "mean" => Some(Self::Mean),
            "rms" => Some(Self::Rms),
            "min" => Some(Self::Min),
            _ => None,
        }
    }

    /// The figure chosen.
    pub const fn pick(self, figures: &Figures) -> f64 {
        match self {
            Self::Min => figures.min,
            Self::Mean => figures.mean,
            Self::Rms => figures.rms,
            Self::Max => figures.max,
        }
    }

    /// Description for reports.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Min => "checked at the smallest λ over the cycle",
            Self::Mean => "checked at the mean λ over the cycle",
            Self::Rms => "checked at the RMS of λ over the cycle",
            Self::Max => "checked at the largest λ over the cycle",
        }
    }
}

/// Exponent of the mean torque of a gearbox.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, schemars::JsonSchema)]
pub enum MeanTorque {
    /// 3: gears.
    #[default]
    #[serde(rename = "3")]
    Cubic,
    /// 10/3: roller bearings.
    #[serde(rename = "10/3")]
    RollerBearing,
}

impl MeanTorque {
    /// Words for machine files.
    pub const WORDS: [&'static str; 2] = ["3", "10/3"];

    /// The choice for a word.
    pub fn of(word: &str) -> Option<Self> {
        match word {
            "3" => Some(Self::Cubic),
            "10/3" => Some(Self::RollerBearing),
            _ => None,
        }
    }

    /// The exponent.
    pub const fn exponent(self) -> f64 {
        match self {
            Self::Cubic => 3.0,
            Self::RollerBearing => 10.0 / 3.0,
        }
    }
}

/// Largest inertia ratio of machines with more than a given number of moves per minute.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Moves {
    /// Moves per minute.
    #[serde(rename = "above [1/min]")]
    pub above: f64,
    /// Largest λ.
    pub limit: f64,
}

/// Choices of a rule set other than limits.
#[derive(Clone, Debug, Default, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Choices {
    /// The λ that is checked.
    pub inertia_ratio_of: InertiaOf,
    /// Exponent of the mean torque of a gearbox.
    pub gearbox_mean_exponent: MeanTorque,
    /// Limits of λ by moves per minute, rising; empty: the same for all.
    pub inertia_ratio_by_moves: Vec<Moves>,
}

impl Choices {
    /// Factor of the limits of λ at a number of moves per minute: one without a table, otherwise the value of the table, NaN
    /// if it has none.
    pub fn inertia_rating(&self, moves_per_minute: f64) -> f64 {
        let mut rating = if self.inertia_ratio_by_moves.is_empty() {
            1.0
        } else {
            f64::NAN
        };
        for band in &self.inertia_ratio_by_moves {
            if moves_per_minute > band.above {
                rating = band.limit;
            }
        }
        rating
    }
}
