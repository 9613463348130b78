//! The boards that QEMU emulates: a simulated machine follows its set-point, and its encoder timer shows the matching counts.
//!
//! Only this file knows that the machine is simulated. The tick reads a 16-bit register that overflows; once it reads nonsense, and once it takes too
//! long.

use cortex_m_semihosting::debug;
pub use cortex_m_semihosting::hprintln as say;
use jred::Phase;
use jred::axis::{Counting, TrackerOutput};
use panic_semihosting as _;

use crate::link::Transfer;
use crate::machine::{COUNTING, COUNTS_PER_TURN, GEAR, HOME, TABLE};

/// Clock cycles per second, of mps2-an386 and microbit.
#[cfg(feature = "qemu-m4f")]
pub const CLOCK: u32 = 25_000_000;
#[cfg(feature = "qemu-m0")]
pub const CLOCK: u32 = 16_000_000;
/// Ticks per second.
#[cfg(feature = "qemu-m4f")]
pub const RATE: u32 = 10_000;
#[cfg(feature = "qemu-m0")]
pub const RATE: u32 = 5000;

/// The same press with a heavier die, as an image unknown at compile time.
#[cfg(not(fixed_point))]
static HEAVY_DIE: &[u8] = include_bytes!("../../tables/heavy_die_f32.jred");
#[cfg(fixed_point)]
static HEAVY_DIE: &[u8] = include_bytes!("../../tables/heavy_die_q31.jred");

/// The new table; the same one damaged; and the first one again, into its old memory.
pub const TRANSFERS: &[Transfer] = &[
    Transfer {
        turn: 2,
        image: HEAVY_DIE,
        damaged: None,
    },
    Transfer {
        turn: 4,
        image: HEAVY_DIE,
        damaged: Some(500),
    },
    Transfer {
        turn: 6,
        image: TABLE,
        damaged: None,
    },
];

/// From rest at φ = 0 to 10 rad/s at 100 rad/s², for 6 s: units of 2⁻⁴⁰ turns, per tick and per tick squared.
const ACCELERATION: i64 =
    (100.0 / core::f64::consts::TAU / (RATE as f64 * RATE as f64) * ONE) as i64;
const SPEED: i64 = (10.0 / core::f64::consts::TAU / RATE as f64 * ONE) as i64;
const ONE: f64 = (1u64 << 40) as f64;
/// Counts per turn of the crank.
const COUNTS: i64 = COUNTS_PER_TURN as i64 * GEAR[0] as i64 / GEAR[1] as i64;
const TICKS: u32 = 6 * RATE;
/// In this tick the register reads nonsense.
const WILD: u32 = 3 * RATE;
/// This tick takes too long, to check that it is counted.
const LONG: u32 = 5 * RATE;
/// A delay of about twice as many cycles in QEMU: enough for the next tick to be due, and for that one to finish in time.
#[cfg(feature = "qemu-m4f")]
const DELAY: u32 = 1600;
#[cfg(feature = "qemu-m0")]
const DELAY: u32 = 700;

pub struct Board {
    tick: u32,
    /// Position of the crank.
    place: i64,
    speed: i64,
    /// The command, which would go to the drive from here (N·m).
    torque: f32,
}

impl Board {
    pub fn start() -> Self {
        Self {
            tick: 0,
            place: 0,
            speed: 0,
            torque: 0.0,
        }
    }

    /// The encoder's timer.
    pub fn count(&mut self) -> u16 {
        if self.tick == LONG {
            cortex_m::asm::delay(DELAY);
        }
        if self.tick == WILD {
            return 0x5555;
        }
        // Counts of the whole turns and of the rest, so that nothing overflows.
        let (turns, rest) = (self.place >> 40, self.place & ((1 << 40) - 1));
        let moved = turns * COUNTS + (((rest >> 16) * COUNTS) >> 24);
        match COUNTING {
            Counting::Up => (HOME + moved) as u16,
            Counting::Down => (HOME - moved) as u16,
        }
    }

    /// The set-point of this tick, with the tick as unit of time.
    pub fn wanted(&mut self) -> TrackerOutput {
        let acceleration = ACCELERATION.min(SPEED - self.speed);
        let now = TrackerOutput {
            phase: Phase::from_bits((self.place >> 8) as u32),
            speed: (self.speed >> 8) as i32,
            acceleration: acceleration as i32,
            ..TrackerOutput::default()
        };
        // The machine at the next tick.
        self.tick += 1;
        self.place += self.speed + acceleration / 2;
        self.speed += acceleration;
        now
    }

    /// The drive's torque command (N·m).
    pub fn command(&mut self, torque: f32) {
        self.torque = core::hint::black_box(torque);
    }
}

/// Whether the program is to end, which firmware never does.
pub fn finish(ticks: u32) -> bool {
    ticks >= TICKS
}

/// Ends QEMU.
pub fn end() {
    debug::exit(debug::EXIT_SUCCESS);
}
