//! The answer of `jred bus` as JSON.

use serde_json::{Value, json};

use super::command::Answer;
use super::cure::{Bound, Change};
use super::curve::PowerCurve;
use super::period::{Common, LOOKED_AT, MOST_CYCLES};
use super::verdict::Judged;
use crate::cli::bus::Bus as Options;
use crate::rule::Sense;

impl Answer {
    pub(super) fn json(&self, options: &Options) -> Value {
        let checks = self.checks(options).into_iter().map(|check| {
            json!({
                "check": check.name(),
                "value": finite(check.figure),
                "limit": check.limit,
                "at least": check.sense() == Sense::AtLeast,
                "unit": check.unit(),
                "holds": check.holds(),
            })
        });
        let worst = self.worst.as_ref().map(|[voltage, resistor, peak, pulse]| {
            json!({
                "voltage": voltage,
                "resistor": resistor,
                "peak": peak,
                "pulse": pulse,
                "exhaustive": self.axes.len() <= 3,
            })
        });
        let open = self.open(options);
        let not_checked = open.iter().map(|o| format!("{}: {}", o.figure, o.words));
        let not_known = open
            .iter()
            .filter(|o| !o.keys.is_empty())
            .map(|o| json!({ "figure": o.figure, "any of": o.keys }));
        let lacks: serde_json::Map<String, Value> = (self.lacks(options).into_iter())
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
        let conflict = self
            .conflict(options)
            .map(|conflict| json!({ "any of": conflict.keys(), "words": conflict.words() }));
        json!({
            "schema": "jred-bus/1",
            "axes": self.axes_json(),
            "period [s]": self.power.as_ref().map(PowerCurve::period),
            "common period": self.common_json(),
            "in step": self.in_step,
            "worst": worst,
            "most room": self.calmest,
            "bounds": {
                "peak drawn [W]": self.bounds.drawn,
                "peak fed back [W]": self.bounds.back,
                "highest voltage [V]": finite(self.bounds.highest),
                "resistor mean [W]": self.bounds.resistor,
            },
            "saved by sharing [W]": self.saved(),
            "brake resistor lacks": lacks,
            "brake resistor needed": self.need,
            "proposal": self.proposal,
            "conflict": conflict,
            "checks": checks.collect::<Vec<_>>(),
            "not checked": not_checked.collect::<Vec<_>>(),
            "not known": not_known.collect::<Vec<_>>(),
            "cures": self.cures_json(),
            "holds": self.holds(options),
        })
    }

    fn axes_json(&self) -> Vec<Value> {
        let axes = self.axes.iter().map(|axis| {
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

    fn common_json(&self) -> Value {
        match self.shared.common() {
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

    fn cures_json(&self) -> Vec<Value> {
        let change = |change: &Change| {
            let (least, most) = match change.bound {
                Bound::AtLeast(value) => (Some(value), None),
                Bound::AtMost(value) => (None, Some(value)),
            };
            json!({ "key": change.key, "at least": least, "at most": most, "unit": change.unit })
        };
        let cures = self.cures.iter().map(|cure| {
            let changes: Vec<Value> = cure.changes.iter().map(change).collect();
            json!({ "changes": changes, "phases [s]": cure.phases, "words": cure.words })
        });
        cures.collect()
    }
}

fn finite(x: f64) -> Option<f64> {
    x.is_finite().then_some(x)
}
