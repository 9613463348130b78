//! Follows a plan tick by tick, at its own pace or slower.

use super::error::{positive, within};
use super::plan::{Plan, PlanError, power_of_two, shifted};
use super::{AxisError, MotionState};
use crate::number::{Factor, Number};
use crate::tick::MachineUnits;

/// The commanded rate of a plan as a share of its own pace, as the feed override of a machine tool.
///
/// ```
/// use jred::axis::Override;
///
/// assert_eq!(Override::percent(100), Override::FULL);
/// assert_eq!(Override::percent(250), Override::FULL);
/// assert_eq!(Override::percent(0), Override::STILL);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Override(u32);

/// 100 %.
const FULL: u32 = 1 << 24;

/// Extra bits of a rate in the sum, compared with a commanded rate, and compared with the rate that a tick uses.
const FINER: u32 = 32;
const UNUSED: u32 = 25;

impl Override {
    /// As planned.
    pub const FULL: Self = Self(FULL);
    /// Hold.
    pub const STILL: Self = Self(0);

    /// `percent` per cent; more than 100 counts as 100, because a motion faster than planned may exceed the plan's limits.
    #[must_use]
    pub const fn percent(percent: u32) -> Self {
        if percent >= 100 {
            Self::FULL
        } else {
            Self((percent << 24) / 100)
        }
    }
}

/// Progress of a plan.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum PlanState {
    /// Not started: at the plan's start.
    #[default]
    Waiting,
    /// Under way.
    Running,
    /// Under way, with the rate 0.
    Held,
    /// At the end, where it stays. If the plan ends with a speed, the set-point keeps that speed times the last rate, and the program must continue
    /// the motion.
    Done,
}

/// The set-point of a tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SetPoint<N: Number> {
    /// Position, speed and acceleration.
    pub motion: MotionState<N>,
    /// Whole turns since φ = 0; 0 on a stroke. They jump back at each repeat of a plan that advances by whole turns; a program that needs the total
    /// way counts the jumps.
    pub turns: i32,
    /// Progress.
    pub state: PlanState,
    /// In fixed point a number was limited: including a change of the rate, the acceleration is beyond its base.
    pub limited: bool,
}

/// Follows a [`Plan`] tick by tick, with a rate that may change.
///
/// The rate r scales the plan's time s: ds/dt = r, so that
///
/// ```text
/// φ = φ_plan(s),   ω = r·ω_plan(s),   α = r²·α_plan(s) + dr/dt·ω_plan(s)
/// ```
///
/// The rate changes linearly to the commanded one: the speed is continuous, and the acceleration contains that of the ramp. At a constant rate r the
/// torque of a machine without viscous friction lies between the plan's torque and that at standstill, where only the load of the position acts. A
/// change of the rate takes J·ω·dr/dt more. A drive that the plan uses fully has that only where the rate falls while the plan drives, or rises while
/// it brakes. [`Plan::least_ramp`] is the shortest ramp for which the drive has it everywhere.
///
/// Accuracy: the period is rounded to units of 2⁻⁴⁰ s, which is exact in single precision from 8 µs on, and no fraction of the plan's time is lost
/// from tick to tick (test `a_follower_is_on_time`). The rate is summed in units of 2⁻⁵⁶ and used in units of 2⁻³¹: a change of the rate takes its
/// time to within a tick and 2⁻²² of it, for any ramp and tick (test `a_long_ramp_takes_its_time`). Its acceleration is off by 2⁻²⁸ of the greatest
/// possible one, and by the single precision of a factor; the sum with the plan's acceleration is rounded once (test
/// `a_ramp_is_as_fine_as_its_numbers`). A speed times the rate is at most one unit too small, an acceleration times its square two
/// (`tests/proofs/plan.g`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanFollower<'a, N> {
    plan: Plan<'a, N>,
    /// A tick and the plan's time, in units of 2⁻⁴⁰ s; the remainder of the time in units of 2⁻⁷² s.
    step: u64,
    time: u64,
    rest: u32,
    /// The rate, and its greatest change per tick, in units of 2⁻⁵⁶.
    rate: u64,
    change: u64,
    /// Shift that brings the change of the rate per tick to 31 bits.
    shift: i32,
    /// Factor from a speed times that change to an acceleration.
    ramp: Factor,
    started: bool,
    /// It has not moved yet: the rate follows the commanded one at once.
    fresh: bool,
    repeats: bool,
}

/// 2⁴⁰
const SECOND: f32 = 1_099_511_627_776.0;

/// 2⁵⁶: the rate of 100 % in the sum.
const WHOLE: f32 = 72_057_594_037_927_936.0;

