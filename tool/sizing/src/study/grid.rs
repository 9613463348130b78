//! The rows of `jred vary`: each a machine, sized over the catalogue.

use super::axis::Grid;
use super::edit::Edit;
use crate::cell::Cell;
use crate::select::filter::Filter;
use crate::select::rank::{Objective, rank};
use crate::select::size::{Candidate, Selection};
use crate::study::common::{Study, sentence};
use crate::study::header::{Header, digest};
use crate::study::task::RowSource;
use jred_file::number::words::counted;

/// Machines of a grid, to be sized.
#[derive(Debug)]
pub struct GridStudy<'s> {
    /// Their common part.
    pub study: &'s Study,
    /// The varied quantities.
    pub grid: Grid,
    /// Filter for the drives.
    pub filter: Filter,
    /// Ranking objective; `None`: the ranking of `jred size`.
    pub rank: Option<Objective>,
}

jred_file::words! {
    /// Result for a machine of a study: the words of the column `verdict`.
    pub enum GridVerdict {
        /// A drive satisfies every rule.
        Fits = "fits",
        /// No drive does.
        NoneFits = "none fits",
        /// The machine cannot be built as described.
        Refused = "machine refused",
    }
}

/// Columns after those of the axes.
const COLUMNS: [&str; 13] = [
    "verdict",
    "drives that fit",
    "motor",
    "gearbox",
    "amplifier",
    "ratio",
    "rated power [W]",
    "mass [kg]",
    "price",
    "margin",
    "worst rule",
    "energy [J]",
    "note",
];

impl RowSource for GridStudy<'_> {
    fn header(&self) -> Header {
        let axes = self.grid.axes.iter();
        let own = axes.clone().map(super::axis::Variation::column);
        let mut options: Vec<String> = axes
            .map(|axis| {
                let ends = [axis.values.first(), axis.values.last()]
                    .map(|x| x.copied().unwrap_or(f64::NAN));
                let [n, digest] = [axis.values.len().to_string(), digest(&axis.values)];
                format!(
                    "{}: {n} values from {} to {} {} ({digest})",
                    axis.path, ends[0], ends[1], axis.unit
                )
            })
            .collect();
        options.push(self.study.accuracy());
        options.push(format!("filter = {}", digest(&self.filter)));
        options.push(format!(
            "rank = {}",
            self.rank.map_or("default", Objective::word)
        ));
        Header {
            jred: "vary/4".to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            machine: self.study.name.clone(),
            machine_digest: self.study.machine_digest(),
            catalogue_digest: digest(&self.study.catalogue),
            options,
            rows: self.grid.count(),
            columns: own.chain(COLUMNS.map(str::to_owned)).collect(),
            shard: None,
        }
    }

    fn row(&self, index: u64) -> Vec<Cell> {
        let values = self.grid.values(index);
        let edits: Vec<Edit> = (self.grid.axes.iter().zip(&values))
            .map(|(axis, value)| Edit {
                quantity: axis.quantity,
                number: *value,
                unit: &axis.unit,
            })
            .collect();
        let mut cells: Vec<Cell> = values.into_iter().map(Cell::from).collect();
        cells.extend(self.sized(&edits));
        cells
    }
}

impl GridStudy<'_> {
    fn sized(&self, edits: &[Edit]) -> Vec<Cell> {
        let machine = match self.study.machine(edits) {
            Ok(machine) => machine,
            Err(report) => {
                let mut cells = vec![Cell::Empty; COLUMNS.len()];
                if let [verdict, .., note] = cells.as_mut_slice() {
                    *verdict = GridVerdict::Refused.word().into();
                    *note = sentence(&report).into();
                }
                return cells;
            }
        };
        let (site, rules) = (&machine.file.site, &machine.file.rules);
        let motors = self.study.catalogue.prepare(site);
        let mut selection =
            Selection::new(&self.study.catalogue, &motors, &machine.cycle, site, rules);
        self.filter.sift(&mut selection);
        if let Some(objective) = self.rank {
            rank(&mut selection, objective);
        }
        let fit = selection.fit.len();
        match (selection.fit.first(), selection.refused.first()) {
            (Some(best), _) => {
                let mut cells = vec![GridVerdict::Fits.word().into(), (fit as f64).into()];
                cells.extend(drive_cells(&selection, best));
                cells.push(match best.outcome.not_checked.count() {
                    0 => Cell::Empty,
                    n => format!(
                        "{} not checked: data missing in the catalogue or the machine file",
                        counted(n, "rule", "rules")
                    )
                    .into(),
                });
                cells
            }
            (None, Some(nearest)) => {
                let mut cells = vec![GridVerdict::NoneFits.word().into(), 0.0.into()];
                cells.extend(drive_cells(&selection, nearest));
                cells.push("closest drive".into());
                cells
            }
            (None, None) => {
                let mut cells = vec![GridVerdict::NoneFits.word().into(), 0.0.into()];
                cells.resize(COLUMNS.len() - 1, Cell::Empty);
                cells.push("no drive passes the filter".into());
                cells
            }
        }
    }
}

/// Cells from motor to energy.
fn drive_cells(selection: &Selection, candidate: &Candidate) -> Vec<Cell> {
    let drive = &candidate.drive;
    let outcome = &candidate.outcome;
    vec![
        drive.motor.key.as_str().into(),
        drive.gearbox.map_or("direct", |g| g.key.as_str()).into(),
        drive
            .amplifier
            .map_or(Cell::Empty, |a| a.key.as_str().into()),
        drive.ratio().into(),
        drive.motor.rated_power().into(),
        drive.mass().into(),
        Objective::Price.value(selection, candidate).into(),
        (1.0 - outcome.worst_use).into(),
        outcome
            .worst_rule
            .map_or(Cell::Empty, |rule| rule.name().into()),
        Objective::Energy.value(selection, candidate).into(),
    ]
}
