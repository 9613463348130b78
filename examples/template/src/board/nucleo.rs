//! Two of ST's Nucleo-64 boards: F446RE (Cortex-M4F) and G071RB (Cortex-M0+). **Compiled in the tests of jred, but never run on a board.**
//!
//! The encoder's channels A and B are on PA0 and PA1, counted by TIM2 in hardware on both edges of both channels; the command is a voltage on PA4, 0
//! to 3.3 V for −12 to 12 N·m. The core runs at 16 MHz, as after reset: set the PLL here for more ticks per second. Sources: reference manuals RM0390
//! and RM0444 (RCC, GPIO, TIM2 encoder mode, DAC), data sheets DS10693 and DS12232 (alternate functions).

use jred::Phase;
use jred::axis::TrackerOutput;
use panic_halt as _;
use stm32_metapac::gpio::vals::Moder;
use stm32_metapac::timer::vals::{CcmrInputCcs, Sms};
use stm32_metapac::{DAC1, GPIOA, RCC, TIM2};

use crate::link::Transfer;
use crate::machine::MOST_TORQUE;

/// Clock cycles per second: the oscillator after reset.
pub const CLOCK: u32 = 16_000_000;
/// Ticks per second.
#[cfg(feature = "nucleo-f446re")]
pub const RATE: u32 = 10_000;
#[cfg(feature = "nucleo-g071rb")]
pub const RATE: u32 = 4000;

/// Your own link brings new tables: call `renew` in `main.rs` with each one.
pub const TRANSFERS: &[Transfer] = &[];

/// Alternate function of PA0 and PA1 for TIM2.
#[cfg(feature = "nucleo-f446re")]
const TIMER_FUNCTION: u8 = 1;
#[cfg(feature = "nucleo-g071rb")]
const TIMER_FUNCTION: u8 = 2;

pub struct Board(());

impl Board {
    pub fn start() -> Self {
        clocks();
        for pin in [0, 1] {
            GPIOA.afr(0).modify(|w| w.set_afr(pin, TIMER_FUNCTION));
            GPIOA.moder().modify(|w| w.set_moder(pin, Moder::ALTERNATE));
        }
        TIM2.ccmr_input(0).modify(|w| {
            w.set_ccs(0, CcmrInputCcs::TI4); // "its own input", as TI1 for channel 1
            w.set_ccs(1, CcmrInputCcs::TI4);
        });
        TIM2.smcr().modify(|w| w.set_sms(Sms::ENCODER_MODE_3));
        TIM2.cr1().modify(|w| w.set_cen(true));

        GPIOA.moder().modify(|w| w.set_moder(4, Moder::ANALOG));
        let mut board = Self(());
        board.command(0.0);
        DAC1.cr().modify(|w| w.set_en(0, true));
        board
    }

    /// The encoder's timer: the lower half of its 32 bits, because most timers have only 16.
    pub fn count(&mut self) -> u16 {
        TIM2.cnt().read() as u16
    }

    /// The set-point of this tick. Here the machine is to rest at φ = 0: replace it by your planned motion, in rad, rad/s and rad/s².
    pub fn wanted(&mut self) -> TrackerOutput {
        set_point(Phase::from_radians_f32(0.0), 0.0, 0.0)
    }

    /// The drive's torque command (N·m).
    pub fn command(&mut self, torque: f32) {
        let share = 0.5 + 0.5 * torque / MOST_TORQUE;
        DAC1.dhr12r(0).write(|w| w.set_dhr((share * 4095.0) as u16));
    }
}

/// A set-point in SI units (rad/s, rad/s²), converted to the tick's units. NaN is marked as a jump, so that its tick is flagged.
fn set_point(phase: Phase, omega: f32, alpha: f32) -> TrackerOutput {
    const SPEED: f32 = 4_294_967_296.0 / core::f32::consts::TAU / RATE as f32;
    const ACCELERATION: f32 = SPEED * 256.0 / RATE as f32;
    TrackerOutput {
        phase,
        speed: (omega * SPEED) as i32,
        acceleration: (alpha * ACCELERATION) as i32,
        residual: 0,
        jumped: !(omega.is_finite() && alpha.is_finite()),
    }
}

#[cfg(feature = "nucleo-f446re")]
fn clocks() {
    RCC.ahb1enr().modify(|w| w.set_gpioaen(true));
    RCC.apb1enr().modify(|w| {
        w.set_tim2en(true);
        w.set_dacen(true);
    });
}

#[cfg(feature = "nucleo-g071rb")]
fn clocks() {
    RCC.gpioenr().modify(|w| w.set_gpioaen(true));
    RCC.apbenr1().modify(|w| {
        w.set_tim2en(true);
        w.set_dac1en(true);
    });
}

/// Firmware does not end.
pub fn finish(_: u32) -> bool {
    false
}

pub fn end() {}

/// No output: without a debugger semihosting would stop the core. Use a serial line or `defmt-rtt` here.
macro_rules! say {
    ($($word:tt)*) => { let _ = core::format_args!($($word)*); };
}
pub(crate) use say;
