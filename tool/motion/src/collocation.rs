//! What the programmes for the gentlest and for the fastest motion share: the way as a path over a parameter u, and the square of the pace
//! du/dt along it in elements, whose equations hold at stations.
//!
//! - [`shape`]: the path, which gives the motion the form of its ends;
//! - [`pieces`]: unknowns at the ends of elements, and the cubic between them;
//! - [`torque`]: the motor torque at a station, with its derivatives.

pub(crate) mod pieces;
pub(crate) mod shape;
pub(crate) mod torque;
