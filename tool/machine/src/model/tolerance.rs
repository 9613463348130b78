//! How far quantities of a machine file may lie from what it says.

use std::ops::Range;

use crate::plain;
use crate::units::literal::{self, Literal};

/// How deviations are distributed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Every value within ± the amount is as likely as any other.
    Uniform,
    /// The normal distribution; the amount is its standard deviation.
    Normal,
}

impl Shape {
    /// Its name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Normal => "normal",
        }
    }
}

/// How far one quantity may deviate from its value in the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Tolerance {
    /// Path of the quantity.
    pub path: String,
    /// How deviations are distributed.
    pub shape: Shape,
    /// By how much: a share of the quantity, or an amount in a unit like its own.
    pub amount: Literal,
    /// Where the machine file gives it; `None`: it does not.
    pub place: Option<Range<usize>>,
}

impl Tolerance {
    /// Reads "±5 %", "5 %", "0.1 mm", "normal 2 %" or "uniform 5 %" for the quantity of a path.
    ///
    /// # Errors
    /// In words for a message.
    pub fn parse(path: &str, text: &str) -> Result<Self, String> {
        let text = text.trim();
        let (shape, amount) = if let Some(rest) = text.strip_prefix("normal") {
            (Shape::Normal, rest)
        } else {
            (Shape::Uniform, text.strip_prefix("uniform").unwrap_or(text))
        };
        Self::of(path, shape, amount)
    }

    /// From a shape and the text of the amount.
    ///
    /// # Errors
    /// In words for a message.
    pub fn of(path: &str, shape: Shape, text: &str) -> Result<Self, String> {
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
            Shape::Uniform => format!("uniform ±{}", self.amount.shown()),
            Shape::Normal => format!("normal, sigma {}", self.amount.shown()),
        }
    }
}
