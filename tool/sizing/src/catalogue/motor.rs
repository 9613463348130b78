//! A motor of the catalogue.

use super::derating::Derating;
use jred_file::units::Vocabulary;
use serde::Serialize;

/// Commutation of a winding, which determines the meaning of its data.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Commutation {
    /// Three phases with sine currents: RMS currents, line-to-line resistance, inductance and voltage constant.
    #[default]
    Sine,
    /// Direct current, or a brushless motor with block commutation: plain values between two terminals.
    Block,
}

/// A servo motor; SI units. `None`: not given. For a linear motor read force (N) for torque, m/s for speed, and the mass of the moving part (kg) for
/// the rotor's inertia.
#[expect(clippy::struct_excessive_bools, reason = "each is a fact of its own")]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motor {
    /// Key, unique in the catalogue.
    pub key: String,
    /// Maker.
    pub maker: String,
    /// Maker's type designation.
    pub model: String,
    /// Rotary or linear.
    pub kind: MotorKind,
    /// S1 torque at rated speed (N·m).
    pub rated_torque: Option<f64>,
    /// Rated speed (rad/s).
    pub rated_speed: Option<f64>,
    /// S1 torque at standstill M0 (N·m).
    pub standstill_torque: Option<f64>,
    /// Peak torque (N·m).
    pub peak_torque: Option<f64>,
    /// Largest speed (rad/s).
    pub max_speed: Option<f64>,
    /// Rated power as stated (W); compared with rated torque times rated speed, not used.
    pub stated_power: Option<f64>,
    /// Largest continuous power (W).
    pub max_power: Option<f64>,
    /// Inertia of the rotor without brake (kg·m²).
    pub rotor_inertia: f64,
    /// Speed up to which the peak torque is available (rad/s).
    pub corner_speed: Option<f64>,
    /// Peak torque at the largest speed (N·m).
    pub torque_at_max_speed: Option<f64>,
    /// No-load speed at `bus_voltage` (rad/s).
    pub no_load_speed: Option<f64>,
    /// Peak torque over speed as points (rad/s, N·m), speeds rising; empty: not given.
    pub peak_curve: Vec<[f64; 2]>,
    /// S1 torque over speed as points; empty: not given.
    pub continuous_curve: Vec<[f64; 2]>,
    /// Coulomb (N·m) and viscous (N·m·s/rad) friction at the shaft; zero if not given.
    pub friction: [f64; 2],
    /// The winding.
    pub winding: Winding,
    /// Its thermal data.
    pub thermal: Thermal,
    /// The maker's derating factors of its S1 torque at the site.
    pub derating: Derating,
    /// Its holding brake.
    pub brake: Option<Brake>,
    /// Whether it can be ordered with a brake: another motor of the catalogue has it.
    pub brake_is_optional: bool,
    /// Size of its flange (m).
    pub flange: Option<f64>,
    /// Diameter of its shaft (m).
    pub shaft_diameter: Option<f64>,
    /// DC-bus voltage that the data are valid for (V).
    pub bus_voltage: Option<f64>,
    /// Mains voltage that the motor is made for (V), with its whole voltage class.
    pub mains_voltage: Option<f64>,
    /// Largest DC-bus voltage that its insulation withstands (V).
    pub max_bus_voltage: Option<f64>,
    /// Whether a list of the catalogue names the amplifiers that run it.
    pub amplifiers_listed: bool,
    /// Whether the catalogue has amplifiers, but none that runs it.
    pub lacks_amplifier: bool,
    /// Mass (kg).
    pub mass: Option<f64>,
    /// Price, in the currency of the catalogue.
    pub price: Option<f64>,
    /// Whether the data were taken from the maker's own document.
    pub from_maker: bool,
    /// Source of the data.
    pub source: String,
}

/// Rotary or linear motor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MotorKind {
    /// Rotary.
    #[default]
    Rotary,
    /// Linear.
    Linear,
}

impl MotorKind {
    /// Names and units of its figures.
    pub const fn vocabulary(self) -> &'static Vocabulary {
        match self {
            Self::Rotary => &Vocabulary::ROTARY,
            Self::Linear => &Vocabulary::LINEAR,
        }
    }
}

