//! The brake resistor that a bus needs.

use super::axes::Axes;
use super::curve::PowerCurve;
use super::phases::Watch;
use super::store::Bus;
use super::supply::BusData;
use crate::catalogue::Resistor;
use jred_file::model::supply::BrakeResistor;
use jred_file::number::rounding::short;
use jred_file::number::words::counted;

/// A requirement, and whether a resistor misses it.
type Requirement<'a> = (&'static str, Box<dyn Fn(&Resistor) -> bool + 'a>);

/// Requirements for a brake resistor that by itself limits the bus to the chopper voltage.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, schemars::JsonSchema)]
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
    /// Requirements for a power curve. `None` if there are no data for the chopper voltage, if it is not between supply voltage and limit
    /// ([`BusData::conflict`]), or if the capacitor stores all regenerated energy.
    pub fn of(data: &BusData, curve: &PowerCurve) -> Option<Self> {
        let [least, _] = curve.extremes();
        let figures = Self::bus(data, -least)?.run(curve);
        let mean = figures.burnt / curve.period();
        Self::new(data, [mean, figures.burnt_peak, figures.pulse])
    }

    /// Requirements of several axes at any phases: each figure at the phases where it is largest. `None` as for [`Need::of`], or if their common
    /// period is not searched.
    pub fn over(data: &BusData, axes: &Axes, watch: &dyn Watch) -> Option<Self> {
        let axes = axes.on(Self::bus(data, axes.bounds().back)?);
        let period = axes.power(&[])?.period();
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
        (mean > 0.0).then(|| Self {
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

    /// Whether a resistor meets these requirements.
    pub fn is_met(&self, resistor: &Resistor) -> bool {
        let least = self.smallest_resistance.unwrap_or(0.0);
        (least..=self.largest_resistance).contains(&resistor.resistance)
            && resistor.rated_power >= self.mean
            && resistor.peak_power.is_some_and(|peak| peak >= self.peak)
            && resistor
                .pulse_energy
                .is_none_or(|energy| energy >= self.pulse)
    }

    /// The smallest suitable resistor of a catalogue (by rated power, then price), those with the maker's own figures first.
    pub fn proposal<'c>(&self, resistors: &'c [Resistor]) -> Option<&'c Resistor> {
        let price = |r: &Resistor| r.price.unwrap_or(f64::INFINITY);
        let met = resistors.iter().filter(|resistor| self.is_met(resistor));
        met.min_by(|a, b| {
            (b.from_maker.cmp(&a.from_maker))
                .then(a.rated_power.total_cmp(&b.rated_power))
                .then(price(a).total_cmp(&price(b)))
                .then_with(|| a.key.cmp(&b.key))
        })
    }

    /// Why no resistor of a catalogue meets these requirements: how many resistors miss each of them.
    pub fn misses(&self, resistors: &[Resistor]) -> String {
        let least = self.smallest_resistance.unwrap_or(0.0);
        let reasons: [Requirement; 6] = [
            (
                "too small a resistance",
                Box::new(move |r| r.resistance < least),
            ),
            (
                "too large a resistance",
                Box::new(|r| r.resistance > self.largest_resistance),
            ),
            (
                "too little continuous power",
                Box::new(|r| r.rated_power < self.mean),
            ),
            (
                "no data for the peak power",
                Box::new(|r| r.peak_power.is_none()),
            ),
            (
                "too little peak power",
                Box::new(|r| r.peak_power.is_some_and(|peak| peak < self.peak)),
            ),
            (
                "too little pulse energy",
                Box::new(|r| r.pulse_energy.is_some_and(|energy| energy < self.pulse)),
            ),
        ];
        let counts = reasons.iter().filter_map(|(words, misses)| {
            let count = resistors.iter().filter(|r| misses(r)).count();
            (count > 0).then(|| format!("{count} with {words}"))
        });
        let counts: Vec<String> = counts.collect();
        let all = counted(resistors.len(), "brake resistor", "brake resistors");
        format!(
            "none of the {all} of the catalogue fits: {}",
            counts.join(", ")
        )
    }

    /// The message.
    pub fn words(&self) -> String {
        format!("requires a brake resistor of {}", self.figures())
    }

    /// The figures of the message.
    pub fn figures(&self) -> String {
        let largest = short(self.largest_resistance);
        let range = match self.smallest_resistance.map(short) {
            Some(least) if self.is_possible() => format!("{least} to {largest} Ω"),
            Some(least) => {
                format!("at most {largest} Ω (but the chopper requires at least {least} Ω)")
            }
            None => format!("at most {largest} Ω"),
        };
        format!(
            "{range} for {} W mean, {} W peak and {} J a pulse",
            short(self.mean),
            short(self.peak),
            short(self.pulse)
        )
    }
}
