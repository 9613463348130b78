//! Rates of acceleration and torque along u at a station, with derivatives with respect to the values of its piece.
//!
//! ```text
//! da/du = L·(g‴·w + 3/2·g″·w′ + ½·g′·w″)/t²
//! dT/du = ∂T/∂R·(½·J″·v² + ½·J′·(v²)′ + F′ + b′·v + b·v′ + J′·a) + ∂T/∂a·a′ + c·v′
//! ```
//!
//! with slopes by u. Times √w/t they are rates by time: |da/du| ≤ t·j/√w.

use super::effort::{StationState, mix};
use super::mesh::{Local, Station, VALUES};
use crate::collocation::pieces::dot;
use crate::collocation::torque::{SLOPE_TOLERANCE, Torque};
use crate::path_dynamics::{Demand, Place};

/// The slopes of a torque averaged over loads ± `range` a second time: Newton's method needs a continuous gradient.
pub(super) fn smooth_slopes(
    place: &Place,
    acceleration: f64,
    range: f64,
    demand: impl Fn(&Place) -> Demand,
) -> Torque {
    let at = |by: f64| {
        let place = Place {
            load: place.load + by,
            ..*place
        };
        Torque::rounded_of(&place, acceleration, range, &demand)
    };
    let own = at(0.0);
    let [low, high] = [-range, range].map(at);
    let rise = high.by_load - low.by_load;
    if rise <= SLOPE_TOLERANCE * high.by_load {
        return own;
    }
    let lean = (high.by_acceleration - low.by_acceleration) / rise;
    let by_load = 0.5 * (high.value - low.value) / range;
    Torque {
        by_load,
        by_acceleration: own.by_acceleration + lean * (by_load - own.by_load),
        bend: 0.5 * rise / range,
        lean,
        ..own
    }
}

/// A slope by u.
pub(super) struct Rate {
    pub(super) value: f64,
    pub(super) gradient: Local,
    /// Factor of the square of w's basis in the second derivatives.
    pub(super) bend: f64,
    /// Where power changes direction: factors, and the linear forms whose squares they multiply.
    pub(super) turn: [(f64, Local); 2],
}

impl Rate {
    /// The rate of the acceleration, with t the unit of time.
    pub(super) fn of_acceleration(station: &Station, values: &Local, t: f64) -> Self {
        let [slope, bend, third] = station.path.map(|path| path / (t * t));
        let [own, change, curve] = &station.basis;
        let gradient = mix(
            (1.0, &mix((third, own), (1.5 * bend, change))),
            (0.5 * slope, curve),
        );
        Self {
            value: dot(&gradient, values),
            gradient,
            bend: 0.0,
            turn: [(0.0, [0.0; VALUES]); 2],
        }
    }

    /// The rate of a torque that rises by `friction` with the speed itself.
    pub(super) fn of_torque(
        station: &Station,
        values: &Local,
        state: &StationState,
        torque: &Torque,
        friction: f64,
        t: f64,
    ) -> Self {
        let place = &station.place;
        let by_u = &station.change;
        let [own, change, _] = &station.basis;
        let pace = state.pace;
        let pace_by_u = station.path[1] / t;
        let (w, root) = (state.w, state.w.sqrt());
        let acceleration = Self::of_acceleration(station, values, t);
        // v′ = p′·√w + p·w′/(2·√w)
        let w_by_u = dot(change, values);
        let speed = pace_by_u * root + 0.5 * pace * w_by_u / root;
        let speed_by = mix(
            (
                0.5 * pace_by_u / root - 0.25 * pace * w_by_u / (w * root),
                own,
            ),
            (0.5 * pace / root, change),
        );
        let speed_bend = (0.375 * pace * w_by_u / w - 0.25 * pace_by_u) / (w * root);
        // Change of the load, without J·a′.
        let straight = mix(
            (
                0.5 * by_u.inertia_slope * pace * pace + place.inertia_slope * pace * pace_by_u,
                own,
            ),
            (0.5 * place.inertia_slope * pace * pace, change),
        );
        let straight = mix((1.0, &straight), (by_u.inertia, &state.by));
        let load =
            dot(&straight, values) + by_u.load + by_u.viscous * pace * root + place.viscous * speed;
        let load_by = mix((1.0, &straight), (0.5 * by_u.viscous * pace / root, own));
        let load_by = mix((1.0, &load_by), (place.viscous, &speed_by));
        let viscous = torque.by_load * place.viscous + friction;
        let steady = mix((torque.by_load, &load_by), (friction, &speed_by));
        let steady = mix(
            (1.0, &steady),
            (torque.by_acceleration, &acceleration.gradient),
        );
        // Where the torque bends, its slopes change with the load.
        let load_by_w = 0.5 * place.inertia_slope * pace * pace + 0.5 * place.viscous * pace / root;
        let turn = &mix((load_by_w, own), (torque.lean, &state.by));
        let bend = torque.bend;
        let across = mix((1.0, &load_by), (torque.lean, &acceleration.gradient));
        let moved = bend * (load + torque.lean * acceleration.value);
        Self {
            value: torque.by_load * load
                + torque.by_acceleration * acceleration.value
                + friction * speed,
            gradient: mix((1.0, &steady), (moved, turn)),
            bend: viscous * speed_bend - 0.25 * torque.by_load * by_u.viscous * pace / (w * root),
            turn: [
                (0.5 * bend, mix((1.0, turn), (1.0, &across))),
                (-0.5 * bend, mix((1.0, turn), (-1.0, &across))),
            ],
        }
    }
}
