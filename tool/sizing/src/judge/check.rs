//! One sizing rule applied to one drive: figure, limit, verdict.

use crate::judge::Grounds;
use jred_file::model::rule::Rule;
use jred_file::model::rules::{Finding, Limit, RuleSet, RuleVerdict};
use jred_file::number::rounding::{cleared, short, told_apart};
use jred_file::units::{DEGREE, RPM, Vocabulary};

/// A rule with its value, limit and verdict.
#[derive(Clone, Debug)]
pub struct Check {
    /// Name of the rule.
    pub rule: &'static str,
    /// The rule.
    pub id: Rule,
    /// Value and rating (SI units).
    pub finding: Finding,
    /// The limits, as shares of the rating.
    pub shares: Limit,
    /// The value, in `unit`; `None` if unknown.
    pub value: Option<f64>,
    /// Its limit, in `unit`; `None` without data in the catalogue.
    pub limit: Option<f64>,
    /// Unit of figure and limit.
    pub unit: &'static str,
    /// SI value of that unit.
    pub scale: f64,
    /// The used share of the limit; zero without a limit, infinite for a limit of zero.
    pub used: f64,
    /// Margin as a share of the limit; `None` without a limit, or for a yes-or-no rule.
    pub margin: Option<f64>,
    /// Verdict.
    pub verdict: RuleVerdict,
    /// Its grounds.
    pub grounds: Grounds,
    /// Words and units of the motor.
    pub words: &'static Vocabulary,
    /// Source of the limit.
    pub source: String,
}

impl Check {
    /// Judges a finding under a rule set.
    pub fn new(
        rules: &RuleSet,
        rule: Rule,
        finding: Finding,
        grounds: Grounds,
        words: &'static Vocabulary,
    ) -> Self {
        let verdict = rules.verdict(rule, finding);
        let shares = rules.limit(rule);
        let (unit, scale) = unit(rule, &grounds, words);
        let used = rules.use_shown(rule, finding);
        let bound = shares.fail.or(shares.warn);
        let bound = bound.map(|share| share * finding.rating);
        let bound = bound.filter(|bound| finding.is_known() && bound.is_finite());
        let margin = bound.is_some() && used.is_finite() && !rule.is_yes_or_no();
        Self {
            rule: rule.named(words),
            id: rule,
            finding,
            shares,
            value: Some(finding.value / scale).filter(|v| v.is_finite()),
            limit: bound.map(|bound| bound / scale),
            unit,
            scale,
            used,
            margin: margin.then_some(match verdict {
                RuleVerdict::Fail => 1.0 - used,
                _ => cleared(1.0 - used, 1.0),
            }),
            verdict,
            grounds,
            words,
            source: rules.source(rule).to_owned(),
        }
    }

    fn with_unit(&self, figure: &str) -> String {
        format!("{figure} {}", self.unit).trim_end().to_owned()
    }

    /// Figure and limit with four digits; with more digits where those would not show that the limit is exceeded.
    fn figures(&self) -> Option<[String; 2]> {
        let pair = [self.value?, self.limit?];
        Some(if self.verdict == RuleVerdict::Fail {
            told_apart(pair)
        } else {
            pair.map(short)
        })
    }

    /// Use of the limit as text.
    pub fn used(&self) -> String {
        match self.used * 100.0 {
            _ if self.limit.is_none() || self.id.is_yes_or_no() => String::new(),
            percent if self.verdict == RuleVerdict::Fail && percent > 100.0 && percent < 100.5 => {
                "> 100 %".to_owned()
            }
            percent if percent <= 1000.0 => format!("{percent:.0} %"),
            _ => "> 1000 %".to_owned(),
        }
    }

    /// The figure with its unit, or a dash.
    pub fn figure(&self) -> String {
        let text = match self.figures() {
            Some([value, _]) => Some(value),
            None => self.value.map(short),
        };
        text.map_or("–".to_owned(), |text| self.with_unit(&text))
    }

    /// Its limit with its unit; `None` without a limit.
    pub fn bound(&self) -> Option<String> {
        let text = match self.figures() {
            Some([_, limit]) => limit,
            None => short(self.limit?),
        };
        Some(self.with_unit(&text))
    }

    /// Figure and limit: "4219 rpm, limit 4500 rpm".
    pub fn against(&self) -> String {
        let bound = self.bound();
        let limit = bound.map_or_else(String::new, |limit| format!(", limit {limit}"));
        format!("{}{limit}", self.figure())
    }
}

/// The unit in which a rule is shown, and its SI value.
const fn unit(rule: Rule, grounds: &Grounds, words: &Vocabulary) -> (&'static str, f64) {
    match rule {
        Rule::RmsTorque
        | Rule::PeakTorque
        | Rule::HoldingTorque
        | Rule::ConstantTorque
        | Rule::BrakeTorque => (words.torque.unit, words.torque.scale),
        Rule::Speed => (words.speed.unit, words.speed.scale),
        Rule::InertiaRatio => ("", 1.0),
        Rule::BrakeWork | Rule::ResistorPulse => ("J", 1.0),
        Rule::AmbientTemperature | Rule::CabinetTemperature => ("degC", 1.0),
        Rule::Altitude => ("m", 1.0),
        Rule::WindingTemperature | Rule::HousingTemperature => match grounds {
            Grounds::Heat { heating, .. } if heating.relative => ("%", 0.01),
            _ => ("K", 1.0),
        },
        Rule::GearboxPeak | Rule::GearboxCubicMean | Rule::GearboxEmergency => ("N m", 1.0),
        Rule::GearboxMeanSpeed | Rule::GearboxSpeed | Rule::ScrewSpeed => ("rpm", RPM),
        Rule::GearboxCycles => ("per hour", 1.0),
        Rule::GearboxRadial
        | Rule::GearboxAxial
        | Rule::BeltTension
        | Rule::BeltForce
        | Rule::BeltPretension
        | Rule::ScrewForce
        | Rule::ScrewBuckling
        | Rule::PinionForce => ("N", 1.0),
        Rule::RmsCurrent | Rule::PeakCurrent => ("A", 1.0),
        Rule::Overload => ("A^2 s", 1.0),
        Rule::MotorVoltage | Rule::AmplifierVoltage | Rule::BusVoltage => ("V", 1.0),
        Rule::BrakeResistance => ("Ohm", 1.0),
        Rule::ResistorPower | Rule::ResistorPeak => ("W", 1.0),
        Rule::NaturalFrequency => ("Hz", 1.0),
        Rule::Backlash => match grounds {
            Grounds::Backlash { turns: true, .. } => ("deg", DEGREE),
            _ => ("mm", 1e-3),
        },
    }
}
