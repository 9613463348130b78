//! Whether the peak of a cycle stays within a share of an envelope, as far as bounds can decide it without searching for the peak.

use super::LoadSample;
use super::extremes::Stretches;
use crate::cycle::form::Coefficients;
use crate::motor::envelope::Envelope;
use jred_analysis::duty::MOST_RAISED;

/// The peak of a cycle relative to two shares of an envelope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum PeakCheck {
    /// Within the lower share at every instant.
    Below,
    /// Above the upper share: an instant uses at least this much.
    Beyond {
        /// |T| as a share of the envelope's torque there, with an allowance for rounding.
        used: f64,
    },
    /// Bounds cannot decide.
    Open,
}

/// Allowance for rounding of a share.
const SHARE_ROUNDING: f64 = 1e-9;

impl Stretches<'_> {
    /// See [`PeakCheck`]; `low` is not above `high`.
    pub(super) fn against(
        self,
        c: &Coefficients,
        ratio: f64,
        envelope: &Envelope,
        [low, high]: [f64; 2],
    ) -> PeakCheck {
        let Some(line) = self.floor_line(ratio, envelope) else {
            return PeakCheck::Open;
        };
        let front = self.front;
        let [start, slope] = line;
        // The bounds apply to samples; the peak between them may be higher.
        let least = low * (1.0 - SHARE_ROUNDING) / (1.0 + MOST_RAISED);
        if front.most_above(&c.0, [least * start, least * slope]) + self.slack(c) <= 0.0 {
            return PeakCheck::Below;
        }
        let bounds = front.bounds(&c.0);
        let floors = front.floors(line);
        let (mut worst, mut most) = (0, f64::NEG_INFINITY);
        for k in 0..front.len {
            let share = bounds[k] / floors[k];
            if share > most {
                (worst, most) = (k, share);
            }
        }
        let node = &self.tree.nodes[front.nodes[worst] as usize];
        let used = |sample: &LoadSample| {
            envelope.peak_used(c.torque(&sample.loads()), sample.speed() * ratio)
        };
        let used = [node.first, node.last]
            .map(|end| used(&self.samples[end as usize]))
            .into_iter()
            .fold(0.0, f64::max);
        if used > high * (1.0 + 4.0 * SHARE_ROUNDING) && used.is_finite() {
            PeakCheck::Beyond {
                used: used * (1.0 - SHARE_ROUNDING),
            }
        } else {
            PeakCheck::Open
        }
    }

    /// A line over the speed at the gearbox output (torque at rest, slope) that is not above the envelope at any speed of the cycle; `None` if no
    /// such line is positive.
    fn floor_line(self, ratio: f64, envelope: &Envelope) -> Option<[f64; 2]> {
        let fastest = self.tree.nodes.first()?.speed[1];
        let floor = |driving| envelope.floor(driving, [0.0, fastest * ratio]);
        let [driving, braking] = [floor(true), floor(false)];
        let [start, end] = [driving[0].min(braking[0]), driving[1].min(braking[1])];
        let slope = (end - start) / fastest;
        // An infinite limit means that there are no data.
        let known = driving[0].max(braking[0]).is_finite() && slope.is_finite();
        let usable = known && start > 0.0 && end > 0.0;
        usable.then_some([start, slope])
    }
}
