//! The known data of the bus of one drive or of several.

use crate::catalogue::{Amplifier, Motor};
use jred_file::model::supply::{BrakeResistor, Supply};

use super::store::Bus;

/// The bus of one drive; `None` where data are missing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BusData {
    /// Supply voltage (V).
    pub voltage: Option<f64>,
    /// Capacitance (F).
    pub capacitance: Option<f64>,
    /// Switch-on voltage of the brake resistor (V).
    pub chopper_voltage: Option<f64>,
    /// Highest voltage (V).
    pub max_voltage: Option<f64>,
    /// Smallest resistance (Ω).
    pub min_resistance: Option<f64>,
    /// Whether energy is fed back into the mains.
    pub regenerative: bool,
    /// The brake resistor.
    pub resistor: Option<BrakeResistor>,
}

impl BusData {
    /// From the machine file, else the amplifier, else, for the voltage, the motor's data sheet. The limit of the motor's insulation also applies to
    /// the bus. `highest_supply`: the voltage without braking at the upper tolerance of the mains (V).
    pub fn new(
        supply: &Supply,
        highest_supply: Option<f64>,
        amplifier: Option<&Amplifier>,
        motor: &Motor,
    ) -> Self {
        let own = |figure: fn(&Amplifier) -> Option<f64>| amplifier.and_then(figure);
        let voltage = highest_supply
            .or(own(Amplifier::nominal_voltage))
            .or(motor.bus_voltage);
        Self {
            voltage,
            capacitance: supply
                .capacitance
                .or(amplifier.and_then(|a| a.bus_capacitance(voltage))),
            chopper_voltage: supply.chopper_voltage.or(own(|a| a.chopper_voltage)),
            max_voltage: [
                supply.max_voltage.or(own(|a| a.max_voltage)),
                motor.max_bus_voltage,
            ]
            .into_iter()
            .flatten()
            .reduce(f64::min),
            min_resistance: supply.min_resistance.or(own(|a| a.min_resistance)),
            regenerative: supply.regenerative,
            resistor: supply.brake_resistor,
        }
    }

    /// The bus of several drives, each with the data of its own amplifier: the strictest limits, and the sum of the
    /// capacitances if all are known.
    pub fn shared(supply: &Supply, each: &[Self]) -> Self {
        let of = |figure: fn(&Self) -> Option<f64>, stricter: fn(f64, f64) -> f64| {
            each.iter().filter_map(figure).reduce(stricter)
        };
        Self {
            voltage: each.iter().find_map(|data| data.voltage),
            capacitance: supply
                .capacitance
                .or_else(|| each.iter().map(|data| data.capacitance).sum()),
            chopper_voltage: of(|data| data.chopper_voltage, f64::min),
            max_voltage: of(|data| data.max_voltage, f64::min),
            min_resistance: of(|data| data.min_resistance, f64::max),
            regenerative: supply.regenerative,
            resistor: supply.brake_resistor,
        }
    }

    /// Whether the bus needs a brake resistor, if it rises to this voltage without one (NaN: unknown): above the highest voltage or, if that is not
    /// given, above the chopper voltage.
    pub fn asks_for_a_resistor(&self, highest: f64) -> bool {
        let top = self.max_voltage.or(self.chopper_voltage);
        top.is_some_and(|top| highest.is_nan() || highest > top)
    }

    /// The bus with its resistor, if it has a resistor and a switch-on voltage. Without capacitance nothing is stored: all regenerated energy goes
    /// into the resistor.
    ///
    /// # Errors
    /// The missing data, as a message.
    pub fn bus(&self) -> Result<Bus, &'static str> {
        let voltage = self.voltage.ok_or("voltage of the DC bus")?;
        let resistor = match (self.resistor, self.chopper_voltage) {
            (Some(resistor), Some(on)) => Some([on, resistor.resistance]),
            (Some(_), None) => return Err("voltage at which the brake resistor switches on"),
            (None, _) => None,
        };
        if let Some([on, _]) = resistor
            && on <= voltage
        {
            return Err(
                "voltage at which the brake resistor switches on, above the supply voltage",
            );
        }
        Ok(Bus {
            voltage,
            capacitance: self.capacitance.unwrap_or(0.0),
            regenerative: self.regenerative,
            resistor,
        })
    }
}
