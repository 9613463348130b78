//! The brake resistor that a bus needs.

use super::axes::Axes;
use super::curve::PowerCurve;
use super::phases::Watch;
use super::store::Bus;
use super::supply::BusData;
use crate::catalogue::{Amplifier, Resistor};
use jred_file::model::supply::BrakeResistor;

/// How many resistors of a catalogue miss each requirement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Misses {
    /// All resistors.
    pub resistors: usize,
    /// Too small a resistance.
    pub small_resistance: usize,
    /// Too large a resistance.
    pub large_resistance: usize,
    /// Too little continuous power.
    pub power: usize,
    /// Made for other amplifiers.
    pub other_amplifier: usize,
    /// Too little peak power.
    pub peak_power: usize,
    /// Too little pulse energy.
    pub pulse_energy: usize,
}

/// Requirements for a brake resistor that by itself limits the bus to the chopper voltage.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct Need {
    /// Mean power (W).
    #[serde(rename = "mean [W]")]
    pub mean: f64,
    /// Largest power (W).
    #[serde(rename = "peak [W]")]
    pub peak: f64,
    /// Largest energy without a pause (J); NaN: not known.
    #[serde(rename = "pulse [J]")]
    #[schemars(with = "Option<f64>")]
    pub pulse: f64,
    /// Largest resistance that takes that power at the chopper's voltage (Ω).
    #[serde(rename = "largest resistance [Ohm]")]
    pub largest_resistance: f64,
    /// Smallest resistance that the chopper may switch (Ω).
    #[serde(rename = "smallest resistance [Ohm]")]
    pub smallest_resistance: Option<f64>,
}

impl Need {
    /// Requirements for a power curve. `None` if there are no data for the chopper voltage, if it is not between supply voltage and limit
    /// ([`BusData::conflict`]), or if the capacitor stores all regenerated energy.
    pub fn of(data: &BusData, curve: &PowerCurve) -> Option<Self> {
        let [least, _] = curve.extremes();
        let back = f64::max(-least, curve.stop().peak);
        let figures = Self::bus(data, back)?.run(curve);
        let mean = figures.burnt / curve.period();
        Self::new(data, [mean, figures.burnt_peak, figures.pulse])
    }

    /// Requirements of several axes at any phases: each figure at the phases where it is largest, or, if their common period is not searched, the
    /// bounds that are valid for any phases; the pulse has none. `None` as for [`Need::of`].
    pub fn over(data: &BusData, axes: &Axes, watch: &dyn Watch) -> Option<Self> {
        let axes = axes.on(Self::bus(data, axes.bounds().back)?);
        let Some(period) = axes.power(&[]).map(|power| power.period()) else {
            let bounds = axes.bounds();
            return Self::new(data, [bounds.resistor, bounds.back, f64::NAN]);
        };
        let of = |f: &super::store::BusFigures| [f.burnt, f.burnt_peak, f.pulse];
        let [mean, peak, pulse] = axes.largest(of, watch)?.map(|worst| of(&worst.figures));
        Self::new(data, [mean[0] / period, peak[1], pulse[2]])
    }

    /// The bus with a resistor that takes the largest regenerated power `back`, so that the voltage never exceeds the
    /// chopper voltage.
    fn bus(data: &BusData, back: f64) -> Option<Bus> {
        let on = data.chopper_voltage?;
        if data.conflict().is_some() {
            return None;
        }
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
        with.bus().ok()
    }

    fn new(data: &BusData, [mean, peak, pulse]: [f64; 3]) -> Option<Self> {
        let on = data.chopper_voltage?;
        (peak > 0.0).then(|| Self {
            mean,
            peak,
            pulse,
            largest_resistance: on * on / peak,
            smallest_resistance: data.min_resistance,
        })
    }

    /// Whether any resistance is both allowed for the chopper and able to take the power.
    pub fn is_possible(&self) -> bool {
        self.smallest_resistance
            .is_none_or(|least| least <= self.largest_resistance)
    }

    /// Whether a resistor meets these requirements, as far as its data say.
    pub fn is_met(&self, resistor: &Resistor) -> bool {
        let least = self.smallest_resistance.unwrap_or(0.0);
        (least..=self.largest_resistance).contains(&resistor.resistance)
            && resistor.rated_power >= self.mean
            && resistor.peak_power.is_none_or(|peak| peak >= self.peak)
            // An unknown pulse is left to the check of the bus.
            && !resistor
                .pulse_energy
                .is_some_and(|energy| energy < self.pulse)
    }

    /// The smallest suitable resistor of a catalogue (by rated power, then price), those with a peak power first, then those with the maker's own
    /// figures.
    pub fn proposal<'c>(
        &self,
        resistors: &'c [Resistor],
        amplifier: Option<&Amplifier>,
    ) -> Option<&'c Resistor> {
        let price = |r: &Resistor| r.price.unwrap_or(f64::INFINITY);
        let made_for = |resistor: &&Resistor| resistor.suits(amplifier);
        let met = resistors.iter().filter(made_for);
        let met = met.filter(|resistor| self.is_met(resistor));
        met.min_by(|a, b| {
            (b.peak_power.is_some().cmp(&a.peak_power.is_some()))
                .then(b.from_maker.cmp(&a.from_maker))
                .then(a.rated_power.total_cmp(&b.rated_power))
                .then(price(a).total_cmp(&price(b)))
                .then_with(|| a.key.cmp(&b.key))
        })
    }

    /// Why no resistor of a catalogue meets these requirements.
    pub fn misses(&self, resistors: &[Resistor], amplifier: Option<&Amplifier>) -> Misses {
        let least = self.smallest_resistance.unwrap_or(0.0);
        let count = |misses: &dyn Fn(&Resistor) -> bool| {
            resistors.iter().filter(|resistor| misses(resistor)).count()
        };
        Misses {
            resistors: resistors.len(),
            small_resistance: count(&|r| r.resistance < least),
            large_resistance: count(&|r| r.resistance > self.largest_resistance),
            power: count(&|r| r.rated_power < self.mean),
            other_amplifier: count(&|r| !r.suits(amplifier)),
            peak_power: count(&|r| r.peak_power.is_some_and(|peak| peak < self.peak)),
            pulse_energy: count(&|r| r.pulse_energy.is_some_and(|energy| energy < self.pulse)),
        }
    }
}
