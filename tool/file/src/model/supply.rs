//! The supply of the DC bus and everything that takes regenerated energy, from the machine file.

/// Mains may be this much above their nominal voltage: 10 % (IEC 60038).
pub const MAINS_TOLERANCE: f64 = 1.1;

/// Lowest and highest mains voltage of a servo amplifier (V): a transformer for 24 V, and the upper end of low voltage (IEC 60038).
pub const MAINS: [f64; 2] = [20.0, 1000.0];

/// Voltage (V) of a DC bus behind a rectifier without load: U_dc = √2·U_ac.
pub const fn rectified(mains: f64) -> f64 {
    std::f64::consts::SQRT_2 * mains
}

/// The supply of the machine file. Missing values come from the amplifier.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Supply {
    /// Whether the file has a `[supply]`.
    pub given: bool,
    /// Capacitance of the DC bus (F).
    pub capacitance: Option<f64>,
    /// Switch-on voltage of the brake resistor (V).
    pub chopper_voltage: Option<f64>,
    /// Highest voltage of the DC bus (V).
    pub max_voltage: Option<f64>,
    /// Smallest resistance that the chopper may switch (Ω).
    pub min_resistance: Option<f64>,
    /// Whether energy is fed back into the mains.
    pub regenerative: bool,
    /// The brake resistor.
    pub brake_resistor: Option<BrakeResistor>,
}

/// A brake resistor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrakeResistor {
    /// Resistance (Ω).
    pub resistance: f64,
    /// Continuous power (W).
    pub power: f64,
    /// Largest short-time power (W).
    pub peak_power: Option<f64>,
    /// Largest energy without a pause (J).
    pub pulse_energy: Option<f64>,
}
