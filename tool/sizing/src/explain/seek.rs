//! Search over the values of one quantity for the range in which every rule is satisfied.

use super::remedy::{Edge, Lever, Remedy};
use crate::judge::{Context, Findings};
use jred_machine::model::rule::Rule;
use jred_machine::model::rules::RuleSet;
use jred_machine::model::rules::Verdict;

/// Result of a drive at one value.
#[derive(Clone, Copy, Debug)]
pub(super) struct State {
    /// The rule violated by most.
    rule: Option<Rule>,
    /// The share of its limit that it uses; without a violated rule the largest share of all.
    used: f64,
    /// A rule is violated whose limit is zero.
    beyond: bool,
}

impl State {
    pub(super) fn of(context: &Context, rules: &RuleSet) -> Self {
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

    /// Increases with the distance from satisfying every rule.
    const fn score(&self) -> f64 {
        self.used + if self.beyond { 1e6 } else { 0.0 }
    }
}

impl Remedy {
    pub(super) fn find(lever: Lever, now: f64, judge: impl Fn(f64) -> State) -> Self {
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
}

/// Bisection for the end of the range between `inside`, where every rule is satisfied, and `outside`, where one is violated.
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
