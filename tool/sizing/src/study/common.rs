//! Data common to all machines of a study: the machine file, the catalogue, the time steps.

use std::sync::{Arc, OnceLock};

use jred_file::text::problem::{Problem, Result};

use super::edit::{Document, Edit};
use crate::catalogue::Catalogue;
use crate::catalogue::{Drive, DriveId};
use crate::cycle::Cycle;
use crate::select::fit::fit_input;
use crate::select::named::named;
use jred_analysis::checked;
use jred_analysis::duty::{Duty, Sampling};
use jred_file::model::machine::MachineFile;
use jred_file::model::rules::RuleSet;
use jred_file::read;
#[cfg(feature = "fs")]
use jred_file::text::disk;
use jred_file::text::file::Files;

/// The common part of a study.
#[derive(Debug)]
pub struct Study {
    /// Name of the machine file, for messages.
    pub name: String,
    /// The files that the machine file names.
    files: Box<dyn Files + Send + Sync>,
    /// The file with the positions of its quantities.
    pub document: Document,
    /// The machine as given in the file.
    pub nominal: MachineFile,
    /// The catalogue to choose drives from.
    pub catalogue: Catalogue,
    /// Rule set to use instead of the file's.
    rules: Option<RuleSet>,
    /// How finely a cycle is sampled.
    pub sampling: Sampling,
    /// The cycle of the nominal machine, computed on demand.
    cycle: OnceLock<Arc<Cycle>>,
}

/// A machine ready to be sized.
#[derive(Debug)]
pub struct PreparedMachine {
    /// The machine.
    pub file: MachineFile,
    /// Its cycle.
    pub cycle: Arc<Cycle>,
}

/// Sections of a machine file that affect the judgement of drives but not machine and motion, so that the cycle does not depend on them (test
/// `some_sections_do_not_reach_the_cycle`).
const AROUND: [&str; 5] = ["supply.", "surroundings.", "stiffness.", "duty.", "rules."];

impl Study {
    /// The accuracy of its figures, for the header of its rows.
    pub(crate) fn accuracy(&self) -> String {
        let Sampling { steps, tolerance } = self.sampling;
        format!("steps = {steps}, tolerance = {tolerance:e}")
    }

    /// The study of the machine file at `path`: see [`Study::new`].
    ///
    /// # Errors
    /// The file cannot be read, or its machine cannot be sized.
    #[cfg(feature = "fs")]
    pub fn open(
        path: &std::path::Path,
        catalogue: Catalogue,
        rules: Option<RuleSet>,
        sampling: impl Into<Sampling>,
    ) -> Result<Self> {
        let name = read::name(path);
        let files = Box::new(disk::Folder::new(read::folder(path).to_owned()));
        Self::new(name, read::text(path)?, files, catalogue, rules, sampling)
    }

    /// Reads the `text` of a machine file that can be sized, and the files that it names from `files`. `rules` replaces its own rule set. The `name`
    /// is for messages.
    ///
    /// # Errors
    /// The machine file is wrong, or its machine cannot be sized.
    pub fn new(
        name: String,
        text: String,
        files: Box<dyn Files + Send + Sync>,
        mut catalogue: Catalogue,
        rules: Option<RuleSet>,
        sampling: impl Into<Sampling>,
    ) -> Result<Self> {
        let mut nominal = checked::parse(&name, &text, &*files)?;
        if let Some(set) = &rules {
            nominal.rules = read::rules_based_on(&nominal.rules, set.clone())?;
        }
        sizeable(&nominal)?;
        fit_input(&mut catalogue, &nominal)?;
        Ok(Self {
            name,
            files,
            document: Document::parse(text)?,
            nominal,
            catalogue,
            rules,
            sampling: sampling.into(),
            cycle: OnceLock::new(),
        })
    }

    /// Digest of the machine file and of all files read with it.
    pub fn machine_digest(&self) -> String {
        crate::study::header::digest(&(self.document.text(), &self.nominal))
    }

    /// The drive named by a text: see [`named`].
    ///
    /// # Errors
    /// The catalogue does not have this drive.
    pub fn drive(&self, text: &str) -> Result<(DriveId, Drive<'_>)> {
        named(&self.catalogue, text)
    }

    /// The machine with some of its quantities changed.
    ///
    /// # Errors
    /// The errors of that machine.
    pub fn machine(&self, edits: &[Edit]) -> Result<PreparedMachine> {
        let text = self.document.with(edits);
        let around = edits.iter().all(|edit| self.is_around(edit.quantity));
        let mut file = if around {
            checked::parse_around(&self.name, &text, &*self.files)?
        } else {
            checked::parse(&self.name, &text, &*self.files)?
        };
        if let Some(set) = &self.rules {
            file.rules = read::rules_based_on(&file.rules, set.clone())?;
        }
        sizeable(&file)?;
        let known = self.cycle.get().filter(|_| around).cloned();
        let cycle = match known {
            Some(cycle) => cycle,
            None => Arc::new(cycle(&file, self.sampling)?),
        };
        if around {
            // Another thread may have been first, with the same cycle.
            let _ = self.cycle.set(Arc::clone(&cycle));
        }
        Ok(PreparedMachine { file, cycle })
    }

    /// Whether the cycle does not depend on a quantity.
    fn is_around(&self, quantity: usize) -> bool {
        let quantity = self.document.quantities().get(quantity);
        quantity.is_some_and(|q| AROUND.iter().any(|section| q.path.starts_with(section)))
    }
}

/// The prepared duty of a machine.
///
/// # Errors
/// The machine has no motion, or cannot follow it.
pub fn cycle(file: &MachineFile, sampling: impl Into<Sampling>) -> Result<Cycle> {
    let motion = file.required_motion()?;
    let duty = Duty::new(file, motion, sampling).map_err(Problem::from)?;
    Ok(Cycle::new(&duty))
}

/// Refuses machines that cannot be sized over the catalogue.
///
/// # Errors
/// The machine has a variator, or no motion.
pub fn sizeable(file: &MachineFile) -> Result<()> {
    jred_file::model::variator::refuse(file, "size")?;
    file.required_motion()?;
    Ok(())
}

/// A report on one line, for a table: its sentence without line breaks.
pub fn sentence(report: &Problem) -> String {
    let text = report.to_string();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
