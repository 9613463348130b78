//! What would have to change for a drive to hold every rule, or how far it may change before it no longer does.
//!
//! One quantity is changed at a time, all else kept: the gear ratio (the gearbox's other data as they are), the cycle time,
//! the moving masses, the process loads. The range in which every rule holds is sought on a grid, outwards from the
//! present value, and its ends by bisection to 1e-10; the duty at every value is exact ([`Altered`]). A range narrower than the
//! grid's step (3 % of the ratio, a tenth of the others) is found if it lies around the value at which the worst rule uses
//! least. Cost: up to some hundred judgements of one drive for each quantity.

use jred::Error;
use serde::Serialize;

use super::altered::{Alteration, Altered};
use crate::catalogue::{Gearbox, Prepared};
use crate::check::Verdict;
use crate::cycle::Cycle;
use crate::drive::Drive;
use crate::judge::{Context, Findings};
use crate::listing::nearest;
use crate::output::short;
use crate::rule::Rule;
use crate::rules::RuleSet;
use crate::site::Site;
use crate::size::Selection;

/// What is changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Lever {
    /// Ratio of the gearbox.
    GearRatio,
    /// Ratio of a gearbox without losses, inertia and limits, for a motor that has none.
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

    /// In words.
    pub const fn name(self) -> &'static str {
        match self {
            Self::GearRatio => "gear ratio",
            Self::IdealGearbox => "ratio of an ideal gearbox",
            Self::CycleTime => "cycle time",
            Self::MovingMass => "moving masses",
            Self::ProcessLoad => "process loads",
        }
    }

    /// The values that are tried, rising.
    fn grid(self) -> Vec<f64> {
        let log = |from: f64, to: f64, steps: u32| {
            (0..=steps).map(move |k| from * (to / from).powf(f64::from(k) / f64::from(steps)))
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

/// An end of the range in which every rule holds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Edge {
    /// The value.
    pub value: f64,
    /// The rule that is at its limit there; `None`: beyond, nothing was tried.
    pub rule: Option<Rule>,
}

/// One quantity, changed by itself.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Remedy {
    /// What is changed.
    pub lever: Lever,
    /// Its value as it is: the ratio, or 1.
    pub now: f64,
    /// From where to where every rule holds: the range that the present value is in, or the nearest to it. `None`: no value
    /// helps.
    pub range: Option<[Edge; 2]>,
    /// Where no value helps: the best value tried, and the rule that is violated there.
    pub best: Option<Edge>,
    /// The share of its limit that this rule uses there.
    pub best_use: Option<f64>,
}

/// A rule that a drive breaks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Miss {
    /// The rule.
    pub rule: Rule,
    /// The share of its limit that is used; `None`: the limit is zero there.
    pub used: Option<f64>,
    /// The limit as a share of the rating.
    pub limit: f64,
    /// The limit that the drive would hold; `None`: no limit would do.
    pub needed: Option<f64>,
}

/// What would have to change for one drive to hold.
#[derive(Clone, Debug, Serialize)]
pub struct Remedies {
    /// The drive.
    pub drive: String,
    /// Whether it holds as it is: then the ranges say how far each quantity may go.
    pub holds: bool,
    /// The rules that it breaks.
    pub misses: Vec<Miss>,
    /// One quantity after the other.
    pub remedies: Vec<Remedy>,
}

/// How a drive comes out at one value.
#[derive(Clone, Copy, Debug)]
struct State {
    /// The violated rule that is missed furthest.
    rule: Option<Rule>,
    /// The share of its limit that it uses; without a violated rule the largest share of all.
    used: f64,
    /// A rule is violated whose limit is zero.
    beyond: bool,
}

impl State {
    fn of(context: &Context, rules: &RuleSet) -> Self {
        let mut findings = Findings::default();
        context.measure_directly(rules, &mut findings);
        let direct = Self::worst(&findings, rules);
        if direct.rule.is_some() {
            return direct;
        }
        context.follow_time(&mut findings);
        Self::worst(&findings, rules)
    }

    fn worst(findings: &Findings, rules: &RuleSet) -> Self {
        let mut state = Self {
            rule: None,
            used: 0.0,
            beyond: false,
        };
        for (rule, finding) in findings.iter() {
            if rules.limit(rule).fail.is_none() {
                continue;
            }
            let used = rules.use_of_limit(rule, finding);
            let fails = rules.verdict(rule, finding) == Verdict::Fail;
            if fails && used.is_infinite() {
                state.beyond = true;
                state.rule = state.rule.or(Some(rule));
            } else if fails && (state.rule.is_none() || used > state.used) {
                (state.rule, state.used) = (Some(rule), used);
            } else if state.rule.is_none() {
                state.used = state.used.max(used);
            }
        }
        state
    }

    const fn holds(&self) -> bool {
        self.rule.is_none()
    }

