//! Positions and speeds of a simulation: of the axis, or of the drive link if the unit says so.

use jred::Domain;

use super::SimulationContext;
use crate::model::axis::Axis;
use crate::model::coordinate::Coordinate;
use crate::number::rounding::figure;
use crate::read::drive_link::DriveLink;
use crate::text::item::Item;
use crate::text::problem::Result;
use crate::text::value::Value;

/// The axis of a machine and its drive link.
#[derive(Clone, Copy)]
pub(super) struct AxisReader {
    drive: DriveLink,
    axis: Axis,
}

/// A given value, and its equivalent at the drive link.
pub(super) struct AxisValue {
    pub(super) value: Value,
    /// At the drive link.
    pub(super) drive: f64,
    /// Whether it was given for the axis.
    of_axis: bool,
}

impl AxisReader {
    pub(super) fn of(around: SimulationContext) -> Self {
        Self {
            drive: around.drive,
            axis: around.axis,
        }
    }

    /// The drive link with the coordinate of the axis, for the kinds of its quantities.
    fn spoken(&self) -> DriveLink {
        DriveLink {
            coordinate: self.axis.coordinate,
            ..self.drive
        }
    }

    /// Whether the axis has a coordinate other than the drive link's.
    pub(super) fn has_axis(&self) -> bool {
        self.axis != Axis::of_drive(self.drive.coordinate)
    }

    /// Whether `start_position` has a meaning: the axis has a coordinate of its own, or the drive link slides.
    pub(super) fn has_positions(&self) -> bool {
        self.drive.slides() || self.has_axis()
    }

    /// Whether the coordinate of the axis is a length.
    pub(super) fn is_length(&self) -> bool {
        self.axis.coordinate == Coordinate::Length
    }

    /// A position of the axis, or of the drive link if the unit says so.
    pub(super) fn position(&self, item: &Item) -> Result<AxisValue> {
        let spoken = item.quantity(self.spoken().position());
        self.either(
            spoken,
            || item.quantity(self.drive.position()),
            |si| self.axis.drive_position(si),
        )
    }

    /// A position of the drive link.
    pub(super) fn drive_position(&self, item: &Item) -> Result<AxisValue> {
        let value = item.quantity(self.drive.position())?;
        Ok(AxisValue {
            drive: value.si,
            value,
            of_axis: false,
        })
    }

    /// A speed of the axis, or of the drive link if the unit says so.
    pub(super) fn speed(&self, item: &Item) -> Result<AxisValue> {
        let spoken = item.quantity(self.spoken().speed());
        self.either(
            spoken,
            || item.quantity(self.drive.speed()),
            |si| self.axis.drive_speed(si),
        )
    }

    /// A quantity of the axis; if it cannot be read as one and the drive link has other units, a quantity of the drive link.
    fn either(
        &self,
        spoken: Result<Value>,
        drive: impl Fn() -> Result<Value>,
        at_drive: impl Fn(f64) -> f64,
    ) -> Result<AxisValue> {
        let other = self.axis.coordinate != self.drive.coordinate;
        match spoken {
            Err(_) if other && drive().is_ok() => {
                let value = drive()?;
                Ok(AxisValue {
                    drive: value.si,
                    value,
                    of_axis: false,
                })
            }
            spoken => {
                let value = spoken?;
                Ok(AxisValue {
                    drive: at_drive(value.si),
                    value,
                    of_axis: true,
                })
            }
        }
    }

    /// Refuses a position outside the stroke; a position beyond an end by rounding is the end.
    pub(super) fn reached(&self, given: &AxisValue, label: &str, cure: &str) -> Result<f64> {
        if !self.drive.reaches(given.drive) {
            let range = match self.axis.range(self.drive.domain) {
                Some([from, to]) if given.of_axis => {
                    let shown = |si: f64| figure(self.axis.coordinate.shown(si));
                    let unit = self.axis.coordinate.unit();
                    format!("{} {unit} to {} {unit}", shown(from), shown(to))
                }
                _ => self.drive.range(),
            };
            let what = format!("is {}, outside the stroke, {range}", given.value.shown());
            return Err(given.value.problem(&what, label).help(cure.to_owned()));
        }
        Ok(match self.drive.domain {
            Domain::Stroke { from, to } if given.of_axis => given.drive.clamp(from, to),
            _ => given.drive,
        })
    }
}
