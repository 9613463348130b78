//! Ranges of ratios in which a motor satisfies its rules. A gearbox of any ratio is combined with the motor, and bisection finds the ratios at which
//! a rule changes its verdict.

use super::{Gear, Range};
use crate::catalogue::Drive;
use crate::catalogue::{Gearbox, Motor};
use crate::cycle::Cycle;
use crate::judge::broken;
use crate::judge::{Context, Findings};
use crate::motor::envelope::MotorLimits;
use jred_file::math;
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleSet;
use jred_file::model::site::Site;
use jred_file::number::numerics::edge;

/// Range of ratios that is searched.
const SEARCH_RANGE: Range = [0.01, 10_000.0];

/// Number of steps over that range, in equal ratios: neighbours differ by 2.3 %. A narrower suitable range is found only if it contains i*.
const RATIO_COUNT: u32 = 600;

/// The tried ratios, rising, including `best`.
pub(super) fn tried(best: Option<f64>) -> Vec<f64> {
    let [from, to] = SEARCH_RANGE;
    let step = |k: u32| from * math::pow(to / from, f64::from(k) / f64::from(RATIO_COUNT));
    let mut ratios: Vec<f64> = (0..=RATIO_COUNT).map(step).collect();
    ratios.extend(best.filter(|best| (from..to).contains(best)));
    ratios.sort_by(f64::total_cmp);
    ratios
}

/// A range of ratios, and the rules that limit it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RatioRange {
    /// The ratios.
    pub range: Range,
    /// The rule that is violated below; `None`: the range continues.
    pub below: Option<Rule>,
    /// The rule that is violated above; `None`: the range continues.
    pub above: Option<Rule>,
}

/// A motor to be combined with any ratio.
#[derive(Clone, Copy, Debug)]
pub struct Trial<'a> {
    /// The duty.
    pub cycle: &'a Cycle,
    /// Site of the drive.
    pub site: &'a Site,
    /// The limits.
    pub rules: &'a RuleSet,
    /// The motor.
    pub motor: &'a Motor,
    /// Its limits.
    pub prepared: &'a MotorLimits,
    /// Data of the gearbox.
    pub gear: Gear,
}

impl Trial<'_> {
    /// Findings at a ratio of the rules that need no time course.
    pub fn findings(&self, ratio: f64) -> Findings {
        let gearbox = self.gear.with_ratio(ratio);
        let drive = Drive {
            motor: self.motor,
            gearbox: Some(&gearbox),
            amplifier: None,
        };
        let mut findings = Findings::default();
        Context::new(self.cycle, self.site, drive, self.prepared)
            .measure_directly(self.rules, &mut findings);
        findings
    }

    /// The rule that is violated at a ratio; of several, the one with the largest use of its limit.
    pub fn broken(&self, ratio: f64) -> Option<Rule> {
        broken(self.rules, &self.findings(ratio))
    }

    /// The ranges without a violation; `best` is tried in addition to the grid.
    pub fn ranges(&self, best: Option<f64>) -> Vec<RatioRange> {
        let mut found: Vec<RatioRange> = Vec::new();
        let mut open: Option<RatioRange> = None;
        let mut before: Option<(f64, Option<Rule>)> = None;
        for ratio in tried(best) {
            let broken = self.broken(ratio);
            match (&mut open, broken) {
                (None, None) => {
                    let (start, below) = match before {
                        Some((last, rule)) => (self.edge(ratio, last), rule),
                        None => (ratio, None),
                    };
                    open = Some(RatioRange {
                        range: [start, ratio],
                        below,
                        above: None,
                    });
                }
                (Some(range), None) => range.range[1] = ratio,
                (Some(range), Some(rule)) => {
                    let last = range.range[1];
                    range.range[1] = self.edge(last, ratio);
                    range.above = Some(rule);
                    found.extend(open.take());
                }
                (None, Some(_)) => {}
            }
            before = Some((ratio, broken));
        }
        found.extend(open);
        found
    }

    /// The last ratio from `inside`, where every rule is satisfied, towards `outside`, where one is violated.
    fn edge(&self, inside: f64, outside: f64) -> f64 {
        let holds = |ratio: f64| Ok::<_, std::convert::Infallible>(self.broken(ratio).is_none());
        edge(holds, inside, outside).unwrap_or(inside)
    }
}

impl Gear {
    /// A gearbox with these data and no limits.
    pub(crate) fn with_ratio(self, ratio: f64) -> Gearbox {
        Gearbox {
            ratio,
            inertia: self.inertia,
            efficiency: self.efficiency,
            back_efficiency: self.efficiency,
            ..Gearbox::default()
        }
    }
}
