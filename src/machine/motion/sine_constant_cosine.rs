//! The family of sine, constant and cosine acceleration (SCCA): a rise whose acceleration rises by a quarter of a sine, stays, falls by a quarter of
//! a cosine, and is zero around the middle; the second half is the mirror image.
//!
//! The four shares of the time, both halves together, add up to one. The family contains modified sine, modified trapezoid, cycloidal, simple sine,
//! parabola and the modified sines with an interval of constant speed (R. L. Norton, *Cam Design and Manufacturing Handbook*, chapter 3).

use core::f64::consts::FRAC_2_PI;

use super::characteristic::Characteristic;
use super::law::versine;
use crate::math::{self, Real};
use crate::number::error::RangeError;

/// The first half of a rise by 1 in the time 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Half<R> {
    /// Ends of the sine, the constant part and the cosine.
    ends: [R; 3],
    /// 2/π times the time of the sine and of the cosine: the speed gained by a quarter of each, in units of the largest acceleration.
    arcs: [R; 2],
    /// Speed and distance at these ends, in the same units.
    speeds: [R; 3],
    ways: [R; 3],
    /// The largest acceleration.
    most: R,
}

/// Checks the shares of sine, constant part and cosine.
pub(super) fn check(shares: [f64; 3]) -> Result<(), RangeError> {
    for (what, share) in ["sine", "constant", "cosine"].into_iter().zip(shares) {
        if !(0.0..=1.0).contains(&share) {
            return Err(RangeError::OutOfRange {
                what,
                value: share,
                min: 0.0,
                max: 1.0,
            });
        }
    }
    let sum = shares.iter().sum::<f64>();
    // Shares with the sum 1 may be rounded up.
    if !(LEAST..=1.0 + 4.0 * f64::EPSILON).contains(&sum) {
        return Err(RangeError::OutOfRange {
            what: "sine + constant + cosine",
            value: sum,
            min: LEAST,
            max: 1.0,
        });
    }
    Ok(())
}

/// Smallest share of the time with an acceleration.
const LEAST: f64 = 0.01;

/// The places in (0, 1) where a derivative jumps.
pub(super) fn breaks(shares: [f64; 3]) -> [Option<f64>; 6] {
    let [sine, constant, cosine] = shares.map(|share| 0.5 * share);
    let ends = [sine, sine + constant, sine + constant + cosine];
    let mut breaks = [None; 6];
    let mut last = 0.0;
    for (k, end) in ends.into_iter().enumerate() {
        // No part remains next to the start, to another end, or to the middle.
        if end - last > ROUNDING && 0.5 - end > ROUNDING {
            breaks[k] = Some(end);
            breaks[5 - k] = Some(1.0 - end);
            last = end;
        }
    }
    // A cosine continues through the middle; without one the acceleration jumps there.
    if cosine < ROUNDING && 0.5 - ends[2] <= ROUNDING {
        breaks[2] = Some(0.5);
    }
    breaks
}

/// Shares of the time below which a part counts as absent.
const ROUNDING: f64 = 1e-12;

/// C_v, C_a, C_j and C_Mdyn.
pub(super) fn characteristic(shares: [f64; 3]) -> Characteristic {
    let half = Half::<f64>::new(shares);
    let [sine, cosine] = half.arcs;
    // Without a sine the acceleration jumps at the ends, without a cosine where it ends.
    let smooth = shares[0] > 0.0 && shares[2] > 0.0;
    // (v + q·sin θ)·cos θ over the cosine is largest at 2q·s² + v·s = q; before it S′·S″ rises.
    let v = half.speeds[1];
    let sin = if cosine > 0.0 {
        (math::sqrt(v * v + 8.0 * cosine * cosine) - v) / (4.0 * cosine)
    } else {
        0.0
    };
    let product = (v + cosine * sin) * math::sqrt(1.0 - sin * sin);
    Characteristic {
        velocity: half.most * half.speeds[2],
        acceleration: half.most,
        jerk: smooth.then(|| half.most / sine.min(cosine)),
        dynamic_torque: half.most * half.most * product,
    }
}

impl<R: Real> Half<R> {
    pub(super) fn new(shares: [R; 3]) -> Self {
        let c = R::from_f64;
        let half = c(0.5);
        let [t1, t2, t3] = shares.map(|share| half * share);
        let [p, q] = [t1, t3].map(|t| c(FRAC_2_PI) * t);
        let ends = [t1, t1 + t2, t1 + t2 + t3];
        let v2 = p + t2;
        let speeds = [p, v2, v2 + q];
        let s1 = p * (t1 - p);
        let s2 = s1 + t2 * (p + half * t2);
        let s3 = s2 + v2 * t3 + q * q;
        let left = half - ends[2];
        let left = if left > c(0.0) { left } else { c(0.0) };
        Self {
            ends,
            arcs: [p, q],
            speeds,
            ways: [s1, s2, s3],
            most: half / (s3 + speeds[2] * left),
        }
    }

    /// [S, S′, S″] for z up to 1/2.
    pub(super) fn at(&self, z: R) -> [R; 3] {
        let c = R::from_f64;
        let ([p, q], [s1, s2, s3]) = (self.arcs, self.ways);
        let shape = if z < self.ends[0] {
            let [versine, sin] = versine(z / p);
            [p * (z - p * sin), p * versine, sin]
        } else if z < self.ends[1] {
            let w = z - self.ends[0];
            [s1 + w * (p + c(0.5) * w), p + w, c(1.0)]
        } else if z < self.ends[2] {
            let w = z - self.ends[1];
            let [versine, sin] = versine(w / q);
            let v = self.speeds[1];
            [s2 + v * w + q * q * versine, v + q * sin, c(1.0) - versine]
        } else {
            let v = self.speeds[2];
            [s3 + v * (z - self.ends[2]), v, c(0.0)]
        };
        shape.map(|value| self.most * value)
    }

    /// S‴ at z; at a break the value after it.
    pub(super) fn jerk(&self, z: R) -> R {
        let c = R::from_f64;
        let second = z > c(0.5);
        let place = if second { c(1.0) - z } else { z };
        // In the second half, after a break means before it in the mirror image.
        let before = |end: R| place < end || (second && place <= end);
        let [p, q] = self.arcs;
        if p > c(0.0) && before(self.ends[0]) {
            self.most / p * (place / p).sin_cos().1
        } else if before(self.ends[1]) {
            c(0.0)
        } else if q > c(0.0) && before(self.ends[2]) {
            -self.most / q * ((place - self.ends[1]) / q).sin_cos().0
        } else {
            c(0.0)
        }
    }
}
