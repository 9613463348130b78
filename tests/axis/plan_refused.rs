//! Images and knots that do not give a plan.

use jred::axis::Plan;
use jred::axis::plan::{Errors, HEADER_WORDS, Knot, PlanError, VERSION, encode, image_len};
use jred::{Domain, ImageError, Q31, Scale, Spline};
use proptest::prelude::*;

use super::machine::in_units;
use super::plan::{image, trapezoid};
use crate::support::images::sealed;
use crate::support::{samples, scale_of};

fn refused(words: &[u32]) -> PlanError {
    let model = in_units::<Spline<f32>>(Domain::Turn, Scale::SI);
    Plan::new(words, &model).expect_err("refused")
}

#[test]
fn every_flipped_bit_of_a_plan_is_refused() {
    let words = image(&trapezoid(), Domain::Turn);
    for bit in 0..32 * words.len() {
        let mut damaged = words.clone();
        damaged[bit / 32] ^= 1 << (bit % 32);
        let error = refused(&damaged);
        let expected = match bit / 32 {
            0 => matches!(error, PlanError::NotAPlan(_)),
            1 if bit % 32 < 16 => matches!(error, PlanError::Image(ImageError::Version { .. })),
            2 => matches!(error, PlanError::Image(ImageError::Length { .. })),
            _ => matches!(error, PlanError::Image(ImageError::Crc { .. })),
        };
        assert!(expected, "bit {bit}: {error:?}");
    }
    for given in 0..words.len() {
        let error = refused(&words[..given]);
        assert!(
            matches!(error, PlanError::Image(ImageError::Length { .. })),
            "{given}: {error:?}"
        );
    }
}

/// With a correct CRC: the fault is reported, and nothing panics.
#[test]
fn a_plan_that_is_not_sound_is_refused() {
    let words = image(&trapezoid(), Domain::Turn);
    let row = |k: usize, word: usize| HEADER_WORDS + 8 * k + word;
    let with = |place: usize, word: u32| {
        let mut words = words.clone();
        words[place] = word;
        refused(&sealed(words))
    };
    let header = |word: u8| PlanError::Image(ImageError::Header(word));
    for (place, word, expected) in [
        (1, u32::from(VERSION) | 15 << 16, header(1)),
        (3, words[3] & !0xff | 2, header(3)),
        (3, words[3] & !0xff00 | 41 << 8, header(3)),
        (3, words[3] & !0xff | 1, header(5)),
        (4, 4, header(4)),
        (8, f32::NAN.to_bits(), header(8)),
        (12, (-1.0_f32).to_bits(), header(8)),
        (13, (-1.0f32).to_bits(), header(13)),
        (13, f32::NAN.to_bits(), header(13)),
        (14, 1, header(14)),
        (15, 1, header(14)),
        (row(0, 0), 1, PlanError::Order(0)),
        (row(2, 0), words[row(1, 0)], PlanError::Order(1)),
        (row(1, 2), words[row(1, 2)] | 32, PlanError::Number(1)),
        (row(0, 3), i32::MIN.cast_unsigned(), PlanError::Number(0)),
        (row(0, 7), i32::MAX.cast_unsigned(), PlanError::Number(0)),
        (
            row(2, 3),
            words[row(2, 3)] + (words[row(2, 3)] >> 10),
            PlanError::Gap(1),
        ),
        (row(2, 1), words[row(2, 1)] ^ 1 << 20, PlanError::Gap(1)),
        (row(0, 5), 1 << 20, PlanError::Gap(0)),
    ] {
        assert_eq!(with(place, word), expected, "word {place}");
    }
    for words in samples(500, 0xff62, &proptest::collection::vec(any::<u32>(), 8 * 4)) {
        let mut plan = image(&trapezoid(), Domain::Turn);
        let places = HEADER_WORDS..HEADER_WORDS + 8 * 4;
        plan[places].copy_from_slice(&words);
        plan[HEADER_WORDS] = 0;
        refused(&sealed(plan));
    }
    // Beyond the bases of fixed point.
    let slow = in_units::<Spline<Q31>>(Domain::Turn, scale_of(100.0, 1.9, 10.0));
    let error = Plan::new(&words, &slow).expect_err("too fast");
    assert_eq!(
        format!("{error}; {}", error.cure()),
        "the greatest speed of the plan is 2, but must be less than its base, 1.9; \
         give a smaller value, or export the table for a greater speed and acceleration"
    );
    let model = in_units::<Spline<f32>>(Domain::Turn, Scale::SI);
    let plan = Plan::new(&words, &model).unwrap();
    assert!(plan.of_machine(7).is_ok());
    assert!(matches!(
        plan.of_machine(8),
        Err(PlanError::Image(ImageError::Machine {
            found: 7,
            expected: 8
        }))
    ));
}

