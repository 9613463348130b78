//! `[simulation]`: a free motion under a motor torque.

mod control;
mod place;

pub(super) use control::Around;

use crate::model::characteristic::Characteristic;
use crate::model::coordinate::Coordinate;
use crate::model::simulation::{Shaft, Simulation};

use super::drive_link::DriveLink;
use crate::number::rounding::figure;
use crate::text::item::{Item, Value};
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::units::kind::{ANGULAR_SPEED, INERTIA, LENGTH, MASS, SHARE, TIME, TORQUE};
use place::Places;

/// Of the integrator, unless given: golden motions come out to 3e-10 of their largest (`tests/simulate.rs`).
const TOLERANCE: f64 = 1e-12;

/// The most output points of a simulation.
const MAX_STEPS: f64 = 100_000.0;

/// The most points of a torque-speed curve.
const MAX_POINTS: usize = 1000;

/// The simulation for `jred simulate`, if the file has one.
pub(super) fn read(root: &Section, around: Around) -> Result<Option<Simulation>> {
    let Around {
        drive, drive_train, ..
    } = around;
    let Some(item) = root.get("simulation") else {
        return Ok(None);
    };
    let section = item.section("[simulation]".into())?;
    let [start_angle, start_speed] = start(&section, around)?;
    let duration = section.quantity("duration", &TIME)?;
    let output_step = section.quantity("output_step", &TIME)?;
    duration.check_positive()?;
    output_step.check_positive()?;
    let steps = duration.si / output_step.si;
    if !(1.0 - 1e-9..=MAX_STEPS * (1.0 + 1e-9)).contains(&steps) {
        let what = format!(
            "is {}, which gives {} steps",
            output_step.shown(),
            figure(steps)
        );
        return Err(output_step
            .problem(&what, "check this step")
            .at(duration.span(), "against this duration")
            .help(format!(
                "between 1 and {MAX_STEPS} steps are possible: a step from {} to {}",
                output_step.show(duration.si / MAX_STEPS),
                output_step.show(duration.si)
            )));
    }
    let words = [
        "motor",
        if drive.slides() {
            "drive-link"
        } else {
            "crank"
        },
    ];
    let at = match section.get("at") {
        Some(item) if item.choice(&words)? == 1 => Shaft::DriveLink,
        _ => Shaft::Motor,
    };
    // A sliding link is driven directly by a linear motor or a cylinder.
    let linear = drive.slides() && (at == Shaft::DriveLink || drive_train.stages().is_empty());
    let torque = if linear {
        effort(
            &section,
            ["force", "force_speed"],
            drive,
            ["0.2 m/s", "400 N"],
        )?
    } else {
        let rotary = DriveLink {
            coordinate: Coordinate::Angle,
            ..drive
        };
        effort(
            &section,
            ["torque", "torque_speed"],
            rotary,
            ["3000 rpm", "14 N m"],
        )?
    };
    // A linear motor has a mass where a rotary one has an inertia.
    let direct = drive.slides() && drive_train.stages().is_empty();
    let (rotor, kind) = if direct {
        ("motor_mass", &MASS)
    } else {
        ("rotor_inertia", &INERTIA)
    };
    let rotor_inertia = match section.optional(rotor, kind)? {
        Some(value) => value.not_negative()?,
        None => 0.0,
    };
    let tolerance = match section.get("tolerance") {
        Some(item) => item.number([1e-13, 1e-3], "1e-12")?,
        None => TOLERANCE,
    };
    let control = control::control(&section, around, (at, duration.si), torque.as_ref())?;
    let halt = control::halt(&section, around, duration.si)?;
    let end_stops = control::end_stops(&section, around, start_angle)?;
    section.finish()?;
    Ok(Some(Simulation {
        start_angle,
        start_speed,
        duration: duration.si,
        output_step: output_step.si,
        torque,
        control,
        halt,
        end_stops,
        at,
        rotor_inertia,
        tolerance,
    }))
}

/// Where the drive link starts (rad, or m), and how fast. A controlled machine that is not told so starts as its motion does.
fn start(section: &Section, around: Around) -> Result<[f64; 2]> {
    let places = Places::of(around);
    let speed = match section.get("start_speed") {
        Some(item) => Some(places.speed(&item)?.drive),
        None => None,
    };
    // The drive link's own angle, or the position of what is prescribed.
    let (own, position) = if around.drive.slides() {
        (None, section.get("start_position"))
    } else if places.has_axis() {
        (section.get("start_angle"), section.get("start_position"))
    } else {
        (section.get("start_angle"), None)
    };
    let given = match (own, position) {
        (Some(own), Some(position)) => {
            return Err(Problem::new(
                "[simulation] has both `start_angle` and `start_position`".to_owned(),
            )
            .at(own.key_span(), "of the drive link")
            .at(position.key_span(), "of the axis")
            .help("keep one of them"));
        }
        (Some(own), None) => places.drive_position(&own)?,
        (None, Some(position)) => places.position(&position)?,
        (None, None) => {
            let reference = around.motion.filter(|_| section.peek("control").is_some());
            if let Some(motion) = reference {
                let state = motion.at(0.0);
                return Ok([state.phi, speed.unwrap_or(state.omega)]);
            }
            let (key, kind) = if places.has_axis() && places.is_length() || around.drive.slides() {
                ("start_position", &LENGTH)
            } else {
                ("start_angle", around.drive.position())
            };
            return Err(section.missing(key, &format!("{key} = \"{}\"", kind.example)));
        }
    };
    let start = places.reached(
        &given,
        "out of reach",
        "start at a position within the stroke",
    )?;
    Ok([start, speed.unwrap_or(0.0)])
}

