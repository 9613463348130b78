//! What is wrong with a variator or a friction drive, and what to do.

use super::{FAN, PRESS, SHAFTS, refuses};
use crate::support::edited;

#[test]
fn wrong_variators_are_refused_with_their_cure() {
    let edits: [(&str, &str, &[&str]); 12] = [
        (
            "ratio = 0.35",
            "ratio = 0",
            &["`ratio` in [variator] is 0", "between 0.001 and 1000"],
        ),
        (
            "ratio = 0.35",
            "ratios = 0.35",
            &["did you mean \"ratio\"?"],
        ),
        (
            "input_inertia = \"60 kg cm^2\"",
            "",
            &["`input_inertia` in [variator] is missing"],
        ),
        (
            "input_inertia = \"60 kg cm^2\"",
            "input_inertia = \"0 kg cm^2\"",
            &["greater than zero"],
        ),
        (
            "slip = \"3 %\"",
            "slip = \"120 %\"",
            &["must be below 100 %", "starts to slide"],
        ),
        (
            "slip = \"3 %\", ",
            "",
            &["`slip` in `creep` of [variator] is missing"],
        ),
        (
            "torque = \"45 N m\"",
            "torque = \"0 N m\"",
            &["`torque` in `creep` of [variator]"],
        ),
        (
            "creep = {",
            "slip = \"2 %\"\ncreep = {",
            &["has both `slip` and `creep`", "keep one"],
        ),
        (
            "creep = {",
            "power_flow = \"input-drives\"\ncreep = {",
            &["is only used together with a constant `slip`"],
        ),
        (
            "at = \"3.4 s\"",
            "at = \"2.2 s\"",
            &[
                "is 2.2 s, but must not be before 2.3 s",
                "after the previous one has ended",
            ],
        ),
        (
            "duration = \"0.8 s\"",
            "duration = \"0 s\"",
            &["[[variator.shift]] number 1", "greater than zero"],
        ),
        (
            "law = \"cycloidal\"",
            "law = \"trapezoid\"",
            &["\"trapezoid\"", "polynomial-345"],
        ),
    ];
    for (from, to, words) in edits {
        refuses(PRESS, from, to, words);
    }
    let constant = edited(SHAFTS, "# slip", "slip = \"2 %\"");
    refuses(
        &constant,
        "ratio = 1.6",
        "ratio = 1.5",
        &["`power_flow` in [variator] is missing"],
    );
}

#[test]
fn wrong_friction_drives_are_refused_with_their_cure() {
    let edits: [(&str, &str, &[&str]); 7] = [
        (
            "arrangement = \"fan\"",
            "",
            &["`arrangement` in [mechanism] is missing"],
        ),
        (
            "arrangement = \"fan\"",
            "arrangement = \"tree\"",
            &["\"tree\"", "possible: \"chain\", \"fan\""],
        ),
        (
            "power_flow = \"input-drives\"",
            "",
            &[
                "`power_flow` in [mechanism] is missing",
                "slip always slows down the driven shaft",
            ],
        ),
        ("ratio = -1.5", "ratio = 0.0", &["too close to zero"]),
        (
            "slip = \"1.5 %\"",
            "slip = \"100 %\"",
            &["must be below 100 %"],
        ),
        (
            "slip = \"1.5 %\"",
            "slip = \"-1 %\"",
            &["must not be negative"],
        ),
        (
            "inertia = \"9 kg cm^2\"",
            "mass = \"1 kg\"",
            &["[[mechanism.stage]] number 1"],
        ),
    ];
    for (from, to, words) in edits {
        refuses(FAN, from, to, words);
    }
}
