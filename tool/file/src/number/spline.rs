//! Curves through measured or tabulated points at any spacing: interpolating, without overshoot, or smoothing.
//!
//! ```text
//! interpolating   cubic, twice continuously differentiable; periodic, or with the first two and the last two pieces being one
//!                 cubic each (not-a-knot). Error at most 5/384·h⁴·max|f⁗| at equal steps h.
//! level           the same, but level at both ends, so that it goes on as a constant with one continuous derivative
//! resting         interpolating, level at an end where its slope is at most a quarter of that of the outer chord
//! monotone        cubic, once continuously differentiable, never beyond the two rows that it runs between (M. Steffen,
//!                 A simple method for monotonic interpolation in one dimension, Astron. Astrophys. 239 (1990) 443)
//! smoothing       minimises Σ w·(y − f)² + ∫f″² dt/ω_c⁴ with w the time that a row stands for (C. H. Reinsch, Smoothing by
//!                 spline functions, Numer. Math. 10 (1967) 177): a sine of the angular frequency ω keeps 1/(1 + (ω/ω_c)⁴) of its
//!                 amplitude, without a shift of phase
//! ```
//!
//! C. de Boor, *A practical guide to splines*, New York 1978.

mod banded;
mod fit;

use std::fmt;

/// Fewest points of a curve; one less for a period, whose last point is its first.
pub const MIN_POINTS: usize = 5;

/// Faults of points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SplineError {
    /// Fewer than [`MIN_POINTS`].
    TooFew,
    /// The arguments do not rise, a number is not finite, or the two lists differ in length.
    NotRising,
    /// The points of a period are spread over more than the period.
    BeyondPeriod,
}

impl fmt::Display for SplineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFew => write!(f, "a curve needs at least {MIN_POINTS} points"),
            Self::NotRising => f.write_str("the points must be finite and in increasing order"),
            Self::BeyondPeriod => f.write_str("the points must lie within one period"),
        }
    }
}

impl std::error::Error for SplineError {}

/// The type of fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FitMethod {
    /// Through every point, twice continuously differentiable.
    Interpolating,
    /// The same, level at both ends; not for periodic curves.
    Level,
    /// The same, level only at an end where the curve rests; not for periodic curves.
    Resting,
    /// Through every point without overshoot, once continuously differentiable.
    Monotone,
    /// Near the points: the amplitude of a sine of this angular frequency (1/unit of the argument) is halved.
    Smoothing(f64),
}

/// A piecewise cubic.
#[derive(Clone, Debug, PartialEq)]
pub struct Spline {
    /// Starts of the pieces, and the end of the last.
    knots: Vec<f64>,
    /// f = c₀ + c₁·u + c₂·u² + c₃·u³ with u from the start of the piece.
    pieces: Vec<[f64; 4]>,
    /// ∫f from the first knot to the start of each piece, and over all.
    areas: Vec<f64>,
    periodic: bool,
}

/// One of the cubics of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CubicPiece {
    /// Its range.
    pub ends: [f64; 2],
    /// Origin of its u.
    pub origin: f64,
    /// f = c₀ + c₁·u + c₂·u² + c₃·u³.
    pub coefficients: [f64; 4],
}

impl Spline {
    /// A curve over the range of its points, constant beyond its ends.
    ///
    /// # Errors
    /// See [`SplineError`].
    pub fn bounded(x: &[f64], y: &[f64], way: FitMethod) -> Result<Self, SplineError> {
        check(x, y, MIN_POINTS)?;
        Ok(Self::new(x.to_vec(), fit::bounded(x, y, way), false))
    }

