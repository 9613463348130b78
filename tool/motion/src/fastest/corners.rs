//! Where the machine is not smooth along its way.

use std::f64::consts::TAU;

use jred::machine::Mechanism as _;
use jred::{Domain, Error, Reducible as _};
use jred_machine::number::numerics::least;

use super::field::Field;

/// Places in a turn, or on the whole way where that is more, between which friction vanishes at most once.
const PLACES: f64 = 360.0;

/// Share of its largest value below which the friction of a load vanishes.
const NOTHING: f64 = 1e-6;

/// Distances from the start, inside the way, at which the machine is not smooth: its own edges, and where what a load rubs on comes to
/// rest and turns back, as a slider does at its dead centres.
///
/// # Errors
/// The mechanism cannot be placed somewhere on the way.
pub fn corners(field: &Field, from: f64, length: f64) -> Result<Vec<f64>, Error> {
    let mut found = edges(field, from, length);
    found.extend(reversals(field, from, length)?);
    found.retain(|x| *x > 0.0 && *x < length);
    Ok(found)
}

fn edges(field: &Field, from: f64, length: f64) -> Vec<f64> {
    let machine = &field.way.file.machine;
    let mut found = Vec::new();
    for phi in (0..).map_while(|k| machine.edge(k)) {
        let x = (phi - from) * field.way.direction;
        match machine.domain() {
            Domain::Turn => {
                let mut x = x.rem_euclid(TAU);
                while x < length {
                    found.push(x);
                    x += TAU;
                }
            }
            Domain::Stroke { .. } => found.push(x),
        }
    }
    found
}

fn reversals(field: &Field, from: f64, length: f64) -> Result<Vec<f64>, Error> {
    let machine = &field.way.file.machine;
    let turns = match machine.domain() {
        Domain::Turn => (length / TAU).max(1.0),
        Domain::Stroke { .. } => 1.0,
    };
    let count = (PLACES * turns).ceil() as usize;
    let place = |k: usize| length * k as f64 / count as f64;
    let mut found = Vec::new();
    for load in machine.loads() {
        let friction = |x: f64| -> Result<f64, Error> {
            let phi = from + field.way.direction * x;
            let frames = machine.mechanism().frames(phi)?;
            let frame = frames.get(load.link());
            Ok(frame.map_or(0.0, |frame| load.reduce(frame, phi).coulomb))
        };
        if load.has_fixed_direction() {
            continue;
        }
        let values: Vec<f64> = (0..=count)
            .map(|k| friction(place(k)))
            .collect::<Result<_, _>>()?;
        let largest = values.iter().copied().fold(0.0, f64::max);
        for (k, three) in values.windows(3).enumerate() {
            if three[1] <= three[0] && three[1] < three[2] {
                let x = least(friction, place(k), place(k + 2))?;
                if friction(x)? <= NOTHING * largest {
                    found.push(x);
                }
            }
        }
    }
    Ok(found)
}
