//! The worth of feed-forward: machines with exact mechanics under the controller of a drive, with and without a table of jred.
//!
//! ```text
//! cargo run --release -p jred-closed-loop                  the tables of docs/closed-loop.md
//! cargo run --release -p jred-closed-loop -- --plots docs  its pictures, into a folder
//! ```
#![forbid(unsafe_code)]

#[path = "../../support/closed_loop.rs"]
mod closed_loop;
mod feed_forward;
mod machine;
mod page;
mod plant;
mod plots;
mod study;
#[cfg(test)]
mod tests;

use std::path::Path;
use std::process::ExitCode;

/// Why the study ends.
type Fault = Box<dyn std::error::Error>;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let done = match words.as_slice() {
        [] => tables(),
        ["--plots", folder] => plots(Path::new(folder)),
        _ => Err("unknown arguments; give none, or --plots FOLDER".into()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(fault) => {
            eprintln!("error: {fault}");
            ExitCode::FAILURE
        }
    }
}

/// Prints the tables.
fn tables() -> Result<(), Fault> {
    for case in machine::CASES {
        println!("{}", page::table(case)?);
    }
    print!("{}", page::summary()?);
    Ok(())
}

/// Writes the pictures.
fn plots(folder: &Path) -> Result<(), Fault> {
    for (name, plot) in [
        ("closed-loop-speed.svg", plots::over_pace()?),
        ("closed-loop-cycle.svg", plots::over_cycle()?),
    ] {
        let path = folder.join(name);
        std::fs::write(&path, plot).map_err(|error| {
            format!(
                "cannot write {}: {error}; give a folder that exists",
                path.display()
            )
        })?;
    }
    Ok(())
}