    /// A curve that repeats after `period`: the points lie in one period, without the last, which equals the first.
    ///
    /// # Errors
    /// See [`SplineError`].
    pub fn periodic(
        x: &[f64],
        y: &[f64],
        period: f64,
        way: FitMethod,
    ) -> Result<Self, SplineError> {
        check(x, y, MIN_POINTS - 1)?;
        let (Some(first), Some(last)) = (x.first(), x.last()) else {
            return Err(SplineError::TooFew);
        };
        let end = first + period;
        if !end.is_finite() || end <= *last {
            return Err(SplineError::BeyondPeriod);
        }
        let mut knots = x.to_vec();
        knots.push(end);
        let pieces = fit::periodic(&knots, y, way);
        Ok(Self::new(knots, pieces, true))
    }

    fn new(knots: Vec<f64>, pieces: Vec<[f64; 4]>, periodic: bool) -> Self {
        let mut areas = Vec::with_capacity(knots.len());
        let mut sum = 0.0;
        areas.push(sum);
        for (piece, h) in pieces.iter().zip(knots.windows(2).map(|k| k[1] - k[0])) {
            sum += area(piece, h);
            areas.push(sum);
        }
        Self {
            knots,
            pieces,
            areas,
            periodic,
        }
    }

    /// Start and end of the curve.
    pub fn range(&self) -> [f64; 2] {
        [self.knots[0], self.knots[self.knots.len() - 1]]
    }

    /// The points of the curve: arguments and values; for a period without the last.
    pub fn points(&self) -> (Vec<f64>, Vec<f64>) {
        let count = self.knots.len() - usize::from(self.periodic);
        let x = self.knots[..count].to_vec();
        let y = x.iter().map(|x| self.at(*x)[0]).collect();
        (x, y)
    }

    /// The smoothing curve near these points, over the same range.
    ///
    /// # Errors
    /// See [`SplineError`].
    pub fn smoothed(&self, cutoff: f64) -> Result<Self, SplineError> {
        let (x, y) = self.points();
        let [from, to] = self.range();
        let way = FitMethod::Smoothing(cutoff);
        if self.periodic {
            Self::periodic(&x, &y, to - from, way)
        } else {
            Self::bounded(&x, &y, way)
        }
    }

    /// The knots strictly between two arguments of the range, in order.
    pub fn knots_between(&self, [low, high]: [f64; 2]) -> impl Iterator<Item = f64> {
        let first = self.knots.partition_point(|knot| *knot <= low);
        let after = self.knots.iter().skip(first).copied();
        after.take_while(move |knot| *knot < high)
    }

    /// The piece at `x`, the position in it, and the number of whole periods before it.
    fn place(&self, x: f64) -> (usize, f64, f64) {
        let [from, to] = self.range();
        let (x, turns) = if self.periodic {
            let turns = ((x - from) / (to - from)).floor();
            (x - turns * (to - from), turns)
        } else {
            (x, 0.0)
        };
        let x = x.clamp(from, to);
        let after = self.knots.partition_point(|knot| *knot <= x);
        let piece = after.clamp(1, self.pieces.len()) - 1;
        (piece, x - self.knots[piece], turns)
    }

    /// f, f′, f″, f‴ at `x`.
    pub fn at(&self, x: f64) -> [f64; 4] {
        let (k, u, _) = self.place(x);
        let [a, b, c, d] = self.pieces[k];
        let value = a + u * (b + u * (c + u * d));
        let [from, to] = self.range();
        if !self.periodic && !(from..=to).contains(&x) {
            return [value, 0.0, 0.0, 0.0];
        }
        let slope = b + u * (2.0 * c + u * 3.0 * d);
        [value, slope, 2.0 * c + 6.0 * d * u, 6.0 * d]
    }

