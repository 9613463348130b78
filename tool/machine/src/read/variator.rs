//! `[variator]`: a friction variator between the motor and the drive train.

use jred::friction::{Contact, CreepContact, CreepLimit, Flow};
use jred::machine::motion::Law;

use crate::model::variator::{Ratio, Slip, Variator};

use super::drive_link::DriveLink;
use crate::text::item::Item;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::units::kind::{INERTIA, SHARE, TIME, TORQUE};

/// Ratios outside this range are refused as mistakes.
const RATIOS: [f64; 2] = [1e-3, 1e3];

/// The most shifts.
const MAX_SHIFTS: usize = 1000;

/// The laws of a shift: those without a jump of speed's second derivative.
const LAWS: [&str; 3] = ["polynomial-345", "cycloidal", "modified-sine"];

/// Which way power flows, as files write it.
pub(super) const FLOWS: [&str; 2] = ["input-drives", "output-drives"];

/// The variator, if the file has one.
pub(super) fn read(root: &Section, drive_link: DriveLink) -> Result<Option<Variator>> {
    let Some(item) = root.get("variator") else {
        return Ok(None);
    };
    let section = item.section("[variator]".into())?;
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
    section.expects(&[
        "ratio",
        "input_inertia",
        "output_inertia",
        "slip",
        "creep",
        "power_flow",
        "shift",
    ]);
    let mut ratio = Ratio::new(ratio(&section)?);
    let input = section.quantity("input_inertia", &INERTIA)?.positive()?;
    let output = section
        .quantity("output_inertia", &INERTIA)?
        .not_negative()?;
    let slip = slip(&section)?;
    if let Some(item) = section.get("shift") {
        let shifts = item.sections("[[variator.shift]]")?;
        if shifts.len() > MAX_SHIFTS {
            let what = format!(
                "has {} entries, but at most {MAX_SHIFTS} are possible",
                shifts.len()
            );
            return Err(item.problem(&what, "shifts"));
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
    section
        .require(
            "ratio",
            "ratio = 0.5, the output speed over the input speed",
        )?
        .number(RATIOS, "0.5")
}

fn slip(section: &Section) -> Result<Slip> {
    let (constant, creep) = (section.get("slip"), section.get("creep"));
    let flow = section.get("power_flow");
    match (constant, creep) {
        (Some(constant), Some(creep)) => {
            Err(Problem::new("[variator] has both `slip` and `creep`")
                .at(constant.key_span(), "a constant slip")
                .at(creep.key_span(), "a slip that grows with the load")
                .help("keep one of them"))
        }
        (Some(constant), None) => Ok(Slip::Constant {
            share: share(&constant)?,
            flow: self::flow(
                section,
                "slip always slows down the driven shaft: say which shaft drives",
            )?,
            contact: Contact::Slipping,
        }),
        (None, other) => {
            if let Some(flow) = flow {
                return Err(flow
                    .problem(
                        "is only used together with a constant `slip`",
                        "remove this",
                    )
                    .help("without slip, and with creep, it does not matter which shaft drives"));
            }
            match other {
                Some(creep) => self::creep(&creep),
                None => Ok(Slip::Constant {
                    share: 0.0,
                    flow: Flow::default(),
                    contact: Contact::Ideal,
                }),
            }
        }
    }
}

/// A slip of at least zero and below one.
pub(super) fn share(item: &Item) -> Result<f64> {
    let value = item.quantity(&SHARE)?;
    if value.si >= 1.0 {
        let what = format!("is {}, but must be below 100 %", value.shown());
        return Err(value
            .problem(&what, "nothing is coupled")
            .help("write the slip of the friction contact, usually 0.5 % to 5 %: \"2 %\""));
    }
    value.not_negative()
}

/// Direction of power flow, which is required for the reason `why`.
pub(super) fn flow(section: &Section, why: &str) -> Result<Flow> {
    let item = section.get("power_flow").ok_or_else(|| {
        section.missing(
            "power_flow",
            &format!("power_flow = \"input-drives\" or \"output-drives\": {why}"),
        )
    })?;
    Ok(match item.choice(&FLOWS)? {
        0 => Flow::FirstDrives,
        _ => Flow::SecondDrives,
    })
}

fn creep(item: &Item) -> Result<Slip> {
    let section = item.section("`creep` of [variator]".into())?;
    section.expects(&["slip", "torque"]);
    let slip = section.quantity("slip", &SHARE)?;
    slip.check_positive()?;
    if slip.si >= 1.0 {
        let what = format!("is {}, but must be below 100 %", slip.shown());
        return Err(slip.problem(&what, "nothing is coupled").help(
            "write the slip at the torque at which the contact starts to slide, usually 1 % to 5 %: \"3 %\"",
        ));
    }
    let torque = section.quantity("torque", &TORQUE)?.positive()?;
    section.finish()?;
    CreepContact::new(CreepLimit {
        slip: slip.si,
        torque,
    })
    .map(Slip::Creep)
    .map_err(|error| {
        section
            .problem(error.to_string(), "in this table")
            .help(error.cure().to_string())
    })
}

/// One shift after the others.
fn add(course: &mut Ratio, section: &Section) -> Result<()> {
    section.expects(&["at", "duration", "ratio", "law"]);
    let at = section.quantity("at", &TIME)?;
    let duration = section.quantity("duration", &TIME)?.positive()?;
    let before = course.end();
    if at.si < 0.0 || at.si < before {
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
    let law = match section.get("law") {
        Some(item) => match item.choice(&LAWS)? {
            1 => Law::Cycloidal,
            2 => Law::ModifiedSine,
            _ => Law::Polynomial345,
        },
        None => Law::Polynomial345,
    };
    section.finish()?;
    course.shift(at.si, duration, to, law).map_err(|error| {
        section
            .problem(error.to_string(), "in this shift")
            .help(error.cure().to_string())
    })
}
