//! Gear ratio synthesis: splits a total ratio over the stages of a train for the smallest reduced inertia.
//!
//! Last part of section 6.3 of V. G. Nazarenko, *Dynamics of mechanisms*, Minsk 2002: for a given total ratio, J_red of (6.9) depends on how it is
//! split. With stage ratios i_k = ω_driver/ω_driven > 0, inertias D_k of the drivers and C_k of the driven wheels, and J_L at the output,
//!
//! ```text
//! J_red = Σ_k (D_k + C_k(i_k)/i_k²)/(i_1·…·i_(k−1))² + J_L/i²          i = i_1·…·i_n
//! ```
//!
//! C_k is either given, or grows with the ratio: a wheel of the pinion's module and width has J ∝ r⁴, so that C_k = P_k·i_k⁴, with P_k the inertia of
//! the pinion that it meshes with.
//!
//! In y_k = ln i_k every term is an exponential of a linear function, so that J_red is convex, and has one minimum over Σ y_k = ln i. There ∂J/∂y_k
//! is equal for all stages whose ratio is not at a bound. After the first stage the rest of the train is of the same kind: with R(L) the smallest
//! inertia of the rest for the remaining ratio L = ln i − y_1,
//!
//! ```text
//! J(y_1) = D_1 + C_1/i_1² + R(L)/i_1²        J′ = (C_1/i_1²)′ − (2·R + R′)/i_1² = 0
//! ```
//!
//! J′ rises with y_1, and its zero is found by bisection, stage by stage. R′ needs no differences: at the minimum it is the slope of the rest's own
//! first stage (envelope theorem).
//!
//! Equal pinions and no load give, for two stages, J/P = 1 + i_1² + 1/i_1² + i²/i_1⁴ and the condition i_2² = (i_1⁴ − 1)/2; for large ratios and n
//! stages i_k = √2·(i/2^(n/2))^(2^(k−1)/(2ⁿ − 1)). See *Minimization of Gear-Train Inertia*, Transactions of the ASME 76 (1954), p. 493.

use crate::math;
use crate::number::error::RangeError;
use crate::number::error::{finite, not_negative, positive};

/// Greatest number of stages of a split.
pub const MOST_STAGES: usize = 4;

/// One number for each stage.
pub type PerStage = heapless::Vec<f64, MOST_STAGES>;

/// Bisections: 2⁻⁵⁶ of the range of ln i, below its rounding.
const HALVINGS: usize = 56;

/// The inertia of a driven wheel (kg·m²).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum WheelInertia {
    /// Independent of the ratio.
    Constant(f64),
    /// P·i⁴, with the module and width of a pinion with the inertia P.
    LikePinion(f64),
}

/// One stage with an open ratio.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct OpenStage {
    /// Inertia of the driver (kg·m²).
    pub driver: f64,
    /// Inertia of the driven wheel (kg·m²).
    pub driven: WheelInertia,
}

impl OpenStage {
    /// A stage whose driven wheel has the module and width of its pinion, of inertia `pinion` (kg·m²).
    #[must_use]
    pub const fn geared(pinion: f64) -> Self {
        Self {
            driver: pinion,
            driven: WheelInertia::LikePinion(pinion),
        }
    }

    /// C/i² = `size`·i^`power` (kg·m²).
    const fn driven_at_driver(&self) -> (f64, f64) {
        match self.driven {
            WheelInertia::Constant(inertia) => (inertia, -2.0),
            WheelInertia::LikePinion(inertia) => (inertia, 2.0),
        }
    }
}

/// A split of the ratio.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Split {
    /// The stages' ratios, from the input on.
    pub ratios: PerStage,
    /// J_red at the input (kg·m²).
    pub inertia: f64,
}

/// A train whose total ratio is to be split.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenTrain<'a> {
    /// The total ratio i > 0.
    pub ratio: f64,
    /// 2 to 4 stages, in order from the input.
    pub stages: &'a [OpenStage],
    /// Inertia J_L on the last shaft (kg·m²).
    pub output: f64,
    /// Smallest and largest ratio of a stage.
    pub bounds: [f64; 2],
}

/// An [`OpenTrain`], checked.
#[derive(Clone, Debug, PartialEq)]
pub struct RatioSplit {
    stages: heapless::Vec<OpenStage, MOST_STAGES>,
    output: f64,
    ratio: f64,
    bounds: [f64; 2],
}

