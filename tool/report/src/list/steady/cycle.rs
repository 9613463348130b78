//! A steady cycle.

use crate::answer::Answer;
use crate::list::driven::{Turns, driven};
use jred_analysis::steady::{Cycle, Level, Scaling, Start, SteadyFigures};
use jred_file::model::coordinate::Coordinate;
use jred_file::number::rounding::{percent, short};
use jred_file::units::RPM;

/// A cycle in lines.
pub(super) fn describe(answer: &mut Answer, cycle: &Cycle) {
    let figures = &cycle.figures;
    speeds(answer, figures);
    let cycle_of = if figures.turns == 1 {
        String::new()
    } else {
        format!(", {} turns", figures.turns)
    };
    let period = short(figures.period);
    answer.fact("period", format!("{period} s{cycle_of}"));
    if let Some(held) = &cycle.held {
        answer.fact("for this speed", scaled(held));
    }
    works(answer, figures);
    process(answer, figures);
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
    answer.fact(
        "stability",
        format!("{left} of a small deviation is left after a {after}{caught}"),
    );
    answer.fact("start from rest", started(&cycle.start));
}

fn speeds(answer: &mut Answer, figures: &SteadyFigures) {
    // Speeds and torques count along the motion, as the fastest and slowest instants do.
    let backwards = if figures.mean_speed < 0.0 {
        "; all speeds and torques along the motion, in which φ falls"
    } else {
        ""
    };
    answer.fact(
        "speed",
        format!(
            "mean {} over the time; from {} at {} to {} at {}{backwards}",
            rpm(figures.mean_speed.abs()),
            rpm(figures.min_speed),
            degrees(figures.min_speed_at),
            rpm(figures.max_speed),
            degrees(figures.max_speed_at)
        ),
    );
    answer.fact("fluctuation",
        format!(
            "δ = (ω_max − ω_min)/ω_mean = {}, with the mean over the time; {} with (ω_max + ω_min)/2",
            short(figures.delta),
            short(figures.delta_of_extremes)
        ),
    );
}

/// Torques, powers and energies of the motor, the loads and the losses.
fn works(answer: &mut Answer, figures: &SteadyFigures) {
    let torque = figures.motor_torque;
    let mean = torque.mean * figures.motor_speed.signum();
    let [mean, rms, peak] = [mean, torque.rms, torque.peak].map(short);
    answer.fact(
        "motor torque",
        format!(
            "mean {mean} N m, RMS {rms} N m, peak {peak} N m, at {} of the motor on average",
            rpm(figures.motor_speed.abs())
        ),
    );
    let power = figures.motor_power;
    let [mean, peak] = [power.mean, power.peak].map(short);
    answer.fact("motor power", format!("mean {mean} W, peak {peak} W"));
    let energy = figures.energy;
    let [motor, process, losses] = [energy.motor, energy.process, energy.losses].map(short);
    answer.fact(if figures.turns == 1 {
            "energy a turn"
        } else {
            "energy a cycle"
        },
        format!(
            "motor {motor} J, process loads {process} J, losses {losses} J; balance within {:.0e} of the energy turned over",
            figures.imbalance.max(1e-16)
        ),
    );
    answer.fact(
        "kinetic energy",
        format!(
            "changes by {} J between its least and its largest value",
            short(figures.kinetic_energy_fluctuation)
        ),
    );
}

/// Reports process loads that drive the machine.
fn process(answer: &mut Answer, figures: &SteadyFigures) {
    let energy = figures.energy;
    let turns = Turns {
        works: [energy.motor, energy.process, energy.losses],
        kinetic: 0.0,
        is_backwards: figures.mean_speed < 0.0,
    };
    if energy.motor < 0.0 {
        answer.fact(
            "process loads",
            format!(
                "they drive the machine, and the motor brakes: {} W on average",
                short(-figures.motor_power.mean)
            ),
        );
    } else if let Some(driven) = driven(&turns) {
        answer.fact("process loads", format!("warning: they {driven}"));
    }
}

fn scaled(held: &Scaling) -> String {
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
                Coordinate::Angle.place(missing.phi),
                short(missing.given),
                short(missing.needed),
                short((missing.needed - missing.given).abs())
            )
        }
        Start::Slow {
            turns,
            time,
            share_of_speed,
        } => format!(
            "not within {} turns: after {} s the speed is {} of the cycle's",
            short(*turns),
            short(*time),
            percent(*share_of_speed)
        ),
    }
}

pub(super) fn rpm(omega: f64) -> String {
    format!("{} rpm", short(omega / RPM))
}

fn degrees(phi: f64) -> String {
    let full = std::f64::consts::TAU;
    let shown = (Coordinate::Angle.shown(phi.rem_euclid(full)) * 10.0).round() / 10.0;
    format!("{shown}°")
}
