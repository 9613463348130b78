//! The answers of the commands, for reading, as CSV and as JSON.

pub mod balance;
pub mod bus;
pub mod catalogue;
pub mod contact;
mod driven;
pub mod export;
pub mod fastest;
pub mod front;
pub mod gentlest;
pub mod inspection;
pub mod kept;
pub mod listing;
mod marks;
pub mod plan;
pub mod ratio;
pub mod reduction;
pub mod require;
pub mod rule_list;
pub mod rule_words;
pub mod sensitivity;
pub mod simulation;
pub mod split;
pub mod steady;
pub mod suited;
pub mod tolerance;
