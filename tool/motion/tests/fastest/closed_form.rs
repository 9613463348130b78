//! Constant inertia.

use jred_motion::fastest::{Binding, MoveLimits};

use super::{close, fastest, motor, table, task};

/// Target accuracy; the remainder is rounding.
const EXACT: f64 = 1e-10;

#[test]
fn a_triangle_and_a_trapezoid() {
    let file = table(2.0, "");
    let found = fastest(&file, &motor([10.0; 2], 100.0), &task(0.5, 3.5));
    close(found.time, 2.0 * (3.0f64 / 5.0).sqrt(), EXACT);
    let limits: Vec<Binding> = found.phases.iter().map(|phase| phase.limit).collect();
    assert_eq!(limits, [Binding::Driving, Binding::Braking]);
    close(found.phases[0].phi[1], 2.0, EXACT);
    let found = fastest(&file, &motor([10.0; 2], 3.0), &task(6.5, 0.5));
    close(found.time, 6.0 / 3.0 + 3.0 / 5.0, EXACT);
    let limits: Vec<Binding> = found.phases.iter().map(|phase| phase.limit).collect();
    assert_eq!(
        limits,
        [Binding::Driving, Binding::MotorSpeed, Binding::Braking]
    );
    close(found.phases[1].t[0], 3.0 / 5.0, EXACT);
    close(found.phases[1].phi[1], 0.5 + 0.9, EXACT);
}

/// Dry friction helps to brake: 4 and 6 rad/s².
#[test]
fn dry_friction() {
    let file = table(
        2.0,
        "[[load]]\non = \"table\"\nopposing_moment = \"2 N m\"\n",
    );
    let found = fastest(&file, &motor([10.0; 2], 100.0), &task(0.0, 3.0));
    let top = (2.0f64 * 3.0 / (1.0 / 4.0 + 1.0 / 6.0)).sqrt();
    close(found.time, top / 4.0 + top / 6.0, EXACT);
}

/// Limits of the drive link, each of which is active, and end speeds other than zero.
#[test]
fn limits_of_speed_and_acceleration_between_speeds() {
    let file = table(2.0, "");
    let limits = MoveLimits {
        speed: Some(2.0),
        acceleration: Some(3.0),
        deceleration: Some(1.5),
        ..MoveLimits::default()
    };
    let asked = jred_motion::fastest::Task {
        speeds: [0.5, 1.0],
        limits,
        ..task(0.0, 4.0)
    };
    let found = fastest(&file, &motor([10.0; 2], 100.0), &asked);
    let [up, down] = [(2.0 - 0.5) / 3.0, (2.0 - 1.0) / 1.5];
    let steady = (4.0 - 1.25 * up - 1.5 * down) / 2.0;
    close(found.time, up + steady + down, EXACT);
    let limits: Vec<Binding> = found.phases.iter().map(|phase| phase.limit).collect();
    assert_eq!(
        limits,
        [Binding::Acceleration, Binding::Speed, Binding::Deceleration]
    );
}

/// A torque that falls with the speed, and viscous friction: exponentials. Driving v′ = α − κ·v, braking v′ = −(α + γ·v).
#[test]
fn a_falling_torque_and_viscous_friction() {
    let (inertia, torque, end, speed, viscous) = (2.0, 10.0, 1.0, 20.0, 0.3);
    let file = table(
        inertia,
        "[[load]]\non = \"table\"\nviscous_moment = \"0.3 N m s/rad\"\n",
    );
    for length in [1e-6, 1e-3, 0.1, 3.0, 60.0, 600.0] {
        let found = fastest(&file, &motor([torque, end], speed), &task(0.0, length));
        let kappa = ((torque - end) / speed + viscous) / inertia;
        let alpha = torque / inertia;
        let (beta, gamma) = (alpha, (viscous - (torque - end) / speed) / inertia);
        // Time and distance of driving up to a speed, and of braking from it.
        let up = |v: f64| {
            let t = -(-kappa * v / alpha).ln_1p() / kappa;
            (t, (alpha * t - v) / kappa)
        };
        let down = |v: f64| {
            let t = (gamma * v / beta).ln_1p() / gamma;
            (t, (v - beta * t) / gamma)
        };
        // For small speeds both distances are differences of nearly equal numbers: use the series.
        let way = |v: f64| {
            if v < 1e-2 {
                let series = |a: f64, k: f64| {
                    let x = k * v / a;
                    v * v / a * (0.5 + x * (1.0 / 3.0 + x * (0.25 + x * (0.2 + x / 6.0))))
                };
                series(alpha, kappa) + series(beta, -gamma)
            } else {
                up(v).1 + down(v).1
            }
        };
        let (mut low, mut high) = (0.0, alpha / kappa * (1.0 - 1e-15));
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if way(middle) < length {
                low = middle;
            } else {
                high = middle;
            }
        }
        close(found.time, up(low).0 + down(low).0, 2e-9);
    }
}

/// A lift: up and down take different torques.
#[test]
fn gravity() {
    let text = "title = \"lift\"\ngravity = [\"0 m/s^2\", \"-10 m/s^2\"]\n[mechanism]\ntype = \"hoist\"\n\
        [mechanism.drum]\nmass = \"10 kg\"\ninertia = \"0.5 kg m^2\"\n[mechanism.load]\nradius = \"100 mm\"\nmass = \"50 kg\"\n";
    let file = super::machine(text);
    let inertia = 0.5 + 50.0 * 0.1 * 0.1;
    let weight = 50.0 * 10.0 * 0.1;
    let [up, down] = [80.0 - weight, 80.0 + weight].map(|torque| torque / inertia);
    for (from, to, [faster, slower]) in [(0.0, 5.0, [up, down]), (5.0, 0.0, [down, up])] {
        let found = fastest(&file, &motor([80.0; 2], 1e3), &task(from, to));
        let top = (2.0f64 * 5.0 / (1.0 / faster + 1.0 / slower)).sqrt();
        close(found.time, top / faster + top / slower, EXACT);
    }
}

/// A moment that acts in one direction only: −3 N·m forwards, nothing backwards, where the table has 2 kg·m² and the motor 10 N·m.
#[test]
fn a_load_of_one_direction_acts_in_it() {
    let file = table(
        2.0,
        "[[load]]\non = \"table\"\nmoment = \"-3 N m\"\ndirection = \"forward\"\n\
         [motion]\ntype = \"constant-speed\"\nspeed = \"60 rpm\"\n",
    );
    let motor = motor([10.0; 2], 1e3);
    // t = √(2·D·(1/a + 1/d))
    let time = |up: f64, down: f64| (2.0 * 1.5 * (1.0 / up + 1.0 / down)).sqrt();
    let forwards = fastest(&file, &motor, &task(0.2, 1.7));
    close(forwards.time, time(3.5, 6.5), 1e-10);
    let backwards = fastest(&file, &motor, &task(1.7, 0.2));
    close(backwards.time, time(5.0, 5.0), 1e-10);
}
