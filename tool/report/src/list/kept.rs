//! Parts and limits of the file's motion that a new motion keeps, and those that it drops.

use schemars::JsonSchema;
use serde::Serialize;

use jred_file::model::machine::MachineFile;
use jred_file::model::motion::{Motion, ToolCoordinate};
use jred_file::number::rounding::short;
use jred_motion::moves::{Chain, KeptMotion};

/// A prescribed speed (rad/s, or m/s).
fn speed(file: &MachineFile, speed: f64) -> String {
    let tool = file.motion.as_ref().and_then(Motion::tool);
    let drive = file.machine.mechanism().coordinate();
    let coordinate = tool.map_or(drive, ToolCoordinate::coordinate);
    let of = tool.map_or_else(String::new, |tool| format!(" of {}", tool.name()));
    format!("{} {}{of}", short(speed.abs()), coordinate.speed_unit())
}

/// A part that is kept.
pub fn kept(file: &MachineFile, kept: &KeptMotion) -> String {
    let axis = file.axis();
    format!(
        "{} from {} to {} in {} s, as segment {} prescribes",
        speed(file, kept.speed),
        axis.place(kept.from),
        axis.place(kept.to),
        short(kept.duration),
        kept.segment + 1
    )
}

/// Named lines about a chain of parts.
pub fn lines(file: &MachineFile, chain: &Chain) -> Vec<(&'static str, String)> {
    let mut lines: Vec<_> = (chain.kept().map(|part| ("kept", kept(file, part)))).collect();
    if let Some(steady) = &chain.given_up {
        let says = format!(
            "the constant speed of the file, {}: the motion has no other part, so a new one is computed for the same turn",
            speed(file, steady.speed)
        );
        lines.push(("not kept", says));
    }
    if let Some(motion) = &file.motion {
        let drive = file.machine.mechanism().coordinate();
        for overshoot in &chain.overshoots {
            let says = format!(
                "the overshoot of the law: {}; its move goes directly to its end",
                overshoot.says(motion, drive)
            );
            lines.push(("not kept", says));
        }
    }
    if chain.begins > 0.0 {
        let says = format!(
            "{} s after the start of the cycle in the file, which is in the middle of a move",
            short(chain.begins)
        );
        lines.push(("begins", says));
    }
    lines
}

/// All lines about kept and dropped parts, for a command without options for limits.
pub(crate) fn all_lines(file: &MachineFile, chain: &Chain) -> Vec<(&'static str, String)> {
    let mut all = lines(file, chain);
    all.extend(limits(file, None).map(|says| ("limits", says)));
    all
}

/// Parts and limits that are not kept, for a command without options for limits.
pub(crate) fn lost(file: &MachineFile, chain: &Chain) -> Vec<String> {
    let all = all_lines(file, chain).into_iter();
    let lost = all.filter(|(name, _)| ["not kept", "limits"].contains(name));
    lost.map(|(_, says)| says).collect()
}

/// The limits of the file's segments that a new motion does not keep. `asked`: the given options; `None` if the command has no options for limits.
pub(crate) fn limits(file: &MachineFile, asked: Option<&[String]>) -> Option<String> {
    let motion = file.motion.as_ref()?;
    let tool = motion.tool();
    let coordinate = tool.map_or(
        file.machine.mechanism().coordinate(),
        ToolCoordinate::coordinate,
    );
    // Options limit the axis, which may not be the prescribed coordinate.
    let options = tool.is_none_or(|tool| tool.axis().is_some());
    let mut lost: Vec<(&str, f64)> = Vec::new();
    for (_, limits) in motion.limits() {
        let deceleration = limits.deceleration;
        let own = (deceleration.total_cmp(&limits.acceleration)).is_ne();
        let all = [
            (
                "speed",
                Some(limits.speed).filter(|speed| speed.is_finite()),
            ),
            ("acceleration", Some(limits.acceleration)),
            ("deceleration", Some(deceleration).filter(|_| own)),
            ("jerk", limits.jerk),
        ];
        let all = all
            .into_iter()
            .filter_map(|(name, value)| Some((name, value?)));
        for (name, value) in all {
            let given = |option: &String| option.starts_with(&format!("--max-{name} "));
            let given = options && asked.is_some_and(|asked| asked.iter().any(given));
            if !given && !lost.contains(&(name, value)) {
                lost.push((name, value));
            }
        }
    }
    if lost.is_empty() {
        return None;
    }
    let length = coordinate.speed_unit().trim_end_matches("/s");
    let unit = |name: &str| match name {
        "speed" => "/s",
        "jerk" => "/s^3",
        _ => "/s^2",
    };
    let value = |(name, value): &(&str, f64)| {
        let unit = unit(name);
        format!("max_{name} {} {length}{unit}", short(*value))
    };
    let values: Vec<String> = lost.iter().map(value).collect();
    let mut names: Vec<&str> = lost.iter().map(|(name, _)| *name).collect();
    names.dedup();
    let cure = if asked.is_some() && options {
        let names: Vec<String> = names.iter().map(|name| format!("--max-{name}")).collect();
        format!("; to keep them, give {}", names.join(", "))
    } else {
        String::new()
    };
    Some(format!(
        "{} of the segments in the file are not kept{cure}",
        values.join(", ")
    ))
}

/// A part of the file's motion that is kept.
#[derive(Debug, Serialize, JsonSchema)]
pub(crate) struct KeptPart {
    /// Number of the segment, from 1.
    segment: usize,
    /// Prescribed speed (rad/s, or m/s).
    speed: f64,
    /// Position at its start (rad, or m).
    from: f64,
    /// Position at its end (rad, or m).
    to: f64,
    /// Duration (s).
    time: f64,
}

/// The kept parts.
pub(crate) fn parts(file: &MachineFile, chain: &Chain) -> Vec<KeptPart> {
    let axis = file.axis();
    let one = |kept: &KeptMotion| KeptPart {
        segment: kept.segment + 1,
        speed: kept.speed,
        from: axis.position(kept.from),
        to: axis.position(kept.to),
        time: kept.duration,
    };
    chain.kept().map(one).collect()
}
