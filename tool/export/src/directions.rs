//! A machine with loads by the direction of travel, as one link.
//!
//! At a position the drive needs the resistances r₊ (φ grows) and r₋ (φ falls) besides the inertia's torque. Both follow from one load and one
//! friction:
//!
//! ```text
//! r₊ = c − load,  r₋ = −c − load        load = −(r₊ + r₋)/2,  c = (r₊ − r₋)/2
//! ```
//!
//! So a friction of 2 N·m forwards and 3 N·m backwards is a friction of 2.5 N·m and a load of 0.5 N·m forwards: the result of a tick is exact in both
//! directions. At rest, where friction may be anything between r₋ and r₊, it is their mean.

use jred::Domain;
use jred::error::Error;
use jred::machine::{Machine, PoseError, Reducible, Reduction};

use crate::failure::{Failure, Impossible};
use crate::task::Task;
use jred_file::model::machine::{MachineFile, Machines};
use jred_file::model::mechanism::AnyMechanism;
use jred_file::model::schedule::ScheduleInstant;

/// Places at which both directions are compared.
const PLACES: u32 = 1440;
/// Share of the largest value that counts as zero: rounding.
const LOAD_ROUNDING: f64 = 1e-12;

/// The machine of each direction; one, if no load depends on it.
#[derive(Clone, Debug)]
pub(crate) struct MachineByDirection {
    forward: Machine<AnyMechanism>,
    backward: Option<Machine<AnyMechanism>>,
}

impl MachineByDirection {
    /// The machines of a file in which only loads depend on the motion, by its direction.
    pub(crate) fn new(file: &MachineFile, task: &Task) -> Result<Self, Failure> {
        if file.schedule.is_empty() {
            return Ok(Self {
                forward: task.whole_machine(file)?,
                backward: None,
            });
        }
        let (machines, ratio) = (Machines::of(file)?, file.drive_train.ratio());
        let way = |omega: f64| -> Result<Machine<AnyMechanism>, Error> {
            let now = ScheduleInstant {
                omega: Some(omega),
                ..ScheduleInstant::default()
            };
            let machine = machines.among(&now).clone();
            Ok(machine.with_flywheel(task.rotor * ratio * ratio)?)
        };
        let both = Self {
            forward: way(1.0)?,
            backward: Some(way(-1.0)?),
        };
        both.check()?;
        Ok(both)
    }

    /// The machine, if it is the same in both directions.
    pub(crate) fn same(&self) -> Option<&Machine<AnyMechanism>> {
        self.backward.is_none().then_some(&self.forward)
    }

    /// Refuses resistances that no load and friction represent: viscous friction by direction, and loads that drive.
    fn check(&self) -> Result<(), Failure> {
        let Some(backward) = &self.backward else {
            return Ok(());
        };
        let domain = self.forward.domain();
        let mut largest = 0.0_f64;
        let mut found = Vec::new();
        for place in 0..=PLACES {
            let phi = domain.position(f64::from(place) / f64::from(PLACES));
            let [there, back] = [self.forward.reduction(phi)?, backward.reduction(phi)?];
            let coulomb = combined(&there, &back).coulomb;
            largest = largest
                .max(coulomb.abs())
                .max(there.coulomb)
                .max(back.coulomb);
            found.push((
                phi,
                coulomb,
                there.viscous - back.viscous,
                there.viscous + back.viscous,
            ));
        }
        for (at, coulomb, difference, sum) in found {
            if difference.abs() > LOAD_ROUNDING * sum.abs() {
                return Err(Failure::Impossible(Impossible::ViscousByDirection { at }));
            }
            if coulomb < -LOAD_ROUNDING * largest {
                let excess = -2.0 * coulomb;
                return Err(Failure::Impossible(Impossible::DrivingLoads { at, excess }));
            }
        }
        Ok(())
    }
}

/// One load and one friction for both directions.
fn combined(forward: &Reduction, backward: &Reduction) -> Reduction {
    let load =
        0.5 * (forward.load_torque() + backward.load_torque() + backward.coulomb - forward.coulomb);
    let coulomb =
        0.5 * (forward.coulomb + backward.coulomb + backward.load_torque() - forward.load_torque());
    forward
        .with_process(load + forward.potential_slope)
        .with_coulomb(coulomb)
}

impl Reducible for MachineByDirection {
    fn domain(&self) -> Domain {
        self.forward.domain()
    }

    fn reduction(&self, phi: f64) -> Result<Reduction, PoseError> {
        let forward = self.forward.reduction(phi)?;
        let Some(backward) = &self.backward else {
            return Ok(forward);
        };
        Ok(combined(&forward, &backward.reduction(phi)?))
    }

    fn edge(&self, k: usize) -> Option<f64> {
        self.forward.edge(k)
    }

    fn check_repeats(&self) -> Result<(), PoseError> {
        self.forward.check_repeats()?;
        self.backward
            .as_ref()
            .map_or(Ok(()), Reducible::check_repeats)
    }
}

#[cfg(test)]
mod tests {
    use super::combined;
    use jred::machine::Reduction;

    /// c − load is the resistance forwards, −c − load the resistance backwards, also with springs and process torques.
    #[test]
    fn one_load_and_one_friction_are_both_directions() {
        let bare = Reduction::new([0.2, 0.1, 0.0]).with_potential_energy([3.0, 0.7]);
        let forward = bare.with_process(1.5).with_coulomb(2.0);
        let backward = bare.with_process(-0.25).with_coulomb(3.0);
        let both = combined(&forward, &backward);
        for (omega, way) in [(0.5, forward), (-0.5, backward)] {
            let [found, exact] = [both, way].map(|r| r.torque(omega, 4.0).total());
            assert!((found - exact).abs() < 1e-12, "{found} {exact}");
        }
        // 2 N·m forwards and 3 backwards: 2.5 and a load of 0.5.
        let friction = |c: f64| Reduction::new([0.2, 0.0, 0.0]).with_coulomb(c);
        let both = combined(&friction(2.0), &friction(3.0));
        assert!((both.coulomb - 2.5).abs() < 1e-12 && (both.load_torque() - 0.5).abs() < 1e-12);
    }
}
