//! The tick: from an encoder count to the torque command, in an interrupt that nothing interrupts.

use core::cell::Cell;

use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
use critical_section::CriticalSection;
use jred::axis::{Counter, MotionState, Tracker};

use crate::board::{Board, CLOCK, RATE};
use crate::exchange::{OFFERED, RETURNED, STATUS};
use crate::machine::{BANDWIDTH, ENCODER, EXCHANGE_AT, HOME};
use crate::table::Table;

/// The background's view of the ticks.
pub struct Status {
    pub ticks: Cell<u32>,
    /// Turns of the crank since the start.
    pub turns: Cell<u32>,
    /// Ticks that were not finished when the next one was due.
    pub missed: Cell<u32>,
    /// Clock cycles of the longest tick, and of the latest start of a tick.
    pub longest: Cell<u32>,
    pub latest: Cell<u32>,
    /// With the current table, and with the previous one.
    pub with: Cell<With>,
    pub before: Cell<With>,
}

/// Commands with one table.
#[derive(Clone, Copy)]
pub struct With {
    pub first_tick: u32,
    pub ticks: u32,
    /// Ticks whose motion is outside the validity of the table or beyond its machine units, or whose count has jumped: they command the torque of the
    /// nearest valid motion, so that a weight is still carried.
    pub flagged: u32,
    /// Ticks whose command was cut by the drive's limits.
    pub clipped: u32,
    /// Largest command of the ticks that were not flagged (N·m).
    pub most: f32,
}

impl With {
    const fn from(tick: u32) -> Self {
        Self {
            first_tick: tick,
            ticks: 0,
            flagged: 0,
            clipped: 0,
            most: 0.0,
        }
    }
}

impl Status {
    pub const fn new() -> Self {
        Self {
            ticks: Cell::new(0),
            turns: Cell::new(0),
            missed: Cell::new(0),
            longest: Cell::new(0),
            latest: Cell::new(0),
            with: Cell::new(With::from(0)),
            before: Cell::new(With::from(0)),
        }
    }
}

/// Everything that the interrupt owns.
pub struct Tick {
    table: &'static mut Table,
    board: Board,
    timer: SYST,
    counter: Counter<16>,
    tracker: Tracker,
    /// Distance of the crank from the place of the exchange in this tick; and whether tables may be exchanged at its end.
    way: i32,
    may_exchange: bool,
    /// Whether the last tick was not finished when this one was due.
    missed: bool,
    ticks: u32,
    with: With,
}

impl Tick {
    /// A tick with a checked table.
    pub fn new(table: &'static mut Table, mut board: Board, timer: SYST) -> Option<Self> {
        // The register has 16 bits: the machine is assumed to be where it shows the count nearest to HOME.
        let mut counter = Counter::at(HOME);
        let count = counter.extend(board.count().into());
        // Start at the machine's position, otherwise the filter would start with a jump of the speed.
        let phase = ENCODER.phase_wide(count);
        let tracker = Tracker::with_bandwidth(BANDWIDTH, 1.0 / RATE as f32)
            .ok()?
            .with_largest_step(table.units?.step)
            .at(phase);
        Some(Self {
            table,
            board,
            timer,
            counter,
            tracker,
            way: (phase - EXCHANGE_AT).to_bits().cast_signed(),
            may_exchange: false,
            missed: false,
            ticks: 0,
            with: With::from(0),
        })
    }

    /// Starts the timer.
    pub fn start(&mut self) {
        self.timer.set_clock_source(SystClkSource::Core);
        self.timer.set_reload(CLOCK / RATE - 1);
        self.timer.clear_current();
        self.timer.enable_interrupt();
        self.timer.enable_counter();
    }

    /// One tick. A separate function, so that its instructions and its stack can be measured (`cargo xtask template` of jred does).
    #[inline(never)]
    pub fn run(&mut self) {
        let reload = SYST::get_reload();
        let late = reload - SYST::get_current();
        self.timer.has_wrapped(); // forgets what caused this tick

        let passes = self.command();
        critical_section::with(|cs| {
            let status = STATUS.borrow(cs);
            status.ticks.set(self.ticks);
            status.turns.set(status.turns.get() + u32::from(passes));
            status.with.set(self.with);
            if self.may_exchange {
                self.exchange(cs);
            }
            let taken = (reload - SYST::get_current()).saturating_sub(late);
            // The tick after one that took too long begins late because of it.
            let after_missed = core::mem::replace(&mut self.missed, self.timer.has_wrapped());
            if self.missed {
                status.missed.set(status.missed.get() + 1);
            } else if !after_missed {
                status.latest.set(status.latest.get().max(late));
                status.longest.set(status.longest.get().max(taken));
            }
        });
    }

    /// Sends the command to the drive; returns whether the crank has passed the place of the exchange.
    fn command(&mut self) -> bool {
        let count = self.counter.extend(self.board.count().into());
        let measured = self.tracker.update(ENCODER.phase_wide(count));
        let wanted = self.board.wanted();
        self.ticks += 1;
        self.with.ticks += 1;
        let way = (measured.phase - EXCHANGE_AT).to_bits().cast_signed();
        // From just before the place to just after it, but not half a turn away from it, where the sign changes, too.
        let passes = self.way < 0 && way >= 0 && way.wrapping_sub(self.way) >= 0;
        self.way = way;
        self.may_exchange = passes || wanted.speed == 0 && wanted.acceleration == 0;

        let (Some(press), Some(units)) = (self.table.slot.feed_forward(), &self.table.units) else {
            self.board.command(0.0);
            return passes; // cannot occur: the tick only gets checked tables
        };
        let alpha = units.tick.alpha(wanted);
        let reference = MotionState {
            phase: wanted.phase,
            omega: units.tick.omega(wanted).value,
            alpha: alpha.value,
        };
        // Position of the machine when the torque acts; friction by the sign of the set-point.
        let omega = units.tick.omega(measured);
        let later = units.lead.later(MotionState {
            phase: measured.phase,
            omega: omega.value,
            alpha: reference.alpha,
        });
        let friction = units.ramp.at(reference.omega);
        let state = later.value;
        let needed = press.at_measured(state.phase, state.omega, reference, friction);
        let motor = units
            .gearbox
            .motor(needed.torque, reference.omega, reference.alpha);
        let limited = units.limits.limited(motor.value);
        // In fixed point a number out of range is limited and flagged.
        let beyond = omega.saturated || alpha.saturated || later.saturated || motor.saturated;
        let jumped = measured.jumped || wanted.jumped;
        let valid = needed.status.is_valid() && !beyond && !jumped;
        let with = &mut self.with;
        // A flagged motion is limited to the table's validity, never dropped to 0: a vertical axis must not fall.
        let torque = units.gearbox.torque_si(limited.torque);
        with.flagged += u32::from(!valid);
        with.clipped += u32::from(limited.clipped != Default::default());
        if valid {
            with.most = with.most.max(torque);
        }
        self.board.command(torque);
        passes
    }

    /// Takes the table offered by the background, where the machine passes the place for it or is to be at rest, and returns the previous one. Two
    /// references change their owners: the next tick computes with one or the other, never with parts of both.
    fn exchange(&mut self, cs: CriticalSection<'_>) {
        if let Some(next) = OFFERED.borrow(cs).take() {
            if let Some(units) = next.units {
                self.tracker = self.tracker.with_largest_step(units.step);
            }
            let last = core::mem::replace(&mut self.table, next);
            RETURNED.borrow(cs).set(Some(last));
            STATUS.borrow(cs).before.set(self.with);
            self.with = With::from(self.ticks);
        }
    }
}
