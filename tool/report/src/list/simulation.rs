//! A simulated motion, for reading and as JSON.

mod json;
mod sentences;

use serde_json::Map;

use crate::table::output::{Format, json_parts, parts};
use jred_machine::analysis::simulate::{Simulated, Stop, Together};
use jred_machine::model::simulation::Simulation;
use jred_motion::driven::Loads;

/// A simulated motion.
#[derive(Clone, Copy, Debug)]
pub struct Shown<'s> {
    /// The machines on the motor's shaft.
    pub machines: &'s Together<'s>,
    /// What was asked for.
    pub simulation: &'s Simulation,
    /// The motion.
    pub found: &'s Simulated,
    /// Stops at instants over a cycle.
    pub stops: Option<&'s [Stop]>,
    /// The drive of the catalogue: its name, and what it bears.
    pub drive: Option<(&'s str, &'s Loads)>,
}

impl<'s> Shown<'s> {
    /// The motion in one of the formats, part by part; CSV is the rows alone.
    pub fn write(&self, format: Format) -> Box<dyn Iterator<Item = String> + 's> {
        let columns = &self.found.columns;
        match format {
            Format::Csv => parts(columns, format, ""),
            Format::Table => {
                let title = std::iter::once(self.title()).chain(self.sentences());
                parts(columns, format, &title.collect::<Vec<_>>().join("\n"))
            }
            Format::Json => {
                let mut before = Map::new();
                before.insert("title".into(), self.title().into());
                Box::new(json_parts(columns, before, self.figures()))
            }
        }
    }

    fn kind(&self) -> &'static str {
        if self.simulation.control.is_some() {
            "motion under its controller"
        } else {
            "free motion"
        }
    }

    /// What a page is about, below the title of the first machine.
    pub(crate) fn about(&self) -> String {
        let motor = self.drive.map_or_else(
            || "the motor of the machine file".to_owned(),
            |(name, _)| format!("the drive {name}"),
        );
        let beside = self.machines.beside_in_words();
        format!("{} with {motor}{beside}", self.kind())
    }

    /// A title, and below it what happened.
    pub(crate) fn summary(&self) -> String {
        [self.title(), self.sentences().join("\n")].join("\n\n")
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
