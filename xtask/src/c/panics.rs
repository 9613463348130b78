//! No function of the library can panic: nothing with which a panic would begin is in it.

use std::path::Path;

use anyhow::{Result, ensure};

use super::gcc::LIBRARY;
use crate::cores::firmware;
use crate::run::{done, workspace};
use crate::symbols::{functions, panics, symbols};

/// Its core compiles to the most code.
const TARGET: &str = "thumbv6m-none-eabi";

/// Checks that no panic is in a library.
pub(crate) fn none(library: &Path, on: &str) -> Result<()> {
    let symbols = symbols(library)?;
    let found = panics(&symbols);
    ensure!(
        found.is_empty(),
        "a panic can be reached on {on}: {}",
        found.join(" ")
    );
    Ok(())
}

/// Checks every function there is; and that one that can panic would be found.
pub(crate) fn everywhere() -> Result<()> {
    let library = firmware(TARGET).join(LIBRARY);
    let compile = |options: &[&str]| {
        let mut cargo = workspace("rustc");
        cargo
            .args(["--quiet", "--package", "jred-ffi", "--profile", "firmware"])
            .args(["--target", TARGET, "--"])
            .args(options);
        done(&mut cargo)
    };
    compile(&["--cfg", "few_sets", "--cfg", "gate_panic"])?;
    ensure!(
        !panics(&symbols(&library)?).is_empty(),
        "a function that can panic is not found, so this gate shows nothing"
    );
    compile(&[])?;
    none(&library, TARGET)?;
    let count = functions(&symbols(&library)?, "jred_");
    println!("{count} functions, and no panic in them");
    Ok(())
}
