//! A machine: its text, its curves.

use std::path::PathBuf;

use numpy::{IntoPyArray as _, PyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use jred_analysis::checked;
use jred_analysis::reduce::{Over, Request, Sets, reduce};
use jred_file::argument::Argument;
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;
use jred_file::model::variator;
use jred_file::number::columns::Columns;
use jred_file::problem;
use jred_file::text::key::{ACCELERATIONS, Kinds, SPEED};
use jred_file::text::problem::{Problem, Result};
use jred_file::units::literal::{self, Literal};
use jred_sizing::study::edit::{Document, Edit};

use crate::detached;
use crate::error::failed;

/// A machine file that was read and checked.
#[pyclass(frozen, module = "jred._jred")]
pub(crate) struct Machine {
    /// Name in messages.
    #[pyo3(get)]
    name: String,
    /// The text of the machine file.
    #[pyo3(get)]
    text: String,
    /// The folder from which the files that it names are read.
    #[pyo3(get)]
    folder: PathBuf,
    file: MachineFile,
}

/// A quantity: a number in SI, or a text with a unit.
#[derive(FromPyObject)]
enum Given {
    Number(f64),
    Text(String),
}

impl Given {
    /// Its value in SI.
    fn read(&self, name: &str, kinds: Kinds, coordinate: Coordinate) -> Result<f64> {
        let value = match self {
            Self::Number(value) => Ok(*value),
            Self::Text(text) => Argument::any(kinds).read(text, coordinate),
        };
        match value {
            Ok(value) if value.is_finite() => Ok(value),
            Ok(value) => Err(problem!("`{name}` is {value}; it must be finite")),
            Err(why) => Err(problem!("`{name}` cannot be used: {why}")),
        }
    }
}

impl Machine {
    pub(crate) fn new(name: &str, text: String, folder: PathBuf) -> Result<Self> {
        Ok(Self {
            name: name.to_owned(),
            file: checked::parse(name, &text, &*folder)?,
            text,
            folder,
        })
    }

    fn changed(&self, path: String, value: String) -> Result<Self> {
        let document = Document::parse(self.text.clone())?;
        let literals = literals(&document, &[(path, value)])?;
        let text = document.with(&edits(&literals));
        Self::new(&self.name, text, self.folder.clone())
    }
}

/// Quantities of a document, each by its path, with values as texts.
pub(crate) fn literals(
    document: &Document,
    values: &[(String, String)],
) -> Result<Vec<(usize, Literal)>> {
    let mut seen = Vec::new();
    let literal = |(path, value): &(String, String)| {
        let quantity = document.find(path)?;
        if seen.contains(&quantity) {
            return Err(problem!(
                help = "give each quantity once",
                "`{path}` is given twice, with two names"
            ));
        }
        seen.push(quantity);
        let value = literal::read(value).map_err(|why| {
            problem!(
                help = "write a number with its unit, such as \"60 kg\"",
                "`{path}` = \"{value}\" cannot be used: {why}"
            )
        })?;
        Ok((quantity, value))
    };
    values.iter().map(literal).collect()
}

/// The edits that write these values.
pub(crate) fn edits(literals: &[(usize, Literal)]) -> Vec<Edit<'_>> {
    let all = literals.iter();
    all.map(|(quantity, value)| Edit {
        quantity: *quantity,
        number: value.number,
        unit: &value.unit,
    })
    .collect()
}

#[pymethods]
impl Machine {
    /// Title of the machine.
    #[getter]
    fn title(&self) -> &str {
        &self.file.title
    }

    /// A machine with another value of the quantity at `path`, such as "slider.mass" and "60 kg".
    fn _set(&self, py: Python<'_>, path: String, value: String) -> PyResult<Self> {
        detached(py, || self.changed(path, value))
    }

    /// Paths of the quantities that can be set, each with its value.
    #[getter]
    fn quantities(&self, py: Python<'_>) -> PyResult<Vec<(String, String)>> {
        let document = Document::parse(self.text.clone()).map_err(|problem| failed(py, problem))?;
        let all = document.quantities().iter();
        Ok(all.map(|own| (own.path.clone(), own.shown())).collect())
    }

    /// The unit of the quantity at `path`; empty for a plain number.
    fn _unit(&self, py: Python<'_>, path: &str) -> PyResult<String> {
        let unit = || -> Result<String> {
            let document = Document::parse(self.text.clone())?;
            let quantity = document.find(path)?;
            let quantity = document.quantities().get(quantity);
            Ok(quantity.map_or_else(String::new, |own| own.unit().to_owned()))
        };
        unit().map_err(|problem| failed(py, problem))
    }

    #[pyo3(signature = (positions, over, speed, acceleration, links, points, forces, energy) -> "dict[str, numpy.typing.NDArray[numpy.float64]]")]
    #[expect(clippy::too_many_arguments, reason = "the keywords of one call")]
    fn _curves<'py>(
        &self,
        py: Python<'py>,
        positions: usize,
        over: &str,
        speed: Option<Given>,
        acceleration: Option<Given>,
        links: bool,
        points: bool,
        forces: bool,
        energy: bool,
    ) -> PyResult<Bound<'py, PyDict>> {
        let coordinate = self.file.machine.mechanism().coordinate();
        let given = |name: &str, value: Option<Given>, kinds| {
            let value = value.map(|value| value.read(name, kinds, coordinate));
            value.transpose().map_err(|problem| failed(py, problem))
        };
        let speed = given("speed", speed, SPEED)?;
        let acceleration = given("acceleration", acceleration, ACCELERATIONS)?;
        let state = speed.map(|speed| [speed, acceleration.unwrap_or(0.0)]);
        let over = if over == "time" {
            Over::Time
        } else {
            Over::Angle
        };
        if acceleration.is_some() && speed.is_none() || over == Over::Time && speed.is_some() {
            return Err(PyValueError::new_err(
                "give speed with acceleration, and neither with over=\"time\", in which the motion has both",
            ));
        }
        let request = Request {
            over,
            positions,
            sets: Sets {
                curves: !(points || forces || energy),
                links,
                torques: false,
                points,
                reactions: forces,
                energy,
            },
            state,
        };
        let columns = detached(py, || {
            variator::refuse(&self.file, "curves")?;
            if over == Over::Time {
                self.file.required_motion()?;
            }
            if (forces || energy) && state.is_none() {
                self.file.motion_or(
                    "forces and energies need a speed: give one, for example speed=\"60 rpm\", or ",
                )?;
            }
            reduce(&self.file, &request).map_err(Problem::of)
        });
        arrays(py, &columns?)
    }
}

/// Columns as arrays by title; an empty cell is NaN.
fn arrays<'py>(py: Python<'py>, columns: &Columns) -> PyResult<Bound<'py, PyDict>> {
    let found = PyDict::new(py);
    for (k, name) in columns.names().into_iter().enumerate() {
        let cell = |row: &Vec<Option<f64>>| row.get(k).copied().flatten().unwrap_or(f64::NAN);
        let values: Vec<f64> = columns.rows().iter().map(cell).collect();
        let array: Bound<'py, PyArray1<f64>> = values.into_pyarray(py);
        found.set_item(name, array)?;
    }
    Ok(found)
}
