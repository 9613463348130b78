//! The coordinate of an axis for users: that of its `[motion]`, or without a motion that of its stroke, if it is proportional to the drive link's:
//! millimetres of the carriage instead of degrees of the pulley.

use jred::Domain;
use jred::machine::motion::State;

use crate::model::coordinate::Coordinate;
use crate::model::mechanism::AnyMechanism;
use crate::model::motion::{Motion, ToolCoordinate};
use crate::number::columns::{Column, ColumnQuantity};

/// A coordinate that is linear in the drive link's: position = zero + scale·φ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// Angle or length.
    pub coordinate: Coordinate,
    symbol: &'static str,
    zero: f64,
    scale: f64,
}

/// A position of the drive link (rad, or m), and its speed and acceleration there, if given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrivePoint {
    /// Position.
    pub phi: f64,
    /// Speed and acceleration.
    pub state: Option<[f64; 2]>,
}

impl Axis {
    /// The drive link itself.
    pub const fn of_drive(coordinate: Coordinate) -> Self {
        Self {
            coordinate,
            symbol: coordinate.symbol(),
            zero: 0.0,
            scale: 1.0,
        }
    }

    /// The coordinate of a motion, if it is linear in the drive link's; without a motion that of the stroke; otherwise the drive link itself.
    pub fn of(motion: Option<&Motion>, mechanism: &AnyMechanism) -> Self {
        let axis = match motion {
            Some(motion) => motion.tool().and_then(ToolCoordinate::axis),
            None => mechanism.axis,
        };
        axis.unwrap_or_else(|| Self::of_drive(mechanism.coordinate()))
    }

    /// A coordinate with this symbol, its value at φ = 0, and its nonzero change per rad or m of the drive link.
    pub const fn new(
        coordinate: Coordinate,
        symbol: &'static str,
        [zero, scale]: [f64; 2],
    ) -> Self {
        Self {
            coordinate,
            symbol,
            zero,
            scale,
        }
    }

    /// Its symbol.
    pub const fn symbol(&self) -> &'static str {
        self.symbol
    }

    /// The column of positions.
    pub fn column(&self) -> Column {
        let symbol = match self.symbol {
            "φ" => "phi",
            symbol => symbol,
        };
        Column::new(ColumnQuantity::Position, symbol, self.coordinate.unit())
    }

    /// The position (rad or m) at φ of the drive link.
    pub fn position(&self, phi: f64) -> f64 {
        self.zero + self.scale * phi
    }

    /// The drive link's position for this `position` (rad or m).
    pub fn drive_position(&self, position: f64) -> f64 {
        (position - self.zero) / self.scale
    }

    /// The drive link's speed for this `speed`, with its sign.
    pub fn drive_speed(&self, speed: f64) -> f64 {
        speed / self.scale
    }

    /// The ends of the drive link's stroke in this coordinate, the lower first; `None` for a turn.
    pub fn range(&self, domain: Domain) -> Option<[f64; 2]> {
        let Domain::Stroke { from, to } = domain else {
            return None;
        };
        let [a, b] = [from, to].map(|phi| self.position(phi));
        Some([a.min(b), a.max(b)])
    }

    /// The magnitude of a speed or an acceleration, from that of the drive link.
    pub fn rate(&self, drive: f64) -> f64 {
        drive * self.scale.abs()
    }

    /// The size of a speed or an acceleration of the drive link.
    pub fn drive_rate(&self, rate: f64) -> f64 {
        rate / self.scale.abs()
    }

    /// Its state, from that of the drive link.
    pub fn state(&self, drive: &State<f64>) -> State<f64> {
        State {
            phi: self.position(drive.phi),
            omega: drive.omega * self.scale,
            alpha: drive.alpha * self.scale,
        }
    }

    /// The position in degrees or millimetres, at φ of the drive link.
    pub fn shown(&self, phi: f64) -> f64 {
        self.coordinate.shown(self.position(phi))
    }

    /// A signed travel in degrees or millimetres, from that of the drive link.
    pub fn shown_way(&self, way: f64) -> f64 {
        self.coordinate.shown(self.distance(way))
    }

    /// The signed distance (rad or m) from that of the drive link.
    pub fn distance(&self, way: f64) -> f64 {
        self.scale * way
    }

    /// The position with symbol and unit, such as `x = 250 mm`.
    pub fn place(&self, phi: f64) -> String {
        let shown = (self.shown(phi) * 1e4).round() / 1e4 + 0.0;
        format!("{} = {shown} {}", self.symbol, self.coordinate.unit())
    }
}

impl AnyMechanism {
    /// With the coordinate in which its stroke is given.
    #[must_use]
    pub(crate) const fn with_axis(mut self, axis: Axis) -> Self {
        self.axis = Some(axis);
        self
    }
}
