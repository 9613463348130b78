//! Machine files, read and checked: the one way from a text to a machine that is analysed.

#[cfg(feature = "fs")]
use std::path::Path;

use jred_file::problem;
use jred_file::text::problem::Problem;

use jred_file::model::machine::MachineFile;
use jred_file::read;
use jred_file::text::file::Files;

use crate::check::check;

/// Reads the machine file at `path`, or standard input if it is `-`; its loads must repeat every turn.
///
/// # Errors
/// A file that cannot be read, any error of [`parse`], or a load that repeats only after several turns.
#[cfg(feature = "fs")]
pub fn read(path: &Path) -> Result<MachineFile, Problem> {
    one_turn(read_over_turns(path)?)
}

/// Refuses loads that repeat only after several turns.
fn one_turn(file: MachineFile) -> Result<MachineFile, Problem> {
    match file.turns() {
        1 => Ok(file),
        turns => Err(problem!(
            help = "for this command give loads without `turns`, which act alike in every turn",
            "the loads of {} repeat after {turns} turns: only `jred simulate` and `jred steady` follow the drive link from turn to turn",
            file.name
        )),
    }
}

/// [`read()`] for a command that follows the drive link over several turns; loads may repeat after several turns.
///
/// # Errors
/// A file that cannot be read, or any error of [`parse`].
#[cfg(feature = "fs")]
pub fn read_over_turns(path: &Path) -> Result<MachineFile, Problem> {
    parse(&read::name(path), &read::text(path)?, read::folder(path))
}

/// Reads a machine file from its `text`. `name` is its name in messages; `files` provides the files that it names, for example a profile's CSV.
///
/// # Errors
/// The first fault in the file, with its place and a cure.
pub fn parse(name: &str, text: &str, files: impl Files) -> Result<MachineFile, Problem> {
    let unchecked = read::parse(name, text, files)?;
    check(unchecked).map_err(|problem| problem.in_text(name, text))
}

/// [`parse`], where loads must repeat every turn.
///
/// # Errors
/// Any error of [`parse`], or a load that repeats only after several turns.
pub fn parse_one_turn(name: &str, text: &str, files: impl Files) -> Result<MachineFile, Problem> {
    one_turn(parse(name, text, files)?)
}

/// [`parse`] for a `text` that differs from one already read, but not in its machine and motion: the checks of its mechanics, which take most of the
/// time, are skipped.
///
/// # Errors
/// Errors of reading.
pub fn parse_around(name: &str, text: &str, files: impl Files) -> Result<MachineFile, Problem> {
    Ok(read::parse(name, text, files)?.trusted())
}
