//! A part of the turn as the range of a drive link that could turn fully.

use std::f64::consts::TAU;

use jred::machine::{Frames, Jointed, Joints, Mechanism, PoseError};
use jred::{Domain, Link};

use crate::model::mechanism::AnyMechanism;

/// A mechanism whose drive link swings between two positions of its turn.
#[derive(Clone, Debug)]
pub(crate) struct Swing {
    inner: AnyMechanism,
    domain: Domain,
    edges: Vec<f64>,
}

impl Swing {
    /// Over this stroke of at most a turn.
    pub(crate) fn new(inner: AnyMechanism, [from, to]: [f64; 2]) -> Self {
        // An edge of the turn, where it lies on the stroke; at its start and at its end there is none.
        let on_stroke = |edge: f64| {
            let ahead = (edge - from).rem_euclid(TAU);
            (0.0 < ahead && ahead < to - from).then_some(from + ahead)
        };
        let edges = (0..).map_while(|k| inner.edge(k)).filter_map(on_stroke);
        let mut edges: Vec<f64> = edges.collect();
        edges.sort_by(f64::total_cmp);
        Self {
            domain: Domain::Stroke { from, to },
            edges,
            inner,
        }
    }
}

impl Mechanism for Swing {
    fn links(&self) -> &[Link] {
        self.inner.links()
    }
    fn domain(&self) -> Domain {
        self.domain
    }
    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        self.inner.frames(phi)
    }
    fn edge(&self, k: usize) -> Option<f64> {
        self.edges.get(k).copied()
    }
}

impl Jointed for Swing {
    fn joints(&self, phi: f64, frames: &Frames) -> Result<Joints, PoseError> {
        self.inner.joints(phi, frames)
    }
    fn drive(&self) -> usize {
        self.inner.drive()
    }
}
