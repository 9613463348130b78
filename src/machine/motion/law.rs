//! Normalised motion laws for a rise from 0 to 1 in the time 0 to 1 (VDI 2143 Blatt 1, *Bewegungsgesetze für
//! Kurvengetriebe*, 1980; R. L. Norton, *Cam Design and Manufacturing Handbook*, chapter 3).

use super::sine_constant_cosine as scca;
use crate::math::Real;
use crate::number::error::RangeError;

/// A motion law between two dwells: S(z) with S(0) = 0, S(1) = 1 and zero speed at both ends.
///
/// `R` is the number type of the evaluation; [`cast`](Self::cast) converts between them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Law<R = f64> {
    /// Constant acceleration, constant speed, constant deceleration. The fields are the shares of the time for acceleration and deceleration, in (0,
    /// 1] and together at most 1. Largest speed 1/(1 − (a + d)/2). The acceleration jumps at [`breaks`](Self::breaks), where it has the value after
    /// the break.
    Trapezoid {
        /// Share of the time spent accelerating.
        accelerate: R,
        /// Share of the time spent decelerating.
        decelerate: R,
    },
    /// 10z³ − 15z⁴ + 6z⁵: largest speed 1.875, largest acceleration 5.774. Without a sine: the law for small processors.
    #[default]
    Polynomial345,
    /// z − sin(2πz)/2π (inclined sine, Bestehorn): largest speed 2, largest acceleration 2π.
    Cycloidal,
    /// Modified sine: largest speed 4π/(4 + π) = 1.760, largest acceleration 4π²/(4 + π) = 5.528.
    ModifiedSine,
    /// ½·(1 − cos πz) (simple sine, simple harmonic motion): largest speed π/2, largest acceleration π²/2. The acceleration jumps at both ends: use
    /// it between reversals, not between dwells.
    SimpleSine,
    /// 35z⁴ − 84z⁵ + 70z⁶ − 20z⁷: largest speed 2.1875, largest acceleration 84/(5·√5) = 7.513; the jerk is continuous.
    Polynomial4567,
    /// Modified trapezoid of the acceleration: largest speed 2, largest acceleration 8π/(2 + π) = 4.888, the smallest of all laws without a jump of
    /// the acceleration.
    ModifiedTrapezoid,
    /// z − 15/(32π)·sin 2πz − 1/(96π)·sin 6πz (Gutman, first and third harmonic): largest speed 2, largest acceleration 2π·√(2/3) = 5.130; it excites
    /// only two frequencies.
    Gutman,
    /// Sine, constant and cosine acceleration (SCCA): shares of the time, both halves together, in which the acceleration rises by a quarter of a
    /// sine, is constant, and falls by a quarter of a cosine. In the rest, around the middle, the speed is constant. Each in [0, 1], together 0.01
    /// to 1. Without a sine or without a cosine the acceleration jumps.
    SineConstantCosine {
        /// Share of the sine.
        sine: R,
        /// Share of constant acceleration.
        constant: R,
        /// Share of the cosine.
        cosine: R,
    },
}

impl<R: Real> Law<R> {
    /// The same law in another number type; the shares of a trapezoid are rounded to it.
    #[must_use]
    pub fn cast<S: Real>(self) -> Law<S> {
        match self {
            Self::Trapezoid {
                accelerate,
                decelerate,
            } => Law::Trapezoid {
                accelerate: S::from_f64(accelerate.to_f64()),
                decelerate: S::from_f64(decelerate.to_f64()),
            },
            Self::Polynomial345 => Law::Polynomial345,
            Self::Cycloidal => Law::Cycloidal,
            Self::ModifiedSine => Law::ModifiedSine,
            Self::SimpleSine => Law::SimpleSine,
            Self::Polynomial4567 => Law::Polynomial4567,
            Self::ModifiedTrapezoid => Law::ModifiedTrapezoid,
            Self::Gutman => Law::Gutman,
            Self::SineConstantCosine {
                sine,
                constant,
                cosine,
            } => {
                let [sine, constant, cosine] =
                    [sine, constant, cosine].map(|share| S::from_f64(share.to_f64()));
                Law::SineConstantCosine {
                    sine,
                    constant,
                    cosine,
                }
            }
        }
    }

    /// Checks the shares of a law.
    ///
    /// # Errors
    /// A trapezoid with a share outside (0, 1], or a sum above 1; sine, constant part and cosine with a share outside [0, 1], or a sum outside 0.01
    /// to 1.
    #[inline] // so that a law without shares brings no double precision into single-precision firmware
    pub fn check(self) -> Result<(), RangeError> {
        let (accelerate, decelerate) = match self {
            Self::Trapezoid {
                accelerate,
                decelerate,
            } => (accelerate, decelerate),
            Self::SineConstantCosine {
                sine,
                constant,
                cosine,
            } => return scca::check([sine, constant, cosine].map(Real::to_f64)),
            _ => return Ok(()),
        };
        for (what, share) in [("accelerate", accelerate), ("decelerate", decelerate)] {
            crate::number::error::positive(what, share.to_f64())?;
        }
        // Shares with the sum 1 may be rounded up.
        let sum = accelerate + decelerate;
        if sum > R::from_f64(1.0) + R::from_f64(4.0) * R::EPSILON {
            return Err(RangeError::OutOfRange {
                what: "accelerate + decelerate",
                value: sum.to_f64(),
                min: 0.0,
                max: 1.0,
            });
        }
        Ok(())
    }

