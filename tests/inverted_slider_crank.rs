//! The inverted slider-crank: textbook formulas of both motions, joints, forces, time ratio.

use crate::support::spoken;
use jred::mechanism::{BuildError, InvertedSliderCrankDimensions};
use jred::number::RangeError;
use std::f64::consts::{PI, TAU};

use crate::support::{assert_near, budget, config, link_of};
use jred::machine::{Action, Link, Load, Machine, Mechanism};
use jred::mechanism::{DimensionError, InvertedSliderCrank, LeverMotion};
use proptest::prelude::*;

const LEVER: usize = InvertedSliderCrank::LEVER;

fn massless() -> [Link; 3] {
    [0.0; 3].map(|inertia| Link::rotor(inertia).unwrap())
}

fn mechanism(r: f64, pivot: [f64; 2], e: f64) -> InvertedSliderCrank {
    InvertedSliderCrank::new(
        InvertedSliderCrankDimensions {
            crank: r,
            pivot,
            offset: e,
        },
        massless(),
    )
    .unwrap()
}

/// ψ′ and ψ″ of the lever for e = 0 and C = (0, −c), angles from the line of centres θ = φ − 90°:
/// tan(ψ − 90°) = r·sin θ/(c + r·cos θ).
fn textbook(r: f64, c: f64, phi: f64) -> [f64; 3] {
    let (sin, cos) = (phi - PI / 2.0).sin_cos();
    let square = r * r + c * c + 2.0 * r * c * cos;
    [
        PI / 2.0 + (r * sin).atan2(c + r * cos),
        r * (r + c * cos) / square,
        r * c * (r * r - c * c) * sin / (square * square),
    ]
}

#[test]
fn rocking_lever_textbook() {
    let (r, c) = (0.08, 0.25);
    let shaper = mechanism(r, [0.0, -c], 0.0);
    assert_eq!(shaper.motion(), LeverMotion::Rocking);
    for k in 0..200 {
        let phi = -10.0 + 0.1 * f64::from(k);
        let psi = shaper.frames(phi).unwrap()[LEVER].psi;
        let [value, d1, d2] = textbook(r, c, phi);
        assert_near("ψ", psi.value, value, budget::GOLDEN);
        assert_near("ψ'", psi.d1, d1, budget::GOLDEN);
        assert_near("ψ''", psi.d2, d2, budget::GOLDEN);
    }
}

#[test]
fn turning_lever_textbook() {
    let (r, c) = (0.12, 0.05);
    let whitworth = mechanism(r, [0.0, -c], 0.0);
    assert_eq!(whitworth.motion(), LeverMotion::Turning);
    for k in 0..200 {
        let phi = -10.0 + 0.1 * f64::from(k);
        let psi = whitworth.frames(phi).unwrap()[LEVER].psi;
        let [value, d1, d2] = textbook(r, c, phi);
        // The textbook's arctangent does not count turns.
        let turns = ((psi.value - value) / TAU).round();
        assert_near("ψ", psi.value - TAU * turns, value, budget::GOLDEN);
        assert_near("ψ'", psi.d1, d1, budget::GOLDEN);
        assert_near("ψ''", psi.d2, d2, budget::GOLDEN);
    }
    // The inverse with an offset: φ = ψ + asin((e − c·sin(γ − ψ))/r), γ = 90° from C to O.
    let e = 0.03;
    let whitworth = mechanism(r, [0.0, -c], e);
    for k in 0..200 {
        let phi = -10.0 + 0.1 * f64::from(k);
        let psi = whitworth.frames(phi).unwrap()[LEVER].psi.value;
        let back = psi + ((e - c * (PI / 2.0 - psi).sin()) / r).asin();
        assert_near("φ", back, phi, budget::GOLDEN);
    }
}

/// The crank's angles at which a function of it changes sign, by bisection to the last bit.
fn roots(f: impl Fn(f64) -> f64) -> Vec<f64> {
    let steps = 720;
    let at = |k: i32| 0.013 + TAU * f64::from(k) / f64::from(steps);
    let bracket = |k: i32| {
        let (mut a, mut b) = (at(k), at(k + 1));
        if f(a) * f(b) > 0.0 {
            return None;
        }
        for _ in 0..60 {
            let middle = 0.5 * (a + b);
            if f(a) * f(middle) <= 0.0 {
                b = middle;
            } else {
                a = middle;
            }
        }
        Some(a)
    };
    (0..steps).filter_map(bracket).collect()
}

