//! Why a proof fails.

use thiserror::Error;

/// Why a proof fails.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ProofError {
    /// A joint with teeth, a cam, a rope or a belt, whose equations do not contain its geometry.
    #[error("joint number {} transmits by contact, and its curves are not enclosed", number + 1)]
    Joint {
        /// Its index.
        number: usize,
    },
    /// The drive moves neither a pin nor a guide.
    #[error("the drive moves neither a pin nor a guide")]
    Drive,
    /// The joints do not leave exactly one degree of freedom.
    #[error("the joints make {equations} equations for {coordinates} coordinates")]
    Freedoms {
        /// Number of equations.
        equations: usize,
        /// Number of coordinates.
        coordinates: usize,
    },
    /// A pose around a position cannot be proven to be unique.
    #[error(
        "the pose of the links at {phi:.6} (rad, or m) is not proven: it is close to a dead point"
    )]
    Pose {
        /// The position (rad, or m).
        phi: f64,
    },
    /// A spring or damper whose ends may meet.
    #[error("the ends of spring or damper number {} may meet at {phi:.6} (rad, or m)", number + 1)]
    EndsMeet {
        /// Its index.
        number: usize,
        /// The position (rad, or m).
        phi: f64,
    },
    /// A table without cells.
    #[error("{layout} has no cells: its curves are not enclosed")]
    Layout {
        /// Its name.
        layout: &'static str,
    },
    /// A part of the machine that the caller cannot enclose.
    #[error("{0}")]
    Part(String),
    /// No finite bound was found around a position, even on short stretches.
    #[error("no bound was found around {phi:.6} (rad, or m)")]
    Unbounded {
        /// The position (rad, or m).
        phi: f64,
    },
    /// More stretches than allowed: the machine has too many features.
    #[error("more than {most} stretches are needed")]
    TooLong {
        /// The limit of their number.
        most: u64,
    },
    /// The caller stopped the proof.
    #[error("stopped")]
    Stopped,
}
