//! A selection as JSON; docs/json.md says how to read it.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Serialize;
use serde_json::json;

use super::bill::BillData;
use super::{Explanation, Listing};
use crate::answer::Answer;
use crate::answer::schema::Data;
use crate::list::rule_words::{self, CheckData, missing};
use crate::list::suited::MotionData;
use jred_file::model::coordinate::Coordinate;
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleVerdict;
use jred_file::number::figures::Figures;
use jred_sizing::catalogue::MotorKind;
use jred_sizing::cycle::form::MotorDuty;
use jred_sizing::judge::{Assessment, cure};
use jred_sizing::select::size::{Candidate, Certainty, Selection};

/// The JSON of `jred size`: SI units unless a key names another; of a linear motor read N for N m, m/s for rad/s and kg for kg m^2.
#[derive(Serialize, JsonSchema)]
pub(crate) struct SizeData<'a> {
    /// Version of jred.
    version: &'static str,
    /// Duration of a cycle.
    #[serde(rename = "cycle [s]")]
    cycle: f64,
    /// Duty at the drive link, without drive train.
    #[serde(flatten)]
    link: LinkData,
    /// Torque at the input of the drive train, which is the gearbox output.
    #[serde(rename = "input torque [N m]")]
    input_torque: Figures,
    /// Speed at the input of the drive train.
    #[serde(rename = "input speed [rad/s]")]
    input_speed: Figures,
    /// Inertia at the input of the drive train.
    #[serde(rename = "input inertia [kg m^2]")]
    input_inertia: Figures,
    /// Holding torque at the input of the drive train.
    #[serde(rename = "holding torque [N m]")]
    holding: f64,
    /// The supply of the machine file.
    supply: SupplyData,
    /// The rules.
    rules: RulesData<'a>,
    /// Possible mistakes in the machine file.
    warnings: &'a [String],
    /// Order of the suitable drives, in words.
    ranking: String,
    /// Numbers of drives.
    counts: Counts,
    /// The suitable drives by the certainty of their data, the most certain first, which is the order of the ranking.
    certainties: Vec<ClassData<'a>>,
    /// Rules that are not checked for some of the suitable drives.
    #[serde(rename = "not checked")]
    not_checked: Vec<GapData>,
    /// Reasons for which drives are refused, the most frequent first; empty where a drive fits.
    violated: Vec<ViolationData>,
    /// The first drive of each motor, of those that violate no rule, best first: `--top` motors; with `--all-gearboxes` or `--all` every drive.
    #[schemars(with = "Vec<RankedData<'static>>")]
    fit: (),
    /// Drives that violate a rule, those that miss by least first: `--nearest` of them.
    #[schemars(with = "Vec<DriveData<'static>>")]
    refused: (),
    /// The drive of `--why`.
    #[serde(skip_serializing_if = "Option::is_none")]
    asked: Option<RankedData<'a>>,
    /// The parts of the first or requested drive as they are ordered.
    #[serde(rename = "bill of materials")]
    bill: Vec<BillData<'a>>,
    /// Contributions and changes, with `--explain` or `--why`.
    #[serde(skip_serializing_if = "Option::is_none")]
    explanation: Option<&'a Explanation>,
    /// The motion that the drives are judged with, with `--motion best`.
    #[serde(skip_serializing_if = "Option::is_none")]
    motion: Option<&'a MotionData>,
}

impl Data for SizeData<'_> {
    // Raised whenever a key is removed or changes its meaning.
    const FORM: &'static str = "jred-size/4";
}

/// Duty at a drive link that turns or slides.
#[derive(Serialize, JsonSchema)]
#[serde(untagged)]
enum LinkData {
    Turns {
        /// Torque.
        #[serde(rename = "drive link torque [N m]")]
        torque: Figures,
        /// Speed.
        #[serde(rename = "drive link speed [rad/s]")]
        speed: Figures,
    },
    Slides {
        /// Force.
        #[serde(rename = "drive link force [N]")]
        force: Figures,
        /// Speed.
        #[serde(rename = "drive link speed [m/s]")]
        speed: Figures,
    },
}

#[derive(Serialize, JsonSchema)]
struct SupplyData {
    /// Null: not given, or the bus voltage was given itself.
    #[serde(rename = "mains voltage [V]")]
    mains: Option<f64>,
    /// Null: not given; each motor at the voltage of its data.
    #[serde(rename = "bus voltage [V]")]
    bus: Option<f64>,
}

#[derive(Serialize, JsonSchema)]
struct RulesData<'a> {
    /// Name of the set.
    set: &'a str,
    /// Its description.
    title: &'a str,
    /// Limits by the rule's key in `[rules]`: shares of the rating.
    limits: BTreeMap<&'static str, LimitData<'a>>,
}

