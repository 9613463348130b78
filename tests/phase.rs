//! Phases and ranges: exact from counts, within half a unit from radians, wrapped or clamped.

use std::f64::consts::TAU;
use std::num::NonZeroU32;

use crate::support::{assert_near, budget, config, largest};
use jred::{Domain, Phase};
use proptest::prelude::*;

const TURN: f64 = 4_294_967_296.0;

/// a − b on the circle, in units of 2⁻³² turn.
fn units(phase: Phase, exact_turns: f64) -> f64 {
    let difference = f64::from(phase.to_bits()) - exact_turns.rem_euclid(1.0) * TURN;
    (difference + TURN / 2.0).rem_euclid(TURN) - TURN / 2.0
}

proptest! {
    #![proptest_config(config(512, 0x0005))]

    #[test]
    fn counts_convert_exactly(count: u32, per_turn in 1u32.., turns in 0u64..1000) {
        let per = NonZeroU32::new(per_turn).unwrap();
        let expected = (u128::from(count) << 32) / u128::from(per_turn) % (1 << 32);
        prop_assert_eq!(u128::from(Phase::from_counts(count, per).to_bits()), expected);
        // Whole turns cancel.
        let more = u64::from(count % per_turn) + turns * u64::from(per_turn);
        if let Ok(more) = u32::try_from(more) {
            prop_assert_eq!(Phase::from_counts(more, per), Phase::from_counts(count % per_turn, per));
        }
    }

    #[test]
    fn phases_wrap(a: u32, b: u32) {
        let [a, b] = [a, b].map(Phase::from_bits);
        prop_assert_eq!((a + b) - b, a);
        prop_assert_eq!(a - a, Phase::default());
        let sum = (u64::from(a.to_bits()) + u64::from(b.to_bits())) % (1 << 32);
        prop_assert_eq!(u64::from((a + b).to_bits()), sum);
    }

    #[test]
    fn cells_divide_the_range(bits: u32, step in 0u32..1 << 20, cells in 1u32..=1 << 16) {
        let (index, fraction) = Phase::from_bits(bits).cell(cells);
        prop_assert!(index < cells);
        // Index and fraction together are bits·cells, to the last bit.
        let place = (u64::from(index) << 32) + u64::from(fraction);
        prop_assert_eq!(u128::from(place), u128::from(bits) * u128::from(cells));
        let next = Phase::from_bits(bits.saturating_add(step)).cell(cells);
        prop_assert!(next >= (index, fraction));
    }

    #[test]
    fn radians_round_to_half_a_unit(phi in -TAU..TAU, far in -1e6f64..1e6) {
        assert_near("phase", units(Phase::from_radians(phi), phi / TAU), 0.0, budget::PHASE_UNITS);
        prop_assert_eq!(Domain::<f64>::Turn.phase(phi), Phase::from_radians(phi));
        // Farther out the angle's own resolution matters: 2⁻⁵³ relative, in the quotient as well.
        let coarse = far.abs() / TAU * 2.0 * f64::EPSILON * TURN;
        assert_near("far", units(Phase::from_radians(far), far / TAU), 0.0, budget::PHASE_UNITS + coarse);
    }

    #[test]
    fn phase_to_radians_and_back(bits: u32) {
        let phase = Phase::from_bits(bits);
        let phi = phase.radians();
        prop_assert!((0.0..TAU).contains(&phi));
        assert_near("radians", phi, f64::from(bits) / TURN * TAU, 4.0 * f64::EPSILON * TAU);
        prop_assert_eq!(Phase::from_radians(phi), phase);
        prop_assert_eq!(Phase::from_radians(phi - TAU), phase);
    }

    #[test]
    fn strokes_clamp(from in -5f64..5.0, length in 0.01..10.0, place in -1f64..2.0) {
        let domain = Domain::stroke(from, from + length).unwrap();
        let position = domain.position(place);
        assert_near("position", position, from + place * length, budget::POSITION);
        let expected = place.clamp(0.0, 1.0 - 1.0 / TURN) * TURN;
        // Truncated, so up to one unit low; a position of size 15 with a resolution of 2⁻⁵³, relative to the stroke.
        let coarse = 15.0 * 4.0 * f64::EPSILON / length * TURN;
        let found = f64::from(domain.phase(position).to_bits());
        assert_near("phase", found + 0.5, expected, 0.5 + coarse + 0.5);
        assert_near("span", domain.span(), length, budget::POSITION);
        let single = domain.to::<f32>();
        let coarse = 15.0 * 4.0 * f64::from(f32::EPSILON) / length * TURN;
        let found = f64::from(single.phase(position as f32).to_bits());
        assert_near("phase in f32", found, expected, 1.0 + coarse);
        assert_near("span in f32", f64::from(single.span()), length, 15.0 * 2.0 * f64::from(f32::EPSILON));
    }
}

#[test]
fn ends_of_a_stroke() {
    let domain = Domain::stroke(-0.25, 0.75).unwrap();
    let bits = |position| domain.phase(position).to_bits();
    assert_eq!([bits(-0.25), bits(-9.0), bits(f64::NEG_INFINITY)], [0; 3]);
    assert_eq!([bits(0.75), bits(9.0), bits(f64::INFINITY)], [u32::MAX; 3]);
    assert_eq!(
        [bits(0.25), bits(0.0), bits(f64::NAN)],
        [1 << 31, 1 << 30, 0]
    );
    let single = |position| domain.to::<f32>().phase(position).to_bits();
    assert_eq!([single(-0.25), single(-9.0), single(f32::NAN)], [0; 3]);
    assert_eq!(
        [single(0.75), single(9.0), single(f32::INFINITY)],
        [u32::MAX; 3]
    );
    assert_eq!(single(0.25), 1 << 31);
    let spans = [
        Domain::<f64>::Turn.span(),
        f64::from(Domain::<f64>::Turn.to::<f32>().span()),
    ];
    assert_near("a turn", spans[0], TAU, 0.0);
    assert_near(
        "a turn in f32",
        spans[1],
        TAU,
        TAU * f64::from(f32::EPSILON) / 2.0,
    );
}

#[test]
fn radians_that_are_no_angle_give_phase_zero() {
    for phi in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(Phase::from_radians(phi), Phase::default());
        assert_eq!(Phase::from_radians_f32(phi as f32), Phase::default());
    }
    for phi in [7e8f32, -7e8, f32::MAX] {
        assert_eq!(Phase::from_radians_f32(phi), Phase::default());
    }
    // Just below a full turn rounds to the full turn, which is phase 0.
    assert_eq!(Phase::from_radians(TAU * (1.0 - 1e-11)), Phase::default());
    assert_eq!(Phase::from_radians(-1e-30), Phase::default());
}

/// Every 509th single-precision number up to 2π, both signs: the documented accuracy.
#[test]
fn single_precision_radians_keep_their_promise() {
    let places = (0..=core::f32::consts::TAU.to_bits())
        .step_by(509)
        .map(f32::from_bits);
    let error = |phi: f32| units(Phase::from_radians_f32(phi), f64::from(phi) / TAU) / TURN;
    let worst = largest(places.flat_map(|phi| [error(phi), error(-phi)]));
    println!("from_radians_f32: {worst:.2e} turn");
    assert_near("turns", worst, 0.0, budget::PHASE_F32_TURNS);
}
