//! The solution of the equations, with its errors, and whether the motion determines it.

use super::column::{Column, Effect, inertia_shares};
use crate::Phase;
use crate::curve::Circular;

/// Parts of a turn that must all be visited.
const PARTS: usize = 32;

/// Fewest rows of a solution: 5 s.
const FEWEST_ROWS: u32 = 1250;

/// [`Found::speed_spread`] below which J′ and load cannot be told apart.
const LEAST_SPREAD: f64 = 0.025;

/// Residual, in the stated noise, beyond which something else disturbs.
const MOST_RESIDUAL: f64 = 1.5;

/// Share of a coefficient's effect that is its own, below which it is not determined.
const LEAST_SHARE: f64 = 1e-4;

/// 95 % of a normal distribution lie within so many standard deviations.
const BAND: f64 = 1.959_964;

/// The equations of an [`Identification`](super::Identification): a copy, to be solved in the background.
#[derive(Clone, Debug, PartialEq)]
pub struct Equations<T, const N: usize> {
    columns: [Column<T>; N],
    words: usize,
    pub(super) matrix: [[T; N]; N],
    pub(super) known: [T; N],
    squares: T,
    weight: T,
    /// λ to the number of rows.
    faded: T,
    pub(super) rows: u32,
    pub(super) jumps: u32,
    pub(super) refused: u32,
    pub(super) motion: Motion<T>,
}

/// Whether a solution can be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum FoundStatus {
    /// It can. [`Found::inertia`] says how well it is known.
    Good,
    /// More than 2 % of the samples were faster than 1.05 times the stated `max_speed`, and were left out: state the machine's greatest speed, and start anew.
    TooFast,
    /// Less than 5 s of motion without jumps and standstill.
    TooShort,
    /// A 32nd of the turn was visited for less than a tenth of the mean time.
    NotVisited(Phase),
    /// At each angle the speed was always the same, whatever its sign: J′ and load act alike.
    SameSpeed,
    /// The motion does not determine this coefficient.
    NotDetermined(usize),
    /// J is negative everywhere: torque and angle count in opposite directions.
    Reversed,
    /// J is not positive everywhere: more harmonics, more acceleration, or a longer time.
    NotPositive,
    /// The residual is more than one and a half times the stated noise: a wrong delay, slip, a load that is not one of φ, or missing harmonics.
    Disturbed,
}

/// A solution of the equations.
#[derive(Clone, Debug, PartialEq)]
pub struct Found<T, const N: usize> {
    /// The words of a table of [`Harmonic`](crate::Harmonic), and then cosine and sine of each order of cogging (N·m on the drive, to be added).
    pub coefficients: [T; N],
    /// Standard error of each.
    pub standard_error: [T; N],
    /// Whether it can be used.
    pub status: FoundStatus,
    /// Root mean square of the whitened residual: 1 if the stated noise is right; 0 before an estimate was adopted.
    pub residual: T,
    /// Standard deviation of |ω| from its line over a 32nd of the turn, as a share of its root mean square there: the median over the turn. A
    /// standstill does not count.
    pub speed_spread: T,
    /// Only one direction: Coulomb friction includes the mean of the load.
    pub one_way: bool,
    /// Rows, of 4 ms each.
    pub rows: u32,
    /// Jumps of the angle. A slip of the encoder moves J along φ; a missed tick does no harm.
    pub jumps: u32,
    /// Torques that were NaN or infinite.
    pub refused: u32,
    columns: [Column<T>; N],
    words: usize,
    /// U with θ = U⁻¹·q and covariance scale²·U⁻¹·U⁻ᵀ.
    triangle: [[T; N]; N],
    scale: T,
}

impl<T: Circular, const N: usize> Equations<T, N> {
    pub(super) fn new(columns: [Column<T>; N], words: usize) -> Self {
        let [zero, _, one] = T::CONSTANTS;
        Self {
            columns,
            words,
            matrix: [[zero; N]; N],
            known: [zero; N],
            squares: zero,
            weight: zero,
            faded: one,
            rows: 0,
            jumps: 0,
            refused: 0,
            motion: Motion::new(),
        }
    }

    pub(super) fn row(&mut self, kept: T) {
        self.rows = self.rows.saturating_add(1);
        self.faded = self.faded * kept;
    }

    pub(super) fn residual(&mut self, error: T, kept: T) {
        let [.., one] = T::CONSTANTS;
        self.squares = self.squares * kept + error * error;
        self.weight = self.weight * kept + one;
    }

