//! Commands for developers of jred; `scripts/test` calls most of them.
#![forbid(unsafe_code)]

mod arduino;
mod bits;
mod book;
mod bounds;
mod c;
mod calls;
mod ceilings;
mod cores;
mod data;
mod elf;
mod examples;
mod expected;
mod gates;
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
mod run;
mod symbols;
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
    Arduino(arduino::Options),
    Bits(bits::Options),
    Book(book::Options),
    C(c::Options),
    Examples(examples::Options),
    Gates(gates::Options),
    Loaded(loaded::Options),
    Perf(perf::Options),
    Template(template::Options),
}

fn main() -> ExitCode {
    let result = match Cli::parse().command {
        Command::Arduino(options) => arduino::run(&options),
        Command::Bits(options) => bits::run(&options),
        Command::Book(options) => book::run(&options),
        Command::C(options) => c::run(&options),
        Command::Examples(options) => examples::run(&options),
        Command::Gates(options) => gates::run(&options),
        Command::Loaded(options) => loaded::run(&options),
        Command::Perf(options) => perf::run(&options),
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
