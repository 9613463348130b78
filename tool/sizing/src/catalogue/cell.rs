//! Quantities in cells: a number with its unit in the header, a number with its own unit, points of a curve.

use jred_machine::units::{Fault, did_you_mean};

use super::column::{For, Unit};

/// Content of a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell<'t> {
    pub(super) text: &'t str,
    /// The unit, if the cell is a number.
    pub(super) unit: Option<&'static Unit>,
}

/// Finds the unit `text`, whatever its product signs, blanks and notation of powers.
pub(super) fn find_unit(text: &str, units: &'static [Unit]) -> Option<&'static Unit> {
    let same = |unit: &&Unit| unit.text == text;
    let alike = |unit: &&Unit| folded(unit.text).eq(folded(text));
    units.iter().find(same).or_else(|| units.iter().find(alike))
}

fn folded(text: &str) -> impl Iterator<Item = char> {
    text.chars().filter_map(|c| match c {
        ' ' | '\u{a0}' | '·' | '⋅' | '*' | '^' => None,
        '²' => Some('2'),
        'µ' | 'μ' => Some('u'),
        '\u{2126}' => Some('Ω'),
        c => Some(c),
    })
}

/// The fault of the unit `text`, with the accepted units as its cure, the most similar first.
pub(super) fn unit_cure(text: &str, units: &[Unit]) -> String {
    let names: Vec<&str> = units
        .iter()
        .map(|u| u.text)
        .filter(|t| !t.is_empty())
        .collect();
    let near = did_you_mean(text, &names);
    format!("{near}possible units: {}", names.join(", "))
}

/// Splits "3.2 N m" into its number and its unit.
pub(super) fn split(text: &str) -> (&str, &str) {
    let bytes = text.as_bytes();
    let digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
    let mut end = 0;
    while let Some(byte) = bytes.get(end) {
        let exponent = matches!(byte, b'e' | b'E')
            && end > 0
            && (digit(end + 1)
                || matches!(bytes.get(end + 1), Some(b'+' | b'-')) && digit(end + 2));
        let sign = matches!(byte, b'+' | b'-')
            && (end == 0 || matches!(bytes.get(end - 1), Some(b'e' | b'E')));
        if !(byte.is_ascii_digit() || matches!(byte, b'.' | b',') || exponent || sign) {
            break;
        }
        end += 1;
    }
    let (number, unit) = text.split_at_checked(end).unwrap_or((text, ""));
    (number, unit.trim())
}

/// A number with its unit, in SI.
pub(super) fn quantity(text: &str, units: &'static [Unit]) -> Result<(f64, For), Fault> {
    let (number, word) = split(text.trim());
    let Some(unit) = find_unit(word, units) else {
        let message = if word.is_empty() {
            "has no unit".to_owned()
        } else {
            format!("has the unit \"{word}\"")
        };
        return Err(Fault::new(message, unit_cure(word, units)));
    };
    match number.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok((value * unit.si, unit.motors)),
        _ => Err(Fault::new("is not a number", NUMBER_CURE)),
    }
}

/// Cure for a text that is not a number.
pub(super) const NUMBER_CURE: &str =
    "write a plain number with a decimal point and no separator for thousands";

/// Points "0 rpm: 12 N m; 3000 rpm: 10 N m", in SI.
pub(super) fn points(
    text: &str,
    [x_units, y_units]: [&'static [Unit]; 2],
    motors: For,
) -> Result<Vec<[f64; 2]>, Fault> {
    let mut points: Vec<[f64; 2]> = Vec::new();
    for part in text
        .split(';')
        .map(str::trim)
        .filter(|part| !part.is_empty())
    {
        let Some((x, y)) = part.split_once(':') else {
            return Err(Fault::new(
                format!("has the point \"{part}\", which has no colon"),
                "write the points as \"0 rpm: 12 N m; 3000 rpm: 10 N m\"",
            ));
        };
        let of = |fault: Fault, what: &str| {
            let message = format!(
                "has the point \"{part}\", where \"{}\" {}",
                what.trim(),
                fault.message
            );
            Fault::new(message, fault.help)
        };
        let (x_value, x_for) = quantity(x, x_units).map_err(|e| of(e, x))?;
        let (y_value, y_for) = quantity(y, y_units).map_err(|e| of(e, y))?;
        for found in [x_for, y_for] {
            if found != For::Any && found != motors {
                return Err(Fault::new(
                    format!(
                        "has the point \"{part}\", whose unit is for a {} motor",
                        words(found)
                    ),
                    "a rotary motor uses rpm and N m, a linear motor m/s and N; see the column \"kind\"",
                ));
            }
        }
        if x_value < 0.0 || y_value < 0.0 {
            return Err(Fault::new(
                format!("has the point \"{part}\", which is negative"),
                "give the first quadrant only: it applies in both directions",
            ));
        }
        if points.last().is_some_and(|last| x_value <= last[0]) {
            return Err(Fault::new(
                format!(
                    "has the point \"{part}\", whose speed is not above that of the previous point"
                ),
                "write the points in order of increasing speed, each once",
            ));
        }
        points.push([x_value, y_value]);
    }
    Ok(points)
}

/// "turning" or "sliding".
pub(super) const fn words(motors: For) -> &'static str {
    match motors {
        For::Any => "any",
        For::Rotary => "turning",
        For::Linear => "sliding",
    }
}
