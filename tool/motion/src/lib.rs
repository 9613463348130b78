//! Motions made for a machine and its drive.
//!
//! Between `jred-sizing`, which knows what a drive can do, and `jred-report`. `jred-machine` says what a *given* motion asks of
//! the drive; here the motion itself is what is sought. Results are data; nothing is printed.
//!
//! 1. [`way`]: the machine and its drive along the way, all quantities counted in the direction of the motion;
//! 2. [`moves`]: what a prescribed motion is made of, moves and pauses;
//! 3. [`fastest`]: minimum time;
//! 4. [`trace`]: a motion that was made, and the files that it becomes;
//! 5. [`plan`]: the same as the table that firmware follows;
//! 6. [`gentlest`]: least RMS torque, energy or peak in a given time;
//! 7. [`retime`]: the moves of a machine file in the gentlest way, beside the motion laws;
//! 8. [`suited`]: drives, each with the motion that is the gentlest for it;
//! 9. [`balance`]: counterweights and springs that relieve the drive;
//! 10. [`driven`]: the free motion under a drive.
#![forbid(unsafe_code)]

pub mod balance;
mod collocation;
pub mod contact;
pub mod driven;
pub mod fastest;
pub mod gentlest;
mod memo;
pub mod moves;
pub mod plan;
pub mod retime;
mod skyline;
pub mod suited;
pub mod trace;
pub mod way;
