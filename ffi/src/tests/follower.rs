//! A plan is refused, or followed with the same bits as in Rust.

use core::mem::{MaybeUninit, zeroed};
use core::ptr::null;

use jred::axis::plan::{Errors, Knot, encode, image_len};
use jred::axis::{Override, Plan, PlanFollower};
use jred::{CurveSet, Domain, Image, Q15, Q31, Rows16, Spline, include_image};

use super::{PRESS, Press, jred_spline_f32_load, jred_spline_q31_load, press, words};
use crate::follower::{CPlan, CPlanState, CSetPoint, Follow};
use crate::memory::Memory;
use crate::status::Status;

#[allow(
    improper_ctypes,
    reason = "C sees the memory of a model and of a follower as bytes"
)]
unsafe extern "C" {
    fn jred_rows_q15_load(
        memory: *mut Memory<Rows16>,
        set: CurveSet,
        words: *const u32,
        length: usize,
    ) -> i32;
    fn jred_spline_f32_follow(
        memory: *const Press,
        follow: *mut Follow<f32>,
        words: *const u32,
        length: usize,
        period: f32,
        ramp: f32,
    ) -> i32;
    fn jred_spline_q31_follow(
        memory: *const Memory<Spline<Q31>>,
        follow: *mut Follow<Q31>,
        words: *const u32,
        length: usize,
        period: f32,
        ramp: f32,
    ) -> i32;
    fn jred_rows_q15_follow(
        memory: *const Memory<Rows16>,
        follow: *mut Follow<Q15>,
        words: *const u32,
        length: usize,
        period: f32,
        ramp: f32,
    ) -> i32;
    fn jred_f32_plan_follower_start(follow: *mut Follow<f32>);
    fn jred_f32_plan_follower_reset(follow: *mut Follow<f32>);
    fn jred_f32_plan_follower_repeat(follow: *mut Follow<f32>) -> i32;
    fn jred_f32_plan_follower_next(
        follow: *mut Follow<f32>,
        percent: u32,
        planned: *mut CSetPoint<f32>,
    ) -> CPlanState;
    fn jred_f32_plan_follower_plan(follow: *mut Follow<f32>, plan: *mut MaybeUninit<CPlan>) -> i32;
    fn jred_q31_plan_follower_start(follow: *mut Follow<Q31>);
    fn jred_q31_plan_follower_next(
        follow: *mut Follow<Q31>,
        percent: u32,
        planned: *mut CSetPoint<i32>,
    ) -> CPlanState;
    fn jred_q15_plan_follower_start(follow: *mut Follow<Q15>);
    fn jred_q15_plan_follower_next(
        follow: *mut Follow<Q15>,
        percent: u32,
        planned: *mut CSetPoint<i16>,
    ) -> CPlanState;
}

/// The plan of the press.
fn plan() -> Vec<u32> {
    words(include_image!("../../../examples/data/press_plan.jred"))
}

/// The operator's command in a tick (%).
fn commanded(tick: u32) -> u32 {
    match tick {
        300..500 => 40,
        500..700 => 0,
        _ => 100,
    }
}

macro_rules! same_bits {
    ($name:ident, $format:ty, $number:ty, $c:ty, $image:literal, $load:ident, $follow:ident, $start:ident, $next:ident) => {
        #[test]
        fn $name() {
            let (words, plan) = (words(include_image!($image)), plan());
            let model = Image::new(&words).unwrap().any_model::<$format>().unwrap();
            let read = Plan::new(&plan, &model).unwrap();
            let mut rust = PlanFollower::new(read, 5e-4, 0.13, &model).unwrap();
            rust.start();
            // SAFETY: zeros are no model and no follower; the words outlive both.
            unsafe {
                let mut memory: Memory<$format> = zeroed();
                let mut follow: Follow<$number> = zeroed();
                assert_eq!(
                    $load(&raw mut memory, PRESS, words.as_ptr(), words.len()),
                    0
                );
                let (address, length) = (plan.as_ptr(), plan.len());
                assert_eq!(
                    $follow(
                        &raw const memory,
                        &raw mut follow,
                        address,
                        length,
                        5e-4,
                        0.13
                    ),
                    0
                );
                $start(&raw mut follow);
                let mut ended = 0;
                for tick in 0..2000 {
                    let mut found = CSetPoint::<$c>::default();
                    let state = $next(&raw mut follow, commanded(tick), &raw mut found);
                    let expected = rust.next(Override::percent(commanded(tick)));
                    assert_eq!(state, expected.state.into(), "{tick}");
                    let expected = CSetPoint {
                        phase: expected.motion.phase.to_bits(),
                        turns: expected.turns,
                        omega: crate::number::to_c(expected.motion.omega),
                        alpha: crate::number::to_c(expected.motion.alpha),
                        limited: expected.limited,
                    };
                    assert_eq!(found, expected, "{tick}");
                    ended += u32::from(state == CPlanState::Done);
                }
                assert!(ended > 100, "{ended}");
            }
        }
    };
}

same_bits!(
    a_follower_in_single_precision_has_the_bits_of_rust,
    Spline<f32>,
    f32,
    f32,
    "../../../examples/data/press_f32.jred",
    jred_spline_f32_load,
    jred_spline_f32_follow,
    jred_f32_plan_follower_start,
    jred_f32_plan_follower_next
);
same_bits!(
    a_follower_in_q31_has_the_bits_of_rust,
    Spline<Q31>,
    Q31,
    i32,
    "../../../examples/data/press_q31.jred",
    jred_spline_q31_load,
    jred_spline_q31_follow,
    jred_q31_plan_follower_start,
    jred_q31_plan_follower_next
);
same_bits!(
    a_follower_in_q15_has_the_bits_of_rust,
    Rows16,
    Q15,
    i16,
    "../../../examples/bits/data/q15_rows.jred",
    jred_rows_q15_load,
    jred_rows_q15_follow,
    jred_q15_plan_follower_start,
    jred_q15_plan_follower_next
);

