//! The command `jred`.
#![forbid(unsafe_code)]

use std::process::ExitCode;

use jred_cli::embedded::command;

fn main() -> ExitCode {
    ExitCode::from(command(std::env::args_os().skip(1).collect()))
}
