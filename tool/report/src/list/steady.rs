//! The steady cycle and the flywheel, for reading and as JSON.

mod cycle;

use std::fmt::Write as _;

use serde_json::{Map, Value, json};

use crate::table::output::{Format, json_parts, parts};
use cycle::{cycle_json, describe, line, rpm};
use jred_machine::analysis::simulate::Together;
use jred_machine::analysis::steady::{Cycle, Flywheel, Place, Steady, Wheel};
use jred_machine::number::rounding::{percent, short};

/// Name and version of the form in JSON.
const SCHEMA: &str = "jred-steady/1";

/// The result in one of the formats, part by part; CSV is the course alone.
pub fn write<'s>(
    machines: &Together,
    steady: &'s Steady,
    format: Format,
) -> Box<dyn Iterator<Item = String> + 's> {
    let Some(last) = steady.last() else {
        return Box::new(std::iter::empty());
    };
    let course = &last.figures.course;
    match format {
        Format::Csv => parts(course, Format::Csv, ""),
        Format::Table => parts(course, Format::Table, &text(machines, steady)),
        Format::Json => {
            let mut before = Map::new();
            before.insert("schema".into(), SCHEMA.into());
            before.insert("title".into(), machines.title().into());
            let own = steady.cycle.as_ref();
            before.insert("cycle".into(), own.map_or(Value::Null, cycle_json));
            let why = own.err().map(ToString::to_string);
            before.insert("no_cycle".into(), json!(why));
            before.insert("inductance_left_out".into(), steady.settled.into());
            let flywheel = steady.flywheel.as_ref().map(flywheel_json);
            before.insert("flywheel".into(), json!(flywheel));
            Box::new(json_parts(course, before, Map::new()))
        }
    }
}

/// As the terminal shows it, without the course.
pub(crate) fn text(machines: &Together, steady: &Steady) -> String {
    let mut text = format!("{}: steady cycle\n\n", machines.title());
    if steady.settled {
        text += "the inductance of the winding is not counted: the torque is that of the settled current at each speed\n\n";
    }
    match &steady.cycle {
        Ok(cycle) => {
            if steady.flywheel.is_some() {
                text += "without a further flywheel\n";
            }
            describe(&mut text, cycle);
        }
        Err(why) => {
            let _ = writeln!(text, "without a further flywheel: {why}");
        }
    }
    if let Some(flywheel) = &steady.flywheel {
        text.push('\n');
        wheel(&mut text, flywheel, steady.cycle.as_ref().ok());
        if flywheel.inertia > 0.0 {
            text += "\nwith this flywheel\n";
            describe(&mut text, &flywheel.cycle);
        }
    }
    text
}

fn wheel(text: &mut String, flywheel: &Flywheel, own: Option<&Cycle>) {
    let _ = writeln!(text, "flywheel for δ = {}", short(flywheel.delta));
    let exact = if flywheel.inertia == 0.0 {
        "none is needed: the machine runs as evenly without".to_owned()
    } else {
        format!("{} kg m^2 on the drive link", short(flywheel.inertia))
    };
    line(text, "exact", &exact);
    let classical = &flywheel.classical;
    line(
        text,
        "Wittenbauer",
        &format!(
            "{} kg m^2: ΔW = {} J at {}, ΔW/(δ·ω²) = {} kg m^2, less {} kg m^2 that the machine has on average",
            short(classical.inertia),
            short(classical.work),
            rpm(classical.speed),
            short(classical.total),
            short(classical.own)
        ),
    );
    if flywheel.inertia > 0.0 {
        let more = classical.inertia / flywheel.inertia - 1.0;
        let side = if more < 0.0 { "smaller" } else { "larger" };
        line(
            text,
            "difference",
            &format!(
                "the classical value is {} {side}: it assumes constant motor torque, speed and inertia",
                percent(more.abs())
            ),
        );
    }
    if let Some(own) = own.filter(|_| flywheel.inertia > 0.0) {
        let [before, after] = [&own.figures, &flywheel.cycle.figures];
        for (what, unit, [without, with]) in [
            ("mean power", "W", [before.power[0], after.power[0]]),
            ("peak power", "W", [before.power[1], after.power[1]]),
            ("RMS torque", "N m", [before.torque[1], after.torque[1]]),
            ("peak torque", "N m", [before.torque[2], after.torque[2]]),
        ] {
            let says = format!(
                "{} {unit} without, {} {unit} with it",
                short(without),
                short(with)
            );
            line(text, what, &says);
        }
    }
    if flywheel.places.len() > 1 {
        text.push_str("\nwhere it can sit, for the same δ\n");
        for place in &flywheel.places {
            let says = match &place.wheel {
                Ok(wheel) => seat(wheel),
                Err(why) => why.to_string(),
            };
            line(text, &shaft(place, flywheel), &says);
        }
    }
}

/// The name of the shaft.
fn shaft(place: &Place, flywheel: &Flywheel) -> String {
    match place.shaft {
        last if last + 1 == flywheel.places.len() => "drive link".to_owned(),
        0 => "motor shaft".to_owned(),
        k => format!("behind stage {k}"),
    }
}

fn seat(wheel: &Wheel) -> String {
    let delivered = wheel.delivered.iter().enumerate();
    let delivered: Vec<String> = delivered
        .map(|(k, torque)| format!("stage {} delivers up to {} N m", k + 1, short(*torque)))
        .collect();
    let [rms, peak] = wheel.torque.map(short);
    format!(
        "{} kg m^2 at {}, {} J; {}; motor {rms} N m RMS, {peak} N m peak; losses {} J a cycle",
        short(wheel.inertia),
        rpm(wheel.speed),
        short(wheel.stored),
        delivered.join(", "),
        short(wheel.losses)
    )
}

fn place_json(place: &Place) -> Value {
    let mut json = json!({ "shaft": place.shaft });
    match &place.wheel {
        Ok(wheel) => {
            let [rms, peak] = wheel.torque;
            json["inertia"] = json!(wheel.inertia);
            json["mean_speed"] = json!(wheel.speed);
            json["kinetic_energy"] = json!(wheel.stored);
            json["largest_torque_delivered_by_stage"] = json!(wheel.delivered);
            json["motor_torque"] = json!({ "rms": rms, "peak": peak });
            json["losses"] = json!(wheel.losses);
        }
        Err(why) => json["no_flywheel"] = json!(why.to_string()),
    }
    json
}

fn flywheel_json(flywheel: &Flywheel) -> Value {
    let classical = &flywheel.classical;
    json!({
        "delta": flywheel.delta,
        "inertia": flywheel.inertia,
        "inertia_at_motor": flywheel.at_motor(),
        "places": flywheel.places.iter().map(place_json).collect::<Vec<_>>(),
        "classical": {
            "work": classical.work,
            "speed": classical.speed,
            "total": classical.total,
            "own": classical.own,
            "inertia": classical.inertia,
        },
        "cycle": cycle_json(&flywheel.cycle),
    })
}
