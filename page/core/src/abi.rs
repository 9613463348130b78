//! The functions that the page calls: texts are passed as address and length in the memory of the module.
#![expect(unsafe_code, reason = "addresses come from the page")]

use std::panic;
use std::sync::Once;

unsafe extern "C" {
    /// Takes the message of a panic, before the module stops.
    fn panicked(message: *const u8, length: usize);
}

/// Space for a request of this length.
#[unsafe(no_mangle)]
extern "C" fn reserve(length: usize) -> *mut u8 {
    Box::into_raw(vec![0_u8; length].into_boxed_slice()).cast()
}

/// Answers the request that was written there, and frees its space. The answer begins with its length, as four bytes; [`release`] frees it.
///
/// # Safety
/// The space is from [`reserve`] of the same length.
#[unsafe(no_mangle)]
unsafe extern "C" fn call(request: *mut u8, length: usize) -> *mut u8 {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        panic::set_hook(Box::new(|panic| {
            let message = panic.to_string();
            // SAFETY: the page reads the message before it returns.
            unsafe { panicked(message.as_ptr(), message.len()) }
        }));
    });
    // SAFETY: by the contract of this function.
    let request = unsafe { Box::from_raw(std::ptr::slice_from_raw_parts_mut(request, length)) };
    let answer = crate::answer(&String::from_utf8_lossy(&request));
    let length = (answer.len() as u32).to_le_bytes();
    let answer = [&length, answer.as_bytes()].concat();
    Box::into_raw(answer.into_boxed_slice()).cast()
}

/// Frees an answer.
///
/// # Safety
/// The answer is from [`call`], and its length is that of its text.
#[unsafe(no_mangle)]
unsafe extern "C" fn release(answer: *mut u8, length: usize) {
    // SAFETY: by the contract of this function.
    drop(unsafe { Box::from_raw(std::ptr::slice_from_raw_parts_mut(answer, length + 4)) });
}
