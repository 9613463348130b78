//! Writes a motion as a plan for firmware.

use miette::{Result, miette};

use crate::commands::core_error::core_report;
use crate::options::plan::{PlanFile, PlanFormat};
use crate::output::Files;
use crate::terminal;
use jred::machine::Reducible as _;
use jred_export::{plan_c_source, plan_source};
use jred_file::model::machine::MachineFile;
use jred_file::plain;
use jred_motion::path_dynamics::Actuator;
use jred_motion::plan::Plan;
use jred_motion::plan::ramp::least_ramp;
use jred_motion::trace::Trace;
use jred_report::list;

/// A motion and the drive that makes it.
pub(super) struct PlannedMotion<'a> {
    pub(super) file: &'a MachineFile,
    pub(super) trace: &'a Trace,
    pub(super) actuator: &'a Actuator,
    /// Largest torque at the gearbox output (N·m).
    pub(super) gearbox: Option<f64>,
}

/// Writes the plan, if requested; returns a sentence about it.
///
/// # Errors
/// A motion that does not fit a plan, or a file that cannot be written.
pub(super) fn write(
    options: &PlanFile,
    motion: &PlannedMotion,
    files: &mut Files,
) -> Result<Option<String>> {
    let PlannedMotion { file, trace, .. } = *motion;
    let Some(path) = &options.plan else {
        return Ok(None);
    };
    let machine = jred_export::identifier(&file.title);
    let ramp = least_ramp(file, motion.actuator, motion.gearbox, trace).map_err(core_report)?;
    let plan = Plan::new(trace, file.machine.domain(), machine, options.plan_error)
        .and_then(|plan| plan.with_ramp(ramp))
        .map_err(|error| miette!(help = format!("{}", error.cure()), "{error}"))?;
    if let Some(warning) = list::plan::warning(&plan, trace) {
        terminal::say(&format!("warning: {warning}"));
    }
    let says = list::plan::text(&plan, trace);
    let title = format!("{}: {says}", file.title);
    let bytes = match PlanFormat::of(path) {
        Some(PlanFormat::Rust) => plan_source(&title, machine, &plan.words).into_bytes(),
        Some(PlanFormat::C) => {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            plan_c_source(&title, &name, machine, &plan.words).into_bytes()
        }
        Some(PlanFormat::Image) | None => plan.bytes(),
    };
    files.add(path, &bytes)?;
    Ok(Some(format!(
        "plan written to {}: {says}",
        plain::path(path)
    )))
}
