//! The limits of a drive for the firmware's duty meter, [`jred::duty`], as `jred size --meter` writes them.
//!
//! The limits include the rules' shares: if the RMS torque may be 80 % of the S1 torque, that is the limit. Curves are lower bounds of at most
//! [`jred::duty::MAX_POINTS`] points ([`below()`]). They are the same in all four quadrants, so they follow the lower of driving and braking. Figures
//! are rounded down to single precision, so the meter allows nothing that `jred size` does not. A rule that is off or lacks its rating gives no
//! limit, and the source says so.

mod lower_curve;
mod source;

pub use lower_curve::{LowerCurve, below};

use crate::catalogue::Drive;
use crate::judge::Assessment;
use crate::judge::{Context, Findings};
use crate::motor::envelope::Envelope;
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleVerdict;
use jred_file::model::rules::{MeanTorque, RuleSet};
use jred_file::number::rounding::{short, significant};
use jred_file::units::Vocabulary;

/// Largest shortfall that counts as rounding and is not reported.
const SHORTFALL_ROUNDING: f64 = 1e-5;

/// Form of a limit.
#[derive(Clone, Debug, PartialEq)]
pub enum Bound {
    /// A torque over speed.
    Curve(LowerCurve),
    /// A figure.
    Figure(f32),
    /// No limit: not checked.
    Open,
}

jred_file::words! {
    /// The fields of [`jred::duty::Limits`], with their names.
    pub enum Field {
        /// The S1 torque over speed.
        Continuous = "continuous",
        /// The peak torque over speed.
        Peak = "peak",
        /// The largest speed.
        Speed = "speed",
        /// The mean speed.
        MeanSpeed = "mean_speed",
        /// The largest torque at the gearbox output.
        OutputPeak = "output_peak",
        /// The cubic mean torque at the gearbox output.
        OutputMean = "output_mean",
        /// The mean power that comes back at the shaft.
        RegenerativePower = "regenerative_power",
        /// The moves per hour.
        CyclesPerHour = "cycles_per_hour",
    }
}

/// One field of [`jred::duty::Limits`].
#[derive(Clone, Debug, PartialEq)]
pub struct MeterLimit {
    /// The field.
    pub field: Field,
    /// Its description.
    pub bound: Bound,
    /// How it is computed, or why it is missing.
    pub words: String,
}

/// The limits of a drive under a rule set, and the figures of the cycle that it was sized with.
#[derive(Clone, Debug)]
pub struct MeterLimits<'a> {
    context: &'a Context<'a>,
    rules: &'a RuleSet,
    /// One entry for each field of [`jred::duty::Limits`], in their order.
    pub entries: Vec<MeterLimit>,
}

/// A share of the S1 torque over speed.
pub fn continuous(envelope: &Envelope, share: f64) -> Option<LowerCurve> {
    let floor = |speeds| {
        envelope
            .continuous_floor(speeds)
            .map(|torque| share * torque)
    };
    below(end(envelope), &envelope.corners(), floor)
}

/// A share of the short-time torque over speed.
pub fn peak(envelope: &Envelope, share: f64) -> Option<LowerCurve> {
    let floor = |speeds| envelope.peak_floor(speeds).map(|torque| share * torque);
    below(end(envelope), &envelope.corners(), floor)
}

/// The largest speed of the motor or, without data, of the meter.
fn end(envelope: &Envelope) -> f64 {
    envelope.max_speed().min(jred::duty::MOST_SPEED)
}

/// The share of a rating that a rule allows, if the rule is checked.
fn share(rules: &RuleSet, rule: Rule) -> Option<RatingShare> {
    let limit = rules.limit(rule);
    let share = limit.fail.or(limit.warn)?;
    Some(RatingShare {
        share,
        warns: limit.fail.is_none(),
    })
}

fn unchecked(rule: Rule, kind: &Vocabulary) -> String {
    format!("the rule \"{}\" is not checked", rule.named(kind))
}

/// An allowed share of a rating.
struct RatingShare {
    share: f64,
    /// Whether sizing only warns beyond it.
    warns: bool,
}

impl RatingShare {
    fn words(&self, rating: &str) -> String {
        let warns = if self.warns {
            ", beyond which sizing gives a warning"
        } else {
            ""
        };
        format!("{} % of the {rating}{warns}", short(100.0 * self.share))
    }
}

/// The limit of a figure: the smallest limit of several rules.
fn figure(
    field: Field,
    rules: &RuleSet,
    kind: &Vocabulary,
    findings: &Findings,
    judged: &[(Rule, &str)],
) -> MeterLimit {
    let mut least: Option<(f64, String)> = None;
    let mut open = Vec::new();
    for &(rule, rating) in judged {
        let Some(finding) = findings.get(rule) else {
            continue;
        };
        match share(rules, rule) {
            None => open.push(unchecked(rule, kind)),
            Some(_) if !finding.rating.is_finite() => open.push(format!("no data for {rating}")),
            Some(share) => {
                let limit = share.share * finding.rating;
                if least.as_ref().is_none_or(|(other, _)| limit < *other) {
                    least = Some((limit, share.words(rating)));
                }
            }
        }
    }
    let (bound, words) = match least {
        Some((limit, words)) => (Bound::Figure(lower_curve::rounded_down(limit)), words),
        None if open.is_empty() => (Bound::Open, "not applicable to this drive".to_owned()),
        None => (Bound::Open, open.join("; ")),
    };
    MeterLimit {
        field,
        bound,
        words,
    }
}

