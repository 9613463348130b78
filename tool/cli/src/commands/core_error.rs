//! The core's errors as reports: the fault, and its cure as help.

use jred::error::Error;
use jred_analysis::duty::DutyError;
use miette::{Report, miette};

/// Report of an obstacle to a duty.
pub(crate) fn duty_report(fault: DutyError) -> Report {
    match fault {
        DutyError::Machine(error) => core_report(error),
        fault => fault.into(),
    }
}

/// Report of an error of the core.
pub(crate) fn core_report(error: impl Into<Error>) -> Report {
    let error = error.into();
    match error.cure().to_string() {
        cure if cure.is_empty() => miette!("{error}"),
        cure => miette!(help = cure, "{error}"),
    }
}
