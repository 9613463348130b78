//! `[variator]`: a friction variator between the motor and the drive train.

use jred::friction::{Contact, Course as _, CreepContact, CreepLimit, Flow, OperatingPoint};
use jred::machine::motion::Law;
use jred_enclosure::Interval;

use crate::model::variator::{Adhesion, RATIOS, Ratio, Slip, VARIABLES, Variator};
use crate::number::formula::Formula;

use super::drive_link::DriveLink;
use crate::number::rounding::figure;
use crate::text::item::Item;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::units::kind::{INERTIA, SHARE, TIME, TORQUE};

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
    let given = section.peek("ratio");
    let whole = given.filter(|item| item.is_list() || item.is_text());
    let mut ratio = match &whole {
        Some(list) if list.is_list() => points(list)?,
        Some(text) => formula(text, root)?,
        None => Ratio::new(ratio(&section)?),
    };
    let input = section.quantity("input_inertia", &INERTIA)?.positive()?;
    let output = section
        .quantity("output_inertia", &INERTIA)?
        .not_negative()?;
    let slip = slip(&section)?;
    if let Some(item) = section.get("shift") {
        let shifts = item.sections("[[variator.shift]]")?;
        if let Some(whole) = &whole {
            return Err(item
                .problem("is given together with a `ratio` over time", "shifts")
                .at(whole.key_span(), "its whole course")
                .help(
                    "give one ratio and its shifts, or the whole course of the ratio as a list or as a formula",
                ));
        }
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

/// Times of a simulation at which a formula is tried.
const TRIED: u32 = 4000;

/// `ratio = "0.8 + 0.3*sin(2*pi*t)"`: a formula of the time (s) and of the angle of the input shaft (rad).
fn formula(item: &Item, root: &Section) -> Result<Ratio> {
    let text = item.text("0.8 + 0.3*sin(2*pi*t)")?;
    let formula = Formula::parse(text, &VARIABLES).map_err(|fault| {
        let shown = text.get(fault.place).unwrap_or_default();
        let label = if shown.is_empty() {
            "this formula".to_owned()
        } else {
            format!("at \"{shown}\"")
        };
        item.problem(&format!("is no formula: {}", fault.what), &label).help(
            "write a ratio as a number, ratio = 0.5, or as a formula of the time t (s) and the angle phi (rad) of the input shaft: \
             ratio = \"0.8 + 0.3*sin(2*pi*t)\"",
        )
    })?;
    // Until the end of the simulation; over the angle, over one turn from the start. Beyond, the simulation looks itself.
    let simulation = root.peek("simulation").filter(Item::is_table);
    let duration = match simulation {
        Some(item) => match item.section("[simulation]".into())?.peek("duration") {
            Some(duration) => duration.quantity(&TIME)?.si,
            None => 0.0,
        },
        None => 0.0,
    };
    let ratio = Ratio::by(formula);
    for k in 0..=TRIED {
        let share = f64::from(k) / f64::from(TRIED);
        let (t, phi) = (
            share * duration,
            (share * 64.0).fract() * std::f64::consts::TAU,
        );
        if let Some(what) = leaves(&ratio, t, phi) {
            return Err(item.problem(&what, "this formula").help(POSITIVE));
        }
    }
    match unbounded(&ratio, duration) {
        None => Ok(ratio),
        Some([t, phi]) => Err(match leaves(&ratio, t, phi) {
            Some(what) => item
                .problem(&what, "this formula")
                .help(POSITIVE),
            None => item
                .problem(
                    &format!(
                        "is not shown to stay between {} and {} near {}",
                        RATIOS[0],
                        RATIOS[1],
                        place(&ratio, t, phi)
                    ),
                    "this formula",
                )
                .help("between the instants that were tried it may have a pole or a zero there: check what is divided by"),
        }),
    }
}

/// The cure of a formula that leaves its range.
const POSITIVE: &str = "the output speed over the input speed is positive at every instant of the simulation: check the signs, and what is divided by";

/// A time, and an angle where the ratio depends on it.
fn place(ratio: &Ratio, t: f64, phi: f64) -> String {
    if ratio.is_turned() {
        format!("t = {} s, phi = {} rad", figure(t), figure(phi))
    } else {
        format!("t = {} s", figure(t))
    }
}

/// How a ratio leaves its range at a time (s) and an angle (rad), if it does.
fn leaves(ratio: &Ratio, t: f64, phi: f64) -> Option<String> {
    let found = ratio.at(OperatingPoint::at_time(t).with_angle(phi));
    let value = found.value;
    if !found.is_finite() {
        return Some(format!(
            "has no finite value or slope at {}",
            place(ratio, t, phi)
        ));
    }
    let out = !(RATIOS[0]..=RATIOS[1]).contains(&value);
    out.then(|| {
        format!(
            "is {} at {}, but must be between {} and {}",
            figure(value),
            place(ratio, t, phi),
            RATIOS[0],
            RATIOS[1]
        )
    })
}

/// Parts of a range that are looked into at first.
const PARTS: u32 = 64;

/// Share of a range below which a part is a place.
const PLACE: f64 = 1e-12;

/// Most parts that are looked into.
const MOST_PARTS: u32 = 400_000;

/// Where the bounds of a formula do not lie within those of a ratio, over all times of the simulation and one turn of the input shaft.
fn unbounded(ratio: &Ratio, duration: f64) -> Option<[f64; 2]> {
    let turn = if ratio.is_turned() {
        std::f64::consts::TAU
    } else {
        0.0
    };
    let spans = [duration, turn];
    let part = |span: f64, k: u32| {
        let end = |k: u32| span * f64::from(k) / f64::from(PARTS);
        Interval::between(end(k), end(k + 1))
    };
    let counts = spans.map(|span| if span > 0.0 { PARTS } else { 1 });
    let times = (0..counts[0]).rev();
    let mut parts: Vec<[Interval; 2]> = times
        .flat_map(|k| {
            (0..counts[1])
                .rev()
                .map(move |l| [part(spans[0], k), part(spans[1], l)])
        })
        .collect();
    let mut looked = 0;
    while let Some([t, phi]) = parts.pop() {
        let found = ratio.bounds(t, phi)?;
        if RATIOS[0] <= found.lo() && found.hi() <= RATIOS[1] {
            continue;
        }
        looked += 1;
        let share = |of: Interval, span: f64| if span > 0.0 { of.width() / span } else { 0.0 };
        let [in_time, in_angle] = [share(t, duration), share(phi, turn)];
        let middle = [t, phi].map(Interval::middle);
        let small = looked > MOST_PARTS || in_time.max(in_angle) < PLACE;
        if small || leaves(ratio, middle[0], middle[1]).is_some() {
            return Some(middle);
        }
        let halves = |of: Interval| {
            let middle = of.middle();
            [
                Interval::between(middle, of.hi()),
                Interval::between(of.lo(), middle),
            ]
        };
        if in_time >= in_angle {
            parts.extend(halves(t).map(|t| [t, phi]));
        } else {
            parts.extend(halves(phi).map(|phi| [t, phi]));
        }
    }
    None
}

/// `ratio = [["0 s", 0.5], …]`: a curve through points in time.
fn points(list: &Item) -> Result<Ratio> {
    const EXAMPLE: &str = "[[\"0 s\", 0.5], [\"0.2 s\", 0.6], …]";
    let (mut times, mut ratios): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
    for point in list.list("point", EXAMPLE)? {
        let pair = point.list("value", "[\"0.2 s\", 0.6]")?;
        let [time, ratio] = pair.as_slice() else {
            return Err(point
                .problem("must be a time and a ratio", "here")
                .help(format!("write ratio = {EXAMPLE}")));
        };
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
    if times.len() > MAX_SHIFTS {
        let what = format!(
            "has {} points, but at most {MAX_SHIFTS} are possible",
            times.len()
        );
        return Err(list.problem(&what, "points"));
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
    section.expects(&["slip", "torque", "curve"]);
    if let Some(curve) = section.get("curve") {
        for key in ["slip", "torque"] {
            if let Some(other) = section.peek(key) {
                return Err(curve
                    .problem(&format!("is given together with `{key}`"), "the whole curve")
                    .at(other.key_span(), "a point of a straight line")
                    .help("keep the curve, whose last point is where the contact begins to slide, or slip and torque of that point alone"));
            }
        }
        section.finish()?;
        return adhesion(&curve).map(Slip::Creep);
    }
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
    .map(|contact| Slip::Creep(Adhesion::Line(contact)))
    .map_err(|error| {
        section
            .problem(error.to_string(), "in this table")
            .help(error.cure().to_string())
    })
}

/// `curve = [["0.5 %", "12 N m"], …]`: slip over the torque of the contact.
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
    let count = slips.len();
    if !(3..=MAX_SHIFTS).contains(&count) {
        let what = format!("has {count} points, but needs 3 to {MAX_SHIFTS}");
        return Err(list.problem(&what, "points").help(
            "from the point alone where it begins to slide: creep = { slip = \"3 %\", torque = \"45 N m\" }, with slip in proportion to the torque",
        ));
    }
    Adhesion::through(&slips, &torques)
        .map_err(|fault| list.problem(&format!("is no curve: {fault}"), "these points"))
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
