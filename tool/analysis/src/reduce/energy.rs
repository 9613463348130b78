//! Energies and generalised forces as columns.
//!
//! The generalised force of a load is its power divided by the speed of the drive link, Q = F·r′ + M·ψ′ (4.1)-(4.7). It is computed from the force
//! itself and the transfer functions of its point, not from the reduced curves; the sum of all is the reduced torque T_red.

use jred::error::Error;
use jred::machine::{Body, Frames, Mechanism as _, Wrench};

use super::{RowPose, Set, Source};
use jred_file::number::columns::{Column, ColumnQuantity};

/// Kinetic and potential energy, and the generalised force of weight, loads, springs and dampers.
pub(super) struct Energy;

impl Set for Energy {
    fn heads(&self, source: &Source) -> Vec<Column> {
        let unit = source.coordinate.effort_unit();
        let energies = ["E_kinetic", "E_potential"];
        let mut heads = energies
            .map(|name| Column::new(ColumnQuantity::Energy, name, "J"))
            .to_vec();
        let mut force = |name: &str| heads.push(Column::other(format!("Q {name}"), unit));
        force("weight");
        source.file.loads.iter().for_each(|load| force(&load.name));
        let elements = source.file.elements.iter();
        elements.for_each(|element| force(&element.name));
        if !source.machine.frictions().is_empty() {
            force("friction in joints");
        }
        force("total");
        heads
    }

    fn values(&self, source: &Source, place: &RowPose) -> Result<Vec<Option<f64>>, Error> {
        let machine = source.machines.at(&place.now, place.phi)?;
        let point = machine.bare_reduction(place.phi)?;
        let Some(state) = place.state else {
            let mut values = vec![None; self.heads(source).len()];
            values[1] = Some(point.potential_energy);
            return Ok(values);
        };
        let omega = state.omega;
        let frames = &place.frames;
        let carriages = source.file.schedule.carriages().iter();
        let beyond = carriages.filter_map(|carriage| {
            let frame = frames.get(carriage.mass.link)?;
            Some(carriage.energy(frame, place.now.t?, omega))
        });
        let kinetic = 0.5 * point.inertia * omega * omega + beyond.sum::<f64>();
        let mut values = vec![kinetic, point.potential_energy];
        let links = machine.mechanism().links().iter().zip(frames);
        let [g_x, g_y] = machine.gravity();
        let weight = links.map(|(link, frame)| {
            let [x, y] = frame.point(link.com());
            link.mass() * (g_x * x.d1 + g_y * y.d1)
        });
        let mut forces = vec![weight.sum::<f64>()];
        for load in machine.loads() {
            let frame = Body::Link(load.link()).frame(frames);
            forces.push(generalised(&load.wrench(frame, place.phi, omega), frames));
        }
        for element in machine.elements() {
            let wrenches = element.wrenches(frames, omega);
            let parts = wrenches.iter().flatten();
            forces.push(parts.map(|w| generalised(w, frames)).sum());
        }
        if !machine.frictions().is_empty() {
            let friction = machine.friction_at(place.phi, omega, omega)?;
            forces.push(-friction.torque(state.alpha)?[0]);
        }
        let total = forces.iter().sum::<f64>();
        values.extend(forces);
        values.push(total);
        Ok(values.into_iter().map(Some).collect())
    }
}

/// F·r′ + M·ψ′ for a force at a point of its body.
fn generalised(wrench: &Wrench, frames: &Frames) -> f64 {
    let frame = wrench.body.frame(frames);
    let turn = frame.psi.d1;
    // The moment about the frame's origin, and the displacement of the origin.
    let origin = [frame.x.value, frame.y.value];
    wrench.force[0] * frame.x.d1 + wrench.force[1] * frame.y.d1 + wrench.moment_about(origin) * turn
}
