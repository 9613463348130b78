//! `--plan` of the commands that make a motion.

use std::path::PathBuf;

use clap::Args;

use super::output_file;

/// Where the plan goes, and how exact it is.
#[derive(Debug, Args)]
pub struct PlanFile {
    /// Write the motion of the drive link as a plan that firmware follows (docs/table-image.md): Rust source if the name ends in .rs, source of C
    /// and C++ if in .h, .hh, .hpp, .hxx, .c, .cc, .cpp or .cxx, otherwise a binary image.
    #[arg(long, value_name = "FILE", value_parser = output_file())]
    pub plan: Option<PathBuf>,
    /// Share of the greatest speed and acceleration by which the plan may be off, of the way a tenth of it.
    #[arg(long, value_name = "SHARE", default_value = "0.1 %", requires = "plan", value_parser = share)]
    pub plan_error: f64,
}

fn share(text: &str) -> Result<f64, String> {
    let share = jred_machine::read::share_argument(text)?;
    if (1e-6..=0.1).contains(&share) {
        Ok(share)
    } else {
        Err("it must be from 0.0001 % to 10 %, such as \"0.1 %\"".to_owned())
    }
}
