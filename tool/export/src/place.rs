//! Features that make a curve hard to approximate at one position: the edge of a load's window, the end of a cam segment, a
//! jump, a kink.

use std::f64::consts::TAU;

use jred::Domain;
use jred::error::Error;
use jred::machine::{Mechanism as _, Reducible, Reduction};

use jred_file::model::machine::MachineFile;

/// A feature of a machine.
#[derive(Clone, Debug)]
pub enum Feature {
    /// An edge of a load's window.
    Window {
        /// Name of the load.
        load: String,
        /// The edge.
        edge: WindowEdge,
        /// Its position (rad, or m).
        at: f64,
        /// Length of the ramp (rad, or m).
        ramp: f64,
    },
    /// The end of a cam segment (rad, or m), without a jump or a kink of a curve.
    SegmentEnd(f64),
    /// A jump or a kink.
    Break {
        /// The curve.
        curve: CurveName,
        /// Whether its value jumps, not its slope.
        jumps: bool,
        /// The position (rad, or m).
        at: f64,
        /// End of a cam segment there (rad, or m).
        segment_end: Option<f64>,
    },
}

/// An edge of a load's window.
#[derive(Clone, Copy, Debug)]
pub enum WindowEdge {
    /// The load begins.
    Begins,
    /// It is full.
    Full,
    /// It begins to fall.
    Falls,
    /// It ends.
    Ends,
}

/// A curve of the reduced machine that a table follows.
#[derive(Clone, Copy, Debug)]
pub enum CurveName {
    /// Inertia.
    Inertia,
    /// Its slope.
    Slope,
    /// Load.
    Load,
    /// Viscous friction.
    Viscous,
    /// Coulomb friction.
    Coulomb,
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
    at: f64,
    near: f64,
) -> Result<Option<Feature>, Error> {
    if let Some(found) = window_edge(file, at, near) {
        return Ok(Some(found));
    }
    let segment_end = segment_end(file, at, near);
    let found = jump_or_kink(machine, at, near)?;
    Ok(match found {
        Some((curve, jumps, at)) => Some(Feature::Break {
            curve,
            jumps,
            at,
            segment_end,
        }),
        None => segment_end.map(Feature::SegmentEnd),
    })
}

fn window_edge(file: &MachineFile, at: f64, near: f64) -> Option<Feature> {
    const EDGES: [WindowEdge; 4] = [
        WindowEdge::Begins,
        WindowEdge::Full,
        WindowEdge::Falls,
        WindowEdge::Ends,
    ];
    let domain = file.machine.mechanism().domain();
    let edges = file.loads.iter().filter_map(|load| {
        let edges = load.load.window()?.edges();
        let all = EDGES.into_iter().zip(edges);
        let all = all.map(|(edge, position)| (distance(domain, position, at), edge, position));
        let (away, edge, position) = all.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let found = || Feature::Window {
            load: load.name.clone(),
            edge,
            at: position,
            ramp: edges[1] - edges[0],
        };
        (away <= near).then(|| (away, found()))
    });
    edges
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, feature)| feature)
}

fn segment_end(file: &MachineFile, at: f64, near: f64) -> Option<f64> {
    let mechanism = file.machine.mechanism();
    let contacts = mechanism.contacts().iter();
    let ends = contacts.flat_map(|c| c.pieces.iter().flat_map(|p| [p.from, p.to]));
    let nearest = ends
        .map(|end| (distance(mechanism.domain(), end, at), end))
        .min_by(|a, b| a.0.total_cmp(&b.0))?;
    (nearest.0 <= near).then_some(nearest.1)
}

/// A curve of the reduced machine.
type CurveValue = fn(&Reduction) -> f64;

/// The curves that a table follows.
const CURVES: [(CurveName, CurveValue); 5] = [
    (CurveName::Inertia, |r| r.inertia),
    (CurveName::Slope, |r| r.inertia_slope),
    (CurveName::Load, |r| r.load_torque()),
    (CurveName::Viscous, |r| r.viscous),
    (CurveName::Coulomb, |r| r.coulomb),
];

/// The curve, whether it jumps, and the position.
fn jump_or_kink(
    machine: &impl Reducible,
    at: f64,
    near: f64,
) -> Result<Option<(CurveName, bool, f64)>, Error> {
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
        if let Some(at) = narrow(&value, ends, 0.0)? {
            return Ok(Some((name, true, at)));
        }
        if let Some(at) = narrow(&slope, ends, 2.0 * step)? {
            return Ok(Some((name, false, at)));
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
