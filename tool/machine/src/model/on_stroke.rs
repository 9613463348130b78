//! A mechanism of which only a part of the range is used: an axis that ends.

use std::sync::Arc;

use jred::machine::{Frames, Jointed, Joints, Mechanism, PoseError};
use jred::{Domain, Link};

use super::mechanism::Inner;

/// A mechanism on a stroke of its drive link.
#[derive(Clone, Debug)]
pub(super) struct OnStroke {
    pub(super) inner: Arc<dyn Inner>,
    pub(super) domain: Domain,
}

impl Mechanism for OnStroke {
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
        self.inner.edge(k)
    }
}

impl Jointed for OnStroke {
    fn joints(&self, phi: f64, frames: &Frames) -> Result<Joints, PoseError> {
        self.inner.joints(phi, frames)
    }
    fn drive(&self) -> usize {
        self.inner.drive()
    }
}