    /// The places in (0, 1) where a derivative of the law jumps.
    #[must_use]
    pub fn breaks(self) -> [Option<f64>; 6] {
        match self {
            Self::Trapezoid {
                accelerate,
                decelerate,
            } => {
                let end = R::from_f64(1.0) - decelerate;
                let [first, last] = [accelerate, end].map(Real::to_f64);
                [Some(first), Some(last), None, None, None, None]
            }
            Self::ModifiedSine => [Some(0.125), Some(0.875), None, None, None, None],
            Self::ModifiedTrapezoid => {
                let [a, b, c, d] = [0.125, 0.375, 0.625, 0.875].map(Some);
                [a, b, c, d, None, None]
            }
            Self::SineConstantCosine {
                sine,
                constant,
                cosine,
            } => scca::breaks([sine, constant, cosine].map(Real::to_f64)),
            Self::Polynomial345
            | Self::Polynomial4567
            | Self::Cycloidal
            | Self::SimpleSine
            | Self::Gutman => [None; 6],
        }
    }

    /// [S, S′, S″] at the time `z`; before 0 and after 1 the ends, at rest.
    #[must_use]
    pub fn at(self, z: R) -> [R; 3] {
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
            } => trapezoid(z, accelerate, decelerate),
            Self::Polynomial345 => [
                z * z * z * (c(10.0) + z * (c(6.0) * z - c(15.0))),
                c(30.0) * z * z * (z - c(1.0)) * (z - c(1.0)),
                c(60.0) * z * (c(2.0) * z - c(1.0)) * (z - c(1.0)),
            ],
            Self::Cycloidal => mirrored(z, |z| {
                const TAU: f64 = core::f64::consts::TAU;
                let [versine, sin] = versine(c(TAU) * z);
                [z - sin / c(TAU), versine, c(TAU) * sin]
            }),
            Self::ModifiedSine => mirrored(z, modified_sine),
            Self::SimpleSine => mirrored(z, |z| {
                use core::f64::consts::PI;
                let [versine, sin] = versine(c(PI) * z);
                [
                    c(0.5) * versine,
                    c(PI / 2.0) * sin,
                    c(PI * PI / 2.0) * (c(1.0) - versine),
                ]
            }),
            Self::Polynomial4567 => mirrored(z, polynomial_4567),
            Self::ModifiedTrapezoid => mirrored(z, modified_trapezoid),
            Self::SineConstantCosine {
                sine,
                constant,
                cosine,
            } => {
                let half = scca::Half::new([sine, constant, cosine]);
                mirrored(z, |z| half.at(z))
            }
            Self::Gutman => mirrored(z, |z| {
                use core::f64::consts::PI;
                // sin 3x = sin x·(3 − 4·sin² x), cos 3x = cos x·(4·cos² x − 3).
                let [versine, sin] = versine(c(2.0 * PI) * z);
                let square = sin * sin;
                [
                    z - sin * (c(12.0) - square) / c(24.0 * PI),
                    versine + (c(1.0) - versine) * square / c(4.0),
                    c(1.5 * PI) * sin * (c(2.0) - square),
                ]
            }),
        }
    }

    /// S‴ at the time `z`, without the pulses of a jumping acceleration; zero before 0 and after 1, at a break the value after it.
    #[must_use]
    pub fn jerk(self, z: R) -> R {
        use core::f64::consts::PI;
        let c = R::from_f64;
        if z < c(0.0) || z > c(1.0) {
            return c(0.0);
        }
        let left = c(1.0) - z;
        match self {
            Self::Trapezoid { .. } => c(0.0),
            Self::Polynomial345 => c(60.0) - c(360.0) * z * left,
            Self::Cycloidal => c(4.0 * PI * PI) * (c(2.0 * PI) * z).sin_cos().1,
            Self::ModifiedSine => {
                let share = 16.0 * PI * PI * PI / (4.0 + PI);
                if z >= c(0.125) && z < c(0.875) {
                    c(share / 3.0) * (c(PI / 3.0) * (c(4.0) * z + c(1.0))).sin_cos().1
                } else {
                    c(share) * (c(4.0 * PI) * z).sin_cos().1
                }
            }
            Self::SimpleSine => c(-PI * PI * PI / 2.0) * (c(PI) * z).sin_cos().0,
            Self::Polynomial4567 => {
                let u = z * left;
                c(840.0) * u * (c(1.0) - c(5.0) * u)
            }
            Self::ModifiedTrapezoid => {
                let share = 32.0 * PI * PI / (2.0 + PI);
                if z < c(0.125) || z >= c(0.875) {
                    c(share) * (c(4.0 * PI) * z).sin_cos().1
                } else if z >= c(0.375) && z < c(0.625) {
                    c(-share) * (c(4.0 * PI) * (z - c(0.375))).sin_cos().0
                } else {
                    c(0.0)
                }
            }
            Self::SineConstantCosine {
                sine,
                constant,
                cosine,
            } => scca::Half::new([sine, constant, cosine]).jerk(z),
            Self::Gutman => {
                let (sin, cos) = (c(2.0 * PI) * z).sin_cos();
                c(3.0 * PI * PI) * cos * (c(2.0) - c(3.0) * sin * sin)
            }
        }
    }
}