    /// Grows with the distance from holding.
    const fn score(&self) -> f64 {
        self.used + if self.beyond { 1e6 } else { 0.0 }
    }
}

impl Remedies {
    /// What would have to change for `drive`, or how far it may.
    pub fn new(
        altered: &Altered,
        site: &Site,
        rules: &RuleSet,
        drive: Drive,
        motor: &Prepared,
    ) -> Self {
        let cycle = Cycle::new(altered.original());
        let context = Context::new(&cycle, site, drive, motor);
        let misses = misses(&context, rules);
        let free = |lever: &Lever| match lever {
            Lever::GearRatio => drive.gearbox.is_some(),
            Lever::IdealGearbox => drive.gearbox.is_none(),
            Lever::ProcessLoad => {
                let mut instants = altered.original().instants.iter();
                instants.any(|i| i.terms.process != 0.0)
            }
            _ => true,
        };
        let levers = Lever::ALL.into_iter().filter(free);
        let remedies = levers.map(|lever| {
            let by = |value: f64| match lever {
                Lever::GearRatio | Lever::IdealGearbox => {
                    let gearbox = with_ratio(drive.gearbox, value);
                    let gearbox = gearbox.as_ref();
                    let drive = Drive { gearbox, ..drive };
                    State::of(&Context::new(&cycle, site, drive, motor), rules)
                }
                _ => {
                    let cycle = Cycle::new(&altered.duty(lever.alteration(value)));
                    State::of(&Context::new(&cycle, site, drive, motor), rules)
                }
            };
            let now = match lever {
                Lever::GearRatio | Lever::IdealGearbox => drive.ratio(),
                _ => 1.0,
            };
            Remedy::find(lever, now, by)
        });
        Self {
            drive: drive.name(),
            holds: misses.is_empty(),
            remedies: remedies.collect(),
            misses,
        }
    }

