//! The rotation of a roller that rolls on the cam.
//!
//! Without slip the roller's rim has the velocity of the cam at the point of contact. Relative to the cam its centre moves along the pitch curve with
//! |w| (see the geometry), so that
//!
//! ```text
//! ψ_r = φ − L(φ)/r_r        ψ_r′ = 1 − |w|/r_r        L: length of the pitch curve from φ = 0
//! ```
//!
//! The transfer functions are exact. The angle itself is integrated by Gauss's formula piece by piece; nothing depends on it, because the roller is
//! round and balanced.

use core::convert::Infallible;
use core::f64::consts::TAU;

use super::geometry::Geometry;
use crate::math;
use crate::mechanism::cam::{MAX_SEGMENTS, Program};
use crate::number::quadrature::integrate;
use crate::number::transfer::Transfer;

/// A segment has at most five pieces.
const MAX_PIECES: usize = 5 * MAX_SEGMENTS;

/// Widest panel (rad), with five nodes each: for the fastest law within 60° the error is 1e-11 of the length.
const PANEL: f64 = 0.25;

/// The length of the pitch curve up to each piece.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Spin {
    /// φ and L at the start of each piece.
    starts: heapless::Vec<[f64; 2], MAX_PIECES>,
    /// Length of the whole curve (m).
    turn: f64,
}

impl Spin {
    pub(super) fn new(program: &Program, geometry: &Geometry) -> Self {
        let mut starts = heapless::Vec::new();
        let mut turn = 0.0;
        for piece in program.pieces() {
            // Cannot fail: a segment has at most five pieces.
            let _ = starts.push([piece.from, turn]);
            turn += length(program, geometry, piece.from, piece.to);
        }
        Self { starts, turn }
    }

    /// ψ_r at `phi`, with the speed `pitch_speed` along the pitch curve.
    pub(super) fn angle(
        &self,
        program: &Program,
        geometry: &Geometry,
        phi: f64,
        pitch_speed: Transfer,
    ) -> Transfer {
        let radius = geometry.follower.roller_radius();
        let turns = math::floor(phi / TAU);
        let into = phi - TAU * turns;
        let at = self.starts.partition_point(|[from, _]| *from <= into);
        let [from, before] = self.starts.get(at.max(1) - 1).copied().unwrap_or_default();
        let along = turns * self.turn + before + length(program, geometry, from, into);
        Transfer {
            value: phi - along / radius,
            d1: 1.0 - pitch_speed.value / radius,
            d2: -pitch_speed.d1 / radius,
            d3: -pitch_speed.d2 / radius,
        }
    }
}

/// Length of the pitch curve from `from` to `to`, within one piece.
fn length(program: &Program, geometry: &Geometry, from: f64, to: f64) -> f64 {
    let panels = 1 + ((to - from) / PANEL) as u32;
    let speed = |phi| Ok::<_, Infallible>(geometry.pitch_speed(program.displacement(phi)));
    match integrate(from, to, panels, speed) {
        Ok(length) => length,
        Err(never) => match never {},
    }
}
