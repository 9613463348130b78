//! `--profile` and `--cam` of the commands that compute a motion.

use std::path::PathBuf;

use clap::Args;

use super::output_file;
use super::word::word;
use jred_export::CamForm;
use jred_motion::trace::Master;

/// Files with the course of a motion.
#[derive(Debug, Args)]
pub struct SeriesFiles {
    /// Write the motion to this file as a profile, times and positions, which `[motion]` of a machine file reads with type = "profile".
    #[arg(long, value_name = "CSV", value_parser = output_file())]
    pub profile: Option<PathBuf>,
    /// Write the motion as the table of an electronic cam, over a master that makes one turn during the motion.
    #[arg(long, value_name = "FILE", value_parser = output_file())]
    pub cam: Option<PathBuf>,
    /// Form of the cam table; names in it are that of the file.
    #[arg(long, value_name = "FORM", requires = "cam", value_parser = word::<CamForm>(), default_value_t)]
    pub cam_form: CamForm,
    /// Number of rows of the cam table; if not given 2001, or 721 with --cam-form sew or siemens, which take fewer as delivered.
    #[arg(long, value_parser = clap::value_parser!(u32).range(5..=1_000_000))]
    pub rows: Option<u32>,
    /// Unit of the cam table's master, which makes one turn during the motion; the derivatives are with respect to it.
    #[arg(long, value_name = "UNIT", value_parser = word::<Master>(), default_value_t)]
    pub master: Master,
}
