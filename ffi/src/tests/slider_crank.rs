//! A slider-crank in closed form is refused, or ticked with the same bits as in Rust.

use core::mem::zeroed;
use core::ptr::{null, null_mut};

use jred::image::{Validity, encode, image_len};
use jred::table::{Shape, Table};
use jred::{CurveSet, Image, Model, SliderCrankForm, curves};

use super::ticks::same_bits;
use super::{PRESS, Press, jred_spline_f32_load, press};
use crate::memory::Memory;
use crate::status::Status;

type Crank = Memory<SliderCrankForm>;

#[allow(improper_ctypes, reason = "C sees the memory of a model as bytes")]
unsafe extern "C" {
    fn jred_slider_crank_f32_load(
        memory: *mut Crank,
        set: CurveSet,
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

/// An image of a slider-crank in closed form with a constant load and constant frictions; `change` may replace its numbers.
fn crank(change: impl FnOnce(&mut [f32])) -> Vec<u32> {
    const SET: CurveSet = curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
    let mut words = [0.25, -0.1, 0.02, 0.03, -0.004, 5.0, 0.5, 2.0];
    assert_eq!(SET, 49);
    change(&mut words);
    let table = Table::new(&words, Shape::slider_crank(SET)).unwrap();
    let validity = Validity {
        max_speed: 30.0,
        max_acceleration: 200.0,
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
        let memory = &raw const memory;
        same_bits(
            &model,
            [
                &|phase, omega, alpha| {
                    jred_slider_crank_f32_s49_torque(memory, phase, omega, alpha)
                },
                &|phase, omega, alpha| {
                    jred_slider_crank_f32_any_torque(memory, phase, omega, alpha)
                },
            ],
            &|phase, omega, torque| {
                jred_slider_crank_f32_s49_acceleration(memory, phase, omega, torque)
            },
        );
    }
}

/// Null pointers, every shorter length, every flipped bit, images of another format or set, and numbers that do not form a slider-crank.
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
        // The CRC is right, and the numbers are wrong: a rod shorter than the crank, a negative inertia.
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