#[test]
fn what_is_no_plan_is_refused() {
    let (image, plan) = (press(), plan());
    let status = |status: Status| status as i32;
    // SAFETY: zeros are no model and no follower; null pointers are allowed; the words outlive both.
    unsafe {
        let (mut memory, mut follow): (Press, Follow<f32>) = (zeroed(), zeroed());
        let follow = &raw mut follow;
        let no_model: Press = zeroed();
        let length = plan.len();
        let with = |memory: *const Press, words: *const u32, length, period, ramp| {
            jred_spline_f32_follow(memory, follow, words, length, period, ramp)
        };
        assert_eq!(
            with(&raw const no_model, plan.as_ptr(), length, 1e-3, 0.1),
            status(Status::NotLoaded)
        );
        assert_eq!(
            jred_spline_f32_load(&raw mut memory, PRESS, image.as_ptr(), image.len()),
            0
        );
        let memory = &raw const memory;
        let refused = |words: &[u32], length, period, ramp| {
            with(memory, words.as_ptr(), length, period, ramp)
        };
        assert_eq!(
            with(null(), plan.as_ptr(), length, 1e-3, 0.1),
            status(Status::Null)
        );
        assert_eq!(
            with(memory, null(), length, 1e-3, 0.1),
            status(Status::Null)
        );
        assert_eq!(
            with(memory, plan.as_ptr().byte_add(2), length - 1, 1e-3, 0.1),
            status(Status::Misaligned)
        );
        for short in [0, 1, 16, length - 1] {
            assert_eq!(
                refused(&plan, short, 1e-3, 0.1),
                status(Status::Length),
                "{short}"
            );
        }
        assert_eq!(
            refused(&image, image.len(), 1e-3, 0.1),
            status(Status::NotAPlan)
        );
        for bit in 0..32 * length {
            let mut damaged = plan.clone();
            damaged[bit / 32] ^= 1 << (bit % 32);
            assert!(refused(&damaged, length, 1e-3, 0.1) > 1, "bit {bit}");
        }
        for (period, ramp) in [
            (0.0, 0.1),
            (f32::NAN, 0.1),
            (1.0, 0.1),
            (1e-3, -1.0),
            (1e-3, f32::INFINITY),
        ] {
            assert_eq!(
                refused(&plan, length, period, ramp),
                status(Status::Figure),
                "{period} {ramp}"
            );
        }
    }
}

#[test]
fn a_follower_is_none_before_it_is_made() {
    let (image, plan) = (press(), plan());
    let status = |status: Status| status as i32;
    // SAFETY: as above.
    unsafe {
        let (mut memory, mut follow): (Press, Follow<f32>) = (zeroed(), zeroed());
        let (memory, follow, length) = (&raw mut memory, &raw mut follow, plan.len());
        assert_eq!(
            jred_spline_f32_load(memory, PRESS, image.as_ptr(), image.len()),
            0
        );
        let refused = |words: &[u32], length, period, ramp| {
            jred_spline_f32_follow(memory, follow, words.as_ptr(), length, period, ramp)
        };
        assert_eq!(
            refused(&plan, length - 1, 1e-3, 0.1),
            status(Status::Length)
        );
        // After a failed creation there is no follower.
        let mut found = CSetPoint::default();
        assert_eq!(
            jred_f32_plan_follower_next(follow, 100, &raw mut found),
            CPlanState::NoFollower
        );
        assert_eq!(found, CSetPoint::default());
        assert_eq!(
            jred_f32_plan_follower_repeat(follow),
            status(Status::NotLoaded)
        );
        let mut figures = MaybeUninit::uninit();
        assert_eq!(
            jred_f32_plan_follower_plan(follow, &raw mut figures),
            status(Status::NotLoaded)
        );
        jred_f32_plan_follower_start(follow);

        assert_eq!(refused(&plan, length, 1e-3, 0.1), 0);
        // The stroke of the press and a rest end a turn later, at rest.
        jred_f32_plan_follower_start(follow);
        assert_eq!(
            jred_f32_plan_follower_next(follow, 100, &raw mut found),
            CPlanState::Running
        );
        jred_f32_plan_follower_reset(follow);
        assert_eq!(
            jred_f32_plan_follower_next(follow, 100, &raw mut found),
            CPlanState::Waiting
        );
        let read = Image::new(&image)
            .unwrap()
            .any_model::<Spline<f32>>()
            .unwrap();
        let read = Plan::new(&plan, &read).unwrap();
        assert_eq!(jred_f32_plan_follower_plan(follow, &raw mut figures), 0);
        assert_eq!(figures.assume_init(), CPlan::of(&read));
        assert_eq!(jred_f32_plan_follower_repeat(follow), 0);
        let open = [(0.0, 0.0), (1.0, 1.0)].map(|(t, position)| Knot {
            t,
            position,
            ..Knot::default()
        });
        let mut words = vec![0; image_len(2)];
        encode(&open, Domain::Turn, 0, Errors::default(), &mut words).unwrap();
        assert_eq!(refused(&words, words.len(), 1e-3, 0.1), 0);
        assert_eq!(jred_f32_plan_follower_repeat(follow), status(Status::Open));
        // Without a follower and without memory.
        assert_eq!(
            jred_f32_plan_follower_next(core::ptr::null_mut(), 100, core::ptr::null_mut()),
            CPlanState::NoFollower
        );
        assert_eq!(
            jred_f32_plan_follower_repeat(core::ptr::null_mut()),
            status(Status::Null)
        );
        jred_f32_plan_follower_start(core::ptr::null_mut());
    }
}
