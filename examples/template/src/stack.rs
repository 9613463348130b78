//! Measures the used stack: cortex-m-rt paints it before `main`, and words that still have the paint were never used.

/// The paint of cortex-m-rt (its feature `paint-stack`).
const PAINT: u32 = 0xcccc_cccc;

/// Bytes of stack used so far, including interrupts.
pub fn used() -> usize {
    let mut word = cortex_m_rt::heap_start();
    // The stack grows down from the end of the RAM towards the program's variables.
    let now = cortex_m::register::msp::read() as usize;
    while (word as usize) < now {
        // SAFETY: between the end of the program's variables and the stack pointer there is RAM that nothing refers to; an aligned word of it is
        // read.
        if unsafe { word.read_volatile() } != PAINT {
            break;
        }
        word = word.wrapping_add(1);
    }
    // A symbol of the linker script, used only for its address.
    let top = (&raw const _stack_start) as usize;
    top.saturating_sub(word as usize)
}

unsafe extern "C" {
    static _stack_start: u32;
}
