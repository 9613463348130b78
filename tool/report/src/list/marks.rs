//! Marks of drives in a list, and their legend.

use jred_sizing::catalogue::Drive;

/// Motor, gearbox and amplifier of a drive, marked: their keys, or maker and model.
pub(crate) fn drive(drive: &Drive, in_full: bool) -> [String; 3] {
    let m = drive.motor;
    let motor = part([&m.maker, &m.model, &m.key], m.from_maker, in_full);
    let gearbox = drive.gearbox;
    let gearbox = gearbox.map(|g| part([&g.maker, &g.model, &g.key], g.from_maker, in_full));
    let amplifier = drive.amplifier.map(|a| {
        let mark = if drive.is_paired() { "" } else { " †" };
        part([&a.maker, &a.model, &a.key], a.from_maker, in_full) + mark
    });
    [
        motor,
        gearbox.unwrap_or_else(|| "direct".to_owned()),
        amplifier.unwrap_or_else(|| "–".to_owned()),
    ]
}

/// The voltage class of a motor.
pub(crate) fn made_for(drive: &Drive) -> String {
    let made = drive.motor.made_for();
    made.map_or("–".to_owned(), |made| made.words())
}

/// A part by maker and model or by its key, marked.
pub(crate) fn part([maker, model, own]: [&String; 3], from_maker: bool, in_full: bool) -> String {
    if in_full {
        key(&format!("{maker} {model}"), from_maker)
    } else {
        key(own, from_maker)
    }
}

/// A key of the catalogue, marked if its figures are not from the maker's own document.
pub(crate) fn key(key: &str, from_maker: bool) -> String {
    let mark = if from_maker { "" } else { " *" };
    format!("{key}{mark}")
}

/// A line for each mark in the list.
pub(crate) fn legend(drives: &[Drive]) -> Vec<&'static str> {
    let mut lines = Vec::new();
    if drives.iter().any(|drive| !drive.from_makers()) {
        lines.push("* figures not from the maker's own document");
    }
    if drives.iter().any(|drive| drive.motor.made_for().is_none()) {
        lines.push("– voltage class of the motor not given in the catalogue");
    }
    if drives.iter().any(|drive| !drive.is_paired()) {
        lines.push("† no source pairs this amplifier with this motor; ask the makers");
    }
    lines
}
