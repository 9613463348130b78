//! Where the compiler may not move reads.

/// A compiler fence on Arm's cores, nothing elsewhere. No instruction; no value depends on it.
///
/// They compute a tick with 7 to 13 registers, and the compiler reads ahead whatever it can. A fence keeps reads behind it, and ways apart
/// that the compiler would make one; where each of them stands it saves 2 to 14 instructions of a tick.
#[inline(always)]
pub(crate) fn fence() {
    #[cfg(target_arch = "arm")]
    core::sync::atomic::compiler_fence(core::sync::atomic::Ordering::SeqCst);
}
