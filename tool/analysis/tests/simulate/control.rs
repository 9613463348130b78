//! Motions under a cascade of controllers.

use std::f64::consts::TAU;

use super::{J, imbalance, simulate, turntable};
use crate::reading::parse;
use crate::support::{budget, edited, largest, near, press_text, within};

/// The turntable follows `motion` from rest, under a controller with these keys.
fn controlled(motion: &str, control: &str, more: &str) -> String {
    turntable(
        &format!("{more}\n{motion}"),
        &format!(
            "start_speed = \"0 rpm\"\nduration = \"1 s\"\noutput_step = \"10 ms\"\ntorque = \"1000 N m\"\ncontrol = {{ {control} }}"
        ),
    )
}

const STEADY: &str = "[motion]\ntype = \"constant-speed\"\nspeed = \"10 rad/s\"\n";

/// A step of the speed: first order without an integral, second order with one.
#[test]
fn a_step_of_the_speed_is_answered_as_the_closed_form_says() {
    let (wanted, gain) = (10.0, 0.4);
    let found = simulate(&controlled(STEADY, "speed_gain = \"0.4 N m s/rad\"", ""));
    for (t, omega) in found
        .get("t [s]")
        .into_iter()
        .zip(found.get("omega [rad/s]"))
    {
        let expected = wanted * (1.0 - (-gain * t / J).exp());
        within("P", omega, expected, budget::CLOSED_MOTION * wanted);
    }
    // J·ω″ + K·ω′ + K/t_i·ω = K/t_i·ω*, ω′(0) = K·ω*/J.
    let integral_time = 0.1;
    let found = simulate(&controlled(
        STEADY,
        "speed_gain = \"0.4 N m s/rad\", integral_time = \"100 ms\"",
        "",
    ));
    let decay: f64 = 0.5 * gain / J;
    let square = gain / (integral_time * J) - decay * decay;
    assert!(square > 0.0, "an oscillation");
    let nu = square.sqrt();
    for (t, omega) in found
        .get("t [s]")
        .into_iter()
        .zip(found.get("omega [rad/s]"))
    {
        // e = ω* − ω: e(0) = ω*, e′(0) = −K·ω*/J = −2·decay·ω*.
        let error = wanted * (-decay * t).exp() * ((nu * t).cos() - decay / nu * (nu * t).sin());
        within("PI", omega, wanted - error, budget::CLOSED_MOTION * wanted);
    }
    assert!(imbalance(&found) < budget::BALANCE);
}

/// A start from a wrong angle: the position error falls by J·e″ + K·e′ + K·K_v·e = 0.
#[test]
fn the_position_controller_takes_an_error_away() {
    let (gain, position): (f64, f64) = (1.0, 4.0);
    let motion =
        "[motion]\ntype = \"cycle\"\nstart = \"1 rad\"\n[[motion.segment]]\ndwell = \"1 s\"\n";
    let found = simulate(&controlled(
        motion,
        "speed_gain = \"1 N m s/rad\", position_gain = \"4 1/s\"",
        "",
    ));
    let root = (gain * gain - 4.0 * J * gain * position).sqrt();
    let [slow, fast] = [-1.0, 1.0].map(|sign| (-gain - sign * root) / (2.0 * J));
    for (t, error) in found
        .get("t [s]")
        .into_iter()
        .zip(found.get("phi error [deg]"))
    {
        let expected = (fast * (slow * t).exp() - slow * (fast * t).exp()) / (fast - slow);
        within("error", error.to_radians(), expected, budget::CLOSED_MOTION);
    }
}

/// At the motor's limit the acceleration is constant, and the integral does not wind up: the overshoot stays small.
#[test]
fn a_limited_motor_accelerates_evenly_and_does_not_wind_up() {
    let text = controlled(
        STEADY,
        "speed_gain = \"20 N m s/rad\", integral_time = \"20 ms\"",
        "",
    );
    let found = simulate(&edited(&text, "1000 N m", "2 N m"));
    let speeds = found.get("omega [rad/s]");
    for (t, omega) in found.get("t [s]").into_iter().zip(&speeds) {
        if t < 0.2 {
            within("at the limit", *omega, 2.0 / J * t, budget::CLOSED_MOTION);
        }
    }
    let most = largest(&speeds);
    assert!((10.0..10.2).contains(&most), "{most}");
    near(
        "at the end",
        *speeds.last().unwrap(),
        10.0,
        budget::CLOSED_MOTION,
    );
}

