//! A plan followed tick by tick, at its own pace or slower.

use super::error::{positive, within};
use super::plan::{Plan, PlanError};
use super::{Motion, Period};
use crate::MachineUnits;
use crate::number::{Number, Quantity as _};

/// How fast a plan is followed, as a share of its own pace: the override of a machine tool.
///
/// ```
/// use jred::axis::Rate;
///
/// assert_eq!(Rate::percent(100), Rate::FULL);
/// assert_eq!(Rate::percent(250), Rate::FULL);
/// assert_eq!(Rate::percent(0), Rate::STILL);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Rate(u32);

/// 100 %.
const FULL: u32 = 1 << 24;

impl Rate {
    /// As planned.
    pub const FULL: Self = Self(FULL);
    /// Hold.
    pub const STILL: Self = Self(0);

    /// So many per cent; more than 100 are 100, because a faster motion than the planned one may not keep its limits.
    #[must_use]
    pub const fn percent(percent: u32) -> Self {
        if percent >= 100 {
            Self::FULL
        } else {
            Self((percent << 24) / 100)
        }
    }
}

/// How far a plan has been followed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Stage {
    /// Not started: at its start.
    #[default]
    Waiting,
    /// On its way.
    Running,
    /// On its way, with the rate 0.
    Held,
    /// At its end, where it stays: if the plan ends with a speed, which the set-point still has, at the last rate, something else must go on.
    Done,
}

/// The set-point of a tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Planned<N: Number> {
    /// Position, speed and acceleration.
    pub motion: Motion<N>,
    /// Whole turns since φ = 0; 0 on a stroke.
    pub turns: i32,
    /// How far.
    pub stage: Stage,
    /// In fixed point a number was limited: with the acceleration that a change of the rate takes it is beyond its base.
    pub limited: bool,
}

/// Follows a [`Plan`] tick by tick, with a rate that may change.
///
/// With the rate r the time s of the plan goes by as ds/dt = r, so that
///
/// ```text
/// φ = φ_plan(s),   ω = r·ω_plan(s),   α = r²·α_plan(s) + dr/dt·ω_plan(s)
/// ```
///
/// The rate goes to the commanded one in a straight line, so that the speed has no steps; the acceleration has that of the ramp. At a constant rate r the torque
/// of a machine without viscous friction lies between those of the plan and of standstill, where the load is that of the position alone. A change of the rate takes J·ω·dr/dt more: a drive that
/// the plan uses fully has that only where the rate falls while the plan drives, or rises while it brakes.
///
/// The time is exact to 2⁻⁴⁰ s a tick (test `a_follower_is_on_time`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Follower<'a, N> {
    plan: Plan<'a, N>,
    period: Period<N>,
    /// A tick, and the time of the plan, in units of 2⁻⁴⁰ s.
    step: u64,
    time: u64,
    /// The rate, and what it changes in a tick at most.
    rate: u32,
    change: u32,
    started: bool,
    /// It has not moved: the rate is that which is commanded.
    fresh: bool,
    repeats: bool,
}

/// 2⁴⁰
const SECOND: f32 = 1_099_511_627_776.0;

impl<'a, N: Number> Follower<'a, N> {
    /// At the start of a plan, with a tick of `period` seconds; `ramp` is the time (s) that the rate takes from 0 to 100 %. The plan must be for the same model.
    ///
    /// # Errors
    /// A period that [`Period::new`] refuses, more than a quarter of a second or as long as the plan; a ramp that is negative, not finite or longer than 1000 s.
    pub fn new(
        plan: Plan<'a, N>,
        period: f32,
        ramp: f32,
        model: &impl MachineUnits<Number = N>,
    ) -> Result<Self, PlanError> {
        positive("the period", period)?;
        let most = plan.duration().min(0.25);
        let range = "shorter than the plan, and than a quarter of a second";
        within("the period", period, period < most, range)?;
        let holds = (0.0..=1000.0).contains(&ramp);
        within("the ramp of the rate", ramp, holds, "from 0 to 1000")?;
        // Of no ramp all at once; of a long one at least a unit.
        let change = (period / ramp).min(1.0) * FULL as f32;
        Ok(Self {
            plan,
            period: Period::new(period, model)?,
            step: (period * SECOND) as u64,
            time: 0,
            rate: FULL,
            change: (change as u32).max(1),
            started: false,
            fresh: true,
            repeats: false,
        })
    }

    /// The same, again and again without a pause, in cycles of its length.
    ///
    /// # Errors
    /// [`PlanError::Open`]: its end is not its start, or whole turns from it, or has another speed.
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

    /// Begins with the next tick, at the rate that is commanded then; after the end once more from the start.
    pub const fn start(&mut self) {
        self.reset();
        self.started = true;
    }

    /// Back to the start, where it waits.
    pub const fn reset(&mut self) {
        self.time = 0;
        self.fresh = true;
        self.started = false;
    }

    /// The set-point now; a tick later it is further on. While it waits the rate is that which is commanded.
    #[inline]
    pub fn next(&mut self, commanded: Rate) -> Planned<N> {
        let Rate(wanted) = commanded;
        if self.fresh {
            self.rate = wanted;
        }
        let before = self.rate;
        let least = before.saturating_sub(self.change);
        let after = wanted.clamp(least, before.saturating_add(self.change));
        let end = self.plan.end();
        let ended = self.time >= end;
        let mut state = self.plan.state(self.time);
        // Of the plan at a rate of 100 %: the speed that the change of the rate gains in a tick.
        let moves = self.started && !ended;
        let gain = if moves {
            share(state.speed, after.cast_signed() - before.cast_signed())
        } else {
            0
        };
        if self.started {
            state.speed = share(state.speed, before.cast_signed());
            state.acceleration = share(
                share(state.acceleration, before.cast_signed()),
                before.cast_signed(),
            );
        } else {
            state.speed = 0;
            state.acceleration = 0;
        }
        let place = self.plan.place(state);
        let ramp = self.period.needed(self.plan.gained(gain));
        let alpha = place.value.motion.alpha.plus(ramp.value);
        if moves {
            self.rate = after;
            self.fresh = self.fresh && after == 0;
            // The mean of both rates, in units of 2⁻²⁵: 38 bits times 25.
            self.time += (self.step * u64::from(before + after)) >> 25;
            if self.repeats && self.time >= end {
                self.time -= end;
            }
        }
        Planned {
            motion: Motion {
                alpha: alpha.value,
                ..place.value.motion
            },
            turns: place.value.turns,
            stage: match (self.started, ended) {
                (false, _) => Stage::Waiting,
                (true, true) => Stage::Done,
                (true, false) if before == 0 && after == 0 => Stage::Held,
                (true, false) => Stage::Running,
            },
            limited: place.saturated || ramp.saturated || alpha.saturated,
        }
    }
}

/// A share of a count, in units of 2⁻²⁴.
#[inline]
fn share(count: i32, share: i32) -> i32 {
    ((i64::from(count) * i64::from(share)) >> 24) as i32
}
