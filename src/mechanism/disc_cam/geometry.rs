//! Position of the follower for a displacement s, and its contact with the cam.
//!
//! Relative to the cam, which turns counter-clockwise, the follower moves around it clockwise. With B the centre of the roller, the velocity of B
//! relative to the cam, for ω = 1, is
//!
//! ```text
//! w = B′ − e_z × B          n = e_z × w/|w|          P = B − r_r·n
//! κ = −(w × a)/|w|³         a = w′ − e_z × w          κ_P = κ/(1 − r_r·κ)
//! ```
//!
//! n is the normal from the cam to the follower, P the point of contact, κ the curvature of the pitch curve (positive where it is convex), κ_P the
//! curvature of the profile. A flat face is the envelope of a line: with ν the direction of its normal in the cam and p its distance from the cam's
//! pivot
//!
//! ```text
//! P = p·n + p_ν·e_z × n     ρ = p + p_νν     p_ν = p′/ν′
//! ```
//!
//! R. L. Norton, *Cam Design and Manufacturing Handbook*, chapter 7; the support function of an envelope: any text on plane differential geometry.

use core::f64::consts::{FRAC_PI_2, PI};

use super::follower::{Follower, distance};
use crate::machine::link::Frame;
use crate::math;
use crate::mechanism::cam::{CamError, Extreme};
use crate::number::transfer::Transfer;

/// Cam and follower in the position s = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Geometry {
    pub(super) follower: Follower,
    pub(super) base_radius: f64,
    /// Height of the roller's centre or of the face at s = 0, or the angle from the line of pivots to the arm or face.
    zero: f64,
}

/// The contact of follower and cam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Touch {
    /// Point of contact, global (m).
    pub(super) point: [f64; 2],
    /// Unit normal from the cam to the follower, global.
    pub(super) normal: [f64; 2],
    /// From the direction in which the follower yields to the normal (rad).
    pub(super) pressure_angle: f64,
    /// Curvature of the profile (1/m), positive where it is convex.
    pub(super) curvature: f64,
    /// Radius of curvature (m): of the pitch curve, which must exceed the roller's radius, or of the profile, which must exceed zero.
    pub(super) radius: f64,
    /// Negative or zero where the cam is undercut.
    pub(super) margin: f64,
    /// Speed of a roller's centre along the pitch curve (m/rad), with two derivatives.
    pub(super) pitch_speed: Transfer,
}

impl Geometry {
    /// Places the follower on the base circle.
    pub(super) fn new(base_radius: f64, follower: Follower) -> Result<Self, CamError> {
        let zero = match follower {
            Follower::TranslatingRoller { offset, roller } => {
                let prime = base_radius + roller.radius();
                let square = (prime - offset) * (prime + offset);
                if square <= 0.0 {
                    let base_radius = math::abs(offset) - roller.radius();
                    return Err(CamError::Offset {
                        offset,
                        base_radius,
                    });
                }
                math::sqrt(square)
            }
            Follower::TranslatingFace { .. } => base_radius,
            Follower::OscillatingRoller {
                pivot, arm, roller, ..
            } => {
                let (prime, d) = (base_radius + roller.radius(), distance(pivot));
                let cos = (d * d + arm * arm - prime * prime) / (2.0 * d * arm);
                if math::abs(cos) >= 1.0 {
                    return Err(CamError::Arm {
                        pivot_distance: d,
                        reach: [math::abs(d - arm), d + arm],
                    });
                }
                math::atan2(math::sqrt((1.0 - cos) * (1.0 + cos)), cos)
            }
            Follower::OscillatingFace { pivot, offset, .. } => {
                let d = distance(pivot);
                let sin = (base_radius + offset) / d;
                if math::abs(sin) >= 1.0 {
                    return Err(CamError::Face {
                        pivot_distance: d,
                        least: math::abs(base_radius + offset),
                    });
                }
                math::asin(sin)
            }
        };
        Ok(Self {
            follower,
            base_radius,
            zero,
        })
    }

    /// Checks the lowest and the highest position of the follower.
    pub(super) fn check_range(&self, [low, high]: [Extreme; 2]) -> Result<(), CamError> {
        let lowest = self.zero + low.value;
        let clear = match self.follower {
            Follower::TranslatingRoller { .. } | Follower::TranslatingFace { .. } => lowest > 0.0,
            Follower::OscillatingRoller {
                pivot, arm, roller, ..
            } => {
                check_swing([low, high], self.zero, [0.0, PI])?;
                let d = distance(pivot);
                let (_, cos) = math::sin_cos(lowest);
                d * d + arm * arm - 2.0 * d * arm * cos > roller.radius() * roller.radius()
            }
            Follower::OscillatingFace { pivot, offset, .. } => {
                check_swing([low, high], self.zero, [-FRAC_PI_2, FRAC_PI_2])?;
                distance(pivot) * math::sin_cos(lowest).0 > offset
            }
        };
        if clear {
            Ok(())
        } else {
            Err(CamError::BelowAxis { phi: low.phi })
        }
    }

    /// The follower's coordinate for the displacement s: the height of a translating one, the angle of the arm or the face of an oscillating one.
    pub(super) fn coordinate(&self, s: Transfer) -> Transfer {
        let Some(([x, y], swing)) = self.follower.pivot() else {
            return s + Transfer::constant(self.zero);
        };
        // From the follower's pivot towards the cam's. 0 − y, because −y of a zero is a negative zero, with the angle −π.
        let towards_cam = math::atan2(0.0 - y, 0.0 - x);
        Transfer::constant(towards_cam) + (s + Transfer::constant(self.zero)) * swing.sign()
    }

