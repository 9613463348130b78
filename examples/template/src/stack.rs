//! How much stack was used: cortex-m-rt has painted it before `main`, and what still has the paint was never used.

/// What cortex-m-rt paints with (its feature `paint-stack`).
const PAINT: u32 = 0xcccc_cccc;

/// Bytes of stack that were used so far, those of interrupts included.
pub fn used() -> usize {
    let mut word = cortex_m_rt::heap_start();
    // The stack grows down from the end of the RAM towards the end of what is in it.
    let now = cortex_m::register::msp::read() as usize;
    while (word as usize) < now {
        // SAFETY: between the end of the program's variables and the stack pointer there is RAM that nothing refers to; an aligned word of it is read.
        if unsafe { word.read_volatile() } != PAINT {
            break;
        }
        word = word.wrapping_add(1);
    }
    // A symbol of the linker script, of which only the address is taken.
    let top = (&raw const _stack_start) as usize;
    top.saturating_sub(word as usize)
}

unsafe extern "C" {
    static _stack_start: u32;
}
