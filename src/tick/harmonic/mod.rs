//! Harmonics: the reduced machine as short Fourier series instead of a table.
//!
//! ```text
//! J(φ)  = a₀ + Σ aₖ·cos kφ + bₖ·sin kφ,   k = 1 … n     (kg·m²)
//! J′(φ) =      Σ k·(bₖ·cos kφ − aₖ·sin kφ)              (kg·m²/rad)
//! ```
//!
//! and load, viscous and Coulomb coefficient likewise, as far as the machine has them; φ is the angle of a drive link
//! that turns fully. The slope is that of the same series, so a free machine keeps its energy. cos kφ and sin kφ come
//! from one sine and cosine by turning on:
//!
//! ```text
//! cos (k+1)φ = cos kφ·cos φ − sin kφ·sin φ,   sin (k+1)φ = sin kφ·cos φ + cos kφ·sin φ
//! ```
//!
//! One such pair serves all curves, and its error grows with k only; the recurrence of C. W. Clenshaw (*Math. Comp.* 9,
//! 1955) needs a pass for each curve and each kind, and near φ = 0 and π its error grows with k².
//!
//! The coefficients of a smooth machine fall like those of a geometric series: a few give what takes a table of many
//! cells. A kink (a load with an edge, a dwell) makes them fall like 1/k²:
//! such a machine needs a [`Table`](crate::Table). [`fit()`] tells them apart.
//!
//! ```
//! use jred::harmonic::{HarmonicModel, Request, fit, scratch_len, terms};
//! use jred::mechanism::{Branch, SliderCrank};
//! use jred::table::curves;
//! use jred::{Error, Link, Machine, Phase, Reducible};
//!
//! fn main() -> Result<(), Error> {
//!     // Crank 30 mm, rod 120 mm, ram 42 kg: weight acts along the guide, so J is even and the load odd in φ.
//!     let links = [Link::new(9.0, 0.018, [0.006, 0.0])?, Link::new(6.5, 0.03, [0.055, 0.0])?, Link::new(42.0, 0.0, [0.0, 0.0])?];
//!     let mechanism = SliderCrank::new(0.03, 0.12, 0.0, Branch::Right, links)?;
//!     let machine = Machine::new(mechanism).with_gravity([9.81, 0.0])?;
//!
//!     const MOST: u32 = 16;
//!     let request = Request { torque_error: 0.001, omega: 12.0, alpha: 60.0, max_harmonics: MOST };
//!     let (mut scratch, mut words) = ([0.0; scratch_len(MOST)], [0.0f32; 2 + 2 * MOST as usize]);
//!     let found = fit::<f32, { curves::LOAD }, { terms::SYMMETRIC }>(&machine, &request, &mut scratch, &mut words)?;
//!     assert!(found.torque_error <= 0.001 && found.bytes <= 80);
//!
//!     let model = HarmonicModel::<f32, { curves::LOAD }, { terms::SYMMETRIC }>::new(&words[..found.words])?;
//!     let torque = model.torque(Phase::from_radians(0.5), 10.0, 50.0);
//!     let exact = machine.reduction(0.5)?.torque(10.0, 50.0).total();
//!     assert!((f64::from(torque) - exact).abs() < 0.001);
//!     Ok(())
//! }
//! ```

mod error;
#[allow(
    clippy::indexing_slicing,
    reason = "runs before a machine does, not in a tick"
)]
mod fit;
#[allow(
    clippy::indexing_slicing,
    reason = "runs before a machine does, not in a tick"
)]
mod identify;
mod sine;
#[allow(
    clippy::indexing_slicing,
    reason = "runs before a machine does, not in a tick"
)]
mod spectrum;
#[allow(clippy::indexing_slicing, reason = "lengths known at compile time")]
mod word;

pub use error::{CoefficientError, HarmonicError};
pub use fit::{Fitted, Request, fit, measure, scratch_len, terms_in_use};
pub use identify::{EXCITED, Identification, Identified, Sample, identify};
pub use sine::Circular;
pub use word::{Coefficient, Curve, Kind, terms, words_len};

use crate::Set;
use crate::tick::AccelerationRange;
use crate::{Outcome, Phase};

/// Most harmonics of a series.
pub const MAX_HARMONICS: u32 = 256;

/// Places looked at to show the inertia positive: at first, and at most.
const PLACES: [u32; 2] = [64, 4096];

/// A reduced machine ready for the tick, as harmonics in RAM or in flash. The counterpart of [`Model`](crate::Model),
/// in SI units.
///
/// `CURVES` are the curves that the machine has in addition to J ([`curves`](crate::curve::curves)); `TERMS` are the cosines
/// and sines that they consist of ([`terms`]; those of curves that are not in `CURVES` do not count). Curves and terms in
/// neither cost no memory and no instruction.
///
/// Everything was checked when it was built: [`torque`](Self::torque) and [`acceleration`](Self::acceleration) neither
/// fail nor panic nor allocate, and take the same path for every phase.
///
/// **Cost** of a tick: one sine and cosine, then six operations for each harmonic, two for each of its coefficients and
/// for each of J's two or three more (J′). A division only in `acceleration`. Instructions are in `docs/harmonics.md`.
#[derive(Clone, Copy, Debug)]
pub struct HarmonicModel<'a, T: Circular, const CURVES: Set, const TERMS: Set> {
    means: [T; 5],
    rows: &'a [T],
}

