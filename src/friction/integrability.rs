//! Whether the constraint of a stage is a relation between angles.
//!
//! A constraint Σ C_i·q̇_i + C = 0 (III.4), or as a form over the variables x = (q₁ … q_r, t)
//!
//! ```text
//! θ = Σ C_i(x)·dx_i = 0                                                   (III.5)
//! ∂C_i/∂x_k = ∂C_k/∂x_i for all i, k: θ is a total differential           (III.6), sufficient
//! θ ∧ dθ = 0: θ is one after multiplication by an integrating factor      Frobenius, necessary and sufficient
//! ```
//!
//! (III.6) as printed gives sufficient conditions and leaves the integrating factor open; Frobenius' theorem closes that gap (H. Flanders,
//! *Differential Forms*, chapter VII). A stage is θ = dα_b − j(t, α_a)·dα_a, with θ ∧ dθ = −(∂j/∂t)·dα_b ∧ dt ∧ dα_a: it is holonomic exactly where j
//! is independent of time.

use crate::number::error::RangeError;
use core::fmt;

use crate::friction::{Drive, OperatingPoint, Stage};
use crate::machine::MAX_STAGES;
use crate::math;
use crate::number::error::finite;

/// The kind of constraint of a stage.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum StageConstraint {
    /// Holonomic (III.18): α_b − j·α_a = const.
    Proportional {
        /// j
        speed: f64,
    },
    /// Holonomic: α_b − ∫ j(α_a) dα_a = const, by [`Stage::angle`].
    Integral,
    /// Non-holonomic: j changes over time. θ ∧ dθ = −rate·dα_b ∧ dt ∧ dα_a, at its largest.
    NonHolonomic {
        /// ∂j/∂t (1/s).
        rate: f64,
        /// Time (s).
        t: f64,
        /// Angle α_a (rad).
        phi: f64,
    },
    /// Not a constraint: j depends on the load, so that angles and speeds alone do not determine ω_b.
    Constitutive,
}

impl StageConstraint {
    /// Whether the stage is a relation between angles.
    #[must_use]
    pub const fn is_holonomic(&self) -> bool {
        matches!(self, Self::Proportional { .. } | Self::Integral)
    }
}

impl fmt::Display for StageConstraint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Proportional { speed } => write!(
                f,
                "holonomic, (III.18): α_b - j α_a = const with j = {speed}"
            ),
            Self::Integral => write!(
                f,
                "holonomic: α_b - ∫ j(α_a) dα_a = const; j depends on the angle alone"
            ),
            Self::NonHolonomic { rate, t, .. } => write!(
                f,
                "non-holonomic: θ∧dθ = -(∂j/∂t) dα_b∧dt∧dα_a is not zero, ∂j/∂t = {rate:.3e} 1/s at t = {t:.6} s; \
                 no integrating factor exists, and α_b is a state of its own"
            ),
            Self::Constitutive => write!(
                f,
                "not a constraint: j depends on the load, so speeds are coupled by forces"
            ),
        }
    }
}

/// Number of test places per variable.
const SAMPLES: u32 = 129;

/// A relative change of j below this is rounding.
const ROUNDING: f64 = 1e-13;

impl Drive<'_> {
    /// The kind of constraint of every stage, for times in `t` = [from, to] (s) and angles of its first shaft in `phi` = [from, to] (rad).
    ///
    /// Tested on a grid of 129 × 129 places, by the derivatives of j there and by its changes between them, so that a short shift is not missed.
    ///
    /// # Errors
    /// As [`Stage::at`], or a range that is not finite.
    pub fn integrability(
        &self,
        t: [f64; 2],
        phi: [f64; 2],
    ) -> Result<heapless::Vec<StageConstraint, MAX_STAGES>, RangeError> {
        for (what, value) in [
            ("start time", t[0]),
            ("end time", t[1]),
            ("first angle", phi[0]),
            ("last angle", phi[1]),
        ] {
            finite(what, value)?;
        }
        self.stages()
            .iter()
            .map(|stage| constraint(stage, t, phi))
            .collect()
    }
}

fn constraint(
    stage: &Stage,
    times: [f64; 2],
    angles: [f64; 2],
) -> Result<StageConstraint, RangeError> {
    let grid =
        |[from, to]: [f64; 2], k: u32| from + (to - from) * f64::from(k) / f64::from(SAMPLES - 1);
    let span = times[1] - times[0];
    let mut fastest: Option<(f64, f64, f64)> = None;
    let mut turns = false;
    let first = stage
        .at(OperatingPoint::at_time(times[0]).with_angle(angles[0]))?
        .speed
        .value;
    for l in 0..SAMPLES {
        let phi = grid(angles, l);
        let mut before: Option<(f64, f64)> = None;
        for k in 0..SAMPLES {
            let t = grid(times, k);
            let speed = stage.at(OperatingPoint::at_time(t).with_angle(phi))?.speed;
            let loaded = stage
                .at(OperatingPoint::at_time(t).with_angle(phi).with_load(LOAD))?
                .speed;
            if speed.slope[2] != 0.0 || loaded.slope[2] != 0.0 {
                return Ok(StageConstraint::Constitutive);
            }
            let size = math::abs(speed.value);
            // By the mean value theorem a change proves that rate somewhere on the way.
            let mean = before.map_or(0.0, |(at, was)| {
                let changed = math::abs(speed.value - was) > ROUNDING * size && t - at > 0.0;
                if changed {
                    (speed.value - was) / (t - at)
                } else {
                    0.0
                }
            });
            for rate in [speed.slope[0], mean] {
                let counts = math::abs(rate) * math::abs(span) > ROUNDING * size;
                if counts && fastest.is_none_or(|(most, ..)| math::abs(rate) > math::abs(most)) {
                    fastest = Some((rate, t, phi));
                }
            }
            turns |= math::abs(speed.value - first) > ROUNDING * size || speed.slope[1] != 0.0;
            before = Some((t, speed.value));
        }
    }
    Ok(match fastest {
        Some((rate, t, phi)) => StageConstraint::NonHolonomic { rate, t, phi },
        None if turns => StageConstraint::Integral,
        None => StageConstraint::Proportional { speed: first },
    })
}

/// A load (N·m) that, compared with zero load, reveals a slip that depends on the load.
const LOAD: f64 = 1e-3;
