//! Sentences about the checks of a drive: one file for each family of rules.
//!
//! The `words` of a family are the rating, such as "S1 torque at mean speed", or the missing data if the rule is not checked; and where or how the
//! value was determined, which may be empty.

mod brake;
mod electric;
mod elements;
mod gearbox;
mod motor;
mod site;
mod stiffness;
mod thermal;
mod voltage;

use schemars::JsonSchema;
use serde::Serialize;

use jred_file::model::rule::{Rule, Sense};
use jred_file::model::rules::RuleVerdict;
use jred_file::number::rounding::short;
use jred_sizing::catalogue::Drive;
use jred_sizing::judge::check::Check;
use jred_sizing::judge::{Assessment, Assumption, Grounds};

/// A rule with its value, limit and verdict.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "Check")]
pub(super) struct CheckData {
    /// Name of the rule.
    rule: &'static str,
    /// The rule.
    id: Rule,
    /// The value, in `unit`; `None` if unknown.
    value: Option<f64>,
    /// Its limit, in `unit`; `None` without data in the catalogue.
    limit: Option<f64>,
    /// Unit of figure and limit.
    unit: &'static str,
    /// Margin as a share of the limit; `None` without a limit, or for a yes-or-no rule.
    margin: Option<f64>,
    /// Verdict.
    verdict: RuleVerdict,
    /// How the limit is computed, or the missing data.
    note: String,
    /// Source of the limit.
    source: String,
}

impl From<&Check> for CheckData {
    fn from(check: &Check) -> Self {
        Self {
            rule: check.rule,
            id: check.id,
            value: check.value,
            limit: check.limit,
            unit: check.unit,
            margin: check.margin,
            verdict: check.verdict,
            note: note(check),
            source: check.source.clone(),
        }
    }
}

/// How the limit is computed, or the missing data.
pub fn note(check: &Check) -> String {
    let (unit, finding, limit) = (check.unit, check.finding, check.shares);
    let (rating, place) = words(check);
    let shown = |x: f64| x / check.scale;
    let mut note = match limit.fail.or(limit.warn) {
        None => "switched off".to_owned(),
        _ if !finding.is_known() => format!("no data: {rating}"),
        Some(_) if !finding.rating.is_finite() => format!("no limit: {rating}"),
        Some(share) if unit.is_empty() => {
            format!("{} {rating}", short(share * shown(finding.rating)))
        }
        Some(share) if unit == "%" => {
            format!("{} % of the {rating}", short(share * shown(finding.rating)))
        }
        Some(share) => {
            let share = if check.id.is_ratio() {
                format!("{} times", short(share))
            } else {
                format!("{:.0} % of", share * 100.0)
            };
            let shown = short(shown(finding.rating));
            format!("{share} {shown} {unit}, the {rating}")
        }
    };
    if check.verdict == RuleVerdict::Warn
        && let Some(warn) = limit.warn.filter(|_| limit.fail.is_some())
    {
        let beyond = match check.id.sense() {
            Sense::AtMost => "above",
            Sense::AtLeast => "below",
        };
        let warn = short(shown(warn * finding.rating));
        note += format!("; warning {beyond} {warn} {unit}").trim_end();
    }
    if !place.is_empty() {
        note += ", ";
        note += &place;
    }
    note
}

/// The missing data of a rule that is not checked.
pub fn missing(check: &Check) -> String {
    words(check).0
}

