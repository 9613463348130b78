//! Changes that bring a bus within its limits.

use std::fmt::Write as _;

use super::analysis::BusAnalysis;
use super::axes::WorstPhases;
use super::conflict::Conflict;
use super::store::{Bus, BusFigures};
use super::verdict::BusQuantity;
use super::{Need, Watch};
use jred_file::number::rounding::short;

/// A single change that is sufficient.
#[derive(Clone, Debug)]
pub struct Cure {
    /// The key to change.
    pub changes: Vec<Change>,
    /// Delay of each axis relative to the first (s), if the phases are to be changed.
    pub phases: Option<Vec<f64>>,
    /// The message.
    pub words: String,
}

/// A key and its required value.
#[derive(Clone, Debug)]
pub struct Change {
    /// The key of `[supply]`.
    pub key: &'static str,
    /// The required value.
    pub bound: Bound,
    /// Unit of the bound.
    pub unit: &'static str,
}

/// A required value.
#[derive(Clone, Copy, Debug)]
pub enum Bound {
    /// Not below.
    AtLeast(f64),
    /// Not above.
    AtMost(f64),
}

impl Change {
    const fn at_least(key: &'static str, value: f64, unit: &'static str) -> Self {
        Self {
            key,
            bound: Bound::AtLeast(value),
            unit,
        }
    }

    const fn at_most(key: &'static str, value: f64, unit: &'static str) -> Self {
        Self {
            key,
            bound: Bound::AtMost(value),
            unit,
        }
    }

    fn words(&self) -> String {
        // Rounded to the safe side.
        let (word, value) = match self.bound {
            Bound::AtLeast(value) => ("at least", rounded(value, f64::ceil)),
            Bound::AtMost(value) => ("at most", rounded(value, f64::floor)),
        };
        format!("{} {word} {} {}", self.key, short(value), self.unit)
    }
}

/// Four digits, to one side.
fn rounded(value: f64, towards: fn(f64) -> f64) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let exponent = value.abs().log10().floor() as i32 - 3;
    // Whole powers of ten are exact, their inverses are not.
    if exponent > 0 {
        let unit = 10f64.powi(exponent);
        towards(value / unit) * unit
    } else {
        let unit = 10f64.powi(-exponent);
        towards(value * unit) / unit
    }
}

/// Largest use of the limits of a bus: voltage, mean power, peak power and pulse energy.
pub fn share(limits: [Option<f64>; 4], figures: &BusFigures, period: f64) -> f64 {
    let shares = figures.judged(period).into_iter().zip(limits);
    shares
        .filter_map(|(figure, limit)| Some(figure / limit?))
        .fold(0.0, f64::max)
}

impl BusAnalysis {
    /// The limits of [`share`].
    pub fn limits(&self) -> [Option<f64>; 4] {
        let resistor = self.data.resistor;
        [
            self.data.max_voltage,
            resistor.map(|r| r.power),
            resistor.and_then(|r| r.peak_power),
            resistor.and_then(|r| r.pulse_energy),
        ]
    }

    /// Changes each of which is sufficient by itself; empty if every limit is satisfied.
    pub fn cures(&self, watch: &dyn Watch) -> Vec<Cure> {
        if self.failed().is_empty() {
            return Vec::new();
        }
        let each = [
            self.resistor_cure(),
            self.capacitance_cure(watch),
            self.phase_cure(),
            self.supply_cure(),
        ];
        each.into_iter().flatten().collect()
    }

    fn fails(&self, what: BusQuantity) -> bool {
        self.failed().iter().any(|check| check.what == what)
    }

    /// Largest regenerated power (W).
    fn back(&self) -> f64 {
        match &self.power {
            Some(power) if self.only_in_step => (-power.extremes()[0]).max(0.0),
            _ => self.bounds.back,
        }
    }

    fn resistor_cure(&self) -> Option<Cure> {
        let [_, mean, peak, pulse] = self.judged();
        let other = self.fails(BusQuantity::Voltage) || self.fails(BusQuantity::Resistance);
        if self.data.resistor.is_some() && !other {
            let figures = [
                (BusQuantity::Mean, "brake_resistor.power", mean, "W"),
                (BusQuantity::Peak, "brake_resistor.peak_power", peak, "W"),
                // The unit of the machine file.
                (
                    BusQuantity::Pulse,
                    "brake_resistor.pulse_energy",
                    pulse,
                    "W s",
                ),
            ];
            let changes = figures.into_iter().filter_map(|(what, key, value, unit)| {
                let fails = self.fails(what);
                fails.then(|| Change::at_least(key, value, unit))
            });
            return Some(Cure::of(changes.collect()));
        }
        if self.data.resistor.is_some() && mean == 0.0 {
            // It never switches on, whatever its resistance.
            let least = self.data.min_resistance?;
            let change = Change::at_least("brake_resistor.resistance", least, "Ohm");
            return (!self.fails(BusQuantity::Voltage)).then(|| Cure::of(vec![change]));
        }
        if let Some(need) = self.need {
            return need.is_possible().then(|| Cure::resistor(&need));
        }
        if self.data.regenerative || self.data.conflict().is_some() {
            return None;
        }
        // Without a search: sufficient for any phases.
        let back = self.back();
        let mut changes = Vec::new();
        let top = self.data.max_voltage.or(self.data.chopper_voltage);
        if let Some(top) = top {
            let largest = top * top / back;
            changes.push(Change::at_most("brake_resistor.resistance", largest, "Ohm"));
            if let Some(least) = self.data.min_resistance {
                if least > largest {
                    return None;
                }
                changes.push(Change::at_least("brake_resistor.resistance", least, "Ohm"));
            }
        }
        changes.push(Change::at_least(
            "brake_resistor.power",
            self.bounds.resistor,
            "W",
        ));
        changes.push(Change::at_least("brake_resistor.peak_power", back, "W"));
        let mut cure = Cure::of(changes);
        cure.words += match (top, self.data.chopper_voltage) {
            (None, _) => {
                ", with a chopper_voltage and a resistance of at most its square over the peak_power"
            }
            (Some(_), None) => ", with a chopper_voltage below max_voltage",
            (Some(_), Some(_)) => "",
        };
        Some(cure)
    }

