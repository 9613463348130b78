//! Windows of loads that are narrow against the integrator's steps.

use crate::simulate::simulate;
use crate::steady::rotor;
use crate::support::{budget, edited, near, press_text};

/// A moment of −T in a window of the width w, of which a ramp r is either side, does −T·(w − r) in each passage, however narrow it is and however far apart the
/// rows are.
#[test]
fn no_window_is_passed_over() {
    for (width, ramp, torque) in [
        (1.0, 0.5, -30.0),
        (1.0, 0.4, -30.0),
        (0.3, 0.1, -100.0),
        (1e-3, 4e-4, -3e4),
    ] {
        let load = |from: f64| {
            format!(
                "[[load]]\non = \"shaft-1\"\nmoment = \"{torque:?} N m\"\nbetween = [\"{from:?} deg\", \"{:?} deg\"]\nramp = \"{ramp:?} deg\"\n",
                from + width
            )
        };
        for (direction, speed) in [(1.0, "40 rad/s"), (-1.0, "-40 rad/s")] {
            for step in ["0.1 s", "2 ms"] {
                let text = rotor(
                    &load(270.0),
                    &format!("torque = \"0 N m\"\nstart_speed = \"{speed}\""),
                )
                .replace(
                    "output_step = \"0.1 s\"",
                    &format!("output_step = \"{step}\""),
                );
                let run = simulate(&text);
                let [phi, work] = ["phi [deg]", "process work [J]"].map(|name| run.get(name));
                let last = phi.len() - 1;
                let passages = ((phi[last].abs() + if direction > 0.0 { 90.0 } else { 270.0 })
                    / 360.0)
                    .floor();
                assert!(passages >= 5.0, "{passages}");
                let each = direction * torque * (width - ramp).to_radians();
                let what = format!("{width} {step} {direction}");
                near(&what, work[last], passages * each, budget::NARROW_WINDOW);
            }
        }
    }
}

/// The figures of the press do not depend on the rows: a punch in a window of one degree, nine times.
#[test]
fn a_narrow_punch_does_the_same_work_at_any_output_step() {
    let press = edited(
        &press_text(),
        "between = [\"315 deg\", \"360 deg\"]",
        "between = [\"270 deg\", \"271 deg\"]",
    );
    let press = edited(&press, "ramp = \"15 deg\"", "ramp = \"0.4 deg\"");
    let work = |step: &str| {
        let run = simulate(&edited(
            &press,
            "output_step = \"5 ms\"",
            &format!("output_step = \"{step}\""),
        ));
        *run.get("process work [J]").last().unwrap()
    };
    let [coarse, fine] = ["50 ms", "0.2 ms"].map(work);
    near("work", coarse, fine, 1e-9);
    assert!(fine < -10.0, "{fine}");
}
