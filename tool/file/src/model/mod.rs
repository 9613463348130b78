//! A machine as described by a machine file, in SI units, with the requirements for its drive.

pub mod axis;
pub mod by_motion;
pub mod carriage;
pub mod characteristic;
pub mod coordinate;
pub mod drive_train;
pub mod machine;
pub mod mechanism;
pub mod motion;
pub mod motor;
pub mod operation;
pub mod repeats;
pub mod rule;
pub mod rules;
pub mod schedule;
pub mod simulation;
pub mod site;
mod stroke;
pub mod supply;
pub mod surroundings;
pub mod tolerance;
pub mod variator;
pub mod virtual_link;
pub(crate) mod winder;
pub mod with_mass;
mod working;