impl RatioSplit {
    /// The split of this train.
    ///
    /// # Errors
    /// Fewer than 2 or more than 4 stages; a negative inertia; no inertia that depends on the split; bounds that are not positive and rising, or that
    /// do not allow the total ratio.
    pub fn new(train: OpenTrain<'_>) -> Result<Self, RangeError> {
        let OpenTrain {
            ratio,
            stages,
            output,
            bounds,
        } = train;
        let count = stages.len();
        let what = "number of stages";
        if !(2..=MOST_STAGES).contains(&count) {
            let (value, min, max) = (count as f64, 2.0, MOST_STAGES as f64);
            return Err(RangeError::OutOfRange {
                what,
                value,
                min,
                max,
            });
        }
        for stage in stages {
            not_negative("inertia of the driver", stage.driver)?;
            not_negative("inertia of the driven wheel", stage.driven_at_driver().0)?;
        }
        let split = Self {
            // Cannot fail: counted above.
            stages: stages.iter().copied().collect(),
            output: not_negative("inertia at the output", output)?,
            ratio: positive("total ratio", ratio)?,
            bounds,
        };
        let [low, high] = bounds;
        positive("smallest stage ratio", low)?;
        if finite("largest stage ratio", high)? < low {
            let (what, value, min, max) = ("largest stage ratio", high, low, f64::INFINITY);
            return Err(RangeError::OutOfRange {
                what,
                value,
                min,
                max,
            });
        }
        let power = |bound: f64| stages.iter().map(|_| bound).product::<f64>();
        // Rounding may put a ratio that needs every stage at its bound just outside.
        let (min, max) = (power(low), power(high));
        if ratio < min * (1.0 - 1e-12) || ratio > max * (1.0 + 1e-12) {
            let (what, value) = ("total ratio", ratio);
            return Err(RangeError::OutOfRange {
                what,
                value,
                min,
                max,
            });
        }
        let shafts = stages.windows(2).map(|pair| match pair {
            [one, next] => one.driven_at_driver().0 + next.driver,
            _ => 0.0,
        });
        positive("inertia between input and output", shafts.sum())?;
        Ok(split)
    }

    /// Total ratio.
    pub const fn ratio(&self) -> f64 {
        self.ratio
    }

    /// Number of stages.
    pub fn stages(&self) -> usize {
        self.stages.len()
    }

    /// J_red at the input (kg·m²) with these stage ratios, whose product is the total ratio.
    #[must_use]
    pub fn inertia(&self, ratios: &[f64]) -> f64 {
        let (mut sum, mut before) = (0.0, 1.0);
        for (stage, ratio) in self.stages.iter().zip(ratios) {
            let (size, power) = stage.driven_at_driver();
            let driven = if power > 0.0 {
                ratio * ratio
            } else {
                1.0 / (ratio * ratio)
            };
            sum += (stage.driver + size * driven) / (before * before);
            before *= ratio;
        }
        sum + self.output / (before * before)
    }

    /// ∂J/∂(ln i_k) of every stage (kg·m²): at the smallest J equal for all stages that are not at a bound.
    #[must_use]
    pub fn slopes(&self, ratios: &[f64]) -> PerStage {
        // From the output back: the inertia at each driver, and the part after the stage.
        let mut slopes = PerStage::new();
        let mut behind = self.output;
        for (stage, ratio) in self.stages.iter().zip(ratios).rev() {
            let (size, power) = stage.driven_at_driver();
            let square = ratio * ratio;
            let driven = size * if power > 0.0 { square } else { 1.0 / square };
            // Cannot fail: one slope per stage.
            let _ = slopes.push(power * driven - 2.0 * behind / square);
            behind = stage.driver + driven + behind / square;
        }
        slopes.reverse();
        let mut before = 1.0;
        for (slope, ratio) in slopes.iter_mut().zip(ratios) {
            *slope /= before * before;
            before *= ratio;
        }
        slopes
    }

    /// The same ratio in every stage.
    #[must_use]
    pub fn equal(&self) -> Split {
        let each = math::exp(math::ln(self.ratio) / self.stages() as f64);
        self.split(self.stages.iter().map(|_| each).collect())
    }

    /// The split with the smallest J_red.
    #[must_use]
    pub fn optimum(&self) -> Split {
        self.minimum([self.bounds.map(math::ln); MOST_STAGES])
    }