#[derive(Serialize, JsonSchema)]
struct LimitData<'a> {
    /// Beyond this the rule is violated.
    fail: Option<f64>,
    /// Beyond this there is a warning.
    warn: Option<f64>,
    /// Source of the limit.
    source: &'a str,
}

#[derive(Serialize, JsonSchema)]
struct Counts {
    /// All drives.
    drives: usize,
    /// Drives that violate no rule.
    fit: usize,
    /// Suitable drives with rules that are not checked.
    #[serde(rename = "fit, not all rules checked")]
    partly: usize,
    /// Drives that violate a rule.
    refused: usize,
}

#[derive(Serialize, JsonSchema)]
struct ClassData<'a> {
    /// makers-figures, other-figures, pairing-unknown or voltage-unknown.
    certainty: &'static str,
    /// Number of suitable drives.
    drives: usize,
    /// Rank of the first one.
    rank: usize,
    /// The first one.
    first: DriveData<'a>,
}

#[derive(Serialize, JsonSchema)]
struct GapData {
    /// Name of the rule.
    rule: &'static str,
    /// The rule.
    id: Rule,
    /// Suitable drives that the rule could not judge.
    drives: usize,
    /// Missing data of one of them.
    missing: String,
    /// Keys of the catalogue or the machine file.
    cure: &'static str,
}

#[derive(Serialize, JsonSchema)]
struct ViolationData {
    /// Name of the rule.
    rule: &'static str,
    /// The rule.
    id: Rule,
    /// Refused drives that violate it; rules over time are judged only where all others are satisfied.
    drives: usize,
    /// Refused drives that violate no other rule.
    #[serde(rename = "drives, nothing else")]
    alone: usize,
}

/// A drive with its rank.
#[derive(Serialize, JsonSchema)]
struct RankedData<'a> {
    #[serde(flatten)]
    drive: DriveData<'a>,
    /// Rank among the drives that violate no rule, from 1; null: refused.
    #[schemars(range(min = 1))]
    rank: Option<usize>,
}

/// A drive.
#[derive(Serialize, JsonSchema)]
pub(crate) struct DriveData<'a> {
    /// Key of the motor in the catalogue.
    motor: &'a str,
    /// Key of the gearbox; null: coupled directly.
    gearbox: Option<&'a str>,
    /// Key of the amplifier.
    amplifier: Option<&'a str>,
    /// Key of the brake resistor that was chosen; null: not needed, none fits, or the machine file gives one.
    #[serde(rename = "brake resistor")]
    resistor: Option<&'a str>,
    /// Gear ratio.
    ratio: f64,
    /// Mass of motor, gearbox and amplifier; null: one of them has no data.
    #[serde(rename = "mass [kg]")]
    mass: Option<f64>,
    /// Price of motor, gearbox, amplifier and chosen resistor, in the currency of the catalogue; null: one of them has no data.
    price: Option<f64>,
    /// Rated power.
    #[serde(rename = "rated power [W]")]
    power: Option<f64>,
    /// Mains voltage that the motor is made for; null: not stated.
    #[serde(rename = "motor mains voltage [V]")]
    mains: Option<f64>,
    /// Bus voltage that the rule motor-voltage judges by; null: no voltage is stated.
    #[serde(rename = "motor largest bus voltage [V]")]
    largest: Option<f64>,
    /// makers-figures, other-figures, pairing-unknown or voltage-unknown; null: refused.
    certainty: Option<&'static str>,
    /// maker, or other: not all figures are from the maker's own document.
    #[serde(rename = "figures from")]
    figures: &'static str,
    /// The worst verdict of its rules.
    verdict: RuleVerdict,
    /// Duty of the motor.
    duty: MotorDuty,
    /// The rules.
    checks: Vec<CheckData>,
    /// Assumptions where data are missing.
    assumptions: Vec<String>,
}

