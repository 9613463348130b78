//! The gentlest motion as nodes over time.

use jred_file::model::machine::MachineFile;
use jred_file::model::motion::Phase;

use crate::gentlest::LeastEffortMove;
use crate::moves::Part;
use crate::trace::{Node, Trace};

/// The motion as nodes.
pub(super) fn trace(file: &MachineFile, parts: &[Part], moves: &[LeastEffortMove]) -> Trace {
    let coordinate = file.machine.mechanism().coordinate();
    let start = parts.first().map_or(0.0, Part::from);
    let mut trace = Trace::from_rest(coordinate, start);
    let mut moves = moves.iter();
    for part in parts {
        match part {
            Part::Dwell { duration, .. } => trace.dwell(*duration),
            Part::Kept(kept) => trace.then(kept.nodes()),
            Part::Move(step) | Part::Passing(step, _) => {
                let phases = moves.next().map_or(&[][..], |gentle| &gentle.phases);
                trace.then(&nodes(step.from, phases));
            }
        }
    }
    trace
}

/// Share of the path by which the positions of a phase may differ from the integral of its speeds: between nodes the speeds are cubics, but those of
/// a phase have one degree more.
const SAME: f64 = 1e-13;

/// Most parts of a phase.
const MOST_PARTS: f64 = 64.0;

fn nodes(from: f64, phases: &[Phase]) -> Vec<Node> {
    let mut nodes: Vec<Node> = Vec::with_capacity(phases.len() + 1);
    let (mut t, mut phi) = (0.0, from);
    let ways = (phases.iter()).map(|phase| phase.polynomial.at(phase.duration)[0].abs());
    let whole: f64 = ways.sum();
    for phase in phases {
        let [_, omega, alpha, _] = phase.polynomial.at(0.0);
        match nodes.last_mut() {
            Some(node) => node.alpha[1] = alpha,
            None => nodes.push(Node {
                t,
                step: 0.0,
                phi,
                omega,
                alpha: [0.0, alpha],
            }),
        }
        let begin = (t, phi);
        let at = |share: f64| {
            let since = phase.duration * share;
            let [way, omega, alpha, _] = phase.polynomial.at(since);
            Node {
                t: begin.0 + since,
                step: since,
                phi: begin.1 + way,
                omega,
                alpha: [alpha; 2],
            }
        };
        let end = at(1.0);
        let [rest, _] = end.missed_since(&at(0.0));
        // The error falls with the fifth power of the step.
        let parts = (rest.abs() / (SAME * whole)).sqrt().sqrt().ceil();
        let parts = if parts.is_finite() {
            parts.clamp(1.0, MOST_PARTS)
        } else {
            1.0
        };
        for k in 1..=parts as u32 {
            let node = at(f64::from(k) / parts);
            nodes.push(Node {
                step: phase.duration / parts,
                ..node
            });
        }
        if let Some(last) = nodes.last_mut() {
            last.alpha[1] = 0.0;
        }
        (t, phi) = (end.t, end.phi);
    }
    nodes
}
