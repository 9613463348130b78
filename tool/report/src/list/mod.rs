//! The answers of the commands, for reading, as CSV and as JSON.

pub mod alternatives;
pub mod balance;
pub mod bus_json;
pub mod bus_text;
pub mod contact;
mod driven;
pub mod fastest;
pub mod front;
pub mod inspection;
pub mod kept;
pub mod listing;
mod marks;
pub mod plan;
pub mod ratio;
pub mod retime;
pub mod rule_list;
pub mod sensitivity;
pub mod simulation;
pub mod steady;
pub mod suited;
pub mod tolerance;
