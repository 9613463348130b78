//! Numbers and phases.

use jred::Phase;

use crate::number::{jred_q15_from_si, jred_q15_to_si, jred_q31_from_si, jred_q31_to_si};
use crate::phase::{jred_phase_from_radians, jred_phase_from_stroke};
use crate::status::Status;

#[test]
fn numbers_and_phases_of_no_number_are_stated() {
    let (mut long, mut short) = (7, 7);
    for (si, base) in [
        (f32::NAN, 10.0),
        (1.0, f32::NAN),
        (0.0, 0.0),
        (f32::INFINITY, f32::INFINITY),
    ] {
        assert_eq!(jred_q31_from_si(si, base, Some(&mut long)), Status::Limited);
        assert_eq!(
            jred_q15_from_si(si, base, Some(&mut short)),
            Status::Limited
        );
        assert_eq!((long, short), (0, 0), "{si} {base}");
    }
    assert_eq!(jred_q31_from_si(1.0, 0.0, Some(&mut long)), Status::Limited);
    assert_eq!(long, i32::MAX);
    for (position, from, to) in [(f32::NAN, 0.0, 1.0), (0.5, f32::NAN, 1.0), (0.0, 0.0, 0.0)] {
        assert_eq!(jred_phase_from_stroke(position, from, to), 0);
    }
    assert_eq!(jred_phase_from_stroke(-1.0, 0.0, 1.0), 0);
    assert_eq!(jred_phase_from_radians(f32::NAN), 0);
    assert_eq!(jred_phase_from_radians(f32::INFINITY), 0);
}

#[test]
fn numbers_beyond_the_range_are_limited() {
    let mut number = 0;
    assert_eq!(jred_q31_from_si(5.0, 10.0, Some(&mut number)), Status::Ok);
    assert_eq!(number, 1 << 30);
    assert_eq!(jred_q31_to_si(number, 10.0).to_bits(), 5f32.to_bits());
    assert_eq!(
        jred_q31_from_si(-11.0, 10.0, Some(&mut number)),
        Status::Limited
    );
    assert_eq!(number, i32::MIN);
    assert_eq!(jred_q31_from_si(1.0, 10.0, None), Status::Null);
    let mut number = 0;
    assert_eq!(
        jred_q15_from_si(11.0, 10.0, Some(&mut number)),
        Status::Limited
    );
    assert_eq!(number, i16::MAX);
    assert_eq!(jred_q15_to_si(1 << 14, 10.0).to_bits(), 5f32.to_bits());
}

#[test]
fn phases_are_those_of_rust() {
    assert_eq!(
        jred_phase_from_radians(1.5),
        Phase::from_radians_f32(1.5).to_bits()
    );
    assert_eq!(jred_phase_from_stroke(0.5, 0.0, 1.0), 1 << 31);
    assert_eq!(jred_phase_from_stroke(2.0, 0.0, 1.0), u32::MAX);
}

#[test]
fn the_range_of_motion_is_that_of_an_image_and_nothing_else() {
    use crate::image::{Info, jred_image_info};
    use crate::number::{
        CMotionRange, jred_f32_motion_range_of, jred_q15_motion_range_of, jred_q31_motion_range_of,
    };
    use core::mem::MaybeUninit;

    let words = super::press();
    let mut info = MaybeUninit::<Info>::uninit();
    // SAFETY: words and their number.
    let read = unsafe { jred_image_info(words.as_ptr(), words.len(), Some(&mut info)) };
    assert_eq!(read, Status::Ok);
    // SAFETY: it was written.
    let info = unsafe { info.assume_init() };
    let mut range = MaybeUninit::uninit();
    let made = jred_f32_motion_range_of(Some(&info), Some(&mut range));
    assert_eq!(made, Status::Ok);
    // SAFETY: it was written.
    let found: CMotionRange<f32> = unsafe { range.assume_init() };
    // 29.4524 rad/s and 226.725 rad/s², plus one hundredth.
    assert!(
        (found.max_speed - 1.01 * 29.4524).abs() < 1e-3
            && (found.max_acceleration - 1.01 * 226.725).abs() < 1e-2
    );
    // Invalid bases, and null pointers: only rest.
    assert_eq!(
        jred_f32_motion_range_of(None, Some(&mut range)),
        Status::Null
    );
    // SAFETY: it is always written.
    assert_eq!(unsafe { range.assume_init() }, CMotionRange::default());
    assert_eq!(jred_f32_motion_range_of(Some(&info), None), Status::Null);
    assert_eq!(jred_q31_motion_range_of(Some(&info), None), Status::Null);
    assert_eq!(jred_q15_motion_range_of(Some(&info), None), Status::Null);
}
