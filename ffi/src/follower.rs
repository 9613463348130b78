//! A plan and its follower, in memory of the caller.

use core::mem::MaybeUninit;

use jred::axis::plan::Errors;
use jred::axis::{MachineUnits, Override, Plan, PlanFollower, PlanState, SetPoint};
use jred::number::Number;
use jred::{Q15, Q31};

use crate::memory::{Held, words};
use crate::number::{CNumber, to_c};
use crate::status::Status;

/// 64-bit words of memory for a follower, as `JRED_PLAN_FOLLOWER_WORDS` of `jred.h`.
pub(crate) const WORDS: usize = 28;

/// A follower in memory of the caller.
pub(crate) type Follow<N> = Held<PlanFollower<'static, N>, WORDS>;

/// Creates a follower of a plan for this model; on failure there is no follower.
///
/// # Safety
/// As [`words`], as long as the follower is ticked.
pub(crate) unsafe fn follow<N: Number>(
    memory: &mut Follow<N>,
    address: *const u32,
    length: usize,
    [period, ramp]: [f32; 2],
    model: &impl MachineUnits<Number = N>,
) -> Status {
    // SAFETY: as promised by the caller.
    let made = unsafe { words(address, length) }.and_then(|words| {
        let plan = Plan::new(words, model)?;
        Ok(PlanFollower::new(plan, period, ramp, model)?)
    });
    Held::keep(Some(memory), made)
}

/// `jred_plan_state` in C.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CPlanState {
    NoFollower = -1,
    Waiting = 0,
    Running = 1,
    Held = 2,
    Done = 3,
}

impl From<PlanState> for CPlanState {
    fn from(state: PlanState) -> Self {
        match state {
            PlanState::Waiting => Self::Waiting,
            PlanState::Running => Self::Running,
            PlanState::Held => Self::Held,
            PlanState::Done => Self::Done,
        }
    }
}

/// `jred_…_set_point` in C.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct CSetPoint<C> {
    pub(crate) phase: u32,
    pub(crate) turns: i32,
    pub(crate) omega: C,
    pub(crate) alpha: C,
    pub(crate) limited: bool,
}

/// `jred_plan` in C.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CPlan {
    rows: u32,
    duration: f32,
    max_speed: f32,
    max_acceleration: f32,
    position_error: f32,
    speed_error: f32,
    acceleration_error: f32,
    machine: u32,
}

impl CPlan {
    pub(crate) fn of<N: Number>(plan: &Plan<'_, N>) -> Self {
        let Errors {
            position,
            speed,
            acceleration,
        } = plan.errors();
        Self {
            rows: plan.rows() as u32,
            duration: plan.duration(),
            max_speed: plan.max_speed(),
            max_acceleration: plan.max_acceleration(),
            position_error: position,
            speed_error: speed,
            acceleration_error: acceleration,
            machine: plan.machine(),
        }
    }
}

/// The set-point of a tick, and its state; 0 without a follower.
fn next<N: CNumber>(
    follow: Option<&mut Follow<N>>,
    percent: u32,
    planned: Option<&mut MaybeUninit<CSetPoint<N::C>>>,
) -> CPlanState {
    let found = follow.and_then(Held::get);
    let (state, content) = match found {
        Some(follower) => {
            let SetPoint {
                motion,
                turns,
                state,
                limited,
            } = follower.next(Override::percent(percent));
            let content = CSetPoint {
                phase: motion.phase.to_bits(),
                turns,
                omega: to_c(motion.omega),
                alpha: to_c(motion.alpha),
                limited,
            };
            (state.into(), content)
        }
        None => (CPlanState::NoFollower, CSetPoint::default()),
    };
    if let Some(planned) = planned {
        planned.write(content);
    }
    state
}

fn repeat<N: Number>(follow: Option<&mut Follow<N>>) -> Status {
    let Some(follow) = follow else {
        return Status::Null;
    };
    let Some(follower) = follow.get() else {
        return Status::NotLoaded;
    };
    match follower.repeating() {
        Ok(repeating) => {
            *follower = repeating;
            Status::Ok
        }
        Err(error) => error.into(),
    }
}

fn plan<N: Number>(
    follow: Option<&mut Follow<N>>,
    plan: Option<&mut MaybeUninit<CPlan>>,
) -> Status {
    let (Some(follow), Some(plan)) = (follow, plan) else {
        return Status::Null;
    };
    let Some(follower) = follow.get() else {
        return Status::NotLoaded;
    };
    plan.write(CPlan::of(follower.plan()));
    Status::Ok
}

macro_rules! functions {
    ($prefix:literal, $number:ty) => {
        const _: () = {
            type C = <$number as CNumber>::C;

            #[unsafe(export_name = concat!($prefix, "_next"))]
            extern "C" fn next(
                follow: Option<&mut Follow<$number>>,
                percent: u32,
                planned: Option<&mut MaybeUninit<CSetPoint<C>>>,
            ) -> CPlanState {
                super::follower::next(follow, percent, planned)
            }

            #[unsafe(export_name = concat!($prefix, "_start"))]
            extern "C" fn start(follow: Option<&mut Follow<$number>>) {
                if let Some(follower) = follow.and_then(Held::get) {
                    follower.start();
                }
            }

            #[unsafe(export_name = concat!($prefix, "_reset"))]
            extern "C" fn reset(follow: Option<&mut Follow<$number>>) {
                if let Some(follower) = follow.and_then(Held::get) {
                    follower.reset();
                }
            }

            #[unsafe(export_name = concat!($prefix, "_repeat"))]
            extern "C" fn repeat(follow: Option<&mut Follow<$number>>) -> Status {
                super::follower::repeat(follow)
            }

            #[unsafe(export_name = concat!($prefix, "_plan"))]
            extern "C" fn plan(
                follow: Option<&mut Follow<$number>>,
                plan: Option<&mut MaybeUninit<CPlan>>,
            ) -> Status {
                super::follower::plan(follow, plan)
            }
        };
    };
}

functions!("jred_f32_plan_follower", f32);
functions!("jred_q31_plan_follower", Q31);
functions!("jred_q15_plan_follower", Q15);
