//! `type = "four-bar"`.

use jred::Domain;
use jred::mechanism::{BuildError, FourBar, FourBarDimensions, Grashof, RotationError, Side};
use jred::number::RangeError;

use super::{core, link};
use crate::model::mechanism::{AnyMechanism, ChangePoint};
use crate::number::rounding::short;
use crate::text::item::Item;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::text::value::Value;

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let pivot = section.two("pivot")?;
    let side = section.pick("side", [Side::Left, Side::Right])?;
    let (keep, kept) = (section.get("keep_branch"), section.is("keep_branch")?);
    let stroke = match section.get("stroke") {
        Some(item) => {
            let range = item.two()?;
            Some((item, range))
        }
        None => None,
    };
    let parts = ["crank", "coupler", "rocker"];
    let crank = section.table("crank")?;
    let coupler = section.table("coupler")?;
    let rocker = section.table("rocker")?;
    let length = crank.value("length")?;
    let dimensions = FourBarDimensions {
        crank: length.si,
        coupler: coupler.si("length")?,
        rocker: rocker.si("length")?,
        pivot,
    };
    let links = [link(&crank)?, link(&coupler)?, link(&rocker)?];
    let built = match (&stroke, kept) {
        (None, false) => FourBar::new(dimensions, side, links),
        (Some((_, range)), false) => FourBar::over_stroke(dimensions, side, *range, links),
        (stroke, true) => {
            let stroke = stroke.as_ref().map(|(_, [from, to])| (*from, *to));
            let domain = stroke.map_or(Domain::Turn, |(from, to)| Domain::Stroke { from, to });
            FourBar::through_change_points(dimensions, side, domain, links)
        }
    };
    let mechanism = built.map_err(|error| match (&keep, &stroke, error) {
        (Some(keep), _, BuildError::Dimensions(misfit)) => {
            Problem::new(format!("{}: {misfit}", section.title()))
                .at(keep.span(), "nothing to keep like this")
                .help(misfit.cure().to_string())
        }
        (_, Some((item, _)), _) => stopped(section, item, error),
        (_, None, _) => blocked(section, &length, &length, error),
    })?;
    let joints = ["crank pivot", "crank pin", "rocker pin", "rocker pivot"];
    let [least, most] = mechanism.transmission_angle_range().map(f64::to_degrees);
    let angles = format!("{} to {} deg", short(least), short(most));
    let grashof = grashof(mechanism.grashof());
    let within = FourBar::FLAT;
    let change_points = (mechanism.change_points().into_iter())
        .map(|at| ChangePoint { at, within })
        .collect();
    Ok(
        AnyMechanism::new(section.chosen(), mechanism, parts, joints)
            .with_point("A", FourBar::CRANK, [dimensions.crank, 0.0])
            .with_point("B", FourBar::ROCKER, [dimensions.rocker, 0.0])
            .with_point("C", FourBar::ROCKER, [0.0, 0.0])
            .with_fact("Grashof's type", grashof)
            .with_fact("transmission angle over the crank's range", angles)
            .with_change_points(change_points),
    )
}

fn grashof(kind: Grashof) -> &'static str {
    match kind {
        Grashof::CrankRocker => "crank-rocker: the crank turns fully, the rocker swings",
        Grashof::DoubleCrank => "double crank (drag link): crank, coupler and rocker turn fully",
        Grashof::RockerCrank => "rocker-crank: the rocker could turn fully, the crank swings",
        Grashof::DoubleRocker => "double rocker: only the coupler could turn fully",
        Grashof::TripleRocker => "triple rocker: no link turns fully",
        Grashof::ChangePoint => "change point: the linkage can flatten",
    }
}

/// A crank that cannot turn fully: shown at the crank's length, or at that of the `last` link (to the slider) if that is too short. The help says how
/// to cure it.
pub(super) fn blocked(
    section: &Section,
    crank: &Value,
    last: &Value,
    error: BuildError,
) -> Problem {
    let BuildError::Rotation(blocked) = error else {
        return core(section, error);
    };
    let (place, label) = match blocked {
        RotationError::TooShort { .. } => (last, "too short"),
        _ => (crank, "this crank"),
    };
    let guided = match blocked {
        RotationError::FourBar { lengths, .. } if Grashof::of(lengths) == Grashof::ChangePoint => {
            "; if something guides it through the flat position, write keep_branch = true"
        }
        _ => "",
    };
    Problem::new(format!("{}: {blocked}", section.title()))
        .at(place.span(), label)
        .help(format!("{}{guided}", blocked.cure()))
}

/// A stroke that the linkage cannot follow.
pub(super) fn stopped(section: &Section, stroke: &Item, error: BuildError) -> Problem {
    if let BuildError::Range(RangeError::NotPositive(..)) = error {
        return stroke
            .problem(
                "is empty: its end must be larger than its start",
                "check these angles",
            )
            .help("write the smaller angle first: stroke = [\"-30 deg\", \"60 deg\"]");
    }
    let words = [
        "coupler and rocker cannot be connected",
        "coupler and rocker are in line",
    ];
    super::stopped(section, stroke, words, error)
}
