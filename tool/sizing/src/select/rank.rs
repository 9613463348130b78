//! Objectives by which drives are ranked and weighed against each other.

use crate::judge::Context;
use crate::select::size::{Candidate, Group, Selection};
use jred_machine::model::rule::Rule;
use jred_machine::model::rules::Finding;
use jred_machine::units::{Sentence, Vocabulary};

jred_machine::words! {
    /// What a drive is to have little of, or of its margin much.
    pub enum Objective {
        /// Rated torque times rated speed of the motor.
        Power = "power",
        /// Mass of motor, gearbox and amplifier.
        Mass = "mass",
        /// Price of motor, gearbox and amplifier, in the currency of the catalogue.
        Price = "price",
        /// Energy that the motor puts in over a cycle; what comes back is not deducted.
        Energy = "energy",
        /// What is left of the limit that is used most.
        Margin = "margin",
        /// Rise of the winding's temperature at its hottest.
        Temperature = "temperature",
    }
}

impl Objective {
    /// Its name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Power => "power",
            Self::Mass => "mass",
            Self::Price => "price",
            Self::Energy => "energy",
            Self::Margin => "margin",
            Self::Temperature => "temperature",
        }
    }

    /// Name of its column, with the unit.
    pub const fn column(self) -> &'static str {
        match self {
            Self::Power => "rated power [W]",
            Self::Mass => "mass [kg]",
            Self::Price => "price",
            Self::Energy => "energy [J]",
            Self::Margin => "margin",
            Self::Temperature => "share of the winding's allowed rise",
        }
    }

    /// How drives are ranked by it, in words for reports.
    pub const fn ranking(self) -> Sentence {
        match self {
            Self::Power => |Vocabulary { torque, .. }| {
                format!(
                    "drives that break no rule, the smallest motor first (rated {torque} times rated speed)"
                )
            },
            Self::Mass => |_| {
                "drives that break no rule, the lightest first (motor, gearbox and amplifier), those of unknown mass last".to_owned()
            },
            Self::Price => |_| {
                "drives that break no rule, the cheapest first (motor, gearbox and amplifier), those of unknown price last".to_owned()
            },
            Self::Energy => |_| {
                "drives that break no rule, the least energy put in per cycle first (what comes back is not deducted)".to_owned()
            },
            Self::Margin => |_| {
                "drives that break no rule, the largest margin first (what is left of the limit that is used most)".to_owned()
            },
            Self::Temperature => |_| {
                "drives that break no rule, the coolest winding first, those of unknown temperature last".to_owned()
            },
        }
    }

    /// Its value for a drive; `None` where the catalogue does not hold what it is made of.
    pub fn value(self, selection: &Selection, candidate: &Candidate) -> Option<f64> {
        let drive = &candidate.drive;
        let known = match self {
            Self::Power => drive.motor.rated_power(),
            Self::Mass => sum([
                drive.motor.mass,
                part(drive.gearbox, |g| g.mass),
                part(drive.amplifier, |a| a.mass),
            ]),
            Self::Price => sum([
                drive.motor.price,
                part(drive.gearbox, |g| g.price),
                part(drive.amplifier, |a| a.price),
            ]),
            Self::Energy => Some(selection.cycle.motor_duty(drive).motoring_energy),
            Self::Margin if candidate.outcome.beyond_all_limits > 0 => Some(f64::NEG_INFINITY),
            Self::Margin => Some(1.0 - candidate.outcome.worst_use),
            Self::Temperature => {
                let context =
                    Context::new(selection.cycle, selection.site, *drive, candidate.motor);
                let finding = context
                    .findings(selection.rules)
                    .get(Rule::WindingTemperature);
                finding
                    .filter(Finding::is_known)
                    .map(|f| f.value / f.rating)
            }
        };
        known.filter(|value| !value.is_nan())
    }

    /// Its value as something to have little of.
    pub(crate) const fn cost(self, value: f64) -> f64 {
        match self {
            Self::Margin => -value,
            _ => value,
        }
    }
}

/// What a part has, nothing at all where the drive is without it; `None` if it does not say.
fn part<T>(part: Option<&T>, of: impl Fn(&T) -> Option<f64>) -> Option<f64> {
    part.map_or(Some(0.0), of)
}

/// The sum; `None` as soon as one part does not say.
fn sum(parts: [Option<f64>; 3]) -> Option<f64> {
    parts.into_iter().sum()
}

/// Ranks the drives that fit by an objective. Those of which it is not known come last, in their order; equal ones keep
/// theirs; if it is known of none, the ranking stays. Returns of how many it is not known.
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
    order.sort_by(|a, b| {
        is_unknown(a)
            .cmp(&is_unknown(b))
            .then_with(|| cost(a).total_cmp(&cost(b)))
    });
    selection.ranking = Some(objective.ranking());
    let ranked = order
        .iter()
        .filter_map(|k| selection.fit.known().get(*k).copied());
    selection.fit = Group::of(ranked.collect());
    unknown
}
