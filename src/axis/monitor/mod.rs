//! Monitoring: a torque that should repeat every cycle, compared with itself in the same place of the range.
//!
//! ```text
//!                  ┌─► bins over φ: mean, σ ─► every tick:  |e − mean| > limit     ─► jam
//! e, φ ─► Monitor ─┤                      ┌──► every cycle: mean of e − mean       ─► wear  (friction)
//!                  └─► e − mean ──────────┼──► every cycle: its spread/σ           ─► wear  (vibration)
//!                                         └──► every cycle: its share of u(φ)      ─► wrong payload
//! ```
//!
//! e is any torque of the drive link that repeats: best the load of an [`Observer`](super::Observer), else the drive's torque minus that of the model.
//! The first cycles are the reference, with the same motion as later. What the model has wrong repeats, and ends up in the means.
//!
//! # Jam
//!
//! A tick whose e is farther from its bin's mean than the limit. If e − mean is normal, or has tails no heavier, with the σ of its bin, the
//! probability of any false alarm in M cycles of n ticks is, by the union bound and thus for any correlation of the ticks,
//!
//! ```text
//! p ≤ 2·M·n·exp(−λ²/2)        limit = 1.5·λ·σ
//! ```
//!
//! The factor 1.5 is for the σ, which is an estimate; a bin's σ counts at least as that of the mean variance of all bins. 10,000 cycles of 2000 ticks
//! with p = 0.001 have λ = 7.0. A jam of 10 % of the peak torque is seen within 5° of the crank, found 2.6°, and 10,000 cycles have no false
//! alarm: with a torque noise of 1 % and 2.6 million counts of the encoder per turn, at 60 Hz (tests `a_jam_is_seen_within_five_degrees`,
//! `ten_thousand_cycles_have_no_false_alarm`).
//!
//! # Wear and wrong payload
//!
//! Each cycle gives three numbers: the payload m by which e changed, by least squares over its torque u(φ) without its mean; the mean of e − mean
//! without m·u; and the root-mean-square of (e − mean)/σ without both. Each passes a CUSUM with the allowance 2·σ and the limit h·2·σ of a cycle's number:
//!
//! ```text
//! S ← max(0, S + (x − x̄)/(2·σ) − 1) > h        p ≤ 6·M·exp(−1.2·h)
//! ```
//!
//! for six sums: from every cycle on, exp of 1.2 times the sum without the 0 is a supermartingale, as long as the reference's mean is within 0.4·2·σ, 4
//! of its standard errors, and σ is at least half of the true one; the union bound is over the cycles. It needs cycles that are independent and normal:
//! a machine that warms up breaks it. Changes below 2·σ are not seen; one of 10·σ is
//! after h/4, 4 cycles for the figures above. The spread is not judged while the payload is wrong.
//!
//! # Cost
//!
//! On a Cortex-M4F a tick takes 126 instructions, the end of a cycle 400 (`scripts/test counts`). After the torque's conversion a tick has integers only
//! and no division, in every number type; the end of a cycle has a few divisions and a root in single precision, and the
//! end of learning one root per bin. Memory: 40 bytes per bin.

mod bin;
mod drift;
mod figures;
mod reference;

use bin::Bin;
use drift::Drift;
pub use figures::{Cycle, Seen, Watch};

use super::AxisError;
use super::error::within;
use super::torque_count::{TorqueCount, nearest};
use crate::Phase;
use crate::number::{Number, Real};
use crate::tick::MachineUnits;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
enum Stage {
    Bins,
    Cycles,
    Watching,
}

/// Sums of one cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct Sums {
    ticks: u32,
    /// Those in bins that are not known.
    unknown: u32,
    jams: u32,
    off: i64,
    weighted: i64,
    /// Of (e − mean)²/σ² in units of 2⁻¹⁶.
    squares: i64,
}

/// Compares a torque with itself in earlier cycles, in `BINS` parts of the range. See the [module](self).
///
/// One monitor is for one direction: a machine that goes there and back has two. After a repair, or for another motion, make a new one; after a loss of
/// power one [`with_reference`](Self::with_reference).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Monitor<N, const BINS: usize> {
    count: TorqueCount<N>,
    watch: Watch,
    stage: Stage,
    /// Cycles in this stage of learning, and the ticks of the mean reference cycle.
    learned: u32,
    ticks: u32,
    bins: [Bin; BINS],
    sums: Sums,
    /// Payload of a mean product of e − mean and weight, and the friction of a payload.
    payload_scale: f32,
    payload_mean: f32,
    /// With w, the payload's torque without its mean: the means over the ticks of 1/σ², 2·w/σ² and w²/σ², in counts.
    precision: f32,
    payload_cross: f32,
    payload_square: f32,
    /// Limit of the sums of the drifts.
    limit: f32,
    friction: Drift,
    spread: Drift,
    payload: Drift,
}

