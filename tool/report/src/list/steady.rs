//! The steady cycle and the flywheel, for reading and as JSON.

use std::fmt::Write as _;

use serde_json::{Map, Value, json};

use super::driven::{Turns, driven};
use crate::table::output::{Format, json_parts, parts};
use jred_machine::analysis::simulate::Together;
use jred_machine::analysis::steady::{Cycle, Flywheel, Held, Level, Place, Start, Steady, Wheel};
use jred_machine::model::coordinate::Coordinate;
use jred_machine::number::rounding::{percent, short};
use jred_machine::units::RPM;

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

/// A line: its name, and what it says.
fn line(text: &mut String, name: &str, says: &str) {
    let _ = writeln!(text, "  {name:<18} {says}");
}

fn rpm(omega: f64) -> String {
    format!("{} rpm", short(omega / RPM))
}

fn degrees(phi: f64) -> String {
    let full = std::f64::consts::TAU;
    let shown = (Coordinate::Angle.shown(phi.rem_euclid(full)) * 10.0).round() / 10.0;
    format!("{shown}°")
}

fn describe(text: &mut String, cycle: &Cycle) {
    let figures = &cycle.figures;
    // Speeds and torques count along the motion, as its fastest and slowest instants do.
    let backwards = if figures.mean_speed < 0.0 {
        "; all speeds and torques along the motion, in which φ falls"
    } else {
        ""
    };
    let [fast, slow] = [figures.fastest, figures.slowest];
    line(
        text,
        "speed",
        &format!(
            "mean {} over the time; from {} at {} to {} at {}{backwards}",
            rpm(figures.mean_speed.abs()),
            rpm(slow[0]),
            degrees(slow[1]),
            rpm(fast[0]),
            degrees(fast[1])
        ),
    );
    line(
        text,
        "fluctuation",
        &format!(
            "δ = (ω_max − ω_min)/ω_mean = {}, with the mean over the time; {} with (ω_max + ω_min)/2",
            short(figures.delta),
            short(figures.delta_of_extremes)
        ),
    );
    let cycle_of = if figures.turns == 1 {
        String::new()
    } else {
        format!(", {} turns", figures.turns)
    };
    let period = short(figures.period);
    line(text, "period", &format!("{period} s{cycle_of}"));
    if let Some(held) = &cycle.held {
        line(text, "for this speed", &scaled(held));
    }
    let [mean, rms, peak] = figures.torque;
    let mean = mean * figures.motor_speed.signum();
    let [mean, rms, peak] = [mean, rms, peak].map(short);
    line(
        text,
        "motor torque",
        &format!(
            "mean {mean} N m, RMS {rms} N m, peak {peak} N m, at {} of the motor on average",
            rpm(figures.motor_speed.abs())
        ),
    );
    let [mean, peak] = figures.power.map(short);
    line(
        text,
        "motor power",
        &format!("mean {mean} W, peak {peak} W"),
    );
    let [motor, process, losses] = figures.works.map(short);
    line(
        text,
        if figures.turns == 1 {
            "energy a turn"
        } else {
            "energy a cycle"
        },
        &format!(
            "motor {motor} J, process loads {process} J, losses {losses} J; balance within {:.0e} of the energy turned over",
            figures.imbalance.max(1e-16)
        ),
    );
    line(
        text,
        "kinetic energy",
        &format!(
            "changes by {} J between its least and its largest value",
            short(figures.fluctuation)
        ),
    );
    let turns = Turns {
        works: figures.works,
        kinetic: 0.0,
        is_backwards: figures.mean_speed < 0.0,
    };
    let [motor, ..] = figures.works;
    if motor < 0.0 {
        line(
            text,
            "process loads",
            &format!(
                "they drive the machine, and the motor brakes: {} W on average",
                short(-figures.power[0])
            ),
        );
    } else if let Some(driven) = driven(&turns) {
        line(text, "process loads", &format!("warning: they {driven}"));
    }
    let left = if cycle.left_over < 1e-3 {
        "less than 0.1 %".to_owned()
    } else {
        percent(cycle.left_over)
    };
    let after = if figures.turns == 1 { "turn" } else { "cycle" };
    let caught = cycle.caught_from.map_or_else(
        || "; it is reached from every speed".to_owned(),
        |least| {
            format!(
                "; it is reached from speeds above {} at the start of the {after}",
                rpm(least)
            )
        },
    );
    line(
        text,
        "stability",
        &format!("{left} of a small deviation is left after a {after}{caught}"),
    );
    line(text, "start from rest", &started(&cycle.start));
}

