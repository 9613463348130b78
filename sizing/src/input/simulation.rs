//! `[simulation]`: a free motion under a motor torque.

use crate::machine::{Shaft, Simulation};

use super::item::Item;
use super::kind::{ANGLE, ANGULAR_SPEED, INERTIA, TIME, TORQUE};
use super::problem::{Problem, Result, figure};
use super::section::Section;

/// The most output points of a simulation.
const MAX_STEPS: f64 = 100_000.0;

/// The most points of a torque-speed curve.
const MAX_POINTS: usize = 1000;

/// What `jred simulate` is to run, if the file says.
pub(super) fn read(root: &Section) -> Result<Option<Simulation>> {
    let Some(item) = root.get("simulation") else {
        return Ok(None);
    };
    let section = item.section("[simulation]".into())?;
    let start_angle = section.quantity("start_angle", &ANGLE)?.si;
    let start_speed = section
        .optional("start_speed", &ANGULAR_SPEED)?
        .map_or(0.0, |value| value.si);
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
    let torque = torque(&section)?;
    let at = match section.get("at") {
        Some(item) if item.choice(&["motor", "crank"])? == 1 => Shaft::DriveLink,
        _ => Shaft::Motor,
    };
    let rotor_inertia = match section.optional("rotor_inertia", &INERTIA)? {
        Some(value) => value.not_negative()?,
        None => 0.0,
    };
    let tolerance = match section.get("tolerance") {
        Some(item) => item.number([1e-13, 1e-3], "1e-10")?,
        None => 1e-10,
    };
    section.finish()?;
    Ok(Some(Simulation {
        start_angle,
        start_speed,
        duration: duration.si,
        output_step: output_step.si,
        torque,
        at,
        rotor_inertia,
        tolerance,
    }))
}

/// The torque as points over speed.
fn torque(section: &Section) -> Result<Vec<(f64, f64)>> {
    match (section.get("torque"), section.get("torque_speed")) {
        (Some(constant), None) => Ok(vec![(0.0, constant.quantity(&TORQUE)?.si)]),
        (None, Some(curve)) => points(&curve),
        (Some(constant), Some(curve)) => {
            Err(Problem::new("[simulation] has both `torque` and `torque_speed`")
                .at(constant.key_span(), "a constant torque")
                .at(curve.key_span(), "a torque that depends on the speed")
                .help("keep one of them"))
        }
        (None, None) => Err(section.missing(
            "torque",
            "torque = \"12 N m\", or torque_speed = [[\"0 rpm\", \"14 N m\"], [\"3000 rpm\", \"0 N m\"]]",
        )),
    }
}

fn points(curve: &Item) -> Result<Vec<(f64, f64)>> {
    let list = curve.list(
        "point",
        "[[\"0 rpm\", \"14 N m\"], [\"3000 rpm\", \"0 N m\"]]",
    )?;
    if list.is_empty() || list.len() > MAX_POINTS {
        let what = format!("has {} points, but must have 1 to {MAX_POINTS}", list.len());
        return Err(curve
            .problem(&what, "here")
            .help("a point is [speed, torque]: [\"1500 rpm\", \"10 N m\"]"));
    }
    let mut points: Vec<(f64, f64)> = Vec::with_capacity(list.len());
    for item in list {
        let [speed, torque] = item.pair([&ANGULAR_SPEED, &TORQUE])?;
        if let Some((before, _)) = points.last().filter(|(before, _)| speed.si <= *before) {
            let what = format!(
                "is {}, but must be larger than the speed of the point before, {}",
                speed.shown(),
                speed.show(*before)
            );
            return Err(speed
                .problem(&what, "not rising")
                .help("sort the points by rising speed"));
        }
        points.push((speed.si, torque.si));
    }
    Ok(points)
}
