//! The command `jred`.

use std::process::ExitCode;

use clap::Parser as _;
use jred_cli::commands::{Done, run};
use jred_cli::options::Cli;

fn main() -> ExitCode {
    // clap itself ends with 2 on a wrong command line.
    match run(&Cli::parse().command) {
        Ok(Done::Holds) => ExitCode::SUCCESS,
        Ok(Done::Violated) => ExitCode::from(1),
        // As a shell reports a program that Ctrl-C ended.
        Ok(Done::Stopped) => ExitCode::from(130),
        Err(report) => {
            eprintln!("{report:?}");
            ExitCode::from(2)
        }
    }
}
