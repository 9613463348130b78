//! Checks that followers stay on their cams and ropes stay taut during the prescribed motion.

use jred::error::Error;

use crate::analysis::contact::lost;
use crate::model::machine::MachineFile;

use crate::text::problem::Result;
use crate::text::section::Section;

/// Checks that every cam contact presses and every rope pulls over the whole motion. A cam that guides its follower on both sides needs no check.
pub(super) fn check(file: &MachineFile, mechanism: &Section) -> Result<()> {
    let Some(motion) = &file.motion else {
        return Ok(());
    };
    let report = |error: Error| {
        mechanism
            .problem(error.to_string(), "in this mechanism")
            .help(error.cure().to_string())
    };
    let Some(lost) = lost(file, motion).map_err(report)? else {
        return Ok(());
    };
    let parted = lost.parted;
    let message = format!(
        "{} in the prescribed motion: at {}, {}",
        parted.what, parted.state, parted.force
    );
    let label = if lost.joint.rope {
        "in this mechanism"
    } else {
        "in this cam"
    };
    Err(mechanism.problem(message, label).help(parted.cure))
}
