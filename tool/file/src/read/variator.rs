//! `[variator]`: a friction variator between the motor and the drive train.

mod formula;

use jred::friction::{Contact, CreepContact, CreepLimit, Flow};
use jred::machine::motion::Law;

use crate::model::variator::{Adhesion, RATIOS, Ratio, Slip, Variator};

use super::drive_link::DriveLink;
use crate::number::rounding::figure;
use crate::text::item::Item;
use crate::text::problem::Result;
use crate::text::section::Section;
use crate::units::kind::{SHARE, TIME, TORQUE};

/// The laws of a shift: those whose speed has a continuous second derivative.
const LAWS: [Law; 3] = [Law::Polynomial345, Law::Cycloidal, Law::ModifiedSine];

/// The variator, if the file has one.
pub(super) fn read(root: &Section, drive_link: DriveLink) -> Result<Option<Variator>> {
    let Some(section) = root.maybe_table("variator")? else {
        return Ok(None);
    };
    if drive_link.slides() {
        return Err(section
            .problem(
                "the output of a variator is a shaft, but the drive link of this mechanism slides",
                "no shaft to drive",
            )
            .help(
                "make the screw, rack or crank that moves the drive link part of the mechanism",
            ));
    }
    let given = section.get("ratio");
    let whole = given.filter(|item| item.is_list() || item.is_text());
    let mut ratio = match &whole {
        Some(list) if list.is_list() => points(list)?,
        Some(text) => formula::formula(text, root)?,
        None => Ratio::new(ratio(&section)?),
    };
    let (input, output) = (section.si("input_inertia")?, section.si("output_inertia")?);
    let slip = slip(&section)?;
    if let Some(item) = section.get("shift") {
        let shifts = section.tables("shift")?;
        if let Some(whole) = &whole {
            return Err(item
                .problem("is given together with a `ratio` over time", "shifts")
                .at(whole.key_span(), "its whole course")
                .help(
                    "give one ratio and its shifts, or the whole course of the ratio as a list or as a formula",
                ));
        }
        for shift in &shifts {
            add(&mut ratio, shift)?;
        }
    }
    section.finish()?;
    Ok(Some(Variator {
        ratio,
        slip,
        inertia: [input, output],
    }))
}

fn ratio(section: &Section) -> Result<f64> {
    section.figure("ratio")
}

/// `ratio = [["0 s", 0.5], …]`: a curve through points over time.
fn points(list: &Item) -> Result<Ratio> {
    const EXAMPLE: &str = "[[\"0 s\", 0.5], [\"0.2 s\", 0.6], …]";
    let (mut times, mut ratios): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
    for point in list.list("point", EXAMPLE)? {
        let [time, ratio] = point.both("value", EXAMPLE)?;
        let time = time.quantity(&TIME)?;
        if times.last().is_some_and(|last| time.si <= *last) || time.si < 0.0 {
            let what = format!("is {}, not after the one before", time.shown());
            return Err(time
                .problem(&what, "does not increase")
                .help("give the points in the order of their times, from 0 s on"));
        }
        times.push(time.si);
        ratios.push(ratio.number(RATIOS, "0.6")?);
    }
    let (ratio, [at, least]) = Ratio::through(&times, &ratios).map_err(|fault| {
        list.problem(&format!("is no curve: {fault}"), "these points")
            .help("give at least 5 points; a ratio that goes from one value to another in one go is a [[variator.shift]]")
    })?;
    if least < RATIOS[0] {
        return Err(list
            .problem(
                &format!("swings to {} at t = {} s", figure(least), figure(at)),
                "these points",
            )
            .help("the curve through the points must stay above zero: add points where it bends"));
    }
    Ok(ratio)
}

fn slip(section: &Section) -> Result<Slip> {
    let given = section.one_of(&["slip", "creep"]);
    let flow = section.get("power_flow");
    if let Some(("slip", constant)) = given {
        return Ok(Slip::Constant {
            share: share(&constant)?,
            flow: self::flow(
                section,
                "slip always slows down the driven shaft: say which shaft drives",
            )?,
            contact: Contact::Slipping,
        });
    }
    if let Some(flow) = flow {
        return Err(flow
            .problem(
                "is only used together with a constant `slip`",
                "remove this",
            )
            .help("without slip, and with creep, it does not matter which shaft drives"));
    }
    match given {
        Some((_, creep)) => self::creep(&creep),
        None => Ok(Slip::Constant {
            share: 0.0,
            flow: Flow::default(),
            contact: Contact::Ideal,
        }),
    }
}

