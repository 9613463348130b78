//! Machine files: a text in, a machine with its motion and drive train out, in SI units; every fault with its line and its cure.
//!
//! One of the packages behind the command `jred`; each uses those to its left:
//!
//! ```text
//! jred ─► jred-enclosure ─► jred-file ─┬─► jred-analysis ─► jred-sizing ─► jred-motion ─┬─► jred-report ─► jred-cli
//! core    curves in         machine    │   duty,            drives,        motions for  │   tables, plots, the command
//!         intervals         files      │   simulation       catalogue      a drive      │   pages
//!                                      └─► jred-export: tables for the firmware ────────┘
//! ```
//!
//! Its modules follow the flow of the data; each knows those before it:
//!
//! 1. [`plain`]: texts without hidden characters; [`math`]: sines and powers; [`number`]: rounding, integrals, splines, columns of numbers.
//! 2. [`units`] and [`text`]: quantities with units, TOML and CSV with positions.
//! 3. [`model`]: a machine as described by a machine file.
//! 4. [`argument`]: quantities of a command line, with the units of machine files.
//! 5. [`keys`]: every key of a machine file, described once: reading, hints, documentation and the schema for editors follow.
//! 6. [`read`]: a text in, a [`model::machine::MachineFile`] out. Its mechanics are checked by `jred-analysis`.
#![forbid(unsafe_code)]

pub mod argument;
pub mod keys;
pub mod math;
pub mod model;
pub mod number;
pub mod plain;
pub mod read;
pub mod text;
pub mod units;
