//! One machine text over one catalogue, evaluated for many values of its quantities.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use pyo3::prelude::*;
use pyo3::types::PyDict;

use jred_file::model::rule::Rule;
use jred_file::model::tolerance::Tolerance;
use jred_file::problem;
use jred_file::text::file::Files;
use jred_file::text::problem::{Problem, Result};
use jred_file::units::Fault;
use jred_sizing::catalogue::{Catalogue, Sources};
use jred_sizing::cell::Cell;
use jred_sizing::judge::{Findings, Outcome};
use jred_sizing::select::filter::Filter;
use jred_sizing::select::size::Selection;
use jred_sizing::study::axis::{Grid, Variation};
use jred_sizing::study::chosen::ChosenDrive;
use jred_sizing::study::common::Study as Common;
use jred_sizing::study::grid::GridStudy;
use jred_sizing::study::sensitivity::used;
use jred_sizing::study::task::RowSource;
use jred_sizing::study::tolerance::{Samples, Scatter};

use crate::detached;
use crate::machine::{edits, literals};

/// A folder of which each file is read once: the digest of a study is that of all its rows.
#[derive(Debug)]
struct Once {
    folder: PathBuf,
    texts: Arc<Texts>,
}

/// Texts of files by name.
type Texts = Mutex<BTreeMap<String, String>>;

impl Files for Once {
    fn shown(&self, file: &str) -> String {
        self.folder.shown(file)
    }

    fn text(&self, file: &str, limit: u64) -> std::result::Result<String, Fault> {
        let mut texts = self.texts.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(text) = texts.get(file) {
            return Ok(text.clone());
        }
        let text = self.folder.text(file, limit)?;
        texts.insert(file.to_owned(), text.clone());
        Ok(text)
    }
}

/// A machine over a catalogue.
#[pyclass(frozen, module = "jred._jred")]
pub(crate) struct Study {
    common: Common,
    /// The drive that is judged; `None`: the best of the catalogue for each machine.
    drive: Option<ChosenDrive>,
    /// The best drive of the nominal machine, found on demand.
    chosen: OnceLock<ChosenDrive>,
    folder: PathBuf,
    /// The files that the machine names.
    texts: Arc<Texts>,
}

/// The name of a drive; whether it violates no rule; of each rule with a limit the used share, 0 where the rule does not apply, and whether it
/// can refuse the drive; the rules that lack data.
type Evaluated = (
    String,
    bool,
    Vec<(&'static str, f64, bool)>,
    Vec<&'static str>,
);

/// Rows between two looks for Ctrl-C.
const BLOCK: usize = 16;

impl Study {
    /// The judgement of the drive in a machine with these values.
    fn evaluated(&self, values: &[(String, String)]) -> Result<Evaluated> {
        let read = literals(&self.common.document, values)?;
        let machine = self.common.machine(&edits(&read))?;
        let (site, rules) = (&machine.file.site, &machine.file.rules);
        let named = |findings: Findings, name: String| {
            let known: Vec<(Rule, f64)> = used(rules, &findings).collect();
            let of = |rule| known.iter().find(|(other, _)| *other == rule);
            let limited = Rule::ALL
                .into_iter()
                .filter(|rule| rules.limit(*rule).is_set());
            let shares = limited.map(|rule| {
                let share = of(rule).map_or(0.0, |(_, share)| *share);
                (rule.name(), share, rules.limit(rule).fail.is_some())
            });
            let outcome = Outcome::of(rules, &findings);
            let open = Rule::ALL
                .into_iter()
                .filter(|rule| outcome.not_checked.has(*rule));
            let open = open.map(Rule::name).collect();
            (name, !outcome.fails(), shares.collect(), open)
        };
        if let Some(drive) = &self.drive {
            return Ok(named(drive.findings(&machine), drive.name()));
        }
        let motors = self.common.catalogue.prepare(site);
        let catalogue = &self.common.catalogue;
        let found = Selection::best(catalogue, &motors, &machine.cycle, site, rules);
        let best = found.or_else(|| {
            let all = Selection::new(catalogue, &motors, &machine.cycle, site, rules);
            all.refused.first().copied()
        });
        let best = best.ok_or_else(|| problem!("no drive can be built for this machine"))?;
        let own = ChosenDrive::of(&best.drive, &self.common.catalogue);
        Ok(named(own.findings(&machine), own.name()))
    }

    fn rows<'py>(
        &self,
        py: Python<'py>,
        task: &(impl RowSource + ?Sized),
        share: [u64; 2],
    ) -> PyResult<Bound<'py, PyDict>> {
        let header = task.header();
        let rows: Vec<u64> = (share[0]..header.rows)
            .step_by(share[1].max(1) as usize)
            .collect();
        let mut cells: Vec<Vec<Cell>> = Vec::new();
        for some in rows.chunks(BLOCK) {
            cells.extend(detached(py, || {
                Ok(some.iter().map(|row| task.row(*row)).collect::<Vec<_>>())
            })?);
            py.check_signals()?;
        }
        let found = PyDict::new(py);
        found.set_item("row", rows)?;
        for (k, name) in header.columns.iter().enumerate() {
            let column = cells.iter().map(|row| match row.get(k) {
                Some(Cell::Number(x)) => x.into_pyobject(py).map(|x| x.into_any().unbind()).ok(),
                Some(Cell::Text(words)) => {
                    words.into_pyobject(py).map(|x| x.into_any().unbind()).ok()
                }
                _ => None,
            });
            found.set_item(name, column.collect::<Vec<_>>())?;
        }
        let about = [
            ("study", header.jred),
            ("version", header.version),
            ("machine", header.machine_digest),
            ("catalogue", header.catalogue_digest),
            ("options", header.options.join("; ")),
            ("rows", header.rows.to_string()),
        ];
        let both = PyDict::new(py);
        both.set_item("columns", found)?;
        both.set_item("about", about.into_iter().collect::<BTreeMap<_, _>>())?;
        Ok(both)
    }
}

