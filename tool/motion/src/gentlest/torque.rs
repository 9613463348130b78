//! The motor torque with its derivatives, its bends rounded over a narrow range of the load.
//!
//! The torque rises with the load R at the drive link in straight lines that meet where the power at a stage changes its direction.
//! Newton's method needs a second derivative there: the torque is averaged over R ± r, which makes each bend a parabola.

use crate::way::{Demand, Place, Way};

/// The torque at a place, a speed and an acceleration.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Torque {
    /// T (N·m).
    pub(crate) value: f64,
    /// ∂T/∂R.
    pub(crate) by_load: f64,
    /// ∂T/∂a.
    pub(crate) by_acceleration: f64,
    /// ∂²T/∂R², not negative.
    pub(crate) bend: f64,
    /// What moves a bend: it stays at R + lean·a.
    pub(crate) lean: f64,
}

/// Shares of the slopes that differ by less are one.
const STRAIGHT: f64 = 1e-9;

impl Torque {
    /// Without rounding.
    pub(super) fn exact(way: &Way, place: &Place, speed: f64, acceleration: f64) -> Self {
        Self::of(place, acceleration, |place| {
            way.demand(place, speed, acceleration)
        })
    }

    /// Without rounding, of what a state asks for at any shaft.
    pub(crate) fn of(
        place: &Place,
        acceleration: f64,
        demand_of: impl Fn(&Place) -> Demand,
    ) -> Self {
        let demand = demand_of(place);
        // The same state with another share of the torque in the inertia: what the slope differs by is the load's.
        let bare = Place {
            inertia: 0.0,
            load: place.load + place.inertia * acceleration,
            ..*place
        };
        let by_load = if place.inertia > 0.0 {
            let bare = demand_of(&bare).per_acceleration;
            (demand.per_acceleration - bare) / place.inertia
        } else {
            0.0
        };
        Self {
            value: demand.torque,
            by_load,
            by_acceleration: demand.per_acceleration,
            ..Self::default()
        }
    }

    /// Averaged over the loads R ± `range`.
    pub(super) fn rounded(
        way: &Way,
        place: &Place,
        [speed, acceleration]: [f64; 2],
        range: f64,
    ) -> Self {
        Self::rounded_of(place, acceleration, range, |place| {
            way.demand(place, speed, acceleration)
        })
    }

    /// The same of what a state asks for at any shaft.
    pub(crate) fn rounded_of(
        place: &Place,
        acceleration: f64,
        range: f64,
        demand_of: impl Fn(&Place) -> Demand,
    ) -> Self {
        if range == 0.0 {
            return Self::of(place, acceleration, demand_of);
        }
        let [low, high] = [-range, range].map(|by| {
            let place = Place {
                load: place.load + by,
                ..*place
            };
            Self::of(&place, acceleration, &demand_of)
        });
        let rise = high.by_load - low.by_load;
        if rise <= STRAIGHT * high.by_load {
            return Self {
                value: 0.5 * (low.value + high.value),
                ..low
            };
        }
        // Where the two lines meet, as a share of the range.
        let meet = (high.value - low.value) / range - high.by_load - low.by_load;
        let share = (0.5 - 0.5 * meet / rise).clamp(0.0, 1.0);
        let mix = |a: f64, b: f64| share * a + (1.0 - share) * b;
        let [left, right] = [share, 1.0 - share].map(|part| part * range);
        Self {
            // The mean of two straight lines, each over its own part.
            value: share * (low.value + low.by_load * left)
                + (1.0 - share) * (high.value - high.by_load * right),
            by_load: mix(low.by_load, high.by_load),
            by_acceleration: mix(low.by_acceleration, high.by_acceleration),
            bend: 0.5 * rise / range,
            lean: (high.by_acceleration - low.by_acceleration) / rise,
        }
    }
}
