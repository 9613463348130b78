//! The keys of a machine file, described once: readers read by them, hints name them, the tables of the documentation and
//! `docs/schemas/machine-file.json` are made from them.
//!
//! A line is a key: its name, what it holds, what it means. `may` keys may be missing, `or` gives their default. Links in the texts are relative to the
//! page of the table.

#[rustfmt::skip]
pub(crate) mod cam;
pub mod complete;
#[rustfmt::skip]
pub(crate) mod drive;
#[rustfmt::skip]
pub(crate) mod linkage;
#[rustfmt::skip]
pub(crate) mod loads;
#[rustfmt::skip]
pub(crate) mod mechanism;
#[rustfmt::skip]
pub(crate) mod motion;
#[rustfmt::skip]
mod parts;
#[rustfmt::skip]
mod project;
pub mod place;
#[rustfmt::skip]
pub(crate) mod simulation;
#[rustfmt::skip]
pub(crate) mod site;
pub mod starter;
#[rustfmt::skip]
mod top;

pub use project::PROJECT;
pub use site::RULE_SET;
pub use top::MACHINE;

/// A table whose keys are listed with those of the table that it is in.
macro_rules! inner {
    ($($group:expr),* $(,)?) => {
        $crate::text::key::ValueForm::Table(&$crate::text::key::KeyTable::of("", &[$($group),*]))
    };
}
use inner;
