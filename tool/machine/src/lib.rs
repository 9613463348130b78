//! Machines as data: the texts that describe them, what they say, and what can be worked out from that alone.
//!
//! One of the packages behind the command `jred`; each knows those to its left:
//!
//! ```text
//! jred ─► jred-enclosure ─► jred-machine ─► jred-sizing ─► jred-motion ─► jred-report ─► jred-cli
//! core    curves in         machine files,   catalogue,     motions for a   tables, plots,  the command
//!         intervals         analysis         drives         drive           pages
//! ```
//!
//! The way of the data is that of the folders, each knows those before it:
//!
//! 1. [`number`]: rounding, integrals, splines, columns of numbers; [`plain`]: texts that show all that they hold.
//! 2. [`units`] and [`text`]: quantities with units, TOML and CSV with places; every fault names its place and its cure.
//! 3. [`model`]: a machine as a machine file describes it, in SI units.
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
