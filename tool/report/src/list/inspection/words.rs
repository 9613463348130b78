//! The findings of a check in words.

use std::fmt::Write as _;

use jred_analysis::inspect::{
    ContactLimit, Findings, NEAR_DEAD_POINT, Transmission, Travel, TravelKind, Violation,
};
use jred_file::model::coordinate::Coordinate;
use jred_file::model::mechanism::{ChangePoint, Fact};
use jred_file::number::rounding::{rounded, short};
use jred_file::units::RPM;

/// Names of the checks.
pub(super) fn checked(findings: &Findings) -> Vec<&'static str> {
    let all = [
        (true, "one degree of freedom"),
        (findings.closure.is_some(), "closure after a turn"),
        (
            findings.transmission.is_some(),
            "distance from dead points, branch",
        ),
        (true, "two ways to the drive torque"),
        (
            findings.agreement.energy.is_some(),
            "energy over the motion",
        ),
    ];
    let done = all.into_iter().filter(|(done, _)| *done);
    done.map(|(_, what)| what).collect()
}

/// Messages about violated rules.
pub(super) fn violations(findings: &Findings) -> Vec<String> {
    let message = |violation: &Violation| match violation {
        Violation::Freedoms(count) => format!("{count} degrees of freedom instead of one"),
        Violation::Closure(gap) => format!(
            "the mechanism does not close: after a turn, the speeds of its links differ by {gap:.1e}"
        ),
        Violation::NearDeadPoint(transmission) => format!(
            "too close to a dead point: transmission index {} {}, at least {NEAR_DEAD_POINT} is required",
            short(transmission.index),
            place(transmission, findings.coordinate)
        ),
        Violation::BranchChanges => {
            "the mechanism changes its branch: it passes through a dead point".to_owned()
        }
        Violation::Torques(off) => {
            format!("drive torques by d'Alembert's principle and by reduction differ by {off:.1e}")
        }
        Violation::Energy(off) => format!(
            "work and energy over the motion differ by {off:.1e} of the energy that the drive moves"
        ),
    };
    findings.violations().iter().map(message).collect()
}

/// Remarks before the warnings.
pub(super) fn before(findings: &Findings) -> Vec<String> {
    findings.integrability.iter().cloned().collect()
}

/// Remarks behind the warnings.
pub(super) fn after(findings: &Findings) -> Vec<String> {
    let flat = change_points(&findings.change_points, findings.coordinate);
    let scheduled = findings.scheduled.iter().map(ToString::to_string);
    flat.into_iter().chain(scheduled).collect()
}

/// Place of the smallest transmission index.
pub(super) fn place(transmission: &Transmission, coordinate: Coordinate) -> String {
    transmission.at.map_or_else(
        || "everywhere".to_owned(),
        |at| format!("at {}", coordinate.place(at)),
    )
}

/// Assumption for a linkage that passes change points.
pub(crate) fn change_points(points: &[ChangePoint], coordinate: Coordinate) -> Option<String> {
    let first = points.first()?;
    let places = points.iter().map(|point| coordinate.place(point.at));
    Some(format!(
        "the linkage lies flat at {} and is taken to be guided there, so that it stays on its branch (a second crank, teeth, \
         another coupler); the forces in its joints are those without the guide: they grow towards these positions, and within \
         {} {} of them they are not determined",
        places.collect::<Vec<_>>().join(" and "),
        short(coordinate.shown(first.within)),
        coordinate.unit()
    ))
}

/// Properties of this kind of mechanism, and the speeds at which its followers lift off.
pub(super) fn facts(findings: &Findings) -> Vec<Fact> {
    let lift_offs = findings.lift_offs.iter().map(lift_off);
    findings.facts.iter().cloned().chain(lift_offs).collect()
}

fn lift_off(contact: &ContactLimit) -> Fact {
    let joint = contact.joint.as_ref();
    let joint = joint.map_or_else(String::new, |name| format!("joint \"{name}\": "));
    let text = contact.limit.map_or_else(
        || "none: contact is maintained at any constant speed".to_owned(),
        |limit| {
            let place = Coordinate::Angle.place(limit.phi);
            format!("{} rpm at {place}", short(limit.omega / RPM))
        },
    );
    Fact {
        label: format!("{joint}constant speed at which the follower lifts off"),
        text,
    }
}

/// A travel as one sentence.
pub(super) fn travel(travel: &Travel, drive: Coordinate) -> String {
    let (own, way) = match travel.way {
        TravelKind::Slides => (Coordinate::Length, "slides"),
        TravelKind::Advances => (Coordinate::Length, "advances"),
        TravelKind::Swings => (Coordinate::Angle, "swings"),
        TravelKind::Turns => (Coordinate::Angle, "turns"),
    };
    let number = |x: f64| rounded((x * 1e6).round() / 1e6 + 0.0);
    let at = |phi: f64| format!("{} {}", number(drive.shown(phi)), drive.unit());
    let moved = |x: f64| format!("{} {}", number(own.shown(x)), own.unit());
    let centres = travel.dead_centres.iter();
    let centres =
        centres.map(|[place, own_place]| format!("{} ({})", at(*place), moved(*own_place)));
    let centres: Vec<String> = centres.collect();
    let centres = match centres.as_slice() {
        [] => "no dead centre".to_owned(),
        [one] => format!("dead centre at {} = {one}", drive.symbol()),
        all => format!("dead centres at {} = {}", drive.symbol(), all.join(", ")),
    };
    let dwells = travel.dwells.iter();
    let dwells: Vec<String> = dwells
        .map(|[from, to]| format!("{} to {}", at(*from), at(*to)))
        .collect();
    let rests = if dwells.is_empty() {
        String::new()
    } else {
        format!("; dwells from {}", dwells.join(", "))
    };
    let mut way = format!("{way} by {}", moved(travel.stroke));
    if matches!(travel.way, TravelKind::Advances | TravelKind::Turns) {
        way += " per turn";
        if !travel.dead_centres.is_empty() {
            let _ = write!(way, " and goes back by {} in between", moved(travel.back));
        }
    }
    format!("{} {way}; {centres}{rests}", travel.link)
}

/// A small share, such as `1.6e-16`.
pub(super) fn exponent(x: f64) -> String {
    if x == 0.0 {
        "0".to_owned()
    } else {
        format!("{x:.1e}")
    }
}
