//! Search over the values of one quantity for the range in which every rule is satisfied.

use jred_file::math;
use std::convert::Infallible;

use super::remedy::{Edge, Lever, Remedy};
use crate::judge::{Context, Findings};
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleSet;
use jred_file::model::rules::RuleVerdict;
use jred_file::number::numerics::golden_section;

/// Steps of the search by the golden section.
const SECTIONS: u32 = 40;

/// Score of violating a limit of zero.
const ZERO_LIMIT_SCORE: f64 = 1e6;

/// Result of a drive at one value.
#[derive(Clone, Copy, Debug)]
pub(super) struct DriveResult {
    /// The most violated rule.
    rule: Option<Rule>,
    /// Its share of the limit; without a violated rule the largest share of all.
    used: f64,
    /// Whether a rule with a limit of zero is violated.
    beyond: bool,
}

impl DriveResult {
    pub(super) fn of(context: &Context, rules: &RuleSet) -> Self {
        let mut findings = Findings::default();
        context.measure_directly(rules, &mut findings);
        let direct = Self::worst(&findings, rules);
        if !direct.holds() {
            return direct;
        }
        context.follow_time(&mut findings);
        Self::worst(&findings, rules)
    }

    /// Evaluates only the rules that need no time course.
    pub(super) fn direct(context: &Context, rules: &RuleSet) -> Self {
        let mut findings = Findings::default();
        context.measure_directly(rules, &mut findings);
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
            let fails = rules.verdict(rule, finding) == RuleVerdict::Fail;
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

    /// Increases with the distance from satisfying every rule.
    const fn score(&self) -> f64 {
        self.used + if self.beyond { ZERO_LIMIT_SCORE } else { 0.0 }
    }

    /// A lower bound of the score over all instants, if this is the result over some of them: any limit may become zero over all of them.
    const fn bound(&self) -> f64 {
        if self.beyond {
            ZERO_LIMIT_SCORE
        } else {
            self.used.min(ZERO_LIMIT_SCORE)
        }
    }
}

/// Judges a drive at the values of one quantity.
pub(super) struct Judge<S, O> {
    /// The result at a value.
    pub(super) state: S,
    /// A cheaper result that is no worse: only rules without a time course, over fewer instants.
    pub(super) at_best: O,
}

impl<S: Fn(f64) -> DriveResult, O: Fn(f64) -> Option<DriveResult>> Judge<S, O> {
    fn state(&self, value: f64) -> DriveResult {
        (self.state)(value)
    }

    fn holds(&self, value: f64) -> bool {
        (self.at_best)(value).is_none_or(|state| state.holds()) && self.state(value).holds()
    }

    /// Bisection for the end of the range between `inside`, where every rule is satisfied, and `outside`, where one is
    /// violated.
    fn bisect(&self, mut inside: f64, mut outside: f64) -> Edge {
        for _ in 0..50 {
            if (outside - inside).abs() <= 1e-10 * inside.abs().max(outside.abs()) {
                break;
            }
            let middle = 0.5 * (inside + outside);
            if self.holds(middle) {
                inside = middle;
            } else {
                outside = middle;
            }
        }
        Edge {
            value: inside,
            rule: (self.state(outside).rule)
                .or_else(|| (self.at_best)(outside).and_then(|state| state.rule)),
        }
    }
}

/// Share of the distance to the next grid value at which a result is compared with that of the grid value.
const NEIGHBOUR_SHARE: f64 = 1e-4;

/// The values of a grid with the results computed so far.
struct GridResults<'j, S, O> {
    judge: &'j Judge<S, O>,
    grid: &'j [f64],
    states: Vec<Option<DriveResult>>,
    at_best: Vec<Option<DriveResult>>,
}

