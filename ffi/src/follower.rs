//! A plan and its follower, in memory of the caller.

use core::mem::MaybeUninit;

use jred::axis::plan::{Errors, PlanError};
use jred::axis::{Follower, Plan, Planned, Rate, Stage};
use jred::number::Number;
use jred::{MachineUnits, Q15, Q31};

use crate::memory::words;
use crate::number::{CNumber, to_c};
use crate::status::Status;

/// 64-bit words of memory for a follower, as `JRED_FOLLOWER_WORDS` of `jred.h`.
pub(crate) const WORDS: usize = 28;

/// A follower; zeros contain no follower.
#[repr(C)]
pub(crate) struct Follow<N: Number> {
    /// 1; 0 without a follower.
    tag: u64,
    follower: MaybeUninit<Follower<'static, N>>,
}

impl<N: Number> Follow<N> {
    const FITS: () = assert!(
        size_of::<Self>() <= (1 + WORDS) * size_of::<u64>()
            && align_of::<Self>() <= align_of::<u64>()
    );

    /// Creates a follower of a plan for this model; on failure there is no follower.
    ///
    /// # Safety
    /// As [`words`], as long as the follower is ticked.
    pub(crate) unsafe fn follow(
        &mut self,
        address: *const u32,
        length: usize,
        [period, ramp]: [f32; 2],
        model: &impl MachineUnits<Number = N>,
    ) -> Status {
        let () = Self::FITS;
        self.tag = 0;
        // SAFETY: as promised by the caller.
        let words = match unsafe { words(address, length) } {
            Ok(words) => words,
            Err(status) => return status,
        };
        let made =
            Plan::new(words, model).and_then(|plan| Follower::new(plan, period, ramp, model));
        self.keep(made)
    }

    fn keep(&mut self, made: Result<Follower<'static, N>, PlanError>) -> Status {
        match made {
            Ok(follower) => {
                self.follower.write(follower);
                self.tag = 1;
                Status::Ok
            }
            Err(error) => error.into(),
        }
    }

    fn get(&mut self) -> Option<&mut Follower<'static, N>> {
        // SAFETY: zeros or written by `follow`; the tag shows that there is a follower.
        (self.tag == 1).then(|| unsafe { self.follower.assume_init_mut() })
    }
}

/// `jred_stage` in C.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CStage {
    NoFollower = -1,
    Waiting = 0,
    Running = 1,
    Held = 2,
    Done = 3,
}

impl From<Stage> for CStage {
    fn from(stage: Stage) -> Self {
        match stage {
            Stage::Waiting => Self::Waiting,
            Stage::Running => Self::Running,
            Stage::Held => Self::Held,
            Stage::Done => Self::Done,
        }
    }
}

/// `jred_…_planned` in C.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct CPlanned<C> {
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
    most_speed: f32,
    most_acceleration: f32,
    position_error: f32,
    speed_error: f32,
    acceleration_error: f32,
    machine: u32,
}

impl CPlan {
    pub(crate) fn of<N: Number>(plan: &Plan<'_, N>) -> Self {
        let [most_speed, most_acceleration] = plan.most();
        let Errors {
            position,
            speed,
            acceleration,
        } = plan.errors();
        Self {
            rows: plan.rows() as u32,
            duration: plan.duration(),
            most_speed,
            most_acceleration,
            position_error: position,
            speed_error: speed,
            acceleration_error: acceleration,
            machine: plan.machine(),
        }
    }
}

/// The set-point of a tick, and its stage; 0 without a follower.
fn next<N: CNumber>(
    follow: Option<&mut Follow<N>>,
    percent: u32,
    planned: Option<&mut MaybeUninit<CPlanned<N::C>>>,
) -> CStage {
    let found = follow.and_then(Follow::get);
    let (stage, content) = match found {
        Some(follower) => {
            let Planned {
                motion,
                turns,
                stage,
                limited,
            } = follower.next(Rate::percent(percent));
            let content = CPlanned {
                phase: motion.phase.to_bits(),
                turns,
                omega: to_c(motion.omega),
                alpha: to_c(motion.alpha),
                limited,
            };
            (stage.into(), content)
        }
        None => (CStage::NoFollower, CPlanned::default()),
    };
    if let Some(planned) = planned {
        planned.write(content);
    }
    stage
}

fn repeat<N: Number>(follow: Option<&mut Follow<N>>) -> Status {
    let Some(follow) = follow else {
        return Status::Null;
    };
    let Some(follower) = follow.get().copied() else {
        return Status::NotLoaded;
    };
    match follower.repeating() {
        Ok(repeating) => follow.keep(Ok(repeating)),
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
                planned: Option<&mut MaybeUninit<CPlanned<C>>>,
            ) -> CStage {
                super::follower::next(follow, percent, planned)
            }

            #[unsafe(export_name = concat!($prefix, "_start"))]
            extern "C" fn start(follow: Option<&mut Follow<$number>>) {
                if let Some(follower) = follow.and_then(Follow::get) {
                    follower.start();
                }
            }

            #[unsafe(export_name = concat!($prefix, "_reset"))]
            extern "C" fn reset(follow: Option<&mut Follow<$number>>) {
                if let Some(follower) = follow.and_then(Follow::get) {
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

functions!("jred_f32_follower", f32);
functions!("jred_q31_follower", Q31);
functions!("jred_q15_follower", Q15);
