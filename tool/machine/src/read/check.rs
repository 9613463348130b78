//! Checks that need the whole machine.

use std::f64::consts::TAU;

use jred::Domain;
use jred::error::Error;
use jred::machine::Reducible;

use crate::analysis::duty;
use crate::model::axis::Axis;
use crate::model::coordinate::Coordinate;
use crate::model::machine::{MachineFile, POSITIONS};
use crate::number::numerics;

use crate::text::problem::{Problem, Result};
use crate::text::section::Section;

/// Share of its largest value below which an inertia is zero.
const ZERO: f64 = 1e-12;

/// Checks that the reduced inertia is positive at every angle, including the drive train.
pub(super) fn inertia(file: &MachineFile, mechanism: &Section) -> Result<()> {
    let report = |error: &Error| {
        let problem = mechanism.problem(error.to_string(), "in this machine");
        problem.help(error.cure().to_string())
    };
    let train = file.train_inertia();
    let inertia = |phi: f64| {
        let reduction = file.bare_reduction(phi).map_err(|error| report(&error))?;
        Ok(reduction.inertia + train)
    };
    let domain = file.machine.domain();
    let (from, to) = (domain.position(0.0), domain.position(1.0));
    let step = domain.span() / (POSITIONS - 1) as f64;
    let (mut largest, mut smallest, mut place) = (0.0_f64, f64::INFINITY, from);
    let all = file.over_range().map_err(|error| report(&error))?;
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
        return Err(no_inertia(file, mechanism, place));
    }
    Ok(())
}

/// The error that the reduced inertia is zero at a position, or everywhere; the cure names the mechanism's links.
fn no_inertia(file: &MachineFile, section: &Section, place: Option<f64>) -> Problem {
    let mechanism = file.machine.mechanism();
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
    section.problem(what, "in this machine").help(help)
}

/// Most passages of the edges of loads and cams in a motion: between any two of them it has separate instants.
const MOST_PASSAGES: u64 = 5000;

/// Refuses a motion that passes more edges than are resolved.
pub(super) fn passages(file: &MachineFile, root: &Section) -> Result<()> {
    let passed = (file.motion.as_ref()).map_or(0, |motion| duty::passages(file, motion));
    if passed <= MOST_PASSAGES {
        return Ok(());
    }
    let message = format!(
        "the motion passes edges of loads or cams {passed} times; at most {MOST_PASSAGES} are resolved"
    );
    let help =
        "describe one cycle that repeats, or fewer turns; a load without between has no edges";
    let section = root.section("motion")?;
    Err(section.problem(message, "in this motion").help(help))
}