/// The listed drives and the requested one with every digit, and the numbers of all. The drives are written one by one: the text of a whole catalogue
/// is many times larger than its drives.
pub(super) fn answer(shown: Listing) -> Answer {
    let (list, selection) = (shown.list, shown.selection);
    let (file, duty) = (shown.file, shown.duty);
    let kind = (shown.shown()).map_or(MotorKind::Rotary, |c| c.drive.motor.kind);
    // In units of the drive link; a rotary motor may drive a slide through a screw.
    let effort = duty.figures(|i| i.terms.total());
    let speed = duty.figures(|i| i.omega);
    let link = match file.machine.mechanism().coordinate() {
        Coordinate::Angle => LinkData::Turns {
            torque: effort,
            speed,
        },
        Coordinate::Length => LinkData::Slides {
            force: effort,
            speed,
        },
    };
    let first = shown.shown().map(|first| selection.judged(&first));
    let bill = first.iter().flat_map(Assessment::bill);
    let bill = bill.map(|item| BillData::from(&item));
    let data = SizeData {
        version: env!("CARGO_PKG_VERSION"),
        cycle: duty.duration,
        link,
        input_torque: duty.figures(|i| i.input_torque),
        input_speed: duty.figures(|i| i.input_speed),
        input_inertia: duty.figures(|i| i.input_inertia),
        holding: duty.hold_torque,
        supply: SupplyData {
            mains: file.site.mains_voltage,
            bus: file.site.bus_voltage,
        },
        rules: rules(selection),
        warnings: shown.warnings,
        ranking: selection.ranking(kind.vocabulary()),
        counts: Counts {
            drives: shown.count(),
            fit: selection.fit.len(),
            partly: selection.partly_checked(),
            refused: selection.refused.len(),
        },
        certainties: classes(selection),
        not_checked: gaps(selection, kind),
        violated: violated(selection, kind),
        fit: (),
        refused: (),
        asked: shown.asked.map(|asked| RankedData {
            drive: drive(selection, &asked.candidate),
            rank: asked.rank,
        }),
        bill: bill.collect(),
        explanation: shown.explanation,
        motion: shown.motion.map(|motion| &motion.data),
    };
    let mut answer = Answer::new(&file.title, &data);
    answer.array("fit", move || {
        let fit = list.fit(selection).into_iter().map(|(rank, candidate)| {
            json!(RankedData {
                drive: drive(selection, &candidate),
                rank: Some(rank),
            })
        });
        Box::new(fit)
    });
    answer.array("refused", move || {
        let refused = list.refused(selection).into_iter();
        Box::new(refused.map(|candidate| json!(drive(selection, &candidate))))
    });
    answer
}

fn rules<'a>(selection: &'a Selection) -> RulesData<'a> {
    let shown = Rule::ALL
        .into_iter()
        .filter(|rule| selection.rules.shows(*rule));
    let limits = shown.map(|rule| {
        let limit = selection.rules.limit(rule);
        let limit = LimitData {
            fail: limit.fail,
            warn: limit.warn,
            source: selection.rules.source(rule),
        };
        (rule.key(), limit)
    });
    RulesData {
        set: &selection.rules.name,
        title: &selection.rules.title,
        limits: limits.collect(),
    }
}

fn classes<'a>(selection: &'a Selection) -> Vec<ClassData<'a>> {
    let classes = selection.classes().into_iter();
    let class = classes.map(|class| ClassData {
        certainty: class.certainty.word(),
        drives: class.count,
        rank: class.rank,
        first: drive(selection, &class.first),
    });
    class.collect()
}

fn gaps(selection: &Selection, kind: MotorKind) -> Vec<GapData> {
    let gaps = selection.gaps().into_iter().map(|gap| GapData {
        rule: gap.rule.named(kind.vocabulary()),
        id: gap.rule,
        drives: gap.count,
        missing: missing(&gap.example),
        cure: cure(gap.rule),
    });
    gaps.collect()
}

/// Reasons for which drives are refused. Empty where one fits: computing them would judge all drives in full.
fn violated(selection: &Selection, kind: MotorKind) -> Vec<ViolationData> {
    if !selection.fit.is_empty() {
        return Vec::new();
    }
    let violations = selection.violations().into_iter();
    let violations = violations.map(|violation| ViolationData {
        rule: violation.rule.named(kind.vocabulary()),
        id: violation.rule,
        drives: violation.count,
        alone: violation.alone,
    });
    violations.collect()
}

fn drive<'c>(selection: &Selection<'c>, candidate: &Candidate<'c>) -> DriveData<'c> {
    let judged = selection.judged(candidate);
    let (power, price, verdict) = (judged.rated_power(), judged.price(), judged.verdict());
    let Assessment {
        drive,
        duty,
        checks,
        assumptions,
        resistor,
        ..
    } = judged;
    DriveData {
        motor: &drive.motor.key,
        gearbox: drive.gearbox.map(|g| g.key.as_str()),
        amplifier: drive.amplifier.map(|a| a.key.as_str()),
        resistor: resistor.map(|r| r.key.as_str()),
        ratio: drive.ratio(),
        mass: drive.mass(),
        price,
        power,
        mains: drive.motor.mains_voltage,
        largest: drive.motor.made_for().map(|made| made.largest),
        certainty: candidate.certainty().map(Certainty::word),
        figures: if drive.from_makers() {
            "maker"
        } else {
            "other"
        },
        verdict,
        duty,
        checks: checks.iter().map(CheckData::from).collect(),
        assumptions: rule_words::assumptions(&drive, &assumptions),
    }
}
