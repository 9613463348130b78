//! Sources of the figures of a document: files, digests, date.

use jred_file::model::machine::MachineFile;
use jred_sizing::catalogue::Catalogue;
use jred_sizing::study::header::digest;

/// Sources of the figures of an answer.
#[derive(Clone, Copy, Debug)]
pub struct Source<'a> {
    /// The machine file as named by the user.
    pub name: &'a str,
    /// Its text.
    pub text: &'a str,
    /// The day of the run.
    pub date: &'a str,
    /// The parts that were considered.
    pub parts: &'a Catalogue,
}

/// Digest of a machine file and of all files read with it.
pub(crate) fn machine_digest(source: &Source, file: &MachineFile) -> String {
    digest(&(source.text, &file.machine, &file.motion, &file.schedule))
}
