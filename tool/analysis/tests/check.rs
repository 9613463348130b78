//! Machine files whose values can be read, but whose mechanics cannot be.

use crate::reading::{parse, refuses, refuses_edit, refuses_edits, rendered};
use crate::support::machines::FOUR_BAR;

const PRESS: &str = include_str!("../../file/tests/data/press.toml");

const JAW: &str = include_str!("../../../machines/linkage-cam-lever.toml");

const DOC: &str = include_str!("../../../docs/mechanisms/disc-cam.md");

/// The one whole example of a document.
fn example(document: &'static str) -> &'static str {
    let mut blocks = document.split("\n```toml\n").skip(1);
    let block = blocks.next().and_then(|rest| rest.split("\n```").next());
    assert!(blocks.next().is_none(), "one example a document");
    block.unwrap()
}

#[test]
fn a_linkage_without_masses_is_refused() {
    let mut text = FOUR_BAR.to_owned();
    for weight in [
        "0.5 kg",
        "4 kg",
        "0.9 kg",
        "0.006 kg",
        "0.7 kg",
        "0.0025 kg",
    ] {
        text = text.replacen(&format!("\"{weight}"), "\"0 kg", 1);
    }
    refuses(&text, &["the reduced inertia is zero at", "flywheel"]);
}

#[test]
fn a_press_without_masses_is_refused() {
    // Every mass and inertia but the slider's is zero: nothing moves at the dead centres.
    let mut massless = PRESS.to_owned();
    for weight in [
        "0.05 kg",
        "9 kg",
        "0.018 kg",
        "6.5 kg",
        "0.03 kg",
        "0.0006 kg",
        "0.6 kg",
    ] {
        massless = massless.replace(&format!("\"{weight}"), "\"0 kg");
    }
    refuses(
        &massless,
        &["the reduced inertia is zero at", "flywheel = "],
    );
}

#[test]
fn a_roller_without_its_spring_is_refused() {
    let edits = r#"
        stiffness = "2 N/mm" => stiffness = "0.01 N/mm" =>
            joint "cam contact": the follower leaves the cam | closure = "form"
    "#;
    refuses_edits(JAW, edits);
}

#[test]
fn a_follower_that_lifts_off_is_refused() {
    let base = example(DOC);
    assert!(parse(base).is_ok());
    let edits = r#"
        "200 rpm" => "900 rpm" =>
            the follower leaves the cam in the prescribed motion: at φ =␣ | 900 rpm, the contact force would be - |
            at constant speed: the follower lifts off at φ =␣ | stiffer spring, more preload, or a slower machine |
            closure = "form"
    "#;
    refuses_edits(base, edits);
    // The speed told is the limit.
    let report = rendered(&parse(&base.replace("\"200 rpm\"", "\"900 rpm\"")).unwrap_err());
    let above = report.split("above ").nth(1).unwrap();
    let limit: f64 = above.split(" rpm").next().unwrap().parse().unwrap();
    for (share, held) in [(0.999, true), (1.001, false)] {
        let speed = format!("\"{} rpm\"", limit * share);
        let found = parse(&base.replace("\"200 rpm\"", &speed));
        assert_eq!(found.is_ok(), held, "{speed}");
    }
    let edits = r#"
        [mechanism.spring]\nstiffness = "3 N/mm"\npreload = "80 N"\n => => at constant speed: the follower lifts off
    "#;
    refuses_edits(base, edits);
    let weightless = base.replace("-9.81", "0");
    let edits = r#"
        [mechanism.spring]\nstiffness = "3 N/mm"\npreload = "80 N"\n => => nothing presses the follower on the cam
    "#;
    refuses_edits(&weightless, edits);
    // A slow move within which it accelerates hard.
    let cycle = "[motion]\ntype = \"cycle\"\n\n[[motion.segment]]\nlaw = \"cycloidal\"\nmove = \"360 deg\"\nduration = ";
    let motion = "[motion]\ntype = \"constant-speed\"\nspeed = \"200 rpm\"";
    assert!(parse(&base.replace(motion, &format!("{cycle}\"0.4 s\""))).is_ok());
    let hard = format!("{cycle}\"0.1 s\"");
    refuses_edit(
        base,
        motion,
        &hard,
        &["leaves the cam in the prescribed motion"],
    );
}
