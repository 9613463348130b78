//! Commands for developers of jred: `cargo xtask perf`, `cargo xtask loaded`, `cargo xtask c`, `cargo xtask template`, `cargo xtask book`.
#![forbid(unsafe_code)]

mod book;
mod bounds;
mod c;
mod calls;
mod ceilings;
mod cores;
mod data;
mod elf;
mod image;
mod instruction;
mod kernels;
mod loaded;
mod machine;
mod mnemonic;
mod number;
mod peers;
mod perf;
mod program;
mod report;
mod template;
mod timing;
mod trace;
mod user;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

#[derive(Parser)]
#[command(about, bin_name = "cargo xtask")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Book(book::Options),
    Perf(perf::Options),
    Loaded(loaded::Options),
    C(c::Options),
    Template(template::Options),
}

fn main() -> ExitCode {
    let result = match Cli::parse().command {
        Command::Book(options) => book::run(&options),
        Command::Perf(options) => perf::run(&options),
        Command::Loaded(options) => loaded::run(&options),
        Command::C(options) => c::run(&options),
        Command::Template(options) => template::run(&options),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error:#}");
            ExitCode::FAILURE
        }
    }
}
