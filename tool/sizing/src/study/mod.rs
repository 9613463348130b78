//! Studies of many machines: quantities of a machine file are varied over ranges, and every machine is sized with the catalogue.
//!
//! A machine file is changed as text ([`edit`]) and read by the ordinary reader, so that every check applies to every machine of a study. A refused
//! machine is a row with the reason. Rows are computed in parallel and written in order. A study may be cut into shares ([`shard`]), or
//! stopped and continued: the file always equals that of an undisturbed run, byte for byte.

pub mod axis;
pub mod chosen;
pub mod common;
mod edge;
pub mod edit;
pub mod grid;
pub mod header;
pub mod ratio;
pub mod sensitivity;
pub mod shard;
pub mod task;
pub mod tolerance;