#[test]
fn knots_that_make_no_plan_are_refused() {
    let mut words = [0; image_len(5)];
    let mut with = |change: fn(&mut [Knot; 5])| {
        let mut knots = trapezoid();
        change(&mut knots);
        encode(&knots, Domain::Turn, 0, Errors::default(), &mut words)
            .map(|_| ())
            .expect_err("refused")
    };
    assert_eq!(with(|knots| knots[2].t = 1.0), PlanError::Order(2));
    assert_eq!(with(|knots| knots[0].t = 0.1), PlanError::Order(0));
    assert_eq!(
        with(|knots| knots[3].omega = f64::NAN),
        PlanError::Number(3)
    );
    assert_eq!(
        with(|knots| knots[3].alpha[1] = f64::INFINITY),
        PlanError::Number(3)
    );
    assert_eq!(with(|knots| knots[4].position = 1e9), PlanError::Number(4));
    let mut few = [0; 20];
    let short = encode(&trapezoid(), Domain::Turn, 0, Errors::default(), &mut few);
    assert!(matches!(
        short,
        Err(PlanError::Image(ImageError::BufferTooShort {
            given: 20,
            ..
        }))
    ));
}

/// Knots on a stroke of 0.5 m from 0.1 m on.
fn on_a_stroke(knots: &[(f64, f64, f64, f64)]) -> Result<Vec<u32>, PlanError> {
    let knots: Vec<Knot> = knots
        .iter()
        .map(|&(t, position, omega, alpha)| Knot {
            t,
            position,
            omega,
            alpha: [alpha; 2],
        })
        .collect();
    let mut words = vec![0; image_len(knots.len())];
    let domain = Domain::stroke(0.1, 0.6).unwrap();
    encode(&knots, domain, 0, Errors::default(), &mut words).map(<[u32]>::to_vec)
}

/// A knot beyond an end, or a polynomial beyond it between two knots, is refused if it exceeds the rounding of its coefficients; one that reverses at
/// the end is not.
#[test]
fn a_row_that_leaves_the_stroke_is_refused() {
    let outside = on_a_stroke(&[(0.0, 0.1, 0.0, 0.0), (2.0, 0.6001, 0.0, 0.0)]);
    assert_eq!(outside, Err(PlanError::Number(1)));
    // Up to the end with 1 m/s and back: x = 0.6 − (t − 1)²/2.
    for (length, end) in [(2.0, 0.1), (1.7, 0.355)] {
        let turning = |more: f64| {
            let knot = |t: f64, position| (t, position + more, 1.0 - t, -1.0);
            let last = knot(length, end);
            on_a_stroke(&[(0.0, 0.1 + more.max(0.0), 1.0, -1.0), last])
        };
        assert!(turning(0.0).is_ok());
        assert_eq!(turning(2.5e-7), Err(PlanError::Stroke(0)));
    }
    // The same for an image: K·u³·(½ − u)² added to a row of half its window changes nothing at its ends.
    let words = on_a_stroke(&[(0.0, 0.59, 0.0, 0.0), (1.0, 0.6, 0.0, 0.0)]).unwrap();
    let domain = Domain::stroke(0.1, 0.6).unwrap();
    let model = in_units::<Spline<f32>>(domain, Scale::SI);
    for (factor, expected) in [(0, None), (-1, None), (1, Some(PlanError::Stroke(0)))] {
        let mut words = words.clone();
        for (k, share) in [(5, 1), (6, -4), (7, 4)] {
            let word = &mut words[HEADER_WORDS + k];
            *word = word.wrapping_add_signed(factor * share * (1 << 23));
        }
        assert_eq!(
            Plan::new(&sealed(words), &model).err(),
            expected,
            "{factor}"
        );
    }
}

/// Random knots on a stroke, with any speeds and accelerations: accepted plans stay on it, refused ones do not, by the Hermite polynomial itself.
#[test]
fn the_stroke_is_kept_between_the_knots() {
    let end = || (0.1..0.6, -1.0..1.0, -3.0..3.0);
    let mut counts = [0; 2];
    for ((p, v, a), (q, w, b), length) in samples(200, 0xff63, &(end(), end(), 0.05..1.5)) {
        let [from, to] = [(0.0, p, v, a), (length, q, w, b)];
        let knot = |(t, position, omega, alpha)| Knot {
            t,
            position,
            omega,
            alpha: [alpha; 2],
        };
        let [first, last] = [knot(from), knot(to)];
        let positions = (0..=1000).map(|k| {
            let t = length * f64::from(k) / 1000.0;
            super::plan::between(&first, &last, t)[0]
        });
        let beyond = positions.fold(f64::NEG_INFINITY, |most, x| most.max(0.1 - x).max(x - 0.6));
        match on_a_stroke(&[from, to]) {
            Ok(_) => {
                counts[0] += 1;
                assert!(beyond < 2.5e-7, "{from:?} {to:?} {beyond}");
            }
            Err(error) => {
                counts[1] += 1;
                assert_eq!(error, PlanError::Stroke(0));
                // Between two samples it may exceed the stroke: by an eighth of some 20 m/s² times 1.5 ms squared.
                assert!(beyond > -1e-5, "{from:?} {to:?} {beyond}");
            }
        }
    }
    assert!(counts.iter().all(|count| *count > 30), "{counts:?}");
}
