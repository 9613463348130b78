//! The checks of `jred bus`, and the reasons for those without data.

use super::analysis::BusAnalysis;
use super::conflict::Conflict;
use super::curve::PowerCurve;
use jred_file::model::rule::Sense;

/// The value that is checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BusQuantity {
    /// Highest voltage of the bus.
    Voltage,
    /// Resistance of the brake resistor.
    Resistance,
    /// Mean power of the brake resistor.
    Mean,
    /// Largest power of the brake resistor.
    Peak,
    /// Largest energy of the brake resistor without a pause.
    Pulse,
}

/// A value of the bus and its limit.
#[derive(Clone, Copy, Debug)]
pub struct BusCheck {
    /// The value that is checked.
    pub what: BusQuantity,
    /// NaN: unknown.
    pub figure: f64,
    /// `None`: no limit given, but the value exceeds any limit.
    pub limit: Option<f64>,
}

impl BusCheck {
    /// Its name in reports.
    pub const fn name(&self) -> &'static str {
        match self.what {
            BusQuantity::Voltage => "bus voltage",
            BusQuantity::Resistance => "brake resistance",
            BusQuantity::Mean => "brake resistor mean power",
            BusQuantity::Peak => "brake resistor peak power",
            BusQuantity::Pulse => "brake resistor pulse energy",
        }
    }

    /// Unit of figure and limit.
    pub const fn unit(&self) -> &'static str {
        match self.what {
            BusQuantity::Voltage => "V",
            BusQuantity::Resistance => "Ohm",
            BusQuantity::Mean | BusQuantity::Peak => "W",
            BusQuantity::Pulse => "J",
        }
    }

    /// On which side of its limit the figure must be.
    pub const fn sense(&self) -> Sense {
        match self.what {
            BusQuantity::Resistance => Sense::AtLeast,
            _ => Sense::AtMost,
        }
    }

    /// Whether the limit is satisfied; `None`: no data.
    pub fn holds(&self) -> Option<bool> {
        (!self.figure.is_nan()).then(|| {
            self.limit.is_some_and(|limit| match self.sense() {
                Sense::AtMost => self.figure <= limit,
                Sense::AtLeast => self.figure >= limit,
            })
        })
    }
}

/// Missing data and the keys of `[supply]` that would provide them: all keys of one of these lists.
pub struct Open {
    /// Name of the figure.
    pub figure: &'static str,
    /// Lists of keys; all keys of one list are needed.
    pub keys: &'static [&'static [&'static str]],
    /// What is missing.
    pub missing: Missing,
}

/// Data missing for a check of the bus.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Missing {
    /// The capacitance, and there is no brake resistor for the regenerated energy.
    Capacitance,
    /// The maximum voltage.
    MaxVoltage {
        /// The voltages (V) between which the bus rises, if it rises.
        rise: Option<[f64; 2]>,
        /// Whether nothing takes regenerated energy.
        bare: bool,
    },
    /// The voltage at which a brake resistor switches on. Only bounds of its load are known.
    ChopperVoltage {
        /// Bound of the mean power (W).
        mean: f64,
        /// Bound of the peak power (W).
        peak: f64,
    },
    /// The smallest resistance that the chopper may switch.
    MinResistance,
    /// The peak power of the resistor.
    PeakPower,
    /// The pulse energy of the resistor.
    PulseEnergy,
    /// The phases are not searched, and a pulse has no bound.
    NotSearched,
}

impl BusAnalysis {
    /// The values to check, each at its worst phases: maximum voltage, mean power, peak power and pulse of the resistor; NaN
    /// if unknown.
    pub fn judged(&self) -> [f64; 4] {
        let mut judged = self.found();
        // No device takes the regenerated energy, or there are no data.
        if judged[0].is_infinite() && self.data.capacitance.is_none() {
            judged[0] = f64::NAN;
        }
        judged
    }

    fn found(&self) -> [f64; 4] {
        let period = self.power.as_ref().map_or(1.0, PowerCurve::period);
        match (&self.in_step, &self.worst) {
            (Some(figures), _) if self.only_in_step => figures.judged(period),
            (Some(_), Some(worst)) => {
                let each = worst.each_ref().map(|worst| worst.figures.judged(period));
                std::array::from_fn(|k| each.iter().map(|figures| figures[k]).fold(0.0, f64::max))
            }
            _ if self.data.resistor.is_some() => [
                self.bounds.highest,
                self.bounds.resistor,
                self.bounds.back,
                f64::NAN,
            ],
            _ => [self.bounds.highest, 0.0, 0.0, 0.0],
        }
    }