impl<S: Fn(f64) -> DriveResult, O: Fn(f64) -> Option<DriveResult>> GridResults<'_, S, O> {
    fn state(&mut self, k: usize) -> DriveResult {
        *self.states[k].get_or_insert_with(|| self.judge.state(self.grid[k]))
    }

    fn at_best(&mut self, k: usize) -> DriveResult {
        if let Some(known) = self.at_best[k] {
            return known;
        }
        let outline = (self.judge.at_best)(self.grid[k]);
        let state = outline.unwrap_or_else(|| self.state(k));
        self.at_best[k] = Some(state);
        state
    }

    fn holds(&mut self, k: usize) -> bool {
        self.at_best(k).holds() && self.state(k).holds()
    }

    /// The value at which the worst rule uses least; of equal values the first in this order.
    fn least(&mut self, order: &[usize]) -> Option<(usize, DriveResult)> {
        let mut promising: Vec<(f64, usize)> = (order.iter().enumerate())
            .map(|(place, &k)| (self.at_best(k).bound(), place))
            .collect();
        promising.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut least: Option<(f64, usize, DriveResult)> = None;
        for (bound, place) in promising {
            let better =
                |score: f64| least.is_none_or(|(least, at, _)| (score, place) < (least, at));
            if better(bound) {
                let state = self.state(order[place]);
                if better(state.score()) {
                    least = Some((state.score(), place, state));
                }
            }
        }
        least.map(|(_, place, state)| (order[place], state))
    }
}

impl Remedy {
    pub(super) fn find<S, O>(lever: Lever, now: f64, judge: &Judge<S, O>) -> Self
    where
        S: Fn(f64) -> DriveResult,
        O: Fn(f64) -> Option<DriveResult>,
    {
        let mut grid = lever.grid();
        if !judge.holds(now) {
            let [least, most] = lever.choices(now);
            grid.retain(|value| (least..=most).contains(value));
            grid.extend([least, most]);
        }
        grid.push(now);
        grid.sort_by(f64::total_cmp);
        grid.dedup();
        let mut tried = GridResults {
            judge,
            grid: &grid,
            states: vec![None; grid.len()],
            at_best: vec![None; grid.len()],
        };
        let distance = |value: f64| math::ln(value.max(1e-3) / now).abs();
        let mut outwards: Vec<usize> = (0..grid.len()).collect();
        outwards.sort_by(|&a, &b| distance(grid[a]).total_cmp(&distance(grid[b])));
        let nearest = outwards.iter().copied().find(|&k| tried.holds(k));
        let remedy = |range, best: Option<(f64, DriveResult)>| Self {
            lever,
            now,
            range,
            best: best.map(|(value, state)| Edge {
                value,
                rule: state.rule,
            }),
            best_use: best
                .filter(|(_, state)| !state.rule.is_some_and(Rule::is_yes_or_no))
                .map(|b| b.1.used)
                .filter(|used| *used > 0.0),
        };
        if let Some(inside) = nearest {
            let below = (0..inside).rev().find(|&k| !tried.holds(k));
            let above = (inside..grid.len()).find(|&k| !tried.holds(k));
            let edge = |outside: Option<usize>, inner: usize, end: usize| match outside {
                Some(outside) => judge.bisect(grid[inner], grid[outside]),
                None => Edge {
                    value: grid[end],
                    rule: None,
                },
            };
            let low = edge(below, below.map_or(0, |k| k + 1), 0);
            let high = edge(above, above.map_or(0, |k| k - 1), grid.len() - 1);
            return remedy(Some([low, high]), None);
        }
        // Of equal values the first, which is the nearest.
        let Some((least, first)) = tried.least(&outwards) else {
            return remedy(None, None);
        };
        let around = [
            grid[least.saturating_sub(1)],
            grid[(least + 1).min(grid.len() - 1)],
        ];
        // If the result is worse on both sides, there is no search between the values of the grid.
        let falls = |end: &f64| {
            let beside = grid[least] + NEIGHBOUR_SHARE * (end - grid[least]);
            judge.state(beside).score() < first.score()
        };
        if !around.iter().any(falls) {
            return remedy(None, Some((grid[least], first)));
        }
        let (value, state) = golden(|value| judge.state(value), around);
        if state.holds() {
            let [low, high] = around.map(|outside| judge.bisect(value, outside));
            return remedy(Some([low, high]), None);
        }
        let best = if state.score() < first.score() {
            (value, state)
        } else {
            (grid[least], first)
        };
        remedy(None, Some(best))
    }
}

/// The value between two others at which the worst rule uses least, by golden section.
fn golden(judge: impl Fn(f64) -> DriveResult, around: [f64; 2]) -> (f64, DriveResult) {
    let Ok([left, right]) = golden_section(
        |value| Ok::<_, Infallible>(judge(value)),
        around,
        SECTIONS,
        |a, b| a.score() < b.score(),
        |a, b| a.holds() || b.holds(),
    );
    if right.1.holds() || (!left.1.holds() && right.1.score() < left.1.score()) {
        right
    } else {
        left
    }
}
