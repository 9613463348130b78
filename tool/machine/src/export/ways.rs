//! A machine whose loads go by the direction of travel, as one link.
//!
//! With the resistances r₊ (φ grows) and r₋ (φ falls) of a position, each a torque that the drive needs beside that of the inertia, both
//! are there in one load and one friction:
//!
//! ```text
//! r₊ = c − load,  r₋ = −c − load        load = −(r₊ + r₋)/2,  c = (r₊ − r₋)/2
//! ```
//!
//! So a friction of 2 N·m forwards and 3 N·m backwards is one of 2.5 N·m and a load of 0.5 N·m forwards: what a tick computes is exact
//! in both directions. At rest, where friction may be anything between r₋ and r₊, it is their mean.

use jred::machine::PoseError;
use jred::{Domain, Machine, Reducible, Reduction};

use super::{Failure, Task};
use crate::model::machine::MachineFile;
use crate::model::mechanism::AnyMechanism;
use crate::model::schedule::Now;
use crate::number::rounding::short;

/// Places at which both directions are compared.
const PLACES: u32 = 1440;
/// What counts as none, of the largest: roundings.
const NOTHING: f64 = 1e-12;

/// The machine of each direction; one, if no load goes by it.
#[derive(Clone, Debug)]
pub(super) struct BothWays {
    forward: Machine<AnyMechanism>,
    backward: Option<Machine<AnyMechanism>>,
}

impl BothWays {
    /// Of a file of which nothing else goes by the motion.
    pub(super) fn new(file: &MachineFile, task: &Task) -> Result<Self, Failure> {
        let machine = task.whole_machine(file)?;
        let schedule = file.schedule.of_machine(&machine, None)?;
        let way = |omega: f64| {
            let now = Now {
                omega: Some(omega),
                ..Now::default()
            };
            schedule.machine(schedule.number(&now)).cloned()
        };
        let (Some(forward), Some(backward)) = (way(1.0), way(-1.0)) else {
            return Ok(Self {
                forward: machine,
                backward: None,
            });
        };
        let both = Self {
            forward,
            backward: Some(backward),
        };
        both.check(file)?;
        Ok(both)
    }

    /// The machine, if it is one in both directions.
    pub(super) fn same(&self) -> Option<&Machine<AnyMechanism>> {
        self.backward.is_none().then_some(&self.forward)
    }

    /// Refuses what no load and friction are: viscous friction that goes by the direction, and loads that drive it.
    fn check(&self, file: &MachineFile) -> Result<(), Failure> {
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
        let coordinate = file.machine.mechanism().coordinate();
        for (phi, coulomb, difference, sum) in found {
            let at = coordinate.place(phi);
            if difference.abs() > NOTHING * sum.abs() {
                return Err(Failure::Impossible {
                    message: format!(
                        "the viscous friction goes by the direction: at {at} it is another one forwards than backwards, and a table has one b"
                    ),
                    help: "remove the direction of the viscous load, or give it to the firmware as a torque of its own".to_owned(),
                });
            }
            if coulomb < -NOTHING * largest {
                return Err(Failure::Impossible {
                    message: format!(
                        "the loads by direction drive the motion: at {at} they take {} {} less forwards than backwards, and friction takes more",
                        short(-2.0 * coulomb),
                        coordinate.effort_unit()
                    ),
                    help: "remove their direction, or give the firmware what helps the motion as a torque of its own".to_owned(),
                });
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

impl Reducible for BothWays {
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
