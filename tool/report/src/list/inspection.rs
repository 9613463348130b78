//! What the check of a mechanism found, for reading and as JSON.

use std::fmt::Write as _;

use jred::Domain;
use serde_json::{Value, json};

use crate::table::output::text_table;
use jred_machine::analysis::inspect::{Findings, MotionFindings, NEAR_DEAD_POINT, RECOMMENDED};
use jred_machine::model::coordinate::Coordinate;
use jred_machine::number::rounding::{short, shown};

jred_machine::words! {
    /// How findings are written.
    pub enum Format default Table {
        /// For reading.
        Table = "table",
        /// JSON, every digit.
        Json = "json",
    }
}

/// For reading.
pub fn text(findings: &Findings) -> String {
    format!(
        "{}: {}\n\n{}",
        findings.title,
        findings.kind,
        untitled(findings)
    )
}

/// The same without its title.
pub(crate) fn untitled(findings: &Findings) -> String {
    let c = findings.coordinate;
    let mut text = String::new();
    let _ = writeln!(
        text,
        "degrees of freedom: 3·{} links − {} constraints = {}",
        findings.links,
        findings.constraints(),
        findings.freedoms()
    );
    let mut table = text_table(&[
        "joint",
        "kind",
        "first body",
        "second body",
        "constraints",
        "",
    ]);
    for joint in &findings.joints {
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
    let range = match findings.domain {
        Domain::Turn => "it turns without end".to_owned(),
        Domain::Stroke { from, to } => format!(
            "{} = {} to {} {}",
            c.symbol(),
            short(c.shown(from)),
            short(c.shown(to)),
            c.unit()
        ),
    };
    let _ = writeln!(text, "range of the drive link: {range}");
    if let Some(gap) = findings.closure {
        let gap = exponent(gap);
        let _ = writeln!(
            text,
            "closure: the speeds of all links repeat after a turn to within {gap}"
        );
    }
    write_motion(findings, &mut text);
    write_inertia(findings, &mut text);
    let _ = writeln!(
        text,
        "drive {} by d'Alembert's principle and by the reduced equation differ by {} of the largest term{}",
        if c == Coordinate::Angle {
            "torque"
        } else {
            "force"
        },
        exponent(findings.agreement.dalembert),
        if findings.agreement.of_motion {
            ""
        } else {
            ", at unit speed"
        }
    );
    if let Some(balance) = findings.agreement.energy {
        let _ = writeln!(
            text,
            "energy balance over the motion: error {} of the energy that the drive moves",
            exponent(balance)
        );
    }
    if let Some(motion) = &findings.motion {
        write_segments(motion, c, &mut text);
    }
    for note in &findings.notes {
        let _ = writeln!(text, "{note}");
    }
    text += &verdict(findings);
    text
}

/// The reduced inertia, over the range and over the time of the motion, and the mass.
fn write_inertia(findings: &Findings, text: &mut String) {
    let c = findings.coordinate;
    let [min, mean, max] = findings.inertia.reduced;
    let _ = writeln!(
        text,
        "{}: {} to {} {}, mean {}, of which flywheel and drive train {}",
        c.inertia(),
        short(min),
        short(max),
        c.inertia_unit(),
        short(mean),
        short(findings.inertia.flywheel)
    );
    if let Some([min, mean, max]) = findings.inertia.laden {
        let _ = writeln!(
            text,
            "{} over the time of the motion, with payloads and carriages: {} to {} {}, mean {}",
            c.inertia(),
            short(min),
            short(max),
            c.inertia_unit(),
            short(mean)
        );
    }
    let _ = writeln!(
        text,
        "mass of the links: {} kg",
        short(findings.inertia.mass)
    );
}

/// What is violated, or else what was checked.
fn verdict(findings: &Findings) -> String {
    let violations = findings.violations();
    if violations.is_empty() {
        return format!(
            "\nevery check is satisfied: {}; `jred size` judges drives\n",
            findings.checked().join(", ")
        );
    }
    let mut text = String::new();
    for violation in violations {
        let _ = writeln!(text, "\nviolated: {violation}");
    }
    text
}

/// Travels of the links, transmission, branch.
fn write_motion(findings: &Findings, text: &mut String) {
    let c = findings.coordinate;
    for travel in &findings.travels {
        let _ = writeln!(text, "{}", travel.sentence(c));
    }
    if let Some(transmission) = &findings.transmission {
        let verdict = if transmission.index < NEAR_DEAD_POINT {
            "CLOSE TO A DEAD POINT"
        } else if transmission.index < RECOMMENDED {
            "below the recommended 40 deg"
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
            "the same over the whole range"
        } else {
            "CHANGES"
        };
        let _ = writeln!(text, "branch: {branch}");
    }
    for fact in &findings.facts {
        let _ = writeln!(text, "{}: {}", fact.label, fact.text);
    }
}

/// The motion, segment by segment, with the characteristic values of VDI 2143.
fn write_segments(motion: &MotionFindings, drive: Coordinate, text: &mut String) {
    let rate = |coordinate: Coordinate, value: f64, order: &str| {
        let unit = match coordinate {
            Coordinate::Angle => "rad",
            Coordinate::Length => "m",
        };
        format!("{} {unit}/s{order}", short(value))
    };
    let of = if motion.of == "drive link" {
        String::new()
    } else {
        format!(" of {}", motion.of)
    };
    let advance = shown(drive.shown(motion.advance), drive.shown(1.0));
    let way = if advance == "0" {
        "comes back".to_owned()
    } else {
        format!("goes on by {advance} {}", drive.unit())
    };
    let _ = writeln!(
        text,
        "motion{of}: {} s{}; the drive link {way}, at up to {} and {}",
        short(motion.duration),
        if motion.cyclic { ", repeated" } else { "" },
        rate(drive, motion.speed, ""),
        rate(drive, motion.acceleration, "^2")
    );
    let mut table = text_table(&[
        "segment",
        "duration",
        "distance",
        "speed",
        "acceleration",
        "jerk",
        "C_v",
        "C_a",
        "C_j",
        "C_Mdyn",
    ]);
    for (k, segment) in motion.segments.iter().enumerate() {
        let c = segment.coordinate();
        let mut cells = vec![
            (k + 1).to_string(),
            format!("{} s", short(segment.duration)),
        ];
        match segment.coefficients {
            None => cells.extend(std::iter::repeat_n(String::new(), 8)),
            Some(values) => {
                cells.push(format!("{} {}", short(c.shown(segment.distance)), c.unit()));
                cells.push(rate(c, segment.speed, ""));
                cells.push(rate(c, segment.acceleration, "^2"));
                let jumps = || "jumps".to_owned();
                cells.push(segment.jerk.map_or_else(jumps, |jerk| rate(c, jerk, "^3")));
                let known = values.map(|value| value.map_or_else(|| "∞".to_owned(), short));
                cells.extend(known);
            }
        }
        table.add_row(cells);
    }
    let _ = writeln!(text, "{table}");
}

/// Everything, with every digit.
pub fn json(findings: &Findings) -> Value {
    let range = match findings.domain {
        Domain::Turn => json!("turn"),
        Domain::Stroke { from, to } => json!([from, to]),
    };
    json!({
        "schema": "jred-check/1",
        "title": findings.title,
        "mechanism": findings.kind,
        "drive coordinate": match findings.coordinate { Coordinate::Angle => "angle [rad]", Coordinate::Length => "displacement [m]" },
        "degrees of freedom": findings.freedoms(),
        "links": findings.links,
        "constraints": findings.constraints(),
        "joints": findings.joints,
        "range": range,
        "closure": findings.closure,
        "travels": findings.travels,
        "transmission": findings.transmission,
        "inertia": findings.inertia,
        "agreement": findings.agreement,
        "motion": findings.motion,
        "facts": findings.facts,
        "notes": findings.notes,
        "violations": findings.violations(),
    })
}

/// A small share, such as `1.6e-16`.
fn exponent(x: f64) -> String {
    if x == 0.0 {
        "0".to_owned()
    } else {
        format!("{x:.1e}")
    }
}
