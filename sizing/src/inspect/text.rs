//! Findings for reading, and as JSON.

use std::fmt::Write as _;

use jred::Domain;
use serde_json::{Value, json};

use super::{Findings, NEAR_DEAD_POINT, RECOMMENDED};
use crate::coordinate::Coordinate;
use crate::output::text_table;
use crate::rounding::short;

impl Findings {
    /// For reading.
    pub fn text(&self) -> String {
        let c = self.coordinate;
        let mut text = format!("{}: {}\n\n", self.title, self.kind);
        let _ = writeln!(
            text,
            "degrees of freedom: 3·{} links − {} constraints = {}",
            self.links,
            self.constraints(),
            self.freedoms()
        );
        let mut table = text_table(&[
            "joint",
            "kind",
            "first body",
            "second body",
            "constraints",
            "",
        ]);
        for joint in &self.joints {
            let [first, second] = joint.bodies.clone();
            table.add_row([
                joint.name.clone(),
                joint.kind.to_owned(),
                first,
                second,
                joint.constraints.to_string(),
                if joint.driven { "drive" } else { "" }.to_owned(),
            ]);
        }
        let _ = writeln!(text, "{table}\n");
        let range = match self.domain {
            Domain::Turn => "a full turn".to_owned(),
            Domain::Stroke { from, to } => format!(
                "{} = {} to {} {}",
                c.symbol(),
                short(c.shown(from)),
                short(c.shown(to)),
                c.unit()
            ),
        };
        let _ = writeln!(text, "range of the drive link: {range}");
        if let Some(gap) = self.closure {
            let gap = exponent(gap);
            let _ = writeln!(
                text,
                "closure: the speeds of all links repeat after a turn to {gap}"
            );
        }
        self.write_motion(&mut text);
        let [min, mean, max] = self.inertia.reduced;
        let _ = writeln!(
            text,
            "{}: {} to {} {}, mean {}; flywheel and drive train {} of it",
            c.inertia(),
            short(min),
            short(max),
            c.inertia_unit(),
            short(mean),
            short(self.inertia.flywheel)
        );
        let _ = writeln!(text, "mass of the links: {} kg", short(self.inertia.mass));
        let _ = writeln!(
            text,
            "drive {} by d'Alembert against the reduced equation: {} of its largest term{}",
            if c == Coordinate::Angle {
                "torque"
            } else {
                "force"
            },
            exponent(self.agreement.dalembert),
            if self.agreement.of_motion {
                ""
            } else {
                ", at unit speed"
            }
        );
        if let Some(balance) = self.agreement.energy {
            let _ = writeln!(
                text,
                "energy balance over the motion: {} of the energy that the drive moves",
                exponent(balance)
            );
        }
        for note in &self.notes {
            let _ = writeln!(text, "{note}");
        }
        let violations = self.violations();
        if violations.is_empty() {
            text += "\nevery rule holds\n";
        }
        for violation in violations {
            let _ = writeln!(text, "\nviolated: {violation}");
        }
        text
    }

    /// Travels of the links, transmission, branch.
    fn write_motion(&self, text: &mut String) {
        let c = self.coordinate;
        for travel in &self.travels {
            let _ = writeln!(text, "{}", travel.sentence(c));
        }
        if let Some(transmission) = &self.transmission {
            let verdict = if transmission.index < NEAR_DEAD_POINT {
                "NEAR A DEAD POINT"
            } else if transmission.index < RECOMMENDED {
                "poorer than the recommended 40 deg"
            } else {
                "ok"
            };
            let angle = transmission.angle.map_or_else(String::new, |angle| {
                format!("a transmission angle of {} deg; ", short(angle))
            });
            let _ = writeln!(
                text,
                "smallest transmission index: {} {} ({angle}{}): {verdict}",
                short(transmission.index),
                transmission.place(c),
                transmission.links.join(", ")
            );
            let branch = if transmission.branch_kept {
                "kept over the whole range"
            } else {
                "CHANGES"
            };
            let _ = writeln!(text, "branch: {branch}");
        }
        for fact in &self.facts {
            let _ = writeln!(text, "{}: {}", fact.label, fact.text);
        }
    }

    /// Everything, with every digit.
    pub fn json(&self) -> Value {
        let range = match self.domain {
            Domain::Turn => json!("turn"),
            Domain::Stroke { from, to } => json!([from, to]),
        };
        json!({
            "schema": "jred-check/1",
            "title": self.title,
            "mechanism": self.kind,
            "drive coordinate": match self.coordinate { Coordinate::Angle => "angle [rad]", Coordinate::Length => "displacement [m]" },
            "degrees of freedom": self.freedoms(),
            "links": self.links,
            "constraints": self.constraints(),
            "joints": self.joints,
            "range": range,
            "closure": self.closure,
            "travels": self.travels,
            "transmission": self.transmission,
            "inertia": self.inertia,
            "agreement": self.agreement,
            "facts": self.facts,
            "notes": self.notes,
            "violations": self.violations(),
        })
    }
}

/// A small share, such as `1.6e-16`.
fn exponent(x: f64) -> String {
    if x == 0.0 {
        "0".to_owned()
    } else {
        format!("{x:.1e}")
    }
}
