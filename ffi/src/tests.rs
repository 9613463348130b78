//! The header says what is exported; an image is refused or ticked with the bits of Rust.

use core::ffi::{CStr, c_char};
use core::mem::zeroed;
use core::ptr::{null, null_mut};
use std::collections::BTreeSet;

use jred::harmonic::terms;
use jred::image::{encode, image_len};
use jred::table::{Format, Shape};
use jred::{
    Cubic, Harmonic, Image, Model, Phase, Q31, Quadratic, Rows16, Set, SliderCrankForm, Spline,
    Spline16, Table, Validity, curves, include_image,
};

use crate::image::{Info, jred_image_info};
use crate::memory::{ANY, Memory, POINTERS};
use crate::number::{jred_q15_from_si, jred_q15_to_si, jred_q31_from_si, jred_q31_to_si};
use crate::phase::{jred_phase_from_counts, jred_phase_from_radians, jred_phase_from_stroke};
use crate::status::{Status, jred_status_name};

const HEADER: &str = include_str!("../include/jred.h");
const PRESS: Set = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;

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
    Option<&mut i32>: "int32_t *", Option<&mut i16>: "int16_t *", Option<&mut core::mem::MaybeUninit<Info>>: "jred_info *",
}

/// Whether the header declares a function so, whatever its arguments are called.
macro_rules! declared {
    ($name:ident($($argument:ty),*) -> $result:ty) => {{
        let _: unsafe extern "C" fn($($argument),*) -> $result = $name;
        let start = format!("{} {}(", <$result as C>::NAME, stringify!($name)).replace("* ", "*");
        let (_, rest) = HEADER.split_once(&start).unwrap_or_else(|| panic!("{start} is not declared"));
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
    declared!(jred_phase_from_counts(u32, u32) -> u32);
    declared!(jred_phase_from_radians(f32) -> u32);
    declared!(jred_phase_from_stroke(f32, f32, f32) -> u32);
    declared!(jred_image_info(*const u32, usize, Number<core::mem::MaybeUninit<Info>>) -> Status);
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
    let listed = HEADER
        .lines()
        .filter(|l| l.starts_with("    JRED_") && l.contains(" = "));
    assert_eq!(listed.count(), Status::ALL.len());
    // SAFETY: a string constant.
    let unknown = unsafe { CStr::from_ptr(jred_status_name(99)) };
    assert_eq!(unknown, c"JRED_UNKNOWN");
}

#[test]
fn the_header_has_the_constants() {
    for (name, value) in [
        ("JRED_MEMORY_POINTERS", POINTERS.to_string()),
        ("JRED_ANY", format!("{ANY:#x}")),
    ] {
        assert!(
            HEADER.contains(&format!("#define {name} {value}\n")),
            "{name}"
        );
    }
    // One word each, in the order of the header.
    assert_eq!(size_of::<Info>(), 4 * 13);
}

/// The sets in a list of `families.rs`, which begins after the first `start`.
fn listed(start: &str) -> BTreeSet<Set> {
    let (_, rest) = include_str!("families.rs").split_once(start).unwrap();
    let list = rest.split_once("not(few_sets)").unwrap().1;
    let list = list.split_once('[').unwrap().1.split_once(']').unwrap().0;
    let list = list.strip_prefix("cfg").unwrap_or(list);
    list.split_whitespace()
        .map(|set| set.parse().unwrap())
        .collect()
}

fn accepted<F: Format>(sets: core::ops::Range<u32>) -> BTreeSet<Set> {
    sets.map(|set| set as Set)
        .filter(|set| F::accepts(*set))
        .collect()
}

#[test]
fn every_set_of_polynomials_has_a_family() {
    let float = listed("macro_rules! polynomials");
    assert_eq!(float.len(), 18);
    for format in [
        accepted::<Spline<f32>>,
        accepted::<Cubic<f32>>,
        accepted::<Quadratic<f32>>,
    ] {
        assert_eq!(format(0..1024), float);
    }
    let fixed = listed("$number:ty, reciprocal)");
    assert_eq!(fixed.len(), 36);
    for format in [
        accepted::<Spline<Q31>>,
        accepted::<Cubic<Q31>>,
        accepted::<Quadratic<Q31>>,
        accepted::<Spline16>,
        accepted::<Rows16>,
    ] {
        assert_eq!(format(0..1024), fixed);
    }
}

#[test]
fn harmonics_with_constant_friction_have_a_family() {
    let families = listed("// Of harmonics");
    let has = |set: Set, bits: Set| set & bits != 0;
    let meant = accepted::<Harmonic<f32>>(0..1 << 16)
        .into_iter()
        .filter(|set| {
            let load = terms::LOAD_COS | terms::LOAD_SIN;
            let others = terms::ALL & !(terms::INERTIA_COS | terms::INERTIA_SIN | load);
            !has(*set, curves::VISCOUS | curves::COULOMB | others)
                && (has(*set, curves::LOAD) || !has(*set, load))
        });
    assert_eq!(families, meant.collect());
}

#[test]
fn slider_cranks_with_plain_loads_have_a_family() {
    use jred::slider_crank::terms;
    let meant = accepted::<SliderCrankForm>(0..1 << 16)
        .into_iter()
        .filter(|set| {
            let others = terms::ALL & !(terms::LOAD_SIN | terms::LOAD_COS);
            set & (curves::VISCOUS | others) == 0
        });
    assert_eq!(listed("// Of a slider-crank"), meant.collect());
}

#[allow(improper_ctypes, reason = "C sees the memory of a model as bytes")]
unsafe extern "C" {
    fn jred_spline_f32_load(memory: *mut Press, set: Set, words: *const u32, length: usize) -> i32;
    fn jred_cubic_f32_load(
        memory: *mut Memory<Cubic<f32>>,
        set: Set,
        words: *const u32,
        length: usize,
    ) -> i32;
    fn jred_spline_q31_load(
        memory: *mut Memory<Spline<Q31>>,
        set: Set,
        words: *const u32,
        length: usize,
    ) -> i32;
    fn jred_spline_f32_s21_torque(memory: *const Press, phase: u32, omega: f32, alpha: f32) -> f32;
    fn jred_spline_f32_s21_acceleration(
        memory: *const Press,
        phase: u32,
        omega: f32,
        torque: f32,
    ) -> f32;
    fn jred_spline_f32_any_torque(memory: *const Press, phase: u32, omega: f32, alpha: f32) -> f32;
    fn jred_slider_crank_f32_load(
        memory: *mut Crank,
        set: Set,
        words: *const u32,
        length: usize,
    ) -> i32;
    fn jred_slider_crank_f32_s49_torque(
        memory: *const Crank,
        phase: u32,
        omega: f32,
        alpha: f32,
    ) -> f32;
    fn jred_slider_crank_f32_any_torque(
        memory: *const Crank,
        phase: u32,
        omega: f32,
        alpha: f32,
    ) -> f32;
    fn jred_slider_crank_f32_s49_acceleration(
        memory: *const Crank,
        phase: u32,
        omega: f32,
        torque: f32,
    ) -> f32;
}

type Crank = Memory<SliderCrankForm>;
type Press = Memory<Spline<f32>>;

/// The image of the press.
fn press() -> Vec<u32> {
    let (words, _) = include_image!("../../examples/data/press_f32.jred").as_chunks();
    words.iter().map(|word| u32::from_le_bytes(*word)).collect()
}

#[test]
fn a_tick_through_c_has_the_bits_of_one_in_rust() {
    let words = press();
    let model: Model<'_, Spline<f32>, PRESS> = Image::new(&words).unwrap().model().unwrap();
    // SAFETY: zeros are no model; the words outlive it.
    unsafe {
        let mut memory: Press = zeroed();
        assert_eq!(
            jred_spline_f32_load(&raw mut memory, PRESS, words.as_ptr(), words.len()),
            0
        );
        for k in 0..1000u32 {
            let phase = k.wrapping_mul(4_294_967);
            let (omega, alpha) = (k as f32 * 0.03 - 15.0, 200.0 - k as f32 * 0.41);
            let torque = model.torque(Phase::from_bits(phase), omega, alpha);
            let back = model
                .acceleration(Phase::from_bits(phase), omega, torque)
                .value;
            let same = |a: f32, b: f32| assert_eq!(a.to_bits(), b.to_bits(), "{k}");
            same(
                jred_spline_f32_s21_torque(&raw const memory, phase, omega, alpha),
                torque,
            );
            same(
                jred_spline_f32_any_torque(&raw const memory, phase, omega, alpha),
                torque,
            );
            same(
                jred_spline_f32_s21_acceleration(&raw const memory, phase, omega, torque),
                back,
            );
        }
    }
}

#[test]
fn what_is_no_image_of_the_model_is_refused() {
    let words = press();
    let (address, length) = (words.as_ptr(), words.len());
    let status = |status: Status| status as i32;
    let damaged = |word: usize, bit: u32| {
        let mut words = words.clone();
        words[word] ^= bit;
        words
    };
    // SAFETY: zeros are no model; null pointers are allowed; the words outlive the models.
    unsafe {
        let (mut memory, mut cubic, mut fixed): (Press, _, _) = (zeroed(), zeroed(), zeroed());
        let mut load = |set, words: *const u32, length| {
            jred_spline_f32_load(&raw mut memory, set, words, length)
        };
        assert_eq!(load(PRESS, null(), length), status(Status::Null));
        assert_eq!(
            load(PRESS, address.byte_add(2), length - 1),
            status(Status::Misaligned)
        );
        for short in [0, 1, 24, length - 1] {
            assert_eq!(
                load(PRESS, address, short),
                status(Status::Length),
                "{short}"
            );
        }
        assert_eq!(load(curves::LOAD, address, length), status(Status::Set));
        assert_eq!(load(ANY, address, length), 0);
        for (word, bit, expected) in [
            (0, 1, Status::NotAnImage),
            (1, 1, Status::Version),
            (2, 1, Status::Length),
            (30, 1, Status::Crc),
        ] {
            let words = damaged(word, bit);
            assert_eq!(load(PRESS, words.as_ptr(), length), status(expected));
        }
        assert_eq!(
            jred_spline_f32_load(null_mut(), PRESS, address, length),
            status(Status::Null)
        );
        assert_eq!(
            jred_cubic_f32_load(&raw mut cubic, PRESS, address, length),
            status(Status::Layout)
        );
        assert_eq!(
            jred_spline_q31_load(&raw mut fixed, PRESS, address, length),
            status(Status::NumberType)
        );
        assert_eq!(jred_image_info(address, length, None), Status::Null);
        assert_eq!(jred_image_info(null(), 0, None), Status::Null);
    }
}

/// An image of a slider-crank in closed form with a constant load and constant frictions; other numbers may stand for its own.
fn crank(change: impl FnOnce(&mut [f32])) -> Vec<u32> {
    const SET: Set = curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
    let mut words = [0.25, -0.1, 0.02, 0.03, -0.004, 5.0, 0.5, 2.0];
    assert_eq!(SET, 49);
    change(&mut words);
    let table = Table::new(&words, Shape::slider_crank(SET)).unwrap();
    let validity = Validity {
        omega: 30.0,
        alpha: 200.0,
        torque_error: 0.01,
    };
    let mut buffer = vec![0; image_len::<SliderCrankForm>(0, SET)];
    encode(&table, validity, &mut buffer).unwrap().to_vec()
}

#[test]
fn a_closed_form_through_c_has_the_bits_of_one_in_rust() {
    let words = crank(|_| ());
    let model: Model<'_, SliderCrankForm, 49> = Image::new(&words).unwrap().model().unwrap();
    // SAFETY: zeros are no model; the words outlive it.
    unsafe {
        let mut memory: Crank = zeroed();
        let (address, length) = (words.as_ptr(), words.len());
        assert_eq!(
            jred_slider_crank_f32_load(&raw mut memory, 49, address, length),
            0
        );
        for k in 0..1000_u32 {
            let phase = k.wrapping_mul(4_294_967);
            let (omega, alpha) = (k as f32 * 0.03 - 15.0, 200.0 - k as f32 * 0.41);
            let torque = model.torque(Phase::from_bits(phase), omega, alpha);
            let back = model
                .acceleration(Phase::from_bits(phase), omega, torque)
                .value;
            assert!((back - alpha).abs() < 1e-2, "{k}");
            let same = |a: f32, b: f32| assert_eq!(a.to_bits(), b.to_bits(), "{k}");
            let memory = &raw const memory;
            same(
                jred_slider_crank_f32_s49_torque(memory, phase, omega, alpha),
                torque,
            );
            same(
                jred_slider_crank_f32_any_torque(memory, phase, omega, alpha),
                torque,
            );
            same(
                jred_slider_crank_f32_s49_acceleration(memory, phase, omega, torque),
                back,
            );
        }
    }
}

/// Null pointers, every shorter length, every turned bit, images of another format or set, and numbers that are no slider-crank's.
#[test]
fn what_is_no_closed_form_is_refused() {
    let (words, table) = (crank(|_| ()), press());
    let status = |status: Status| status as i32;
    // SAFETY: zeros are no model; null pointers are allowed; the words outlive the models.
    unsafe {
        let mut memory: Crank = zeroed();
        let mut load = |set, words: &[u32], length| {
            jred_slider_crank_f32_load(&raw mut memory, set, words.as_ptr(), length)
        };
        for short in 0..words.len() {
            assert_eq!(load(49, &words, short), status(Status::Length), "{short}");
        }
        for set in [0, 1, 17, 529, 21] {
            assert_eq!(load(set, &words, words.len()), status(Status::Set), "{set}");
        }
        assert_eq!(load(49, &table, table.len()), status(Status::Layout));
        for bit in 0..32 * words.len() {
            let mut damaged = words.clone();
            damaged[bit / 32] ^= 1 << (bit % 32);
            assert!(load(49, &damaged, words.len()) > 1, "bit {bit}");
        }
        // The CRC is right, and the numbers are not: a rod shorter than the crank, a negative inertia.
        for (number, wrong, expected) in [(0, 1.25, Status::Table), (2, -1.0, Status::NoInertia)] {
            let words = crank(|words| words[number] = wrong);
            let found = load(49, &words, words.len());
            assert_eq!(found, status(expected), "number {number}");
        }
        let mut memory: Crank = zeroed();
        let (address, length) = (words.as_ptr(), words.len());
        let mut load =
            |words, length| jred_slider_crank_f32_load(&raw mut memory, 49, words, length);
        assert_eq!(load(null(), length), status(Status::Null));
        assert_eq!(load(null(), 0), status(Status::Null));
        assert_eq!(
            load(address.byte_add(1), length - 1),
            status(Status::Misaligned)
        );
        let none = null_mut();
        assert_eq!(
            jred_slider_crank_f32_load(none, 49, address, length),
            status(Status::Null)
        );
        let mut spline: Press = zeroed();
        assert_eq!(
            jred_spline_f32_load(&raw mut spline, PRESS, address, length),
            status(Status::Layout)
        );
    }
}

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
    assert_eq!(jred_phase_from_counts(1024 + 4096, 4096), 1 << 30);
    assert_eq!(jred_phase_from_counts(1024, 0), 0);
    assert_eq!(
        jred_phase_from_radians(1.5),
        Phase::from_radians_f32(1.5).to_bits()
    );
    assert_eq!(jred_phase_from_stroke(0.5, 0.0, 1.0), 1 << 31);
    assert_eq!(jred_phase_from_stroke(2.0, 0.0, 1.0), u32::MAX);
}
