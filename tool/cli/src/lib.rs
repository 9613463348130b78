//! The command `jred`: options, files, progress and signals for [`jred_file`], [`jred_sizing`], [`jred_motion`] and [`jred_report`].
#![forbid(unsafe_code)]

pub mod browser;
pub mod busy;
pub mod commands;
pub mod embedded;
pub mod options;
pub mod output;
pub mod rows;
pub mod terminal;