    /// Smallest and largest possible ratio of the first stage: the range of the curve over the split.
    #[must_use]
    pub fn first_range(&self) -> [f64; 2] {
        let [low, high] = self.bounds;
        let rest = |bound: f64| self.stages.iter().skip(1).map(|_| bound).product::<f64>();
        let least = (self.ratio / rest(high)).max(low);
        let most = (self.ratio / rest(low)).min(high);
        [least, most.max(least)]
    }

    /// The best split whose first stage has the ratio `first`: a point of the curve over the split.
    ///
    /// # Errors
    /// A ratio outside [`first_range`](Self::first_range).
    pub fn with_first(&self, first: f64) -> Result<Split, RangeError> {
        let [min, max] = self.first_range();
        let (what, value) = (
            "ratio of the first stage",
            finite("ratio of the first stage", first)?,
        );
        if value < min * (1.0 - 1e-12) || value > max * (1.0 + 1e-12) {
            return Err(RangeError::OutOfRange {
                what,
                value,
                min,
                max,
            });
        }
        let mut bounds = [self.bounds.map(math::ln); MOST_STAGES];
        bounds[0] = [math::ln(value); 2];
        Ok(self.minimum(bounds))
    }

    fn minimum(&self, bounds: [[f64; 2]; MOST_STAGES]) -> Split {
        let bounds = bounds.get(..self.stages()).unwrap_or_default();
        let mut ratios = self.rest(0, math::ln(self.ratio), bounds).ratios;
        // ln and exp may round beyond a bound.
        for ratio in &mut ratios {
            *ratio = ratio.clamp(self.bounds[0], self.bounds[1]);
        }
        self.split(ratios)
    }

    fn split(&self, ratios: PerStage) -> Split {
        let inertia = self.inertia(&ratios);
        Split { ratios, inertia }
    }

    /// The smallest inertia of the stages from number `from` on, for the ratio e^`total`.
    fn rest(&self, from: usize, total: f64, bounds: &[[f64; 2]]) -> Rest {
        let (Some(stage), Some([low, high])) = (self.stages.get(from), bounds.get(from)) else {
            return Rest::default();
        };
        let (size, power) = stage.driven_at_driver();
        let behind = bounds.get(from + 1..).unwrap_or_default();
        // The inertia at this stage's driver, and its slopes with respect to y: with everything else constant, and with the total constant.
        let with = |y: f64| {
            let rest = self.rest(from + 1, total - y, bounds);
            let factor = math::exp(-2.0 * y);
            let driven = size * math::exp(power * y);
            let behind = if behind.is_empty() {
                self.output
            } else {
                rest.inertia
            };
            let own = power * driven - 2.0 * factor * behind;
            let mut ratios = PerStage::new();
            // Cannot fail: one ratio per stage.
            let _ = ratios.push(math::exp(y));
            ratios.extend(rest.ratios);
            Rest {
                inertia: stage.driver + driven + factor * behind,
                slope: factor * rest.slope,
                own,
                ratios,
            }
        };
        if behind.is_empty() {
            let only = with(total);
            return Rest {
                slope: only.own,
                ..only
            };
        }
        // The range of the later stages limits this one, too.
        let sum = |end: usize| behind.iter().filter_map(|ends| ends.get(end)).sum::<f64>();
        let least = (total - sum(1)).max(*low);
        let most = (total - sum(0)).min(*high).max(least);
        let (mut below, mut above) = (least, most);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (below + above);
            // No number lies between: further halving would repeat the same evaluation, for a stage with a fixed ratio every time.
            if middle <= below || middle >= above {
                break;
            }
            let here = with(middle);
            if here.own < here.slope {
                below = middle;
            } else {
                above = middle;
            }
        }
        // A minimum at an end of the range is exactly there.
        let y = match (below > least, above < most) {
            (false, true) => least,
            (true, false) => most,
            _ => 0.5 * (below + above),
        };
        let best = with(y);
        // At its own bound, this stage leaves more ratio to the later ones; at their bound, it takes the change itself.
        let own_bound = y <= *low || y >= *high;
        let slope = if own_bound { best.slope } else { best.own };
        Rest { slope, ..best }
    }
}

/// The best split of the stages after some shaft.
#[derive(Clone, Debug, Default)]
struct Rest {
    /// Inertia at that shaft.
    inertia: f64,
    /// Slope with respect to the logarithm of their ratio.
    slope: f64,
    /// Slope with respect to y of their first stage alone.
    own: f64,
    ratios: PerStage,
}
