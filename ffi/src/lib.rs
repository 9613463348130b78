#![cfg_attr(target_os = "none", no_std)]
//! jred for C and C++: the functions that `include/jred.h` declares, in a static library.
//!
//! `docs/c.md` shows how a program uses them. This is only the boundary: pointers are checked, errors become a status, and the library's own tick is
//! called, with its format and set of curves known at compile time. So there is a family of functions for each format and set; the linker includes
//! those that a program calls.

// The boundary itself: names for the linker, words and memory of the caller. Each `unsafe` block has its reason.
#![allow(unsafe_code, reason = "C calls by names and gives pointers")]

mod axis;
mod encoder;
mod families;
mod follower;
mod image;
mod memory;
mod number;
mod phase;
mod status;
#[cfg(test)]
mod tests;
mod ticks;

/// Never reached, as `scripts/test c` proves: the library does not contain it, because no function here can panic.
#[cfg(target_os = "none")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {
        core::hint::spin_loop();
    }
}

/// Panics, for a gate that must find it.
#[cfg(all(target_os = "none", gate_panic))]
#[unsafe(no_mangle)]
extern "C" fn jred_gate_panic(index: usize) -> u32 {
    [1, 2, 3][index]
}
