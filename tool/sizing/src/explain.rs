//! Why a drive comes out as it does: what its torque and its inertia are made of, and what would have to change for it to
//! hold.

mod altered;
mod breakdown;
mod course;
mod remedy;
mod seek;
mod words;

pub use altered::{Alteration, Altered};
pub use breakdown::{Breakdown, Cell, Cells, Effect, InertiaShare, Share};
pub use course::ratio_course;
pub use remedy::{Edge, Lever, Miss, Remedies, Remedy};
