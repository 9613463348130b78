//! The command `jred`: options, files, progress and signals round [`jred_machine`], [`jred_sizing`] and [`jred_report`].

pub mod commands;
pub mod options;
pub mod output;
pub mod rows;