    /// The cubics of f between two arguments, with the constants beyond the ends of a curve that does not repeat.
    pub fn pieces_between(&self, [low, high]: [f64; 2]) -> Vec<CubicPiece> {
        let [from, to] = self.range();
        let period = to - from;
        let mut found = Vec::new();
        let turns = if self.periodic {
            let turn = |x: f64| ((x - from) / period).floor();
            // One more on each side, because of rounding.
            (turn(low) as i64 - 1, turn(high) as i64 + 1)
        } else {
            found.push(CubicPiece {
                ends: [f64::NEG_INFINITY, from],
                origin: from,
                coefficients: [self.at(from)[0], 0.0, 0.0, 0.0],
            });
            found.push(CubicPiece {
                ends: [to, f64::INFINITY],
                origin: to,
                coefficients: [self.at(to)[0], 0.0, 0.0, 0.0],
            });
            (0, 0)
        };
        for turn in turns.0..=turns.1 {
            let ahead = turn as f64 * period;
            let knots = self.knots.windows(2).zip(&self.pieces);
            found.extend(knots.map(|(ends, coefficients)| CubicPiece {
                ends: [ends[0] + ahead, ends[1] + ahead],
                origin: ends[0] + ahead,
                coefficients: *coefficients,
            }));
        }
        found.retain(|piece| piece.ends[0] <= high && low <= piece.ends[1]);
        found
    }

    /// ∫f from the start of the range to `x`: exact for the cubic pieces.
    pub fn integral(&self, x: f64) -> f64 {
        let (k, u, turns) = self.place(x);
        let [from, to] = self.range();
        let beyond = if self.periodic {
            turns * self.areas[self.areas.len() - 1]
        } else {
            (x - x.clamp(from, to)) * self.at(x)[0]
        };
        self.areas[k] + area(&self.pieces[k], u) + beyond
    }

    /// A bound on |f|: the largest of all pieces' Bézier points, between which a piece lies.
    pub fn largest(&self) -> f64 {
        let mut largest = 0.0f64;
        for ([a, b, c, d], ends) in self.pieces.iter().zip(self.knots.windows(2)) {
            let h = ends[1] - ends[0];
            let points = [
                *a,
                a + h * b / 3.0,
                a + h * (2.0 * b + h * c) / 3.0,
                a + h * (b + h * (c + h * d)),
            ];
            largest = points.iter().fold(largest, |most, p| most.max(p.abs()));
        }
        largest
    }

    /// The smallest value and its position: at a knot, or where the slope of a piece is zero.
    pub fn least(&self) -> (f64, f64) {
        let mut least = (f64::INFINITY, self.knots[0]);
        for (piece, ends) in self.pieces.iter().zip(self.knots.windows(2)) {
            let h = ends[1] - ends[0];
            for u in stationary(piece).into_iter().chain([0.0, h]) {
                let u = u.clamp(0.0, h);
                let [a, b, c, d] = piece;
                let value = a + u * (b + u * (c + u * d));
                if value < least.0 {
                    least = (value, ends[0] + u);
                }
            }
        }
        least
    }
}

fn check(x: &[f64], y: &[f64], fewest: usize) -> Result<(), SplineError> {
    if x.len() < fewest {
        return Err(SplineError::TooFew);
    }
    let finite = x.iter().chain(y).all(|value| value.is_finite());
    if !finite || x.len() != y.len() || x.windows(2).any(|pair| pair[1] <= pair[0]) {
        return Err(SplineError::NotRising);
    }
    Ok(())
}

/// ∫ of a piece from its start over `u`.
fn area([a, b, c, d]: &[f64; 4], u: f64) -> f64 {
    u * (a + u * (b / 2.0 + u * (c / 3.0 + u * d / 4.0)))
}

/// Zeros of a piece's slope.
fn stationary([_, b, c, d]: &[f64; 4]) -> [f64; 2] {
    // b + 2c·u + 3d·u² = 0, in the form without cancellation.
    let discriminant = c * c - 3.0 * b * d;
    if discriminant < 0.0 {
        return [0.0; 2];
    }
    let q = -(c + c.signum() * discriminant.sqrt());
    let root = |u: f64| if u.is_finite() { u } else { 0.0 };
    [root(q / (3.0 * d)), root(b / q)]
}
