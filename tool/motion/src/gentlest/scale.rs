//! How large a move is: the unit of its numbers, and the load of which bends are rounded over a share.
//!
//! Both are taken from an even pace along the path, w = 1. At an end that moves the pace is another one; what the change to it takes is
//! added. Whether the torque bends at all is the machine's: [`Way::bends`].

use super::mesh::Mesh;
use super::{Fault, Travel};
use crate::collocation::torque::Torque;
use crate::way::Way;

/// Sizes of a move in a time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    /// Torque of the motor (N·m) that is one in the numbers of the search: about the RMS torque.
    pub(super) unit: f64,
    /// About the largest load at the drive link (N·m), without Coulomb friction, which never changes. Zero: nothing resists but that.
    pub(super) load: f64,
}

impl Scale {
    /// Of a move on a mesh.
    ///
    /// # Errors
    /// A torque that is not finite, or nothing that moves has inertia.
    pub(super) fn new(way: &Way, travel: &Travel, mesh: &Mesh) -> Result<Self, Fault> {
        let change = change(travel);
        let (mut squares, mut load) = (0.0, 0.0f64);
        for station in &mesh.stations {
            let state = station.state([1.0, 0.0], travel.duration);
            let place = &station.place;
            let [speed, acceleration] = state;
            let torque = Torque::exact(way, place, speed, acceleration);
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

/// The largest acceleration (rad/s², or m/s²) with which the way takes the time between the speeds at its ends, if it is a straight line
/// over the time; zero where no speed is given.
fn change(travel: &Travel) -> f64 {
    let ends = travel.ends();
    if ends.ring || ends.rest == [true; 2] {
        return 0.0;
    }
    let (way, time) = (travel.distance.abs(), travel.duration);
    let [first, last] = travel.speeds.map(|speed| speed * time / way);
    let most = (6.0 - 4.0 * first - 2.0 * last)
        .abs()
        .max((6.0 - 2.0 * first - 4.0 * last).abs());
    most * way / (time * time)
}