/// 1 − cos x and sin x, by the half angle: near rest 1 − cos x itself would be rounded to zero, and a slowly moving machine would count as standing,
/// without friction.
pub(super) fn versine<R: Real>(x: R) -> [R; 2] {
    let c = R::from_f64;
    let (sin, cos) = (c(0.5) * x).sin_cos();
    [c(2.0) * sin * sin, c(2.0) * sin * cos]
}

/// Both halves from the first one: S(1 − z) = 1 − S(z). So the last instants are as accurate as the first.
fn mirrored<R: Real>(z: R, half: impl Fn(R) -> [R; 3]) -> [R; 3] {
    let c = R::from_f64;
    if z > c(0.5) {
        let [s, v, a] = half(c(1.0) - z);
        [c(1.0) - s, v, -a]
    } else {
        half(z)
    }
}

fn polynomial_4567<R: Real>(z: R) -> [R; 3] {
    let c = R::from_f64;
    let u = z * (c(1.0) - z);
    [
        z * z * z * z * (c(35.0) + z * (c(-84.0) + z * (c(70.0) - c(20.0) * z))),
        c(140.0) * u * u * u,
        c(420.0) * u * u * (c(1.0) - c(2.0) * z),
    ]
}

/// Quarter of a sine up to z = 1/8, constant to 3/8, quarter of a cosine to 1/2, in units of the largest acceleration, with S(1/2) = 1/2.
fn modified_trapezoid<R: Real>(z: R) -> [R; 3] {
    use core::f64::consts::PI;
    const MOST: f64 = 8.0 * PI / (2.0 + PI);
    const ARC: f64 = 1.0 / (4.0 * PI);
    // Speed and distance at z = 1/8 and 3/8.
    const V_1: f64 = MOST * ARC;
    const S_1: f64 = V_1 * (0.125 - ARC);
    const V_2: f64 = V_1 + MOST / 4.0;
    const S_2: f64 = S_1 + V_1 / 4.0 + MOST / 32.0;
    let c = R::from_f64;
    if z < c(0.125) {
        let [versine, sin] = versine(c(4.0 * PI) * z);
        [c(V_1) * (z - c(ARC) * sin), c(V_1) * versine, c(MOST) * sin]
    } else if z < c(0.375) {
        let w = z - c(0.125);
        [
            c(S_1) + w * (c(V_1) + c(MOST / 2.0) * w),
            c(V_1) + c(MOST) * w,
            c(MOST),
        ]
    } else {
        let w = z - c(0.375);
        let (sin, cos) = (c(4.0 * PI) * w).sin_cos();
        [
            c(S_2) + c(V_2) * w + c(V_1 * ARC) * (c(1.0) - cos),
            c(V_2) + c(V_1) * sin,
            c(MOST) * cos,
        ]
    }
}

fn trapezoid<R: Real>(z: R, accelerate: R, decelerate: R) -> [R; 3] {
    let c = R::from_f64;
    let speed = c(1.0) / (c(1.0) - (accelerate + decelerate) / c(2.0));
    if z < accelerate {
        let a = speed / accelerate;
        [a * z * z / c(2.0), a * z, a]
    } else if z < c(1.0) - decelerate {
        [speed * (z - accelerate / c(2.0)), speed, c(0.0)]
    } else {
        let (a, left) = (speed / decelerate, c(1.0) - z);
        [c(1.0) - a * left * left / c(2.0), a * left, -a]
    }
}

/// Quarter of a sine up to z = 1/8, then a three times slower one up to the middle, in units with S(1/2) = 1/2.
fn modified_sine<R: Real>(z: R) -> [R; 3] {
    use core::f64::consts::PI;
    let c = R::from_f64;
    let (share, quarter) = (1.0 / (4.0 + PI), 0.125);
    if z <= c(quarter) {
        let [versine, sin] = versine(c(4.0 * PI) * z);
        [
            c(share) * (c(PI) * z - c(0.25) * sin),
            c(share * PI) * versine,
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
