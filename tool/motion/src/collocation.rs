//! What the programmes for the gentlest and for the fastest motion share: the way as a path over a parameter u, and the square of the pace
//! du/dt along it in elements, whose equations hold at stations.
//!
//! - [`shape`]: the path, which gives the motion the form of its ends;
//! - [`pieces`]: unknowns at the ends of elements, and the cubic between them;
//! - [`torque`]: the motor torque at a station, with its derivatives.

pub(crate) mod pieces;
pub(crate) mod shape;
pub(crate) mod torque;

/// The form of the ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ends {
    pub(crate) rest: [bool; 2],
    pub(crate) ramp: f64,
    pub(crate) ring: bool,
}
