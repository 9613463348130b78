//! Normalised motion laws for a rise from 0 to 1 in the time 0 to 1 (VDI 2143 Blatt 1).

use crate::Error;
use crate::math::Real;

/// A motion law between two dwells: S(z) with S(0) = 0, S(1) = 1 and zero speed at both ends.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Law {
    /// Constant acceleration, constant speed, constant deceleration. The fields are the shares of the time spent
    /// accelerating and decelerating, in (0, 1] and together at most 1. Largest speed 1/(1 − (a + d)/2).
    /// The acceleration jumps at the breaks (its value there is the one after the break).
    Trapezoid {
        /// Share of the time spent accelerating.
        accelerate: f32,
        /// Share of the time spent decelerating.
        decelerate: f32,
    },
    /// 10z³ − 15z⁴ + 6z⁵: largest speed 1.875, largest acceleration 5.774. No sine: the law for small processors.
    #[default]
    Polynomial345,
    /// z − sin(2πz)/2π (inclined sine, Bestehorn): largest speed 2, largest acceleration 2π.
    Cycloidal,
    /// Modified sine: largest speed 4π/(4 + π) = 1.760, largest acceleration 4π²/(4 + π) = 5.528.
    ModifiedSine,
}

impl Law {
    /// Checks the shares of a trapezoid.
    ///
    /// # Errors
    /// A share outside (0, 1], or the two together above 1.
    #[inline] // so that a law without shares brings no double precision into single-precision firmware
    pub fn check(self) -> Result<(), Error> {
        let Self::Trapezoid {
            accelerate,
            decelerate,
        } = self
        else {
            return Ok(());
        };
        for (what, share) in [("accelerate", accelerate), ("decelerate", decelerate)] {
            crate::error::positive(what, f64::from(share))?;
        }
        let sum = f64::from(accelerate) + f64::from(decelerate);
        if sum > 1.0 + 1e-6 {
            return Err(Error::OutOfRange {
                what: "accelerate + decelerate",
                value: sum,
                min: 0.0,
                max: 1.0,
            });
        }
        Ok(())
    }

    /// The places in (0, 1) where a derivative of the law jumps.
    #[must_use]
    pub fn breaks(self) -> [Option<f64>; 2] {
        match self {
            Self::Trapezoid {
                accelerate,
                decelerate,
            } => [
                Some(f64::from(accelerate)),
                Some(1.0 - f64::from(decelerate)),
            ],
            Self::ModifiedSine => [Some(0.125), Some(0.875)],
            Self::Polynomial345 | Self::Cycloidal => [None, None],
        }
    }

    /// [S, S′, S″] at the time `z`; before 0 and after 1 the ends, at rest.
    #[must_use]
    pub fn at<R: Real>(self, z: R) -> [R; 3] {
        let c = R::from_f64;
        if z < c(0.0) {
            return [c(0.0); 3];
        }
        if z > c(1.0) {
            return [c(1.0), c(0.0), c(0.0)];
        }
        match self {
            Self::Trapezoid {
                accelerate,
                decelerate,
            } => trapezoid(z, c(f64::from(accelerate)), c(f64::from(decelerate))),
            Self::Polynomial345 => [
                z * z * z * (c(10.0) + z * (c(6.0) * z - c(15.0))),
                c(30.0) * z * z * (z - c(1.0)) * (z - c(1.0)),
                c(60.0) * z * (c(2.0) * z - c(1.0)) * (z - c(1.0)),
            ],
            Self::Cycloidal => {
                const TAU: f64 = core::f64::consts::TAU;
                let (sin, cos) = (c(TAU) * z).sin_cos();
                [z - sin / c(TAU), c(1.0) - cos, c(TAU) * sin]
            }
            Self::ModifiedSine => modified_sine(z),
        }
    }
}

fn trapezoid<R: Real>(z: R, accelerate: R, decelerate: R) -> [R; 3] {
    let c = R::from_f64;
    let speed = c(1.0) / (c(1.0) - (accelerate + decelerate) / c(2.0));
    let left = c(1.0) - z;
    if z < accelerate {
        let a = speed / accelerate;
        [a * z * z / c(2.0), a * z, a]
    } else if left > decelerate {
        [speed * (z - accelerate / c(2.0)), speed, c(0.0)]
    } else {
        let a = speed / decelerate;
        [c(1.0) - a * left * left / c(2.0), a * left, -a]
    }
}

/// Three sine arcs: quarter-period arcs at the ends, a three times slower one between (z = 1/8 to 7/8).
fn modified_sine<R: Real>(z: R) -> [R; 3] {
    use core::f64::consts::PI;
    let c = R::from_f64;
    let (share, quarter) = (1.0 / (4.0 + PI), 0.125);
    let end_arc = !(z > c(quarter) && z < c(1.0 - quarter));
    if end_arc {
        let (sin, cos) = (c(4.0 * PI) * z).sin_cos();
        let before = if z > c(0.5) { 4.0 } else { 0.0 };
        [
            c(share) * (c(before) + c(PI) * z - c(0.25) * sin),
            c(share * PI) * (c(1.0) - cos),
            c(share * 4.0 * PI * PI) * sin,
        ]
    } else {
        let (sin, cos) = (c(PI / 3.0) * (c(4.0) * z + c(1.0))).sin_cos();
        [
            c(share) * (c(2.0) + c(PI) * z - c(2.25) * sin),
            c(share * PI) * (c(1.0) - c(3.0) * cos),
            c(share * 4.0 * PI * PI) * sin,
        ]
    }
}
