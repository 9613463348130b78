//! Contributions to one drive and the changes it would need, for all output formats.

use jred::error::Error;
use serde::Serialize;

use super::{remedy, table};
use crate::answer::Answer;
use crate::table::reading::ColumnKind::{self, Quantity, Words};
use jred_analysis::duty::Duty;
use jred_file::model::machine::MachineFile;
use jred_file::number::rounding::{percent, short, shown};
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

    /// Contributions, changes of the drive, and changes of refused ones; `duration` is the cycle time (s).
    pub(super) fn blocks(&self, answer: &mut Answer, duration: f64) {
        if let Some(breakdown) = &self.contributions {
            let torque = breakdown.words.torque;
            answer.heading(format!(
                "Contributions to the motor {torque} of {} [{}]; the peak is at {} s",
                breakdown.drive,
                torque.unit,
                short(breakdown.peak_time)
            ));
            contributions(answer, breakdown);
        }
        if let Some(change) = &self.change {
            answer.heading(if change.holds {
                "How far each quantity may change by itself before a rule is violated"
            } else {
                "What would have to change, one quantity at a time"
            });
            changes(answer, change, duration);
        }
        if !self.nearest.is_empty() {
            answer.heading(
                "Closest refused drives, and what would have to change, one quantity at a time",
            );
            for refused in &self.nearest {
                changes(answer, refused, duration);
            }
        }
    }
}

/// The shares of torque and inertia of the effects and parts, with their totals.
pub(crate) fn contributions(answer: &mut Answer, breakdown: &Breakdown) {
    let Breakdown { total, words, .. } = breakdown;
    for (name, shares) in [("effect", &breakdown.effects), ("part", &breakdown.parts)] {
        let header = [
            (name, Words),
            ("RMS", Quantity),
            ("peak", Quantity),
            ("at the peak", Quantity),
            ("share of mean square", ColumnKind::Share),
            ("energy [J]", Quantity),
        ];
        let row = |share: &Share| {
            [
                share.name.clone(),
                shown(share.torque.rms, total.torque.rms),
                shown(share.torque.peak(), total.torque.peak()),
                shown(share.at_peak, total.at_peak),
                percent(share.mean_square),
                shown(share.energy, breakdown.turned_over()),
            ]
        };
        answer.table(table(header, shares.iter().chain([total]).map(row), 0));
    }
    let inertia = words.inertia;
    let row = |share: &InertiaShare| {
        let of = share.inertia;
        let [min, mean, max] =
            [of.min, of.mean, of.max].map(|x| shown(x / inertia.scale, of.max / inertia.scale));
        [share.name.clone(), min, mean, max, percent(share.of_mean)]
    };
    let shares = breakdown.inertia.iter().chain([&breakdown.total_inertia]);
    let name = format!("{inertia} at the motor [{}]", inertia.unit);
    let header = [
        (&*name, Words),
        ("min", Quantity),
        ("mean", Quantity),
        ("max", Quantity),
        ("share", ColumnKind::Share),
    ];
    answer.table(table(header, shares.map(row), 0));
}

/// A drive, the rules it violates, and the range of each quantity.
pub(crate) fn changes(answer: &mut Answer, remedies: &Remedies, duration: f64) {
    let misses = remedies.misses.iter();
    let misses: Vec<String> = misses
        .map(|miss| remedy::violation(miss, remedies.words))
        .collect();
    if misses.is_empty() {
        answer.sentence(&remedies.drive);
    } else {
        answer.sentence(format!("{}: {}", remedies.drive, misses.join("; ")));
    }
    for one in &remedies.remedies {
        let [name, says] = remedy::fact(one, duration, remedies.words);
        answer.fact(name, says);
    }
}
