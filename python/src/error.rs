//! Python exceptions that keep file, line, quantity and cure.

use miette::{Diagnostic, Report};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use jred_file::text::problem::Problem;

/// The exception of a problem of the libraries.
pub(crate) fn failed(py: Python<'_>, problem: Problem) -> PyErr {
    of(py, &problem)
}

/// The exception of a command that ended with an error.
pub(crate) fn refused(py: Python<'_>, report: Report) -> PyErr {
    of(py, report.as_ref())
}

/// `jred.JredError` with the parts of a diagnostic.
fn of(py: Python<'_>, fault: &dyn Diagnostic) -> PyErr {
    let raised = || -> PyResult<PyErr> {
        let class = py.import("jred._errors")?.getattr("JredError")?;
        let parts = PyDict::new(py);
        let message = fault.to_string();
        parts.set_item("cure", fault.help().map(|help| help.to_string()))?;
        parts.set_item("quantity", quoted(&message))?;
        let place = fault.labels().and_then(|mut labels| labels.next());
        if let (Some(place), Some(source)) = (place, fault.source_code())
            && let Ok(found) = source.read_span(place.inner(), 0, 0)
        {
            parts.set_item("file", found.name())?;
            parts.set_item("line", found.line() + 1)?;
            parts.set_item("column", found.column() + 1)?;
            // The span has a part of the line only.
            if let Ok(around) = source.read_span(place.inner(), 1, 1) {
                let text = String::from_utf8_lossy(around.data());
                let line = text.lines().nth(found.line() - around.line());
                parts.set_item("excerpt", line.unwrap_or_default().trim())?;
            }
            parts.set_item("label", place.label())?;
        }
        let error = class.call((message,), Some(&parts))?;
        Ok(PyErr::from_value(error))
    };
    raised().unwrap_or_else(|error| PyRuntimeError::new_err(error.to_string()))
}

/// The first name in back-ticks: the key or quantity of a message.
fn quoted(message: &str) -> Option<&str> {
    let (_, rest) = message.split_once('`')?;
    let (name, _) = rest.split_once('`')?;
    name.starts_with(char::is_alphabetic).then_some(name)
}
