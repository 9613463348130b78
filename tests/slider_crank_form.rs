//! A slider-crank in closed form against its mechanism, and the equation of motion with it.

use std::f64::consts::TAU;

use crate::support::cranks::{ALPHA, Given, OMEGA, cranks, model_of, words_of};
use crate::support::{assert_near, budget, config, largest, link_of, samples};
use jred::axis::{FeedForward, MotionState};
use jred::image::{Validity, encode, image_len};
use jred::machine::{Link, Machine, Reducible};
use jred::mechanism::{Branch, SliderCrank, SliderCrankDimensions};
use jred::number::FrictionSign;
use jred::slider_crank::{STEEPEST, form, set_in_use, terms};
use jred::table::{Shape, Table, TableError, Usage};
use jred::{CurveSet, Image, ImageError, Phase, SliderCrankForm, Spline, curves};
use proptest::prelude::*;

fn phases(count: u32) -> impl Iterator<Item = Phase> {
    (0..count).map(move |k| Phase::from_bits(k.wrapping_mul((u32::MAX / count) | 1)))
}

/// Errors of the torque and of J, J′, load, b and c, each relative to the sum of the largest magnitudes of the torque's terms.
fn rounding(given: &Given) -> [f64; 2] {
    let machine = given.machine();
    let (words, set) = words_of(&machine).unwrap();
    let model = model_of(&words, set).unwrap();
    let (mut sizes, mut ticks, mut curves) = ([0.0f64; 6], 0.0f64, 0.0f64);
    for phase in phases(500) {
        let exact = machine.reduction(phase.radians()).unwrap();
        let read = model.table().at(phase);
        let worst = [
            (read.inertia - exact.inertia) * ALPHA,
            0.5 * (read.inertia_slope - exact.inertia_slope) * OMEGA * OMEGA,
            read.load - exact.load_torque(),
            (read.viscous - exact.viscous) * OMEGA,
            read.coulomb - exact.coulomb,
        ];
        curves = curves.max(worst.iter().map(|error| error.abs()).sum());
        for (omega, alpha) in [(OMEGA, ALPHA), (-OMEGA, ALPHA), (0.0, -ALPHA)] {
            let terms = exact.torque(omega, alpha);
            for (size, term) in sizes.iter_mut().zip(terms.values()) {
                *size = size.max(term.abs());
            }
            let found = model.torque(phase, omega as f32, alpha as f32);
            ticks = ticks.max((f64::from(found) - terms.total()).abs());
        }
    }
    let size: f64 = sizes.iter().sum();
    [ticks / size, curves / size]
}

/// Every mass, weight, force and friction that the form supports, on both sides, with offset; two-sided.
#[test]
fn the_tick_rounds_as_stated() {
    for (least, most, stated) in [
        (0.05, 0.5, budget::SLIDER_CRANK),
        (0.9, f64::from(STEEPEST) - 0.001, budget::SLIDER_CRANK_STEEP),
    ] {
        let cases = samples(300, 0x5c01, &cranks(least, most));
        let errors: Vec<[f64; 2]> = cases.iter().map(rounding).collect();
        let ticks = largest(errors.iter().map(|error| error[0]));
        let curves = largest(errors.iter().map(|error| error[1]));
        println!("slider-cranks up to {most}: ticks {ticks:e}, curves {curves:e}");
        assert!((stated / 5.0..=stated).contains(&ticks), "{ticks:e}");
        assert!((stated / 5.0..=stated).contains(&curves), "{curves:e}");
    }
}

