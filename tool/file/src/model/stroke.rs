//! A mechanism of which only a part of the range is used: an axis with ends.

use std::f64::consts::TAU;
use std::sync::Arc;

use jred::Domain;
use jred::machine::{Frames, Jointed, Joints, Link, Mechanism, PoseError};

use super::mechanism::Inner;

/// A mechanism on a stroke of its drive link, which may be a part of a turn.
#[derive(Clone, Debug)]
pub(super) struct StrokeMechanism {
    inner: Arc<dyn Inner>,
    domain: Domain,
    edges: Vec<f64>,
}

impl StrokeMechanism {
    /// The mechanism on its whole range.
    pub(super) fn inner(&self) -> &dyn Inner {
        self.inner.as_ref()
    }

    /// The mechanism from one position to another.
    pub(super) fn new(inner: Arc<dyn Inner>, [from, to]: [f64; 2]) -> Self {
        // An edge of the turn, in every turn on the stroke, except at its ends.
        let repeats = inner.domain() == Domain::Turn;
        let mut edges = Vec::new();
        for edge in (0..).map_while(|k| inner.edge(k)) {
            let ahead = if repeats {
                (edge - from).rem_euclid(TAU)
            } else {
                edge - from
            };
            let turns = if repeats { (to - from) / TAU } else { 0.0 };
            let places = (0..=turns as u32).map(|k| ahead + f64::from(k) * TAU);
            let inside = places.filter(|place| *place > 0.0 && *place < to - from);
            edges.extend(inside.map(|place| from + place));
        }
        edges.sort_by(f64::total_cmp);
        Self {
            domain: Domain::Stroke { from, to },
            edges,
            inner,
        }
    }
}

impl Mechanism for StrokeMechanism {
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

impl Jointed for StrokeMechanism {
    fn joints(&self, phi: f64, frames: &Frames) -> Result<Joints, PoseError> {
        self.inner.joints(phi, frames)
    }
    fn drive(&self) -> usize {
        self.inner.drive()
    }
    fn determined(&self, phi: f64) -> bool {
        self.inner.determined(phi)
    }
}
