//! Checks of a machine file that need its mechanics: inertia, edges, contacts.

use std::f64::consts::TAU;

use jred::Domain;
use jred::error::Error;
use jred::machine::{MachineError, PoseError, Reducible};

use jred_file::model::axis::Axis;
use jred_file::model::coordinate::{Coordinate, positions};
use jred_file::model::machine::{MachineFile, POSITIONS};
use jred_file::number::numerics;
use jred_file::read::UncheckedFile;
use jred_file::text::problem::{Problem, Result};

use crate::contact;
use crate::duty;

/// Share of its largest value below which an inertia is zero.
const ZERO: f64 = 1e-12;

/// The machine file, if its mechanics pass all checks.
///
/// # Errors
/// The reduced inertia vanishes somewhere, friction jams a joint, the motion passes too many edges, a follower lifts off or a rope goes slack.
pub fn check(unchecked: UncheckedFile) -> Result<MachineFile> {
    inertia(&unchecked)?;
    friction(&unchecked)?;
    passages(&unchecked)?;
    contacts(&unchecked)?;
    Ok(unchecked.trusted())
}

/// Checks that the reduced inertia is positive at every angle, including the drive train.
fn inertia(unchecked: &UncheckedFile) -> Result<()> {
    let file = unchecked.file();
    let report = |error: Error| unchecked.in_mechanism(Problem::of(error), "in this machine");
    let train = file.train_inertia();
    let inertia = |phi: f64| -> Result<f64> {
        let reduction = file.bare_reduction(phi).map_err(report)?;
        Ok(reduction.inertia + train)
    };
    let domain = file.machine.domain();
    let (from, to) = (domain.position(0.0), domain.position(1.0));
    let step = domain.span() / (POSITIONS - 1) as f64;
    let (mut largest, mut smallest, mut place) = (0.0_f64, f64::INFINITY, from);
    let all = file.over_range().map_err(report)?;
    // A turn ends at its start.
    let (mut before, mut steepest) = (None, 0.0_f64);
    if let (Domain::Turn, Some((_, last))) = (domain, all.last()) {
        before = Some(last.inertia + train);
    }
    for (phi, reduction) in all {
        let (phi, value) = (*phi, reduction.inertia + train);
        largest = largest.max(value);
        if value < smallest {
            (smallest, place) = (value, phi);
        }
        steepest = steepest.max((value - before.unwrap_or(value)).abs());
        before = Some(value);
    }
    // Usually far from zero: between two samples it falls by no more than its largest change between samples.
    if smallest - steepest > ZERO * largest {
        return Ok(());
    }
    // Between the samples the smallest value is found by thirds.
    let (low, high) = match domain {
        Domain::Turn => (place - step, place + step),
        Domain::Stroke { .. } => ((place - step).max(from), (place + step).min(to)),
    };
    let phi = numerics::least(inertia, low, high)?;
    if inertia(phi)? <= ZERO * largest {
        let phi = match domain {
            Domain::Turn => phi.rem_euclid(TAU),
            Domain::Stroke { .. } => phi,
        };
        let place = (largest > 0.0).then_some(phi);
        return Err(no_inertia(unchecked, place));
    }
    Ok(())
}

/// The error that the reduced inertia is zero at a position, or everywhere; the cure names the mechanism's links.
fn no_inertia(unchecked: &UncheckedFile, place: Option<f64>) -> Problem {
    let mechanism = unchecked.file().machine.mechanism();
    let drive = Axis::of_drive(mechanism.coordinate());
    let place = place.map_or_else(|| "every position".to_owned(), |phi| drive.place(phi));
    let link = mechanism.link_names().first();
    let link = link.map_or("drive link", String::as_str);
    let help = if drive.coordinate == Coordinate::Length {
        format!("a real drive link has a mass: give that of the {link}")
    } else {
        format!(
            "a real drive link has a moment of inertia: give the {link} a mass or an inertia, or add flywheel = \"0.05 kg m^2\" under [mechanism]"
        )
    };
    let what = format!("the reduced inertia is zero at {place}");
    unchecked.in_mechanism(Problem::new(what).help(help), "in this machine")
}

/// Checks that friction by a coefficient is determined everywhere in the range.
fn friction(unchecked: &UncheckedFile) -> Result<()> {
    let machine = &unchecked.file().machine;
    if machine.frictions().is_empty() {
        return Ok(());
    }
    for phi in positions(machine.domain(), POSITIONS) {
        machine.friction_at(phi, 0.0, 1.0).map_err(|error| {
            let label = match error {
                MachineError::Pose(PoseError::Jams { joint, .. }) => {
                    let name = machine.mechanism().joint_names().get(joint);
                    format!("joint {joint} is \"{}\"", name.map_or("", String::as_str))
                }
                _ => "in this machine".to_owned(),
            };
            unchecked.in_mechanism(Problem::of(error), &label)
        })?;
    }
    Ok(())
}

/// Most passages of the edges of loads and cams in a motion: between any two of them it has separate instants.
const MOST_PASSAGES: u64 = 5000;

/// Refuses a motion that passes more edges than are resolved.
fn passages(unchecked: &UncheckedFile) -> Result<()> {
    let file = unchecked.file();
    let passed = (file.motion.as_ref()).map_or(0, |motion| duty::passages(file, motion));
    if passed <= MOST_PASSAGES {
        return Ok(());
    }
    let message = format!(
        "the motion passes edges of loads or cams {passed} times; at most {MOST_PASSAGES} are resolved"
    );
    let help =
        "describe one cycle that repeats, or fewer turns; a load without between has no edges";
    Err(unchecked.in_motion(Problem::new(message).help(help), "in this motion"))
}

/// Checks that every cam contact presses and every rope pulls over the whole motion. A cam that guides its follower on both sides needs no check.
fn contacts(unchecked: &UncheckedFile) -> Result<()> {
    let file = unchecked.file();
    let Some(motion) = &file.motion else {
        return Ok(());
    };
    let lost = contact::lost(file, motion)
        .map_err(|error| unchecked.in_mechanism(Problem::of(error), "in this mechanism"))?;
    let Some(lost) = lost else {
        return Ok(());
    };
    let parted = lost.parted;
    let message = format!(
        "{} in the prescribed motion: at {}, {}",
        parted.what(),
        parted.state(),
        parted.required_force()
    );
    let label = if lost.joint.rope {
        "in this mechanism"
    } else {
        "in this cam"
    };
    Err(unchecked.in_mechanism(Problem::new(message).help(parted.cure()), label))
}
