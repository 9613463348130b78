//! A slip of the encoder: the place that separates two offsets of the position best.

use super::fault::Fault;
use super::fit::{Fit, fit};
use super::matrix::{Matrix, whiten};
use super::{FEWER, Options, Samples};

/// Rows in a block of the search for a slip; statistic from which on one is reported.
const BLOCK: usize = 250;
const SLIP: f64 = 4.5;

/// A slip of fewer counts is not told from the steps of the encoder.
const COUNTS: f64 = 1.5;

/// A slip that was found.
pub(super) struct Slipped {
    /// When (s).
    pub(super) at: f64,
    /// By how much (rad).
    by: f64,
    statistic: f64,
    /// Whether it explains much of the noise: then it is the cause of other faults.
    pub(super) proven: bool,
}

impl Slipped {
    pub(super) const fn fault(&self) -> Fault {
        Fault::Slip {
            at: self.at,
            by: self.by,
            statistic: self.statistic,
        }
    }

    /// Whether the torque's noise falls when the slip is taken out.
    fn is_proven(&self, found: &Fit, samples: &Samples, options: &Options) -> bool {
        let mut mended = samples.clone();
        let from = (self.at / samples.step) as usize;
        for phi in mended.position.iter_mut().skip(from) {
            *phi -= self.by;
        }
        let mended = fit(&mended, &found.basis, options, Some(found.delay), None);
        mended.is_ok_and(|mended| mended.torque_noise < FEWER * found.torque_noise)
    }
}

/// The most certain slip.
pub(super) fn slip(found: &Fit, samples: &Samples, options: &Options) -> Option<Slipped> {
    let sums = effects(found);
    let total = sums
        .iter()
        .fold([0.0, 0.0], |[a, b], [x, y]| [a + x, b + y]);
    let mut before = [0.0, 0.0];
    let mut best: Option<Slipped> = None;
    let last = sums.len().saturating_sub(2);
    for (i, [de, dd]) in sums.iter().enumerate().take(last) {
        before = [before[0] + de, before[1] + dd];
        let after = [total[0] - before[0], total[1] - before[1]];
        if i < 2 || before[1] <= 0.0 || after[1] <= 0.0 {
            continue;
        }
        // The model's angle must be moved against the slip.
        let by = before[0] / before[1] - after[0] / after[1];
        let spread = found.misfit.max(1.0) * (1.0 / before[1] + 1.0 / after[1]);
        let statistic = by.abs() / spread.sqrt();
        let larger = best.as_ref().is_none_or(|best| statistic > best.statistic);
        let counts = options
            .encoder_step
            .is_none_or(|step| by.abs() > COUNTS * step);
        if statistic > SLIP && counts && larger {
            best = Some(Slipped {
                at: ((i + 1) * BLOCK) as f64 * found.weak.knots(),
                by,
                statistic,
                proven: false,
            });
        }
    }
    let best = best?;
    Some(Slipped {
        proven: best.is_proven(found, samples, options),
        ..best
    })
}

/// In each block: the sum of the residuals times the effect d of an offset of the position on them, and that of d².
fn effects(found: &Fit) -> Vec<[f64; 2]> {
    const CHANGE: f64 = 1e-4;
    let motion = &found.motion;
    let moved: Vec<f64> = motion.position.iter().map(|phi| phi + CHANGE).collect();
    let torque = |position: &[f64]| {
        let rows = found.weak.rows(&found.basis, position, &motion.speed);
        rows.times(&found.theta)
    };
    let (moved, here) = (torque(&moved), torque(&motion.position));
    let mut effect = Matrix::zeros(here.len(), 1);
    for (i, row) in effect.rows_mut().enumerate() {
        if found.kept[i] {
            row[0] = (moved[i] - here[i]) / CHANGE;
        }
    }
    whiten(&found.lower, &mut effect);
    let block = |b: usize| {
        let rows = b * BLOCK..(b + 1) * BLOCK;
        rows.fold([0.0, 0.0], |[de, dd], i| {
            let d = effect.at(i, 0);
            [de + d * found.residuals[i], dd + d * d]
        })
    };
    (0..here.len() / BLOCK).map(block).collect()
}
