//! The answer of `jred bus` as JSON.

use serde_json::{Value, json};

use jred_machine::model::rule::Sense;
use jred_sizing::bus::answer::Answer;
use jred_sizing::bus::cure::{Bound, Change};
use jred_sizing::bus::curve::PowerCurve;
use jred_sizing::bus::period::{Common, LOOKED_AT, MOST_CYCLES};
use jred_sizing::bus::verdict::Judged;

/// The answer with every digit.
pub fn json(answer: &Answer) -> Value {
    let checks = answer.checks().into_iter().map(|check| {
        json!({
            "check": check.name(),
            "value": finite(check.figure),
            "limit": check.limit,
            "at least": check.sense() == Sense::AtLeast,
            "unit": check.unit(),
            "holds": check.holds(),
        })
    });
    let worst = answer
        .worst
        .as_ref()
        .map(|[voltage, resistor, peak, pulse]| {
            json!({
                "voltage": voltage,
                "resistor": resistor,
                "peak": peak,
                "pulse": pulse,
                "exhaustive": answer.axes.len() <= 3,
            })
        });
    let open = answer.open();
    let not_checked = open.iter().map(|o| format!("{}: {}", o.figure, o.words));
    let not_known = open
        .iter()
        .filter(|o| !o.keys.is_empty())
        .map(|o| json!({ "figure": o.figure, "any of": o.keys }));
    let lacks: serde_json::Map<String, Value> = (answer.lacks().into_iter())
        .map(|(what, by)| {
            let name = match what {
                Judged::Mean => "mean [W]",
                Judged::Peak => "peak [W]",
                Judged::Pulse => "pulse [J]",
                _ => "resistance [Ohm]",
            };
            (name.to_owned(), json!(by))
        })
        .collect();
    let conflict = answer
        .conflict()
        .map(|conflict| json!({ "any of": conflict.keys(), "words": conflict.words() }));
    json!({
        "schema": "jred-bus/1",
        "axes": axes_json(answer),
        "period [s]": answer.power.as_ref().map(PowerCurve::period),
        "common period": common_json(answer),
        "in step": answer.in_step,
        "worst": worst,
        "most room": answer.calmest,
        "bounds": {
            "peak drawn [W]": answer.bounds.drawn,
            "peak fed back [W]": answer.bounds.back,
            "highest voltage [V]": finite(answer.bounds.highest),
            "resistor mean [W]": answer.bounds.resistor,
        },
        "saved by sharing [W]": answer.saved(),
        "brake resistor lacks": lacks,
        "brake resistor needed": answer.need,
        "proposal": answer.proposal,
        "brake resistor chosen": answer.chosen,
        "conflict": conflict,
        "checks": checks.collect::<Vec<_>>(),
        "not checked": not_checked.collect::<Vec<_>>(),
        "not known": not_known.collect::<Vec<_>>(),
        "cures": cures_json(answer),
        "holds": answer.holds(),
    })
}

fn axes_json(answer: &Answer) -> Vec<Value> {
    let axes = answer.axes.iter().map(|axis| {
        let [drawn, back] = axis.curve.energies();
        let [least, most] = axis.curve.extremes();
        json!({
            "title": axis.title,
            "drive": axis.drive,
            "holds": axis.holds,
            "period [s]": axis.curve.period(),
            "drawn [J]": drawn,
            "fed back [J]": back,
            "peak drawn [W]": most.max(0.0),
            "peak fed back [W]": (-least).max(0.0),
        })
    });
    axes.collect()
}

fn common_json(answer: &Answer) -> Value {
    match answer.shared.common() {
        Common::Searched { period, cycles } => json!({
            "kind": "searched", "period [s]": period, "cycles": cycles, "most cycles": MOST_CYCLES,
        }),
        Common::TooLong { period, cycles } => json!({
            "kind": "too long", "period [s]": period, "cycles": cycles, "most cycles": MOST_CYCLES,
        }),
        Common::None => json!({
            "kind": "none", "period [s]": null, "cycles": null, "most cycles": LOOKED_AT,
        }),
    }
}

fn cures_json(answer: &Answer) -> Vec<Value> {
    let change = |change: &Change| {
        let (least, most) = match change.bound {
            Bound::AtLeast(value) => (Some(value), None),
            Bound::AtMost(value) => (None, Some(value)),
        };
        json!({ "key": change.key, "at least": least, "at most": most, "unit": change.unit })
    };
    let cures = answer.cures.iter().map(|cure| {
        let changes: Vec<Value> = cure.changes.iter().map(change).collect();
        json!({ "changes": changes, "phases [s]": cure.phases, "words": cure.words })
    });
    cures.collect()
}

fn finite(x: f64) -> Option<f64> {
    x.is_finite().then_some(x)
}
