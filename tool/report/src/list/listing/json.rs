//! A selection as JSON; the form is described in `docs/json.md` and `docs/size.schema.json`.

use serde_json::{Map, Value, json as object};

use super::{Asked, Explanation, List};
use crate::table::json::{array_parts, split_at_entry};
use jred_machine::analysis::duty::Duty;
use jred_machine::model::coordinate::Coordinate;
use jred_machine::model::machine::MachineFile;
use jred_machine::model::rule::Rule;
use jred_sizing::catalogue::MotorKind;
use jred_sizing::judge::cure;
use jred_sizing::select::size::{Candidate, Certainty, Selection};

/// Name and version of the form. The number is raised whenever a key is removed or changes its meaning.
pub const SCHEMA: &str = "jred-size/4";

/// What is said beside the drives.
#[derive(Debug)]
pub struct Notes<'a> {
    /// What may be a mistake in the machine file.
    pub warnings: &'a [String],
    /// Which motion the drives are judged with, if one was made for them.
    pub motion: Option<&'a Value>,
}

/// The listed drives and the one asked for with every digit, and how many there are in all; part by part, a drive each: the text of
/// all drives of a catalogue is many times larger than they are.
pub fn json(
    list: List,
    file: &MachineFile,
    duty: &Duty,
    selection: &Selection,
    notes: &Notes,
    asked: Option<&Asked>,
    explanation: Option<&Explanation>,
) -> impl Iterator<Item = String> {
    let first = selection.fit.first().or(selection.refused.first());
    let shown = asked.map(|asked| &asked.candidate).or(first);
    let kind = shown.map_or(MotorKind::Rotary, |c| c.drive.motor.kind);
    let limits: Map<String, Value> = Rule::ALL
        .into_iter()
        .filter(|rule| selection.rules.shows(*rule))
        .map(|rule| {
            let limit = selection.rules.limit(rule);
            let source = selection.rules.source(rule);
            let limit = object!({ "fail": limit.fail, "warn": limit.warn, "source": source });
            (rule.key().to_owned(), limit)
        })
        .collect();
    // The drive link's own units: a rotary motor may drive a slide through a screw.
    let [effort, speed] = match file.machine.mechanism().coordinate() {
        Coordinate::Angle => ["drive link torque [N m]", "drive link speed [rad/s]"],
        Coordinate::Length => ["drive link force [N]", "drive link speed [m/s]"],
    };
    let classes = selection.classes().into_iter().map(|class| {
        object!({
            "certainty": class.certainty.word(),
            "drives": class.count,
            "rank": class.rank,
            "first": drive(selection, &class.first),
        })
    });
    let gaps = selection.gaps().into_iter().map(|gap| {
        object!({
            "rule": gap.rule.named(kind.vocabulary()),
            "id": gap.rule,
            "drives": gap.count,
            "missing": gap.missing,
            "cure": cure(gap.rule),
        })
    });
    let mut value = object!({
        "schema": SCHEMA,
        "version": env!("CARGO_PKG_VERSION"),
        "title": file.title,
        "cycle [s]": duty.duration,
        effort: duty.figures(|i| i.terms.total()),
        speed: duty.figures(|i| i.omega),
        "input torque [N m]": duty.figures(|i| i.input_torque),
        "input speed [rad/s]": duty.figures(|i| i.input_speed),
        "input inertia [kg m^2]": duty.figures(|i| i.input_inertia),
        "holding torque [N m]": duty.hold_torque,
        "supply": { "mains voltage [V]": file.site.mains_voltage, "bus voltage [V]": file.site.bus_voltage },
        "rules": { "set": selection.rules.name, "title": selection.rules.title, "limits": limits },
        "warnings": notes.warnings,
        "ranking": selection.ranking(kind.vocabulary()),
        "counts": {
            "drives": selection.fit.len() + selection.refused.len(),
            "fit": selection.fit.len(),
            "fit, not all rules checked": selection.partly_checked(),
            "refused": selection.refused.len(),
        },
        "certainties": classes.collect::<Vec<_>>(),
        "not checked": gaps.collect::<Vec<_>>(),
        "violated": violated(selection, kind),
        "fit": Value::Null,
        "refused": Value::Null,
    });
    if let (Some(asked), Some(map)) = (asked, value.as_object_mut()) {
        let mut found = drive(selection, &asked.candidate);
        found["rank"] = asked.rank.into();
        map.insert("asked".to_owned(), found);
    }
    if let (Some(explanation), Some(map)) = (explanation, value.as_object_mut()) {
        map.insert("explanation".to_owned(), object!(explanation));
    }
    if let (Some(motion), Some(map)) = (notes.motion, value.as_object_mut()) {
        map.insert("motion".to_owned(), motion.clone());
    }
    let text = format!("{value:#}\n");
    let (before, rest) = split_at_entry(&text, "fit");
    let (between, after) = split_at_entry(&rest, "refused");
    let fit = list.fit(selection).into_iter();
    let fit = fit.map(|(rank, candidate)| {
        let mut found = drive(selection, &candidate);
        found["rank"] = rank.into();
        found
    });
    let refused = list.refused(selection).into_iter();
    std::iter::once(before)
        .chain(array_parts(fit))
        .chain(std::iter::once(between))
        .chain(array_parts(
            refused.map(|candidate| drive(selection, &candidate)),
        ))
        .chain(std::iter::once(after))
}

/// What the drives are refused for. Where one fits, nobody asks, and it would mean judging all drives in full.
fn violated(selection: &Selection, kind: MotorKind) -> Vec<Value> {
    if !selection.fit.is_empty() {
        return Vec::new();
    }
    let violations = selection.violations().into_iter().map(|violation| {
        object!({
            "rule": violation.rule.named(kind.vocabulary()),
            "id": violation.rule,
            "drives": violation.count,
            "drives, nothing else": violation.alone,
        })
    });
    violations.collect()
}

fn drive(selection: &Selection, candidate: &Candidate) -> Value {
    let judged = selection.judged(candidate);
    let drive = &judged.drive;
    object!({
        "motor": drive.motor.key,
        "gearbox": drive.gearbox.map(|g| &g.key),
        "amplifier": drive.amplifier.map(|a| &a.key),
        "brake resistor": judged.resistor.map(|r| &r.key),
        "ratio": drive.ratio(),
        "mass [kg]": drive.mass(),
        "price": judged.price(),
        "rated power [W]": judged.rated_power(),
        "motor mains voltage [V]": drive.motor.mains_voltage,
        "motor largest bus voltage [V]": drive.motor.made_for().map(|made| made.largest),
        "certainty": candidate.certainty().map(Certainty::word),
        "figures from": if drive.from_makers() { "maker" } else { "other" },
        "verdict": judged.verdict(),
        "duty": judged.duty,
        "checks": judged.checks,
        "assumptions": judged.assumptions,
    })
}