/// A proportional controller is at the limit until K·(ω* − ω) is the limit, and the position lags behind the reference all the way.
#[test]
fn the_limit_of_the_torque_is_timed_and_the_following_error_found() {
    let (wanted, gain, most) = (10.0, 2.0, 4.0);
    let text = controlled(STEADY, "speed_gain = \"2 N m s/rad\"", "");
    let file = parse(&edited(&text, "1000 N m", "4 N m")).unwrap();
    let simulation = file.simulation.as_ref().unwrap();
    let found = jred_analysis::simulate::simulate(&file, simulation).unwrap();
    let limit = found.torque_limit.unwrap();
    let speed = wanted - most / gain;
    let free = speed * J / most;
    assert_eq!((limit.count, limit.time, limit.position), (1, 0.0, 0.0));
    within("duration", limit.duration, free, budget::CLOSED_MOTION);
    // Then e′ = ω* − ω decays with K/J: the lag is that of the ramp and ∫e^(−K·t/J).
    let lag = |t: f64| {
        let decay = (-gain / J * (t - free)).exp();
        wanted * free - 0.5 * speed * free + (wanted - speed) * J / gain * (1.0 - decay)
    };
    let following = found.following.unwrap();
    near("error", following.error, lag(1.0), budget::CLOSED_MOTION);
    let free = parse(&text).unwrap();
    let found =
        jred_analysis::simulate::simulate(&free, free.simulation.as_ref().unwrap()).unwrap();
    assert!(found.torque_limit.is_none());
}

/// Friction holds the machine until the integral has grown to it: K·ω*·(1 + t/t_i) = M, on the side of the motor.
#[test]
fn friction_holds_until_the_integral_breaks_it_away() {
    let friction = "[[load]]\non = \"shaft-1\"\nopposing_moment = \"2 N m\"\n";
    let found = simulate(&controlled(
        STEADY,
        "speed_gain = \"0.1 N m s/rad\", integral_time = \"100 ms\"",
        friction,
    ));
    // 0.1·10·(1 + t/0.1) = 2.
    for (t, omega) in found
        .get("t [s]")
        .into_iter()
        .zip(found.get("omega [rad/s]"))
    {
        if t < 0.1 - 1e-9 {
            assert_eq!(omega, 0.0, "at t = {t}");
        } else if t > 0.1 + 1e-9 {
            assert!(omega > 0.0, "at t = {t}: {omega}");
        }
    }
}

/// A drive's feed-forward is one constant, (J_rotor + J_driver + (J_driven + J_table)/i²)·i·α: what the stage loses is not in it, neither
/// driving nor braking.
#[test]
fn the_mean_inertia_feeds_forward_no_losses() {
    let text = r#"
gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "rotary-table"
table = { diameter = "600 mm", mass = "20 kg" }
[[drive_train]]
type = "gear-train"
[[drive_train.stage]]
driver = { teeth = 20, inertia = "2 kg cm^2" }
driven = { teeth = 80, inertia = "0.02 kg m^2" }
efficiency = "70 %"
[motion]
type = "cycle"
[[motion.segment]]
law = "cycloidal"
move = "360 deg"
duration = "0.8 s"
[simulation]
duration = "0.8 s"
output_step = "50 ms"
torque = "100 N m"
rotor_inertia = "10 kg cm^2"
control = { speed_gain = "1e-6 N m s/rad", feed_forward = "mean-inertia" }
"#;
    let found = simulate(text);
    let (ratio, duration): (f64, f64) = (4.0, 0.8);
    let inertia = 1e-3 + 2e-4 + (0.02 + 0.5 * 20.0 * 0.3 * 0.3) / (ratio * ratio);
    let most = inertia * ratio * TAU * TAU / (duration * duration);
    // Gears turn the table the other way.
    for (t, torque) in found
        .get("t [s]")
        .into_iter()
        .zip(found.get("motor torque [N m]"))
    {
        let expected = -most * (TAU * t / duration).sin();
        // The controller adds its gain times the error of the speed, which is less than twice the largest speed.
        within(
            "torque",
            torque,
            expected,
            1e-6 * 2.0 * 2.0 * ratio * TAU / duration,
        );
    }
}

/// The torque of the model is what the motion asks for: without any error to begin with there is none later. The mean inertia of the
/// press, as drives have it, leaves one.
#[test]
fn the_model_feeds_forward_all_that_a_press_needs() {
    let follow = |feed_forward: &str| {
        let text = press_text();
        let (text, _) = text.split_once("[simulation]").unwrap();
        let text = format!(
            "{text}\n[simulation]\nduration = \"1 s\"\noutput_step = \"5 ms\"\ntorque = \"500 N m\"\nrotor_inertia = \"12 kg cm^2\"\ncontrol = {{ speed_gain = \"0.5 N m s/rad\", position_gain = \"20 1/s\", feed_forward = \"{feed_forward}\" }}\n"
        );
        let file = parse(&text).unwrap();
        let simulation = file.simulation.as_ref().unwrap();
        let found = jred_analysis::simulate::simulate(&file, simulation)
            .unwrap()
            .whole()
            .unwrap();
        let error = found
            .names()
            .iter()
            .position(|name| name == "phi error [deg]")
            .unwrap();
        let errors: Vec<f64> = found.rows().iter().map(|row| row[error].unwrap()).collect();
        let squares: f64 = errors.iter().map(|error| error * error).sum();
        [largest(&errors), (squares / errors.len() as f64).sqrt()]
    };
    let [none, mean, model] = ["none", "mean-inertia", "model"].map(follow);
    assert!(model[0] < 1e-7, "{model:?} deg");
    // The load makes the largest error: the RMS shows the inertia.
    assert!(
        mean[0] > 1e-3 && none[1] > mean[1],
        "{none:?} deg, {mean:?} deg"
    );
}
