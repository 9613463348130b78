//! The result of a proof.

use jred_enclosure::{Proof, ProofError};

/// Result of a proof.
#[derive(Clone, Debug, PartialEq)]
pub enum ProofResult {
    /// The error is bounded.
    Bounded(Proof),
    /// It could not be bounded.
    Open(ProofError),
}

impl ProofResult {
    /// The bound: of the ticks, or of the table if the tick's arithmetic is not proven.
    pub fn bound(&self) -> Option<f64> {
        match self {
            Self::Bounded(proof) => Some(proof.ticked.unwrap_or(proof.bound)),
            Self::Open(_) => None,
        }
    }
}
