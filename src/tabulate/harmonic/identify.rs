//! Harmonics from measurements.
//!
//! The drive torque is linear in all coefficients:
//!
//! ```text
//! T = Σ aₖ·(cos kφ·α − ½·k·sin kφ·ω²) + bₖ·(sin kφ·α + ½·k·cos kφ·ω²)       J
//!   − Σ (aₖ·cos kφ + bₖ·sin kφ)                                             load
//!   + Σ (aₖ·cos kφ + bₖ·sin kφ)·ω + Σ (aₖ·cos kφ + bₖ·sin kφ)·sgn ω         b, c
//! ```
//!
//! with the Coulomb friction c not negative, so that measured φ, ω, α and T determine them by least squares. Each sample is added to a triangular
//! matrix R with RᵀR = ΦᵀΦ by Givens rotations: memory does not grow with the samples, and the error depends on the condition of the measurements,
//! not on its square as with normal equations (Å. Björck, *Numerical Methods for Least Squares Problems*, SIAM 1996, 2.4 and 3.2).

use super::HarmonicError;
use crate::CurveSet;
use crate::curve::{
    Circular, Coefficient, Curve, Harmonic, Kind, MAX_HARMONICS, TableError, words_len,
};
use crate::error::Error;
use crate::number::error::finite;
use crate::{Phase, math};

/// A coefficient counts as excited if more than this share of its effect in the samples is independent of the others. Measurement errors are
/// amplified by 1/share.
pub const EXCITED: f64 = 1e-6;

/// One measurement. Compute α from the measured motion, without delay against φ, ω and T.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Phase of the drive link.
    pub phase: Phase,
    /// Its speed (rad/s).
    pub omega: f64,
    /// Its acceleration (rad/s²).
    pub alpha: f64,
    /// Torque on it (N·m).
    pub torque: f64,
}

/// The identified coefficients; every array in the order of [`Coefficient::of_word`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Identified<const WORDS: usize> {
    /// The coefficients: the words of a table of [`Harmonic`].
    pub words: [f64; WORDS],
    /// Standard error of each, in its own unit, if the errors of the measured torques have equal variance and are independent of each other and of
    /// the motion.
    pub standard_error: [f64; WORDS],
    /// Share of each coefficient's effect that is independent of the others, 0 to 1 (the sine of the angle to their span).
    pub excitation: [f64; WORDS],
    /// Root mean square of the unexplained torque (N·m), over the number of samples minus that of coefficients.
    pub residual: f64,
    /// Condition of the samples, each coefficient's effect scaled to one: ‖R‖·‖R⁻¹‖/WORDS in the Frobenius norm. 1 is best; the condition number is
    /// between this and WORDS times it.
    pub condition: f64,
    /// Number of samples.
    pub samples: u32,
}

/// Accumulates samples one by one, for `WORDS` coefficients: the means and a whole number of harmonics.
///
/// **Cost** of a sample: 3·WORDS² multiplications in `f64`; 8·WORDS² bytes.
#[derive(Clone, Debug)]
pub struct Identification<const WORDS: usize, const SET: CurveSet> {
    /// R, row by row.
    triangle: [[f64; WORDS]; WORDS],
    right: [f64; WORDS],
    residual_square: f64,
    samples: u32,
}

impl<const WORDS: usize, const SET: CurveSet> Identification<WORDS, SET> {
    /// An identification without samples.
    ///
    /// # Errors
    /// `WORDS` is not the number of means and of coefficients of a whole number of harmonics: [`TableError::Length`].
    pub fn new() -> Result<Self, Error> {
        let lengths = (0..=MAX_HARMONICS).map(|n| words_len::<Harmonic<f64>>(n, SET));
        let enough = lengths.take_while(|words| *words <= WORDS).last();
        if enough != Some(WORDS) {
            return Err(Error::Table(TableError::Length {
                needed: enough.unwrap_or(words_len::<Harmonic<f64>>(0, SET)) as u32,
                given: WORDS as u32,
            }));
        }
        Ok(Self {
            triangle: [[0.0; WORDS]; WORDS],
            right: [0.0; WORDS],
            residual_square: 0.0,
            samples: 0,
        })
    }

