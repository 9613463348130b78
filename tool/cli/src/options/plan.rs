//! `--plan` of the commands that compute a motion.

use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::TypedValueParser;

use super::output_file;

/// File and accuracy of the plan.
#[derive(Debug, Args)]
pub struct PlanFile {
    /// Write the motion of the drive link as a plan that firmware follows (docs/table-image.md): Rust source if the name ends in .rs, source of C
    /// and C++ if in .h, .hh, .hpp, .hxx, .c, .cc, .cpp or .cxx, a binary image if in .jred, .bin, .img or .dat.
    #[arg(long, value_name = "FILE", value_parser = plan_file())]
    pub plan: Option<PathBuf>,
    /// Largest error of the plan as a share of the greatest speed and acceleration; for the position a tenth of this share of the distance.
    #[arg(long, value_name = "SHARE", default_value = "0.1 %", requires = "plan", value_parser = share)]
    pub plan_error: f64,
}

/// Format of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlanFormat {
    /// Rust source.
    Rust,
    /// Source of C and C++.
    C,
    /// The words as binary.
    Image,
}

impl PlanFormat {
    /// The format for a file extension, case-insensitive.
    pub fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_ascii_lowercase();
        match ending.to_str()? {
            "rs" => Some(Self::Rust),
            "h" | "hh" | "hpp" | "hxx" | "c" | "cc" | "cpp" | "cxx" => Some(Self::C),
            "jred" | "bin" | "img" | "dat" => Some(Self::Image),
            _ => None,
        }
    }
}

fn plan_file() -> impl TypedValueParser<Value = PathBuf> {
    output_file().try_map(|path| {
        if PlanFormat::of(&path).is_some() {
            return Ok(path);
        }
        Err(
            "its extension selects the form: .rs is Rust source; .h, .hh, .hpp, .hxx, .c, .cc, .cpp and .cxx are source of C and C++; .jred, .bin, .img and .dat are a binary image",
        )
    })
}

fn share(text: &str) -> Result<f64, String> {
    let share = jred_file::argument::any(&jred_file::units::kind::SHARE)(text)?;
    if (1e-6..=0.1).contains(&share) {
        Ok(share)
    } else {
        Err("it must be from 0.0001 % to 10 %, such as \"0.1 %\"".to_owned())
    }
}
