//! The core's errors in a report: what is wrong, and its cure as help.

use jred::error::Error;
use jred_machine::analysis::duty::Fault;
use miette::{Report, miette};

/// The report of what stands in the way of a duty.
pub(crate) fn duty_report(fault: Fault) -> Report {
    match fault {
        Fault::Machine(error) => core_report(error),
        fault => fault.into(),
    }
}

/// The report of an error of the core.
pub(crate) fn core_report(error: impl Into<Error>) -> Report {
    let error = error.into();
    match error.cure().to_string() {
        cure if cure.is_empty() => miette!("{error}"),
        cure => miette!(help = cure, "{error}"),
    }
}
