//! Voltages of a bus that stand in the wrong order.
//!
//! The machine file refuses such an order among its own keys. The voltages of one bus may come from several places, though:
//! the machine file, the amplifier, the motor's data sheet.

use super::supply::BusData;
use jred_machine::number::rounding::short;

/// What no brake resistor mends: the supply must hold less than the chopper's voltage, and that must be less than the highest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Conflict {
    /// The supply holds the highest voltage already, or more (V).
    Supply {
        /// What it holds.
        supply: f64,
        /// The highest voltage.
        highest: f64,
    },
    /// The brake resistor comes on at the highest voltage, or above it (V).
    LateChopper {
        /// Voltage at which it comes on.
        chopper: f64,
        /// The highest voltage.
        highest: f64,
    },
    /// The brake resistor is never off (V).
    EarlyChopper {
        /// Voltage at which it comes on.
        chopper: f64,
        /// What the supply holds.
        supply: f64,
    },
}

impl Conflict {
    /// The keys of `[supply]` of which one is to be changed.
    pub const fn keys(&self) -> &'static [&'static str] {
        match self {
            Self::Supply { .. } => &["max_voltage", "bus_voltage"],
            Self::LateChopper { .. } => &["chopper_voltage", "max_voltage"],
            Self::EarlyChopper { .. } => &["chopper_voltage", "bus_voltage"],
        }
    }

    /// In words, with what is to be changed.
    pub fn words(&self) -> String {
        match *self {
            Self::Supply { supply, highest } if supply > highest => format!(
                "the bus already stands above its highest voltage, {} V: its supply holds {} V, and no brake resistor, capacitance or \
                 regenerative supply lowers that; correct max_voltage or bus_voltage in [supply], or what the amplifier and the motor \
                 state for them",
                short(highest),
                short(supply)
            ),
            Self::Supply { highest, .. } => format!(
                "the supply holds the bus at its highest voltage, {} V: there is no room for what comes back, nor for a brake resistor to \
                 come on; correct max_voltage or bus_voltage in [supply], or what the amplifier and the motor state for them",
                short(highest)
            ),
            Self::LateChopper { chopper, highest } => format!(
                "the brake resistor comes on only at {} V, not below the highest voltage of the bus, {} V, and none keeps it there: \
                 lower chopper_voltage or raise max_voltage in [supply], as the amplifier allows",
                short(chopper),
                short(highest)
            ),
            Self::EarlyChopper { chopper, supply } => format!(
                "a brake resistor would always be on: it comes on at {} V, and the supply holds {} V; raise chopper_voltage or lower \
                 bus_voltage in [supply], as the amplifier allows",
                short(chopper),
                short(supply)
            ),
        }
    }
}

impl BusData {
    /// Whether the voltages, as far as they are known, leave a brake resistor nothing to do. A supply that takes energy back
    /// needs none.
    pub fn conflict(&self) -> Option<Conflict> {
        if let (Some(supply), Some(highest)) = (self.voltage, self.max_voltage)
            && supply >= highest
        {
            return Some(Conflict::Supply { supply, highest });
        }
        let chopper = self.chopper_voltage.filter(|_| !self.regenerative)?;
        match (self.max_voltage, self.voltage) {
            (Some(highest), _) if chopper >= highest => {
                Some(Conflict::LateChopper { chopper, highest })
            }
            (_, Some(supply)) if chopper <= supply => {
                Some(Conflict::EarlyChopper { chopper, supply })
            }
            _ => None,
        }
    }
}
