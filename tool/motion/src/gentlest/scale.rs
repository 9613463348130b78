//! Scales of a move: the unit of its numbers, and the load of which a share rounds the bends.
//!
//! Both come from a constant pace along the path, w = 1. At a moving end the pace differs; the effort for that change is added. Whether the torque
//! bends at all depends on the machine: [`PathDynamics::bends`].

use super::mesh::Mesh;
use super::{Fault, Travel};
use crate::collocation::torque::Torque;
use crate::path_dynamics::PathDynamics;

/// Scales of a move in a given time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    /// Unit of the motor torque in the search (N·m): about the RMS torque.
    pub(super) unit: f64,
    /// About the largest load at the drive link (N·m), without Coulomb friction, which is constant. Zero: nothing else resists.
    pub(super) load: f64,
}

impl Scale {
    /// Scales of a move on a mesh.
    ///
    /// # Errors
    /// A torque is not finite, or nothing in motion has inertia.
    pub(super) fn new(
        dynamics: &PathDynamics,
        travel: &Travel,
        mesh: &Mesh,
    ) -> Result<Self, Fault> {
        let change = change(travel);
        let (mut squares, mut load) = (0.0, 0.0f64);
        for station in &mesh.stations {
            let state = station.state([1.0, 0.0], travel.duration);
            let place = &station.place;
            let [speed, acceleration] = state;
            let torque = Torque::exact(dynamics, place, speed, acceleration);
            if !torque.value.is_finite() {
                return Err(Fault::Figure("torque", torque.value));
            }
            if torque.by_acceleration <= 0.0 {
                return Err(Fault::NoInertia);
            }
            let of_change = torque.by_acceleration * change;
            squares += station.weight * (torque.value * torque.value + of_change * of_change);
            let of_speed = 0.5 * place.inertia_slope * speed * speed + place.viscous * speed;
            let inertial = place.inertia * acceleration.abs().max(change);
            load = load.max(inertial + place.load.abs() + of_speed.abs());
        }
        Ok(Self {
            unit: if squares > 0.0 { squares.sqrt() } else { 1.0 },
            load,
        })
    }
}

/// The largest acceleration (rad/s², or m/s²) of a motion with acceleration linear in time that covers the path in the time with the given end
/// speeds; zero if no end moves.
fn change(travel: &Travel) -> f64 {
    let ends = travel.ends();
    if ends.ring || ends.rest == [true; 2] {
        return 0.0;
    }
    let (dynamics, time) = (travel.distance.abs(), travel.duration);
    let [first, last] = travel.speeds.map(|speed| speed * time / dynamics);
    let most = (6.0 - 4.0 * first - 2.0 * last)
        .abs()
        .max((6.0 - 2.0 * first - 4.0 * last).abs());
    most * dynamics / (time * time)
}