/// In line, with mass at the slider only: x′ = −r at a quarter turn, 0 at the dead centres, and x = r·cos φ + √(l² − r²·sin²φ) by differences in
/// between.
#[test]
fn a_bare_slider_is_as_by_hand() {
    let (r, l, mass, rotor) = (0.05, 0.2, 10.0, 0.004);
    let lengths = SliderCrankDimensions {
        crank: r,
        rod: l,
        offset: 0.0,
    };
    let links = [
        link_of(0.0, rotor, [0.0; 2]),
        link_of(0.0, 0.0, [0.0; 2]),
        link_of(mass, 0.0, [0.0; 2]),
    ];
    let mechanism = SliderCrank::new(lengths, Branch::Right, links).unwrap();
    let machine = Machine::new(mechanism).with_gravity([9.81, 0.0]).unwrap();
    let (words, set) = words_of(&machine).unwrap();
    assert_eq!(set, curves::LOAD);
    assert_eq!(words.len(), 6);
    let model = model_of(&words, set).unwrap();
    let slider = |phi: f64| r * phi.cos() + (l * l - (r * phi.sin()).powi(2)).sqrt();
    let step = 1e-5;
    for k in 0..64u32 {
        let phase = Phase::from_bits(k << 26);
        let read = model.table().at(phase);
        let phi = phase.radians();
        let d1 = (slider(phi + step) - slider(phi - step)) / (2.0 * step);
        let d2 = (slider(phi + step) - 2.0 * slider(phi) + slider(phi - step)) / (step * step);
        // Differences of numbers near 0.25: 1e-16/1e-5 and 1e-16/1e-10.
        assert_near("J", read.inertia, rotor + mass * d1 * d1, 1e-7);
        assert_near("J'", read.inertia_slope, 2.0 * mass * d1 * d2, 2e-6);
        assert_near("load", read.load, mass * 9.81 * d1, 1e-5);
        if k % 32 == 0 {
            assert_near("dead centre", read.inertia, rotor, 1e-9);
        }
        if k % 32 == 16 {
            assert_near("quarter", read.inertia, rotor + mass * r * r, 1e-7);
        }
    }
}

/// J′ is the slope of J: the trapezoidal rule over a turn of a smooth periodic curve is exact, and with Simpson's rule the work of ½·J′·ω² is the
/// change of energy at every position.
#[test]
fn the_velocity_torque_balances_the_energy() {
    const PLACES: u32 = 2048;
    for given in samples(40, 0x5c02, &cranks(0.05, 0.8)) {
        let machine = given.machine();
        let (words, set) = words_of(&machine).unwrap();
        let model = model_of(&words, set).unwrap();
        let at = |k: u32| model.table().at(Phase::from_bits(k.wrapping_mul(1 << 21)));
        let size = largest((0..PLACES).map(|k| at(k).inertia_slope)) + at(0).inertia;
        let step = TAU / f64::from(PLACES);
        let (start, mut gained) = (at(0).inertia, 0.0);
        for k in (0..PLACES).step_by(2) {
            let [a, b, c] = [k, k + 1, k + 2].map(|k| at(k).inertia_slope);
            gained += step / 3.0 * (a + 4.0 * b + c);
            // Roundings of 2⁻²⁴ of each slope, at worst of one sign.
            assert_near("energy", at(k + 2).inertia - start, gained, 3e-6 * size);
        }
    }
}

