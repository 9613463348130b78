//! A firmware to start from: feed-forward from an encoder count in an interrupt, and a table that is exchanged while the machine runs.
//!
//! | file | content |
//! |---|---|
//! | `machine.rs` | your machine and its drive: change this first |
//! | `board/` | clock, encoder and command of each board; QEMU's simulate a machine |
//! | `tick.rs` | the interrupt |
//! | `table.rs` | a table and the drive's figures in its units |
//! | `exchange.rs` | data exchanged between interrupt and background |
//! | `link.rs` | a stand-in for a link that brings new tables |
#![no_std]
#![no_main]
#![cfg_attr(not(feature = "stack"), forbid(unsafe_code))]

mod board;
mod exchange;
mod link;
mod machine;
#[cfg(feature = "stack")]
mod stack;
mod table;
mod tick;

use cortex_m::Peripherals;
use cortex_m_rt::{entry, exception};
use jred::FirmwareError;

use board::{Board, CLOCK, RATE, TRANSFERS, say};
use exchange::{START, exchange, status};
use link::Transfer;
use machine::{TABLE, WORDS};
use table::Table;
use tick::{Tick, With};

/// Words added to the CRC in one step of the background.
const SLICE: usize = 16;

#[entry]
fn main() -> ! {
    // cortex-m-rt makes these `&'static mut`: two tables and their memory.
    static mut MEMORY: [[u32; WORDS]; 2] = [[0; WORDS]; 2];
    static mut TABLES: [Option<Table>; 2] = [None, None];

    let ([memory, other], [table, spare]) = (MEMORY, TABLES);
    let (table, mut spare) = (
        table.insert(Table::new(memory)),
        spare.insert(Table::new(other)),
    );
    // The first table is loaded like all others, but nothing ticks yet.
    let first = Transfer {
        turn: 0,
        image: TABLE,
        damaged: None,
    };
    if let Err(refused) = load(table, &first) {
        say!("the first table is refused: {}", refused);
        stop();
    }
    start(table);
    for transfer in TRANSFERS {
        wait_for(|| status(|all| all.turns.get()) >= transfer.turn);
        spare = renew(spare, transfer);
    }
    wait_for(|| board::finish(status(|all| all.ticks.get())));
    // Read together, so that all belong to the same tick.
    let (with, missed) = status(|all| (all.with.get(), all.missed.get()));
    let (longest, latest) = status(|all| (all.longest.get(), all.latest.get()));
    report(&with);
    say!("{} ticks, {} missed", with.first_tick + with.ticks, missed);
    say!(
        "time: {} of {} cycles in the longest tick, {} late at most",
        longest,
        CLOCK / RATE,
        latest
    );
    #[cfg(feature = "stack")]
    say!("stack: {} bytes", stack::used());
    stop();
}

/// Makes the interrupt the owner of table, board and timer, and starts it.
fn start(table: &'static mut Table) {
    let Some(core) = Peripherals::take() else {
        return;
    };
    // By default an exception has the highest priority: nothing interrupts a tick. Give other interrupts lower priorities.
    let Some(mut tick) = Tick::new(table, Board::start(), core.SYST) else {
        return;
    };
    critical_section::with(|cs| {
        tick.start();
        START.borrow(cs).set(Some(tick));
    });
}

#[exception]
fn SysTick() {
    static mut TICK: Option<Tick> = None;
    match TICK {
        Some(tick) => tick.run(),
        None => *TICK = critical_section::with(|cs| START.borrow(cs).take()),
    }
}

/// Receives an image and checks it, in the background: the tick interrupts every step.
fn load(table: &mut Table, transfer: &Transfer) -> Result<(), FirmwareError> {
    table.clear();
    transfer.pieces(|piece| table.slot.receive(piece))?;
    loop {
        if let Some(verdict) = table.check(SLICE) {
            return verdict;
        }
    }
}

/// A new table for the tick; returns the memory that the tick does not use.
fn renew(spare: &'static mut Table, transfer: &Transfer) -> &'static mut Table {
    let ticks = || status(|all| all.ticks.get());
    let begin = ticks();
    if let Err(refused) = load(spare, transfer) {
        say!(
            "turn {}: refused, the tick keeps its table: {}",
            transfer.turn,
            refused
        );
        return spare;
    }
    say!("time: {} ticks to receive and check it", ticks() - begin);
    let other = exchange(spare);
    let before = status(|all| all.before.get());
    report(&before);
    say!(
        "turn {}: a new table, from tick {} on",
        transfer.turn,
        before.first_tick + before.ticks
    );
    other
}

fn report(with: &With) {
    say!(
        "{} ticks with this table: at most {} mN m, {} flagged, {} clipped",
        with.ticks,
        (with.most * 1000.0) as i32,
        with.flagged,
        with.clipped
    );
}

/// The background: everything else that the firmware does.
fn wait_for(condition: impl Fn() -> bool) {
    while !condition() {
        cortex_m::asm::wfi(); // until the next interrupt
    }
}

fn stop() -> ! {
    board::end();
    loop {
        cortex_m::asm::wfi();
    }
}
