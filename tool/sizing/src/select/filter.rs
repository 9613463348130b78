//! Filter for the drives of a catalogue.

use glob::{MatchOptions, Pattern};
use jred_file::problem;
use jred_file::text::problem::Result;

use crate::catalogue::Catalogue;
use crate::select::named::{is_named, named};
use crate::select::rank::Objective;
use crate::select::size::{Candidate, Group, Selection};

/// Conditions for a drive; if none is set, every drive passes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Filter {
    /// Makers of motor and gearbox, as patterns; empty: any.
    pub makers: Vec<Pattern>,
    /// Keys of motors, as patterns, each also with its optional brake; empty: any.
    pub motors: Vec<Pattern>,
    /// Keys of gearboxes, as patterns; empty: any gearbox, or none.
    pub gearboxes: Vec<Pattern>,
    /// Smallest and largest ratio; a direct drive has 1.
    pub ratio: Option<[f64; 2]>,
    /// Only drives without a gearbox.
    pub direct_only: bool,
    /// Largest mass (kg).
    pub max_mass: Option<f64>,
    /// Largest price, in the currency of the catalogue.
    pub max_price: Option<f64>,
    /// Only this drive, by a name for [`named`].
    pub drive: Option<String>,
}

/// Drives removed by a filter because the catalogue lacks data.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Unknown {
    /// Drives of unknown mass.
    pub mass: usize,
    /// Drives of unknown price.
    pub price: usize,
}

/// Whether a text matches one of the patterns, in either case; without patterns any does.
pub fn matches(patterns: &[Pattern], text: &str) -> bool {
    const EITHER_CASE: MatchOptions = MatchOptions {
        case_sensitive: false,
        require_literal_separator: false,
        require_literal_leading_dot: false,
    };
    patterns.is_empty() || patterns.iter().any(|p| p.matches_with(text, EITHER_CASE))
}

impl Filter {
    /// Removes the motors and gearboxes that no passing drive has.
    ///
    /// # Errors
    /// Nothing remains; no drive has that name.
    pub fn thin(&self, catalogue: &mut Catalogue) -> Result<()> {
        if let Some(name) = &self.drive {
            let (_, drive) = named(catalogue, name)?;
            let motor = drive.motor.key.clone();
            let gearbox = drive.gearbox.map(|gearbox| gearbox.key.clone());
            catalogue.keep(|m| m.key == motor, |g| Some(&g.key) == gearbox.as_ref());
        }
        let (motors, gearboxes) = (catalogue.motors.len(), catalogue.gearboxes.len());
        let [least, most] = self.ratio.unwrap_or([0.0, f64::INFINITY]);
        catalogue.keep(
            |m| {
                let is_named = [m.key.as_str(), m.key_without_brake()]
                    .iter()
                    .any(|key| matches(&self.motors, key));
                is_named && matches(&self.makers, &m.maker)
            },
            |g| {
                !self.direct_only
                    && matches(&self.makers, &g.maker)
                    && matches(&self.gearboxes, &g.key)
                    && (least..=most).contains(&g.ratio)
            },
        );
        if catalogue.motors.is_empty() {
            return Err(problem!(
                help = "in patterns, * matches any text and ? any character; without --maker and --motor all motors are considered",
                "no motor in the catalogue ({motors} in total) passes the filter"
            ));
        }
        if catalogue.gearboxes.is_empty() && !self.allows_direct() {
            return Err(problem!(
                help = "in patterns, * matches any text and ? any character; a direct drive has the ratio 1",
                "no gearbox in the catalogue ({gearboxes} in total) passes the filter"
            ));
        }
        Ok(())
    }

    /// Whether a drive without gearbox may be considered.
    fn allows_direct(&self) -> bool {
        let [least, most] = self.ratio.unwrap_or([0.0, f64::INFINITY]);
        self.gearboxes.is_empty() && (least..=most).contains(&1.0)
    }

    /// Removes drives that do not pass as a whole: direct drives, drives that are too heavy or too expensive, and those
    /// without data for a limited mass or price.
    pub fn sift(&self, selection: &mut Selection) -> Unknown {
        let mut unknown = Unknown::default();
        let whole = self.max_mass.is_some() || self.max_price.is_some() || self.drive.is_some();
        if self.allows_direct() && !whole {
            return unknown;
        }
        let mut sifted = [Vec::new(), Vec::new()];
        // So far only the first drives are sorted, and it is not known in advance which of them remain.
        selection.complete();
        for (kept, from) in sifted.iter_mut().zip([&selection.fit, &selection.refused]) {
            for candidate in from.known() {
                if self.passes(selection, candidate, &mut unknown) {
                    kept.push(*candidate);
                }
            }
        }
        [selection.fit, selection.refused] = sifted.map(Group::of);
        unknown
    }

    fn passes(&self, selection: &Selection, candidate: &Candidate, unknown: &mut Unknown) -> bool {
        if candidate.drive.gearbox.is_none() && !self.allows_direct() {
            return false;
        }
        if (self.drive.as_ref()).is_some_and(|name| !is_named(&candidate.drive, name)) {
            return false;
        }
        let below = |most: Option<f64>, objective: Objective, unknown: &mut usize| {
            most.is_none_or(|most| {
                let value = objective.value(selection, candidate);
                *unknown += usize::from(value.is_none());
                value.is_some_and(|value| value <= most)
            })
        };
        below(self.max_mass, Objective::Mass, &mut unknown.mass)
            && below(self.max_price, Objective::Price, &mut unknown.price)
    }
}
