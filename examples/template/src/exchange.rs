//! Data exchanged between interrupt and background. The owner gives a thing away and the other takes it: both never see the same thing.

use core::cell::Cell;

use critical_section::Mutex;

use crate::table::Table;
use crate::tick::{Status, Tick};

/// For the interrupt, before its first tick.
pub static START: Mutex<Cell<Option<Tick>>> = Mutex::new(Cell::new(None));
/// A checked table, for the interrupt; and its previous one, for the background.
pub static OFFERED: Mutex<Cell<Option<&'static mut Table>>> = Mutex::new(Cell::new(None));
pub static RETURNED: Mutex<Cell<Option<&'static mut Table>>> = Mutex::new(Cell::new(None));
pub static STATUS: Mutex<Status> = Mutex::new(Status::new());

/// The status of the ticks.
pub fn status<T>(of: impl Fn(&Status) -> T) -> T {
    critical_section::with(|cs| of(STATUS.borrow(cs)))
}

/// Offers a table to the tick, waits until it is taken, and returns the previous one.
pub fn exchange(table: &'static mut Table) -> &'static mut Table {
    critical_section::with(|cs| OFFERED.borrow(cs).set(Some(table)));
    loop {
        if let Some(other) = critical_section::with(|cs| RETURNED.borrow(cs).take()) {
            return other;
        }
        cortex_m::asm::wfi(); // until the next tick
    }
}