proptest! {
    #![proptest_config(config(64, 0x5c03))]

    #[test]
    fn forward_inverts_inverse(given in cranks(0.05, 0.9), omega in -60f32..60.0, alpha in -400f32..400.0, bits: u32, share in -1f32..1.0) {
        let machine = given.machine();
        let (words, set) = words_of(&machine).unwrap();
        let model = model_of(&words, set).unwrap();
        let phase = Phase::from_bits(bits);
        for omega in [omega, 0.0] {
            let torque = model.torque(phase, omega, alpha);
            let inertia = model.table().at(phase).inertia;
            let terms = model.torque_terms(phase, omega, alpha, FrictionSign::OfSpeed(omega));
            let parts = [terms.acceleration, terms.velocity, terms.load, terms.viscous, terms.coulomb];
            let size: f64 = parts.iter().map(|part| f64::from(part.abs())).sum();
            let rounding = budget::TICK_ROUNDINGS * f64::from(f32::EPSILON) * size;
            assert_near("sum", parts.iter().sum::<f32>().into(), torque.into(), rounding);
            let back = model.acceleration(phase, omega, torque);
            prop_assert!(!back.saturated);
            assert_near("alpha", back.value.into(), alpha.into(), rounding / inertia);
            let range = model.acceleration_range(phase, omega, torque, torque + 10.0);
            prop_assert_eq!(range.least.value.to_bits(), back.value.to_bits());
            let more = model.acceleration(phase, omega, torque + 10.0);
            prop_assert_eq!(range.greatest.value.to_bits(), more.value.to_bits());
            // A share of the friction scales its term.
            let ramped = model.torque_with(phase, omega, alpha, FrictionSign::Scaled(share));
            let without = model.torque_with(phase, omega, alpha, FrictionSign::Scaled(0.0));
            let coulomb = share * model.table().at(phase).coulomb as f32;
            assert_near("ramp", (ramped - without).into(), coulomb.into(), rounding + 1e-6 * f64::from(coulomb.abs()));
        }
    }

    /// The set is part of the image, its model has the same bits, and every bit of it matters.
    #[test]
    fn images_hold_the_form(given in cranks(0.05, 0.9), bits: u32, omega in -60f32..60.0, flipped: prop::sample::Index) {
        let (words, set) = words_of(&given.machine()).unwrap();
        let model = model_of(&words, set).unwrap();
        let validity = Validity { max_speed: 60.0, max_acceleration: 400.0, torque_error: 0.01 };
        let mut buffer = vec![0; image_len::<SliderCrankForm>(0, set)];
        prop_assert_eq!(buffer.len(), 24 + words.len() + 1);
        let image = encode(model.table(), validity, &mut buffer).unwrap().to_vec();
        let read = Image::new(&image).unwrap();
        prop_assert_eq!(read.validity(), validity);
        prop_assert_eq!((read.cells(), read.set()), (0, set & 0xff));
        let again = read.any_model::<SliderCrankForm>().unwrap();
        let phase = Phase::from_bits(bits);
        prop_assert_eq!(again.table().set(), set);
        prop_assert_eq!(again.torque(phase, omega, 100.0).to_bits(), model.torque(phase, omega, 100.0).to_bits());
        prop_assert_eq!(read.any_model::<Spline<f32>>().unwrap_err(), ImageError::Layout(7));
        let mut damaged = image.clone();
        let bit = flipped.index(32 * image.len());
        damaged[bit / 32] ^= 1 << (bit % 32);
        prop_assert!(Image::new(&damaged).is_err());
    }
}

/// A set known at compile time gives the same bits, and must equal that of the header.
#[test]
fn known_and_unknown_sets_tick_alike() {
    const SET: CurveSet = curves::LOAD | curves::COULOMB | terms::LOAD_SIN | terms::COULOMB_ROD;
    let words = [0.25, -0.1, 0.02, 0.03, -0.004, 5.0, 1.5, 2.0, 0.25];
    let any = model_of(&words, SET).unwrap();
    let known = jred::Model::<SliderCrankForm, SET>::new(*any.table()).unwrap();
    let other = jred::Model::<SliderCrankForm, { curves::LOAD }>::new(*any.table());
    assert_eq!(other.unwrap_err(), TableError::Curves(SET));
    for phase in phases(1000) {
        for omega in [-30.0, 0.0, 20.0] {
            let [a, b] = [
                known.torque(phase, omega, 50.0),
                any.torque(phase, omega, 50.0),
            ];
            assert_eq!(a.to_bits(), b.to_bits());
            let [a, b] = [
                known.acceleration(phase, omega, 3.0),
                any.acceleration(phase, omega, 3.0),
            ];
            assert_eq!(a.value.to_bits(), b.value.to_bits());
        }
    }
    let mut buffer = [0; 40];
    let validity = Validity {
        max_speed: 1.0,
        max_acceleration: 1.0,
        torque_error: 1.0,
    };
    let image = encode(any.table(), validity, &mut buffer).unwrap();
    let feed = FeedForward::new(known, validity);
    let (phase, omega, alpha) = (Phase::from_bits(0x1357_9bdf), 0.5, 0.25);
    let motion = MotionState {
        phase,
        omega,
        alpha,
    };
    let checked = feed.at_reference(motion, FrictionSign::OfSpeed(omega));
    assert!(checked.status.is_valid());
    let plain = known.torque(phase, omega, alpha);
    assert_eq!(checked.torque.to_bits(), plain.to_bits());
    assert!(Image::is_of::<SliderCrankForm, SET>(image));
    assert!(!Image::is_of::<SliderCrankForm, { SET & !terms::LOAD_SIN }>(image));
    assert!(!Image::is_of::<jred::Harmonic<f32>, SET>(image));
}

