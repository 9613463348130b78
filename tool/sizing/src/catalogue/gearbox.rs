//! A gearbox of the catalogue.

use super::{Motor, broken_line};

/// A gearbox; SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Gearbox {
    /// Key, unique in the catalogue.
    pub key: String,
    /// Maker.
    pub maker: String,
    /// Maker's type designation.
    pub model: String,
    /// Input speed over output speed.
    pub ratio: f64,
    /// Whether the output turns against the input.
    pub reverses: bool,
    /// Number of stages.
    pub stages: Option<u32>,
    /// Rated output torque T2N (N·m).
    pub rated_torque: Option<f64>,
    /// Acceleration torque T2B at the output (N·m).
    pub peak_torque: Option<f64>,
    /// Emergency torque at the output (N·m), allowed a limited number of times.
    pub emergency_torque: Option<f64>,
    /// Rated input speed (rad/s).
    pub rated_speed: Option<f64>,
    /// Largest input speed (rad/s).
    pub max_speed: Option<f64>,
    /// Inertia at the input (kg·m²).
    pub inertia: f64,
    /// Efficiency at full load, 0 to 1, where power flows to the machine.
    pub efficiency: f64,
    /// Whether the data sheet gives no efficiency and one was assumed.
    pub efficiency_assumed: bool,
    /// Factor of the torque where power flows back: η again, or 2 − 1/η for friction. Zero or negative: self-locking at rest. While the motor brakes,
    /// a gearbox with zero still passes on the torque of its rotor; one with less may lock and stop the machine at once.
    pub back_efficiency: f64,
    /// No-load torque at the input (N·m); zero if not given.
    pub no_load_torque: f64,
    /// Torsional stiffness at the output (N·m/rad).
    pub stiffness: Option<f64>,
    /// Backlash at the output (rad).
    pub backlash: Option<f64>,
    /// Largest radial force on the output shaft (N).
    pub max_radial_load: Option<f64>,
    /// Largest axial force on the output shaft (N).
    pub max_axial_load: Option<f64>,
    /// Shock factors of the maker: (cycles per hour, factor), cycles rising; empty: not given.
    pub shock_factors: Vec<[f64; 2]>,
    /// Largest diameter of the motor shaft that its hub takes (m).
    pub max_motor_shaft: Option<f64>,
    /// Size of the flange for the motor (m).
    pub flange: Option<f64>,
    /// Mass (kg).
    pub mass: Option<f64>,
    /// Price, in the currency of the catalogue.
    pub price: Option<f64>,
    /// Whether the data were taken from the maker's own document.
    pub from_maker: bool,
    /// Source of the data.
    pub source: String,
}

impl Gearbox {
    /// Whether its hub takes the shaft of a motor, as far as the data say.
    pub fn takes(&self, motor: &Motor) -> bool {
        match (self.max_motor_shaft, motor.shaft_diameter) {
            (Some(most), Some(shaft)) => shaft <= most * (1.0 + 1e-9),
            _ => true,
        }
    }

    /// Its size: the rated output torque, else the acceleration torque (N·m).
    pub fn size(&self) -> Option<f64> {
        self.rated_torque.or(self.peak_torque)
    }
}

/// Cycles per hour up to which T2B is valid if the maker gives no shock factors (WITTENSTEIN, engineering glossary).
const CYCLES: f64 = 1000.0;

impl Gearbox {
    /// The maker's shock factor f_s at a number of cycles per hour: linear between the maker's points, constant beyond them; one if not given.
    pub fn shock_factor(&self, cycles: f64) -> f64 {
        broken_line(&self.shock_factors, cycles)
    }

    /// Largest output torque (N·m) at a number of cycles per hour: T2B/f_s; `None` if T2B is not given.
    pub fn acceleration_torque(&self, cycles: f64) -> Option<f64> {
        Some(self.peak_torque? / self.shock_factor(cycles))
    }

    /// Cycles per hour up to which [`Self::acceleration_torque`] comes from the maker.
    pub fn most_cycles(&self) -> f64 {
        self.shock_factors.last().map_or(CYCLES, |[most, _]| *most)
    }
}

impl Default for Gearbox {
    /// A plain shaft: ratio 1, no inertia, no losses, no limits.
    fn default() -> Self {
        Self {
            key: String::new(),
            maker: String::new(),
            model: String::new(),
            ratio: 1.0,
            reverses: false,
            stages: None,
            rated_torque: None,
            peak_torque: None,
            emergency_torque: None,
            rated_speed: None,
            max_speed: None,
            inertia: 0.0,
            efficiency: 1.0,
            efficiency_assumed: false,
            back_efficiency: 1.0,
            no_load_torque: 0.0,
            stiffness: None,
            backlash: None,
            max_radial_load: None,
            max_axial_load: None,
            shock_factors: Vec::new(),
            max_motor_shaft: None,
            flange: None,
            mass: None,
            price: None,
            from_maker: false,
            source: String::new(),
        }
    }
}
