//! The figures that docs/closed-loop.md and the README state.

use crate::feed_forward::Way;
use crate::machine::{CASES, Deviation};
use crate::study::{Bench, Solver};
