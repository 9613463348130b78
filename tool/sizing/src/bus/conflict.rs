//! Contradictory bus voltages.
//!
//! The machine file refuses such an order among its own keys. However, the voltages of one bus may come from several sources: the machine file, the
//! amplifier, the motor's data sheet.

use super::supply::BusData;

/// A conflict that no brake resistor resolves: the supply voltage must be below the chopper voltage, and the chopper voltage below the maximum
/// voltage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Conflict {
    /// The supply voltage is at or above the maximum voltage (V).
    Supply {
        /// Supply voltage.
        supply: f64,
        /// The highest voltage.
        highest: f64,
    },
    /// The brake resistor switches on at or above the maximum voltage (V).
    LateChopper {
        /// Switch-on voltage.
        chopper: f64,
        /// The highest voltage.
        highest: f64,
    },
    /// The brake resistor is never off (V).
    EarlyChopper {
        /// Switch-on voltage.
        chopper: f64,
        /// Supply voltage.
        supply: f64,
    },
}

impl Conflict {
    /// Keys of `[supply]`, one of which must be changed.
    pub const fn keys(&self) -> &'static [&'static str] {
        match self {
            Self::Supply { .. } => &["max_voltage", "bus_voltage"],
            Self::LateChopper { .. } => &["chopper_voltage", "max_voltage"],
            Self::EarlyChopper { .. } => &["chopper_voltage", "bus_voltage"],
        }
    }
}

impl BusData {
    /// Whether the known voltages make a brake resistor useless. A regenerative supply needs no resistor.
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
