//! Analysis of a machine and its motion, without any drive.
//!
//! One of the packages behind the command `jred`, between [`jred_file`], which reads machine files, and `jred-sizing`, which knows drives. Results
//! are data; nothing is printed. Each module knows those before it:
//!
//! 1. [`duty`]: the load that one cycle of the motion puts on the drive.
//! 2. [`contact`]: followers that lift off, ropes that go slack.
//! 3. [`reduce`]: the reduced link, points, joint forces and energies, position by position.
//! 4. [`warnings`] and [`inspect`]: what is legal but unlikely, and the check of the mechanism.
//! 5. [`simulate`] and [`steady`]: the motion under given torques, and its steady state.
//! 6. [`identify`]: the machine's curves from a log of a drive.
//! 7. [`checked`]: a text in, a machine file out whose mechanics are checked.
#![forbid(unsafe_code)]

pub mod check;
pub mod checked;
pub mod contact;
pub mod duty;
pub mod identify;
pub mod inspect;
pub mod reduce;
pub mod simulate;
pub mod steady;
pub mod warnings;
