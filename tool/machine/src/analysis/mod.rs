//! Analysis of a machine and its motion, without any drive.

pub mod contact;
pub mod duty;
pub mod inspect;
pub mod mechanics;
pub mod reduce;
pub mod repeats;
pub mod simulate;
pub mod steady;
pub mod warnings;
