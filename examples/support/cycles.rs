//! The cycle counter of a Cortex-M; on the host there is none.

/// A counter that counts.
pub(crate) struct Counter {
    #[cfg(target_os = "none")]
    source: Source,
}

/// Where cycles are counted.
#[cfg(target_os = "none")]
enum Source {
    /// CYCCNT: 32 bits, upwards.
    Dwt,
    /// SysTick: 24 bits, downwards.
    SysTick,
}

#[cfg(not(target_os = "none"))]
impl Counter {
    pub(crate) fn start() -> Option<Self> {
        None
    }

    pub(crate) fn now(&self) -> u32 {
        0
    }

    pub(crate) fn since(&self, start: u32) -> u32 {
        start
    }
}

#[cfg(target_os = "none")]
impl Counter {
    /// SysTick has so many bits.
    const BITS_24: u32 = 0x00ff_ffff;

    /// Starts the counter of this core; `None` if it does not count cycles, as in QEMU.
    pub(crate) fn start() -> Option<Self> {
        use cortex_m::peripheral::syst::SystClkSource;
        let mut core = cortex_m::Peripherals::take()?;
        #[cfg(has_cycle_counter)]
        {
            use cortex_m::peripheral::DWT;
            core.DCB.enable_trace();
            // The M7 and M33 of some makers lock it.
            DWT::unlock();
            core.DWT.enable_cycle_counter();
        }
        core.SYST.set_clock_source(SystClkSource::Core);
        core.SYST.set_reload(Self::BITS_24);
        core.SYST.clear_current();
        core.SYST.enable_counter();
        todo!()
    }
}
