//! A limit over speed.

use super::LimitError;
use crate::math::Real;

/// Greatest number of points of a [`Curve`].
pub const MAX_POINTS: usize = 8;

/// A torque over speed: straight lines through up to [`MAX_POINTS`] points, constant below the first, zero beyond the last.
///
/// The same in all four quadrants: only magnitudes of speed and torque count.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Curve<R> {
    /// Speed at the upper end of each line, torque there, slope; unused lines repeat the last point.
    lines: [Line<R>; MAX_POINTS],
}

#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct Line<R> {
    end: R,
    torque: R,
    slope: R,
}

impl<R: Real> Curve<R> {
    /// A curve through `points`, each [speed (rad/s), torque (N·m)], speeds rising; one to [`MAX_POINTS`].
    ///
    /// # Errors
    /// No point or too many; a speed or a torque negative or not finite; speeds that do not rise.
    pub fn new(points: &[[R; 2]]) -> Result<Self, LimitError> {
        let zero = R::from_f64(0.0);
        let (Some(first), true) = (points.first(), points.len() <= MAX_POINTS) else {
            return Err(LimitError::Points {
                given: points.len(),
            });
        };
        let mut before: Option<[R; 2]> = None;
        let mut line = Line {
            end: first[0],
            torque: first[1],
            slope: zero,
        };
        let mut lines = [line; MAX_POINTS];
        let mut given = points.iter().enumerate();
        for place in &mut lines {
            if let Some((point, &[speed, torque])) = given.next() {
                for (what, value) in [
                    ("speed of the curve", speed),
                    ("torque of the curve", torque),
                ] {
                    if !value.is_finite() {
                        return Err(LimitError::NotFinite(what));
                    }
                    if value < zero {
                        return Err(LimitError::Negative(what));
                    }
                }
                let slope = match before {
                    None => zero,
                    Some([from, _]) if speed <= from => {
                        return Err(LimitError::NotRising { point });
                    }
                    Some([from, at]) => (torque - at) / (speed - from),
                };
                before = Some([speed, torque]);
                line = Line {
                    end: speed,
                    torque,
                    slope,
                };
            }
            *place = line;
        }
        Ok(Self { lines })
    }

    /// The torque at a `speed` (rad/s), which must not be negative.
    #[inline]
    #[must_use]
    pub fn at(&self, speed: R) -> R {
        for line in &self.lines {
            if speed <= line.end {
                return line.torque + line.slope * (speed - line.end);
            }
        }
        R::from_f64(0.0)
    }
}
