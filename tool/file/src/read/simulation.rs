//! `[simulation]`: a free motion under a motor torque.

mod control;
mod motor;
mod place;

pub(super) use control::SimulationContext;

use crate::model::coordinate::Coordinate;
use crate::model::simulation::{Shaft, Simulation};

use super::drive_link::DriveLink;
use crate::number::rounding::figure;
use crate::text::item::Item;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::text::value::Value;
use crate::units::kind::LENGTH;
use motor::effort;
use place::AxisReader;

/// The most output points of a simulation.
const MAX_STEPS: f64 = 100_000.0;

/// The simulation for `jred simulate`, if the file has one.
pub(super) fn read(root: &Section, around: SimulationContext) -> Result<Option<Simulation>> {
    let SimulationContext {
        drive, drive_train, ..
    } = around;
    let Some(section) = root.maybe_table("simulation")? else {
        return Ok(None);
    };
    let [start_angle, start_speed] = start(&section, around)?;
    let [duration, output_step] = times(&section)?;
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
    // A sliding link is driven by a linear motor or a cylinder directly.
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
    // A linear motor has a mass instead of a rotor inertia.
    let direct = drive.slides() && drive_train.stages().is_empty();
    let rotor = if direct {
        "motor_mass"
    } else {
        "rotor_inertia"
    };
    let rotor_inertia = section.si(rotor)?;
    let tolerance = section.figure("tolerance")?;
    let (torque, winding) = match torque {
        Some(given) => (Some(given.characteristic), given.winding),
        None => (None, None),
    };
    let control = control::control(&section, around, (at, duration.si), torque.as_ref())?;
    if let (Some(_), Some((_, inductance))) = (&control, &winding) {
        return Err(inductance
            .problem("belongs to a motor at a constant voltage", "under a controller the current follows at once")
            .help("leave out `inductance`: the amplifier's current controller is faster than the controllers of this simulation"));
    }
    let halt = control::halt(&section, around, duration.si)?;
    let end_stops = control::end_stops(&section, around, start_angle)?;
    section.finish()?;
    Ok(Some(Simulation {
        start_angle,
        start_speed,
        duration: duration.si,
        output_step: output_step.si,
        torque,
        winding: winding.map(|(winding, _)| winding),
        control,
        halt,
        to_speed: None,
        end_stops,
        at,
        rotor_inertia,
        tolerance,
    }))
}

/// Duration and step of the output rows.
fn times(section: &Section) -> Result<[Value; 2]> {
    let (duration, output_step) = (section.value("duration")?, section.value("output_step")?);
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
    Ok([duration, output_step])
}

/// A position of the prescribed coordinate in a file that prescribes none.
fn no_axis(position: &Item, around: SimulationContext) -> Problem {
    let has = if around.motion.is_some() {
        "a [motion] without `of`"
    } else {
        "no [motion]"
    };
    let what = format!("goes with [motion] `of = …`, and the file has {has}");
    position.problem(&what, "this position").help(format!(
        "add a [motion] with `of`, the part whose position this is, or give the drive link's own position: start_angle = \"{}\"",
        around.drive.position().example
    ))
}

/// Start position (rad or m) and speed of the drive link. By default a controlled machine starts with its motion.
fn start(section: &Section, around: SimulationContext) -> Result<[f64; 2]> {
    let places = AxisReader::of(around);
    let speed = match section.get("start_speed") {
        Some(item) => Some(places.speed(&item)?.drive),
        None => None,
    };
    if let Some(position) = section
        .get("start_position")
        .filter(|_| !places.has_positions())
    {
        return Err(no_axis(&position, around));
    }
    // The drive link's own angle, or the position of the prescribed coordinate.
    let (own, position) = if around.drive.slides() {
        (None, section.get("start_position"))
    } else if places.has_axis() {
        (section.get("start_angle"), section.get("start_position"))
    } else {
        (section.get("start_angle"), None)
    };
    let given = match (own, position) {
        (Some(own), _) => places.drive_position(&own)?,
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
