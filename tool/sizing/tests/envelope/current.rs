//! Current, loss and constants against the three phases in time.

use std::f64::consts::TAU;

use jred_file::model::site::Site;
use jred_sizing::catalogue::Commutation;
use jred_sizing::catalogue::Winding;
use jred_sizing::motor::envelope::MotorLimits;
use jred_sizing::motor::winding::CurrentCurve;

use super::{RPM, bare, budget, near, servo};

/// The mean of a quantity of the three phases over a turn of the current.
fn mean(of: impl Fn(f64) -> f64) -> f64 {
    const STEPS: u32 = 720;
    let turn = (0..STEPS).map(|k| TAU * f64::from(k) / f64::from(STEPS));
    turn.map(of).sum::<f64>() / f64::from(STEPS)
}

#[test]
fn the_loss_of_three_phases_is_what_their_currents_make() {
    let (line_to_line, rms) = (3.8, 7.0);
    let winding = Winding {
        resistance: Some(line_to_line),
        ..Winding::default()
    };
    let amplitude = rms * 2f64.sqrt();
    let loss = mean(|angle| {
        let phases = [0.0, 1.0, 2.0].map(|k| amplitude * (angle - k * TAU / 3.0).cos());
        phases.iter().map(|i| line_to_line / 2.0 * i * i).sum()
    });
    near(
        winding.loss_resistance(20.0).unwrap() * rms * rms,
        loss,
        budget::CLOSED_FORM,
    );
    let hot = winding.loss_resistance(120.0).unwrap() * rms * rms;
    near(hot, loss * 1.393, budget::CLOSED_FORM);
    let block = Winding {
        commutation: Commutation::Block,
        ..winding
    };
    near(
        block.loss_resistance(20.0).unwrap() * 49.0,
        3.8 * 49.0,
        budget::CLOSED_FORM,
    );
}

#[test]
fn torque_and_voltage_constant_belong_together() {
    // k_e line to line, RMS: power of the three phases with 1 A in phase with the voltage.
    let (k_e, speed) = (0.49, 100.0);
    let phase = k_e * speed / 3f64.sqrt() * 2f64.sqrt();
    let power = mean(|angle| {
        let at = |k: f64| (angle - k * TAU / 3.0).cos();
        [0.0, 1.0, 2.0]
            .map(|k| phase * at(k) * 2f64.sqrt() * at(k))
            .iter()
            .sum()
    });
    let mut motor = bare();
    motor.winding.voltage_constant = Some(k_e);
    let curve = CurrentCurve::of(&motor).unwrap();
    near(curve.torque_constant(), power / speed, budget::CLOSED_FORM);
}

#[test]
fn the_current_curve_bends_where_the_iron_saturates() {
    let mut motor = servo();
    motor.winding.peak_current = Some(14.0);
    let curve = CurrentCurve::of(&motor).unwrap();
    assert!(curve.saturates());
    near(curve.current(2.3), 2.3 / 0.85, budget::CLOSED_FORM);
    near(curve.current(-9.0), 14.0, budget::CLOSED_FORM);
    // Half way between 2.3 N·m and 9 N·m.
    near(
        curve.current(5.65),
        0.5 * (2.3 / 0.85 + 14.0),
        budget::CLOSED_FORM,
    );
    for k in 0..60 {
        let torque = 0.2 * f64::from(k);
        near(
            curve.torque(curve.current(torque)),
            torque,
            budget::CLOSED_FORM,
        );
    }
    // The current by k_t, and less: no saturation.
    motor.winding.peak_current = Some(9.0 / 0.85);
    assert!(!CurrentCurve::of(&motor).unwrap().saturates());
}

#[test]
fn the_constant_comes_from_currents_where_it_is_not_stated() {
    let mut motor = servo();
    motor.winding = Winding {
        rated_current: Some(3.0),
        ..Winding::default()
    };
    near(
        CurrentCurve::of(&motor).unwrap().current(2.1),
        3.0,
        budget::CLOSED_FORM,
    );
    motor.winding.standstill_current = Some(3.1);
    near(
        CurrentCurve::of(&motor).unwrap().current(2.3),
        3.1,
        budget::CLOSED_FORM,
    );
    motor.winding = Winding::default();
    assert_eq!(CurrentCurve::of(&motor), None);
}

#[test]
fn weakening_the_field_takes_current_of_its_own() {
    let mut motor = servo();
    motor.max_speed = Some(9000.0 * RPM);
    let prepared = MotorLimits::new(&motor, None, &Site::default());
    let slow = prepared.current(1.0, 1000.0 * RPM).unwrap();
    near(slow, 1.0 / 0.85, budget::CLOSED_FORM);
    let speed = 0.98 * prepared.envelope.max_speed();
    let limit = prepared.envelope.peak_torque(1.0, speed);
    let [idle, half, full] = [0.0, 0.5, 1.0].map(|s| prepared.current(s * limit, speed).unwrap());
    assert!(
        idle > 1.0 && half >= idle && full >= half,
        "{idle} {half} {full}"
    );
    // On the envelope the peak current flows, or the torque per volt is largest.
    let circuit = prepared.circuit.unwrap();
    assert!(
        full <= circuit.current * (1.0 + budget::CLOSED_FORM),
        "{full}"
    );
    // The least current that the voltage allows, by search.
    let (e, x) = (circuit.flux * speed, circuit.reactance * speed);
    let q = 0.5 * limit / 0.85;
    let least = (0..=200_000)
        .map(|k| circuit.current * f64::from(k) / 2e5)
        .find(|d| {
            let across = -circuit.drop * d - x * q;
            let along = circuit.drop * q - x * d + e;
            across.hypot(along) <= circuit.voltage
        })
        .unwrap();
    near(half, q.hypot(least), budget::GRID_SEARCH);
}