    /// The nearest refused drives of a selection, `count` of them, each with what would have to change.
    ///
    /// # Errors
    /// Those of the machine.
    pub fn of_nearest(
        selection: &Selection,
        altered: &Altered,
        count: usize,
    ) -> Result<Vec<Self>, Error> {
        let nearest = nearest(selection, count);
        Ok(nearest
            .iter()
            .map(|c| Self::new(altered, selection.site, selection.rules, c.drive, c.motor))
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

/// The rules that a drive breaks, those that it misses furthest first.
fn misses(context: &Context, rules: &RuleSet) -> Vec<Miss> {
    let findings = context.findings(rules);
    let broken = findings
        .iter()
        .filter(|(rule, finding)| rules.verdict(*rule, *finding) == Verdict::Fail);
    let mut misses: Vec<Miss> = broken
        .filter_map(|(rule, finding)| {
            let limit = rules.limit(rule).fail?;
            let used = Some(rules.use_of_limit(rule, finding)).filter(|used| used.is_finite());
            let needed = finding.value / finding.rating;
            Some(Miss {
                rule,
                used,
                limit,
                needed: Some(needed).filter(|needed| needed.is_finite()),
            })
        })
        .collect();
    let far = |miss: &Miss| miss.used.unwrap_or(f64::INFINITY);
    misses.sort_by(|a, b| far(b).total_cmp(&far(a)));
    misses
}

/// The gearbox with another ratio; without one, a gearbox that has nothing but its ratio.
pub(super) fn with_ratio(gearbox: Option<&Gearbox>, ratio: f64) -> Option<Gearbox> {
    let bare = || Gearbox {
        key: "ideal".to_owned(),
        ratio,
        from_maker: true,
        ..Gearbox::default()
    };
    let mut gearbox = gearbox.cloned().unwrap_or_else(bare);
    gearbox.ratio = ratio;
    Some(gearbox)
}

impl Remedy {
    fn find(lever: Lever, now: f64, judge: impl Fn(f64) -> State) -> Self {
        let mut grid = lever.grid();
        grid.push(now);
        grid.sort_by(f64::total_cmp);
        grid.dedup();
        let mut states: Vec<Option<State>> = vec![None; grid.len()];
        let mut at = |k: usize| *states[k].get_or_insert_with(|| judge(grid[k]));
        let distance = |value: f64| (value.max(1e-3) / now).ln().abs();
        let mut outwards: Vec<usize> = (0..grid.len()).collect();
        outwards.sort_by(|&a, &b| distance(grid[a]).total_cmp(&distance(grid[b])));
        let nearest = outwards.iter().copied().find(|&k| at(k).holds());
        let remedy = |range, best: Option<(f64, State)>| Self {
            lever,
            now,
            range,
            best: best.map(|(value, state)| Edge {
                value,
                rule: state.rule,
            }),
            best_use: best.map(|b| b.1.used).filter(|used| *used > 0.0),
        };
        if let Some(inside) = nearest {
            let below = (0..inside).rev().find(|&k| !at(k).holds());
            let above = (inside..grid.len()).find(|&k| !at(k).holds());
            let edge = |outside: Option<usize>, inner: usize, end: usize| match outside {
                Some(outside) => bisect(&judge, grid[inner], grid[outside]),
                None => Edge {
                    value: grid[end],
                    rule: None,
                },
            };
            let low = edge(below, below.map_or(0, |k| k + 1), 0);
            let high = edge(above, above.map_or(0, |k| k - 1), grid.len() - 1);
            return remedy(Some([low, high]), None);
        }
        // Of equal ones the first, which is the nearest.
        let scored = outwards.iter().map(|&k| (k, at(k)));
        let least = scored.min_by(|a, b| a.1.score().total_cmp(&b.1.score()));
        let Some((least, first)) = least else {
            return remedy(None, None);
        };
        let around = [
            grid[least.saturating_sub(1)],
            grid[(least + 1).min(grid.len() - 1)],
        ];
        let (value, state) = golden(&judge, around);
        if state.holds() {
            let [low, high] = around.map(|outside| bisect(&judge, value, outside));
            return remedy(Some([low, high]), None);
        }
        let best = if state.score() < first.score() {
            (value, state)
        } else {
            (grid[least], first)
        };
        remedy(None, Some(best))
    }

    /// The nearest value at which every rule holds, and what is at its limit there; `None` where no value helps, or where the
    /// present one holds.
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

    /// In words; `duration` is the cycle time as it is (s).
    pub fn sentence(&self, duration: f64) -> String {
        let shown = |value: f64| match self.lever {
            Lever::GearRatio | Lever::IdealGearbox => short(value),
            Lever::CycleTime => format!("{} s", short(value * duration)),
            Lever::MovingMass | Lever::ProcessLoad => format!("{} %", short(value * 100.0)),
        };
        let at = |edge: &Edge| {
            let rule = edge.rule.map_or(String::new(), |r| format!(" ({})", r.name()));
            format!("{}{rule}", shown(edge.value))
        };
        let (name, now) = (self.lever.name(), shown(self.now));
        if let Some([low, high]) = &self.range {
            let range = match (low.rule, high.rule) {
                (None, None) => "any value that was tried".to_owned(),
                (Some(_), None) => format!("{} or more", at(low)),
                (None, Some(_)) => format!("{} or less", at(high)),
                (Some(_), Some(_)) => format!("{} to {}", at(low), at(high)),
            };
            return if self.change().is_some() {
                format!("{name} {now}: holds with {range}")
            } else {
                format!("{name} {now}: may be {range}")
            };
        }
        let Some(best) = &self.best else {
            return format!("{name} {now}: no value helps");
        };
        let rule = best.rule.map_or("a rule", Rule::name);
        let used = self.best_use.map_or(String::new(), |used| {
            format!(" with {:.1} % of its limit", used * 100.0)
        });
        format!(
            "{name} {now}: no value helps; at {}, the best, {rule} fails{used}",
            shown(best.value)
        )
    }
}

impl Miss {
    /// In words: what is used, and what limit would do.
    pub fn sentence(&self) -> String {
        let name = self.rule.name();
        match (self.used, self.needed) {
            (Some(used), Some(needed)) => format!(
                "{name} uses {:.1} % of its limit (it would hold with {} instead of {})",
                used * 100.0,
                short(needed),
                short(self.limit)
            ),
            _ => format!("{name} is asked for where there is none"),
        }
    }
}

/// Where the rules stop to hold between `inside`, where they do, and `outside`, where they do not.
fn bisect(judge: &impl Fn(f64) -> State, mut inside: f64, mut outside: f64) -> Edge {
    let mut rule = judge(outside).rule;
    for _ in 0..50 {
        if (outside - inside).abs() <= 1e-10 * inside.abs().max(outside.abs()) {
            break;
        }
        let middle = 0.5 * (inside + outside);
        let state = judge(middle);
        if state.holds() {
            inside = middle;
        } else {
            outside = middle;
            rule = state.rule;
        }
    }
    Edge {
        value: inside,
        rule,
    }
}

/// The value between two others at which the worst rule uses least, by golden section.
fn golden(judge: &impl Fn(f64) -> State, [mut low, mut high]: [f64; 2]) -> (f64, State) {
    const SECTION: f64 = 0.381_966_011_250_105_1;
    let at = |value: f64| (value, judge(value));
    let mut left = at(low + SECTION * (high - low));
    let mut right = at(high - SECTION * (high - low));
    for _ in 0..40 {
        if left.1.score() < right.1.score() {
            high = right.0;
            right = left;
            left = at(low + SECTION * (high - low));
        } else {
            low = left.0;
            left = right;
            right = at(high - SECTION * (high - low));
        }
        if left.1.holds() || right.1.holds() {
            break;
        }
    }
    if right.1.holds() || (!left.1.holds() && right.1.score() < left.1.score()) {
        right
    } else {
        left
    }
}
