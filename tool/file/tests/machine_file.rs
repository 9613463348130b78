//! Machine files: what they say in SI units, and what a user is told about a wrong one.

mod documented;
mod files;
mod profiles;
mod refusals;
mod values;

use crate::reading::{
    data, parse, parse_as, refuses, refuses_edit, refuses_edits, rendered, rendered_in,
};

const PRESS: &str = include_str!("data/press.toml");
const GEARS: &str = include_str!("data/gear-train.toml");

fn close(found: f64, expected: f64) {
    let error = (found - expected).abs();
    assert!(
        error <= 1e-15 * expected.abs().max(1e-3),
        "{found} is not {expected}"
    );
}

#[test]
fn random_damage_never_panics() {
    let mut state = 7_u64;
    let mut random = |below: usize| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    let spare: Vec<char> = "\"[]{}=.,-+e0919 \n#kmNs^/%²é\u{0}\u{feff}"
        .chars()
        .collect();
    for round in 0..500 {
        let base = if round % 3 == 0 { GEARS } else { PRESS };
        let mut text: Vec<char> = base.chars().collect();
        for _ in 0..=random(4) {
            let at = random(text.len());
            match random(4) {
                0 => drop(text.remove(at)),
                1 => text[at] = spare[random(spare.len())],
                2 => text.insert(at, spare[random(spare.len())]),
                _ => drop(text.drain(at..(at + random(60)).min(text.len()))),
            }
        }
        let text: String = text.into_iter().collect();
        if let Err(report) = parse(&text) {
            assert!(rendered(&report).len() > 20);
        }
    }
}
