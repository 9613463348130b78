//! The coordinate in which people speak of an axis: that of its `[motion]`, where it is the drive link's but for a factor: millimetres of
//! the carriage instead of degrees of the pulley.

use jred::machine::motion::State;

use crate::model::coordinate::Coordinate;

/// A coordinate that goes with the drive link evenly: position = zero + scale·φ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// Angle or length.
    pub coordinate: Coordinate,
    symbol: &'static str,
    zero: f64,
    scale: f64,
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

    /// A coordinate with this symbol, its value at φ = 0 and what it goes on by per rad or m of the drive link, not zero.
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

    /// The position (rad or m) where the drive link is at φ.
    pub fn position(&self, phi: f64) -> f64 {
        self.zero + self.scale * phi
    }

    /// The drive link's position where this one is `position` (rad or m).
    pub fn drive_position(&self, position: f64) -> f64 {
        (position - self.zero) / self.scale
    }

    /// The size of a speed or an acceleration, from that of the drive link.
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

    /// The position in degrees or millimetres, where the drive link is at φ.
    pub fn shown(&self, phi: f64) -> f64 {
        self.coordinate.shown(self.position(phi))
    }

    /// The same with symbol and unit, such as `x = 250 mm`.
    pub fn place(&self, phi: f64) -> String {
        let shown = (self.shown(phi) * 1e4).round() / 1e4 + 0.0;
        format!("{} = {shown} {}", self.symbol, self.coordinate.unit())
    }
}
