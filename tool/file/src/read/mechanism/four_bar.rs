//! `type = "four-bar"`.

use jred::Domain;
use jred::mechanism::{BuildError, FourBar, FourBarDimensions, Grashof, RotationError, Side};
use jred::number::RangeError;

use super::{core, link};
use crate::model::mechanism::{AnyMechanism, ChangePoint};
use crate::number::rounding::short;
use crate::text::item::{Item, Value};
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::units::kind::{ANGLE, LENGTH};

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let item = section.require("pivot", "pivot = [\"300 mm\", \"0 mm\"]")?;
    let pivot = item.pair([&LENGTH, &LENGTH])?.map(|value| value.si);
    let side = side(section.get("side"))?;
    let keep = section.get("keep_branch");
    let kept = keep.as_ref().map_or(Ok(false), Item::flag)?;
    let stroke = match section.get("stroke") {
        Some(item) => {
            let range = item.pair([&ANGLE, &ANGLE])?.map(|value| value.si);
            Some((item, range))
        }
        None => None,
    };
    let parts = ["crank", "coupler", "rocker"];
    let [crank, coupler, rocker] = [
        section.section(parts[0])?,
        section.section(parts[1])?,
        section.section(parts[2])?,
    ];
    let length = length(&crank)?;
    let dimensions = FourBarDimensions {
        crank: length.si,
        coupler: self::length(&coupler)?.si,
        rocker: self::length(&rocker)?.si,
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
    Ok(AnyMechanism::new(super::FOUR_BAR, mechanism, parts, joints)
        .with_point("A", FourBar::CRANK, [dimensions.crank, 0.0])
        .with_point("B", FourBar::ROCKER, [dimensions.rocker, 0.0])
        .with_point("C", FourBar::ROCKER, [0.0, 0.0])
        .with_fact("Grashof's type", grashof)
        .with_fact("transmission angle over the crank's range", angles)
        .with_change_points(change_points))
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

/// The length of a link, greater than zero.
pub(super) fn length(link: &Section) -> Result<Value> {
    let length = link.quantity("length", &LENGTH)?;
    length.check_positive()?;
    Ok(length)
}

/// `side = "left"` or `"right"`; left if not given.
pub(super) fn side(item: Option<Item>) -> Result<Side> {
    Ok(match item {
        Some(item) if item.choice(&["left", "right"])? == 1 => Side::Right,
        _ => Side::Left,
    })
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
