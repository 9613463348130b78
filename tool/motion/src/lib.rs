//! Motion synthesis for a machine and its drive.
//!
//! This crate lies between `jred-sizing`, which computes what a drive can do, and `jred-report`. `jred-analysis` computes the duty of a *given*
//! motion; here the motion itself is the unknown. Results are data; nothing is printed.
//!
//! 1. [`path_dynamics`]: the machine and its drive along the path, all quantities counted in the direction of the motion;
//! 2. [`moves`]: the parts of a prescribed motion, moves and pauses;
//! 3. [`fastest`]: minimum time;
//! 4. [`trace`]: a finished motion, and its export formats;
//! 5. [`plan`]: the same as the table that firmware follows;
//! 6. [`gentlest`]: least RMS torque, energy or peak in a given time;
//! 7. [`co_design`]: drives, each with its own gentlest motion;
//! 8. [`balance`]: counterweights and springs that relieve the drive;
//! 9. [`drive_simulation`]: the free motion under a drive.
#![forbid(unsafe_code)]

pub mod balance;
pub mod co_design;
mod collocation;
pub mod contact;
pub mod drive_simulation;
pub mod fastest;
pub mod gentlest;
mod memo;
pub mod moves;
pub mod path_dynamics;
pub mod plan;
mod skyline;
pub mod trace;