fn words(check: &Check) -> (String, String) {
    use Rule::{
        Altitude, AmbientTemperature, AmplifierVoltage, Backlash, BeltForce, BeltPretension,
        BeltTension, BrakeResistance, BrakeTorque, BrakeWork, BusVoltage, CabinetTemperature,
        ConstantTorque, GearboxAxial, GearboxCubicMean, GearboxCycles, GearboxEmergency,
        GearboxMeanSpeed, GearboxPeak, GearboxRadial, GearboxSpeed, HoldingTorque,
        HousingTemperature, InertiaRatio, MotorVoltage, NaturalFrequency, Overload, PeakCurrent,
        PeakTorque, PinionForce, ResistorPeak, ResistorPower, ResistorPulse, RmsCurrent, RmsTorque,
        ScrewBuckling, ScrewForce, ScrewSpeed, Speed, WindingTemperature,
    };
    if let Grounds::Missing(figure) = check.grounds
        && !check.finding.is_known()
    {
        return (figure.to_owned(), String::new());
    }
    match check.id {
        BrakeTorque => brake::of_torque(check),
        BrakeWork => brake::of_work(check),
        AmbientTemperature | CabinetTemperature | Altitude => site::words(check),
        RmsTorque | PeakTorque | Speed | HoldingTorque | ConstantTorque | InertiaRatio => {
            motor::words(check)
        }
        GearboxPeak | GearboxCubicMean | GearboxEmergency | GearboxMeanSpeed | GearboxSpeed
        | GearboxCycles => gearbox::words(check),
        WindingTemperature | HousingTemperature => thermal::words(check),
        MotorVoltage | AmplifierVoltage => voltage::words(check),
        GearboxRadial | GearboxAxial => elements::of_shaft(check),
        BeltTension | BeltForce | BeltPretension | ScrewForce | ScrewBuckling | ScrewSpeed
        | PinionForce => elements::words(check),
        NaturalFrequency => stiffness::of_frequency(check),
        Backlash => stiffness::of_backlash(check),
        RmsCurrent | PeakCurrent | Overload | BusVoltage | BrakeResistance | ResistorPower
        | ResistorPeak | ResistorPulse => electric::words(check),
    }
}

/// Figure, limit and the limit's description, as one sentence.
pub fn sentence(check: &Check) -> String {
    let against = format!("{} {}", check.rule, check.against());
    if check.limit.is_some() {
        format!("{against} ({})", note(check))
    } else {
        format!("{against}: {}", note(check))
    }
}

/// One sentence for each violated rule.
pub fn reasons(judged: &Assessment) -> String {
    let sentences: Vec<String> = sentences(judged, RuleVerdict::Fail).collect();
    sentences.join("; ")
}

/// One sentence for each rule that warns, and each assumption.
pub fn warnings(judged: &Assessment) -> impl Iterator<Item = String> {
    let assumed = assumptions(&judged.drive, &judged.assumptions);
    sentences(judged, RuleVerdict::Warn).chain(assumed)
}

/// Assumptions about a drive, one sentence each.
pub fn assumptions(drive: &Drive, all: &[Assumption]) -> Vec<String> {
    all.iter().map(|one| assumption(drive, *one)).collect()
}

fn assumption(drive: &Drive, assumption: Assumption) -> String {
    let motor = drive.motor;
    let words = motor.kind.vocabulary();
    match assumption {
        Assumption::OtherFigures(part) => format!(
            "{part} data not taken from the maker's own document; check them against the data sheet"
        ),
        Assumption::Pairing => {
            let amplifier = drive.amplifier.map(|a| format!("{} ({})", a.key, a.maker));
            format!(
                "no source pairs amplifier {} with motor {} ({}); ask the makers, or name the amplifier in the column amplifiers of compatibility.csv",
                amplifier.unwrap_or_default(),
                motor.key,
                motor.maker
            )
        }
        Assumption::GearboxEfficiency => {
            "gearbox efficiency not given; using 87 % per stage".to_owned()
        }
        Assumption::HoldingBrake(least) => format!(
            "weight or loads move the machine when the motor is switched off, and the catalogue states no holding brake of \
             this motor; choose it with a brake of at least {} {}, or hold the machine in another way",
            short(least / words.torque.scale),
            words.torque.unit
        ),
        Assumption::Limits(sentence) => sentence(words),
    }
}

fn sentences(judged: &Assessment, verdict: RuleVerdict) -> impl Iterator<Item = String> {
    let checks = judged.checks.iter();
    checks
        .filter(move |check| check.verdict == verdict)
        .map(sentence)
}
