//! Why a motor satisfies the rules at no ratio.

use jred_file::math;
use std::convert::Infallible;

use super::Range;
use super::ranges::{Trial, tried};
use crate::judge::Findings;
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleVerdict;
use jred_file::number::numerics::edge;

/// Parts into which a step of the grid of ratios is cut where the use of a limit is least.
const FINER: u32 = 200;

/// The obstacle at every ratio.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Obstacle {
    /// A rule violated at every ratio: the least share of its limit, and the ratio there.
    Always {
        /// The rule; of several, the most violated one.
        rule: Rule,
        /// The share.
        used: f64,
        /// The ratio.
        ratio: f64,
    },
    /// Two rules that are satisfied only at different ratios.
    Apart {
        /// The rule that needs a large ratio, and its least ratio.
        least: (Rule, f64),
        /// The rule that needs a small ratio, and its largest ratio.
        most: (Rule, f64),
    },
    /// No ratio satisfies all rules together, although each is satisfied at some ratio; the closest ratio.
    Together {
        /// The rule violated there.
        rule: Rule,
        /// The share of its limit.
        used: f64,
        /// The ratio.
        ratio: f64,
    },
}

/// Result of one rule over the ratios tried.
struct RuleByRatio {
    rule: Rule,
    /// For each ratio: whether the rule is satisfied, and the share of its limit.
    points: Vec<(bool, f64)>,
}

impl Trial<'_> {
    /// The obstacle; `None` if a ratio satisfies every rule. `best` is tried in addition to the grid.
    pub fn obstacle(&self, best: Option<f64>) -> Option<Obstacle> {
        let ratios = tried(best);
        let findings: Vec<Findings> = ratios.iter().map(|ratio| self.findings(*ratio)).collect();
        let courses: Vec<RuleByRatio> = Rule::ALL
            .into_iter()
            .filter(|rule| self.rules.limit(*rule).fail.is_some())
            .map(|rule| RuleByRatio {
                rule,
                points: findings
                    .iter()
                    .map(|found| self.point(rule, found))
                    .collect(),
            })
            .collect();
        let all = |k: usize| courses.iter().all(|c| c.points.get(k).is_none_or(|p| p.0));
        if (0..ratios.len()).any(all) {
            return None;
        }
        let never = courses.iter().filter(|c| c.points.iter().all(|p| !p.0));
        let never = never.map(|c| (c.rule, minimum(&ratios, |ratio| self.one(c.rule, ratio).1)));
        // Between the tried ratios it may still be satisfied.
        let never = never.filter(|(_, (_, used))| *used > 1.0);
        if let Some((rule, (ratio, used))) = never.max_by(|a, b| a.1.1.total_cmp(&b.1.1)) {
            return Some(Obstacle::Always { rule, used, ratio });
        }
        let bounds = courses.iter().filter_map(|c| {
            let [from, to] = self.bounds(c, &ratios)?;
            Some((c.rule, from, to))
        });
        let bounds: Vec<(Rule, f64, f64)> = bounds.collect();
        let least = bounds.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
        let most = bounds.iter().min_by(|a, b| a.2.total_cmp(&b.2))?;
        if least.1 > most.2 {
            return Some(Obstacle::Apart {
                least: (least.0, least.1),
                most: (most.0, most.2),
            });
        }
        let worst = |ratio: f64| {
            let findings = self.findings(ratio);
            let uses = courses
                .iter()
                .map(|c| (self.point(c.rule, &findings), c.rule));
            let broken = uses.filter(|((holds, _), _)| !holds);
            broken
                .max_by(|a, b| a.0.1.total_cmp(&b.0.1))
                .map(|((_, used), rule)| (used, rule))
        };
        let (ratio, used) = minimum(&ratios, |ratio| worst(ratio).map_or(0.0, |w| w.0));
        let (_, rule) = worst(ratio)?;
        Some(Obstacle::Together { rule, used, ratio })
    }

    /// Whether a rule is satisfied, and the share of its limit; a rule that does not apply is satisfied.
    fn point(&self, rule: Rule, findings: &Findings) -> (bool, f64) {
        findings.get(rule).map_or((true, 0.0), |finding| {
            let holds = self.rules.verdict(rule, finding) != RuleVerdict::Fail;
            (holds, self.rules.use_of_limit(rule, finding))
        })
    }

    /// The same for a ratio.
    fn one(&self, rule: Rule, ratio: f64) -> (bool, f64) {
        self.point(rule, &self.findings(ratio))
    }

    /// The smallest and the largest ratio that satisfies a rule.
    fn bounds(&self, course: &RuleByRatio, ratios: &[f64]) -> Option<Range> {
        let first = course.points.iter().position(|p| p.0)?;
        let last = course.points.iter().rposition(|p| p.0)?;
        let holds = |ratio: f64| Ok::<_, Infallible>(self.one(course.rule, ratio).0);
        let at = |k: usize| ratios.get(k).copied();
        let closed = |inside: f64, outside: Option<f64>| match outside {
            Some(outside) => edge(holds, inside, outside).unwrap_or(inside),
            None => inside,
        };
        let below = first.checked_sub(1).and_then(at);
        Some([closed(at(first)?, below), closed(at(last)?, at(last + 1))])
    }
}

/// The ratio with the least value of a function, and that value: the best of the grid, refined.
fn minimum(ratios: &[f64], value: impl Fn(f64) -> f64) -> (f64, f64) {
    let of = |ratio: f64| (ratio, value(ratio));
    let smaller = |a: (f64, f64), b: (f64, f64)| if b.1 < a.1 { b } else { a };
    let points: Vec<(f64, f64)> = ratios.iter().map(|ratio| of(*ratio)).collect();
    let start = points
        .iter()
        .enumerate()
        .min_by(|a, b| a.1.1.total_cmp(&b.1.1));
    let Some((k, first)) = start else {
        return (1.0, f64::INFINITY);
    };
    let neighbour = |k: usize| points.get(k).map_or(first.0, |p| p.0);
    let [from, to] = [neighbour(k.saturating_sub(1)), neighbour(k + 1)];
    let step = |k: u32| from * math::pow(to / from, f64::from(k) / f64::from(FINER));
    (0..=FINER).map(|k| of(step(k))).fold(*first, smaller)
}