#[pymethods]
impl Study {
    #[new]
    #[pyo3(signature = (name, text, folder, catalogues, drive, steps))]
    fn new(
        py: Python<'_>,
        name: String,
        text: String,
        folder: PathBuf,
        catalogues: Vec<PathBuf>,
        drive: Option<&str>,
        steps: usize,
    ) -> PyResult<Self> {
        let made = || -> Result<Self> {
            let sources = Sources {
                catalogues,
                ..Sources::default()
            };
            let catalogue = Catalogue::open(&sources).map_err(|error| problem!("{error}"))?;
            let texts = Arc::default();
            let files = Once {
                folder: folder.clone(),
                texts: Arc::clone(&texts),
            };
            let common = Common::new(name, text, Box::new(files), catalogue, None, steps)?;
            let drive = match drive {
                Some(name) => Some(ChosenDrive::of(&common.drive(name)?.1, &common.catalogue)),
                None => None,
            };
            Ok(Self {
                common,
                drive,
                chosen: OnceLock::new(),
                folder,
                texts,
            })
        };
        detached(py, made)
    }

    /// Whether the files that the machine names are still as they were read.
    fn is_current(&self) -> bool {
        let texts = self.texts.lock().unwrap_or_else(PoisonError::into_inner);
        texts.iter().all(|(file, text)| {
            let now = self.folder.text(file, text.len() as u64 + 1);
            now.is_ok_and(|now| now == *text)
        })
    }

    /// The judgement of the drive for these values of quantities.
    fn evaluate(&self, py: Python<'_>, values: Vec<(String, String)>) -> PyResult<Evaluated> {
        detached(py, || self.evaluated(&values))
    }

    /// Rows of a share of `jred vary`: the columns, and what the study is.
    #[pyo3(signature = (axes, share) -> "dict[str, dict[str, typing.Any]]")]
    fn vary<'py>(
        &self,
        py: Python<'py>,
        axes: Vec<String>,
        share: [u64; 2],
    ) -> PyResult<Bound<'py, PyDict>> {
        let read = || -> Result<Grid> {
            let axes = axes
                .iter()
                .map(|text| Variation::parse(&self.common.document, text));
            Grid::new(axes.collect::<Result<_, Problem>>()?)
        };
        let task = GridStudy {
            study: &self.common,
            grid: detached(py, read)?,
            filter: Filter::default(),
            rank: None,
        };
        self.rows(py, &task, share)
    }

    /// Rows of a share of `jred tolerance`.
    #[pyo3(signature = (given, samples, seed, share) -> "dict[str, dict[str, typing.Any]]")]
    fn tolerance<'py>(
        &self,
        py: Python<'py>,
        given: Vec<(String, String)>,
        samples: u64,
        seed: u64,
        share: [u64; 2],
    ) -> PyResult<Bound<'py, PyDict>> {
        let read = || -> Result<_> {
            let given = given.iter().map(|(path, amount)| {
                Tolerance::parse(path, amount).map_err(|why| {
                    problem!(
                        help = "write \"5 %\", \"0.1 mm\" or \"normal: 2 %\"",
                        "`{path}` = \"{amount}\" cannot be used: {why}"
                    )
                })
            });
            let scatters = Scatter::all(&self.common, &given.collect::<Result<Vec<_>>>()?)?;
            let machine = self.common.machine(&[])?;
            if self.drive.is_none() && self.chosen.get().is_none() {
                let one = ChosenDrive::choose(&self.common, None, &Filter::default(), None)?;
                // Another thread may have been first, with the same drive.
                let _ = self.chosen.set(one);
            }
            let one = self.drive.as_ref().or_else(|| self.chosen.get());
            let one = one.ok_or_else(|| problem!("no drive can be built for this machine"))?;
            Ok((scatters, machine, one))
        };
        let (scatters, machine, one) = detached(py, read)?;
        let task = Samples::new(&self.common, one, &machine, scatters, samples, seed);
        self.rows(py, &task, share)
    }
}
