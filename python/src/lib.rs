//! The Python package `jred`: a thin layer over the packages of the tool. It has no physics and no sentences of its own.

mod error;
mod machine;
mod model;
mod study;

use std::ffi::OsString;
use std::path::PathBuf;

use pyo3::prelude::*;

use jred_cli::embedded;

use error::{failed, refused};
use machine::Machine;
use model::Model;
use study::Study;

/// Runs a command of `jred` and returns its exit code, its standard output and its messages. `files` has texts that stand for files on disk.
#[pyfunction]
fn run(
    py: Python<'_>,
    words: Vec<String>,
    files: Vec<(PathBuf, String)>,
) -> PyResult<(u8, String, Vec<String>)> {
    let ran = py.detach(|| embedded::run(&words, files));
    ran.map(|ran| (ran.code, ran.out, ran.messages))
        .map_err(|fault| refused(py, fault))
}

/// The command line: words behind `jred`; returns the exit code.
#[pyfunction]
fn command(py: Python<'_>, words: Vec<OsString>) -> u8 {
    py.detach(|| embedded::command(words))
}

/// The machine of a file or a text.
#[pyfunction]
fn read(py: Python<'_>, name: &str, text: String, folder: PathBuf) -> PyResult<Machine> {
    py.detach(|| Machine::new(name, text, folder))
        .map_err(|problem| failed(py, problem))
}

#[pymodule]
fn _jred(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_function(wrap_pyfunction!(run, module)?)?;
    module.add_function(wrap_pyfunction!(command, module)?)?;
    module.add_function(wrap_pyfunction!(read, module)?)?;
    module.add_class::<Machine>()?;
    module.add_class::<Model>()?;
    module.add_class::<Study>()
}