fn ratio_of(roots: &[f64]) -> f64 {
    let [a, b] = roots else {
        panic!("{} reversals a turn", roots.len());
    };
    let (stroke, rest) = (b - a, TAU - (b - a));
    stroke.max(rest) / stroke.min(rest)
}

#[test]
fn time_ratio_is_that_of_the_strokes() {
    // e = 0: (180° + α)/(180° − α) with sin(α/2) = r/c.
    let shaper = mechanism(0.1, [0.0, -0.2], 0.0);
    assert_near("r = c/2", shaper.time_ratio(), 2.0, budget::GOLDEN);
    assert_near("swing", shaper.swing(), PI / 3.0, budget::GOLDEN);
    for (r, pivot, e) in [
        (0.08, [0.02, -0.25], 0.0),
        (0.08, [0.1, -0.25], 0.05),
        (0.08, [-0.3, 0.1], -0.03),
    ] {
        let shaper = mechanism(r, pivot, e);
        let lever = |phi| shaper.frames(phi).unwrap()[LEVER].psi;
        let ends = roots(|phi| lever(phi).d1);
        assert_near(
            "time ratio",
            shaper.time_ratio(),
            ratio_of(&ends),
            budget::GOLDEN,
        );
        let swing = (lever(ends[0]).value - lever(ends[1]).value).abs();
        assert_near("swing", shaper.swing(), swing, budget::GOLDEN);
        // The slow stroke passes the pin's farthest point, where the crank points from C to O.
        let far = (-pivot[1]).atan2(-pivot[0]).rem_euclid(TAU);
        let slow_inside = ends[1] - ends[0] > PI;
        let inside = (ends[0]..ends[1]).contains(&far) || (ends[0]..ends[1]).contains(&(far + TAU));
        assert_eq!(slow_inside, inside);
    }
    let whitworth = mechanism(0.1, [0.0, -0.05], 0.0);
    assert_near("c = r/2", whitworth.time_ratio(), 2.0, budget::GOLDEN);
    for (r, pivot, e) in [(0.12, [0.0, -0.05], 0.0), (0.12, [0.04, 0.03], -0.06)] {
        let whitworth = mechanism(r, pivot, e);
        let centres = pivot[1].atan2(pivot[0]);
        let lever = |phi| whitworth.frames(phi).unwrap()[LEVER].psi.value;
        // A ram on a line perpendicular to OC reverses where the slot is parallel to that line.
        let ends = roots(|phi| (lever(phi) - centres).cos());
        assert_near(
            "time ratio",
            whitworth.time_ratio(),
            ratio_of(&ends),
            budget::GOLDEN,
        );
    }
}

#[test]
fn lever_about_the_crank_s_own_axis_is_a_coupling() {
    let coupling = mechanism(0.1, [0.0, 0.0], 0.06);
    let at = |phi| coupling.frames(phi).unwrap()[LEVER].psi;
    assert_near("ψ", at(7.0).value - at(2.0).value, 5.0, budget::GOLDEN);
    assert_near("ψ'", at(3.0).d1, 1.0, budget::GOLDEN);
    assert_near("time ratio", coupling.time_ratio(), 1.0, budget::GOLDEN);
}

prop_compose! {
    /// Both motions; the pin keeps at least a tenth of the shorter length from the change point.
    pub(crate) fn machines()(
        turning in any::<bool>(),
        r in 0.02..0.3_f64,
        spare in 1.1..4.0_f64,
        offset in -0.8..0.8_f64,
        towards in 0.0..6.2_f64,
        mass in [0.1..3.0, 0.1..3.0, 0.1..5.0],
        com in [-0.5..1.0, -0.3..0.3, -0.2..0.2, -0.2..0.2, -0.5..1.5, -0.3..0.3],
        down in 0.0..6.2_f64,
        load in [-30.0..30.0, 0.0..10.0, 0.0..2.0],
    ) -> Machine<InvertedSliderCrank> {
        let e = offset * r;
        let centres = if turning { (r - e.abs()) / spare } else { (r + e.abs()) * spare };
        let pivot = [centres * towards.cos(), centres * towards.sin()];
        let [u1, v1, u2, v2, u3, v3] = com.map(|c: f64| c * r);
        let links = [
            link_of(mass[0], 0.2 * mass[0] * r * r, [u1, v1]),
            link_of(mass[1], 0.1 * mass[1] * r * r, [u2, v2]),
            link_of(mass[2], 0.5 * mass[2] * r * r, [u3, v3]),
        ];
        let on = |action| Load::new(LEVER, action).unwrap();
        Machine::new(InvertedSliderCrank::new(InvertedSliderCrankDimensions { crank: r, pivot, offset: e }, links).unwrap())
            .with_gravity([9.81 * down.cos(), 9.81 * down.sin()])
            .and_then(|m| m.with_load(on(Action::Moment(load[0]))))
            .and_then(|m| m.with_load(on(Action::OpposingMoment(load[1]))))
            .and_then(|m| m.with_load(on(Action::ViscousMoment(load[2]))))
            .and_then(|m| m.with_load(on(Action::Force([load[0], -load[1]])).at([r, 0.1 * r])?))
            .unwrap()
    }
}

