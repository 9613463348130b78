//! A simulated motion.

mod data;
mod error;
mod sentences;

use std::borrow::Cow;

use crate::answer::Answer;
use jred_analysis::simulate::{CoupledMachines, SimulationResult, Stop};
use jred_file::model::simulation::Simulation;
use jred_motion::drive_simulation::Loads;

pub(crate) use data::SimulationData;
pub use error::problem;

/// A simulated motion.
#[derive(Clone, Copy, Debug)]
pub struct SimulationView<'s> {
    /// The machines on the motor's shaft.
    pub machines: &'s CoupledMachines<'s>,
    /// The request.
    pub simulation: &'s Simulation,
    /// The motion.
    pub found: &'s SimulationResult,
    /// Stops from instants over a cycle.
    pub stops: Option<&'s [Stop]>,
    /// The drive of the catalogue: its name, and its loads.
    pub drive: Option<(&'s str, &'s Loads)>,
}

impl<'s> SimulationView<'s> {
    /// Its events, one per line, and the course.
    pub fn answer(&self) -> Answer<'s> {
        let mut answer = Answer::new(self.title(), &self.data());
        self.sentences(&mut answer);
        answer.course(Cow::Borrowed(&self.found.columns));
        answer
    }

    fn kind(&self) -> &'static str {
        if self.simulation.control.is_some() {
            "motion under its controller"
        } else {
            "free motion"
        }
    }

    /// Subtitle of the page, below the title of the first machine.
    pub(crate) fn about(&self) -> String {
        let motor = self.drive.map_or_else(
            || "the motor of the machine file".to_owned(),
            |(name, _)| format!("the drive {name}"),
        );
        let beside = self.machines.beside_in_words();
        format!("{} with {motor}{beside}", self.kind())
    }

    fn title(&self) -> String {
        let simulation = self.simulation;
        let kind = self.kind();
        let drive = self
            .drive
            .map_or_else(String::new, |(name, _)| format!(" with the drive {name}"));
        format!(
            "{}: {kind}{drive}, Dormand-Prince 8(5,3), tolerance {:e}",
            self.machines.title(),
            simulation.tolerance
        )
    }

    fn effort_unit(&self) -> &'static str {
        if self.slides() { "N" } else { "N m" }
    }

    fn slides(&self) -> bool {
        self.simulation.drives_a_slide(self.machines.first)
    }
}
