//! A quantity of the machine file with its place, and the check of its limits.

use std::ops::Range;

use super::key::ValueRange;
use super::problem::{Problem, Result};
use crate::units::kind::Kind;
use crate::units::quantity::Quantity;

/// A quantity in SI with its place in the file.
pub(crate) struct Value {
    /// The value in SI.
    pub(crate) si: f64,
    pub(super) quantity: Quantity,
    /// Its kind.
    pub(crate) kind: &'static Kind,
    pub(super) name: String,
    pub(super) span: Range<usize>,
}

impl Value {
    /// A problem with this quantity.
    pub(crate) fn problem(&self, what: &str, label: &str) -> Problem {
        Problem::new(format!("{} {what}", self.name)).at(self.span.clone(), label)
    }

    /// The place of the value.
    pub(crate) fn span(&self) -> Range<usize> {
        self.span.clone()
    }

    /// The value in the file's unit, with a shortened number.
    pub(crate) fn shown(&self) -> String {
        self.show(self.si)
    }

    /// Another SI value in the unit of this one.
    pub(crate) fn show(&self, si: f64) -> String {
        self.quantity.in_its_unit(si).trim_end().to_owned()
    }

    /// Checks that the value is within limits.
    pub(crate) fn check(&self, limit: ValueRange) -> Result<()> {
        match limit {
            ValueRange::Any => Ok(()),
            ValueRange::Positive => self.check_positive(),
            ValueRange::NotNegative => self.check_not_negative(),
            ValueRange::UpTo(most) => self.check_positive().and_then(|()| self.check_most(most)),
            ValueRange::Within(most) => self
                .check_not_negative()
                .and_then(|()| self.check_most(most)),
            ValueRange::Between(least, most) => self.check_between([least, most]),
        }
    }

    fn check_not_negative(&self) -> Result<()> {
        if self.si >= 0.0 {
            return Ok(());
        }
        let what = format!("is {}, but must not be negative", self.shown());
        Err(self
            .problem(&what, "negative")
            .help(format!("write {} of zero or more", self.kind.name)))
    }

    /// Checks that the value is greater than zero.
    pub(crate) fn check_positive(&self) -> Result<()> {
        if self.si >= self.kind.smallest {
            return Ok(());
        }
        let what = if self.si > 0.0 {
            format!("is {}, too small for any machine", self.shown())
        } else {
            format!("is {}, but must be greater than zero", self.shown())
        };
        Err(self.problem(&what, "too small").help(format!(
            "write {} such as \"{}\"",
            self.kind.name, self.kind.example
        )))
    }

    /// The value if it is greater than zero.
    pub(crate) fn positive(self) -> Result<f64> {
        self.check_positive().map(|()| self.si)
    }

    fn check_most(&self, max: f64) -> Result<()> {
        if self.si <= max {
            return Ok(());
        }
        let (max, shown) = (self.show(max), self.shown());
        let what = format!("is {shown}, but must not be greater than {max}");
        let help = if self.kind.unit == "%" && self.quantity.unit.text.is_empty() {
            format!("the plain number 1 means 100 %; write \"{shown} %\"")
        } else {
            format!("write {} of {max} or less", self.kind.name)
        };
        Err(self.problem(&what, "too large").help(help))
    }

    fn check_between(&self, [least, most]: [f64; 2]) -> Result<()> {
        if (least..=most).contains(&self.si) {
            return Ok(());
        }
        let ends = [least, most].map(|end| self.show(end));
        let what = format!(
            "is {}, but must be between {} and {}",
            self.shown(),
            ends[0],
            ends[1]
        );
        Err(self.problem(&what, "out of range").help("check the number"))
    }
}
