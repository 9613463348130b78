//! `between` and `ramp`: the part of the drive link's range in which a load acts.

use std::f64::consts::TAU;

use jred::Domain;
use jred::machine::Window;

use super::drive_link::DriveLink;
use crate::text::item::Item;
use crate::text::problem::Result;
use crate::text::section::Section;
use crate::text::value::Value;

/// `turns`: number of turns of the drive link after which a load repeats.
pub(super) fn turns(section: &Section, drive: DriveLink) -> Result<u32> {
    let Some(item) = section.get("turns") else {
        return Ok(1);
    };
    let turns = item.whole()?;
    if drive.domain == Domain::Turn {
        return Ok(turns);
    }
    Err(item
        .problem(
            "is given for a drive link with a stroke",
            "of a turning drive link",
        )
        .help("remove `turns`: the load acts wherever the drive link is"))
}

/// The window of a load that repeats after some turns, if it has one.
pub(super) fn read(section: &Section, drive: DriveLink, turns: u32) -> Result<Option<Window>> {
    match drive.domain {
        Domain::Turn => window(section, turns),
        Domain::Stroke { .. } => stretch(section, drive),
    }
}

/// The part of the turn in which the load acts.
fn window(section: &Section, turns: u32) -> Result<Option<Window>> {
    let period = f64::from(turns) * TAU;
    let whole = if turns == 1 {
        "one turn".to_owned()
    } else {
        format!("{turns} turns")
    };
    let (between, ramp) = (section.get("between"), section.given("ramp")?);
    let (between, ramp) = match (between, ramp) {
        (None, None) => return Ok(None),
        (Some(between), Some(ramp)) => (between, ramp),
        (Some(_), None) => {
            return Err(section.lacks("ramp"));
        }
        (None, Some(_)) => {
            return Err(section.lacks("between"));
        }
    };
    long_enough(&ramp, TAU)?;
    let [from, to] = between.values()?;
    precise_enough(&between, [&from, &to], ramp.si)?;
    let end = if to.si < from.si {
        to.si + period
    } else {
        to.si
    };
    let width = end - from.si;
    if width <= 0.0 || width > period * (1.0 + 1e-12) {
        return Err(between
            .problem(
                &format!("must span more than zero and at most {whole}"),
                "check these angles",
            )
            .help(format!(
                "the load acts from the first angle to the second; a smaller second angle means {whole} later: here \
                 the span is {}",
                to.show(width)
            )));
    }
    // Kept 1e-14 below the whole, so that rounding cannot make it wider.
    let start = from.si.rem_euclid(period);
    let end = start + width.min(period * (1.0 - 1e-14));
    if width < 2.0 * ramp.si {
        let what = format!(
            "is {}, too long for the range of {}",
            ramp.shown(),
            from.show(width)
        );
        let help = format!(
            "the load rises over one ramp and falls over another: write at most {}",
            ramp.show(width / 2.0)
        );
        if is_too_long(ramp.si, from.si, width) {
            return Err(ramp
                .problem(&what, "too long")
                .at(between.span(), "range")
                .help(help));
        }
    }
    let ramp = ramp.si.min((end - start) / 2.0);
    Window::over_turns(turns, [start, end], ramp)
        .map(Some)
        .map_err(|error| {
            between.problem(&format!("is not possible: {error}"), "check these angles")
        })
}

/// Share of a ramp by which the rounding of a window's ends may move it.
const RAMP_ROUNDING: f64 = 1e-6;

/// Checks that the ends have enough digits for the ramp: far from zero, a position is rounded.
fn precise_enough(between: &Item, [from, to]: [&Value; 2], ramp: f64) -> Result<()> {
    let rounding = f64::EPSILON * from.si.abs().max(to.si.abs());
    if rounding <= RAMP_ROUNDING * ramp {
        return Ok(());
    }
    Err(between
        .problem(
            &format!(
                "runs from {} to {}: so far from zero the ends of a range as short as this are rounded by {}",
                from.shown(),
                to.shown(),
                from.show(rounding)
            ),
            "too far away",
        )
        .help("give positions of the first turn, or of the stroke counted from its beginning, or a longer ramp"))
}

/// Checks that a ramp is long enough to differ from a step.
fn long_enough(ramp: &Value, span: f64) -> Result<()> {
    let least = Window::SHORTEST_RAMP * span;
    if ramp.si < least {
        return Err(ramp
            .problem(
                &format!("is {}, as steep as a jump", ramp.shown()),
                "too short",
            )
            .help(format!(
                "write at least {}, a millionth of the drive link's range",
                ramp.show(least)
            )));
    }
    Ok(())
}

/// The part of the stroke in which the load acts.
fn stretch(section: &Section, drive: DriveLink) -> Result<Option<Window>> {
    let kind = drive.position();
    let (between, ramp) = (section.get("between"), section.given("ramp")?);
    let (between, ramp) = match (between, ramp) {
        (None, None) => return Ok(None),
        (Some(between), Some(ramp)) => (between, ramp),
        (Some(_), None) => {
            let example = format!(
                "ramp = \"{}\": the way over which the load rises and falls",
                kind.example
            );
            return Err(section.missing("ramp", &example));
        }
        (None, Some(_)) => {
            let example = format!(
                "between = [\"{}\", …]: where the load acts, within the stroke {}",
                kind.example,
                drive.range()
            );
            return Err(section.missing("between", &example));
        }
    };
    long_enough(&ramp, drive.domain.span())?;
    let [from, to] = between.values()?;
    precise_enough(&between, [&from, &to], ramp.si)?;
    let width = to.si - from.si;
    if width <= 0.0 {
        return Err(between
            .problem(
                &format!("runs from {} to {}", from.shown(), to.shown()),
                "check these ends",
            )
            .help("on a stroke, the second position must be the larger one"));
    }
    let Domain::Stroke {
        from: start,
        to: end,
    } = drive.domain
    else {
        return Ok(None);
    };
    if to.si <= start || from.si >= end {
        return Err(between
            .problem(
                &format!("is outside the stroke, {}", drive.range()),
                "never reached",
            )
            .help("give positions within the stroke; positions beyond its ends are allowed"));
    }
    if is_too_long(ramp.si, from.si, width) {
        return Err(ramp
            .problem(
                &format!(
                    "is {}, too long for the range of {}",
                    ramp.shown(),
                    from.show(width)
                ),
                "too long",
            )
            .at(between.span(), "range")
            .help(format!(
                "the load rises over one ramp and falls over another: write at most {}",
                ramp.show(width / 2.0)
            )));
    }
    Window::new(drive.domain, [from.si, to.si], ramp.si.min(width / 2.0))
        .map(Some)
        .map_err(|error| {
            between.problem(
                &format!("is not possible: {error}"),
                "check these positions",
            )
        })
}

/// Whether two ramps are longer than a range by more than rounding, which grows with the distance of the range from zero.
fn is_too_long(ramp: f64, from: f64, width: f64) -> bool {
    width + 1e-14 * from.abs() < 2.0 * ramp * (1.0 - 1e-12)
}
