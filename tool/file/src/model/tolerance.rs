//! Tolerances of a machine file's quantities.

use std::ops::Range;

use crate::plain;
use crate::units::literal::{self, Literal};

/// Distribution of deviations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Distribution {
    /// Every value within ± the amount is equally likely.
    Uniform,
    /// The normal distribution; the amount is its standard deviation.
    Normal,
}

impl Distribution {
    /// Its name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Normal => "normal",
        }
    }
}

/// Tolerance of one quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Tolerance {
    /// Path of the quantity.
    pub path: String,
    /// Distribution of deviations.
    pub shape: Distribution,
    /// Size: a share of the quantity, or an amount in a unit of its kind.
    pub amount: Literal,
    /// Position in the machine file; `None`: not from the machine file.
    pub place: Option<Range<usize>>,
}

impl Tolerance {
    /// Reads "±5 %", "5 %", "0.1 mm", "normal 2 %" or "uniform 5 %" for the quantity of a path.
    ///
    /// # Errors
    /// Text for a message.
    pub fn parse(path: &str, text: &str) -> Result<Self, String> {
        let text = text.trim();
        let (shape, amount) = if let Some(rest) = text.strip_prefix("normal") {
            (Distribution::Normal, rest)
        } else {
            (
                Distribution::Uniform,
                text.strip_prefix("uniform").unwrap_or(text),
            )
        };
        Self::of(path, shape, amount)
    }

    /// From a shape and the text of the amount.
    ///
    /// # Errors
    /// Text for a message.
    pub fn of(path: &str, shape: Distribution, text: &str) -> Result<Self, String> {
        let amount = text
            .trim_start_matches([' ', ':'])
            .trim_start_matches(['±', ' ']);
        let amount =
            literal::read(amount).map_err(|why| format!("{} {why}", plain::quoted(text)))?;
        if amount.unit.is_empty() {
            return Err(format!(
                "{} has no unit; write a share, \"5 %\", or an amount with its unit, \"0.1 mm\"",
                plain::quoted(text)
            ));
        }
        if amount.number <= 0.0 {
            return Err(format!("{} must be greater than zero", plain::quoted(text)));
        }
        Ok(Self {
            path: path.to_owned(),
            shape,
            amount,
            place: None,
        })
    }

    /// Shape and amount.
    pub fn shown(&self) -> String {
        match self.shape {
            Distribution::Uniform => format!("uniform ±{}", self.amount.shown()),
            Distribution::Normal => format!("normal, sigma {}", self.amount.shown()),
        }
    }
}
