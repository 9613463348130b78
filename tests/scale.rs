//! Per-unit scales: their coverage, and integer velocity factors.

use std::f64::consts::TAU;

use crate::support::machines::{Wave, spec};
use crate::support::rows::{Fixed, Rows};
use crate::support::{assert_near, budget, config, largest, scale_of};
use jred::machine::Reducible;
use jred::{Acceleration, Cubic, CurveSet, Outcome, Phase, Q31, Quadratic, Scale, Spline, curves};
use proptest::prelude::*;

const ALL: CurveSet = curves::ALL;

/// ½·cells/span·J_b·ω_b²/T_b
fn factor(scale: &Scale, cells: u32, span: f64) -> f64 {
    let [torque, speed, inertia] = [scale.torque(), scale.speed(), scale.inertia()].map(f64::from);
    0.5 * f64::from(cells) / span * inertia * speed * speed / torque
}

proptest! {
    #![proptest_config(config(512, 0x0061))]

    #[test]
    fn for_cells_makes_the_factor_whole(
        torque in -3f32..4.0, speed in -2f32..3.0, inertia in -5f32..2.0, cells in 4u32..2000, span in 0.01..10.0,
    ) {
        let [torque, speed, inertia] = [torque, speed, inertia].map(|x| 10f32.powf(x));
        let given = scale_of(torque, speed, inertia);
        prop_assume!(factor(&given, cells, span) < 1e5);
        let scale = given.for_cells(cells, span);
        let whole = factor(&scale, cells, span);
        let nearest = whole.round();
        prop_assert!(nearest >= 1.0);
        assert_near("factor", whole, nearest, budget::WHOLE_FACTOR * whole);
        // Each base shrinks at most by its rounding; that of the acceleration stays.
        for (after, before) in [(scale.torque(), torque), (scale.speed(), speed), (scale.inertia(), inertia)] {
            prop_assert!(after >= before * (1.0 - f32::EPSILON), "{after} after {before}");
        }
        let [after, before] = [scale, given].map(|s| f64::from(s.acceleration()));
        assert_near("acceleration base", after, before, budget::BASE_ROUNDINGS * before);
        // Up to the next integer, no further.
        let before = factor(&given, cells, span);
        prop_assert!(nearest <= before.floor() + 1.0, "{before} became {whole}");
        // A second time changes nothing.
        prop_assert_eq!(scale.for_cells(cells, span), scale);
    }

    /// No state within the stated ones saturates, nor on the way back.
    #[test]
    fn covering_scale_covers_what_it_says(
        spec in spec(), omega in 1.0..200.0, alpha in 1.0..5000.0, w in -1f64..1.0, a in -1f64..1.0, bits: u32,
    ) {
        let machine = spec.machine();
        let scale = Scale::covering(&machine, omega, alpha, 256).unwrap();
        let states = [[w, a], [w.signum(), a.signum()], [-w.signum(), a.signum()]].map(|[w, a]| [omega * w, alpha * a]);
        covers::<Spline<Q31>>(&machine, &scale, &states, bits)?;
        covers::<Cubic<Q31>>(&machine, &scale, &states, bits)?;
        covers::<Quadratic<Q31>>(&machine, &scale, &states, bits)?;
    }

    /// The same with the finest scale, whose torque covers inverse dynamics only.
    #[test]
    fn limited_scale_covers_its_own_accelerations(
        spec in spec(), omega in 1.0..200.0, alpha in 1.0..5000.0, w in -1f64..1.0, a in -1f64..1.0, bits: u32,
    ) {
        let machine = spec.machine();
        let limited = Scale::limited_to(&machine, omega, alpha, 256).unwrap();
        let states = [[w, a], [w.signum(), a.signum()], [-w.signum(), a.signum()]].map(|[w, a]| [omega * w, alpha * a]);
        covers::<Spline<Q31>>(&machine, &limited, &states, bits)?;
        let covering = Scale::covering(&machine, omega, alpha, 256).unwrap();
        prop_assert!(limited.acceleration() <= covering.acceleration() && limited.torque() <= covering.torque());
        assert_near("acceleration base", f64::from(limited.acceleration()), 1.05 * alpha, 1e-6 * alpha);
    }
}

