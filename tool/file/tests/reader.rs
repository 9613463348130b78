//! Machine files as these tests read them: without the checks of their mechanics, which are tested with `jred-analysis`.

use std::path::Path;

use jred_file::model::machine::MachineFile;
use jred_file::read::{self, UncheckedFile};
use jred_file::text::file::Files;
use jred_file::text::problem::Problem;

/// The machine file of a text.
pub(crate) fn parse(name: &str, text: &str, files: impl Files) -> Result<MachineFile, Problem> {
    read::parse(name, text, files).map(UncheckedFile::trusted)
}

/// The machine file at a path.
pub(crate) fn read(path: &Path) -> Result<MachineFile, Problem> {
    parse(
        &jred_file::plain::path(path),
        &read::text(path)?,
        read::folder(path),
    )
}
