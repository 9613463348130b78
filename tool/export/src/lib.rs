//! The table for the firmware: the smallest one that meets a torque error, or the best one for its bytes, as an image or as source code.
//!
//! One of the packages behind the command `jred`, on [`jred_file`], which reads machine files, and [`jred_enclosure`], which proves errors. Each module
//! knows those before it; [`Export`] is the result of the search:
//!
//! 1. `choice`, `cost`, `task`: number types, layouts, cores; the request.
//! 2. `directions`, `reference`, `ticks`, `search`, `pieces`: the machine's exact curves, and the sizes that are tried.
//! 3. `export`: the chosen table. `enclose` and `proof`: the machine's curves in intervals, and a bound of the error at every position.
//! 4. `form`: the table as image, Rust, C; `plc`: the tick for a PLC. `cam`, `cia402`: a motion for a PLC or drive.
#![forbid(unsafe_code)]

mod block_test;
mod c_source;
mod cam;
mod candidate;
mod choice;
mod cia402;
mod cost;
mod directions;
mod enclose;
mod export;
mod failure;
mod fault;
mod form;
mod function_block;
mod harmonic;
mod name;
mod pieces;
mod place;
mod plan;
mod plc;
mod plcopen;
mod proof;
mod reference;
mod rust_type;
mod search;
mod slider_crank;
mod structured_text;
mod task;
mod ticks;
mod wide_table;

pub use c_source::plan_c_source;
pub use cam::{Cam, CamForm, CamRow};
pub use candidate::{Candidate, RangeTable, SearchResult};
pub use choice::{Choice, LayoutChoice, LayoutName, Number};
pub use cia402::{ShaftInstant, TorqueOffsets};
pub use cost::Core;
pub use export::{Export, identifier};
pub use failure::{
    AccuracyLimit, Alternative, BestFit, CellsNeeded, CoarseLayout, Failure, Impossible,
    Inaccuracy, LeastError, NoClosedForm, NotReached,
};
pub use form::OutputForm;
pub use function_block::BLOCK_NAMES;
pub use jred_enclosure::{Proof, ProofError};
pub use name::{Name, PlcNames};
pub use place::{CurveName, Feature, WindowEdge};
pub use plan::plan_source;
pub use search::EXHAUSTIVE;
pub use task::Task;
pub use ticks::Ticks;
