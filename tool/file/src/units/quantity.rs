//! Quantities: a number and its unit, of the kind that the key requires.

use super::RPM;
use super::fault::Fault;
use super::kind::{ANGULAR_SPEED, CUTOFF, Kind, SHARE, TEMPERATURE, describe};
use super::unit::{self, Unit};
use crate::math;
use crate::number::rounding::figure;

/// A quantity as read.
#[derive(Debug)]
pub struct Quantity {
    /// The value in SI.
    pub si: f64,
    /// The unit in which it was written.
    pub unit: Unit,
}

impl Quantity {
    /// The value `si` in the unit in which the quantity was written, for messages.
    pub fn in_its_unit(&self, si: f64) -> String {
        format!("{} {}", figure(self.unit.number(si)), self.unit.text)
    }
}

/// Reads `text` as a quantity of the `kind`.
///
/// # Errors
/// A missing number, a missing or wrong unit, or a value outside the range of the kind.
pub fn read(text: &str, kind: &Kind) -> Result<Quantity, Fault> {
    let tidy = unit::tidy(text);
    if tidy.is_empty() {
        return Err(Fault::new(
            "is empty",
            format!("write {}: \"{}\"", kind.name, kind.example),
        ));
    }
    let (number, rest) = split_number(&tidy, kind)?;
    if rest.is_empty() {
        if kind.dimension == SHARE.dimension {
            return finish(number, Unit::plain(), kind);
        }
        return Err(no_unit(&number, kind));
    }
    let unit = unit::read(rest).map_err(|fault| converted(fault, &number, rest, kind))?;
    let unit = meant(unit, &[kind])?;
    let units = || {
        let (name, example, units) = (kind.name, kind.example, kind.units);
        format!("write {name} such as \"{example}\"; possible units: {units}")
    };
    if let Some(fault) = misfit(&unit, text, &[kind], units) {
        return Err(fault);
    }
    finish(number, unit, kind)
}

/// Reads a unit of one of the `kinds`, and returns the index of the kind. An empty text is the unit of a share. A header can have a power of ten:
/// "10^-4 kg m^2".
///
/// # Errors
/// No unit, one that cannot be read, or one of another kind.
pub fn unit_of(text: &str, kinds: &[&Kind]) -> Result<(Unit, usize), Fault> {
    let tidy = unit::tidy(text);
    let (power, rest) = unit::power_of_ten(&tidy);
    let unit = match rest {
        "" => Unit::plain(),
        rest => meant(unit::read_listed(rest)?, kinds)?,
    };
    let unit = Unit {
        text: text.to_owned(),
        scale: unit.scale * 10f64.powi(power),
        ..unit
    };
    if let Some(fault) = misfit(&unit, text, kinds, || possible_units(kinds)) {
        return Err(match text {
            "" => Fault::new("has no unit", possible_units(kinds)).label("no unit"),
            _ => fault,
        });
    }
    let fits = |kind: &&Kind| kind.is_measured_by(unit.dimension);
    let kind = kinds.iter().position(fits).unwrap_or_default();
    Ok((unit, kind))
}

/// The unit with the meaning that fits the kinds: a pound is a mass or a force, and "1/min" may count turns.
///
/// # Errors
/// Both a mass and a force are possible.
fn meant(unit: Unit, kinds: &[&Kind]) -> Result<Unit, Fault> {
    let fits = |unit: &Unit| kinds.iter().any(|kind| kind.is_measured_by(unit.dimension));
    match unit.as_force().filter(fits) {
        Some(_) if fits(&unit) => Err(Fault::new(
            format!("has the unit \"{}\", a mass or a force", unit.text),
            "write \"lbm\" for a mass, \"lbf\" or \"ozf\" for a force",
        )),
        Some(force) => Ok(force),
        None => Ok(per_minute(unit, kinds)),
    }
}