    /// The follower's frame. Translating: origin at the roller's centre, or where the guide's axis meets the face, axes parallel to the global ones.
    /// Oscillating: origin at the pivot, u along the arm, or along the face.
    pub(super) fn frame(&self, s: Transfer) -> Frame {
        match self.follower {
            Follower::TranslatingRoller { offset, .. } | Follower::TranslatingFace { offset } => {
                Frame::translating([Transfer::constant(offset), self.coordinate(s)])
            }
            Follower::OscillatingRoller { pivot, .. } | Follower::OscillatingFace { pivot, .. } => {
                Frame::turning(pivot, self.coordinate(s))
            }
        }
    }

    /// The roller's centre in the follower's frame.
    pub(super) const fn roller_at(&self) -> [f64; 2] {
        match self.follower {
            Follower::OscillatingRoller { arm, .. } => [arm, 0.0],
            _ => [0.0, 0.0],
        }
    }

    /// The contact of follower and cam.
    pub(super) fn touch(&self, s: Transfer) -> Touch {
        match self.follower.roller() {
            Some(roller) => self.touch_roller(s, roller.radius()),
            None => self.touch_face(s),
        }
    }

    fn touch_roller(&self, s: Transfer, radius: f64) -> Touch {
        let [x, y] = self.frame(s).point(self.roller_at());
        let w = [x.derivative() + y, y.derivative() - x];
        let speed = (w[0] * w[0] + w[1] * w[1]).sqrt();
        let along = w.map(|c| c.value / speed.value);
        let normal = [-along[1], along[0]];
        let a = [w[0].d1 + w[1].value, w[1].d1 - w[0].value];
        let curvature = (along[1] * a[0] - along[0] * a[1]) / (speed.value * speed.value);
        let centre = [x.value, y.value];
        let margin = 1.0 - radius * curvature;
        Touch {
            point: [
                centre[0] - radius * normal[0],
                centre[1] - radius * normal[1],
            ],
            normal,
            pressure_angle: self.pressure_angle(centre, normal),
            curvature: curvature / margin,
            radius: 1.0 / curvature,
            margin,
            pitch_speed: speed,
        }
    }

    /// Speed of the roller's centre along the pitch curve (m/rad), without derivatives: |w| by the law of cosines.
    pub(super) fn pitch_speed(&self, s: Transfer) -> f64 {
        let (rise, speed) = (self.zero + s.value, s.d1);
        let square = match self.follower {
            Follower::OscillatingRoller {
                pivot, arm, swing, ..
            } => {
                let along = distance(pivot) * math::sin_cos(rise).1;
                let turning = swing.sign() * speed;
                let centre =
                    pivot[0] * pivot[0] + pivot[1] * pivot[1] + arm * arm - 2.0 * arm * along;
                centre + arm * turning * (arm * turning - 2.0 * (arm - along))
            }
            Follower::TranslatingRoller { offset, .. } => {
                rise * rise + (speed - offset) * (speed - offset)
            }
            Follower::TranslatingFace { .. } | Follower::OscillatingFace { .. } => 0.0,
        };
        math::sqrt(square)
    }

    fn touch_face(&self, s: Transfer) -> Touch {
        // Distance from the cam's pivot, rotation of the normal in the cam, and the normal.
        let (p, turning, normal) = match self.follower {
            Follower::OscillatingFace {
                pivot,
                offset,
                swing,
            } => {
                let sign = swing.sign();
                let (sin, _) = (s + Transfer::constant(self.zero)).sin_cos();
                let (sin_psi, cos_psi) = math::sin_cos(self.coordinate(s).value);
                (
                    sin * distance(pivot) - Transfer::constant(offset),
                    s.derivative() * sign - Transfer::constant(1.0),
                    [-sign * sin_psi, sign * cos_psi],
                )
            }
            _ => (
                s + Transfer::constant(self.zero),
                Transfer::constant(-1.0),
                [0.0, 1.0],
            ),
        };
        let p_nu = p.derivative().over(turning);
        let radius = p.value + p_nu.derivative().over(turning).value;
        let point = [
            p.value * normal[0] - p_nu.value * normal[1],
            p.value * normal[1] + p_nu.value * normal[0],
        ];
        Touch {
            point,
            normal,
            pressure_angle: self.pressure_angle(point, normal),
            curvature: 1.0 / radius,
            radius,
            margin: radius / self.base_radius,
            pitch_speed: Transfer::constant(0.0),
        }
    }

    /// Angle from the velocity of the follower's point `at`, when it rises, to the normal, counter-clockwise.
    fn pressure_angle(&self, at: [f64; 2], normal: [f64; 2]) -> f64 {
        let way = match self.follower.pivot() {
            Some((pivot, swing)) => [
                -swing.sign() * (at[1] - pivot[1]),
                swing.sign() * (at[0] - pivot[0]),
            ],
            None => [0.0, 1.0],
        };
        math::atan2(
            way[0] * normal[1] - way[1] * normal[0],
            way[0] * normal[0] + way[1] * normal[1],
        )
    }
}

/// Checks that the angle `zero` + s stays within limits.
fn check_swing([low, high]: [Extreme; 2], zero: f64, limits: [f64; 2]) -> Result<(), CamError> {
    if zero + low.value <= limits[0] {
        return Err(CamError::Swing { phi: low.phi });
    }
    if zero + high.value >= limits[1] {
        return Err(CamError::Swing { phi: high.phi });
    }
    Ok(())
}
