//! Limits of a fastest motion from the command line.

use std::collections::BTreeSet;

use miette::{Result, miette};

use super::motor_coordinate;
use crate::commands::core_error::core_report;
use crate::commands::{quantity, rate};
use crate::options::fastest::Fastest as Options;
use crate::options::gentlest::EndAcceleration;
use jred::Domain;
use jred::machine::Mechanism as _;
use jred_analysis::reduce::joints_with_force;
use jred_file::argument::{self, Argument};
use jred_file::model::axis::Axis;
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;
use jred_file::number::rounding::short;
use jred_file::number::words::counted;
use jred_file::plain;
use jred_file::text::key::{ACCELERATIONS, EFFORT, EFFORT_RATES, JERKS, SPEED};
use jred_motion::fastest::tool_speed::MOST;
use jred_motion::fastest::{JointForces, MoveLimits, ToolSpeed, ToolSpeeds};

/// The given options, except moves, drive and reserve, which the answer contains anyway.
fn asked(options: &Options) -> Vec<String> {
    let ends = options.ends.map(|ends| ends.word().to_owned());
    let given = [
        ("from-speed", &options.from_speed),
        ("to-speed", &options.to_speed),
        ("max-speed", &options.max_speed),
        ("max-acceleration", &options.max_acceleration),
        ("max-deceleration", &options.max_deceleration),
        ("max-jerk", &options.max_jerk),
        ("max-torque-rate", &options.max_torque_rate),
        ("ends", &ends),
        ("max-rms", &options.max_rms),
        ("max-winding-temperature", &options.max_winding_temperature),
    ];
    let given = given.into_iter();
    let given = given.filter_map(|(name, text)| Some(format!("--{name} {}", text.as_ref()?)));
    let forces = options.max_reaction.iter();
    let forces = forces.map(|text| format!("--max-reaction {text}"));
    given.chain(forces).collect()
}

/// The limits of the command line and of the gearbox, and the request as text.
///
/// # Errors
/// Bad input.
pub(super) fn limits(
    options: &Options,
    file: &MachineFile,
    gearbox: &MoveLimits,
) -> Result<(MoveLimits, Vec<String>)> {
    let axis = file.axis();
    let read = |name: &str, text: &Option<String>, argument: Argument| {
        rate(name, text.as_deref(), argument, &axis)
    };
    let acceleration = read(
        "max-acceleration",
        &options.max_acceleration,
        Argument::positive(ACCELERATIONS),
    )?;
    let deceleration = read(
        "max-deceleration",
        &options.max_deceleration,
        Argument::positive(ACCELERATIONS),
    )?;
    let jerk = read("max-jerk", &options.max_jerk, Argument::positive(JERKS))?;
    let torque_rate = quantity(
        "max-torque-rate",
        options.max_torque_rate.as_deref(),
        Argument::positive(EFFORT_RATES),
        motor_coordinate(file),
    )?;
    let has_rates = jerk.is_some() || torque_rate.is_some();
    if options.ends == Some(EndAcceleration::Zero) && !has_rates {
        return Err(miette!(
            help = "give --max-jerk or --max-torque-rate as well",
            "--ends zero alone has no fastest motion: the faster the acceleration rises from zero, the less time the motion takes"
        ));
    }
    let (tool, words) = tool_speeds(&options.max_tool_speed, file)?;
    let limits = MoveLimits {
        speed: read("max-speed", &options.max_speed, Argument::positive(SPEED))?,
        tool,
        forces: forces(&options.max_reaction, file)?,
        acceleration,
        deceleration: deceleration.or(acceleration),
        jerk,
        torque_rate,
        level_ends: has_rates && options.ends != Some(EndAcceleration::Free),
        ..*gearbox
    };
    Ok((limits, asked(options).into_iter().chain(words).collect()))
}

/// "crank pin=2 kN", for each joint.
fn forces(texts: &[String], file: &MachineFile) -> Result<JointForces> {
    let mut forces = JointForces::default();
    let mut named = BTreeSet::new();
    let joints = joints_with_force(file.machine.mechanism()).map_err(core_report)?;
    for text in texts {
        let given = format!("--max-reaction {}", plain::quoted(text));
        let Some((name, force)) = text.rsplit_once('=') else {
            return Err(miette!(
                help = "write a joint and its largest force: \"crank pin=2 kN\"",
                "{given} has no \"=\""
            ));
        };
        let name = name.trim();
        let Some((joint, _)) = joints.iter().find(|(_, own)| *own == name) else {
            let all: Vec<&str> = joints.iter().map(|(_, name)| *name).collect();
            return Err(miette!(
                help = format!("these do: {}", all.join(", ")),
                "{given}: the mechanism has no joint {} that carries a force",
                plain::quoted(name)
            ));
        };
        let force = Argument::positive(EFFORT)
            .read(force.trim(), Coordinate::Length)
            .map_err(|why| miette!("{given} cannot be used: {why}"))?;
        if !named.insert(*joint) {
            return Err(miette!(
                help = "give each joint one largest force",
                "--max-reaction names the joint {} twice",
                plain::quoted(name)
            ));
        }
        forces = forces.with(*joint, force);
    }
    Ok(forces)
}