/// A slip of at least zero and less than one.
pub(super) fn share(item: &Item) -> Result<f64> {
    let value = item.value()?;
    if value.si >= 1.0 {
        let what = format!("is {}, but must be below 100 %", value.shown());
        return Err(value
            .problem(&what, "nothing is coupled")
            .help("write the slip of the friction contact, usually 0.5 % to 5 %: \"2 %\""));
    }
    Ok(value.si)
}

/// Direction of power flow; the message about a missing one gives the reason `why`.
pub(super) fn flow(section: &Section, why: &str) -> Result<Flow> {
    let item = section.get("power_flow").ok_or_else(|| {
        section.missing(
            "power_flow",
            &format!("power_flow = \"input-drives\" or \"output-drives\": {why}"),
        )
    })?;
    Ok(match item.word()? {
        0 => Flow::FirstDrives,
        _ => Flow::SecondDrives,
    })
}

fn creep(item: &Item) -> Result<Slip> {
    let section = item.section("`creep` of [variator]".into())?;
    if let Some(curve) = section.get("curve") {
        section.finish()?;
        return adhesion(&curve).map(Slip::Creep);
    }
    let slip = section.value("slip")?;
    if slip.si >= 1.0 {
        let what = format!("is {}, but must be below 100 %", slip.shown());
        return Err(slip.problem(&what, "nothing is coupled").help(
            "write the slip at the torque at which the contact starts to slide, usually 1 % to 5 %: \"3 %\"",
        ));
    }
    let torque = section.value("torque")?.si;
    section.finish()?;
    CreepContact::new(CreepLimit {
        slip: slip.si,
        torque,
    })
    .map(|contact| Slip::Creep(Adhesion::Line(contact)))
    .map_err(|error| section.error(error, "in this table"))
}

/// `curve = [["0.5 %", "12 N m"], …]`: slip over the torque at the contact.
fn adhesion(list: &Item) -> Result<Adhesion> {
    const EXAMPLE: &str =
        "[[\"0.5 %\", \"12 N m\"], [\"1.5 %\", \"30 N m\"], [\"3 %\", \"36 N m\"]]";
    let (mut slips, mut torques): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
    for point in list.list("point", EXAMPLE)? {
        let [slip, torque] = point.pair([&SHARE, &TORQUE])?;
        for (value, before) in [(&slip, slips.last()), (&torque, torques.last())] {
            value.check_positive()?;
            if before.is_some_and(|before| value.si <= *before) {
                let what = format!("is {}, not more than the one before", value.shown());
                return Err(value
                    .problem(&what, "does not increase")
                    .help("a contact that carries more slips more: give the points by rising slip and torque, without [0, 0]; beyond the last point it slides"));
            }
        }
        if slip.si >= 1.0 {
            let what = format!("is {}, but must be below 100 %", slip.shown());
            return Err(slip
                .problem(&what, "nothing is coupled")
                .help(format!("write curve = {EXAMPLE}")));
        }
        slips.push(slip.si);
        torques.push(torque.si);
    }
    Adhesion::through(&slips, &torques)
        .map_err(|fault| list.problem(&format!("is no curve: {fault}"), "these points"))
}

/// Adds a shift after those before.
fn add(course: &mut Ratio, section: &Section) -> Result<()> {
    let (at, duration) = (section.value("at")?, section.si("duration")?);
    let before = course.end();
    if at.si < before {
        let what = format!(
            "is {}, but must not be before {}",
            at.shown(),
            at.show(before.max(0.0))
        );
        return Err(at.problem(&what, "too early").help(
            "each shift must start after the previous one has ended, the first at 0 s or later",
        ));
    }
    let to = ratio(section)?;
    let law = section.pick("law", LAWS)?;
    section.finish()?;
    course
        .shift(at.si, duration, to, law)
        .map_err(|error| section.error(error, "in this shift"))
}
