//! The end of a program that links only if no panic can be reached, and its panic handler.
#![allow(
    unsafe_code,
    reason = "a symbol that does not exist, for the linker to miss"
)]

use cortex_m_semihosting::debug;

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    // SAFETY: never called; a program that could call it does not link.
    unsafe extern "C" {
        safe fn a_panic_is_reachable() -> !;
    }
    a_panic_is_reachable()
}

pub(crate) fn end(succeeded: bool) -> ! {
    let status = if succeeded {
        debug::EXIT_SUCCESS
    } else {
        debug::EXIT_FAILURE
    };
    loop {
        debug::exit(status);
    }
}
