//! The tables of the report.

use jred_analysis::duty::Duty;
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleSet;
use jred_file::model::rules::RuleVerdict;
use jred_file::number::figures::Figures;
use jred_file::number::rounding::{percent, rounded, short, shown, significant};
use jred_file::units::Vocabulary;
use jred_sizing::explain::{Breakdown, InertiaShare, Remedies, Share};
use jred_sizing::judge::Assessment;
use jred_sizing::judge::check::Check;

use crate::list::listing::{figure, margin};

/// A rule, its verdict, and a bar for its use.
pub(super) struct CheckRow {
    pub(super) rule: &'static str,
    pub(super) value: String,
    pub(super) limit: String,
    pub(super) used: String,
    /// Length of the bar (%).
    pub(super) bar: f64,
    pub(super) margin: String,
    pub(super) verdict: &'static str,
    pub(super) class: &'static str,
    pub(super) note: String,
}

impl CheckRow {
    pub(super) fn of(check: &Check) -> Self {
        let class = match check.verdict {
            RuleVerdict::Pass | RuleVerdict::Off => "ok",
            RuleVerdict::Warn | RuleVerdict::NotChecked => "warn",
            RuleVerdict::Fail => "bad",
        };
        let used = check.use_of_limit();
        Self {
            rule: check.rule,
            value: check.figure(),
            limit: check.bound().unwrap_or("–".into()),
            used: check.used(),
            bar: if used.is_finite() {
                (used * 100.0).clamp(0.0, 100.0).round()
            } else {
                100.0
            },
            margin: margin(check),
            verdict: check.verdict.word(),
            class,
            note: check.note.clone(),
        }
    }
}

/// Text for a part that the drive does not have.
pub(super) const NO_PART: &str = "–";

/// A ranked drive.
pub(super) struct FitRow {
    pub(super) rank: usize,
    pub(super) motor: String,
    pub(super) made_for: String,
    pub(super) gearbox: String,
    pub(super) ratio: String,
    pub(super) amplifier: String,
    pub(super) resistor: String,
    pub(super) power: String,
    pub(super) mass: String,
    pub(super) price: String,
    pub(super) rms: String,
    pub(super) peak: String,
    pub(super) lambda: String,
    pub(super) remarks: String,
}

impl FitRow {
    pub(super) fn of(rank: usize, judged: &Assessment) -> Self {
        let drive = &judged.drive;
        let named = |verdict: RuleVerdict| -> Vec<&str> {
            let checks = judged.checks.iter().filter(|c| c.verdict == verdict);
            checks.map(|c| c.rule).collect()
        };
        let mut remarks = Vec::new();
        for verdict in [RuleVerdict::Warn, RuleVerdict::NotChecked] {
            let rules = named(verdict);
            if !rules.is_empty() {
                remarks.push(format!("{}: {}", verdict.word(), rules.join(", ")));
            }
        }
        if !drive.from_makers() {
            remarks.push("figures not from the maker's own document".to_owned());
        }
        if !drive.is_paired() {
            remarks.push("no source pairs this amplifier with this motor".to_owned());
        }
        let power = judged.rated_power();
        Self {
            rank,
            motor: format!("{} {}", drive.motor.maker, drive.motor.model),
            made_for: (drive.motor.made_for()).map_or("–".to_owned(), |made| made.words()),
            gearbox: drive
                .gearbox
                .map_or("direct".into(), |g| format!("{} {}", g.maker, g.model)),
            ratio: rounded(drive.ratio()),
            amplifier: drive
                .amplifier
                .map_or(NO_PART.into(), |a| format!("{} {}", a.maker, a.model)),
            resistor: judged
                .resistor
                .map_or(NO_PART.into(), |r| format!("{} {}", r.maker, r.model)),
            mass: figure(drive.mass()),
            price: figure(judged.price()),
            power: power.map_or("–".to_owned(), |p| {
                format!("{} kW", significant(p / 1000.0, 3))
            }),
            rms: judged.used(Rule::RmsTorque),
            peak: judged.used(Rule::PeakTorque),
            lambda: short(judged.duty.inertia_ratio.max),
            remarks: remarks.join("; "),
        }
    }
}

/// A contribution to the motor torque, with a bar.
pub(super) struct ShareRow {
    pub(super) name: String,
    pub(super) rms: String,
    pub(super) peak: String,
    pub(super) at_peak: String,
    pub(super) energy: String,
    pub(super) share: String,
    /// Length of the bar (%).
    pub(super) bar: f64,
    /// Whether it reduces the RMS torque.
    pub(super) negative: bool,
}

