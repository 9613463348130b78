//! The command `jred`.

use std::process::ExitCode;

use clap::Parser as _;
use jred_cli::commands::{Done, run};
use jred_cli::options::Cli;
use jred_cli::output;
use jred_machine::text::plain;

fn main() -> ExitCode {
    // Colours are made with characters that are not seen: where an argument holds such, errors are shown without colours, so
    // that all of them can be escaped.
    let hidden = |word: std::ffi::OsString| plain::hidden(&word.to_string_lossy()).is_some();
    let hostile = std::env::args_os().any(hidden);
    let cli = match Cli::try_parse() {
        Err(error) if hostile => {
            output::say(&error.render().to_string());
            return ExitCode::from(2);
        }
        // It ends with 2 on a wrong command line, with 0 after a help text.
        parsed => parsed.unwrap_or_else(|error| error.exit()),
    };
    match run(&cli.command) {
        Ok(Done::Holds) => ExitCode::SUCCESS,
        Ok(Done::Violated) => ExitCode::from(1),
        // As a shell reports a program that Ctrl-C ended.
        Ok(Done::Stopped) => ExitCode::from(130),
        Err(report) => {
            output::complain(&report, hostile);
            ExitCode::from(2)
        }
    }
}
