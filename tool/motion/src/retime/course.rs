//! The gentlest motion as nodes over the time.

use jred_machine::model::machine::MachineFile;
use jred_machine::model::motion::Phase;

use crate::gentlest::Gentle;
use crate::moves::Part;
use crate::trace::{Node, Trace};

/// The motion as nodes.
pub(super) fn trace(file: &MachineFile, parts: &[Part], moves: &[Gentle]) -> Trace {
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

fn nodes(from: f64, phases: &[Phase]) -> Vec<Node> {
    let mut nodes: Vec<Node> = Vec::with_capacity(phases.len() + 1);
    let (mut t, mut phi) = (0.0, from);
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
        let [way, omega, alpha, _] = phase.polynomial.at(phase.duration);
        t += phase.duration;
        phi += way;
        nodes.push(Node {
            t,
            step: phase.duration,
            phi,
            omega,
            alpha: [alpha, 0.0],
        });
    }
    nodes
}
