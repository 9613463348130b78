//! The DC bus: what a drive, or several on one bus, draw from it and feed back, the voltage and the brake resistor.
//!
//! The power that a drive draws from the bus is that of the motor's torque, which covers all friction behind it, with the
//! copper loss and the losses of the amplifier:
//!
//! ```text
//! P = T·ω + R·I² + p₀ + p₁·I        R at 20 °C; of a three-phase winding 3/2 of that between two terminals
//! ```
//!
//! Most comes back with the least losses: the copper is taken cold, and left out where the winding's resistance is not
//! stated. While the motor brakes, I is the current of the torque alone: how far the bus has risen, and how much the
//! amplifier still weakens the field, is not known. While it drives, the field-weakening current is in I.

pub mod axes;
pub mod command;
pub mod curve;
mod report;
pub mod store;
pub mod supply;
mod verdict;

use crate::catalogue::{Amplifier, Motor, Resistor};
use crate::cycle::Cycle;
use crate::drive::Coefficients;
use crate::envelope::Prepared;
use crate::output::short;
use crate::winding::REFERENCE_TEMPERATURE;

use curve::PowerCurve;
use supply::{BrakeResistor, BusData};

/// Power that a drive draws from the DC bus over the cycle.
pub fn power(
    cycle: &Cycle,
    coefficients: &Coefficients,
    ratio: f64,
    motor: &Motor,
    prepared: &Prepared,
    amplifier: Option<&Amplifier>,
) -> PowerCurve {
    let resistance = motor.winding.loss_resistance(REFERENCE_TEMPERATURE);
    let [constant, per_ampere] = amplifier.map_or([0.0; 2], |a| a.losses);
    let points = cycle.samples().iter().map(|sample| {
        let torque = coefficients.torque(&sample.loads);
        let speed = sample.speed() * ratio;
        let mut power = torque * speed + constant;
        let current = if torque * speed < 0.0 {
            prepared.torques.map(|curve| curve.current(torque))
        } else {
            prepared.current(torque, speed)
        };
        if let Some(current) = current {
            power += per_ampere * current + resistance.unwrap_or(0.0) * current * current;
        }
        [sample.t, power]
    });
    PowerCurve::new(points, cycle.duration())
}

/// What a brake resistor must bear that the chopper's voltage alone bounds.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Need {
    /// Mean power (W).
    #[serde(rename = "mean [W]")]
    pub mean: f64,
    /// Largest power (W).
    #[serde(rename = "peak [W]")]
    pub peak: f64,
    /// Largest energy without a pause (J).
    #[serde(rename = "pulse [J]")]
    pub pulse: f64,
    /// Largest resistance that takes that power at the chopper's voltage (Ω).
    #[serde(rename = "largest resistance [Ohm]")]
    pub largest_resistance: f64,
    /// Smallest resistance that the chopper may switch (Ω).
    #[serde(rename = "smallest resistance [Ohm]")]
    pub smallest_resistance: Option<f64>,
}

impl Need {
    /// The need of a power. `None`: the chopper's voltage is not known, or the capacitor takes all that comes back.
    pub fn of(data: &BusData, curve: &PowerCurve) -> Option<Self> {
        let on = data.chopper_voltage?;
        let [least, _] = curve.extremes();
        let back = -least;
        if data.regenerative || back <= 0.0 {
            return None;
        }
        // A resistor that takes the largest power which ever comes back never lets the voltage rise above the chopper's.
        let resistor = BrakeResistor {
            resistance: on * on / back,
            power: f64::INFINITY,
            peak_power: None,
            pulse_energy: None,
        };
        let with = BusData {
            resistor: Some(resistor),
            ..*data
        };
        let figures = with.bus().ok()?.run(curve);
        (figures.burnt > 0.0).then(|| Self {
            mean: figures.burnt / curve.period(),
            peak: figures.burnt_peak,
            pulse: figures.pulse,
            largest_resistance: on * on / figures.burnt_peak,
            smallest_resistance: data.min_resistance,
        })
    }

    /// Whether a resistor bears it.
    pub fn is_met(&self, resistor: &Resistor) -> bool {
        let least = self.smallest_resistance.unwrap_or(0.0);
        (least..=self.largest_resistance).contains(&resistor.resistance)
            && resistor.rated_power >= self.mean
            && resistor.peak_power.is_some_and(|peak| peak >= self.peak)
            && resistor
                .pulse_energy
                .is_none_or(|energy| energy >= self.pulse)
    }

    /// The smallest resistor (rated power, then price) of a catalogue that bears it.
    pub fn proposal<'c>(&self, resistors: &'c [Resistor]) -> Option<&'c Resistor> {
        let price = |r: &Resistor| r.price.unwrap_or(f64::INFINITY);
        let met = resistors.iter().filter(|resistor| self.is_met(resistor));
        met.min_by(|a, b| {
            (a.rated_power.total_cmp(&b.rated_power)).then(price(a).total_cmp(&price(b)))
        })
    }

    /// In words.
    pub fn words(&self) -> String {
        let from = match self.smallest_resistance {
            Some(least) => format!("{} to ", short(least)),
            None => "at most ".to_owned(),
        };
        format!(
            "needs a brake resistor of {from}{} Ω for {} W mean, {} W peak and {} W s a pulse",
            short(self.largest_resistance),
            short(self.mean),
            short(self.peak),
            short(self.pulse)
        )
    }
}