fn covers<L: Fixed>(
    machine: &impl Reducible,
    scale: &Scale,
    states: &[[f64; 2]],
    bits: u32,
) -> Result<(), TestCaseError> {
    let scale = scale.for_cells(128, TAU);
    let rows = Rows::<L>::of(machine, ALL, 128, &scale).unwrap();
    let model = rows.try_model::<ALL>(&scale);
    let model = model.expect("the scale covers all terms together");
    for [omega, alpha] in states {
        let (speed, accel) = (scale.omega(*omega as f32), scale.alpha(*alpha as f32));
        prop_assert!(!speed.saturated && !accel.saturated);
        let torque = model.torque(Phase::from_bits(bits), speed.value, accel.value);
        let back = model.acceleration(Phase::from_bits(bits), speed.value, torque);
        prop_assert!(!back.saturated, "acceleration {back:?}");
    }
    Ok(())
}

/// A nearly constant inertia, a high speed, a small acceleration: the velocity torque alone sets the base.
#[test]
fn covering_scale_covers_the_velocity_torque() {
    let machine = Wave::bare(1.0, 0.01);
    let scale = Scale::covering(&machine, 100.0, 0.1, 256).unwrap();
    let scale = scale.for_cells(64, TAU);
    let rows = Rows::<Spline<Q31>>::of(&machine, curves::INERTIA, 64, &scale).unwrap();
    let built = rows.try_model::<{ curves::INERTIA }>(&scale);
    assert!(built.is_ok(), "{:?} with {scale:?}", built.err());
}

/// A torque as large as the stated motions need, where speed and friction add to it, and where the inertia is smallest.
#[test]
fn covering_scale_covers_forward_dynamics() {
    let machine = Wave {
        viscous: 0.5,
        ..Wave::bare(1.0, 0.5)
    };
    let needed = (0..256).map(|k| {
        let place = machine.reduction(f64::from(k) / 40.0).unwrap();
        place.torque(10.0, 20.0).total()
    });
    let drive = largest(needed) as f32;
    let saturated = |scale: Scale| {
        let scale = scale.for_cells(64, TAU);
        let rows = Rows::<Spline<Q31>>::of(&machine, ALL, 64, &scale).unwrap();
        let model = rows.model::<ALL>(&scale);
        let torque = scale.to_torque(drive).value;
        let states = (0..64u32).flat_map(|k| [-10.0, 0.0, 10.0].map(|speed| (k << 26, speed)));
        let limited = states.filter(|(bits, speed)| {
            let omega = scale.omega(*speed).value;
            let found = model.acceleration(Phase::from_bits(*bits), omega, torque);
            let exact = machine
                .reduction(Phase::from_bits(*bits).radians())
                .unwrap();
            let exact = exact.acceleration(f64::from(*speed), f64::from(drive));
            let beyond = exact.abs() - f64::from(scale.acceleration());
            assert!(beyond.abs() < 1e-2 || (beyond > 0.0) == found.saturated);
            found.saturated
        });
        limited.count()
    };
    assert_eq!(
        saturated(Scale::covering(&machine, 10.0, 20.0, 256).unwrap()),
        0
    );
    // A scale for the accelerations alone reports where such a torque gives more.
    let limited = saturated(Scale::limited_to(&machine, 10.0, 20.0, 256).unwrap());
    assert!((1..192).contains(&limited), "{limited} of 192");
}

/// A machine so slow that J′ has almost no effect still has a model.
#[test]
fn a_slow_machine_has_a_model() {
    let machine = Wave::bare(1.0, 0.25);
    let slow = scale_of(1e3, 0.1, 1.5);
    let scale = slow.for_cells(64, TAU);
    let rows = Rows::<Spline<Q31>>::of(&machine, curves::INERTIA, 64, &scale).unwrap();
    let model = rows.model::<{ curves::INERTIA }>(&scale);
    let omega = scale.omega(0.1).value;
    let phase = Phase::from_radians(1.0);
    let torque = scale.torque_si(model.torque(phase, omega, Acceleration::default()));
    let exact = -0.125 * 0.01 * 1f64.sin();
    println!("{scale:?}: {torque:e} N·m, exact {exact:e}");
    let unit = f64::from(scale.torque()) * budget::Q31_UNIT;
    assert_near(
        "torque",
        f64::from(torque),
        exact,
        budget::Q31_TICK_UNITS * unit,
    );
}

#[test]
fn conversions_are_per_unit() {
    let scale = scale_of(2.0, 10.0, 0.5);
    let found = scale.omega::<f32>(25.0);
    assert_eq!(
        found,
        Outcome {
            value: 2.5,
            saturated: false
        }
    );
    assert_eq!(scale.acceleration().to_bits(), 4f32.to_bits());
}
