//! Contributions to one drive and the changes it would need, for all output formats.

use std::fmt::Write as _;

use jred::error::Error;
use serde::Serialize;

use crate::table::output::text_table;
use jred_analysis::duty::Duty;
use jred_file::model::machine::MachineFile;
use jred_file::number::rounding::{percent, short, shown};
use jred_file::units::Vocabulary;
use jred_sizing::explain::{Breakdown, DutyModel, InertiaShare, Remedies, Share};
use jred_sizing::select::size::{Candidate, Selection};

/// The explanation of one drive, and of the refused drives closest to their limits.
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
pub struct Explanation {
    /// Torque and inertia of the drive, part by part; `None` if only refused drives were requested.
    pub contributions: Option<Breakdown>,
    /// The range of each quantity, or the changes that are needed.
    pub change: Option<Remedies>,
    /// The same for the closest refused drives.
    #[serde(rename = "nearest refused")]
    pub nearest: Vec<Remedies>,
}

impl Explanation {
    /// Explains a drive and the `nearest` refused ones.
    ///
    /// # Errors
    /// Those of the machine.
    pub fn new(
        file: &MachineFile,
        duty: &Duty,
        selection: &Selection,
        candidate: &Candidate,
        nearest: usize,
    ) -> Result<Self, Error> {
        let altered = DutyModel::new(file, duty)?;
        let change = Remedies::of_candidate(selection, &altered, candidate);
        let nearest = Remedies::of_nearest(selection, &altered, nearest)?;
        Ok(Self {
            contributions: Some(Breakdown::new(file, duty, &candidate.drive)?),
            nearest: nearest
                .into_iter()
                .filter(|refused| refused.drive != change.drive)
                .collect(),
            change: Some(change),
        })
    }

    /// Changes for the `nearest` refused drives.
    ///
    /// # Errors
    /// Those of the machine.
    pub fn of_refused(
        file: &MachineFile,
        duty: &Duty,
        selection: &Selection,
        nearest: usize,
    ) -> Result<Self, Error> {
        let altered = DutyModel::new(file, duty)?;
        Ok(Self {
            contributions: None,
            change: None,
            nearest: Remedies::of_nearest(selection, &altered, nearest)?,
        })
    }

    /// For reading; `duration` is the cycle time (s).
    pub fn text(&self, duration: f64) -> String {
        let mut text = String::new();
        if let Some(contributions) = &self.contributions {
            text += &contributions_text(contributions);
        }
        if let Some(change) = &self.change {
            let heading = if change.holds {
                "How far each quantity may change by itself before a rule is violated"
            } else {
                "What would have to change, one quantity at a time"
            };
            let _ = write!(text, "\n{heading}\n{}", remedies_text(change, duration));
        }
        if !self.nearest.is_empty() {
            text +=
                "\nClosest refused drives, and what would have to change, one quantity at a time\n";
            for refused in &self.nearest {
                text += &remedies_text(refused, duration);
            }
        }
        text
    }
}

fn contributions_text(breakdown: &Breakdown) -> String {
    let shares = |heading: &str, shares: &[Share]| {
        let mut table = text_table(&[
            heading,
            "RMS",
            "peak",
            "at the peak",
            "share of mean square",
            "energy [J]",
        ]);
        for share in shares.iter().chain([&breakdown.total]) {
            table.add_row([
                share.name.clone(),
                shown(share.torque.rms, breakdown.total.torque.rms),
                shown(share.torque.peak(), breakdown.total.torque.peak()),
                shown(share.at_peak, breakdown.total.at_peak),
                percent(share.mean_square),
                shown(share.energy, breakdown.turned_over()),
            ]);
        }
        table.to_string()
    };
    let Vocabulary {
        torque, inertia, ..
    } = breakdown.words;
    let scale = inertia.scale;
    let heading = format!("{inertia} at the motor [{}]", inertia.unit);
    let mut inertias = text_table(&[heading.as_str(), "min", "mean", "max", "share"]);
    let row = |share: &InertiaShare| {
        let figures = share.inertia;
        let [min, mean, max] = [figures.min, figures.mean, figures.max];
        let [min, mean, max] = [min, mean, max].map(|x| shown(x / scale, figures.max / scale));
        let part = percent(share.of_mean);
        [share.name.clone(), min, mean, max, part]
    };
    for share in breakdown.inertia.iter().chain([&breakdown.total_inertia]) {
        inertias.add_row(row(share));
    }
    format!(
        "\nContributions to the motor {torque} of {} [{}]; the peak is at {} s\n{}\n\n{}\n\n{inertias}\n",
        breakdown.drive,
        torque.unit,
        short(breakdown.peak_time),
        shares("effect", &breakdown.effects),
        shares("part", &breakdown.parts)
    )
}

/// A drive, the rules it violates, and all remedies.
fn remedies_text(remedies: &Remedies, duration: f64) -> String {
    let mut text = format!("  {}", remedies.drive);
    let misses: Vec<String> = remedies
        .misses
        .iter()
        .map(|miss| miss.sentence(remedies.words))
        .collect();
    if !misses.is_empty() {
        let _ = write!(text, ": {}", misses.join("; "));
    }
    text += "\n";
    for remedy in &remedies.remedies {
        let _ = writeln!(text, "    {}", remedy.sentence(duration, remedies.words));
    }
    text
}
