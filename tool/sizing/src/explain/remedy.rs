//! The changes that would make a drive satisfy every rule, or how far each quantity may change before a rule is violated.
//!
//! One quantity is changed at a time, with all others fixed: the gear ratio (with the gearbox's other data), the cycle time, the moving masses, the
//! process loads. For a refused drive only practical values are tried ([`Lever::choices`]). For a drive that fits, many more are tried, because the
//! range shows its margin.
//!
//! The range in which every rule is satisfied is searched on a grid, outwards from the current value, and its ends by bisection to 1e-10. The duty at
//! every value is exact ([`DutyModel`]). A range narrower than the grid's step (3 % of the ratio, a tenth of the others) is found if it lies around the
//! value at which the worst rule uses least.
//!
//! Cost: up to some hundred judgements of one drive for each quantity. Where instants were added only to resolve peaks, most judgements omit them: a
//! rule that is violated without them is violated ([`DutyModel::outline`]). Between two values of the grid there is no search if the result is worse on
//! both sides.

use jred::error::Error;
use jred_file::math;
use serde::Serialize;

use super::duty_model::DutyModel;
use super::seek::{DriveResult, Judge};
use crate::catalogue::Drive;
use crate::catalogue::{Gearbox, MotorKind};
use crate::cycle::Cycle;
use crate::judge::Context;
use crate::motor::envelope::MotorLimits;
use crate::select::size::{Candidate, Selection};
use jred_analysis::duty::Duty;
use jred_analysis::duty::mechanics::Alteration;
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleSet;
use jred_file::model::rules::RuleVerdict;
use jred_file::model::site::Site;
use jred_file::units::Vocabulary;

/// The quantity to change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Lever {
    /// Ratio of the gearbox.
    GearRatio,
    /// Ratio of a gearbox without losses, inertia and limits, for a motor without a gearbox.
    IdealGearbox,
    /// Cycle time, as a factor.
    CycleTime,
    /// Masses and inertias of the mechanism, as a factor.
    MovingMass,
    /// Process loads, as a factor.
    ProcessLoad,
}

impl Lever {
    const ALL: [Self; 5] = [
        Self::GearRatio,
        Self::IdealGearbox,
        Self::CycleTime,
        Self::MovingMass,
        Self::ProcessLoad,
    ];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::GearRatio => "gear ratio",
            Self::IdealGearbox => "ratio of an ideal gearbox",
            Self::CycleTime => "cycle time",
            Self::MovingMass => "moving masses",
            Self::ProcessLoad => "process loads",
        }
    }

    /// Practical values that could make a refused drive suitable, from `now`: a third to three times the gear ratio, a gearbox of 1 to 100, half to
    /// twice the cycle time, masses and process loads down to a half.
    pub const fn choices(self, now: f64) -> [f64; 2] {
        match self {
            Self::GearRatio => [now / 3.0, now * 3.0],
            Self::IdealGearbox => [1.0, 100.0],
            Self::CycleTime => [0.5, 2.0],
            Self::MovingMass | Self::ProcessLoad => [0.5, 1.0],
        }
    }

    /// The values of the grid, rising.
    pub(super) fn grid(self) -> Vec<f64> {
        let log = |from: f64, to: f64, steps: u32| {
            (0..=steps).map(move |k| from * math::pow(to / from, f64::from(k) / f64::from(steps)))
        };
        match self {
            Self::GearRatio | Self::IdealGearbox => log(0.2, 500.0, 264).collect(),
            Self::CycleTime => log(0.05, 100.0, 76).collect(),
            Self::MovingMass | Self::ProcessLoad => {
                let below = (0..20).map(|k| f64::from(k) / 20.0);
                below.chain(log(1.0, 100.0, 46)).collect()
            }
        }
    }
}

/// An end of the range in which every rule is satisfied.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Edge {
    /// The value.
    pub value: f64,
    /// The rule at its limit there; `None`: the end of the tried values.
    pub rule: Option<Rule>,
}

/// The result of changing one quantity by itself.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Remedy {
    /// The quantity that is changed.
    pub lever: Lever,
    /// Its current value: the ratio, or 1.
    pub now: f64,
    /// Range in which every rule is satisfied: the one that contains the current value, or the closest one; `None` if no practical value helps.
    pub range: Option<[Edge; 2]>,
    /// If no value helps: the best value tried, and the rule violated there.
    pub best: Option<Edge>,
    /// The share of its limit that this rule uses there.
    pub best_use: Option<f64>,
}

impl Remedy {
    /// The closest value at which every rule is satisfied, and the rule at its limit there; `None` if no value helps or the current one is suitable.
    pub fn change(&self) -> Option<Edge> {
        let [low, high] = self.range?;
        if self.now < low.value {
            Some(low)
        } else if self.now > high.value {
            Some(high)
        } else {
            None
        }
    }
}

/// A rule that a drive violates.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, schemars::JsonSchema)]
pub struct RuleViolation {
    /// The rule.
    pub rule: Rule,
    /// The share of its limit that is used; `None` if the limit is zero there, or for a yes-or-no rule.
    pub used: Option<f64>,
    /// The limit as a share of the rating.
    pub limit: f64,
    /// The limit that the drive would satisfy; `None` if no limit would be sufficient, or for a yes-or-no rule.
    pub needed: Option<f64>,
}

/// Changes that would make one drive suitable.
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
pub struct Remedies {
    /// The drive.
    pub drive: String,
    /// Names and units of its figures.
    #[serde(skip)]
    pub words: &'static Vocabulary,
    /// Whether it already satisfies every rule; the ranges then show how far each quantity may change.
    pub holds: bool,
    /// The rules that it violates.
    pub misses: Vec<RuleViolation>,
    /// One entry for each quantity.
    pub remedies: Vec<Remedy>,
}