/// A motor's winding. For a three-phase motor currents are RMS values and voltages line to line; for a direct-current motor both are plain values.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Winding {
    /// Commutation, which determines the meaning of the following values.
    pub commutation: Commutation,
    /// Torque constant k_t (N·m/A).
    pub torque_constant: Option<f64>,
    /// Voltage constant k_e (V·s/rad); in SI equal to k_t for a direct-current motor.
    pub voltage_constant: Option<f64>,
    /// Resistance at 20 °C (Ω).
    pub resistance: Option<f64>,
    /// Inductance (H).
    pub inductance: Option<f64>,
    /// Pairs of poles.
    pub pole_pairs: Option<f64>,
    /// Current at rated torque (A).
    pub rated_current: Option<f64>,
    /// Current at standstill torque (A).
    pub standstill_current: Option<f64>,
    /// Largest current (A).
    pub peak_current: Option<f64>,
    /// Current without load at the no-load speed (A).
    pub no_load_current: Option<f64>,
}

/// A motor's thermal data.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Thermal {
    /// Thermal resistance from winding to housing, or from winding to surroundings if only that is given (K/W).
    pub winding_resistance: Option<f64>,
    /// Thermal resistance from housing to surroundings (K/W).
    pub housing_resistance: Option<f64>,
    /// Thermal time constant of the winding (s).
    pub winding_time: Option<f64>,
    /// Thermal time constant of the housing, or of the motor as a whole (s).
    pub housing_time: Option<f64>,
    /// Maximum temperature of the winding (°C).
    pub max_temperature: Option<f64>,
}

/// End of the key of a motor that is offered with an optional brake.
pub(super) const WITH_BRAKE: &str = "-brake";

/// A holding brake.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Brake {
    /// Static torque (N·m).
    pub torque: f64,
    /// Its inertia (kg·m²).
    pub inertia: f64,
    /// Mean torque while it slips (N·m), if given.
    pub dynamic_torque: Option<f64>,
    /// Time from switching off its current until it has its torque (s).
    pub closing_time: Option<f64>,
    /// Largest work of one stop from speed (J).
    pub work: Option<f64>,
    /// Allowed number of such stops per hour.
    pub stops_per_hour: Option<f64>,
    /// Time until it is open (s).
    pub opening_time: Option<f64>,
    /// Power that keeps it open (W).
    pub power: Option<f64>,
    /// Mass that it adds to the motor (kg).
    pub mass: Option<f64>,
}

impl Motor {
    /// Inertia of the brake (kg·m²); zero without a brake.
    pub fn brake_inertia(&self) -> f64 {
        self.brake.map_or(0.0, |brake| brake.inertia)
    }

    /// The key under which it is offered with its brake, if that is an option.
    pub(super) fn key_with_brake(&self) -> Option<String> {
        let has_option = self.brake_is_optional && self.brake.is_some();
        has_option.then(|| format!("{}{WITH_BRAKE}", self.key))
    }

    /// Its key without the end that names an optional brake.
    pub fn key_without_brake(&self) -> &str {
        self.key.strip_suffix(WITH_BRAKE).unwrap_or(&self.key)
    }

    /// The motor without and with a brake that is an option; otherwise the motor as it is.
    pub(super) fn variants(self) -> Vec<Self> {
        let Some((brake, key)) = self.brake.zip(self.key_with_brake()) else {
            return vec![self];
        };
        let with = Self {
            key,
            model: format!("{} with brake", self.model),
            mass: self.mass.zip(brake.mass).map(|(mass, brake)| mass + brake),
            price: None,
            brake_is_optional: false,
            ..self.clone()
        };
        let without = Self {
            brake: None,
            ..self
        };
        vec![without, with]
    }

    /// Inertia of the rotor with its brake (kg·m²).
    pub fn rotor_with_brake(&self) -> f64 {
        self.rotor_inertia + self.brake_inertia()
    }

    /// Rated torque times rated speed (W). If no rated speed is given, it is the speed at the nominal point of a direct-current motor: n = (V −
    /// R·I)/k_e at the rated current.
    pub fn rated_power(&self) -> Option<f64> {
        let torque = self.rated_torque?;
        let speed = self.rated_speed.or_else(|| self.nominal_speed(torque))?;
        Some(torque * speed)
    }

    fn nominal_speed(&self, torque: f64) -> Option<f64> {
        let winding = &self.winding;
        if winding.commutation != Commutation::Block {
            return None;
        }
        let constant = winding.torque_constant?;
        let current = winding.rated_current.unwrap_or(torque / constant);
        let voltage = self.figures_voltage()? - winding.resistance? * current;
        let speed = voltage / winding.voltage_constant.unwrap_or(constant);
        (speed.is_finite() && speed > 0.0).then_some(speed)
    }
}