    /// Adds a sample.
    ///
    /// # Errors
    /// A number of it is not finite; then the sample is not added.
    pub fn add(&mut self, sample: &Sample) -> Result<(), Error> {
        finite("measured speed", sample.omega)?;
        finite("measured acceleration", sample.alpha)?;
        let mut right = finite("measured torque", sample.torque)?;
        let mut effects = Self::effects(sample);
        for (j, row) in self.triangle.iter_mut().enumerate() {
            if effects[j] == 0.0 {
                continue;
            }
            // The rotation of (row[j], effects[j]) to (size, 0).
            let size = math::sqrt(row[j] * row[j] + effects[j] * effects[j]);
            let (c, s) = (row[j] / size, effects[j] / size);
            let turn = |kept: &mut f64, new: &mut f64| {
                (*kept, *new) = (c * *kept + s * *new, c * *new - s * *kept);
            };
            row[j] = size;
            for (kept, new) in row.iter_mut().zip(&mut effects).skip(j + 1) {
                turn(kept, new);
            }
            turn(&mut self.right[j], &mut right);
        }
        self.residual_square += right * right;
        self.samples += 1;
        Ok(())
    }

    /// ∂T/∂(coefficient) for each coefficient.
    fn effects(sample: &Sample) -> [f64; WORDS] {
        let (sin, cos) = f64::sin_cos_of(sample.phase);
        let (omega, alpha) = (sample.omega, sample.alpha);
        let (mut order, mut c, mut s) = (0, 1.0, 0.0);
        core::array::from_fn(|word| {
            let Some(Coefficient { curve, kind }) = Coefficient::of_word(word, SET) else {
                return 0.0;
            };
            let k = match kind {
                Kind::Mean => 0,
                Kind::Cosine(k) | Kind::Sine(k) => k,
            };
            while order < k {
                (s, c) = (s * cos + c * sin, c * cos - s * sin);
                order += 1;
            }
            // A harmonic and its derivative with respect to φ.
            let (wave, slope) = match kind {
                Kind::Sine(_) => (s, f64::from(k) * c),
                Kind::Mean | Kind::Cosine(_) => (c, -f64::from(k) * s),
            };
            match curve {
                Curve::Inertia => wave * alpha + 0.5 * slope * omega * omega,
                Curve::Load => -wave,
                Curve::Viscous => wave * omega,
                Curve::Coulomb | Curve::Constant => wave * math::sign(omega),
            }
        })
    }

    /// The coefficients that best explain the samples.
    ///
    /// # Errors
    /// [`HarmonicError::TooFewSamples`]; [`HarmonicError::NotExcited`] with the least excited coefficient if its excitation is below [`EXCITED`].
    pub fn solve(&self) -> Result<Identified<WORDS>, Error> {
        let free = (self.samples as usize)
            .checked_sub(WORDS)
            .filter(|free| *free > 0);
        let free = free.ok_or(HarmonicError::TooFewSamples {
            needed: WORDS as u32 + 1,
            given: self.samples,
        })?;
        let mut scaled = self.triangle;
        let sizes: [f64; WORDS] =
            core::array::from_fn(|word| norm(self.triangle.iter().map(|row| row[word])));
        for (word, size) in sizes.into_iter().enumerate() {
            if finite("sum of the squares of the samples", size)? <= 0.0 {
                return Err(Self::not_excited(word, None));
            }
            for row in &mut scaled {
                row[word] /= size;
            }
            // A coefficient that depends on those before it; keeps R regular, so that the other one can be named.
            if math::abs(scaled[word][word]) < f64::EPSILON {
                scaled[word][word] = f64::EPSILON;
            }
        }
        let inverse = inverse_of_triangle(&scaled);
        let gain: [f64; WORDS] = inverse.map(norm);
        let worst = (0..WORDS).max_by(|a, b| gain[*a].total_cmp(&gain[*b]));
        if let Some(word) = worst.filter(|word| gain[*word] * EXCITED >= 1.0) {
            let alike =
                |other: usize| math::abs(dot(&inverse[word], &inverse[other])) / gain[other];
            let others = (0..WORDS).filter(|other| *other != word);
            let like = others.max_by(|a, b| alike(*a).total_cmp(&alike(*b)));
            return Err(Self::not_excited(word, like));
        }
        let residual = math::sqrt(self.residual_square / free as f64);
        Ok(Identified {
            words: core::array::from_fn(|word| dot(&inverse[word], &self.right) / sizes[word]),
            standard_error: core::array::from_fn(|word| residual * gain[word] / sizes[word]),
            excitation: gain.map(|gain| 1.0 / gain),
            residual,
            condition: norm(scaled.into_iter().flatten()) * norm(gain) / WORDS as f64,
            samples: self.samples,
        })
    }

