//! A cell of a row: a number, or words.

use serde_json::Value;

/// A cell of a row.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Empty.
    Empty,
    /// A number, written with every digit.
    Number(f64),
    /// Words.
    Text(String),
}

impl Cell {
    /// The number, if it is one.
    pub const fn number(&self) -> Option<f64> {
        match self {
            Self::Number(x) => Some(*x),
            _ => None,
        }
    }

    /// As a value of JSON.
    pub fn json(&self) -> Value {
        match self {
            Self::Empty => Value::Null,
            Self::Number(x) => (*x).into(),
            Self::Text(text) => text.as_str().into(),
        }
    }

    /// The words, if it has any.
    pub const fn text(&self) -> Option<&str> {
        match self {
            Self::Text(text) => Some(text.as_str()),
            _ => None,
        }
    }
}

impl From<Option<f64>> for Cell {
    /// A number that is not finite is written as null.
    fn from(x: Option<f64>) -> Self {
        x.filter(|x| x.is_finite())
            .map_or(Self::Empty, |x| Self::Number(x + 0.0))
    }
}

impl From<f64> for Cell {
    fn from(x: f64) -> Self {
        Some(x).into()
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}