/// The speed limits of the tool, and each as text with its range.
fn tool_speeds(texts: &[String], file: &MachineFile) -> Result<(ToolSpeeds, Vec<String>)> {
    let mut all = ToolSpeeds::default();
    let mut words = Vec::new();
    for text in texts {
        let (limit, own) = tool_speed(text, file)?;
        all = all.with(limit).ok_or_else(|| {
            miette!(
                help = "merge adjacent ranges into one",
                "--max-tool-speed is given {} times, at most {MOST} are read",
                texts.len()
            )
        })?;
        words.push(own);
    }
    Ok((all, words))
}

/// Two positions of the drive link, and whether their range repeats every turn: angles of the drive link do, lengths along an axis do not.
fn part(
    [from, to]: [&str; 2],
    domain: Domain,
    drive: &Axis,
    axis: &Axis,
) -> Result<([f64; 2], bool), String> {
    let both = |axes: [&Axis; 2]| {
        let one = |text: &str| argument::drive_positions(text, domain, axes).map(|all| all[0]);
        Ok([one(from)?, one(to)?])
    };
    if domain != Domain::Turn {
        return both([drive, axis]).map(|between| (between, true));
    }
    match both([drive, drive]) {
        Ok(between) => Ok((between, true)),
        Err(why) if axis.coordinate == drive.coordinate => Err(why),
        Err(_) => {
            let lengths = argument::drive_positions(from, domain, [axis, axis]);
            let between = both([drive, axis])?;
            if lengths.is_err() || argument::drive_positions(to, domain, [axis, axis]).is_err() {
                return Err("one position is an angle, the other a length; write both as angles of the drive link, which repeat every turn, or both as lengths".to_owned());
            }
            Ok((between, false))
        }
    }
}

/// "slider, 60 mm/s, 300 deg, 360 deg": the limit, and its range as text.
fn tool_speed(text: &str, file: &MachineFile) -> Result<(ToolSpeed, String)> {
    let given = format!("--max-tool-speed {}", plain::quoted(text));
    let mechanism = file.machine.mechanism();
    let links = mechanism.link_names();
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    let &[point, speed, from, to] = parts.as_slice() else {
        return Err(miette!(
            help = "write a point, its largest speed, and two positions of the drive link: \"slider, 60 mm/s, 300 deg, 360 deg\"",
            "{given} has {} instead of four",
            counted(parts.len(), "part", "parts")
        ));
    };
    let named = mechanism.points().iter().find(|own| own.name == point);
    let link = || links.iter().position(|name| name == point);
    let place = named
        .map(|own| (own.link, own.at))
        .or_else(|| Some((link()?, [0.0; 2])));
    let Some((link, at)) = place else {
        let points = mechanism.points().iter().map(|own| own.name.as_str());
        let all: Vec<&str> = points.chain(links.iter().map(String::as_str)).collect();
        return Err(miette!(
            help = format!("it has {}", all.join(", ")),
            "{given}: the mechanism has no point and no link {}",
            plain::quoted(point)
        ));
    };
    let refused = |why: String| miette!("{given} cannot be used: {why}");
    let most = Argument::positive(SPEED)
        .read(speed, Coordinate::Length)
        .map_err(refused)?;
    let domain = mechanism.domain();
    let turns = domain == Domain::Turn;
    let drive = Axis::of_drive(mechanism.coordinate());
    let axis = file.axis();
    let ([start, end], repeats) = part([from, to], domain, &drive, &axis).map_err(refused)?;
    let spoken = if turns && repeats { drive } else { axis };
    let between = if turns && repeats {
        [start, end]
    } else {
        // The axis may move backward while the drive link moves forward.
        [start.min(end), start.max(end)]
    };
    let width = between[1] - between[0];
    if width == 0.0 || (repeats && width.abs() > domain.span()) {
        return Err(miette!(
            help = "the range runs from the first position to the second in the direction of growing positions; on a turn the second may be smaller",
            "{given}: {from} to {to} is not a valid range"
        ));
    }
    let over = if width < 0.0 {
        let rest = spoken.coordinate.shown(domain.span() + width);
        format!(
            ", over the end of the turn, {} {} in all (for the other part swap the positions)",
            short(rest),
            spoken.coordinate.unit()
        )
    } else {
        String::new()
    };
    let words = format!(
        "--max-tool-speed {point}, {speed}, from {} to {}{over}",
        spoken.place(start),
        spoken.place(end)
    );
    let limit = ToolSpeed::new(mechanism, link, at, most, between);
    let limit = limit.map_err(core_report)?;
    let limit = limit.map(|limit| {
        let limit = if repeats { limit } else { limit.once() };
        (limit, words)
    });
    limit.ok_or_else(|| {
        miette!(
            help = "choose a point or a link that moves with the drive link",
            "{given}: {} does not move",
            plain::quoted(point)
        )
    })
}
