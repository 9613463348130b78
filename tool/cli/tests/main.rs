//! The test program of the command.
#![allow(
    clippy::disallowed_methods,
    reason = "tests show paths that they made, and expect values of another library"
)]

mod aas;
mod begin;
mod bus {
    //! `jred bus`.
    pub(crate) mod command;
    mod conflict;
    mod cures;
    mod several;
}
mod catalogue;
mod check;
mod choice;
mod cli;
mod documents;
mod drawing;
mod drive;
mod envelope_commands;
mod export;
mod finite;
mod hidden;
mod identify;
mod machines;
mod made_anew;
mod many_rows;
mod meter;
mod motions;
mod outputs;
mod pages;
mod plc;
mod points;
mod press;
mod project;
mod reactions;
mod report;
mod rules;
mod schemas;
mod search_commands;
mod sensitivity_commands;
mod size_json;
mod split;
mod support;
mod units;
mod vary;
mod wording;
