//! Features that make a curve hard to approximate at one position: the edge of a load's window, the end of a cam segment, a
//! jump, a kink.

use std::f64::consts::TAU;

use jred::Domain;
use jred::error::Error;
use jred::machine::{Mechanism as _, Reducible, Reduction};

use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;
use jred_file::number::rounding::rounded;

/// The feature, and a change in the machine file that would help, if any.
pub(crate) struct Feature {
    pub(crate) words: String,
    pub(crate) cure: Option<String>,
}

/// Distance of two positions, across a whole turn if that is shorter.
fn distance(domain: Domain, a: f64, b: f64) -> f64 {
    let apart = (a - b).abs();
    match domain {
        Domain::Turn => {
            let apart = apart % TAU;
            apart.min(TAU - apart)
        }
        Domain::Stroke { .. } => apart,
    }
}

/// The feature within `near` (rad, or m) of a position.
pub(crate) fn feature(
    file: &MachineFile,
    machine: &impl Reducible,
    coordinate: Coordinate,
    at: f64,
    near: f64,
) -> Result<Option<Feature>, Error> {
    if let Some(found) = window_edge(file, coordinate, at, near) {
        return Ok(Some(found));
    }
    let jump = jump_or_kink(machine, coordinate, at, near)?;
    let piece = piece_end(file, coordinate, at, near);
    Ok(match (piece, jump) {
        (Some(piece), Some(jump)) => Some(Feature {
            words: format!("{piece}, and {}", jump.words),
            ..jump
        }),
        (Some(words), None) => Some(Feature { words, cure: None }),
        (None, jump) => jump,
    })
}

fn window_edge(file: &MachineFile, coordinate: Coordinate, at: f64, near: f64) -> Option<Feature> {
    const WHAT: [&str; 4] = ["begins", "reaches its full value", "begins to fall", "ends"];
    let domain = file.machine.mechanism().domain();
    let edges = file.loads.iter().filter_map(|load| {
        let edges = load.load.window()?.edges();
        let edge = WHAT.into_iter().zip(edges).map(|(what, edge)| {
            let away = distance(domain, edge, at);
            (away, what, edge, edges)
        });
        let (away, what, edge, edges) = edge.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (away <= near).then_some((away, load.name.as_str(), what, edge, edges))
    });
    let (_, name, what, edge, edges) = edges.min_by(|a, b| a.0.total_cmp(&b.0))?;
    let ramp = rounded(coordinate.shown(edges[1] - edges[0]));
    let unit = coordinate.unit();
    let words = format!(
        "the load {name:?} {what} at {}, over a ramp of {ramp} {unit}",
        coordinate.place(edge)
    );
    let cure = Some(format!(
        "a longer ramp of the load {name:?} in the machine file, or --pieces auto, a table for each piece between edges"
    ));
    Some(Feature { words, cure })
}

fn piece_end(file: &MachineFile, coordinate: Coordinate, at: f64, near: f64) -> Option<String> {
    let mechanism = file.machine.mechanism();
    let contacts = mechanism.contacts().iter();
    let ends = contacts.flat_map(|c| c.pieces.iter().flat_map(|p| [p.from, p.to]));
    let nearest = ends
        .map(|end| (distance(mechanism.domain(), end, at), end))
        .min_by(|a, b| a.0.total_cmp(&b.0))?;
    (nearest.0 <= near).then(|| {
        format!(
            "a segment of the cam's program ends at {}",
            coordinate.place(nearest.1)
        )
    })
}

/// Name of a curve in messages.
type CurveName = fn(Coordinate) -> String;

/// A curve of the reduced machine.
type CurveValue = fn(&Reduction) -> f64;

/// The curves that a table follows.
const CURVES: [(CurveName, CurveValue); 5] = [
    (|c| c.inertia().to_owned(), |r| r.inertia),
    (|c| format!("{}'", c.inertia()), |r| r.inertia_slope),
    (|_| "the curve of load".to_owned(), |r| r.load_torque()),
    (|_| "the curve of viscous".to_owned(), |r| r.viscous),
    (|_| "the curve of coulomb".to_owned(), |r| r.coulomb),
];

fn jump_or_kink(
    machine: &impl Reducible,
    coordinate: Coordinate,
    at: f64,
    near: f64,
) -> Result<Option<Feature>, Error> {
    let domain = machine.domain();
    let ends = match domain {
        Domain::Turn => [at - near, at + near],
        Domain::Stroke { from, to } => [(at - near).max(from), (at + near).min(to)],
    };
    for (name, curve) in CURVES {
        let value = |phi: f64| -> Result<f64, Error> { Ok(curve(&machine.reduction(phi)?)) };
        let step = 1e-7 * domain.span();
        let slope = |phi: f64| {
            let [low, high] = match domain {
                Domain::Turn => [phi - step, phi + step],
                Domain::Stroke { from, to } => [(phi - step).max(from), (phi + step).min(to)],
            };
            Ok((value(high)? - value(low)?) / (high - low))
        };
        for (what, found) in [
            ("jumps", narrow(&value, ends, 0.0)?),
            ("has a kink", narrow(&slope, ends, 2.0 * step)?),
        ] {
            if let Some(phi) = found {
                let words = format!("{} {what} at {}", name(coordinate), coordinate.place(phi));
                return Ok(Some(Feature { words, cure: None }));
            }
        }
    }
    Ok(None)
}

/// Finds a step of a function within an interval: repeatedly selects the part whose difference deviates most from its neighbours. A step keeps its
/// size. The search ends at `finest`.
fn narrow(
    f: &impl Fn(f64) -> Result<f64, Error>,
    [mut from, mut to]: [f64; 2],
    finest: f64,
) -> Result<Option<f64>, Error> {
    const PARTS: u32 = 16;
    const DEPTH: u32 = 8;
    // In an interval of three parts of the last one, the value is 150 times smaller for a smooth curve, 5 times for a kink.
    const JUMP_SHARE: f64 = 0.5;
    let mut first = None;
    for depth in 0..DEPTH {
        if depth > 1 && to - from < finest * f64::from(PARTS) {
            break;
        }
        let at = |k: u32| from + (to - from) * f64::from(k) / f64::from(PARTS);
        let values = (0..=PARTS).map(|k| f(at(k)));
        let values = values.collect::<Result<Vec<f64>, Error>>()?;
        let size = values
            .iter()
            .fold(0.0, |most: f64, value| most.max(value.abs()));
        let steps: Vec<f64> = values.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let odd = |triple: &[f64]| (triple[1] - 0.5 * (triple[0] + triple[2])).abs();
        let best = (1..).zip(steps.windows(3).map(odd));
        let Some((k, step)) = best.max_by(|a: &(u32, f64), b| a.1.total_cmp(&b.1)) else {
            return Ok(None);
        };
        // Only rounding, or smooth.
        if step <= 1e-6 * size || step < JUMP_SHARE * *first.get_or_insert(step) {
            return Ok(None);
        }
        (from, to) = (at(k - 1), at(k + 2));
    }
    Ok(Some(0.5 * (from + to)))
}
