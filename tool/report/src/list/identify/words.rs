//! A log and its faults in words.

use std::f64::consts::TAU;

use miette::{Report, miette};

use jred_analysis::identify::{Fault, Obstacle, RecordFault, Repair, Shaft};
use jred_file::number::rounding::{percent, short};

use super::{LogResult, Signs};
use crate::answer::Answer;

/// The longest time between samples (s) for which the method is tested, and the highest frequency (Hz) that its test functions let through.
const SLOW: f64 = 0.0021;
const HIGHEST: f64 = 80.0;

/// Limits of the warnings: variation of ω² at an angle, inertial torque against the noise, band of J.
const EVEN: f64 = 0.10;
const HARDLY: f64 = 2.0;
const WIDE: f64 = 0.01;

pub(super) fn of_log(answer: &mut Answer, log: &LogResult) {
    let found = &log.found;
    let motion = &found.excitation;
    answer.fact(
        "motion",
        format!(
            "{} turns in {} s; at an angle ω² varies by {}; {} of the time forwards",
            short(motion.turns),
            short(motion.duration),
            percent(motion.speed_variation),
            percent(motion.forward)
        ),
    );
    answer.fact("harmonics", found.harmonics.to_string());
    answer.fact(
        "delay of the torque",
        format!(
            "{} ± {} ms",
            short(found.delay.value * 1e3),
            short(found.delay.band * 1e3)
        ),
    );
    answer.fact(
        "noise",
        format!(
            "torque {} N m, position {} deg",
            short(found.torque_noise),
            short(found.position_noise.to_degrees())
        ),
    );
    for repair in &log.repairs {
        answer.warning(repaired(repair));
    }
    for fault in &found.faults {
        answer.warning(fault_words(fault, log));
    }
    if log.is_misread() {
        return;
    }
    if motion.step > SLOW {
        answer.warning(format!(
            "the log has {} samples a second: the method is tested from 500 on; with fewer it sees less of high harmonics",
            short(1.0 / motion.step)
        ));
    }
    let turns = motion.turns / motion.duration;
    for order in &log.cogging {
        let frequency = f64::from(*order) * turns;
        if frequency > HIGHEST {
            answer.warning(format!(
                "cogging of order {order} has {} Hz at the mean speed; above {HIGHEST} Hz the method sees little of it: record a slower run",
                short(frequency)
            ));
        }
    }
    if motion.speed_variation < EVEN {
        answer.warning(format!(
            "at an angle ω² varies by {} only: vary the speed more from turn to turn",
            percent(motion.speed_variation)
        ));
    }
    if motion.acceleration < HARDLY {
        answer.warning(format!(
            "the inertial torque is only {} times the torque's noise: accelerate harder",
            short(motion.acceleration)
        ));
    }
    if motion.band > WIDE {
        answer.warning(format!(
            "the band of J is ±{} of its maximum: for 1 % record {} s",
            percent(motion.band),
            short((motion.duration * (motion.band / WIDE).powi(2)).ceil())
        ));
    }
    if found.mean_load.is_none() {
        answer.warning(
            "the log has one direction only: a mean load cannot be separated from Coulomb friction; record both directions",
        );
    }
}

/// The orders of cogging to ask for.
fn orders(log: &LogResult) -> String {
    let found = log.found.faults.iter().filter_map(|fault| match fault {
        Fault::Cogging { order, .. } => Some(order),
        _ => None,
    });
    let mut orders: Vec<u32> = log.cogging.iter().chain(found).copied().collect();
    orders.sort_unstable();
    let orders: Vec<String> = orders.iter().map(u32::to_string).collect();
    orders.join(",")
}