    /// An upper triangle that has the same solution.
    fn triangle(&self) -> ([[T; N]; N], [T; N]) {
        let [zero, _, one] = T::CONSTANTS;
        let mut triangle = [[zero; N]; N];
        let mut known = [zero; N];
        for (row, value) in self.matrix.iter().zip(&self.known) {
            let (mut row, mut value) = (*row, *value);
            for (i, (kept, right)) in triangle.iter_mut().zip(&mut known).enumerate() {
                let (Some(old), Some(new)) = (kept.get(i).copied(), row.get(i).copied()) else {
                    continue;
                };
                let size = (old * old + new * new).sqrt();
                if size > zero {
                    let (c, s) = (old / size, new / size);
                    turn(kept.get_mut(i..), row.get_mut(i..), one, c, s);
                    let (u, v) = (*right, value);
                    (*right, value) = (c * u + s * v, c * v - s * u);
                }
            }
        }
        (triangle, known)
    }

    /// Solves them: about 4·N³ operations, for the background.
    #[must_use]
    pub fn solve(&self) -> Found<T, N> {
        let [zero, half, one] = T::CONSTANTS;
        let (triangle, known) = self.triangle();
        let mut sizes = [zero; N];
        for row in &triangle {
            for (sum, value) in sizes.iter_mut().zip(row) {
                *sum = *sum + *value * *value;
            }
        }
        let residual = if self.weight > zero {
            (self.squares / self.weight).sqrt()
        } else {
            zero
        };
        let fading = (half * (one + self.faded)).sqrt();
        let (part, speed_spread) = self.motion.judge();
        let mut found = Found {
            coefficients: [zero; N],
            standard_error: [zero; N],
            status: FoundStatus::Good,
            residual,
            speed_spread: speed_spread.sqrt(),
            one_way: self.motion.is_one_way(),
            rows: self.rows,
            jumps: self.jumps,
            refused: self.refused,
            columns: self.columns,
            words: self.words,
            triangle,
            scale: fading * if residual > one { residual } else { one },
        };
        let mut undetermined = None;
        let share = T::from_f64(LEAST_SHARE);
        for (i, size) in sizes.iter().enumerate() {
            if self
                .columns
                .get(i)
                .is_none_or(|column| column.effect == Effect::None)
            {
                continue;
            }
            let mut unit = [zero; N];
            if let Some(value) = unit.get_mut(i) {
                *value = one;
            }
            let spread = found.spread(unit);
            // A NaN is not determined.
            let determined = size.sqrt() * spread * share < one && *size > zero;
            if !determined {
                undetermined.get_or_insert(i);
            }
            if let Some(error) = found.standard_error.get_mut(i) {
                *error = spread * found.scale;
            }
        }
        let rows = found.triangle.iter().zip(&known).enumerate();
        for (i, (row, value)) in rows.rev() {
            let rest = row.iter().zip(&found.coefficients).skip(i + 1);
            let rest = rest.fold(*value, |rest, (factor, known)| rest - *factor * *known);
            let (Some(diagonal), Some(slot)) = (row.get(i), found.coefficients.get_mut(i)) else {
                continue;
            };
            *slot = if *diagonal == zero {
                zero
            } else {
                rest / *diagonal
            };
        }
        found.status = self.status(&found, part, undetermined);
        found
    }

    /// Whether a solution can be used; with a part that was hardly visited, and a coefficient that is not determined.
    fn status(
        &self,
        found: &Found<T, N>,
        part: Option<Phase>,
        undetermined: Option<usize>,
    ) -> FoundStatus {
        let varies = found.speed_spread > T::from_f64(LEAST_SPREAD);
        if self.motion.is_too_fast() {
            FoundStatus::TooFast
        } else if self.rows < FEWEST_ROWS {
            FoundStatus::TooShort
        } else if let Some(part) = part {
            FoundStatus::NotVisited(part)
        } else if !varies {
            FoundStatus::SameSpeed
        } else if let Some(coefficient) = undetermined {
            FoundStatus::NotDetermined(coefficient)
        } else {
            match found.positive_places() {
                0 => FoundStatus::Reversed,
                PARTS if found.residual < T::from_f64(MOST_RESIDUAL) => FoundStatus::Good,
                PARTS => FoundStatus::Disturbed,
                _ => FoundStatus::NotPositive,
            }
        }
    }
}

impl<T: Circular, const N: usize> Found<T, N> {
    /// The words of a table of [`Harmonic`](crate::Harmonic) with the set of the identification.
    #[must_use]
    pub fn words(&self) -> &[T] {
        self.coefficients.get(..self.words).unwrap_or(&[])
    }

    /// J (kg·m²) at this phase, and its 95 % band: it lies within ± the second.
    #[must_use]
    pub fn inertia(&self, phase: Phase) -> [T; 2] {
        let shares = inertia_shares(phase, &self.columns);
        [
            dot(&shares, &self.coefficients),
            T::from_f64(BAND) * self.scale * self.spread(shares),
        ]
    }