/// Judges a drive by all rules, or by some of them.
type Rules = fn(&Context, &RuleSet) -> DriveResult;

impl Remedies {
    /// Computes the changes for `drive`, without brake resistors to choose from.
    pub fn new(
        altered: &DutyModel,
        site: &Site,
        rules: &RuleSet,
        drive: Drive,
        motor: &MotorLimits,
    ) -> Self {
        let cycle = Cycle::new(altered.original());
        Self::of(altered, rules, &Context::new(&cycle, site, drive, motor))
    }

    /// Computes the changes for a drive of a selection.
    pub fn of_candidate(selection: &Selection, altered: &DutyModel, candidate: &Candidate) -> Self {
        let cycle = Cycle::new(altered.original());
        let context = selection.context(candidate);
        Self::of(altered, selection.rules, &context.in_cycle(&cycle))
    }

    fn of(altered: &DutyModel, rules: &RuleSet, context: &Context) -> Self {
        let Context { drive, .. } = *context;
        let outline = altered.outline(Alteration::default());
        let outline = outline.map(|duty| Cycle::new(&duty));
        let misses = misses(context, rules);
        let free = |lever: &Lever| match lever {
            Lever::GearRatio => drive.gearbox.is_some(),
            Lever::IdealGearbox => drive.gearbox.is_none() && drive.motor.kind == MotorKind::Rotary,
            Lever::ProcessLoad => {
                let mut instants = altered.original().instants.iter();
                instants.any(|i| i.terms.process != 0.0)
            }
            _ => true,
        };
        let exact = |lever: &Lever| {
            altered.scales() || matches!(lever, Lever::GearRatio | Lever::IdealGearbox)
        };
        let levers = Lever::ALL.into_iter().filter(free).filter(exact);
        let remedies = levers.map(|lever| {
            let at_ratio = |context: &Context<'_>, ratio: f64, judge: Rules| {
                let gearbox = with_ratio(drive.gearbox, ratio);
                let gearbox = Some(&gearbox);
                judge(&context.with(Drive { gearbox, ..drive }), rules)
            };
            let of = |duty: &Duty, judge: Rules| {
                let cycle = Cycle::new(duty);
                judge(&context.in_cycle(&cycle), rules)
            };
            let state = |value: f64| match lever {
                Lever::GearRatio | Lever::IdealGearbox => at_ratio(context, value, DriveResult::of),
                _ => of(&altered.duty(lever.alteration(value)), DriveResult::of),
            };
            let at_best = |value: f64| match lever {
                Lever::GearRatio | Lever::IdealGearbox => {
                    let cycle = outline.as_ref()?;
                    Some(at_ratio(
                        &context.in_cycle(cycle),
                        value,
                        DriveResult::direct,
                    ))
                }
                _ => {
                    let duty = altered.outline(lever.alteration(value))?;
                    Some(of(&duty, DriveResult::direct))
                }
            };
            let now = match lever {
                Lever::GearRatio | Lever::IdealGearbox => drive.ratio(),
                _ => 1.0,
            };
            Remedy::find(lever, now, &Judge { state, at_best })
        });
        Self {
            drive: drive.name(),
            words: drive.motor.kind.vocabulary(),
            holds: misses.is_empty(),
            remedies: remedies.collect(),
            misses,
        }
    }

    /// The `count` closest refused drives of a selection, each with its changes.
    ///
    /// # Errors
    /// The mechanism cannot be placed somewhere.
    pub fn of_nearest(
        selection: &Selection,
        altered: &DutyModel,
        count: usize,
    ) -> Result<Vec<Self>, Error> {
        let nearest = selection.first_refused(count);
        Ok(nearest
            .iter()
            .map(|candidate| Self::of_candidate(selection, altered, candidate))
            .collect())
    }
}

impl Lever {
    fn alteration(self, value: f64) -> Alteration {
        let mut by = Alteration::default();
        match self {
            Self::GearRatio | Self::IdealGearbox => {}
            Self::CycleTime => by.time = value,
            Self::MovingMass => by.mass = value,
            Self::ProcessLoad => by.process = value,
        }
        by
    }
}

/// The rules that a drive violates, the most violated first. As in the ranking, rules that follow time are only evaluated if no other rule is
/// violated.
fn misses(context: &Context, rules: &RuleSet) -> Vec<RuleViolation> {
    let (findings, _) = context.ranked(rules);
    let broken = findings
        .iter()
        .filter(|(rule, finding)| rules.verdict(*rule, *finding) == RuleVerdict::Fail);
    let mut misses: Vec<RuleViolation> = broken
        .filter_map(|(rule, finding)| {
            let limit = rules.limit(rule).fail?;
            // Another limit does not make a part fit for a supply that it is not made for.
            let share = |x: f64| Some(x).filter(|x| x.is_finite() && !rule.is_yes_or_no());
            Some(RuleViolation {
                rule,
                used: share(rules.use_of_limit(rule, finding)),
                limit,
                needed: share(finding.value / finding.rating),
            })
        })
        .collect();
    let far = |miss: &RuleViolation| miss.used.unwrap_or(f64::INFINITY);
    misses.sort_by(|a, b| far(b).total_cmp(&far(a)));
    misses
}

/// The gearbox with another ratio; for a direct drive, an ideal gearbox of this ratio.
pub(super) fn with_ratio(gearbox: Option<&Gearbox>, ratio: f64) -> Gearbox {
    let bare = || Gearbox {
        key: "ideal".to_owned(),
        ratio,
        from_maker: true,
        ..Gearbox::default()
    };
    let mut gearbox = gearbox.cloned().unwrap_or_else(bare);
    gearbox.ratio = ratio;
    gearbox
}