fn curve(
    field: Field,
    rules: &RuleSet,
    kind: &Vocabulary,
    rule: Rule,
    rating: &str,
    of: impl Fn(f64) -> Option<LowerCurve>,
) -> MeterLimit {
    let (bound, words) = match share(rules, rule) {
        None => (Bound::Open, unchecked(rule, kind)),
        Some(share) => match of(share.share) {
            None => (Bound::Open, format!("no data for the {rating}")),
            Some(curve) => {
                let mut words = share.words(rating);
                if curve.shortfall > SHORTFALL_ROUNDING {
                    let shortfall = significant(100.0 * curve.shortfall, 2);
                    words = format!("{words}, up to {shortfall} % of its largest value below it");
                }
                (Bound::Curve(curve), words)
            }
        },
    };
    MeterLimit {
        field,
        bound,
        words,
    }
}

impl<'a> MeterLimits<'a> {
    /// The limits of a drive.
    pub fn new(context: &'a Context<'a>, rules: &'a RuleSet) -> Self {
        let findings = context.findings(rules);
        let envelope = &context.motor.envelope;
        let kind = context.vocabulary();
        let torque = kind.torque;
        let of = |field, judged: &[_]| figure(field, rules, kind, &findings, judged);
        let mut output_mean = of(
            Field::OutputMean,
            &[(Rule::GearboxCubicMean, "gearbox's rated torque T2N")],
        );
        if rules.choices.gearbox_mean_exponent != MeanTorque::Cubic {
            output_mean.bound = Bound::Open;
            "the rule uses a mean with the exponent 10/3, the meter with 3"
                .clone_into(&mut output_mean.words);
        }
        let entries = vec![
            curve(
                Field::Continuous,
                rules,
                kind,
                Rule::RmsTorque,
                &format!("S1 {torque}"),
                |share| continuous(envelope, share),
            ),
            curve(
                Field::Peak,
                rules,
                kind,
                Rule::PeakTorque,
                &format!("peak {torque}"),
                |share| peak(envelope, share),
            ),
            of(
                Field::Speed,
                &[
                    (Rule::Speed, "motor's maximum speed"),
                    (Rule::GearboxSpeed, "gearbox's maximum input speed"),
                ],
            ),
            of(
                Field::MeanSpeed,
                &[(Rule::GearboxMeanSpeed, "gearbox's rated input speed n1N")],
            ),
            of(
                Field::OutputPeak,
                &[(Rule::GearboxPeak, "gearbox's acceleration torque T2B")],
            ),
            output_mean,
            regenerative_power(context, rules, &findings),
            of(
                Field::CyclesPerHour,
                &[(
                    Rule::GearboxCycles,
                    "moves per hour up to which T2B is valid",
                )],
            ),
        ];
        Self {
            context,
            rules,
            entries,
        }
    }

    /// The rules that are checked for this drive but not monitored by the meter.
    pub fn unseen(&self) -> Vec<Rule> {
        use Rule::{
            GearboxCubicMean, GearboxCycles, GearboxMeanSpeed, GearboxPeak, GearboxSpeed,
            PeakTorque, RmsTorque, Speed,
        };
        let seen = |rule: Rule| match rule {
            RmsTorque | PeakTorque | Speed | GearboxMeanSpeed | GearboxPeak | GearboxSpeed
            | GearboxCycles => true,
            GearboxCubicMean => self.rules.choices.gearbox_mean_exponent == MeanTorque::Cubic,
            _ => false,
        };
        let findings = self.context.findings(self.rules);
        let judged = findings.iter().map(|(rule, _)| rule);
        judged
            .filter(|rule| self.rules.limit(*rule).is_set() && !seen(*rule))
            .collect()
    }

    /// The violated rules, each with its value, its limit and the use of it.
    pub fn broken(&self) -> Vec<String> {
        let judged = Assessment::new(self.context, self.rules);
        let broken = judged.checks.iter();
        let broken = broken.filter(|check| check.verdict == RuleVerdict::Fail);
        let words = broken.map(|check| {
            let rule = check.rule;
            // A violated rule has a limit.
            let limit = check.bound().unwrap_or_default();
            format!("{rule} {} of {limit}, {}", check.figure(), check.used())
        });
        words.collect()
    }

    /// The drive.
    pub const fn drive(&self) -> &Drive<'a> {
        &self.context.drive
    }
}

/// Limit of the power fed back at the shaft. Apart from losses and the capacitor, all of it reaches the brake resistor, so the limit is on the safe
/// side. There is no limit if the cycle itself exceeds it.
fn regenerative_power(context: &Context, rules: &RuleSet, findings: &Findings) -> MeterLimit {
    let mut entry = figure(
        Field::RegenerativePower,
        rules,
        context.vocabulary(),
        findings,
        &[(
            Rule::ResistorPower,
            "brake resistor's continuous power, at the shaft",
        )],
    );
    let cycle = context.cycle;
    let [_, back] = cycle.energies(&context.coefficients, context.ratio);
    if let Bound::Figure(limit) = entry.bound
        && back / cycle.duration() > f64::from(limit)
    {
        entry.bound = Bound::Open;
        "more power comes back at the shaft than the brake resistor can take: losses and the capacitor take the rest"
            .clone_into(&mut entry.words);
    }
    entry
}
