//! Inverse and forward dynamics of one table are inverse to each other: every number type, every layout, with and without
//! division.

use std::f64::consts::TAU;

use crate::support::machines::{Spec, spec};
use crate::support::rows::Rows;
use crate::support::{assert_near, budget, config, quantity, value};
use jred::number::Number;
use jred::table::{Format, TorqueOf};
use jred::{Cubic, CurveSet, Phase, Q31, Quadratic, Scale, Spline, curves};
use proptest::prelude::*;

const ALL: CurveSet = curves::ALL;
const CELLS: u32 = 64;

/// Acceleration → torque → acceleration, and the range of accelerations of two torques. `bound` is in terms of J·α and J in machine units.
fn there_and_back<F: Format>(
    spec: &Spec,
    [omega, alpha, other]: [f64; 3],
    phase: Phase,
    bound: impl Fn(f64, f64) -> f64,
) {
    let machine = spec.machine();
    let scale = Scale::covering(&machine, 60.0, 900.0, 256).unwrap();
    let scale = scale.for_cells(CELLS, TAU);
    let rows = Rows::<F>::of(&machine, ALL, CELLS, &scale).unwrap();
    let model = rows.model::<ALL>(&scale);
    let (base, acceleration) = (f64::from(scale.speed()), f64::from(scale.acceleration()));
    let omega = quantity(omega * 60.0 / base);
    let [alpha, other] = [alpha, other].map(|a| quantity(a * 900.0 / acceleration));
    let torque = model.torque(phase, omega, alpha);
    let back = model.acceleration(phase, omega, torque);
    assert!(!back.saturated, "{back:?}");
    let inertia = model.table().at(phase).inertia;
    let budget = bound(inertia * value(alpha), inertia);
    assert_near(
        <F::Number as Number>::NAME,
        value(back.value),
        value(alpha),
        budget,
    );
    // Both at once equal each one alone.
    let least = model.torque(phase, omega, other);
    let range = model.acceleration_range(phase, omega, least, torque);
    assert_eq!(range.greatest, back);
    assert_eq!(range.least, model.acceleration(phase, omega, least));
    let mut many = [TorqueOf::<F>::default(); 3];
    let done = model.torques(&[phase; 2], &[omega; 3], &[alpha, other], &mut many);
    assert_eq!((done, many), (2, [torque, least, TorqueOf::<F>::default()]));
}

fn float(epsilon: f64) -> impl Fn(f64, f64) -> f64 {
    // The parts of the resisting torque may exceed their sum: up to the torque base, 1.
    move |own, inertia| budget::TICK_ROUNDINGS * epsilon * (own.abs() + 1.0) / inertia
}

/// The resisting torque is the same number both ways; J·α loses up to a unit of Q29 by its floor, the quotient up to one of Q31.
fn fixed(_: f64, inertia: f64) -> f64 {
    budget::Q31_UNIT * (4.0 / inertia + 1.0)
}

proptest! {
    #![proptest_config(config(64, 0x0003))]

    #[test]
    fn forward_inverts_inverse(spec in spec(), state in [-1.0..1.0, -1.0..1.0, -1.0..1.0], bits: u32) {
        let phase = Phase::from_bits(bits);
        there_and_back::<Spline<f64>>(&spec, state, phase, float(f64::EPSILON));
        there_and_back::<Cubic<f64>>(&spec, state, phase, float(f64::EPSILON));
        there_and_back::<Quadratic<f64>>(&spec, state, phase, float(f64::EPSILON));
        there_and_back::<Spline<f32>>(&spec, state, phase, float(f64::from(f32::EPSILON)));
        there_and_back::<Cubic<f32>>(&spec, state, phase, float(f64::from(f32::EPSILON)));
        there_and_back::<Quadratic<f32>>(&spec, state, phase, float(f64::from(f32::EPSILON)));
        there_and_back::<Spline<Q31>>(&spec, state, phase, fixed);
        there_and_back::<Cubic<Q31>>(&spec, state, phase, fixed);
        there_and_back::<Quadratic<Q31>>(&spec, state, phase, fixed);
    }
}
