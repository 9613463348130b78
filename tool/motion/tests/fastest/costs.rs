//! Cost of limits, and figures left by a reserve.

use std::f64::consts::TAU;

use jred_motion::fastest::cycle::{MORE, single};
use jred_motion::fastest::{Binding, MoveLimits, Reserve, Task, time};

use jred_motion::path_dynamics::Actuator;
use jred_sizing::catalogue::Motor;
use jred_sizing::motor::envelope::Envelope;

use super::{close, motor, table, task};

/// A tenth more motor speed does not raise the gearbox's limit: with a motor of 3000 rpm a gearbox of 3050 rpm leaves a sixtieth.
#[test]
fn more_motor_speed_is_not_more_gearbox_speed() {
    let file = table(0.5, "");
    let rpm = TAU / 60.0;
    let actuator = motor([20.0; 2], 3000.0 * rpm);
    let limits = MoveLimits {
        gearbox_speed: Some(3050.0 * rpm),
        ..MoveLimits::default()
    };
    let asked = Task {
        limits,
        ..task(0.0, 4000.0)
    };
    let found = single(&file, &actuator, asked, None).unwrap();
    let made = &found.with_costs(&file, &actuator).moves[0];
    let cost = (made.costs.iter())
        .find(|cost| cost.limit == Binding::MotorSpeed)
        .unwrap();
    // A ramp at 40 rad/s² up and down, the rest at the gearbox's limit.
    let top = 3050.0 * rpm;
    close(cost.time, 4000.0 / top + top / 40.0, 1e-9);
    // Without the gearbox a tenth more speed.
    let free = single(&file, &actuator, task(0.0, 4000.0), None).unwrap();
    let free = free.with_costs(&file, &actuator);
    let top = (1.0 + MORE) * 3000.0 * rpm;
    close(free.moves[0].costs[1].time, 4000.0 / top + top / 40.0, 1e-9);
}

/// A stretched envelope of points equals that of a motor with proportionally higher speed.
#[test]
fn a_tenth_more_speed_is_a_faster_motor() {
    let file = table(0.5, "");
    let slow = motor([20.0, 5.0], 100.0);
    let fast = motor([20.0, 5.0], 110.0);
    let asked = task(0.0, 40.0);
    let stretched = Actuator {
        envelope: slow.envelope.stretched(1.1),
        ..slow
    };
    let faster = time(&file, &fast, &asked).unwrap();
    close(time(&file, &stretched, &asked).unwrap(), faster, 1e-12);
}

/// The RMS torque with a reserve stays a millionth below the remaining share, as torque and speed do.
#[test]
fn the_rms_torque_stays_below_its_reserve() {
    let motor = Motor {
        peak_curve: vec![[0.0, 30.0], [300.0, 30.0]],
        rated_torque: Some(8.0),
        standstill_torque: Some(8.0),
        rated_speed: Some(300.0),
        ..Motor::default()
    };
    let actuator = Actuator {
        envelope: Envelope::of(&motor),
        ..super::motor([30.0; 2], 300.0)
    };
    let file = table(0.5, "");
    let reserve = Reserve {
        rms: 0.2,
        ..Reserve::default()
    };
    let asked = Task {
        limits: MoveLimits::default().with_reserve(reserve),
        ..task(0.0, 40.0)
    };
    let load = single(&file, &actuator, asked, None).unwrap().load;
    let share = load.allowed / (0.8 * load.continuous);
    assert!((1.0 - share - 1e-6).abs() < 1e-12, "{share}");
}

/// Full torque T throughout, T = 30 N m over t: with a pause the cycle time τ satisfies T²·t = C²·τ, where the S1 torque C = 12 − 4·(40/τ)/300 is
/// that of the mean speed including the pause: 144·τ² − (12.8 + T²·t)·τ + 0.64/2.25 = 0.
#[test]
fn the_pause_is_that_of_the_mean_speed_with_it() {
    let motor = Motor {
        peak_curve: vec![[0.0, 30.0], [300.0, 30.0]],
        rated_torque: Some(8.0),
        standstill_torque: Some(12.0),
        rated_speed: Some(300.0),
        ..Motor::default()
    };
    let actuator = Actuator {
        envelope: Envelope::of(&motor),
        ..super::motor([30.0; 2], 300.0)
    };
    let made = single(&table(0.5, ""), &actuator, task(0.0, 40.0), None).unwrap();
    let t = made.trace.duration();
    let b = 12.8 + 900.0 * t;
    let cycle = (b + (b * b - 4.0 * 144.0 * 0.64 / 2.25).sqrt()) / 288.0;
    let pause = made.load.pause.unwrap();
    assert!((pause / (cycle - t) - 1.0).abs() < 1e-6, "{pause} {cycle}");
}
