//! Servo sizing for machines whose inertia depends on the angle: the library behind the command `jred`.
//!
//! The way of the data: [`input`] reads a machine file into a [`machine::MachineFile`]; [`duty`] samples one cycle of
//! its motion; [`size`] judges every drive of a [`catalogue`] against it; the rest are the commands and their output.

pub mod catalogue;
pub mod check;
pub mod cli;
pub mod commands;
pub mod contact;
pub mod coordinate;
pub mod drawing;
pub mod drive;
pub mod duty;
pub mod envelope;
pub mod export;
pub mod input;
pub mod inspect;
pub mod listing;
pub mod machine;
pub mod motion;
pub mod numerics;
pub mod output;
pub mod plot;
pub mod reduce;
pub mod report;
pub mod rules;
pub mod simulate;
pub mod size;
pub mod split;
pub mod variator;
