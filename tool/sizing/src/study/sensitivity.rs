//! How the rules of a drive depend on the quantities of the machine file: the derivative of each use of a limit, and how far each quantity may change
//! until a rule is violated.
//!
//! Every number with a unit, and every plain number, is changed by a relative ε with all others fixed; the machine is read and judged again. The
//! derivative of a rule's share of its limit u is the central difference (u(ε) − u(−ε))/(2ε), extrapolated from ε and ε/2 to (4·D(ε/2) − D(ε))/3,
//! whose error grows with ε⁴. The difference of two such values is given as its uncertainty.
//!
//! A count, such as a number of teeth, is changed by one: its derivative is (u(n + 1) − u(n − 1))·n/2, its uncertainty half the difference of the two
//! steps. A quantity that is zero has no relative change, and some quantities cannot be changed alone (the moves of a cycle add up to whole turns).
//! These are listed with the reason.

mod mover;

use mover::{Mover, load};

use crate::judge::Findings;
use crate::judge::broken;
use crate::study::chosen::ChosenDrive;
use crate::study::common::Study;
use crate::threads;
use jred_file::model::rule::Rule;
use jred_file::model::rules::{Limit, RuleSet};
use jred_file::text::problem::{Problem, Result};

/// One rule's dependence on one quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slope {
    /// The rule.
    pub rule: Rule,
    /// Whether it can refuse a drive, or only warns.
    pub refuses: bool,
    /// Change of its share of the limit per relative change of the quantity: du/dε.
    pub slope: f64,
    /// Difference of the two estimates of the slope.
    pub uncertainty: f64,
}

/// How far a quantity may change in one direction.
#[derive(Debug)]
pub enum Room {
    /// No violation within the search range: this relative change.
    AtLeast(f64),
    /// Up to this relative change; beyond it, the rule is violated.
    UpTo(f64, Rule),
    /// Up to this relative change; beyond it, the machine file is invalid for this reason.
    Refused(f64, Problem),
    /// A rule is already violated.
    Broken,
}

impl Room {
    /// The allowed relative change.
    pub const fn change(&self) -> f64 {
        match self {
            Self::AtLeast(change) | Self::UpTo(change, _) | Self::Refused(change, _) => *change,
            Self::Broken => 0.0,
        }
    }
}

/// Why a quantity is not varied.
#[derive(Debug)]
pub enum Fixed {
    /// Zero has no relative change.
    Zero,
    /// The machine file with a changed quantity is invalid.
    Refused(Problem),
    /// The machine file with a count one less is invalid.
    OneLess(Problem),
    /// The machine file with a count one more is invalid.
    OneMore(Problem),
}

/// Dependence on one quantity.
#[derive(Debug)]
pub struct Dependence {
    /// Index of the quantity in the document.
    pub quantity: usize,
    /// Whether it is a count, which is changed by one.
    pub whole: bool,
    /// The slopes of the rules that can be checked.
    pub slopes: Vec<Slope>,
    /// Room to smaller and to larger values.
    pub room: [Room; 2],
}

impl Dependence {
    /// Whether it affects no rule, and no rule limits its change.
    pub fn is_idle(&self) -> bool {
        let still = self.slopes.iter().all(|slope| slope.slope == 0.0);
        still
            && self
                .room
                .iter()
                .all(|room| matches!(room, Room::AtLeast(_) | Room::Broken))
    }

