//! Servo amplifiers and brake resistors of the catalogue.

use jred_file::model::supply::BrakeResistor;

use super::derating::Derating;
use super::lists::keys;

/// A servo amplifier (drive controller); SI units, currents RMS.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Amplifier {
    /// Key, unique in the catalogue.
    pub key: String,
    /// Maker.
    pub maker: String,
    /// Maker's type designation.
    pub model: String,
    /// Rated current (A).
    pub rated_current: f64,
    /// Peak current (A).
    pub peak_current: f64,
    /// The maker's derating factors on both currents at the site.
    pub derating: Derating,
    /// Longest duration of the peak current from cold (s).
    pub peak_time: Option<f64>,
    /// Nominal DC-bus voltage (V).
    pub bus_voltage: Option<f64>,
    /// Mains voltage that it is made for (V), with its whole voltage class.
    pub mains_voltage: Option<f64>,
    /// DC-bus capacitance (F).
    pub capacitance: Option<f64>,
    /// DC-bus voltage at which the brake resistor switches on (V).
    pub chopper_voltage: Option<f64>,
    /// Highest DC-bus voltage (V).
    pub max_voltage: Option<f64>,
    /// Smallest brake resistance (Ω).
    pub min_resistance: Option<f64>,
    /// Energy that the DC bus absorbs above that at the supply voltage until the brake resistor switches on (J).
    pub absorbable_energy: Option<f64>,
    /// Its internal brake resistor; `None`: it has none.
    pub internal_resistor: Option<BrakeResistor>,
    /// Losses: constant (W), and per ampere of RMS current (V).
    pub losses: [f64; 2],
    /// Mass (kg).
    pub mass: Option<f64>,
    /// Price, in the currency of the catalogue.
    pub price: Option<f64>,
    /// Whether the data were taken from the maker's own document.
    pub from_maker: bool,
    /// Source of the data.
    pub source: String,
}

/// A brake resistor of the catalogue; SI units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Resistor {
    /// Key, unique in the catalogue.
    pub key: String,
    /// Maker.
    pub maker: String,
    /// Maker's type designation.
    pub model: String,
    /// Resistance (Ω).
    pub resistance: f64,
    /// Continuous power (W).
    pub rated_power: f64,
    /// Largest short-time power (W).
    pub peak_power: Option<f64>,
    /// Energy of a single pulse (J).
    pub pulse_energy: Option<f64>,
    /// Keys of the amplifiers that it is made for, or starts of keys followed by "*"; empty: any.
    pub fits: String,
    /// Mass (kg).
    pub mass: Option<f64>,
    /// Price, in the currency of the catalogue.
    pub price: Option<f64>,
    /// Whether the data were taken from the maker's own document.
    pub from_maker: bool,
    /// Source of the data.
    pub source: String,
}

impl Amplifier {
    /// Capacitance of the DC bus (F). If only the energy E that it absorbs is given, it is 2·E/(U² − U₀²), from the supply voltage U₀ (at this site
    /// `voltage`, unless the amplifier states its own) to the voltage U at which the brake resistor switches on, else to the highest voltage.
    pub fn bus_capacitance(&self, voltage: Option<f64>) -> Option<f64> {
        self.capacitance.or_else(|| {
            let energy = self.absorbable_energy?;
            let low = self.nominal_voltage().or(voltage)?;
            let high = self.chopper_voltage.or(self.max_voltage)?;
            (high > low).then(|| 2.0 * energy / (high * high - low * low))
        })
    }
}

impl Resistor {
    /// Whether it is made for an amplifier, as far as its data say.
    pub fn suits(&self, amplifier: Option<&Amplifier>) -> bool {
        let Some(amplifier) = amplifier.filter(|_| !self.fits.is_empty()) else {
            return true;
        };
        let named = |pattern: &str| match pattern.strip_suffix('*') {
            Some(start) => amplifier.key.starts_with(start),
            None => amplifier.key == pattern,
        };
        keys(&self.fits).any(named)
    }

    /// Its data for the bus.
    pub const fn on_bus(&self) -> BrakeResistor {
        BrakeResistor {
            resistance: self.resistance,
            power: self.rated_power,
            peak_power: self.peak_power,
            pulse_energy: self.pulse_energy,
        }
    }
}
