//! Many machines instead of one: quantities of a machine file varied over ranges, every machine sized over the catalogue.
//!
//! A machine file is changed as a text ([`edit`]) and read by the ordinary reader, so that every check of a machine file
//! applies to every machine of a study; one that is refused is a row with the reason. Rows are computed in parallel and
//! written in order ([`run`]); a study may be cut into shares ([`shard`]) and put together again ([`merge`]), stopped and
//! continued ([`store`]): the file is always that of an undisturbed run, byte by byte.

pub mod axis;
pub mod cell;
pub mod command;
pub mod edit;
pub mod header;
pub mod merge;
pub mod one;
pub mod rows;
pub mod run;
pub mod shard;
pub mod sheet;
pub mod sized;
pub mod store;
pub mod study;
pub mod task;
