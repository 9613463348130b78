//! The header declares the exported functions.

use core::ffi::{CStr, c_char};
use core::mem::MaybeUninit;

use jred::axis::{Encoder, StrokeEncoder, StrokeMounting, Tracker};

use crate::axis::{OBSERVER_WORDS, jred_tracker_make};
use crate::encoder::{CMounting, jred_encoder_make, jred_stroke_encoder_make};

use crate::follower::{CPlan, CPlanState, WORDS};
use crate::image::{Info, jred_image_info};
use crate::memory::{ANY, POINTERS};
use crate::number::{jred_q15_from_si, jred_q15_to_si, jred_q31_from_si, jred_q31_to_si};
use crate::phase::{jred_phase_from_radians, jred_phase_from_stroke};
use crate::status::{Status, jred_status_name};

const HEADER: &str = include_str!("../../include/jred.h");
const AXIS: &str = include_str!("../../include/jred_axis.h");

/// The type of an argument or a result in C.
trait C {
    const NAME: &'static str;
}

macro_rules! c {
    ($($rust:ty: $c:literal,)*) => { $(impl C for $rust { const NAME: &'static str = $c; })* };
}

c! {
    u32: "uint32_t", i32: "int32_t", i16: "int16_t", f32: "float", usize: "size_t", Status: "jred_status",
    *const u32: "const uint32_t *", *const c_char: "const char *",
    Option<&mut i32>: "int32_t *", Option<&mut i16>: "int16_t *", Option<&mut MaybeUninit<Info>>: "jred_info *",
    Option<&mut MaybeUninit<Encoder>>: "jred_encoder *", Option<&CMounting>: "const jred_mounting *",
    Option<&mut MaybeUninit<Tracker>>: "jred_tracker *",
    Option<&mut MaybeUninit<StrokeEncoder>>: "jred_stroke_encoder *", Option<&StrokeMounting>: "const jred_stroke_mounting *",
}

/// Whether the header declares a function with these types, whatever the names of its arguments.
macro_rules! declared {
    ($name:ident($($argument:ty),* $(,)?) -> $result:ty) => {{
        let _: unsafe extern "C" fn($($argument),*) -> $result = $name;
        let start = format!("{} {}(", <$result as C>::NAME, stringify!($name)).replace("* ", "*");
        let headers = [HEADER, AXIS].concat();
        let (_, rest) = headers.split_once(&start).unwrap_or_else(|| panic!("{start} is not declared"));
        let arguments = rest.split_once(')').unwrap().0.split(", ");
        let arguments: Vec<_> = arguments.map(|text| {
            let name = text.rfind([' ', '*']).unwrap() + 1;
            text[..name].trim_end().to_owned()
        }).collect();
        assert_eq!(arguments, [$(<$argument as C>::NAME),*], "{start}");
    }};
}

#[test]
fn the_header_declares_what_is_exported() {
    type Number<'a, N> = Option<&'a mut N>;
    declared!(jred_status_name(i32) -> *const c_char);
    declared!(jred_encoder_make(Number<MaybeUninit<Encoder>>, Option<&CMounting>) -> Status);
    declared!(
        jred_stroke_encoder_make(
            Number<MaybeUninit<StrokeEncoder>>,
            f32,
            f32,
            Option<&StrokeMounting>,
        ) -> Status
    );
    declared!(jred_tracker_make(Number<MaybeUninit<Tracker>>, f32, f32, u32) -> Status);
    declared!(jred_phase_from_radians(f32) -> u32);
    declared!(jred_phase_from_stroke(f32, f32, f32) -> u32);
    declared!(jred_image_info(*const u32, usize, Number<MaybeUninit<Info>>) -> Status);
    declared!(jred_q31_from_si(f32, f32, Number<i32>) -> Status);
    declared!(jred_q15_from_si(f32, f32, Number<i16>) -> Status);
    declared!(jred_q31_to_si(i32, f32) -> f32);
    declared!(jred_q15_to_si(i16, f32) -> f32);
}

#[test]
fn the_header_has_every_status() {
    for status in Status::ALL {
        let name = status.name().to_str().unwrap();
        let line = format!("    {name} = {}", *status as i32);
        assert!(
            HEADER.lines().any(|l| l
                .split([',', ' ', '/'])
                .collect::<String>()
                .starts_with(&line.replace(' ', ""))),
            "{line}"
        );
        // SAFETY: a string constant.
        let given = unsafe { CStr::from_ptr(jred_status_name(*status as i32)) };
        assert_eq!(given, status.name());
    }
    let (statuses, _) = HEADER.split_once("/* ---- phase").unwrap();
    let listed = statuses
        .lines()
        .filter(|l| l.starts_with("    JRED_") && l.contains(" = "));
    assert_eq!(listed.count(), Status::ALL.len());
    // SAFETY: a string constant.
    let unknown = unsafe { CStr::from_ptr(jred_status_name(99)) };
    assert_eq!(unknown, c"JRED_UNKNOWN");
}

/// Also those of a follower: C would read another one otherwise.
#[test]
fn the_header_has_every_stage() {
    for (name, state) in [
        ("NO_FOLLOWER", CPlanState::NoFollower),
        ("WAITING", CPlanState::Waiting),
        ("RUNNING", CPlanState::Running),
        ("HELD", CPlanState::Held),
        ("DONE", CPlanState::Done),
    ] {
        let value = format!("    JRED_{name} = {}", state as i32);
        assert!(HEADER.contains(&value), "{value}");
    }
}

#[test]
fn the_header_has_the_constants() {
    for (name, value) in [
        ("JRED_MEMORY_POINTERS", POINTERS.to_string()),
        ("JRED_ANY", format!("{ANY:#x}")),
        ("JRED_PLAN_FOLLOWER_WORDS", WORDS.to_string()),
        ("JRED_OBSERVER_WORDS", OBSERVER_WORDS.to_string()),
    ] {
        assert!(
            [HEADER, AXIS]
                .concat()
                .contains(&format!("#define {name} {value}\n")),
            "{name}"
        );
    }
    // One word each, in the order of the header.
    assert_eq!(size_of::<Info>(), 4 * 13);
    assert_eq!(size_of::<CPlan>(), 4 * 8);
}
