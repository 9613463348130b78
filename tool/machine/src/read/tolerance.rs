//! `[tolerance]`: how far quantities of the file may lie from what it says.

use crate::text::problem::Result;
use crate::text::section::Section;
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

/// How far one quantity may lie from what the file says.
#[derive(Clone, Debug, PartialEq)]
pub struct Tolerance {
    /// Path of the quantity.
    pub path: String,
    /// How deviations are distributed.
    pub shape: Shape,
    /// By how much: a share of the quantity, or an amount in a unit like its own.
    pub amount: Literal,
}

impl Tolerance {
    /// Reads "±5 %", "5 %", "0.1 mm", "normal 2 %" or "uniform 5 %" for the quantity of a path.
    ///
    /// # Errors
    /// In words for a message.
    pub fn parse(path: &str, text: &str) -> std::result::Result<Self, String> {
        let text = text.trim();
        let (shape, amount) = if let Some(rest) = text.strip_prefix("normal") {
            (Shape::Normal, rest)
        } else {
            (Shape::Uniform, text.strip_prefix("uniform").unwrap_or(text))
        };
        Self::of(path, shape, amount)
    }

    fn of(path: &str, shape: Shape, text: &str) -> std::result::Result<Self, String> {
        let amount = text
            .trim_start_matches([' ', ':'])
            .trim_start_matches(['±', ' ']);
        let amount = literal::read(amount).map_err(|why| format!("{text:?} {why}"))?;
        if amount.unit.is_empty() {
            return Err(format!(
                "{text:?} has no unit; write a share, \"5 %\", or an amount with its unit, \"0.1 mm\""
            ));
        }
        if amount.number <= 0.0 {
            return Err(format!("{text:?} must be greater than zero"));
        }
        Ok(Self {
            path: path.to_owned(),
            shape,
            amount,
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

/// The tolerances, in the order of the text.
pub(super) fn read(root: &Section) -> Result<Vec<Tolerance>> {
    const EXAMPLE: &str =
        "write \"±5 %\", \"0.1 mm\", or { normal = \"2 %\" } for a standard deviation";
    let Some(item) = root.get("tolerance") else {
        return Ok(Vec::new());
    };
    let section = item.section("[tolerance]".into())?;
    let mut tolerances = Vec::new();
    for (path, item) in section.entries() {
        let found = if item.is_table() {
            let table = item.section(format!("[tolerance.\"{path}\"]"))?;
            let [normal, uniform] = ["normal", "uniform"].map(|key| table.get(key));
            table.finish()?;
            let (shape, item) = match (normal, uniform) {
                (Some(item), None) => (Shape::Normal, item),
                (None, Some(item)) => (Shape::Uniform, item),
                _ => {
                    return Err(table
                        .problem(
                            format!("{} must have one of `normal` and `uniform`", table.title()),
                            "here",
                        )
                        .help(EXAMPLE));
                }
            };
            Tolerance::of(path, shape, item.text("2 %")?)
        } else {
            Tolerance::parse(path, item.text("±5 %")?)
        };
        tolerances.push(found.map_err(|why| {
            item.problem(&format!("is wrong: {why}"), "here")
                .help(EXAMPLE)
        })?);
    }
    Ok(tolerances)
}
