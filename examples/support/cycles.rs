//! The cycle counter of a Cortex-M; the host has none.

/// A counter that counts cycles.
pub(crate) struct Counter {
    read: fn() -> u32,
    /// Mask of its bits.
    mask: u32,
}

impl Counter {
    pub(crate) fn now(&self) -> u32 {
        (self.read)()
    }

    /// Cycles since `start`.
    pub(crate) fn since(&self, start: u32) -> u32 {
        self.now().wrapping_sub(start) & self.mask
    }

    /// Starts the counter of this core; `None` if there is no cycle counter.
    #[cfg(not(target_os = "none"))]
    pub(crate) fn start() -> Option<Self> {
        None
    }

    /// Starts the counter of this core; `None` if there is no cycle counter.
    ///
    /// In QEMU CYCCNT reads 0, and SysTick follows the wall clock.
    #[cfg(target_os = "none")]
    pub(crate) fn start() -> Option<Self> {
        /// SysTick has 24 bits and counts down.
        const SYSTICK: u32 = 0x00ff_ffff;
        let mut core = cortex_m::Peripherals::take()?;
        #[cfg(not(short_multiply))]
        {
            use cortex_m::peripheral::DWT;
            core.DCB.enable_trace();
            // Some parts with an M7 lock it.
            DWT::unlock();
            core.DWT.enable_cycle_counter();
            let counter = Self {
                read: DWT::cycle_count,
                mask: u32::MAX,
            };
            if counter.counts_cycles() {
                return Some(counter);
            }
        }
        core.SYST
            .set_clock_source(cortex_m::peripheral::syst::SystClkSource::Core);
        core.SYST.set_reload(SYSTICK);
        core.SYST.clear_current();
        core.SYST.enable_counter();
        let counter = Self {
            read: || SYSTICK - cortex_m::peripheral::SYST::get_current(),
            mask: SYSTICK,
        };
        counter.counts_cycles().then_some(counter)
    }

    /// Whether a delay of known length takes a plausible number of cycles. A core may run it faster than specified, but not in a quarter of the
    /// cycles; a wall clock shows less than that in one of several runs, because an emulator is faster than the core.
    #[cfg(target_os = "none")]
    fn counts_cycles(&self) -> bool {
        const DELAY: u32 = 100_000;
        let delayed = || {
            let start = self.now();
            cortex_m::asm::delay(DELAY);
            self.since(start)
        };
        (0..8).all(|_| delayed() >= DELAY / 4)
    }
}