/// "1/min" and "min^-1" count turns if an angular speed is expected, as on name plates.
fn per_minute(unit: Unit, kinds: &[&Kind]) -> Unit {
    let asked = |of: &Kind| kinds.iter().any(|kind| kind.dimension == of.dimension);
    let counts = matches!(unit.text.as_str(), "1/min" | "min^-1" | "min-1" | "min⁻¹");
    if counts && asked(&ANGULAR_SPEED) && !asked(&CUTOFF) {
        return Unit::new(unit.text, RPM, ANGULAR_SPEED.dimension);
    }
    unit
}

/// The fault of a unit that is not accepted; its cure gives the quantity in an accepted unit, if it can be converted.
fn converted(fault: Fault, number: &str, text: &str, kind: &Kind) -> Fault {
    let given = unit::read_every(text).filter(|unit| kind.is_measured_by(unit.dimension));
    let Some((given, own)) = given.zip(unit::read(kind.unit).ok()) else {
        return fault;
    };
    let value = number.parse().unwrap_or(f64::NAN) * given.scale / own.scale;
    if !value.is_finite() {
        return fault;
    }
    // Nine decimals of the mantissa remove rounding errors.
    let shown: f64 = format!("{value:.9e}").parse().unwrap_or(value);
    Fault {
        help: format!("write \"{shown} {}\"; {}", kind.unit, fault.help),
        ..fault
    }
}

/// The fault of a number without a unit.
pub fn no_unit(number: &str, kind: &Kind) -> Fault {
    Fault::new(
        format!("has no unit: {number}"),
        format!(
            "write {} as a text with its unit, such as \"{number} {}\" (possible units: {})",
            kind.name, kind.unit, kind.units
        ),
    )
    .label("no unit")
}

/// A share written as a plain number.
///
/// # Errors
/// A number that is not finite or far too large.
pub fn share(number: String) -> Result<Quantity, Fault> {
    finish(number, Unit::plain(), &SHARE)
}

fn finish(number: String, unit: Unit, kind: &Kind) -> Result<Quantity, Fault> {
    let si = if unit.zero == 0.0 {
        scaled(&number, unit.scale)
    } else {
        number.parse().map_or(f64::NAN, |number| unit.si(number))
    };
    if !si.is_finite() {
        return Err(not_finite(kind));
    }
    let quantity = Quantity { si, unit };
    if si.abs() > kind.largest {
        let shown = if quantity.unit.text.is_empty() {
            number
        } else {
            format!("{number} {}", quantity.unit.text)
        };
        return Err(Fault::new(
            format!("is {shown}, too large for any machine"),
            format!(
                "at most {} is accepted here; check the number and its unit",
                quantity.in_its_unit(kind.largest).trim_end()
            ),
        ));
    }
    Ok(quantity)
}

/// The fault of infinity and NaN.
pub fn not_finite(kind: &Kind) -> Fault {
    Fault::new(
        "is not a finite number",
        format!(
            "write {} as a number with a unit: \"{}\"",
            kind.name, kind.example
        ),
    )
}

