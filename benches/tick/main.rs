//! The on-target half of `cargo xtask perf`: calls every kernel at the points prepared by the host.
//!
//! A kernel is a function that is not inlined, with its own symbol, so that the host finds its calls in a trace of the emulator. Each has a file
//! `NAME.in`: two numbers of words, the data (model, table), the points. The results go to `NAME.out`; a kernel without a file is skipped. Data and
//! arguments come from outside the program, so that the compiler knows as little about them as in firmware, and only the kernels compute.
//!
//! To add a kernel: a function and a line in `KERNELS` of one of the modules here, and a line in `xtask/src/kernels.rs`.
#![cfg_attr(target_os = "none", no_std, no_main)]
#![allow(
    unsafe_code,
    reason = "kernels by their names for the linker, C beside them, files of the host"
)]

#[cfg(target_os = "none")]
mod analytic;
#[cfg(target_os = "none")]
mod files;
#[cfg(target_os = "none")]
mod hand;
#[cfg(target_os = "none")]
mod library;
#[cfg(all(target_os = "none", tick_peers))]
mod peers;

#[cfg(not(target_os = "none"))]
fn main() {
    println!("tick runs on a Cortex-M in QEMU: cargo xtask perf");
}

#[cfg(target_os = "none")]
mod target {
    use cortex_m::peripheral::SYST;
    use cortex_m::peripheral::syst::SystClkSource;
    use cortex_m::singleton;
    use cortex_m_rt::entry;
    use cortex_m_semihosting::{debug, hprintln};
    use panic_semihosting as _;

    use crate::files;

    /// Three arguments: angle, speed, and acceleration or torque. The result replaces the first.
    pub(crate) type Point = [u32; 3];

    /// A kernel's name, and the function that calls it with its data at every point.
    pub(crate) type Kernel = (&'static str, fn(&[u32], &mut [Point]));

    /// Replaces every point by the result of `call`.
    pub(crate) fn each(points: &mut [Point], mut call: impl FnMut(Point) -> u32) {
        for point in points {
            point[0] = call(*point);
        }
    }

    const LISTS: &[&[Kernel]] = &[
        crate::library::KERNELS,
        crate::library::AXES,
        crate::hand::KERNELS,
        crate::analytic::KERNELS,
        #[cfg(tick_peers)]
        crate::peers::KERNELS,
    ];

    /// Words of the largest file: the microbit has 16 KiB of RAM.
    const WORDS: usize = 2700;

    #[entry]
    fn main() -> ! {
        let buffer: &mut [u32] = singleton!(: [u32; WORDS] = [0; WORDS]).expect("taken once");
        let mut clock = cortex_m::Peripherals::take().expect("taken once").SYST;
        clock.set_clock_source(SystClkSource::Core);
        clock.set_reload(RELOAD);
        clock.clear_current();
        clock.enable_counter();
        let mut status = debug::EXIT_SUCCESS;
        for (name, run) in LISTS.iter().copied().flatten() {
            let Some(words) = files::read(name, buffer) else {
                continue;
            };
            let Some((data, points)) = parts(words) else {
                hprintln!("{}.in is not a file of data and points", name);
                status = debug::EXIT_FAILURE;
                continue;
            };
            let start = tick_clock();
            run(data, points);
            let ticks = start.wrapping_sub(tick_clock()) & RELOAD;
            files::write(name, points.as_flattened(), ticks);
        }
        loop {
            debug::exit(status);
        }
    }

    /// Start value of SysTick, which counts down.
    const RELOAD: u32 = 0x00ff_ffff;

    /// Reads SysTick. The host finds its calls in the trace: between two of them lie as many instructions as the clock counts at 1 ns each.
    #[unsafe(no_mangle)]
    #[inline(never)]
    extern "Rust" fn tick_clock() -> u32 {
        SYST::get_current()
    }

    /// Data and points of a file.
    fn parts(words: &mut [u32]) -> Option<(&[u32], &mut [Point])> {
        let ([data, points], rest) = words.split_first_chunk_mut()?;
        let (data, rest) = rest.split_at_mut_checked(*data as usize)?;
        let (places, []) = rest.as_chunks_mut() else {
            return None;
        };
        (places.len() == *points as usize).then_some((data, places))
    }
}
