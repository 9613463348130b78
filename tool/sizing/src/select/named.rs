//! A drive of the catalogue by its name.

use jred_file::problem;
use jred_file::text::problem::Result;

use crate::catalogue::{Catalogue, Drive, DriveId};
use jred_file::plain;
use jred_file::units::closest;

/// Motor, gearbox and amplifier of a drive's name, by their keys: `MOTOR+GEARBOX on AMPLIFIER`.
fn keys(text: &str) -> (&str, Option<&str>, Option<&str>) {
    let (rest, amplifier) = match text.split_once(" on ") {
        Some((rest, amplifier)) => (rest, Some(amplifier.trim())),
        None => (text, None),
    };
    let rest = [", direct", "+direct"]
        .into_iter()
        .find_map(|end| rest.trim().strip_suffix(end))
        .unwrap_or(rest);
    match rest.split_once('+') {
        Some((motor, gearbox)) => (motor.trim(), Some(gearbox.trim()), amplifier),
        None => (rest.trim(), None, amplifier),
    }
}

/// Number of drives listed in a message.
const SHOWN: usize = 6;

/// Whether a drive has this name; a name without an amplifier matches any amplifier.
pub fn is_named(drive: &Drive, text: &str) -> bool {
    let (motor, gearbox, amplifier) = keys(text);
    drive.motor.key == motor
        && drive.gearbox.map(|g| g.key.as_str()) == gearbox
        && amplifier.is_none_or(|key| drive.amplifier.is_some_and(|a| a.key == key))
}

/// The drive whose name differs from a text only in capitals, if there is exactly one.
fn alike<'c>(catalogue: &'c Catalogue, text: &str) -> Option<(DriveId, Drive<'c>)> {
    let (motor, gearbox, amplifier) = keys(text);
    let one = |mut keys: Box<dyn Iterator<Item = &'c str> + 'c>, word: &str| {
        let own = keys.find(|key| key.eq_ignore_ascii_case(word))?;
        keys.all(|key| !key.eq_ignore_ascii_case(word))
            .then_some(own)
    };
    let Catalogue {
        motors,
        gearboxes,
        amplifiers,
        ..
    } = catalogue;
    let mut name = one(Box::new(motors.iter().map(|m| &*m.key)), motor)?.to_owned();
    if let Some(word) = gearbox {
        name += "+";
        name += one(Box::new(gearboxes.iter().map(|g| &*g.key)), word)?;
    }
    if let Some(word) = amplifier {
        name += " on ";
        name += one(Box::new(amplifiers.iter().map(|a| &*a.key)), word)?;
    }
    catalogue.drives().find(|(_, drive)| is_named(drive, &name))
}

/// The error for a drive whose parts exist but are not combined.
fn not_combined(
    catalogue: &Catalogue,
    [motor, text]: [&str; 2],
) -> jred_file::text::problem::Problem {
    let drives = catalogue
        .drives()
        .filter(|(_, drive)| drive.motor.key == motor);
    let names: Vec<String> = drives.map(|(_, drive)| drive.name()).collect();
    let shown = names.iter().take(SHOWN).map(String::as_str);
    let shown = shown.collect::<Vec<_>>().join(", ");
    let more = match names.len().saturating_sub(SHOWN) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    problem!(
        help = format!(
            "it combines {motor} into: {shown}{more}; name further gearboxes and amplifiers of a motor in compatibility.csv (docs/catalogue.md)"
        ),
        "the catalogue does not combine the parts of the drive {}",
        plain::quoted(text)
    )
}

/// The drive named by a text: MOTOR+GEARBOX or MOTOR, followed by " on AMPLIFIER" if the catalogue has amplifiers (otherwise the motor's first
/// amplifier is used). Letter case is ignored where that is unambiguous.
///
/// # Errors
/// The catalogue does not have this drive.
pub fn named<'c>(catalogue: &'c Catalogue, text: &str) -> Result<(DriveId, Drive<'c>)> {
    let (motor, gearbox, amplifier) = keys(text);
    if let Some(found) = catalogue.drives().find(|(_, drive)| is_named(drive, text)) {
        return Ok(found);
    }
    if let Some(found) = alike(catalogue, text) {
        return Ok(found);
    }
    let motors: Vec<&str> = catalogue.motors.iter().map(|m| m.key.as_str()).collect();
    let gearboxes: Vec<&str> = catalogue.gearboxes.iter().map(|g| g.key.as_str()).collect();
    let amplifiers: Vec<&str> = catalogue
        .amplifiers
        .iter()
        .map(|a| a.key.as_str())
        .collect();
    let has = |keys: &[&str], word: Option<&str>| word.is_none_or(|word| keys.contains(&word));
    if has(&motors, Some(motor)) && has(&gearboxes, gearbox) && has(&amplifiers, amplifier) {
        return Err(not_combined(catalogue, [motor, text]));
    }
    let (word, keys) = match (gearbox, amplifier) {
        _ if !motors.contains(&motor) => (motor, motors),
        (Some(gearbox), _) if !gearboxes.contains(&gearbox) => (gearbox, gearboxes),
        (_, Some(amplifier)) => (amplifier, amplifiers),
        (Some(gearbox), None) => (gearbox, gearboxes),
        (None, None) => (motor, motors),
    };
    let near = closest(word, &keys).map_or_else(
        || "`jred size FILE --all` lists every drive".to_owned(),
        |near| format!("did you mean \"{near}\"?"),
    );
    Err(problem!(
        help = near,
        "the catalogue has no {} for the drive {}",
        plain::quoted(word),
        plain::quoted(text)
    ))
}