fn repaired(repair: &Repair) -> String {
    match *repair {
        Repair::Duplicates { count, row } => format!(
            "{count} rows repeat the row before, with the same time (first: row {row}), and are left out: check the recorder"
        ),
        Repair::Gaps {
            count,
            row,
            longest,
        } => format!(
            "samples are missing in {}, the first before row {row}, the longest for {} ms; up to 4 ms they are interpolated, others are left out: check the bus or the recorder",
            places(count),
            short(longest * 1e3)
        ),
        Repair::Jitter { by, equal } => format!(
            "the times scatter by up to {} ms; {}: record with the clock of the drive",
            short(by * 1e3),
            if equal {
                "the samples are taken as those of a uniform clock, with which the position is smoother"
            } else {
                "position and torque are interpolated"
            }
        ),
        Repair::Saturated { count, row, torque } => format!(
            "{count} torques are at the limit {} N m (first: row {row}) and are left out: accelerate less, or raise the limit",
            short(torque)
        ),
    }
}

fn fault_words(fault: &Fault, log: &LogResult) -> String {
    match *fault {
        Fault::Slip { at, by, .. } => {
            let size = log.encoder_step.map_or_else(
                || format!("{} deg", short(by.to_degrees())),
                |step| format!("{} counts", short((by / step).round())),
            );
            format!(
                "the encoder slips by about {size} at about {} s: check its coupling and its cable, and record again",
                short(at)
            )
        }
        Fault::Spikes { count, first } => format!(
            "{count} torques or positions do not fit the motion (first at {} s) and are left out: check shield and filter",
            short(first)
        ),
        Fault::Cogging { order, amplitude } => format!(
            "the torque has {} N m of order {order} of a turn, which was not asked for, as by the cogging of a motor: run again with --cogging {}",
            short(amplitude),
            orders(log)
        ),
        Fault::Reversed { position: None } => format!(
            "J is negative at every angle: the torque or the position has the wrong sign, and the design fits both: run again {}, or {}",
            log.signs.toggled(true, false),
            log.signs.toggled(false, true)
        ),
        Fault::Reversed {
            position: Some(position),
        } => format!(
            "J is negative at every angle: the {} has the wrong sign, by the design: run again {}",
            if position { "position" } else { "torque" },
            log.signs.toggled(!position, position)
        ),
        Fault::Mirrored => format!(
            "the curves are those of the design over -φ: torque and position both have the wrong sign: run again {}",
            log.signs.toggled(true, true)
        ),
        Fault::Zero { by } => {
            let sign = if log.signs.position { -1.0 } else { 1.0 };
            let zero = log.zero + sign * log.ratio * by;
            format!(
                "the curves fit the design best when they are shifted by {} deg: is the position of the log at φ = 0 of the machine file {1} deg? Then give --zero \"{1} deg\"",
                short(by.to_degrees()),
                short(zero.to_degrees())
            )
        }
        Fault::Scale { by } => format!(
            "the curves are those of the design if the positions are {} times as large: {}",
            short(by),
            log.counts.map_or_else(
                || "check the unit of the position".to_owned(),
                |counts| format!("give --counts-per-turn {}", short(counts / by)),
            )
        ),
        Fault::Shaft => {
            let (name, options) = match log.shaft.other() {
                Shaft::Motor => ("motor", "motor"),
                Shaft::Link => ("drive link", "link, without --rotor-inertia"),
            };
            format!(
                "the curves are those of the design if the log is of the {name}: run again with --shaft {options}"
            )
        }
        Fault::Torque { by } => format!(
            "J and V' are {} times those of the design: check --torque-constant, --rated-torque and the unit of the torque",
            short(by)
        ),
        Fault::NotPositive { at, inertia } => format!(
            "J at {} deg is {} kg m^2, not positive: take less out of the log (--rotor-inertia, the drive train of the machine file, --shaft), or accelerate harder",
            short(at.to_degrees()),
            short(inertia)
        ),
        Fault::Noisy { share } => format!(
            "{} of the torque is not explained: the torque is limited, samples are missing, or the machine has more than one degree of freedom",
            percent(share)
        ),
        Fault::Delay { at } => format!(
            "the delay of the torque does not settle ({} ms): give --delay",
            short(at * 1e3)
        ),
    }
}

