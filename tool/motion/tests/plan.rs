//! A motion as a plan that firmware follows.

use jred::Reducible as _;
use jred::axis::plan::{HEADER_WORDS, PlanError};
use jred_machine::model::coordinate::Coordinate;
use jred_machine::read;
use jred_motion::fastest::Limits;
use jred_motion::fastest::cycle::cycle;
use jred_motion::moves::parts;
use jred_motion::plan::{Plan, SHARE};
use jred_motion::trace::{Node, Trace};

use crate::fastest::torque_motor;
use crate::support::press_text;

fn node(t: f64, step: f64, phi: f64, omega: f64, alpha: [f64; 2]) -> Node {
    Node {
        t,
        step,
        phi,
        omega,
        alpha,
    }
}
