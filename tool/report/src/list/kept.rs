//! What a motion made anew keeps of the file's, and what it does not.

use serde_json::{Value, json};

use jred_machine::model::machine::MachineFile;
use jred_machine::model::motion::{Motion, ToolCoordinate};
use jred_machine::number::rounding::short;
use jred_motion::moves::{Chain, Kept};

/// A speed (rad/s, or m/s) of what the motion prescribes.
fn speed(file: &MachineFile, speed: f64) -> String {
    let tool = file.motion.as_ref().and_then(Motion::tool);
    let drive = file.machine.mechanism().coordinate();
    let coordinate = tool.map_or(drive, ToolCoordinate::coordinate);
    let of = tool.map_or_else(String::new, |tool| format!(" of {}", tool.name()));
    format!("{} {}{of}", short(speed.abs()), coordinate.speed_unit())
}

/// A part that is kept.
pub fn kept(file: &MachineFile, kept: &Kept) -> String {
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

/// The lines about a chain of parts: each with its name.
pub fn lines(file: &MachineFile, chain: &Chain) -> Vec<(&'static str, String)> {
    let mut lines: Vec<_> = (chain.kept().map(|part| ("kept", kept(file, part)))).collect();
    if let Some(steady) = &chain.given_up {
        let says = format!(
            "the constant speed of the file, {}: it is all of the motion, so another one is sought for the same turn",
            speed(file, steady.speed)
        );
        lines.push(("not kept", says));
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

/// The kept parts.
pub(crate) fn json(file: &MachineFile, chain: &Chain) -> Value {
    let axis = file.axis();
    let one = |kept: &Kept| {
        json!({
            "segment": kept.segment + 1,
            "speed": kept.speed,
            "from": axis.position(kept.from),
            "to": axis.position(kept.to),
            "time": kept.duration,
        })
    };
    chain.kept().map(one).collect()
}
