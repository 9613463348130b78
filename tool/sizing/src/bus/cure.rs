//! Changes that bring a bus within its limits.

use super::analysis::BusAnalysis;
use super::axes::WorstPhases;
use super::conflict::Conflict;
use super::store::{Bus, BusFigures};
use super::verdict::BusQuantity;
use super::{Need, Watch};

/// A single change that is sufficient.
#[derive(Clone, Debug)]
pub struct Cure {
    /// The key to change.
    pub changes: Vec<Change>,
    /// Delay of each axis relative to the first (s), if the phases are to be changed.
    pub phases: Option<Vec<f64>>,
    /// What it does.
    pub kind: CureKind,
}

/// What a cure does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CureKind {
    /// Its changes are all.
    Changes,
    /// The voltage at which the resistor switches on is to be given as well, below the maximum voltage.
    LowerChopper,
    /// That voltage is to be given as well, with a resistance of at most its square over the peak power.
    AnyChopper,
    /// The capacitor stores all regenerated energy: the brake resistor never switches on.
    StoresAll,
    /// Other phases.
    Phases {
        /// Highest voltage of the bus (V).
        highest: f64,
        /// Mean power (W), peak power (W) and pulse energy (J) of the brake resistor, if there is one.
        resistor: Option<[f64; 3]>,
    },
    /// A supply that feeds back.
    Regenerative {
        /// Its peak power (W).
        peak: f64,
        /// Bound of its mean power (W).
        mean: f64,
    },
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
        // Bounds allow a larger resistance below: the voltage may rise to its limit.
        if let Some(need) = self.need.filter(|need| !need.pulse.is_nan()) {
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
        cure.kind = match (top, self.data.chopper_voltage) {
            (None, _) => CureKind::AnyChopper,
            (Some(_), None) => CureKind::LowerChopper,
            (Some(_), Some(_)) => CureKind::Changes,
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
            cure.kind = CureKind::StoresAll;
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
        let [highest, mean, peak, pulse] = figures.judged(period);
        let resistor = self.data.resistor.map(|_| [mean, peak, pulse]);
        Some(Cure {
            changes: Vec::new(),
            phases: Some(phases.clone()),
            kind: CureKind::Phases { highest, resistor },
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
            kind: CureKind::Regenerative {
                peak: self.back(),
                mean: self.bounds.resistor,
            },
        })
    }
}

impl Cure {
    const fn of(changes: Vec<Change>) -> Self {
        Self {
            kind: CureKind::Changes,
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
        let energy = "brake_resistor.pulse_energy";
        changes.push(Change::at_least(energy, need.pulse, "W s"));
        Self::of(changes)
    }
}