proptest! {
    #![proptest_config(config(200, 42))]

    #[test]
    fn a_turning_lever_turns_once(machine in machines()) {
        let mechanism = machine.mechanism();
        let advance = |phi| mechanism.frames(phi + TAU).unwrap()[LEVER].psi.value
            - mechanism.frames(phi).unwrap()[LEVER].psi.value;
        let turn = if mechanism.motion() == LeverMotion::Turning { TAU } else { 0.0 };
        for phi in [-7.0, -3.2, 0.0, 3.1, 9.5] {
            assert_near("ψ a turn later", advance(phi), turn, budget::POSITION);
        }
        // The block stays on the lever's positive u axis.
        let frames = mechanism.frames(1.0).unwrap();
        let along = jred::machine::Marker::on(LEVER, [0.0, 0.0]).axis(&frames);
        let [x, y] = mechanism.dimensions().pivot;
        let (block, [cos, sin]) = (frames[InvertedSliderCrank::BLOCK], along);
        prop_assert!((block.x.value - x) * cos.value + (block.y.value - y) * sin.value > 0.0);
    }
}

#[test]
fn wrong_dimensions_are_refused() {
    let new = |r, pivot, e| {
        InvertedSliderCrank::new(
            InvertedSliderCrankDimensions {
                crank: r,
                pivot,
                offset: e,
            },
            massless(),
        )
        .unwrap_err()
    };
    assert_eq!(
        new(0.0, [0.0, 1.0], 0.0).to_string(),
        "crank length is 0, but must be greater than zero"
    );
    assert_eq!(
        new(0.1, [f64::NAN, 1.0], 0.0),
        BuildError::Range(RangeError::NotFinite("lever pivot x"))
    );
    assert_eq!(
        new(0.1, [0.0, f64::INFINITY], 0.0),
        BuildError::Range(RangeError::NotFinite("lever pivot y"))
    );
    assert_eq!(
        new(0.1, [0.0, 1.0], f64::NAN),
        BuildError::Range(RangeError::NotFinite("slot offset"))
    );
    // Between the two ranges, both ends included.
    for centres in [0.25, 0.3, 0.5, 0.75] {
        let misfit = DimensionError::ChangePoint {
            centres,
            rocking: 0.75,
            turning: 0.25,
        };
        assert_eq!(
            new(0.5, [centres, 0.0], -0.25),
            BuildError::Dimensions(misfit)
        );
    }
    assert_eq!(
        spoken(new(0.1, [0.0, -0.1], 0.0)),
        "the slot cannot follow the crank pin through a whole turn: the pivots are 0.1 m apart; make it more than \
         crank + |offset| = 0.1 m for a lever that rocks, or less than crank − |offset| = 0.1 m for one that turns"
    );
    assert_eq!(
        spoken(new(0.125, [0.0, 0.0], 0.25)),
        "the slot cannot follow the crank pin through a whole turn: the pivots are 0 m apart; make it more than \
         crank + |offset| = 0.375 m for a lever that rocks"
    );
}

/// An accepted mechanism has a position at every angle, however close to the change point.
#[test]
fn nothing_fails_next_to_the_change_point() {
    for centres in [0.3 * (1.0 + 1e-11), 0.1 * (1.0 - 1e-10)] {
        let narrow = mechanism(0.2, [0.0, -centres], 0.1);
        for k in 0..=4000 {
            let phi = TAU * f64::from(k) / 4000.0;
            let frames = narrow.frames(phi).unwrap();
            assert!(frames[LEVER].psi.d3.is_finite(), "φ = {phi}");
        }
    }
}
