//! The Python package `jred`: a thin layer over the packages of the tool. It has no physics and no sentences of its own.

mod error;
mod machine;
mod model;
mod study;

use std::ffi::OsString;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread::Builder;
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use jred_cli::embedded;
use jred_file::text::problem::Result;

use error::{failed, refused};
use machine::Machine;

/// Runs a command of `jred` on a thread of its own, so that Ctrl-C is heeded, and returns its exit code, its standard output and its messages. `files` has texts that stand for files on disk.
#[pyfunction]
fn run(
    py: Python<'_>,
    words: Vec<String>,
    files: Vec<(PathBuf, String)>,
) -> PyResult<(u8, String, Vec<String>)> {
    let stop = Arc::new(AtomicBool::new(false));
    let own = Arc::clone(&stop);
    let (sender, mut receiver) = mpsc::channel();
    Builder::new().stack_size(STACK).spawn(move || {
        // Nobody receives the result of an interrupted command.
        let _ = sender.send(embedded::run(&words, files, &own));
    })?;
    loop {
        let ran;
        (ran, receiver) = py.detach(move || (receiver.recv_timeout(INTERVAL), receiver));
        match ran {
            Ok(ran) => {
                return ran
                    .map(|ran| (ran.code, ran.out, ran.messages))
                    .map_err(|fault| refused(py, fault));
            }
            Err(RecvTimeoutError::Timeout) => py
                .check_signals()
                .inspect_err(|_| stop.store(true, Ordering::Relaxed))?,
            Err(RecvTimeoutError::Disconnected) => return Err(panicked()),
        }
    }
}

/// Time between two looks for Ctrl-C.
const INTERVAL: Duration = Duration::from_millis(100);

/// Stack of a command's thread: that of a program.
const STACK: usize = 8 << 20;

/// The command line: words behind `jred`; returns the exit code.
#[pyfunction]
fn command(py: Python<'_>, words: Vec<OsString>) -> u8 {
    py.detach(|| embedded::command(words))
}

/// Does some work without the interpreter's lock, on a stack like that of a program: threads of Python may have a smaller one.
fn detached<T: Send>(py: Python<'_>, work: impl FnOnce() -> Result<T> + Send) -> PyResult<T> {
    let done = py.detach(|| {
        std::thread::scope(|scope| {
            let thread = Builder::new().stack_size(STACK).spawn_scoped(scope, work)?;
            Ok::<_, std::io::Error>(thread.join())
        })
    })?;
    match done {
        Ok(done) => done.map_err(|problem| failed(py, problem)),
        Err(_) => Err(panicked()),
    }
}

fn panicked() -> PyErr {
    PyRuntimeError::new_err(
        "jred panicked, which is a fault of it; its message is on standard error",
    )
}

/// The machine of a file or a text.
#[pyfunction]
fn read(py: Python<'_>, name: &str, text: String, folder: PathBuf) -> PyResult<Machine> {
    detached(py, || Machine::new(name, text, folder))
}

/// The native part of the package.
#[pymodule]
mod _jred {
    use numpy::PyArray1;
    use pyo3::prelude::*;

    #[pymodule_export]
    use super::machine::Machine;
    #[pymodule_export]
    use super::model::Model;
    #[pymodule_export]
    use super::study::Study;
    #[pymodule_export]
    use super::{command, read, run};
    #[pymodule_export]
    #[expect(non_upper_case_globals, reason = "the name that Python gives it")]
    const __version__: &str = env!("CARGO_PKG_VERSION");

    /// NumPy is imported now: later, a signal in the midst of it would be a panic.
    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.py().import("numpy")?;
        PyArray1::<f64>::zeros(module.py(), 0, false);
        Ok(())
    }
}