    /// The rule that depends on it most: of the rules that can refuse the drive, or else of those that only warn.
    pub fn steepest(&self) -> Option<Slope> {
        let slopes = self.slopes.iter().copied();
        let key = |slope: &Slope| (slope.refuses && slope.slope != 0.0, slope.slope.abs());
        slopes.max_by(|a, b| {
            let (a, b) = (key(a), key(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        })
    }
}

/// Result of a sensitivity analysis.
#[derive(Debug)]
pub struct Sensitivity {
    /// The original shares of the limits.
    pub shares: Vec<(Rule, f64)>,
    /// By quantity; the one that affects a rule most comes first.
    pub dependences: Vec<Dependence>,
    /// Quantities that were not changed, and why.
    pub fixed: Vec<(usize, Fixed)>,
    /// Number of quantities in `[simulation]` and `[tolerance]`, which are omitted because no rule depends on them.
    pub left_out: usize,
}

/// Settings of a sensitivity analysis.
#[derive(Clone, Copy, Debug)]
pub struct Reach {
    /// Relative change of the differences.
    pub change: f64,
    /// Largest relative change in the search for the first violation.
    pub most: f64,
}

/// Share of the limit (or of the warning limit, if there is no other) of every rule that has a limit and can be checked; infinite if a limit of zero
/// is violated.
pub fn used(rules: &RuleSet, findings: &Findings) -> impl Iterator<Item = (Rule, f64)> {
    let known = findings
        .iter()
        .filter(|(rule, finding)| finding.is_known() && rules.limit(*rule) != Limit::default());
    known.map(|(rule, finding)| (rule, rules.use_shown(rule, finding)))
}

/// The shares that can be compared.
pub fn shares(rules: &RuleSet, findings: &Findings) -> Vec<(Rule, f64)> {
    let finite = used(rules, findings).filter(|(_, used)| used.is_finite());
    finite.collect()
}

impl Sensitivity {
    /// Changes every quantity of the study's machine file; `progress` is called for each.
    ///
    /// # Errors
    /// The original machine is refused.
    pub fn new(
        study: &Study,
        one: &ChosenDrive,
        reach: Reach,
        progress: impl Fn() + Sync,
    ) -> Result<Self> {
        let machine = study.machine(&[])?;
        let findings = one.findings(&machine);
        let rules = &machine.file.rules;
        let holds = broken(rules, &findings).is_none();
        let load = load(rules, &findings);
        // The free motion of `[simulation]` and the scatter of `[tolerance]` do not affect sizing.
        let apart = |path: &str| {
            ["simulation.", "tolerance."]
                .iter()
                .any(|at| path.starts_with(at))
        };
        let quantities = study.document.quantities().iter().enumerate();
        let quantities: Vec<_> = quantities.filter(|(_, q)| !apart(&q.path)).collect();
        let left_out = study.document.quantities().len() - quantities.len();
        let found: Vec<(usize, Result<Dependence, Fixed>)> =
            threads::map(&quantities, |&(index, quantity)| {
                let mover = Mover {
                    study,
                    one,
                    quantity: index,
                    number: quantity.number(),
                    unit: quantity.unit(),
                    load,
                };
                let dependence = if quantity.number() == 0.0 {
                    Err(Fixed::Zero)
                } else {
                    mover.dependence(reach, holds)
                };
                progress();
                (index, dependence)
            });
        let (mut dependences, mut fixed) = (Vec::new(), Vec::new());
        for (index, dependence) in found {
            match dependence {
                Ok(dependence) => dependences.push(dependence),
                Err(why) => fixed.push((index, why)),
            }
        }
        let steepest = |d: &Dependence| d.steepest().map_or(0.0, |slope| slope.slope.abs());
        dependences.sort_by(|a, b| steepest(b).total_cmp(&steepest(a)));
        Ok(Self {
            shares: shares(rules, &findings),
            dependences,
            fixed,
            left_out,
        })
    }

    /// Whether the original drive already violates a rule, so that there is no room.
    pub fn is_broken(&self) -> bool {
        let mut all = self.dependences.iter();
        all.any(|d| matches!(d.room, [Room::Broken, _] | [_, Room::Broken]))
    }

    /// The quantity with the smallest change that violates a rule, and its room.
    pub fn first_to_break(&self) -> Option<(usize, &Room)> {
        let rooms = self
            .dependences
            .iter()
            .flat_map(|d| d.room.iter().map(|room| (d.quantity, room)));
        let breaking = rooms.filter(|(_, room)| matches!(room, Room::UpTo(..)));
        breaking.min_by(|a, b| a.1.change().abs().total_cmp(&b.1.change().abs()))
    }
}