    /// Number of places where J is positive.
    fn positive_places(&self) -> usize {
        let [zero, ..] = T::CONSTANTS;
        let places = (0..PARTS as u32).map(|part| Phase::from_bits(part << 27));
        let inertia = |phase| dot(&inertia_shares(phase, &self.columns), &self.coefficients);
        places.filter(|phase| inertia(*phase) > zero).count()
    }

    /// ‖U⁻ᵀ·shares‖.
    fn spread(&self, mut shares: [T; N]) -> T {
        let [zero, ..] = T::CONSTANTS;
        let mut sum = zero;
        for (i, row) in self.triangle.iter().enumerate() {
            let (Some(diagonal), Some(share)) = (row.get(i), shares.get(i)) else {
                continue;
            };
            if *diagonal == zero {
                continue;
            }
            let y = *share / *diagonal;
            sum = sum + y * y;
            for (rest, factor) in shares.iter_mut().zip(row).skip(i + 1) {
                *rest = *rest - *factor * y;
            }
        }
        sum.sqrt()
    }
}

/// Where the machine was, and how fast.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Motion<T> {
    /// Sums of 1, |ω|, ω², x, x² and x·|ω| in each part of a turn, with x from −½ to ½ over the part.
    parts: [[T; 6]; PARTS],
    samples: u32,
    forward: u32,
    /// Samples beyond the greatest speed, which are in no part.
    pub(super) fast: u32,
}

impl<T: Circular> Motion<T> {
    const fn new() -> Self {
        let [zero, ..] = T::CONSTANTS;
        Self {
            parts: [[zero; 6]; PARTS],
            samples: 0,
            forward: 0,
            fast: 0,
        }
    }

    #[inline]
    pub(super) fn add(&mut self, phase: Phase, omega: T, most: u32) {
        let [zero, half, one] = T::CONSTANTS;
        let speed = if omega < zero { -omega } else { omega };
        let place = (phase.to_bits() << 5 >> 8) as f32 / 16_777_216.0;
        let place = T::from_single(place) - half;
        if let Some(part) = self.parts.get_mut((phase.to_bits() >> 27) as usize) {
            let more = [
                one,
                speed,
                speed * speed,
                place,
                place * place,
                place * speed,
            ];
            for (sum, value) in part.iter_mut().zip(more) {
                *sum = *sum + value;
            }
        }
        self.samples += 1;
        self.forward += u32::from(omega > zero);
        if self.samples >= most {
            self.samples /= 2;
            self.forward /= 2;
            self.fast /= 2;
            self.parts = self.parts.map(|part| part.map(|sum| half * sum));
        }
    }

    fn is_too_fast(&self) -> bool {
        self.fast > self.samples / 50
    }

    fn is_one_way(&self) -> bool {
        let least = self.samples / 50;
        self.forward < least || self.samples - self.forward < least
    }

    /// A part that was hardly visited, and the median of the share of ω² that varies at an angle.
    fn judge(&self) -> (Option<Phase>, T) {
        let [zero, ..] = T::CONSTANTS;
        let fewest = T::from_count(self.samples) * T::from_f64(0.1 / PARTS as f64);
        let mut part = None;
        let mut shares = [zero; PARTS];
        for ((k, sums), share) in (0..).zip(self.parts).zip(&mut shares) {
            let [number, speeds, squares, places, width, both] = sums;
            if number > fewest {
                let varying = squares - speeds * speeds / number;
                let (width, both) = (
                    width - places * places / number,
                    both - places * speeds / number,
                );
                let line = if width > zero {
                    both * both / width
                } else {
                    zero
                };
                *share = if squares > zero {
                    (varying - line) / squares
                } else {
                    zero
                };
            } else {
                part.get_or_insert(Phase::from_bits(k << 27));
            }
        }
        let below = |limit: &T| shares.iter().filter(|share| **share < *limit).count();
        let upper = shares.into_iter().filter(|share| below(share) <= PARTS / 2);
        let median = upper.fold(zero, |most, share| if share > most { share } else { most });
        (part, median)
    }
}

pub(super) fn dot<T: Circular, const N: usize>(a: &[T; N], b: &[T; N]) -> T {
    let [zero, ..] = T::CONSTANTS;
    a.iter().zip(b).fold(zero, |sum, (a, b)| sum + *a * *b)
}

/// The rotation of (kept·u, v) by (c, s).
#[inline]
pub(super) fn turn<T: Circular>(old: Option<&mut [T]>, new: Option<&mut [T]>, kept: T, c: T, s: T) {
    let (Some(old), Some(new)) = (old, new) else {
        return;
    };
    for (u, v) in old.iter_mut().zip(new) {
        let (a, b) = (kept * *u, *v);
        (*u, *v) = (c * a + s * b, c * b - s * a);
    }
}