/// ln x for x ≥ 1, at most 0.06 too large: the logarithm's chord between powers of two.
fn logarithm(x: f32) -> f32 {
    let bits = x.to_bits();
    let exponent = (bits >> 23) as f32 - 127.0;
    let mantissa = (bits & 0x7f_ffff) as f32 / 8_388_608.0;
    core::f32::consts::LN_2 * (exponent + mantissa + 0.086_1)
}

impl<N: Number, const BINS: usize> Monitor<N, BINS> {
    /// A monitor of torques of this model; `payload` is the torque (N·m) on the drive link, in +φ, by which one more unit of payload changes e at
    /// this phase, in the motion of the reference: `|_| 0.0` without one.
    ///
    /// A payload is told from friction by how u varies: over the range by 1/8192 of the largest torque or more, so that rounding to counts is at most
    /// 1 % of it; |u| is at most twice the largest torque.
    ///
    /// # Errors
    /// A figure outside the range stated for it; no bin, or more than 65535.
    pub fn new(
        watch: Watch,
        mut payload: impl FnMut(Phase) -> f32,
        model: &impl MachineUnits<Number = N>,
    ) -> Result<Self, AxisError> {
        let count = TorqueCount::new(watch.largest, model)?;
        within(
            "the probability of a false alarm",
            watch.false_alarm,
            (1e-9..=0.5).contains(&watch.false_alarm),
            "from 1e-9 to 0.5",
        )?;
        within(
            "the reference cycles",
            watch.reference as f32,
            (32..=10_000).contains(&watch.reference),
            "from 32 to 10000",
        )?;
        within(
            "the cycles without a false alarm",
            watch.cycles as f32,
            (1..=1_000_000).contains(&watch.cycles),
            "from 1 to 1000000",
        )?;
        within(
            "the bins",
            BINS as f32,
            (1..=65_535).contains(&BINS),
            "from 1 to 65535",
        )?;
        let mut bins = [Bin::default(); BINS];
        let [mut least, mut most] = [f32::INFINITY, f32::NEG_INFINITY];
        for (k, bin) in (0u64..).zip(&mut bins) {
            // The middle of the bin.
            let middle = ((2 * k + 1) << 31) / BINS as u64;
            let torque = payload(Phase::from_bits(middle as u32));
            within(
                "the payload's torque",
                torque,
                torque.abs() <= 2.0 * watch.largest,
                "at most twice the largest torque, in either direction",
            )?;
            bin.weight = count.of_si(torque);
            [least, most] = [least.min(torque), most.max(torque)];
        }
        within(
            "the variation of the payload's torque over the range",
            most - least,
            most - least >= watch.largest / 8192.0 || (least == 0.0 && most == 0.0),
            "at least 1/8192 of the largest torque, unless the payload has no torque anywhere",
        )?;
        let cycles = 6.0 * watch.cycles as f32;
        Ok(Self {
            count,
            watch,
            stage: Stage::Bins,
            learned: 0,
            ticks: 0,
            bins,
            sums: Sums::default(),
            payload_scale: 0.0,
            payload_mean: 0.0,
            precision: 0.0,
            payload_cross: 0.0,
            payload_square: 0.0,
            limit: logarithm(cycles / watch.false_alarm) / 1.2,
            friction: Drift::default(),
            spread: Drift::default(),
            payload: Drift::default(),
        })
    }

    /// Adds a tick: the phase, and the torque e there.
    #[inline]
    pub fn tick(&mut self, phase: Phase, torque: N::Torque) -> Seen {
        let Some(torque) = self.count.of(torque) else {
            return Seen::Invalid;
        };
        let (bin, _) = phase.cell(BINS as u32);
        let Some(bin) = self.bins.get_mut(bin as usize) else {
            return Seen::Unknown;
        };
        let sums = &mut self.sums;
        sums.ticks = sums.ticks.saturating_add(1);
        if self.stage == Stage::Bins {
            bin.learn(torque);
            return Seen::Learning;
        }
        if bin.limit == 0 {
            sums.unknown = sums.unknown.saturating_add(1);
            return Seen::Unknown;
        }
        let off = torque - bin.mean;
        // In units of 2⁻⁸·σ, up to eight of them.
        let share = (i64::from(off) * i64::from(bin.inverse)) >> 16;
        let share = share.clamp(-2048, 2048);
        sums.off = sums.off.saturating_add(i64::from(off));
        sums.weighted = sums
            .weighted
            .saturating_add(i64::from(off) * i64::from(bin.weight));
        sums.squares = sums.squares.saturating_add(share * share);
        if self.stage == Stage::Cycles {
            Seen::Learning
        } else if off.abs() > bin.limit {
            sums.jams = sums.jams.saturating_add(1);
            Seen::Jam
        } else {
            Seen::Usual
        }
    }

