//! Errors of a plan.

use core::fmt;

use super::super::AxisError;
use crate::number::error::{Curable, error};
use crate::tick::ImageError;

/// Why a plan is refused, or not written. Rows count from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum PlanError {
    /// Length, version, CRC, a header field or the machine, as for a table image.
    Image(ImageError),
    /// The first word is not "JRPL".
    NotAPlan(u32),
    /// Made for another range of the drive link than the model.
    Range,
    /// The row does not begin after the one before, or, as the first, not at 0.
    Order(u32),
    /// A number of the row is not finite, or out of range.
    Number(u32),
    /// The row does not end with the position and speed of the next row's start.
    Gap(u32),
    /// The row leaves the stroke between its ends.
    Stroke(u32),
    /// The end has another position or speed than the start: the plan cannot be repeated.
    Open,
    /// A figure outside the plan.
    Axis(AxisError),
}

impl fmt::Display for PlanError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Image(error) => error.fmt(f),
            Self::NotAPlan(word) => write!(
                f,
                "not a plan: it starts with {word:#010x} instead of \"JRPL\""
            ),
            Self::Range => {
                f.write_str("the plan was made for another range of the drive link than the model")
            }
            Self::Order(row) => write!(
                f,
                "row {row} of the plan does not begin after the one before it"
            ),
            Self::Number(row) => {
                write!(f, "row {row} of the plan has a number that does not fit")
            }
            Self::Gap(row) => write!(
                f,
                "row {row} of the plan does not end where the next begins"
            ),
            Self::Stroke(row) => write!(
                f,
                "row {row} of the plan leaves the stroke between its ends"
            ),
            Self::Open => {
                f.write_str("the plan does not end as it begins, so it cannot be repeated")
            }
            Self::Axis(error) => error.fmt(f),
        }
    }
}

error!(PlanError, Image(ImageError), Axis(AxisError));

impl Curable for PlanError {
    fn write_cure(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Image(error) => error.write_cure(f),
            Self::NotAPlan(_) => {
                f.write_str("give what jred fastest or jred gentlest wrote with --plan")
            }
            Self::Range => f.write_str("make table and plan of the same machine file"),
            Self::Order(_) => f.write_str("give rows at least 2⁻⁴⁰ s and a 2³⁰th of the plan apart"),
            Self::Number(_) => f.write_str(
                "give finite numbers, rows of less than 8 million turns, and the position within the stroke",
            ),
            Self::Gap(_) => f.write_str("write the plan again"),
            Self::Stroke(_) => {
                f.write_str("give the motion with more knots where it turns near an end of the stroke")
            }
            Self::Open => f.write_str(
                "give a plan whose end is its start, whole turns on, with the same speed, or follow it once",
            ),
            Self::Axis(error) => error.write_cure(f),
        }
    }
}
