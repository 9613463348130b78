//! Servo sizing for machines whose inertia depends on the angle: the library behind the command `jred`.
//!
//! The way of the data: [`input`] reads a machine file into a [`machine::MachineFile`]; [`duty`] samples one cycle of
//! its motion; [`size`] judges every drive of a [`catalogue`] against it; the rest are the commands and their output.

pub mod bus;
pub mod catalogue;
pub mod check;
pub mod cli;
pub mod columns;
pub mod comma;
pub mod commands;
pub mod contact;
pub mod coordinate;
pub mod cycle;
pub mod drawing;
pub mod duty;
pub mod envelope;
pub mod explain;
pub mod export;
pub mod figures;
pub mod filter;
pub mod form;
pub mod input;
pub mod inspect;
pub mod judge;
pub mod listing;
pub mod machine;
pub mod mechanics;
pub mod meter;
pub mod motion;
pub mod numerics;
pub mod output;
pub mod overload;
pub mod pareto;
pub mod plot;
pub mod rank;
pub mod ratio;
pub mod reduce;
pub mod report;
pub mod rounding;
pub mod rule;
pub mod rules;
pub mod sensitivity;
pub mod simulate;
pub mod site;
pub mod size;
pub mod spline;
pub mod split;
pub mod supply;
pub mod tabulated;
pub mod thermal;
pub mod tolerance;
pub mod units;
pub mod variator;
pub mod vary;
pub mod winding;
pub mod words;
