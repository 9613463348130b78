//! Faults of a log, and obstacles to an identification.

use schemars::JsonSchema;
use serde::Serialize;

use super::Samples;
use super::fit::Fit;
use super::matrix::DIAGONALS;

/// Whitened residuals above this many robust standard deviations are outliers.
const OUTLIER: f64 = 5.0;

/// Why a log does not determine the machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Obstacle {
    /// Too few samples, or independent rows.
    Short {
        /// Samples, or rows that are left; 4 ms of motion without a fault give one row.
        rows: usize,
        /// How many are needed.
        needed: usize,
        /// Time between two samples (s).
        step: f64,
    },
    /// Angles that are not visited, the longest range (rad).
    NotVisited {
        /// Its first angle.
        from: f64,
        /// Its last angle.
        to: f64,
        /// Whether the log visits them, with samples that are left out.
        left_out: bool,
    },
    /// The speed is the same in every turn: share by which ω² varies at an angle.
    SameSpeed {
        /// Median over the angles of std ω²/mean ω².
        variation: f64,
    },
    /// The unknowns cannot be told apart.
    NotDetermined,
}

impl Obstacle {
    pub(super) const fn short(samples: &Samples, rows: usize, needed: usize) -> Self {
        Self::Short {
            rows,
            needed,
            step: samples.step,
        }
    }
}

/// A fault of the log that was found.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Fault {
    /// The encoder slipped.
    Slip {
        /// When (s from the beginning of the log).
        at: f64,
        /// By how much (rad).
        by: f64,
        /// The statistic: standard deviations of the difference, by the residuals that were found.
        statistic: f64,
    },
    /// Single torques or positions that the motion cannot explain.
    Spikes {
        /// Their number.
        count: usize,
        /// The first (s).
        first: f64,
    },
    /// The torque has a part of this order that was not asked for.
    Cogging {
        /// Periods in a turn of the drive link.
        order: u32,
        /// Its amplitude (N·m).
        amplitude: f64,
    },
    /// J is negative at every angle: torque or position is reversed.
    Reversed {
        /// Whether it is the position; `None`: the design is symmetric and fits both.
        position: Option<bool>,
    },
    /// The curves are those of the design over −φ: torque and position are both reversed.
    Mirrored,
    /// The curves are those of the design with another zero.
    Zero {
        /// The angle at which they have what the design has at φ = 0 (rad).
        by: f64,
    },
    /// The curves are those of the design if the positions are this many times as large.
    Scale {
        /// The factor.
        by: f64,
    },
    /// The curves are those of the design if the log is of the other shaft.
    Shaft,
    /// The curves are those of the design times this factor.
    Torque {
        /// The factor.
        by: f64,
    },
    /// J is not positive at an angle: what was taken out is more than the log has.
    NotPositive {
        /// The angle of the smallest J (rad).
        at: f64,
        /// J there (kg·m²).
        inertia: f64,
    },
    /// The torque's noise is above this share of its RMS value.
    Noisy {
        /// The share.
        share: f64,
    },
    /// The delay did not settle.
    Delay {
        /// The last value (s).
        at: f64,
    },
}

/// Rows whose residual is too large: the largest of those that one sample may cause, whose effect whitening carries on.
pub(super) fn outliers(fit: &Fit) -> Vec<usize> {
    let kept = fit.residuals.iter().zip(&fit.kept);
    let mut sizes: Vec<f64> = kept
        .filter(|(_, kept)| **kept)
        .map(|(e, _)| e.abs())
        .collect();
    sizes.sort_by(f64::total_cmp);
    let median = sizes.get(sizes.len() / 2).copied().unwrap_or_default();
    let limit = OUTLIER * 1.4826 * median;
    let each = fit.residuals.iter().zip(&fit.kept).enumerate();
    let far = each.filter(|(_, (e, kept))| **kept && e.abs() > limit);
    let far: Vec<usize> = far.map(|(i, _)| i).collect();
    let size = |row: usize| fit.residuals.get(row).map_or(0.0, |e| e.abs());
    far.chunk_by(|a, b| b - a <= DIAGONALS)
        .filter_map(|group| {
            let rows = group.iter().copied();
            rows.max_by(|a, b| size(*a).total_cmp(&size(*b)))
        })
        .collect()
}