/// All curves at one phase, in SI units; zero where the machine has none.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Values<T> {
    /// J (kg·m²).
    pub inertia: T,
    /// J′ (kg·m²/rad).
    pub inertia_slope: T,
    /// −U′ + process (N·m).
    pub load: T,
    /// b (N·m·s/rad).
    pub viscous: T,
    /// c (N·m): its constant part, and the magnitude of the part that varies.
    pub coulomb: T,
}

impl<'a, T: Circular, const CURVES: Set, const TERMS: Set> HarmonicModel<'a, T, CURVES, TERMS> {
    /// Coefficients of each harmonic.
    const ROW: usize = word::row(CURVES, TERMS);

    /// A model with these coefficients, which lie as [`Coefficient::of_word`] says: the means, then harmonic after
    /// harmonic.
    ///
    /// J is shown to be positive everywhere: at 64 places its least value must exceed what J″ can take off between two
    /// of them, h²/8·Σ k²·(|aₖ| + |bₖ|), and the rounding; else 128, up to 4096 places are looked at.
    ///
    /// # Errors
    /// See [`CoefficientError`].
    pub fn new(words: &'a [T]) -> Result<Self, CoefficientError> {
        let model = Self::unproved(words)?;
        model.check_inertia()?;
        Ok(model)
    }

    /// As [`new`](Self::new), but J may be anything.
    fn unproved(words: &'a [T]) -> Result<Self, CoefficientError> {
        let count = word::means(CURVES);
        let length = CoefficientError::Length {
            given: words.len() as u32,
            means: count as u32,
            row: Self::ROW as u32,
        };
        let (head, rows) = words.split_at_checked(count).ok_or(length)?;
        let whole = rows.len() % Self::ROW.max(1) == 0 && (Self::ROW > 0 || rows.is_empty());
        if !whole || rows.len() > MAX_HARMONICS as usize * Self::ROW {
            return Err(length);
        }
        let most = T::from_f64(1e30);
        if let Some(word) = words.iter().position(|&w| !(w < most && w > -most)) {
            return Err(CoefficientError::Range { word: word as u32 });
        }
        let [zero, ..] = T::CONSTANTS;
        let mut given = head.iter().copied();
        let means = Curve::ALL.map(|curve| {
            let there = curve.is_in(CURVES);
            there.then(|| given.next()).flatten().unwrap_or(zero)
        });
        Ok(Self { means, rows })
    }

    fn check_inertia(&self) -> Result<(), CoefficientError> {
        let [zero, half, one] = T::CONSTANTS;
        let [mean, ..] = self.means;
        let (mut rounding, mut curvature, mut order) = (size(mean), zero, one);
        for row in self.rows() {
            let [a, b] = pair::<T, CURVES, TERMS>(&mut row.iter().copied(), 0);
            let amplitude = size(a.unwrap_or(zero)) + size(b.unwrap_or(zero));
            rounding = rounding + order * amplitude;
            curvature = curvature + order * order * amplitude;
            order = order + one;
        }
        rounding = rounding * T::ROUNDINGS;
        let [first, last] = PLACES;
        // (2π/places)²/8
        let mut share = T::from_f64(4.934_802_200_544_679 / (64.0 * 64.0));
        let mut places = first;
        loop {
            let (mut least, mut place) = (T::from_f64(1e38), Phase::default());
            for k in 0..places {
                let phase = Phase::from_bits(k * (u32::MAX / places + 1));
                let inertia = self.at(phase).inertia;
                if inertia <= zero {
                    return Err(CoefficientError::NoInertia { phase });
                }
                if inertia < least {
                    (least, place) = (inertia, phase);
                }
            }
            if least > curvature * share + rounding {
                return Ok(());
            }
            if places >= last {
                return Err(CoefficientError::InertiaNotShown { phase: place });
            }
            places *= 2;
            share = share * half * half;
        }
    }

    /// Number of harmonics n.
    #[must_use]
    pub const fn harmonics(&self) -> u32 {
        match (self.rows.len() as u32).checked_div(Self::ROW as u32) {
            Some(rows) => rows,
            None => 0,
        }
    }