fn scaled(held: &Held) -> String {
    match (&held.by, held.torque) {
        (Level::Motor, Some(torque)) => format!("a constant motor torque of {} N m", short(torque)),
        (Level::Motor, None) => format!(
            "the motor torque of the file, {} times at every speed",
            short(held.factor)
        ),
        (Level::Load(name), _) => format!(
            "the load \"{name}\" of the file, {} times",
            short(held.factor)
        ),
    }
}

fn held_json(held: &Held) -> Value {
    json!({
        "scaled": match &held.by {
            Level::Motor => Value::Null,
            Level::Load(name) => json!(name),
        },
        "factor": held.factor,
        "constant_torque": held.torque,
    })
}

fn started(start: &Start) -> String {
    match start {
        Start::Reached { time, turns } => format!(
            "{} s, {} turns, until the speed stays within 1 % of the cycle",
            short(*time),
            short(*turns)
        ),
        Start::Stuck { turns, missing } => {
            let what = if *turns == 0.0 {
                "warning: the motor cannot start the machine at".to_owned()
            } else {
                format!(
                    "warning: the machine stops after {} turns at",
                    short(*turns)
                )
            };
            format!(
                "{what} {}: the motor gives {} N m at rest and {} N m would be needed, {} N m are missing",
                missing.place,
                short(missing.given),
                short(missing.needed),
                short((missing.needed - missing.given).abs())
            )
        }
        Start::Slow { turns, time, share } => format!(
            "not within {} turns: after {} s the speed is {} of the cycle's",
            short(*turns),
            short(*time),
            percent(*share)
        ),
    }
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

fn cycle_json(cycle: &Cycle) -> Value {
    let figures = &cycle.figures;
    let [mean, rms, peak] = figures.torque;
    let start = match &cycle.start {
        Start::Reached { time, turns } => json!({ "reached": true, "time": time, "turns": turns }),
        Start::Stuck { turns, missing } => json!({
            "reached": false,
            "turns": turns,
            "stuck_at": missing.phi,
            "torque_at_rest": missing.given,
            "torque_needed": missing.needed,
        }),
        Start::Slow { turns, time, share } => {
            json!({ "reached": false, "turns": turns, "time": time, "share_of_speed": share })
        }
    };
    json!({
        "mean_speed": figures.mean_speed,
        "speed_at_start_of_turn": figures.begin,
        "max_speed": figures.fastest[0],
        "max_speed_at": figures.fastest[1],
        "min_speed": figures.slowest[0],
        "min_speed_at": figures.slowest[1],
        "delta": figures.delta,
        "delta_of_extremes": figures.delta_of_extremes,
        "turns": figures.turns,
        "period": figures.period,
        "kinetic_energy_fluctuation": figures.fluctuation,
        "for_mean_speed": cycle.held.as_ref().map(held_json),
        "motor_torque": { "mean": mean, "rms": rms, "peak": peak },
        "motor_power": { "mean": figures.power[0], "peak": figures.power[1] },
        "motor_speed": figures.motor_speed,
        "energy": { "motor": figures.works[0], "process": figures.works[1], "losses": figures.works[2] },
        "imbalance": figures.imbalance,
        "residual": cycle.residual,
        "left_over": cycle.left_over,
        "reached_from_speed": cycle.caught_from,
        "start": start,
    })
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
