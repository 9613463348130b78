//! Faults of a log, and obstacles to an identification.

use schemars::JsonSchema;
use serde::Serialize;

use super::Samples;
use super::fit::Fit;
use super::matrix::{DIAGONALS, Matrix, whiten};

/// Whitened residuals above this many robust standard deviations are outliers.
const OUTLIER: f64 = 5.0;

/// Rows in a block of the search for a slip; statistic from which on one is reported.
const BLOCK: usize = 250;
const SLIP: f64 = 4.5;

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
    /// J is negative at every angle: torque or position is reversed.
    Reversed {
        /// Whether the design fits a reversed position better.
        position: bool,
    },
    /// The curves are those of the design over −φ: torque and position are both reversed.
    Mirrored,
    /// The curves are those of the design with another zero.
    Zero {
        /// The angle at which they have what the design has at φ = 0 (rad).
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

/// A slip of the encoder: the place that separates two offsets of the position best.
pub(super) fn slip(fit: &Fit) -> Option<Fault> {
    const CHANGE: f64 = 1e-4;
    let moved: Vec<f64> = fit.motion.position.iter().map(|phi| phi + CHANGE).collect();
    let torque = |position: &[f64]| {
        fit.weak
            .rows(&fit.basis, position, &fit.motion.speed)
            .times(&fit.theta)
    };
    let (moved, here) = (torque(&moved), torque(&fit.motion.position));
    let mut effect = Matrix::zeros(here.len(), 1);
    for (i, row) in effect.rows_mut().enumerate() {
        if fit.kept[i] {
            row[0] = (moved[i] - here[i]) / CHANGE;
        }
    }
    whiten(&fit.lower, &mut effect);
    let sums: Vec<[f64; 2]> = (0..here.len() / BLOCK)
        .map(|b| {
            let rows = b * BLOCK..(b + 1) * BLOCK;
            rows.fold([0.0, 0.0], |[de, dd], i| {
                let d = effect.at(i, 0);
                [de + d * fit.residuals[i], dd + d * d]
            })
        })
        .collect();
    let total = sums
        .iter()
        .fold([0.0, 0.0], |[a, b], [x, y]| [a + x, b + y]);
    let mut before = [0.0, 0.0];
    let mut best: Option<Fault> = None;
    let last = sums.len().saturating_sub(2);
    for (i, [de, dd]) in sums.iter().enumerate().take(last) {
        before = [before[0] + de, before[1] + dd];
        let after = [total[0] - before[0], total[1] - before[1]];
        if i < 2 || before[1] <= 0.0 || after[1] <= 0.0 {
            continue;
        }
        // The model's angle must be moved against the slip.
        let by = before[0] / before[1] - after[0] / after[1];
        let spread = fit.misfit.max(1.0) * (1.0 / before[1] + 1.0 / after[1]);
        let statistic = by.abs() / spread.sqrt();
        let larger =
            |known: &Fault| !matches!(known, Fault::Slip { statistic: s, .. } if *s >= statistic);
        if statistic > SLIP && best.as_ref().is_none_or(larger) {
            best = Some(Fault::Slip {
                at: ((i + 1) * BLOCK) as f64 * fit.weak.knots(),
                by,
                statistic,
            });
        }
    }
    best
}
