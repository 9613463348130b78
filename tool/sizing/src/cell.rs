//! A cell of a row: a number, or words.

use serde_json::Value;

/// An infinite number in JSON, which has no form for it.
const INFINITE: &str = "inf";

/// A cell of a row.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Empty.
    Empty,
    /// A number, written with every digit; an infinite one as `inf`.
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
            Self::Number(x) if x.is_infinite() => INFINITE.into(),
            Self::Number(x) => (*x).into(),
            Self::Text(text) => text.as_str().into(),
        }
    }

    /// The cell of a value that [`Cell::json`] wrote; `None` for any other value.
    pub fn of_json(value: &Value) -> Option<Self> {
        match value {
            Value::Null => Some(Self::Empty),
            Value::String(text) if text == INFINITE => Some(Self::Number(f64::INFINITY)),
            Value::String(text) => Some(Self::Text(text.clone())),
            value => value.as_f64().map(Self::Number),
        }
    }

    /// The words, if it is a text.
    pub const fn text(&self) -> Option<&str> {
        match self {
            Self::Text(text) => Some(text.as_str()),
            _ => None,
        }
    }
}

impl From<Option<f64>> for Cell {
    /// A number that is not finite gives an empty cell.
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
