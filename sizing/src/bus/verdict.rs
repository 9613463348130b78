//! What `jred bus` judges, and what it cannot.

use super::command::Answer;
use super::curve::PowerCurve;
use super::store::BusFigures;
use crate::cli::bus::Bus as Options;
use crate::output::short;
use crate::rule::Sense;

/// A figure of the bus beside its limit.
pub(super) struct BusCheck {
    pub(super) name: &'static str,
    pub(super) unit: &'static str,
    /// NaN: not known.
    pub(super) figure: f64,
    /// `None`: none is stated, but the figure is beyond any.
    pub(super) limit: Option<f64>,
    pub(super) sense: Sense,
}

impl BusCheck {
    /// Whether the figure keeps its limit; `None`: it is not known.
    pub(super) fn holds(&self) -> Option<bool> {
        (!self.figure.is_nan()).then(|| {
            self.limit.is_some_and(|limit| match self.sense {
                Sense::AtMost => self.figure <= limit,
                Sense::AtLeast => self.figure >= limit,
            })
        })
    }
}

impl Answer {
    /// The figures that are judged: highest voltage, mean power, largest power and pulse of the resistor; NaN where one is not
    /// known.
    fn judged(&self, options: &Options) -> [f64; 4] {
        let mut judged = self.found(options);
        // Nothing takes up what comes back, or nobody said what does.
        if judged[0].is_infinite() && self.data.capacitance.is_none() {
            judged[0] = f64::NAN;
        }
        judged
    }

    fn found(&self, options: &Options) -> [f64; 4] {
        let of = |figures: &BusFigures, period: f64| {
            [
                figures.highest,
                figures.burnt / period,
                figures.burnt_peak,
                figures.pulse,
            ]
        };
        let period = self.power.as_ref().map_or(1.0, PowerCurve::period);
        match (&self.in_step, &self.worst) {
            (Some(figures), _) if options.in_step => of(figures, period),
            (Some(_), Some([voltage, resistor])) => {
                let (a, b) = (of(&voltage.figures, period), of(&resistor.figures, period));
                std::array::from_fn(|k| a[k].max(b[k]))
            }
            _ => [
                self.bounds.highest,
                self.bounds.resistor,
                if self.data.resistor.is_some() {
                    self.bounds.back
                } else {
                    0.0
                },
                f64::NAN,
            ],
        }
    }

    /// What is judged; only where there is a limit.
    pub(super) fn checks(&self, options: &Options) -> Vec<BusCheck> {
        let [voltage, mean, peak, pulse] = self.judged(options);
        let resistor = self.data.resistor.as_ref();
        let least = self.data.min_resistance;
        let at_most = |name, unit, figure, limit| (name, unit, figure, limit, Sense::AtMost);
        [
            at_most("bus voltage", "V", voltage, self.data.max_voltage),
            (
                "brake resistance",
                "Ohm",
                resistor.map_or(f64::NAN, |r| r.resistance),
                least.filter(|_| resistor.is_some()),
                Sense::AtLeast,
            ),
            at_most(
                "brake resistor mean power",
                "W",
                mean,
                resistor.map(|r| r.power),
            ),
            at_most(
                "brake resistor peak power",
                "W",
                peak,
                resistor.and_then(|r| r.peak_power),
            ),
            at_most(
                "brake resistor pulse energy",
                "W s",
                pulse,
                resistor.and_then(|r| r.pulse_energy),
            ),
        ]
        .into_iter()
        .map(|(name, unit, figure, limit, sense)| BusCheck {
            name,
            unit,
            figure,
            limit,
            sense,
        })
        // A voltage without bound is beyond any limit.
        .filter(|check| check.limit.is_some() || check.figure.is_infinite())
        .collect()
    }

    /// What could not be checked, and what is missing for it.
    pub(super) fn not_checked(&self, options: &Options) -> Vec<String> {
        let [voltage, _, peak, pulse] = self.judged(options);
        let data = &self.data;
        let mut missing = Vec::new();
        if voltage.is_nan() {
            missing.push(
                "bus voltage: the capacitance of the DC bus is not known, and there is no brake resistor for what comes back"
                    .to_owned(),
            );
        } else if data.max_voltage.is_none() && voltage.is_finite() {
            let rise = data.voltage.filter(|volts| voltage > *volts);
            let rise = rise.map_or(String::new(), |volts| {
                let bare = if data.resistor.is_none() && !data.regenerative {
                    " without a brake resistor"
                } else {
                    ""
                };
                format!(
                    ", and it rises from {} V to {} V{bare}: give max_voltage in [supply]",
                    short(volts),
                    short(voltage)
                )
            });
            missing.push(format!(
                "bus voltage: the highest voltage of the DC bus is not known{rise}"
            ));
        }
        let Some(resistor) = data.resistor.as_ref().filter(|_| peak > 0.0) else {
            return missing;
        };
        let mut without = |known: bool, words: &str| {
            if !known {
                missing.push(words.to_owned());
            }
        };
        without(
            data.min_resistance.is_some(),
            "brake resistance: the smallest resistance that the chopper may switch is not known",
        );
        without(
            resistor.peak_power.is_some(),
            "brake resistor peak power: that of the resistor is not known",
        );
        without(
            resistor.pulse_energy.is_some(),
            "brake resistor pulse energy: that of the resistor is not known",
        );
        without(
            !pulse.is_nan() || resistor.pulse_energy.is_none(),
            "brake resistor pulse energy: the cycles have no common period",
        );
        missing
    }

    /// Whether nothing that was checked is violated; what was not is [named](Self::not_checked).
    pub(super) fn holds(&self, options: &Options) -> bool {
        let checks = self.checks(options);
        self.axes.iter().all(|axis| axis.holds) && checks.iter().all(|c| c.holds() != Some(false))
    }
}