    /// Coefficients, harmonic after harmonic.
    #[inline]
    fn rows(&self) -> core::slice::ChunksExact<'a, T> {
        // Without terms there is nothing to divide.
        self.rows
            .chunks_exact(const { Self::ROW + (Self::ROW == 0) as usize })
    }

    /// All curves at a phase.
    ///
    /// **Accuracy**: in `f64` 4e-15, in `f32` 4e-7 of the sum of the sizes of the coefficients, that of k·(|aₖ| + |bₖ|)
    /// for the slope, for up to 12 harmonics (test `evaluation_rounds_as_stated`).
    #[inline]
    #[must_use]
    pub fn at(&self, phase: Phase) -> Values<T> {
        let [zero, _, one] = T::CONSTANTS;
        let (sin, cos) = T::sin_cos_of(phase);
        let (mut s, mut c, mut order) = (sin, cos, one);
        let mut sums = [zero; 4];
        let mut slope = zero;
        for row in self.rows() {
            let mut words = row.iter().copied();
            let mut next = |curve| pair::<T, CURVES, TERMS>(&mut words, curve);
            let inertia = next(0);
            slope = match inertia {
                [Some(a), Some(b)] => slope + order * (b * c - a * s),
                [Some(a), None] => slope - order * (a * s),
                [None, Some(b)] => slope + order * (b * c),
                [None, None] => slope,
            };
            let wave = [c, s];
            add(&mut sums[0], inertia, wave);
            add(&mut sums[1], next(1), wave);
            add(&mut sums[2], next(2), wave);
            add(&mut sums[3], next(3), wave);
            (s, c) = (s * cos + c * sin, c * cos - s * sin);
            order = order + one;
        }
        Values {
            inertia: self.means[0] + sums[0],
            inertia_slope: slope,
            load: self.means[1] + sums[1],
            viscous: self.means[2] + sums[2],
            coulomb: size(self.means[3] + sums[3]) + self.means[4],
        }
    }

    /// Inverse dynamics: the torque on the drive link (N·m) that the motion (rad/s, rad/s²) needs, (7.12).
    #[inline]
    #[must_use]
    pub fn torque(&self, phase: Phase, omega: T, alpha: T) -> T {
        let values = self.at(phase);
        values.inertia * alpha + Self::resisting(&values, omega)
    }

    /// Forward dynamics: the acceleration (rad/s²) that a torque on the drive link (N·m) gives at a speed (rad/s).
    #[inline]
    #[must_use]
    pub fn acceleration(&self, phase: Phase, omega: T, torque: T) -> Outcome<T> {
        let values = self.at(phase);
        outcome((torque - Self::resisting(&values, omega)) / values.inertia)
    }

    /// The accelerations (rad/s²) that torques from `least` to `greatest` (N·m) can give at a speed (rad/s): as J is
    /// positive, those of the two ends, each as [`acceleration`](Self::acceleration) gives it.
    #[inline]
    #[must_use]
    pub fn acceleration_range(
        &self,
        phase: Phase,
        omega: T,
        least: T,
        greatest: T,
    ) -> AccelerationRange<T> {
        let values = self.at(phase);
        let resisting = Self::resisting(&values, omega);
        AccelerationRange {
            least: outcome((least - resisting) / values.inertia),
            greatest: outcome((greatest - resisting) / values.inertia),
        }
    }

    /// ½·J′·ω² − load + b·ω + c·sgn ω, of the curves that the machine has; sgn 0 = 0.
    #[inline]
    fn resisting(values: &Values<T>, omega: T) -> T {
        let [zero, half, _] = T::CONSTANTS;
        let mut sum = half * values.inertia_slope * (omega * omega);
        if Curve::Load.is_in(CURVES) {
            sum = sum - values.load;
        }
        if Curve::Viscous.is_in(CURVES) {
            sum = sum + values.viscous * omega;
        }
        if Curve::Coulomb.is_in(CURVES) || Curve::Constant.is_in(CURVES) {
            if omega > zero {
                sum = sum + values.coulomb;
            } else if omega < zero {
                sum = sum - values.coulomb;
            }
        }
        sum
    }
}

/// Floating point has room for every torque.
#[inline]
fn outcome<T>(value: T) -> Outcome<T> {
    Outcome {
        value,
        saturated: false,
    }
}

#[inline]
fn size<T: Circular>(x: T) -> T {
    if x < T::CONSTANTS[0] { -x } else { x }
}

/// The next coefficients of a curve, [cosine, sine], where it has them.
#[inline]
fn pair<T, const CURVES: Set, const TERMS: Set>(
    words: &mut impl Iterator<Item = T>,
    curve: u8,
) -> [Option<T>; 2] {
    let has = |term: Set| word::in_use(CURVES, TERMS) & (term << (2 * curve)) != 0;
    let a = if has(1) { words.next() } else { None };
    let b = if has(2) { words.next() } else { None };
    [a, b]
}

/// `sum` + a·c + b·s of the coefficients there are: a zero times an angle is not left out by the compiler.
#[inline]
fn add<T: Circular>(sum: &mut T, [a, b]: [Option<T>; 2], [c, s]: [T; 2]) {
    *sum = match (a, b) {
        (Some(a), Some(b)) => *sum + (a * c + b * s),
        (Some(a), None) => *sum + a * c,
        (None, Some(b)) => *sum + b * s,
        (None, None) => *sum,
    };
}
