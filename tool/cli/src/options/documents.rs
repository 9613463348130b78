//! Documents of an answer.

use std::path::PathBuf;

use clap::{ArgGroup, Args};

use super::document;
use super::word::word;
use jred_report::page::Paper;

/// Files for people who do not use the command.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("page").multiple(true))]
pub struct Documents {
    /// Write a report as one self-contained HTML page.
    #[arg(
        long,
        alias = "plot",
        value_name = "HTML",
        group = "page",
        value_parser = document("--report")
    )]
    pub report: Option<PathBuf>,
    /// Write the report as PDF. A browser prints it: the one named by the environment variable JRED_BROWSER, else Chromium, Chrome, Edge or Brave.
    #[arg(long, value_name = "PDF", group = "page", value_parser = document("--pdf"))]
    pub pdf: Option<PathBuf>,
    /// Paper of the report: a4 if not given.
    #[arg(long, value_parser = word::<Paper>(), requires = "page")]
    pub paper: Option<Paper>,
    /// Write every table of the answer as a sheet of a workbook for spreadsheet programs.
    #[arg(long, value_name = "XLSX", value_parser = document("--xlsx"))]
    pub xlsx: Option<PathBuf>,
}

impl Documents {
    /// The files with their options.
    pub fn files(&self) -> [(&'static str, &Option<PathBuf>); 3] {
        [
            ("--report", &self.report),
            ("--pdf", &self.pdf),
            ("--xlsx", &self.xlsx),
        ]
    }
}
