//! Where a follower leaves its cam, or a rope goes slack, the run ends with the place and the cure.

use super::run;
use crate::reading::{parse, refuses, says, text_of};
use crate::support::edited;

fn refused(text: &str) -> String {
    match run(text) {
        Err(message) => message,
        Ok(_) => panic!("ran to its end"),
    }
}

fn runs(text: &str) {
    run(text).unwrap_or_else(|message| panic!("{message}"));
}

/// The number that stands after `before` in the text.
fn number_after(text: &str, before: &str) -> f64 {
    let start = text
        .find(before)
        .unwrap_or_else(|| panic!("{before:?} is not in\n{text}"));
    let rest = text[start + before.len()..].trim_start();
    let end = rest.find(|c: char| !"0123456789.-+e".contains(c)).unwrap();
    rest[..end].trim_end_matches('.').parse().unwrap()
}

/// Far above the limit of about 322 rpm: at the first place that the spring cannot follow, not before and not after.
#[test]
fn a_cam_above_its_limit() {
    let fast = edited(
        &text_of("cam-translating.toml"),
        "start_speed = \"120 rpm\"",
        "start_speed = \"600 rpm\"",
    );
    let message = refused(&fast);
    assert!(
        message.contains("the follower leaves the cam: at φ = "),
        "{message}"
    );
    assert!(
        message.contains("the follower lifts off at φ = "),
        "{message}"
    );
    assert!(message.contains("closure = \"form\""), "{message}");
    let limit = number_after(&message, "° above");
    assert!((321.0..324.0).contains(&limit), "{message}");
    // The dwell of 70° holds; the rise brakes from its middle at 120° on.
    let place = number_after(&message, "the cam: at φ =");
    assert!((118.0..140.0).contains(&place), "{message}");
}

/// Below its limit the same cam runs on; the limit itself parts the two.
#[test]
fn a_cam_near_its_limit() {
    let at = |speed: f64| {
        let text = edited(
            &text_of("cam-translating.toml"),
            "start_speed = \"120 rpm\"",
            &format!("start_speed = \"{speed} rpm\""),
        );
        // A flywheel that keeps the speed, and no torque: the limit of constant speed counts.
        let text = edited(
            &text,
            "base_radius",
            "flywheel = \"2000 kg m^2\"\nbase_radius",
        );
        let text = edited(&text, "torque = \"1.5 N m\"", "torque = \"0 N m\"");
        edited(&text, "duration = \"2 s\"", "duration = \"0.5 s\"")
    };
    let limit = number_after(&refused(&at(600.0)), "° above");
    runs(&at(limit * 0.999));
    refused(&at(limit * 1.001));
    let form = edited(&at(600.0), "closure = \"force\"", "closure = \"form\"");
    runs(&form);
}

const HOIST: &str = r#"
gravity = ["0 m/s^2", "-9.81 m/s^2"]
[mechanism]
type = "hoist"
[mechanism.drum]
mass = "20 kg"
inertia = "0.2 kg m^2"
[mechanism.load]
radius = "100 mm"
mass = "50 kg"
[simulation]
start_angle = "0 deg"
start_speed = "10 rad/s"
duration = "1 s"
output_step = "0.1 s"
torque = "TORQUE"
"#;

/// The rope is slack where the drum brakes faster than the load falls: −α·R > g, J·α + m·R·(g + R·α) = T with a free load at
/// the limit, so the torque that just does it is T = −J·g/R.
#[test]
fn a_rope_that_would_push() {
    let limit = -0.2 * 9.81 / 0.1;
    for at_a_time in [0.98, 1.02] {
        let text = HOIST.replace("TORQUE", &format!("{} N m", limit * at_a_time));
        if at_a_time < 1.0 {
            runs(&text);
        } else {
            says(
                &refused(&text),
                &[
                    "at t = 0.000000 s the rope of the load goes slack: at φ = 0.00°, 95.493 rpm",
                    "accelerate or brake more gently, or hang more weight on this rope",
                ],
            );
        }
    }
}

/// A prescribed motion that asks a rope to push is refused when the file is read.
#[test]
fn a_rope_in_too_fast_a_cycle() {
    let fast = text_of("hoist.toml").replace("duration = \"8 s\"", "duration = \"1 s\"");
    refuses(
        &fast,
        &[
            "goes slack in the prescribed motion: at φ = ",
            "the rope of the ",
            "it would have to push with",
            "a rope can only pull",
            "accelerate or brake more gently",
        ],
    );
}

/// The least acceleration time of a lift by hand: the counterweight's rope is slack where R·α > g.
#[test]
fn a_rope_at_its_limit() {
    // The largest acceleration of the modified sine is 5.528·h/T², on the way up.
    let (move_by, radius) = (40.0, 0.1);
    let limit = (5.527_957_f64 * move_by * radius / 9.81).sqrt();
    for (share, holds) in [(0.999, false), (1.001, true)] {
        let text = HOIST.split("[simulation]").next().unwrap().to_owned()
            + &format!(
                "[motion]\ntype = \"cycle\"\n[[motion.segment]]\nlaw = \"modified-sine\"\nmove = \"{move_by} rad\"\n\
                 duration = \"{} s\"\n[[motion.segment]]\nlaw = \"modified-sine\"\nmove = \"-{move_by} rad\"\n\
                 duration = \"20 s\"\n",
                limit * share
            );
        assert_eq!(parse(&text).is_ok(), holds, "{share}");
    }
}

/// Behind a variator as well.
#[test]
fn a_cam_behind_a_variator() {
    let with = |speed: &str| {
        let text = edited(
            &text_of("cam-translating.toml"),
            "start_speed = \"120 rpm\"",
            &format!("start_speed = \"{speed}\""),
        );
        let text = edited(&text, "duration = \"2 s\"", "duration = \"0.4 s\"");
        let start = text.find("[motion]").unwrap();
        let end = text.find("[simulation]").unwrap();
        let variator = "[variator]\nratio = 0.5\ninput_inertia = \"60 kg cm^2\"\noutput_inertia = \"0.012 kg m^2\"\n\
                        creep = { slip = \"3 %\", torque = \"45 N m\" }\n";
        format!("{}{variator}{}", &text[..start], &text[end..])
    };
    runs(&with("120 rpm"));
    let message = refused(&with("600 rpm"));
    assert!(
        message.contains("the follower leaves the cam: at φ = "),
        "{message}"
    );
    let limit = number_after(&message, "° above");
    assert!((321.0..324.0).contains(&limit), "{message}");
}