    /// Ends a cycle of the machine: what it showed.
    pub fn end_cycle(&mut self) -> Cycle {
        let sums = core::mem::take(&mut self.sums);
        if self.stage == Stage::Bins {
            self.learned += 1;
            if self.learned >= self.watch.reference {
                self.finish_bins();
            }
            return Cycle::default();
        }
        let mut cycle = self.figures(&sums);
        // To an eighth.
        if sums.ticks == sums.unknown
            || self.ticks.abs_diff(sums.ticks) > self.ticks / 8
            || sums.jams > 0
        {
            return cycle;
        }
        if self.stage == Stage::Cycles {
            self.friction.learn(cycle.friction);
            self.spread.learn(cycle.spread);
            self.payload.learn(cycle.payload);
            self.learned += 1;
            if self.learned >= self.watch.reference {
                self.finish_cycles();
            }
            return cycle;
        }
        cycle.judged = true;
        let (payload, wrong) = self.payload.judge(cycle.payload, self.limit);
        let (friction, rubs) = self.friction.judge(cycle.friction, self.limit);
        let (_, shakes) = self.spread.judge(cycle.spread, self.limit);
        cycle.payload = payload;
        cycle.friction = friction;
        cycle.wrong_payload = wrong;
        cycle.wear = rubs || (shakes && !wrong);
        cycle
    }

    /// Whether the reference is complete.
    #[must_use]
    pub fn is_watching(&self) -> bool {
        self.stage == Stage::Watching
    }

    /// Mean, and least deviation from it that is a jam, at this phase (N·m); `None`: not known (yet).
    #[must_use]
    pub fn usual(&self, phase: Phase) -> Option<[f32; 2]> {
        let (bin, _) = phase.cell(BINS as u32);
        let bin = self.bins.get(bin as usize)?;
        let known = bin.limit > 0;
        known.then(|| [bin.mean, bin.limit].map(|counts| self.count.si(counts as f32)))
    }

    fn figures(&self, sums: &Sums) -> Cycle {
        let ticks = sums.ticks.saturating_sub(sums.unknown).max(1) as f32;
        let payload = self.payload_scale * (sums.weighted as f32 / ticks);
        let off = sums.off as f32 / ticks;
        let mean = self.count.si(off);
        // In σ².
        let squares = sums.squares as f32 / ticks / 65_536.0;
        // ((off + payload·w)/σ)²: where σ varies over the range, both share a part.
        let explained = off * (off * self.precision + payload * self.payload_cross)
            + payload * payload * self.payload_square;
        let left = if squares > explained {
            squares - explained
        } else {
            0.0
        };
        Cycle {
            friction: mean - payload * self.payload_mean,
            spread: Real::sqrt(left),
            payload,
            jams: sums.jams,
            ..Cycle::default()
        }
    }

    /// The mean over the ticks of a figure of the known bins.
    fn mean(&self, of: impl Fn(&Bin) -> f32) -> f32 {
        let known = self.bins.iter().filter(|bin| bin.is_known());
        let [sum, ticks] = known.fold([0.0, 0.0], |[sum, all], bin| {
            let ticks = bin.ticks as f32;
            [sum + of(bin) * ticks, all + ticks]
        });
        sum / ticks.max(1.0)
    }

    /// The bins are learned: means, limits, and weights of the payload without their mean.
    fn finish_bins(&mut self) {
        // Of all bins: a cycle is as long where too few ticks were.
        let bins = self.bins.iter();
        let ticks = bins.fold(0u32, |sum, bin| sum.saturating_add(bin.ticks));
        self.ticks = ticks / self.watch.reference.max(1);
        let variance = self.mean(|bin| {
            let [_, variance] = bin.moments();
            variance
        });
        for bin in self.bins.iter_mut().filter(|bin| bin.is_known()) {
            bin.finish(variance);
        }
        self.set_limits();
        self.stage = Stage::Cycles;
        self.learned = 0;
    }

    /// Limits, and weights of the payload without their mean, from what is usual.
    fn set_limits(&mut self) {
        // Ticks of all cycles without a false alarm, on both sides.
        let ticks = 2.0 * self.watch.cycles as f32 * self.ticks.max(1) as f32;
        let multiple = Real::sqrt(2.0 * logarithm(ticks / self.watch.false_alarm));
        let payload = self.mean(|bin| bin.weight as f32);
        for bin in self.bins.iter_mut().filter(|bin| bin.is_known()) {
            bin.set_limit(1.5 * multiple);
            bin.weight = nearest(bin.weight as f32 - payload);
        }
        let squared = |share: f32| share * share;
        let square = self.mean(|bin| squared(bin.weight as f32));
        self.precision = self.mean(|bin| squared(bin.precision()));
        self.payload_cross = 2.0 * self.mean(|bin| bin.weight as f32 * squared(bin.precision()));
        self.payload_square = self.mean(|bin| squared(bin.weight as f32 * bin.precision()));
        self.payload_mean = self.count.si(payload);
        if square > 0.0 {
            self.payload_scale = 1.0 / square;
        }
    }

    fn finish_cycles(&mut self) {
        let resolution = self.count.si(1.0);
        self.friction.finish(resolution);
        self.spread.finish(1.0 / 256.0);
        self.payload.finish(Real::sqrt(self.payload_scale));
        self.stage = Stage::Watching;
        self.learned = 0;
    }
}
