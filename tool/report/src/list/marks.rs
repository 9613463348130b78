//! Marks of drives in a list, and their legend.

use jred_sizing::catalogue::Drive;

/// Motor, gearbox and amplifier of a drive, marked.
pub(crate) fn drive(drive: &Drive) -> [String; 3] {
    let motor = key(&drive.motor.key, drive.motor.from_maker);
    let gearbox = drive.gearbox.map(|g| key(&g.key, g.from_maker));
    let amplifier = drive.amplifier.map(|a| {
        let mark = if drive.is_paired() { "" } else { " †" };
        key(&a.key, a.from_maker) + mark
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
