//! The winding of a motor: current of a torque, copper loss, and the voltage for current and speed.
//!
//! Two kinds of data sheet are in use, distinguished by [`Commutation`]. For a three-phase motor with sine currents the catalogue has RMS currents
//! and line-to-line values; per phase of the star R/2, L/2 and k_e/√3 apply. i_q is the current in phase with the induced voltage (it makes the
//! torque) and i_d the current perpendicular to it, at the electrical frequency p·n:
//!
//! ```text
//! T = k_t·i_q             k_t = √3·k_e
//! v_q = r·i_q + x·i_d + k_e·n
//! v_d = r·i_d − x·i_q     r = √3/2·R,  x = √3/2·p·n·L,  √(v_d² + v_q²) ≤ U/√2
//! P = 3/2·R·I²
//! ```
//!
//! in line-to-line RMS volts; U is the voltage of the DC bus, and U/√2 the output of a bridge with space-vector modulation (Schröder, *Elektrische
//! Antriebe – Regelung von Antriebssystemen*). For a direct-current motor, including block commutation (as data sheets of small brushless motors have
//! it), T = k_t·I, k_t = k_e, V = k_e·n + R·I ≤ U, P = R·I².

use crate::catalogue::{Commutation, Motor, Winding};

/// Temperature coefficient of copper's resistance, from its value at 20 °C (1/K).
pub const COPPER: f64 = 0.00393;

/// Temperature at which the catalogue gives resistances (°C).
pub const REFERENCE_TEMPERATURE: f64 = 20.0;

impl Commutation {
    /// k_t/k_e from the power balance.
    pub const fn torque_per_voltage_constant(self) -> f64 {
        match self {
            Self::Sine => SQRT_3,
            Self::Block => 1.0,
        }
    }

    /// Copper loss as a multiple of R·I².
    const fn loss_factor(self) -> f64 {
        match self {
            Self::Sine => 1.5,
            Self::Block => 1.0,
        }
    }

    /// Voltage drop of the current in the voltage equation, as a multiple of R·I.
    pub const fn drop_factor(self) -> f64 {
        match self {
            Self::Sine => 0.5 * SQRT_3,
            Self::Block => 1.0,
        }
    }

    /// The largest voltage available from a DC bus, as a multiple of the bus voltage.
    pub const fn voltage_share(self) -> f64 {
        match self {
            Self::Sine => std::f64::consts::FRAC_1_SQRT_2,
            Self::Block => 1.0,
        }
    }
}

const SQRT_3: f64 = 1.732_050_807_568_877_2;

/// Far beyond any motor, in SI units.
pub(super) const PLAUSIBLE: std::ops::RangeInclusive<f64> = 1e-15..=1e15;

/// A usable figure of a data sheet: values far beyond any motor would overflow.
pub(super) fn usable(figure: Option<f64>) -> Option<f64> {
    figure.filter(|x| PLAUSIBLE.contains(x))
}

impl Winding {
    /// Resistance (Ω) at a temperature of the winding (°C): R₂₀·(1 + 0.00393·(θ − 20)). Never below zero.
    pub fn resistance_at(&self, temperature: f64) -> Option<f64> {
        let factor = 1.0 + COPPER * (temperature - REFERENCE_TEMPERATURE);
        Some(usable(self.resistance)? * factor.max(0.0))
    }

    /// Copper loss over the square of the current (W/A² = Ω) at a temperature (°C): 3/2·R for three phases with sine currents, R for direct current;
    /// `None` if no resistance is given.
    pub fn loss_resistance(&self, temperature: f64) -> Option<f64> {
        Some(self.commutation.loss_factor() * self.resistance_at(temperature)?)
    }
}

/// Current of a torque. It is linear with 1/k_t up to the S1 torque. If the data sheet's peak current exceeds peak torque/k_t, a second line leads
/// from there to peak torque and peak current: the iron saturates.
///
/// ```
/// # use jred_sizing::motor::winding::CurrentCurve;
/// let curve = CurrentCurve::new(2.0, Some([10.0, 25.0]), 8.0);
/// assert_eq!(curve.current(-6.0), 3.0);
/// assert_eq!(curve.current(25.0), 12.5);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurrentCurve {
    /// Amperes per newton metre up to the knee.
    slope: f64,
    /// Torque of the knee (N·m); infinite: no saturation given.
    knee: f64,
    /// Amperes per newton metre beyond it.
    steep: f64,
}

impl CurrentCurve {
    /// From the torque constant (N·m/A, positive), a point \[current, torque\] of saturation (A, N·m), and the torque up to which the constant is
    /// valid. A point that is not beyond k_t's line and beyond the knee is ignored.
    pub fn new(torque_constant: f64, saturated: Option<[f64; 2]>, knee: f64) -> Self {
        // Rounding in the data sheet is not saturation.
        const ROUNDING: f64 = 1.001;
        let slope = 1.0 / torque_constant;
        let straight = Self {
            slope,
            knee: f64::INFINITY,
            steep: slope,
        };
        let Some([current, torque]) = saturated else {
            return straight;
        };
        let usable = current.is_finite() && torque.is_finite() && knee > 0.0 && torque > knee;
        if !usable || current <= ROUNDING * torque * slope {
            return straight;
        }
        Self {
            slope,
            knee,
            steep: (current - knee * slope) / (torque - knee),
        }
    }

    /// The curve of a motor; `None` if neither a torque constant nor a torque with its current is given.
    pub fn of(motor: &Motor) -> Option<Self> {
        let winding = &motor.winding;
        let peak = usable(winding.peak_current).zip(usable(motor.peak_torque));
        let pair = |torque, current| Some(usable(torque)? / usable(current)?);
        let constant = usable(winding.torque_constant)
            .or_else(|| {
                let voltage = usable(winding.voltage_constant)?;
                Some(voltage * winding.commutation.torque_per_voltage_constant())
            })
            .or_else(|| pair(motor.standstill_torque, winding.standstill_current))
            .or_else(|| pair(motor.rated_torque, winding.rated_current))
            .or_else(|| peak.map(|(current, torque)| torque / current))?;
        let s1 = [motor.rated_torque, motor.standstill_torque];
        let knee = s1.into_iter().filter_map(usable).fold(0.0, f64::max);
        Some(Self::new(
            constant,
            peak.map(|(current, torque)| [current, torque]),
            knee,
        ))
    }

    /// Torque constant up to the knee (N·m/A).
    pub fn torque_constant(&self) -> f64 {
        1.0 / self.slope
    }

    /// Current from which the iron saturates (A); infinite: no saturation given.
    pub const fn knee_current(&self) -> f64 {
        self.knee * self.slope
    }

    /// Torque from which the iron saturates (N·m); infinite: no saturation given. Up to it the current is proportional to the torque.
    pub const fn knee(&self) -> f64 {
        self.knee
    }

    /// Whether saturation is given.
    pub const fn saturates(&self) -> bool {
        self.knee.is_finite()
    }

    /// Current (A, RMS of a three-phase motor), without sign, of a torque (N·m).
    pub fn current(&self, torque: f64) -> f64 {
        let torque = torque.abs();
        if torque <= self.knee {
            torque * self.slope
        } else {
            self.knee * self.slope + (torque - self.knee) * self.steep
        }
    }

    /// Torque (N·m) of a current (A), without sign: the inverse of [`current`](Self::current).
    pub fn torque(&self, current: f64) -> f64 {
        let current = current.abs();
        let knee = self.knee_current();
        if current <= knee {
            current / self.slope
        } else {
            self.knee + (current - knee) / self.steep
        }
    }
}