/// The rows of `shares` of a breakdown, and their total.
pub(super) fn share_rows(shares: &[Share], breakdown: &Breakdown) -> Vec<ShareRow> {
    let total = &breakdown.total;
    let rows = shares.iter().chain([total]).map(|share| ShareRow {
        name: share.name.clone(),
        rms: shown(share.torque.rms, total.torque.rms),
        peak: shown(share.torque.peak(), total.torque.peak()),
        at_peak: shown(share.at_peak, total.at_peak),
        energy: shown(share.energy, breakdown.turned_over()),
        share: percent(share.mean_square),
        bar: (share.mean_square.abs() * 100.0).min(100.0).round(),
        negative: share.mean_square < 0.0,
    });
    rows.collect()
}

/// A part's inertia at the motor: name, min, mean, max, share, length of the bar (%).
pub(super) struct InertiaRow {
    pub(super) name: String,
    pub(super) figures: [String; 3],
    pub(super) share: String,
    pub(super) bar: f64,
}

pub(super) fn inertia_rows(breakdown: &Breakdown) -> Vec<InertiaRow> {
    let scale = breakdown.words.inertia.scale;
    let row = |share: &InertiaShare| InertiaRow {
        name: share.name.clone(),
        figures: [share.inertia.min, share.inertia.mean, share.inertia.max]
            .map(|x| shown(x / scale, share.inertia.max / scale)),
        share: percent(share.of_mean),
        bar: (share.of_mean * 100.0).clamp(0.0, 100.0).round(),
    };
    let all = breakdown.inertia.iter().chain([&breakdown.total_inertia]);
    all.map(row).collect()
}

/// A drive with the changes that would make it suitable, or the range of each quantity.
#[derive(Default)]
pub(super) struct ChangeRow {
    pub(super) drive: String,
    pub(super) misses: Vec<String>,
    pub(super) changes: Vec<String>,
}

impl ChangeRow {
    pub(super) fn of(remedies: &Remedies, duration: f64) -> Self {
        let misses = remedies.misses.iter();
        let changes = remedies.remedies.iter();
        Self {
            drive: remedies.drive.clone(),
            misses: misses.map(|m| m.sentence(remedies.words)).collect(),
            changes: changes
                .map(|r| r.sentence(duration, remedies.words))
                .collect(),
        }
    }
}

/// A rule of the set: name, limit, warning, source.
pub(super) fn rule_rows(rules: &RuleSet, words: &Vocabulary) -> Vec<[String; 4]> {
    let limit_of = |share: Option<f64>| share.map_or(String::new(), short);
    Rule::ALL
        .into_iter()
        .filter(|rule| rules.shows(*rule))
        .map(|rule| {
            let limit = rules.limit(rule);
            let fail = if rules.is_off(rule) {
                "off".to_owned()
            } else {
                limit_of(limit.fail)
            };
            let source = rules.source(rule).to_owned();
            [
                rule.named(words).to_owned(),
                fail,
                limit_of(limit.warn),
                source,
            ]
        })
        .collect()
}

/// Minimum, mean, maximum and RMS values from the drive link, in its own terms, to the motor.
pub(super) fn duty_rows(
    best: &Assessment,
    duty: &Duty,
    input: &str,
    link: &Vocabulary,
    words: &Vocabulary,
) -> Vec<(String, Vec<String>)> {
    let row = |name: String, figures: Figures, unit: f64| {
        let cells = figures.values().map(|x| rounded(x / unit));
        (name, cells.to_vec())
    };
    let (word, torque) = (words.torque, words.torque.unit);
    let (speed, scale) = (words.speed.unit, words.speed.scale);
    vec![
        row(
            format!(
                "{} at the drive link [{}], without drive train",
                link.torque, link.torque.unit
            ),
            duty.figures(|i| i.terms.total()),
            1.0,
        ),
        row(
            format!("speed of the drive link [{}]", link.speed.unit),
            duty.figures(|i| i.omega),
            link.speed.scale,
        ),
        row(
            format!("{word} at the {input}, losses and drive train included [{torque}]"),
            duty.figures(|i| i.input_torque),
            1.0,
        ),
        row(format!("motor {word} [{torque}]"), best.duty.torque, 1.0),
        row(format!("motor speed [{speed}]"), best.duty.speed, scale),
        row("motor power [W]".to_owned(), best.duty.power, 1.0),
        row(
            format!("{} ratio λ", words.inertia),
            best.duty.inertia_ratio,
            1.0,
        ),
    ]
}