/// The torque or force over the speed; not given: that of a drive.
fn effort(
    section: &Section,
    [key, curve_key]: [&'static str; 2],
    drive: DriveLink,
    [speed, most]: [&str; 2],
) -> Result<Option<Characteristic>> {
    let no_speed = format!("0 {}", drive.speed().unit);
    let no_effort = format!("0 {}", drive.effort().unit);
    let example = format!("[[\"{no_speed}\", \"{most}\"], [\"{speed}\", \"{no_effort}\"]]");
    // A motor by its formula turns.
    let formulas: &[&'static str] = if drive.slides() {
        &[]
    } else {
        &["dc_motor", "induction_motor"]
    };
    let keys = [key, curve_key].into_iter().chain(formulas.iter().copied());
    let given: Vec<(&str, Item)> = keys
        .filter_map(|key| Some((key, section.get(key)?)))
        .collect();
    match given.as_slice() {
        [] => Ok(None),
        [(found, item)] => match *found {
            "dc_motor" => dc_motor(item).map(Some),
            "induction_motor" => induction_motor(item).map(Some),
            found if found == key => Ok(Some(Characteristic::constant(
                item.quantity(drive.effort())?.si,
            ))),
            _ => Ok(Some(Characteristic::Points(points(item, drive, &example)?))),
        },
        [(first, one), (second, other), ..] => {
            let label = |found: &str| {
                if found == key {
                    format!("a constant {key}")
                } else {
                    format!("a {key} that depends on the speed")
                }
            };
            Err(
                Problem::new(format!("[simulation] has both `{first}` and `{second}`"))
                    .at(one.key_span(), label(first))
                    .at(other.key_span(), label(second))
                    .help("keep one of them"),
            )
        }
    }
}

/// The line of a DC motor.
fn dc_motor(item: &Item) -> Result<Characteristic> {
    let section = item.section("[simulation.dc_motor]".into())?;
    let speed = section.quantity("no_load_speed", &ANGULAR_SPEED)?;
    let torque = section.quantity("stall_torque", &TORQUE)?;
    section.finish()?;
    same_way(&speed, &torque)?;
    Ok(Characteristic::Dc {
        no_load_speed: speed.si,
        stall_torque: torque.si,
    })
}

/// An induction motor by Kloss' formula.
fn induction_motor(item: &Item) -> Result<Characteristic> {
    let section = item.section("[simulation.induction_motor]".into())?;
    let speed = section.quantity("synchronous_speed", &ANGULAR_SPEED)?;
    let torque = section.quantity("breakdown_torque", &TORQUE)?;
    let slip =
        (section.require("breakdown_slip", "breakdown_slip = \"20 %\"")?).quantity(&SHARE)?;
    section.finish()?;
    same_way(&speed, &torque)?;
    if !(slip.si > 0.0 && slip.si <= 1.0) {
        let what = format!("is {}, but must be above 0 % and up to 100 %", slip.shown());
        return Err(slip
            .problem(&what, "no slip of breakdown")
            .help("10 % to 40 % is usual, such as breakdown_slip = \"20 %\""));
    }
    Ok(Characteristic::Induction {
        breakdown_torque: torque.si,
        breakdown_slip: slip.si,
        synchronous_speed: speed.si,
    })
}

/// Refuses a motor whose torque does not drive it towards its own speed.
fn same_way(speed: &Value, torque: &Value) -> Result<()> {
    if speed.si * torque.si > 0.0 {
        return Ok(());
    }
    let what = format!(
        "is {} with a speed of {}: they must have the same sign and not be zero",
        torque.shown(),
        speed.shown()
    );
    Err(torque
        .problem(&what, "torque")
        .at(speed.span(), "speed")
        .help("give both positive; both negative for a motor that runs backwards"))
}

fn points(curve: &Item, drive: DriveLink, example: &str) -> Result<Vec<(f64, f64)>> {
    let list = curve.list("point", example)?;
    if list.is_empty() || list.len() > MAX_POINTS {
        let what = format!("has {} points, but must have 1 to {MAX_POINTS}", list.len());
        return Err(curve.problem(&what, "here").help(format!(
            "a point is [speed, torque or force], as in {example}"
        )));
    }
    let mut points: Vec<(f64, f64)> = Vec::with_capacity(list.len());
    for item in list {
        let [speed, effort] = item.pair([drive.speed(), drive.effort()])?;
        if let Some((before, _)) = points.last().filter(|(before, _)| speed.si <= *before) {
            let what = format!(
                "is {}, but must be greater than the speed of the previous point, {}",
                speed.shown(),
                speed.show(*before)
            );
            return Err(speed
                .problem(&what, "not increasing")
                .help("sort the points by increasing speed"));
        }
        points.push((speed.si, effort.si));
    }
    Ok(points)
}
