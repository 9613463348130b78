//! The motor torque with its derivatives, with rounded bends.
//!
//! The torque is piecewise linear in the load R at the drive link. It bends where the power at a stage changes direction. Newton's method needs a
//! second derivative there, so the torque is averaged over R ± r, which makes each bend a parabola.

use crate::path_dynamics::{Demand, PathDynamics, Place};

/// The torque for a place, a speed and an acceleration.
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
    /// A bend moves with the acceleration: it stays at R + lean·a.
    pub(crate) lean: f64,
}

/// Relative difference below which two slopes count as equal.
pub(crate) const SLOPE_TOLERANCE: f64 = 1e-9;

/// Most bends in one range. Without it, loads so large that their last digits exceed the range would show any number.
const MOST_BENDS: u32 = 8;

impl Torque {
    /// Without rounding.
    pub(crate) fn exact(
        dynamics: &PathDynamics,
        place: &Place,
        speed: f64,
        acceleration: f64,
    ) -> Self {
        Self::of(place, acceleration, |place| {
            dynamics.demand(place, speed, acceleration)
        })
    }

    /// Without rounding, for the demand of a state at any shaft.
    pub(crate) fn of(
        place: &Place,
        acceleration: f64,
        demand_of: impl Fn(&Place) -> Demand,
    ) -> Self {
        let demand = demand_of(place);
        // The same state with another share of the torque in the inertia: the change of the slope comes from the load.
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
    pub(crate) fn rounded(
        dynamics: &PathDynamics,
        place: &Place,
        [speed, acceleration]: [f64; 2],
        range: f64,
    ) -> Self {
        Self::rounded_of(place, acceleration, range, |place| {
            dynamics.demand(place, speed, acceleration)
        })
    }

    /// [`Self::rounded`] for the demand of a state at any shaft.
    pub(crate) fn rounded_of(
        place: &Place,
        acceleration: f64,
        range: f64,
        demand_of: impl Fn(&Place) -> Demand,
    ) -> Self {
        if range == 0.0 {
            return Self::of(place, acceleration, demand_of);
        }
        let at = |by: f64| {
            let place = Place {
                load: place.load + by,
                ..*place
            };
            Self::of(&place, acceleration, &demand_of)
        };
        let [low, high] = [-range, range].map(at);
        let rise = high.by_load - low.by_load;
        if rise <= SLOPE_TOLERANCE * high.by_load {
            return Self {
                value: 0.5 * (low.value + high.value),
                ..low
            };
        }
        let [value, by_acceleration] = mean([-range, range], [low, high], &at, MOST_BENDS);
        Self {
            value,
            by_load: 0.5 * (high.value - low.value) / range,
            by_acceleration,
            bend: 0.5 * rise / range,
            lean: (high.by_acceleration - low.by_acceleration) / rise,
        }
    }
}

/// Means of the torque and of its slope by the acceleration over a range of loads, where it is `ends` at the two borders. The torque is linear while
/// the power flows one way. A machine with two lossy stages has two bends, which may lie in the same range.
fn mean(
    [from, to]: [f64; 2],
    ends: [Torque; 2],
    at: &impl Fn(f64) -> Torque,
    bends: u32,
) -> [f64; 2] {
    let [low, high] = ends;
    let width = to - from;
    let rise = high.by_load - low.by_load;
    if rise <= SLOPE_TOLERANCE * high.by_load {
        return [0.5 * (low.value + high.value), low.by_acceleration];
    }
    // Intersection of the two lines.
    let left = ((low.value - high.value + high.by_load * width) / rise).clamp(0.0, width);
    let right = width - left;
    let corner = low.value + low.by_load * left;
    let between = at(from + left);
    let [first, last] = if bends > 1 && between.value > corner + SLOPE_TOLERANCE * rise * width {
        [
            mean([from, from + left], [low, between], at, bends - 1),
            mean([from + left, to], [between, high], at, bends - 1),
        ]
    } else {
        [
            [0.5 * (low.value + corner), low.by_acceleration],
            [0.5 * (corner + high.value), high.by_acceleration],
        ]
    };
    [0, 1].map(|k| (left * first[k] + right * last[k]) / width)
}

#[cfg(test)]
mod tests {
    use super::Torque;
    use crate::path_dynamics::{Demand, Place};

    /// Slopes by the load, with their offsets: two bends, at loads of 0 and 1, as of a motor behind two lossy stages.
    const LINES: [[f64; 2]; 3] = [[0.6, 0.0], [1.0, 0.0], [1.5, -0.5]];

    fn demand(place: &Place) -> Demand {
        let torque = |[slope, more]: [f64; 2]| slope * place.load + more;
        let by_torque = |a: &[f64; 2], b: &[f64; 2]| torque(*a).total_cmp(&torque(*b));
        let [slope, more] = LINES.into_iter().max_by(by_torque).unwrap();
        Demand {
            torque: torque([slope, more]),
            per_acceleration: slope * place.inertia,
        }
    }

    fn rounded(load: f64, range: f64) -> Torque {
        let place = Place {
            phi: 0.0,
            inertia: 2.0,
            inertia_slope: 0.0,
            load,
            viscous: 0.0,
            coulomb: 0.0,
        };
        Torque::rounded_of(&place, 0.0, range, demand)
    }

    /// The result is the mean of the torque over ranges with no, one and two bends, and its slope is the slope of the mean.
    #[test]
    fn a_range_may_contain_two_bends() {
        for range in [0.3, 0.7, 2.0] {
            for k in -400..=600 {
                let load = 0.005 * f64::from(k) + 1e-4;
                let parts = 4000;
                let mean = (0..parts).map(|k| {
                    let by = range * ((2.0 * f64::from(k) + 1.0) / f64::from(parts) - 1.0);
                    rounded(load + by, 0.0).value
                });
                let mean = mean.sum::<f64>() / f64::from(parts);
                let own = rounded(load, range);
                assert!((own.value - mean).abs() < 1e-6, "{own:?}, not {mean}");
                let [before, after] = [-1e-5, 1e-5].map(|by| rounded(load + by, range).value);
                let slope = (after - before) / 2e-5;
                assert!((own.by_load - slope).abs() < 1e-5, "{own:?}, not {slope}");
                assert!((own.by_acceleration - 2.0 * slope).abs() < 1e-4, "{own:?}");
            }
        }
    }
}