impl Signs {
    /// The options that change these signs.
    fn toggled(self, torque: bool, position: bool) -> String {
        let both = [
            ("--reverse-torque", self.torque, torque),
            ("--reverse-position", self.position, position),
        ];
        let words = both.iter().filter_map(|(option, now, toggle)| {
            let word = match (now, toggle) {
                (true, true) => "without",
                (true, false) | (false, true) => "with",
                (false, false) => return None,
            };
            Some(format!("{word} {option}"))
        });
        words.collect::<Vec<_>>().join(" and ")
    }
}

/// Why a log does not determine a machine, of whose rows these were repaired.
pub fn refusal(name: &str, why: &Obstacle, repairs: &[Repair]) -> Report {
    match *why {
        Obstacle::Short { rows, needed, step } if step > SLOW => miette!(
            help = "record 30 s with at least 500 samples a second",
            "{name} has too few samples: {rows} independent ones are left at {} samples a second, {needed} are needed{}",
            short(1.0 / step),
            because(repairs)
        ),
        Obstacle::Short { rows, needed, .. } => miette!(
            help = "record 30 s with the speed varied from turn to turn",
            "{name} is too short: {rows} independent samples are left, {needed} are needed{}",
            because(repairs)
        ),
        Obstacle::NotVisited { from, to, left_out } => miette!(
            help = if left_out {
                "accelerate less, raise the torque limit, or record without pauses"
            } else {
                "let the drive link turn fully in the log; if it did, check the unit of the position and --counts-per-turn"
            },
            "{name}: the angles from {} to {} deg are not visited{}",
            short(from.to_degrees()),
            short(to.to_degrees()),
            if left_out {
                because(repairs)
            } else {
                String::new()
            }
        ),
        Obstacle::SameSpeed { variation } => miette!(
            help = "vary the speed from turn to turn, for example 60 to 120 rpm in waves of 0.4 to 3 Hz; a cycle repeated identically determines nothing",
            "{name}: at each angle the speed is always the same (ω² varies by {}, at least 5 % is needed): J' and V' cannot be separated",
            percent(variation)
        ),
        Obstacle::NotDetermined => miette!(
            help = "vary speed and acceleration more, in both directions",
            "{name}: the motion does not determine the machine"
        ),
    }
}

fn places(count: usize) -> String {
    format!("{count} place{}", if count == 1 { "" } else { "s" })
}

/// The samples that are left out, and why.
fn because(repairs: &[Repair]) -> String {
    let words = repairs.iter().filter_map(|repair| match *repair {
        Repair::Saturated { count, torque, .. } => Some(format!(
            "; {count} samples at the torque limit {} N m are left out",
            short(torque)
        )),
        Repair::Gaps { count, .. } => Some(format!("; samples are missing in {}", places(count))),
        _ => None,
    });
    words.collect()
}

/// Why the rows of a log cannot be used.
pub fn unreadable(name: &str, fault: &RecordFault) -> Report {
    match *fault {
        RecordFault::Backwards { row, time, before } => miette!(
            help = "sort the rows by time, or give one file for each run",
            "{name}: the time does not increase: row {row} has {} s after {} s",
            short(time),
            short(before)
        ),
        RecordFault::Turns { row, gap, longest } => miette!(
            help = "give the rows before and after the gap as two files, or log a position that counts turns",
            "{name}: the encoder counts within one turn, and {} ms are missing before row {row}: above {} ms half a turn may be lost",
            short(gap * 1e3),
            short(longest * 1e3)
        ),
        RecordFault::Jump { row, by } => miette!(
            help =
                "log a position that counts turns without an overflow, or an angle within one turn",
            "{name}: the position jumps by {} turns in row {row}: its counter overflows, or was reset",
            short(by / TAU)
        ),
        RecordFault::Scattered => miette!(
            help = "give one file for each run without pauses in the recording",
            "{name}: most samples are missing between the first and the last, or their times scatter by more than four steps"
        ),
        RecordFault::Constant { torque } => miette!(
            help = "log the torque or the current that acts, not a set value or a limit",
            "{name}: the torque is {} N m in every row",
            short(torque)
        ),
        RecordFault::Empty => miette!(
            help = "record 30 s",
            "{name} has fewer than two different times"
        ),
    }
}
