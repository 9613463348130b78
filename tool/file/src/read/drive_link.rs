//! The drive link for the other readers of the file: whether it turns, swings or slides, and its range.

use std::f64::consts::TAU;

use jred::Domain;
use jred::error::Error;
use jred::machine::Mechanism as _;

use crate::model::coordinate::Coordinate;
use crate::model::mechanism::AnyMechanism;

use crate::number::rounding::figure;
use crate::text::key::{EFFORT, POSITION, SPEED};
use crate::units::RPM;
use crate::units::kind::Kind;

/// Share of a stroke by which a motion may pass its ends: rounding.
const ROUNDING: f64 = 1e-9;

/// Speed (rad/s or m/s) below which a link is at rest: a turn in twenty years.
const STANDSTILL: f64 = 1e-8;

/// Type and range of the drive link's motion, or of another coordinate that is prescribed.
#[derive(Clone, Copy, Debug)]
pub(super) struct DriveLink {
    pub(super) coordinate: Coordinate,
    pub(super) domain: Domain,
}

impl DriveLink {
    pub(super) fn of(mechanism: &AnyMechanism) -> Result<Self, Error> {
        Ok(Self {
            coordinate: Coordinate::of(mechanism)?,
            domain: mechanism.domain(),
        })
    }

    /// Whether it slides.
    pub(super) fn slides(self) -> bool {
        self.coordinate == Coordinate::Length
    }

    /// The kind of its positions.
    pub(super) fn position(self) -> &'static Kind {
        POSITION[usize::from(self.slides())]
    }

    /// The kind of its speeds.
    pub(super) fn speed(self) -> &'static Kind {
        SPEED[usize::from(self.slides())]
    }

    /// A distance (rad or m) with its unit.
    pub(super) fn distance(self, way: f64) -> String {
        format!(
            "{} {}",
            figure(self.coordinate.shown(way)),
            self.coordinate.unit()
        )
    }

    /// A speed (rad/s or m/s) with its unit; rounding is shown as zero.
    pub(super) fn pace(self, speed: f64) -> String {
        let speed = if speed.abs() < STANDSTILL { 0.0 } else { speed };
        match self.coordinate {
            Coordinate::Angle => format!("{} rpm", figure(speed / RPM)),
            Coordinate::Length => format!("{} m/s", figure(speed)),
        }
    }

    /// The kind of its effort.
    pub(super) fn effort(self) -> &'static Kind {
        EFFORT[usize::from(self.slides())]
    }

    /// Default start of a motion: at zero, or at the start of the stroke.
    pub(super) fn start(self) -> f64 {
        match self.domain {
            Domain::Turn => 0.0,
            Domain::Stroke { from, .. } => from,
        }
    }

    /// Whether `position` lies on the stroke; on a turn, always true.
    pub(super) fn reaches(self, position: f64) -> bool {
        self.beyond(position) <= ROUNDING * self.domain.span()
    }

    /// Distance of `position` beyond the stroke.
    pub(super) fn beyond(self, position: f64) -> f64 {
        match self.domain {
            Domain::Turn => 0.0,
            Domain::Stroke { from, to } => (from - position).max(position - to).max(0.0),
        }
    }

    /// The ends of the stroke as text, such as "400 mm to 650 mm".
    pub(super) fn range(self) -> String {
        let shown = |position| {
            let shown = (self.coordinate.shown(position) * 1e4).round() / 1e4 + 0.0;
            format!("{shown} {}", self.coordinate.unit())
        };
        match self.domain {
            Domain::Turn => shown(TAU),
            Domain::Stroke { from, to } => format!("{} to {}", shown(from), shown(to)),
        }
    }
}
