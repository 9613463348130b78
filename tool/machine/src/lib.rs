//! Machines as data: the texts that describe them, their content, and its analysis.
//!
//! One of the packages behind the command `jred`; each knows those to its left:
//!
//! ```text
//! jred ─► jred-enclosure ─► jred-machine ─► jred-sizing ─► jred-motion ─► jred-report ─► jred-cli
//! core    curves in         machine files,   catalogue,     motions for a   tables, plots,  the command
//!         intervals         analysis         drives         drive           pages
//! ```
//!
//! The folders follow the flow of the data; each knows those before it:
//!
//! 1. [`number`]: rounding, integrals, splines, columns of numbers; [`plain`]: texts without hidden characters.
//! 2. [`units`] and [`text`]: quantities with units, TOML and CSV with positions; every fault names its position and its cure.
//! 3. [`model`]: a machine as described by a machine file, in SI units.
//! 4. [`analysis`]: reduction, duty, check of the mechanism, free motion.
//! 5. [`read`]: a text in, a [`model::machine::MachineFile`] out.
//! 6. `enclose`: its curves in intervals, for proofs. [`export`]: the smallest table for the firmware that meets a torque error.
#![forbid(unsafe_code)]

pub mod analysis;
mod enclose;
pub mod export;
pub mod model;
pub mod number;
pub mod plain;
pub mod read;
pub mod text;
pub mod units;
