//! The differences between boards: clock, encoder timer, output of the command.
//!
//! Your own board is a file like `nucleo.rs`, a memory map in `boards/` and its name in `build.rs` and `Cargo.toml`.

#[cfg(feature = "nucleo")]
mod nucleo;
#[cfg(feature = "qemu")]
mod qemu;

#[cfg(feature = "nucleo")]
pub(crate) use nucleo::{Board, CLOCK, RATE, TRANSFERS, end, finish, say};
#[cfg(feature = "qemu")]
pub(crate) use qemu::{Board, CLOCK, RATE, TRANSFERS, end, finish, say};