impl<'a, N: Number> PlanFollower<'a, N> {
    /// Creates a follower at the start of a plan, with a tick of `period` seconds; `ramp` is the time (s) of the rate from 0 to 100 %. The plan must
    /// be for the same model.
    ///
    /// # Errors
    /// A period less than a microsecond, at least a quarter of a second, or at least the length of the plan; a ramp that is negative, not finite,
    /// longer than 1000 s, or shorter than the plan's [`least_ramp`](Plan::least_ramp), if that is finite; a ramp whose acceleration exceeds single
    /// precision, or in fixed point the range of a factor.
    pub fn new(
        plan: Plan<'a, N>,
        period: f32,
        ramp: f32,
        model: &impl MachineUnits<Number = N>,
    ) -> Result<Self, PlanError> {
        positive("the period", period)?;
        let most = plan.duration().min(0.25);
        let range = "from a microsecond on, shorter than the plan, and than a quarter of a second";
        within("the period", period, (1e-6..most).contains(&period), range)?;
        let holds = (0.0..=1000.0).contains(&ramp);
        within("the ramp of the rate", ramp, holds, "from 0 to 1000")?;
        let least = plan.least_ramp();
        let keeps = ramp >= least || least.is_infinite();
        let range = "at least the shortest ramp with which the plan keeps the torque of its drive (Plan::least_ramp)";
        within("the ramp of the rate", ramp, keeps, range)?;
        // Without a ramp, the whole change at once.
        let change = ((period / ramp).min(1.0) * WHOLE) as u64;
        let bits = 64 - change.leading_zeros().cast_signed();
        // The acceleration of a speed of one unit and a change of 2³¹ per tick.
        let per_count = plan.speed_unit() * power_of_two(bits - 56) / period;
        let factor = Factor::of_count(per_count / model.scale().acceleration());
        Ok(Self {
            plan,
            step: (period * SECOND) as u64,
            time: 0,
            rest: 0,
            rate: u64::from(FULL) << FINER,
            change,
            shift: 31 - bits,
            ramp: factor.ok_or(AxisError::OutOfRange {
                what: "the ramp of the rate",
                value: ramp,
                range: "such that a factor holds its acceleration in machine units",
            })?,
            started: false,
            fresh: true,
            repeats: false,
        })
    }

    /// The same, repeated without end or pause. If the plan advances by whole turns, [`turns`](SetPoint::turns) jumps back to that of its start at
    /// each repeat; phase, speed and acceleration continue.
    ///
    /// # Errors
    /// [`PlanError::Open`]: the end is not at the start or whole turns from it, or has another speed.
    pub fn repeating(mut self) -> Result<Self, PlanError> {
        if !self.plan.closes() {
            return Err(PlanError::Open);
        }
        self.repeats = true;
        Ok(self)
    }

    /// The plan.
    #[must_use]
    pub const fn plan(&self) -> &Plan<'a, N> {
        &self.plan
    }

    /// Starts with the next tick, at the rate commanded then; after the end, again from the start.
    pub const fn start(&mut self) {
        self.reset();
        self.started = true;
    }

    /// Returns to the start and waits there.
    pub const fn reset(&mut self) {
        self.time = 0;
        self.rest = 0;
        self.fresh = true;
        self.started = false;
    }

    /// The set-point of this tick; advances the plan by one tick. Until the first movement the rate is the commanded one, without a ramp.
    #[inline]
    pub fn next(&mut self, commanded: Override) -> SetPoint<N> {
        let Override(wanted) = commanded;
        let wanted = u64::from(wanted) << FINER;
        if self.fresh {
            self.rate = wanted;
        }
        let before = self.rate;
        let least = before.saturating_sub(self.change);
        let after = wanted.clamp(least, before.saturating_add(self.change));
        let end = self.plan.end();
        let ended = self.time >= end;
        let mut state = self.plan.state(self.time);
        // Speed that the change of the rate gains in a tick, with the plan's speed at 100 %.
        let moves = self.started && !ended;
        let gain = if moves {
            let changed = after.wrapping_sub(before).cast_signed();
            share(state.speed, shifted(changed, self.shift))
        } else {
            0
        };
        let [rate, next] = [before, after].map(|rate| rate >> UNUSED);
        if self.started {
            let rate = rate.cast_signed();
            state.speed = share(state.speed, rate);
            state.acceleration = share(share(state.acceleration, rate), rate);
        } else {
            state.speed = 0;
            state.acceleration = 0;
        }
        let alpha = N::of_counts([
            (state.acceleration, self.plan.of_acceleration()),
            (gain, &self.ramp),
        ]);
        let place = self.plan.place(state, alpha);
        if moves {
            self.rate = after;
            self.fresh = self.fresh && after == 0;
            // Twice the mean of both rates, at most 2³² in units of 2⁻³²; the tick has 38 bits.
            let sum = rate + next;
            let low = (self.step & u64::from(u32::MAX)) * sum + u64::from(self.rest);
            self.rest = low as u32;
            self.time += (self.step >> 32) * sum + (low >> 32);
            if self.repeats && self.time >= end {
                self.time -= end;
            }
        }
        SetPoint {
            motion: place.value.motion,
            turns: place.value.turns,
            state: match (self.started, ended) {
                (false, _) => PlanState::Waiting,
                (true, true) => PlanState::Done,
                (true, false) if before == 0 && after == 0 => PlanState::Held,
                (true, false) => PlanState::Running,
            },
            limited: place.saturated,
        }
    }
}

/// A share of a count, in units of 2⁻³¹.
#[inline]
fn share(count: i32, share: i64) -> i32 {
    ((i64::from(count) * share) >> 31) as i32
}
