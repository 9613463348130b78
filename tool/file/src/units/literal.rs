//! A number with a unit of any kind, for code that changes quantities in a machine file without knowing their meaning.

use super::kind::{Kind, SHARE};
use super::quantity::split_number;
use super::unit;

/// A number and its unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Literal {
    /// The number as written.
    pub number: f64,
    /// The unit in its tidy form; empty for a plain number.
    pub unit: String,
    /// SI value of one such unit.
    pub scale: f64,
    /// Powers of m, kg, s and of the angle.
    pub dimension: [i8; 4],
}

impl Literal {
    /// A plain number.
    pub const fn plain(number: f64) -> Self {
        Self {
            number,
            unit: String::new(),
            scale: 1.0,
            dimension: [0; 4],
        }
    }

    /// Whether both have the same dimension; an angle in the unit is optional ("N m s" for "N m s/rad").
    pub fn is_like(&self, other: &Self) -> bool {
        self.dimension
            .iter()
            .zip(&other.dimension)
            .take(3)
            .all(|(a, b)| a == b)
    }

    /// Number and unit.
    pub fn shown(&self) -> String {
        format!("{} {}", self.number, self.unit)
            .trim_end()
            .to_owned()
    }
}

/// The kind of quantity in messages.
const ANY: Kind = Kind {
    name: "a quantity",
    example: "60 kg",
    ..SHARE
};

/// Reads "1.2e-3 kg m^2", "12 %" or "0.8".
///
/// # Errors
/// A message that follows "\"…\" ".
pub fn read(text: &str) -> Result<Literal, String> {
    let tidy = unit::tidy(text);
    let words = |fault: super::fault::Fault| format!("{}; {}", fault.message, fault.help);
    let (number, rest) = split_number(&tidy, &ANY).map_err(words)?;
    let number = number
        .parse::<f64>()
        .ok()
        .filter(|n| n.is_finite())
        .ok_or("is not a finite number")?;
    if rest.is_empty() {
        return Ok(Literal::plain(number));
    }
    let unit = unit::read(rest).map_err(words)?;
    // Its number is not proportional to the temperature, so ranges and factors would be wrong.
    if unit.zero != 0.0 {
        return Err(format!("is in {}; write it in degC", unit.text));
    }
    let dimension = unit.dimension;
    Ok(Literal {
        number,
        scale: unit.scale,
        dimension: [
            dimension.length,
            dimension.mass,
            dimension.time,
            dimension.angle,
        ],
        unit: unit.text,
    })
}

#[cfg(test)]
mod tests {
    use super::read;

    #[test]
    fn number_and_unit_come_apart() {
        let literal = read("-1.2e-3 kg·m²").unwrap();
        assert_eq!((literal.number, literal.unit.as_str()), (-1.2e-3, "kg*m^2"));
        assert_eq!(literal.dimension, [2, 1, 0, 0]);
        let share = read("97 %").unwrap();
        assert_eq!(
            (share.number, share.unit.as_str(), share.scale),
            (97.0, "%", 0.01)
        );
        assert_eq!(read("0.8").unwrap().unit, "");
    }

    #[test]
    fn what_is_no_quantity_is_refused() {
        for text in [
            "",
            "crank",
            "polynomial-345",
            "5 apples",
            "1,5 kg",
            "ground.P",
            "nan kg",
        ] {
            assert!(read(text).is_err(), "{text}");
        }
    }
}
