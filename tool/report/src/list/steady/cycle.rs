//! A steady cycle, for reading and as JSON.

use std::fmt::Write as _;

use serde_json::{Value, json};

use crate::list::driven::{Turns, driven};
use jred_machine::analysis::steady::{Cycle, Figures, Held, Level, Start};
use jred_machine::model::coordinate::Coordinate;
use jred_machine::number::rounding::{percent, short};
use jred_machine::units::RPM;

/// A cycle in lines.
pub(super) fn describe(text: &mut String, cycle: &Cycle) {
    let figures = &cycle.figures;
    speeds(text, figures);
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
    works(text, figures);
    process(text, figures);
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

fn speeds(text: &mut String, figures: &Figures) {
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
}

/// Torques, powers and energies of the motor, the loads and the losses.
fn works(text: &mut String, figures: &Figures) {
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
}

/// What the loads do to a machine that they drive.
fn process(text: &mut String, figures: &Figures) {
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

pub(super) fn cycle_json(cycle: &Cycle) -> Value {
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

/// A line: its name, and what it says.
pub(super) fn line(text: &mut String, name: &str, says: &str) {
    let _ = writeln!(text, "  {name:<18} {says}");
}

pub(super) fn rpm(omega: f64) -> String {
    format!("{} rpm", short(omega / RPM))
}

fn degrees(phi: f64) -> String {
    let full = std::f64::consts::TAU;
    let shown = (Coordinate::Angle.shown(phi.rem_euclid(full)) * 10.0).round() / 10.0;
    format!("{shown}°")
}
