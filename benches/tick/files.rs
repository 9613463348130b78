//! Files of the host by semihosting, in the folder that the emulator runs in.

use cortex_m_semihosting::{nr, syscall};

/// A file name: the kernel's name, an ending, and a zero byte.
fn path(name: &str, ending: &str) -> ([u8; 64], usize) {
    let mut path = [0; 64];
    let bytes = name.bytes().chain(ending.bytes());
    for (to, from) in path.iter_mut().zip(bytes) {
        *to = from;
    }
    (path, name.len() + ending.len())
}

fn open(name: &str, ending: &str, mode: usize) -> Option<usize> {
    let (path, length) = path(name, ending);
    // SAFETY: the path outlives the call and ends with a zero byte.
    let handle = unsafe { syscall!(OPEN, path.as_ptr(), mode, length) };
    (handle != usize::MAX).then_some(handle)
}

fn close(handle: usize) {
    // SAFETY: an open file.
    unsafe { syscall!(CLOSE, handle) };
}

/// Reads `NAME.in` as words; `None` if there is no such file.
pub(crate) fn read<'b>(name: &str, buffer: &'b mut [u32]) -> Option<&'b mut [u32]> {
    let handle = open(name, ".in", nr::open::R_BINARY)?;
    let room = size_of_val(buffer);
    // SAFETY: at most `room` bytes are written, and words may hold any bits.
    let left = unsafe { syscall!(READ, handle, buffer.as_mut_ptr(), room) };
    close(handle);
    buffer.get_mut(..(room - left) / 4)
}

/// Writes `words`, and one more, to `NAME.out`.
pub(crate) fn write(name: &str, words: &[u32], last: u32) {
    let Some(handle) = open(name, ".out", nr::open::RW_TRUNC_BINARY) else {
        return;
    };
    for part in [words, &[last]] {
        // SAFETY: reads within the slice.
        unsafe { syscall!(WRITE, handle, part.as_ptr(), size_of_val(part)) };
    }
    close(handle);
}