    fn not_excited(word: usize, like: Option<usize>) -> Error {
        let name = |word| {
            let fallback = Coefficient {
                curve: Curve::Inertia,
                kind: Kind::Mean,
            };
            Coefficient::of_word(word, SET).unwrap_or(fallback)
        };
        HarmonicError::NotExcited {
            coefficient: name(word),
            like: like.map(name),
        }
        .into()
    }
}

/// The inverse of an upper triangular matrix without zeros on its diagonal, column by column from below.
#[expect(
    clippy::needless_range_loop,
    reason = "rows and columns of two matrices"
)]
fn inverse_of_triangle<const N: usize>(triangle: &[[f64; N]; N]) -> [[f64; N]; N] {
    let mut inverse = [[0.0; N]; N];
    for column in 0..N {
        for row in (0..=column).rev() {
            let one = if row == column { 1.0 } else { 0.0 };
            let known: f64 = (row + 1..=column)
                .map(|k| triangle[row][k] * inverse[k][column])
                .sum();
            inverse[row][column] = (one - known) / triangle[row][row];
        }
    }
    inverse
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(values: impl IntoIterator<Item = f64>) -> f64 {
    math::sqrt(values.into_iter().map(|x| x * x).sum())
}

/// The coefficients of a machine from samples of its motion: [`Identification`] in one call.
///
/// ```
/// use jred::error::Error;
/// use jred::harmonic::{Sample, identify, terms};
/// use jred::table::{Shape, Table};
/// use jred::{CurveSet, Harmonic, Model, Phase, curves};
///
/// // J = 0.5 − 0.2·cos 2φ kg·m², 3 N·m of Coulomb friction.
/// const SET: CurveSet = curves::COULOMB | terms::INERTIA_COS;
/// let made = [0.5, 3.0, 0.0, -0.2];
/// let table = Table::new(&made, Shape::harmonics(2, SET))?;
/// let machine = Model::<Harmonic<f64>, SET>::new(table)?;
/// let samples = core::array::from_fn::<_, 50, _>(|k| {
///     let time = k as f64 * 0.1;
///     let (phase, omega, alpha) = (Phase::from_radians(time + time.sin()), 1.0 + 2.0 * time.cos(), -2.0 * time.sin());
///     Sample { phase, omega, alpha, torque: machine.torque(phase, omega, alpha) }
/// });
/// let found = identify::<4, SET>(&samples)?;
/// assert!(found.words.iter().zip(made).all(|(found, made)| (found - made).abs() < 1e-12));
/// # Ok::<(), jred::error::Error>(())
/// ```
///
/// # Errors
/// As [`Identification::new`], [`add`](Identification::add) and [`solve`](Identification::solve).
pub fn identify<const WORDS: usize, const SET: CurveSet>(
    samples: &[Sample],
) -> Result<Identified<WORDS>, Error> {
    let mut identification = Identification::<WORDS, SET>::new()?;
    for sample in samples {
        identification.add(sample)?;
    }
    identification.solve()
}
