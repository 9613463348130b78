//! The check of a machine.

mod data;
mod words;

use jred::Domain;

use crate::answer::Answer;
use crate::table::output::Format as Full;
use crate::table::reading::Reading;
use jred_analysis::inspect::{Findings, MotionFindings, NEAR_DEAD_POINT, RECOMMENDED};
use jred_file::model::coordinate::Coordinate;
use jred_file::number::rounding::{short, shown};
use jred_sizing::cell::Cell;

pub(crate) use data::CheckData;
pub(crate) use words::change_points;
use words::exponent;

jred_file::words! {
    /// Format of an answer without columns.
    pub enum AnswerFormat default Table {
        /// For reading.
        Table = "table",
        /// JSON, every digit.
        Json = "json",
    }
}

impl From<AnswerFormat> for Full {
    fn from(format: AnswerFormat) -> Self {
        match format {
            AnswerFormat::Table => Self::Table,
            AnswerFormat::Json => Self::Json,
        }
    }
}

/// The verdict, the findings, and tables of segments and joints.
pub fn answer(findings: &Findings) -> Answer<'static> {
    let c = findings.coordinate;
    let title = format!("{}: {}", findings.title, findings.kind);
    let mut answer = Answer::new(findings.title.clone(), &data::data(findings)).titled(title);
    let violations = words::violations(findings);
    for violation in &violations {
        answer.fact("violated", violation);
    }
    if violations.is_empty() {
        answer.fact(
            "result",
            format!(
                "every check is satisfied: {}; `jred size` judges drives",
                words::checked(findings).join(", ")
            ),
        );
    }
    answer.fact(
        "degrees of freedom",
        format!(
            "3·{} links − {} constraints = {}",
            findings.links,
            findings.constraints(),
            findings.freedoms()
        ),
    );
    let range = match findings.domain {
        Domain::Turn => "the drive link turns without end".to_owned(),
        Domain::Stroke { from, to } => format!(
            "{} = {} to {} {}",
            c.symbol(),
            short(c.shown(from)),
            short(c.shown(to)),
            c.unit()
        ),
    };
    answer.fact("range", range);
    if let Some(gap) = findings.closure {
        answer.fact(
            "closure",
            format!(
                "the speeds of all links repeat after a turn to within {}",
                exponent(gap)
            ),
        );
    }
    motions(findings, &mut answer);
    inertia(findings, &mut answer);
    answer.fact(
        format!("drive {}", c.vocabulary().torque),
        format!(
            "by d'Alembert's principle and by the reduced equation: they differ by {} of the largest term{}",
            exponent(findings.agreement.dalembert),
            if findings.agreement.of_motion {
                ""
            } else {
                ", at unit speed"
            }
        ),
    );
    if let Some(balance) = findings.agreement.energy {
        answer.fact(
            "energy balance",
            format!(
                "error {} of the energy that the drive moves over the motion",
                exponent(balance)
            ),
        );
    }
    for note in words::before(findings) {
        answer.sentence(note);
    }
    for warning in &findings.warnings {
        answer.warning(warning);
    }
    for note in words::after(findings) {
        answer.sentence(note);
    }
    if let Some(motion) = &findings.motion {
        segments(motion, c, &mut answer);
    }
    joints(findings, &mut answer);
    answer
}

fn joints(findings: &Findings, answer: &mut Answer) {
    answer.heading("joints");
    let columns = [
        "joint",
        "kind",
        "first body",
        "second body",
        "constraints",
        "",
    ];
    let rows = findings.joints.iter().map(|joint| {
        let [first, second] = joint.bodies.clone();
        let driven = if joint.driven { "drive" } else { "" };
        let cells = [
            joint.name.clone(),
            joint.kind.to_owned(),
            first,
            second,
            joint.constraints.to_string(),
            driven.to_owned(),
        ];
        cells.map(Cell::from).to_vec()
    });
    answer.table(Reading::new(columns, rows, columns.len()));
}

/// The reduced inertia, over the range and over the time of the motion, and the mass.
fn inertia(findings: &Findings, answer: &mut Answer) {
    let c = findings.coordinate;
    let unit = c.inertia_unit();
    let [min, mean, max] = findings.inertia.reduced.map(short);
    let flywheel = short(findings.inertia.flywheel);
    answer.fact(
        c.inertia(),
        format!("{min} to {max} {unit}, mean {mean} {unit}, of which flywheel and drive train {flywheel} {unit}"),
    );
    if let Some(laden) = findings.inertia.laden {
        let [min, mean, max] = laden.map(short);
        answer.fact(
            format!("{} with payloads", c.inertia()),
            format!(
                "{min} to {max} {unit}, mean {mean}, over the time of the motion, with carriages"
            ),
        );
    }
    let mass = short(findings.inertia.mass);
    answer.fact("mass of the links", format!("{mass} kg"));
}

/// Travels of the links, transmission, branch.
fn motions(findings: &Findings, answer: &mut Answer) {
    let c = findings.coordinate;
    for travel in &findings.travels {
        answer.fact("travel", words::travel(travel, c));
    }
    if let Some(transmission) = &findings.transmission {
        let verdict = if transmission.index < NEAR_DEAD_POINT {
            "CLOSE TO A DEAD POINT"
        } else if transmission.index < RECOMMENDED {
            "below the recommended 40 deg"
        } else {
            "ok"
        };
        let angle = transmission.angle;
        let angle = angle.map(|angle| format!("a transmission angle of {} deg", short(angle)));
        let links = Some(transmission.links.join(", ")).filter(|links| !links.is_empty());
        let because: Vec<String> = [angle, links].into_iter().flatten().collect();
        let because = if because.is_empty() {
            String::new()
        } else {
            format!(" ({})", because.join("; "))
        };
        answer.fact(
            "transmission index",
            format!(
                "at least {} {}{because}: {verdict}",
                short(transmission.index),
                words::place(transmission, c)
            ),
        );
        let branch = if transmission.branch_kept {
            "the same over the whole range"
        } else {
            "CHANGES"
        };
        answer.fact("branch", branch);
    }
    for fact in words::facts(findings) {
        answer.fact(fact.label, fact.text);
    }
}

/// The motion, segment by segment, with the characteristic values of VDI 2143.
fn segments(motion: &MotionFindings, drive: Coordinate, answer: &mut Answer) {
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
    answer.heading(format!(
        "motion{of}: {} s{}; the drive link {way}, at up to {} and {}",
        short(motion.duration),
        if motion.cyclic { ", repeated" } else { "" },
        rate(drive, motion.speed, ""),
        rate(drive, motion.acceleration, "^2")
    ));
    let columns = [
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
    ];
    let rows = motion.segments.iter().enumerate().map(|(k, segment)| {
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
        cells.into_iter().map(Cell::from).collect()
    });
    answer.table(Reading::new(columns, rows, columns.len()));
}
