//! Collocation shared by the programmes for the gentlest and the fastest motion. The path is a function of a parameter u. The square of the pace
//! du/dt is interpolated in elements, whose equations are satisfied at stations.
//!
//! - [`shape`]: the path, which adapts the motion to its ends;
//! - [`pieces`]: unknowns at the ends of elements, and the cubic between them;
//! - [`torque`]: the motor torque at a station, with its derivatives.

pub(crate) mod pieces;
pub(crate) mod shape;
pub(crate) mod torque;