/// `number`·`scale`. If the scale is a power of ten, it goes into the exponent of the number, so that "120 mm" is the double nearest to 0.12.
fn scaled(number: &str, scale: f64) -> f64 {
    let power = math::log10(scale).round();
    if power.is_finite() && (10f64.powi(power as i32) / scale - 1.0).abs() < 1e-12 {
        let (digits, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
        if let Ok(exponent) = exponent.parse::<i32>() {
            let shifted = format!("{digits}e{}", exponent.saturating_add(power as i32));
            return shifted.parse().unwrap_or(f64::NAN);
        }
    }
    number
        .parse::<f64>()
        .map_or(f64::NAN, |value| value * scale)
}

/// Splits "1.2e-3 kg m^2" into its number and its unit.
///
/// # Errors
/// A missing number, more than one, or one that is not written with digits and a decimal point.
pub fn split_number<'t>(text: &'t str, kind: &Kind) -> Result<(String, &'t str), Fault> {
    unit::short_enough(text)?;
    let bytes = text.as_bytes();
    let is = |index: usize, set: &[u8]| bytes.get(index).is_some_and(|b| set.contains(b));
    let digits = |from: usize| {
        from + bytes
            .iter()
            .skip(from)
            .take_while(|b| b.is_ascii_digit())
            .count()
    };
    let sign = usize::from(is(0, b"+-"));
    let mut end = digits(sign);
    let mut count = end - sign;
    if is(end, b".") {
        let after = digits(end + 1);
        count += after - end - 1;
        end = after;
    }
    let part = |range: std::ops::Range<usize>| text.get(range).unwrap_or_default();
    if count == 0 {
        let word = part(sign..text.len()).trim().to_lowercase();
        if word.starts_with("nan") || word.starts_with("inf") {
            return Err(not_finite(kind));
        }
        return Err(Fault::new(
            format!("does not begin with a number: \"{text}\""),
            format!(
                "write {} as a number with a unit: \"{}\"",
                kind.name, kind.example
            ),
        ));
    }
    if is(end, b",") {
        let (whole, fraction) = (part(0..end), part(end + 1..digits(end + 1)));
        return Err(Fault::new(
            "has a comma in its number",
            format!(
                "write a decimal point, \"{whole}.{fraction}\", and no separator for thousands, \"{whole}{fraction}\""
            ),
        ));
    }
    let mut number = part(0..end).to_owned();
    // An exponent: `e-3`, `E+3` or `*10^-3`.
    let exponent = if is(end, b"eE") {
        Some(end + 1)
    } else if part(end..text.len()).starts_with("*10^") {
        Some(end + 4)
    } else {
        None
    };
    if let Some(start) = exponent {
        let first = start + usize::from(is(start, b"+-"));
        if digits(first) > first {
            end = digits(first);
            number.push('e');
            number.push_str(part(start..end));
        }
    }
    let rest = part(end..text.len());
    let second = rest.trim_start_matches([' ', '*', '/', '+', '-']);
    if rest.starts_with(['+', '-']) || rest.contains(" +") || rest.contains(" -") {
        return Err(Fault::new(
            format!("is a sum or a difference: \"{text}\""),
            "write one number and its unit; sums are not evaluated",
        ));
    }
    let per_second = rest.strip_prefix(' ').is_some_and(|r| r.starts_with("1/"));
    if second.starts_with(|c: char| c.is_ascii_digit() || ".,_'".contains(c)) && !per_second {
        return Err(Fault::new(
            format!("contains more than one number: \"{text}\""),
            "write one number without separators, then its unit; products and fractions are not evaluated",
        ));
    }
    Ok((number, rest.trim_start_matches([' ', '*'])))
}

/// The fault of a `unit` that does not measure any of the `kinds`; `units` lists the possible ones.
fn misfit(
    unit: &Unit,
    text: &str,
    kinds: &[&Kind],
    units: impl FnOnce() -> String,
) -> Option<Fault> {
    let found = unit.dimension;
    let kind = kinds.iter().find(|kind| kind.is_measured_by(found));
    if kind.is_some_and(|kind| kind.dimension == TEMPERATURE.dimension) && unit.text.contains('K') {
        let cure = "write a temperature in degrees Celsius, such as \"40 degC\"";
        return Some(Fault::new("is not in degrees Celsius", cure).label("which unit?"));
    }
    if kind.is_some() {
        return None;
    }
    let turns = kinds.iter().any(|k| k.dimension == ANGULAR_SPEED.dimension);
    let help = if found == CUTOFF.dimension && turns {
        "\"Hz\" and \"1/s\" do not say whether they count turns or radians: write \"rpm\" or \"rad/s\" (1 turn per \
         second = 60 rpm = 6.2832 rad/s)"
            .to_owned()
    } else {
        units()
    };
    let names: Vec<&str> = kinds.iter().map(|kind| kind.name).collect();
    let message = format!(
        "must be {}, but \"{}\" is {}",
        names.join(" or "),
        text.trim(),
        describe(found)
    );
    Some(Fault::new(message, help).label(describe(found)))
}

/// `possible units: …`
pub fn possible_units(kinds: &[&Kind]) -> String {
    let units: Vec<&str> = kinds.iter().map(|kind| kind.units).collect();
    format!("possible units: {}", units.join(", "))
}

#[cfg(test)]
mod tests;