/// The threshold for zero is relative to the same curve: in a machine of millimetres an inertia is small compared with a length.
#[test]
fn a_small_machine_keeps_its_small_coefficients() {
    for size in [1.0, 0.1, 0.01] {
        let links = [
            link_of(0.01 * size, 1e-9 * size * size * size, [0.0, 0.0]),
            // Its centre of mass is off its line.
            link_of(
                0.002 * size,
                1e-8 * size * size * size,
                [0.003 * size, 0.000_1 * size],
            ),
            Link::point_mass(0.001 * size).unwrap(),
        ];
        let dimensions = SliderCrankDimensions {
            crank: 0.002 * size,
            rod: 0.008 * size,
            offset: 0.0,
        };
        let machine = Machine::new(SliderCrank::new(dimensions, Branch::Right, links).unwrap());
        let set = set_in_use(&machine).unwrap();
        assert_eq!(set & terms::INERTIA_COS, terms::INERTIA_COS, "{size}");
        let mut words = [0.0; 18];
        let count = form(&machine, set, &mut words).unwrap();
        let table =
            Table::new(&words[..count], Shape::<SliderCrankForm>::slider_crank(set)).unwrap();
        for k in 0..64 {
            let phi = f64::from(k) / 64.0 * TAU;
            let found = table.at(Phase::from_radians(phi)).inertia;
            let exact = machine.reduction(phi).unwrap().inertias()[0];
            assert_near(&format!("{size} at {phi}"), found / exact, 1.0, 2e-6);
        }
    }
}

/// The usage stated by a form is a bound of its curves at every phase. For a rod much longer than the crank it is the magnitude of a sine: J₀ +
/// m·r²·sin²φ, m·g·r·sin φ; ½·|J′| ≤ ½·m·r² is counted as |X·X′| ≤ 1, twice that.
#[test]
fn usage_bounds_the_curves() {
    for given in samples(60, 0x5c07, &cranks(0.05, 0.95)) {
        let machine = given.machine();
        let (words, set) = words_of(&machine).unwrap();
        let table = Table::new(&words, Shape::slider_crank(set)).unwrap();
        let usage = Usage::of::<SliderCrankForm>(&table).unwrap();
        let bounds = [
            usage.inertia,
            usage.velocity,
            usage.load,
            usage.viscous,
            usage.coulomb,
        ];
        for phase in phases(200) {
            let exact = machine.reduction(phase.radians()).unwrap();
            let sizes = [
                exact.inertia,
                0.5 * exact.inertia_slope,
                exact.load_torque(),
                exact.viscous,
                exact.coulomb,
            ];
            for (size, bound) in sizes.iter().zip(bounds) {
                let slack = budget::SLIDER_CRANK_STEEP * f64::from(usage.torque);
                assert!(size.abs() <= f64::from(bound) + slack, "{size} {bound}");
            }
        }
        let sum: f32 = bounds.iter().sum();
        assert_near(
            "sum",
            usage.torque.into(),
            sum.into(),
            1e-6 * f64::from(sum),
        );
    }
    let (r, l, mass, rotor) = (0.05, 50.0, 10.0, 0.004);
    let lengths = SliderCrankDimensions {
        crank: r,
        rod: l,
        offset: 0.0,
    };
    let links = [Link::rotor(rotor), Link::rotor(0.0), Link::point_mass(mass)].map(Result::unwrap);
    let mechanism = SliderCrank::new(lengths, Branch::Right, links).unwrap();
    let machine = Machine::new(mechanism).with_gravity([9.81, 0.0]).unwrap();
    let (words, set) = words_of(&machine).unwrap();
    let table = Table::new(&words, Shape::slider_crank(set)).unwrap();
    let usage = Usage::of::<SliderCrankForm>(&table).unwrap();
    // The margin of 1e-4 of the root twice, and r/l = 1e-3 in X′.
    for (what, found, expected) in [
        ("J", usage.inertia, rotor + mass * r * r),
        ("½·J′", usage.velocity, mass * r * r),
        ("load", usage.load, mass * 9.81 * r),
    ] {
        assert_near(what, found.into(), expected, 2e-3 * expected);
    }
}