    /// A capacitor that stores all regenerated energy: ½·C·(U² − U₀²) is the largest stored energy, whatever C is. With a brake resistor U is its
    /// switch-on voltage, if that is not above the maximum.
    fn capacitance_cure(&self, watch: &dyn Watch) -> Option<Cure> {
        let u0 = self.data.voltage?;
        let chopper = self.data.resistor.and(self.data.chopper_voltage);
        let top = [chopper, self.data.max_voltage].into_iter().flatten();
        let top = top.reduce(f64::min).filter(|top| *top > u0)?;
        let known = self.data.capacitance.filter(|c| *c > 0.0)?;
        let bare = Bus {
            resistor: None,
            ..*self.shared.bus()
        };
        let highest = match (&self.power, self.data.resistor) {
            (Some(power), _) if self.only_in_step => bare.run(power).highest,
            (_, None) => self.judged()[0],
            (Some(_), Some(_)) => {
                let [worst] = self.shared.on(bare).largest(|f| [f.highest], watch)?;
                worst.figures.highest
            }
            (None, Some(_)) => self.shared.on(bare).bounds().highest,
        };
        if !highest.is_finite() {
            return None;
        }
        let needed = known * (highest * highest - u0 * u0) / (top * top - u0 * u0);
        let change = Change {
            key: "capacitance",
            bound: Bound::AtLeast(1e6 * needed),
            unit: "uF",
        };
        let mut cure = Cure::of(vec![change]);
        if self.data.resistor.is_some() {
            cure.words +=
                ", which stores all regenerated energy: the brake resistor never switches on";
        }
        // A resistance that is too small for the chopper stays too small.
        (!self.fails(BusQuantity::Resistance)).then_some(cure)
    }

    fn phase_cure(&self) -> Option<Cure> {
        let WorstPhases { phases, figures } = self.calmest.as_ref()?;
        let period = self.power.as_ref()?.period();
        let limits = self.limits();
        if phases.len() < 2
            || limits == [None; 4]
            || figures.highest.is_infinite()
            || share(limits, figures, period) > 1.0
            || self.resistance_is_too_small()
        {
            return None;
        }
        let starts = phases.iter().enumerate().skip(1);
        let starts = starts.map(|(k, phase)| format!("axis {} {} s", k + 1, short(*phase)));
        let starts: Vec<String> = starts.collect();
        let mut words = format!(
            "axes synchronised, {} after axis 1: bus up to {} V",
            starts.join(", "),
            short(figures.highest)
        );
        if self.data.resistor.is_some() {
            let _ = write!(
                words,
                ", brake resistor {} W mean, {} W peak, {} J a pulse",
                short(figures.burnt / period),
                short(figures.burnt_peak),
                short(figures.pulse)
            );
        }
        Some(Cure {
            changes: Vec::new(),
            phases: Some(phases.clone()),
            words,
        })
    }

    fn resistance_is_too_small(&self) -> bool {
        let least = self.data.min_resistance.unwrap_or(0.0);
        self.data.resistor.is_some_and(|r| r.resistance < least)
    }

    fn supply_cure(&self) -> Option<Cure> {
        let already = matches!(
            self.data.conflict(),
            Some(Conflict::Supply { supply, highest }) if supply > highest
        );
        let helps = !self.data.regenerative && !already && self.back() > 0.0;
        helps.then(|| Cure {
            changes: Vec::new(),
            phases: None,
            words: format!(
                "regenerative = true without a brake resistor: a supply that feeds back {} W peak, at most {} W mean",
                short(rounded(self.back(), f64::ceil)),
                short(rounded(self.bounds.resistor, f64::ceil))
            ),
        })
    }
}

impl Cure {
    fn of(changes: Vec<Change>) -> Self {
        let each: Vec<String> = changes.iter().map(Change::words).collect();
        Self {
            words: each.join(", "),
            phases: None,
            changes,
        }
    }

    fn resistor(need: &Need) -> Self {
        let mut changes = vec![Change::at_most(
            "brake_resistor.resistance",
            need.largest_resistance,
            "Ohm",
        )];
        if let Some(least) = need.smallest_resistance {
            changes.push(Change::at_least("brake_resistor.resistance", least, "Ohm"));
        }
        changes.push(Change::at_least("brake_resistor.power", need.mean, "W"));
        changes.push(Change::at_least(
            "brake_resistor.peak_power",
            need.peak,
            "W",
        ));
        changes.push(Change::at_least(
            "brake_resistor.pulse_energy",
            need.pulse,
            "W s",
        ));
        Self::of(changes)
    }
}
