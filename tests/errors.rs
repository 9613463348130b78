//! Every error of the core: some input produces it, and its message names quantity, value and cure.

mod reach;
mod tables;
mod values;

use jred::error::Error;
use jred::machine::{Link, Machine};
use jred::mechanism::{Branch, BuildError, SliderCrank, SliderCrankDimensions};

use crate::support::link_of;

/// The error, after checking that its message contains every part.
#[track_caller]
fn says<T: std::fmt::Debug, E: Into<Error> + std::fmt::Debug>(
    result: Result<T, E>,
    parts: &[&str],
) -> Error {
    let error = result.unwrap_err().into();
    let text = format!("{error}; {}", error.cure());
    for part in parts {
        assert!(text.contains(part), "\"{text}\" does not say \"{part}\"");
    }
    error
}

fn links() -> [Link; 3] {
    [0.1, 0.2, 0.3].map(|mass| link_of(mass, 0.001, [0.0, 0.0]))
}

fn slider_crank(r: f64, l: f64, e: f64) -> Result<SliderCrank, BuildError> {
    SliderCrank::new(
        SliderCrankDimensions {
            crank: r,
            rod: l,
            offset: e,
        },
        Branch::Right,
        links(),
    )
}

fn machine() -> Machine<SliderCrank> {
    Machine::new(slider_crank(0.1, 0.3, 0.0).unwrap())
}
