//! The prescribed motion: segments between speeds, limits, laws.

mod course;
mod join;
mod limits;
mod overshoot;
mod repeats;
mod segments;
mod tool;

use jred_file::model::motion::Motion;

use crate::reading::{belt_motion, read, refuses};
use crate::support::within;

fn motion(kind: &str, segments: &[&str]) -> Motion {
    read(&belt_motion(kind, segments)).motion.unwrap()
}

fn refused(kind: &str, segments: &[&str], words: &[&str]) {
    refuses(&belt_motion(kind, segments), words);
}
