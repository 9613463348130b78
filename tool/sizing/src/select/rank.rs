//! Objectives for ranking and comparing drives.

use crate::judge::price;
use crate::select::size::{Candidate, Certainty, Group, Selection};
use jred_file::model::rule::Rule;
use jred_file::model::rules::Finding;
use jred_file::units::{Sentence, Vocabulary};

jred_file::words! {
    /// An objective: to be minimised, except for the margin.
    pub enum Objective {
        /// Rated torque times rated speed of the motor.
        Power = "power",
        /// Mass of motor, gearbox and amplifier.
        Mass = "mass",
        /// Price of motor, gearbox, amplifier and the chosen brake resistor, in the currency of the catalogue.
        Price = "price",
        /// Energy supplied by the motor over a cycle; regenerated energy is not deducted.
        Energy = "energy",
        /// Margin of the limit that is closest.
        Margin = "margin",
        /// Largest temperature rise of the winding.
        Temperature = "temperature",
    }
}

impl Objective {
    /// Name of its column, with the unit.
    pub const fn column(self) -> &'static str {
        match self {
            Self::Power => "rated power [W]",
            Self::Mass => "mass [kg]",
            Self::Price => "price",
            Self::Energy => "energy [J]",
            Self::Margin => "margin",
            Self::Temperature => "share of the winding's allowed temperature rise",
        }
    }

    /// Description of the ranking by it, for reports.
    pub const fn ranking(self) -> Sentence {
        match self {
            Self::Power => |Vocabulary { torque, .. }| {
                format!("the smallest motor first (rated {torque} times rated speed)")
            },
            Self::Mass => |_| {
                "the lightest first (motor, gearbox and amplifier), unknown mass last".to_owned()
            },
            Self::Price => |_| {
                "the cheapest first (motor, gearbox, amplifier and the chosen brake resistor), unknown price last".to_owned()
            },
            Self::Energy => |_| {
                "the least energy supplied per cycle first (regenerated energy is not deducted)"
                    .to_owned()
            },
            Self::Margin => {
                |_| "the largest margin first (of the limit that is closest)".to_owned()
            }
            Self::Temperature => {
                |_| "the coolest winding first, unknown temperature last".to_owned()
            }
        }
    }

    /// Its value for a drive; `None` without data in the catalogue.
    pub fn value(self, selection: &Selection, candidate: &Candidate) -> Option<f64> {
        let drive = &candidate.drive;
        let known = match self {
            Self::Power => drive.motor.rated_power(),
            Self::Mass => drive.mass(),
            Self::Price => price(drive, selection.context(candidate).resistor()),
            Self::Energy => Some(selection.cycle.motor_duty(drive).motoring_energy),
            Self::Margin if candidate.outcome.beyond_all_limits > 0 => Some(f64::NEG_INFINITY),
            Self::Margin => Some(1.0 - candidate.outcome.worst_use),
            Self::Temperature => {
                let finding = selection
                    .context(candidate)
                    .findings(selection.rules)
                    .get(Rule::WindingTemperature);
                finding
                    .filter(Finding::is_known)
                    .map(|f| f.value / f.rating)
            }
        };
        known.filter(|value| !value.is_nan())
    }

    /// Its value as a cost to minimise.
    pub(crate) const fn cost(self, value: f64) -> f64 {
        match self {
            Self::Margin => -value,
            _ => value,
        }
    }
}

/// Ranks the suitable drives by an objective, within each certainty. Drives without data come last in their previous order; equal ones keep their
/// order; if no drive has data, the ranking does not change. Returns the number of drives without data.
pub fn rank(selection: &mut Selection, objective: Objective) -> usize {
    selection.complete();
    let fit = selection.fit.known().iter();
    let costs: Vec<Option<f64>> = fit.map(|c| objective.value(selection, c)).collect();
    let unknown = costs.iter().filter(|cost| cost.is_none()).count();
    if unknown == costs.len() {
        return unknown;
    }
    let mut order: Vec<usize> = (0..costs.len()).collect();
    let cost = |k: &usize| {
        let value = costs.get(*k).copied().flatten();
        value.map_or(f64::INFINITY, |value| objective.cost(value))
    };
    // A known cost that is infinite comes before an unknown one.
    let is_unknown = |k: &usize| costs.get(*k).copied().flatten().is_none();
    let certainty = |k: &usize| {
        let candidate = selection.fit.known().get(*k);
        candidate.map(|c| Certainty::of(&c.drive, &c.outcome))
    };
    order.sort_by(|a, b| {
        certainty(a)
            .cmp(&certainty(b))
            .then_with(|| is_unknown(a).cmp(&is_unknown(b)))
            .then_with(|| cost(a).total_cmp(&cost(b)))
    });
    selection.ranking = Some(objective.ranking());
    let ranked = order
        .iter()
        .filter_map(|k| selection.fit.known().get(*k).copied());
    selection.fit = Group::of(ranked.collect());
    unknown
}
