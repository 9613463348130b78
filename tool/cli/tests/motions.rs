//! Motions that are computed, written and judged: `jred fastest` and `jred gentlest`, then `jred size`.

mod limits;
mod plan;
mod profile;

use crate::support::{Run, jred_with};

const PRESS_DRIVE: &str = "sgm7a-25a+npt025mf-4";

fn run(arguments: &[&str]) -> Run {
    jred_with(arguments)
}
