//! A torque at a station, with first and second derivatives with respect to the values of its piece.

use super::mesh::{Local, Station};
use crate::collocation::torque::Torque;
use crate::path_dynamics::{Demand, Place};

/// A motion at a station.
pub(super) struct StationState {
    pub(super) speed: f64,
    pub(super) acceleration: f64,
    pub(super) w: f64,
    /// Speed per √w.
    pub(super) pace: f64,
    pub(super) by: Local,
}

/// A torque at a station.
#[derive(Clone, Copy)]
pub(super) struct Effort {
    pub(super) value: f64,
    pub(super) gradient: Local,
    /// Factor of the square of w's basis in the second derivatives.
    pub(super) bend: f64,
    /// Where power changes direction: a factor, and the linear form whose square it multiplies.
    pub(super) turn: (f64, Local),
}

impl Effort {
    /// The torque with its derivatives; `rate`: slope of the torque by the speed itself; bends are rounded over loads ± `range`.
    pub(super) fn of(
        station: &Station,
        state: &StationState,
        rate: f64,
        range: f64,
        demand: impl Fn(&Place) -> Demand,
    ) -> Self {
        let place = &station.place;
        let torque = Torque::rounded_of(place, state.acceleration, range, demand);
        let root = state.w.sqrt();
        let own = &station.basis[0];
        let per_root = state.pace / (2.0 * root);
        let load_by_w =
            0.5 * place.inertia_slope * state.pace * state.pace + place.viscous * per_root;
        let friction = torque.by_load * place.viscous + rate;
        Self {
            value: torque.value,
            gradient: mix(
                (torque.by_load * load_by_w + rate * per_root, own),
                (torque.by_acceleration, &state.by),
            ),
            bend: -0.25 * friction * state.pace / (state.w * root),
            turn: (torque.bend, mix((load_by_w, own), (torque.lean, &state.by))),
        }
    }

    /// The part of a term's second derivatives from the bend of the torque, times a factor.
    pub(super) const fn turned(&self, factor: f64) -> (f64, Local) {
        (factor * self.turn.0, self.turn.1)
    }
}

/// p·a + q·b
pub(super) fn mix((p, a): (f64, &Local), (q, b): (f64, &Local)) -> Local {
    std::array::from_fn(|k| p * a[k] + q * b[k])
}
