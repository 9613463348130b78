//! Quantities in cells: a number with its unit in the header, a number with its own unit, points of a curve.

use jred_file::number::rounding::figure;
use jred_file::plain;
use jred_file::units::Fault;
use jred_file::units::kind::SHARE;
use jred_file::units::quantity::{no_unit, split_number};
use jred_file::units::unit::tidy;

use super::column::{CellContent, MotorScope, Unit};

/// Content of a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct TableCell<'t> {
    pub(super) text: &'t str,
    /// The unit, if the cell is a number.
    pub(super) unit: Option<&'t Unit>,
    /// The separator of the cells: if it is no comma, the decimal sign may be one.
    pub(super) separator: char,
}

/// Splits "3.2 N m" into number and unit.
pub(super) fn number_and_unit(text: &str, holds: CellContent) -> Result<(String, Unit), Fault> {
    let tidy = tidy(text);
    let kind = holds.kinds().first();
    let (number, unit) =
        split_number(&tidy, kind.unwrap_or(&&SHARE)).map_err(|fault| match kind {
            Some(_) => fault,
            None => Fault::new(fault.message, NUMBER_CURE),
        })?;
    let found = holds.unit(unit).map_err(|fault| match kind {
        Some(kind) if unit.is_empty() => no_unit(&number, kind),
        _ => fault,
    })?;
    Ok((number, found))
}

/// A number with its unit, in SI.
fn quantity(text: &str, holds: CellContent) -> Result<(f64, MotorScope), Fault> {
    let (number, unit) = number_and_unit(text, holds)?;
    match number.parse::<f64>() {
        Ok(value) if unit.measure.si(value).abs() > unit.range[1] => {
            let most = format!(
                "{} {}",
                figure(unit.measure.number(unit.range[1])),
                unit.text
            );
            Err(Fault::new(
                "is too large for any drive",
                format!(
                    "at most {} is accepted: check the number and its unit",
                    most.trim_end()
                ),
            ))
        }
        Ok(value) if value.is_finite() => Ok((unit.measure.si(value), unit.motors)),
        _ => Err(Fault::new("is not a finite number", NUMBER_CURE)),
    }
}

/// Cure for a text that is not a number.
pub(super) const NUMBER_CURE: &str =
    "write a plain number with a decimal point and no separator for thousands";

/// Points "0 rpm: 12 N m; 3000 rpm: 10 N m", in SI.
pub(super) fn points(
    text: &str,
    [x_holds, y_holds]: [CellContent; 2],
    motors: MotorScope,
) -> Result<Vec<[f64; 2]>, Fault> {
    let mut points: Vec<[f64; 2]> = Vec::new();
    for part in text
        .split(';')
        .map(str::trim)
        .filter(|part| !part.is_empty())
    {
        let shown = plain::cut(part);
        let Some((x, y)) = part.split_once(':') else {
            return Err(Fault::new(
                format!("has the point \"{shown}\", which has no colon"),
                "write the points as \"0 rpm: 12 N m; 3000 rpm: 10 N m\"",
            ));
        };
        let of = |fault: Fault, what: &str| {
            let message = format!(
                "has the point \"{shown}\", where \"{}\" {}",
                plain::cut(what.trim()),
                fault.message
            );
            Fault::new(message, fault.help)
        };
        let (x_value, x_for) = quantity(x, x_holds).map_err(|e| of(e, x))?;
        let (y_value, y_for) = quantity(y, y_holds).map_err(|e| of(e, y))?;
        for found in [x_for, y_for] {
            if found != MotorScope::Any && found != motors {
                return Err(Fault::new(
                    format!(
                        "has the point \"{shown}\", whose unit is for a {} motor",
                        words(found)
                    ),
                    "a rotary motor uses rpm and N m, a linear motor m/s and N; see the column \"kind\"",
                ));
            }
        }
        if x_value < 0.0 || y_value < 0.0 {
            return Err(Fault::new(
                format!("has the point \"{shown}\", which is negative"),
                "give the first quadrant only: it applies in both directions",
            ));
        }
        if points.last().is_some_and(|last| x_value <= last[0]) {
            return Err(Fault::new(
                format!("has the point \"{shown}\", which is not above the previous point"),
                "write the points in increasing order, each once",
            ));
        }
        points.push([x_value, y_value]);
    }
    Ok(points)
}

/// "turning" or "sliding".
pub(super) const fn words(motors: MotorScope) -> &'static str {
    match motors {
        MotorScope::Any => "any",
        MotorScope::Rotary => "turning",
        MotorScope::Linear => "sliding",
    }
}
