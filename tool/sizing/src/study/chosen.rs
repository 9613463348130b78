//! One drive, checked in any machine of a study.

use jred_file::problem;
use jred_file::text::problem::Result;

use crate::catalogue::{Amplifier, Catalogue, Drive, Gearbox, Motor, Resistor};
use crate::judge::{Context, Findings};
use crate::motor::envelope::MotorLimits;
use crate::select::filter::Filter;
use crate::select::rank::{Objective, rank};
use crate::select::size::Selection;
use crate::study::common::{PreparedMachine, Study};

/// A drive of the catalogue.
#[derive(Clone, Debug)]
pub struct ChosenDrive {
    motor: Motor,
    gearbox: Option<Gearbox>,
    amplifier: Option<Amplifier>,
    /// Brake resistors of its catalogue, to choose from for each machine that gives no resistor.
    resistors: Vec<Resistor>,
}

impl ChosenDrive {
    /// The drive of this name; without a name the best one for the nominal machine, or else the closest one.
    ///
    /// # Errors
    /// There is no such drive.
    pub fn choose(
        study: &Study,
        name: Option<&str>,
        filter: &Filter,
        objective: Option<Objective>,
    ) -> Result<Self> {
        if let Some(name) = name {
            return Ok(Self::of(&study.drive(name)?.1, &study.catalogue));
        }
        let machine = study.machine(&[])?;
        let (site, rules) = (&machine.file.site, &machine.file.rules);
        let motors = study.catalogue.prepare(site);
        let mut selection = Selection::new(&study.catalogue, &motors, &machine.cycle, site, rules);
        filter.sift(&mut selection);
        if let Some(objective) = objective {
            rank(&mut selection, objective);
        }
        let first = selection.fit.first().or(selection.refused.first());
        let first = first.ok_or_else(|| problem!("no drive in the catalogue passes the filter"))?;
        Ok(Self::of(&first.drive, &study.catalogue))
    }

    /// A copy of a catalogue's drive that does not need the catalogue.
    pub fn of(drive: &Drive, catalogue: &Catalogue) -> Self {
        Self {
            motor: drive.motor.clone(),
            gearbox: drive.gearbox.cloned(),
            amplifier: drive.amplifier.cloned(),
            resistors: catalogue.resistors.clone(),
        }
    }

    /// The drive.
    pub fn drive(&self) -> Drive<'_> {
        Drive {
            motor: &self.motor,
            gearbox: self.gearbox.as_ref(),
            amplifier: self.amplifier.as_ref(),
        }
    }

    /// The brake resistors of its catalogue.
    pub fn resistors(&self) -> &[Resistor] {
        &self.resistors
    }

    /// Its name.
    pub fn name(&self) -> String {
        self.drive().name()
    }

    /// Findings of every rule in a machine.
    pub fn findings(&self, machine: &PreparedMachine) -> Findings {
        let site = &machine.file.site;
        let limits = MotorLimits::new(&self.motor, self.amplifier.as_ref(), site);
        Context::new(&machine.cycle, site, self.drive(), &limits)
            .with_resistors(&self.resistors)
            .findings(&machine.file.rules)
    }
}
