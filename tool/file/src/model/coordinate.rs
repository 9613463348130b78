//! The coordinate of the drive link: an angle φ, or a displacement s of a sliding one; its names and units.

use std::f64::consts::TAU;

use jred::Domain;
use jred::error::Error;
use jred::machine::{Joint, Jointed};

use crate::number::columns::{Column, ColumnQuantity};
use crate::units::Vocabulary;

/// Type of motion of the drive link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinate {
    /// Rotates or swings: φ in rad, torque in N·m.
    Angle,
    /// Slides: s in m, force in N; J_red is a reduced mass.
    Length,
}

impl Coordinate {
    /// The coordinate of a mechanism, from the joint that its drive moves.
    ///
    /// # Errors
    /// The mechanism cannot be placed.
    pub(crate) fn of(mechanism: &impl Jointed) -> Result<Self, Error> {
        let phi = mechanism.domain().position(0.0);
        let joints = mechanism.joints(phi, &mechanism.frames(phi)?)?;
        Ok(match joints.get(mechanism.drive()) {
            Some(Joint::Prismatic(_)) => Self::Length,
            _ => Self::Angle,
        })
    }

    /// The first for an angle, the second for a length.
    pub const fn pick<T: Copy>(self, angle: T, length: T) -> T {
        match self {
            Self::Angle => angle,
            Self::Length => length,
        }
    }

    /// Names and units of efforts and speeds at the drive link. A motor that drives a slide through a screw has its own vocabulary.
    pub const fn vocabulary(self) -> &'static Vocabulary {
        self.pick(&Vocabulary::ROTARY, &Vocabulary::LINEAR)
    }

    /// The column of positions.
    pub fn column(self) -> Column {
        Column::new(ColumnQuantity::Position, self.pick("phi", "s"), self.unit())
    }

    /// Label of the axis of positions.
    pub const fn axis(self) -> &'static str {
        self.pick(
            "angle of the drive link φ [deg]",
            "displacement of the drive link s [mm]",
        )
    }

    /// Symbol of the position.
    pub const fn symbol(self) -> &'static str {
        self.pick("φ", "s")
    }

    /// Unit of a displayed position.
    pub const fn unit(self) -> &'static str {
        self.pick("deg", "mm")
    }

    /// A position (rad or m) for display: in degrees or millimetres.
    pub fn shown(self, position: f64) -> f64 {
        match self {
            Self::Angle => position.to_degrees(),
            Self::Length => position * 1e3,
        }
    }

    /// A position with its symbol and unit, such as `φ = 90 deg`.
    pub fn place(self, position: f64) -> String {
        let shown = (self.shown(position) * 1e4).round() / 1e4 + 0.0;
        format!("{} = {shown} {}", self.symbol(), self.unit())
    }

    /// The columns of speed and acceleration of the drive link.
    pub fn rates(self) -> [Column; 2] {
        let acceleration = self.pick("alpha", "a");
        [
            Column::new(
                ColumnQuantity::DriveSpeed,
                self.pick("omega", "v"),
                self.speed_unit(),
            ),
            Column::new(
                ColumnQuantity::DriveAcceleration,
                acceleration,
                self.pick("rad/s^2", "m/s^2"),
            ),
        ]
    }

    /// The column of the drive's effort.
    pub fn drive_effort(self) -> Column {
        Column {
            part: self.effort().to_owned(),
            ..Column::new(
                ColumnQuantity::DriveEffort,
                format!("{}_drive", self.effort()),
                self.effort_unit(),
            )
        }
    }

    /// Unit of the speed.
    pub const fn speed_unit(self) -> &'static str {
        self.pick("rad/s", "m/s")
    }

    /// Symbol of the drive's effort: torque or force.
    pub const fn effort(self) -> &'static str {
        self.pick("T", "F")
    }

    /// Unit of the drive's effort.
    pub const fn effort_unit(self) -> &'static str {
        self.pick("N m", "N")
    }

    /// Symbol of the reduced inertia.
    pub const fn inertia(self) -> &'static str {
        self.pick("J_red", "m_red")
    }

    /// Unit of the reduced inertia.
    pub const fn inertia_unit(self) -> &'static str {
        self.pick("kg m^2", "kg")
    }

    /// Unit of the position in derivatives.
    pub const fn per(self) -> &'static str {
        self.pick("rad", "m")
    }
}

/// `count` positions over the range: of a turn without its end, which equals its start; of a stroke from end to end.
pub fn positions(domain: Domain, count: usize) -> impl Iterator<Item = f64> {
    let last = match domain {
        Domain::Turn => count,
        Domain::Stroke { .. } => count.saturating_sub(1).max(1),
    };
    (0..count).map(move |k| at(domain, k, last))
}

/// `count` + 1 positions over the range with both its ends, for plots.
pub fn whole_range(domain: Domain, count: usize) -> impl Iterator<Item = f64> {
    (0..=count).map(move |k| at(domain, k, count))
}

fn at(domain: Domain, k: usize, last: usize) -> f64 {
    match domain {
        Domain::Turn => TAU * k as f64 / last as f64,
        Domain::Stroke { .. } => domain.position(k as f64 / last as f64),
    }
}
