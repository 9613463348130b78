//! Losses of the drive train, on the side that the power comes from.

use super::{J, imbalance, simulate, turntable};
use crate::support::{budget, near};

/// A constant torque through two lossy stages: shaft by shaft, with the loss on the side that the power comes from.
#[test]
fn a_lossy_train_has_a_constant_acceleration() {
    let train = r#"
[[load]]
on = "shaft-1"
opposing_moment = "2 N m"
[[drive_train]]
type = "belt"
driver = { radius = "20 mm", inertia = "0.0003 kg m^2" }
driven = { radius = "60 mm", inertia = "0.004 kg m^2" }
efficiency = "90 %"
[[drive_train]]
type = "gear-train"
stage = [{ driver = { teeth = 15, inertia = "0.001 kg m^2" }, driven = { teeth = 60, inertia = "0.012 kg m^2" }, efficiency = 0.8 }]
"#;
    let found = simulate(&turntable(
        train,
        r#"duration = "1 s"
output_step = "0.1 s"
torque = "-1.5 N m"
rotor_inertia = "0.0002 kg m^2""#,
    ));
    // Belt: i = 3, gears reverse: i = −4. The motor's −1.5 N m turn the drive link forward.
    let (motor, link) = (0.0002 + 0.0003, J + 0.012);
    let middle = 0.004 + 0.001;
    // motor: ω_m = −12·ω; middle shaft: −4·ω. Magnitudes along the motion:
    // T₁ = 1.5 − motor·12·α, at the middle 3·0.9·T₁ − middle·4·α = T₂, at the link 4·0.8·T₂ − 2 = link·α.
    let alpha = (3.2 * 2.7 * 1.5 - 2.0) / (link + 3.2 * middle * 4.0 + 3.2 * 2.7 * motor * 12.0);
    near(
        "omega",
        *found.get("omega [rad/s]").last().unwrap(),
        alpha,
        budget::CLOSED_MOTION,
    );
    // Losses: a tenth of what the belt takes in, a fifth of what the gears take in, and the friction.
    let torque = 1.5 - motor * 12.0 * alpha;
    let belt = 0.1 * torque * 12.0;
    let gears = 0.2 * (2.7 * torque - middle * 4.0 * alpha) * 4.0;
    near(
        "losses",
        *found.get("losses [J]").last().unwrap(),
        (belt + gears + 2.0) * alpha / 2.0,
        budget::CLOSED_MOTION,
    );
    assert!(imbalance(&found) <= budget::BALANCE);
}

/// The train's losses stay on the right side when the load drives the motor: coasting down with a braking torque.
#[test]
fn braking_through_a_lossy_belt() {
    let train = r#"
[[drive_train]]
type = "belt"
driver = { radius = "20 mm", inertia = "0 kg m^2" }
driven = { radius = "60 mm", inertia = "0 kg m^2" }
efficiency = "80 %"
"#;
    let found = simulate(&turntable(
        train,
        r#"start_speed = "20 rad/s"
duration = "0.2 s"
output_step = "0.02 s"
torque = "-1 N m""#,
    ));
    // The belt's loss helps: the link is braked by 3/0.8 N m.
    near(
        "omega",
        *found.get("omega [rad/s]").last().unwrap(),
        20.0 - 0.2 * 3.0 / 0.8 / J,
        budget::CLOSED_MOTION,
    );
    assert!(imbalance(&found) <= budget::BALANCE);
}

/// From rest a load drives the motor: the loss is on that side from the first instant, not only once there is a speed.
#[test]
fn a_load_starts_the_motor_through_a_lossy_belt() {
    let train = r#"
[[load]]
on = "shaft-1"
moment = "-5 N m"
[[drive_train]]
type = "belt"
driver = { radius = "20 mm", inertia = "0 kg m^2" }
driven = { radius = "60 mm", inertia = "0 kg m^2" }
efficiency = "30 %"
"#;
    let found = simulate(&turntable(
        train,
        r#"duration = "0.1 s"
output_step = "0.01 s"
torque = "0 N m"
rotor_inertia = "0.02 kg m^2""#,
    ));
    // The rotor takes 3·0.02·α at the motor, which is 0.3 of what the link gives: 9·0.02·α/0.3 at the link.
    let alpha = -5.0 / (J + 9.0 * 0.02 / 0.3);
    for found in found.get("alpha [rad/s^2]") {
        near("alpha", found, alpha, budget::CLOSED_MOTION);
    }
    assert!(imbalance(&found) <= budget::BALANCE);
}
