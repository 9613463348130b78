//! Where a follower leaves its cam, or a rope goes slack, the run ends with the place and the cure.

use std::path::Path;

use crate::support::{Folder, edited, jred};

fn example(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    std::fs::read_to_string(folder.join(name)).unwrap()
}

fn refused(text: &str) -> String {
    let folder = Folder::new();
    let run = jred([&"simulate", &folder.file("machine.toml", text)]).ends(2);
    run.message()
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
        &example("cam-translating.toml"),
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
            &example("cam-translating.toml"),
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
    let folder = Folder::new();
    jred([&"simulate", &folder.file("slow.toml", at(limit * 0.999))]).ends(0);
    refused(&at(limit * 1.001));
    let form = edited(&at(600.0), "closure = \"force\"", "closure = \"form\"");
    jred([&"simulate", &folder.file("form.toml", form)]).ends(0);
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
    let folder = Folder::new();
    for at_a_time in [0.98, 1.02] {
        let text = HOIST.replace("TORQUE", &format!("{} N m", limit * at_a_time));
        let file = folder.file("hoist.toml", &text);
        if at_a_time < 1.0 {
            jred([&"simulate", &file]).ends(0);
        } else {
            let message = refused(&text);
            for words in [
                "at t = 0.000000 s the rope of the load goes slack: at φ = 0.00°, 95.493 rpm",
                "accelerate or brake more gently, or hang more weight on this rope",
            ] {
                assert!(message.contains(words), "{words} is not in\n{message}");
            }
        }
    }
}

/// A prescribed motion that asks a rope to push is refused when the file is read.
#[test]
fn a_rope_in_too_fast_a_cycle() {
    let fast = example("hoist.toml").replace("duration = \"8 s\"", "duration = \"1 s\"");
    let folder = Folder::new();
    for command in ["check", "size"] {
        let run = jred([&command, &folder.file("fast.toml", &fast)]).ends(2);
        run.says(&[
            "goes slack in the prescribed motion: at φ = ",
            "it would have to push with",
            "a rope can only pull",
            "accelerate or brake more gently",
        ]);
        assert!(run.message().contains("the rope of the "), "{}", run.err);
    }
}

/// The least acceleration time of a lift by hand: the counterweight's rope is slack where R·α > g.
#[test]
fn a_rope_at_its_limit() {
    // The largest acceleration of the modified sine is 5.528·h/T², on the way up.
    let (move_by, radius) = (40.0, 0.1);
    let limit = (5.527_957_f64 * move_by * radius / 9.81).sqrt();
    let folder = Folder::new();
    for (share, code) in [(0.999, 2), (1.001, 0)] {
        let text = HOIST.split("[simulation]").next().unwrap().to_owned()
            + &format!(
                "[motion]\ntype = \"cycle\"\n[[motion.segment]]\nlaw = \"modified-sine\"\nmove = \"{move_by} rad\"\n\
                 duration = \"{} s\"\n[[motion.segment]]\nlaw = \"modified-sine\"\nmove = \"-{move_by} rad\"\n\
                 duration = \"20 s\"\n",
                limit * share
            );
        let run = jred([&"check", &folder.file("lift.toml", text)]);
        assert_eq!(run.code, code, "{share}: {}{}", run.out, run.err);
    }
}

/// Behind a variator as well.
#[test]
fn a_cam_behind_a_variator() {
    let with = |speed: &str| {
        let text = edited(
            &example("cam-translating.toml"),
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
    let folder = Folder::new();
    jred([&"simulate", &folder.file("slow.toml", with("120 rpm"))]).ends(0);
    let message = refused(&with("600 rpm"));
    assert!(
        message.contains("the follower leaves the cam: at φ = "),
        "{message}"
    );
    let limit = number_after(&message, "° above");
    assert!((321.0..324.0).contains(&limit), "{message}");
}
