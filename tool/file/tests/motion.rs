//! The prescribed motion: segments between speeds, limits, laws.

mod course;
mod join;
mod limits;
mod overshoot;
mod repeats;
mod segments;
mod tool;

use jred_file::model::motion::Motion;

use crate::reading::{read, refuses};

/// A belt drive, whose drive link turns, with these segments.
fn turning(kind: &str, segments: &[&str]) -> String {
    let mut text = format!(
        "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"belt\"\n\
         driver = {{ radius = \"2 cm\", inertia = \"1 kg cm^2\" }}\n\
         driven = {{ radius = \"5 cm\", inertia = \"6 kg cm^2\" }}\n\
         [motion]\ntype = \"{kind}\"\n"
    );
    for segment in segments {
        text.push_str("[[motion.segment]]\n");
        text.push_str(&segment.replace("; ", "\n"));
        text.push('\n');
    }
    text
}

fn motion(kind: &str, segments: &[&str]) -> Motion {
    read(&turning(kind, segments)).motion.unwrap()
}

fn refused(kind: &str, segments: &[&str], words: &[&str]) {
    refuses(&turning(kind, segments), words);
}

#[track_caller]
fn near(what: &str, found: f64, expected: f64, tolerance: f64) {
    let error = (found - expected).abs();
    assert!(
        error <= tolerance,
        "{what}: {found} is {error:e} off {expected}"
    );
}