    /// The checks for which there is a limit.
    pub fn checks(&self) -> Vec<BusCheck> {
        let [voltage, mean, peak, pulse] = self.judged();
        let resistor = self.data.resistor.as_ref();
        let least = self.data.min_resistance;
        let check = |what, figure, limit| BusCheck {
            what,
            figure,
            limit,
        };
        [
            check(BusQuantity::Voltage, voltage, self.data.max_voltage),
            check(
                BusQuantity::Resistance,
                resistor.map_or(f64::NAN, |r| r.resistance),
                least.filter(|_| resistor.is_some()),
            ),
            check(BusQuantity::Mean, mean, resistor.map(|r| r.power)),
            check(BusQuantity::Peak, peak, resistor.and_then(|r| r.peak_power)),
            check(
                BusQuantity::Pulse,
                pulse,
                resistor.and_then(|r| r.pulse_energy),
            ),
        ]
        .into_iter()
        // An unbounded voltage exceeds any limit.
        .filter(|check| check.limit.is_some() || check.figure.is_infinite())
        .collect()
    }

    /// The checks that are violated.
    pub fn failed(&self) -> Vec<BusCheck> {
        let mut checks = self.checks();
        checks.retain(|check| check.holds() == Some(false));
        checks
    }

    /// A conflict of voltages that makes every brake resistor useless; `None` if no resistor is needed.
    pub fn conflict(&self) -> Option<Conflict> {
        let asked =
            |check: &BusCheck| matches!(check.what, BusQuantity::Voltage | BusQuantity::Resistance);
        let needed = self.judged()[0].is_nan() || self.failed().iter().any(asked);
        self.data.conflict().filter(|_| needed)
    }

    /// Checks without data: the missing data, and the keys that provide them.
    pub fn open(&self) -> Vec<Open> {
        let [voltage, _, peak, pulse] = self.judged();
        let data = &self.data;
        let mut open = Vec::new();
        let mut add = |figure, keys, missing| {
            open.push(Open {
                figure,
                keys,
                missing,
            });
        };
        if voltage.is_nan() {
            add(
                "bus voltage",
                &[
                    &["capacitance"],
                    &["chopper_voltage", "brake_resistor"],
                    &["regenerative"],
                ],
                Missing::Capacitance,
            );
        }
        if data.max_voltage.is_none() && !voltage.is_infinite() {
            let from = data.voltage.filter(|volts| voltage > *volts);
            let missing = Missing::MaxVoltage {
                rise: from.map(|from| [from, voltage]),
                bare: data.resistor.is_none() && !data.regenerative,
            };
            add("bus voltage", &[&["max_voltage"]], missing);
        }
        if voltage.is_nan() && data.chopper_voltage.is_none() {
            let missing = Missing::ChopperVoltage {
                mean: self.bounds.resistor,
                peak: self.bounds.back,
            };
            add("brake resistor", &[&["chopper_voltage"]], missing);
        }
        let Some(resistor) = data.resistor.as_ref().filter(|_| peak > 0.0) else {
            return open;
        };
        if data.min_resistance.is_none() {
            add(
                "brake resistance",
                &[&["min_resistance"]],
                Missing::MinResistance,
            );
        }
        if resistor.peak_power.is_none() {
            add(
                "brake resistor peak power",
                &[&["brake_resistor.peak_power"]],
                Missing::PeakPower,
            );
        }
        if resistor.pulse_energy.is_none() {
            add(
                "brake resistor pulse energy",
                &[&["brake_resistor.pulse_energy"]],
                Missing::PulseEnergy,
            );
        } else if pulse.is_nan() {
            add("brake resistor pulse energy", &[], Missing::NotSearched);
        }
        open
    }

    /// Whether every check with data is satisfied; [`open`](Self::open) lists the others.
    pub fn holds(&self) -> bool {
        self.axes.iter().all(|axis| axis.holds) && self.failed().is_empty()
    }

    /// Distance of the brake resistor from each violated requirement.
    pub fn lacks(&self) -> Vec<(BusQuantity, f64)> {
        let failed = self.failed().into_iter();
        let own = failed.filter(|check| check.what != BusQuantity::Voltage);
        own.filter_map(|check| Some((check.what, (check.figure - check.limit?).abs())))
            .collect()
    }
}
