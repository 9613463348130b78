//! From a machine to the fewest harmonics that meet a torque error.
//!
//! ```text
//! |δT| ≤ Σ over what was left out or rounded of  |δJₖ|·(α_max + ½·k·ω_max²) + |δloadₖ| + |δbₖ|·ω_max + |δcₖ|
//! ```
//!
//! with δₖ the amplitude √(aₖ² + bₖ²) of an omitted harmonic, or the rounding of a stored coefficient: a bound for all φ, not only for sampled
//! places. The harmonics beyond those that the samples determine are bounded by the decay of the terms before them.

use super::HarmonicError;
use super::spectrum::Spectrum;
use crate::curve::{
    Circular, Coefficient, Curve, Format, Harmonic, Kind, MAX_HARMONICS, Shape, Table, in_use,
    words_len,
};
use crate::error::Error;
use crate::machine::reducible::Reducible;
use crate::number::Number;
use crate::number::error::{RangeError, positive};
use crate::tabulate::{Request, edge_places, torque_between};
use crate::{AnyModel, CurveSet, Domain, Phase, math};

/// Largest torque of one unit of the k-th harmonic of a curve.
fn weight(request: &Request, curve: Curve, k: usize) -> f64 {
    match curve {
        Curve::Inertia => {
            request.max_acceleration + 0.5 * k as f64 * request.max_speed * request.max_speed
        }
        Curve::Viscous => request.max_speed,
        Curve::Load | Curve::Coulomb | Curve::Constant => 1.0,
    }
}

/// The figures of fitted harmonics.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct Fit {
    /// Number of harmonics.
    pub harmonics: u32,
    /// Number of coefficients.
    pub words: usize,
    /// Size in bytes.
    pub bytes: usize,
    /// Bound on the error of the drive torque (N·m) at every phase, except for the rounding of the evaluation. It assumes that the harmonics continue
    /// to fall beyond the samples; at edges the error is measured.
    pub bound: f64,
    /// Largest error of the drive torque (N·m) at the places checked, including the rounding of the evaluation.
    pub torque_error: f64,
    /// Position of the largest error (rad).
    pub worst: f64,
    /// Number of samples per turn.
    pub samples: u32,
}

/// Numbers of `f64` scratch for [`fit`]: 576 for up to 8 harmonics, 72 for each harmonic up to 16, 32, …
#[must_use]
pub const fn scratch_len(max_harmonics: u32) -> usize {
    Spectrum::scratch_len(max_harmonics)
}

/// The terms of the machine's curves of this set, with up to `max_harmonics` harmonics: a curve without cosines is odd except for its mean, one
/// without sines even. Terms below 1e-12 of a curve's magnitude count as rounding. `scratch` is as for [`fit`].
///
/// # Errors
/// The machine's errors; [`HarmonicError::Stroke`]; a buffer too short.
pub fn terms_in_use(
    machine: &impl Reducible,
    set: CurveSet,
    max_harmonics: u32,
    scratch: &mut [f64],
) -> Result<CurveSet, Error> {
    const ROUNDING: f64 = 1e-12;
    let mut spectrum = spectrum(machine, set, max_harmonics, scratch)?;
    while spectrum.can_grow() {
        spectrum.grow(machine)?;
    }
    let mut terms = 0;
    for (curve, bit) in Curve::ALL.into_iter().zip([8, 10, 12, 14]) {
        let limit = ROUNDING * spectrum.size(curve);
        for k in 1..=spectrum.samples() / 2 {
            let [a, b] = spectrum.coefficient(curve, k).map(|x| math::abs(x) > limit);
            terms |= (CurveSet::from(a) | CurveSet::from(b) << 1) << bit;
        }
    }
    Ok(in_use(set & 0xff | terms))
}

/// The curves of a machine that turns, not yet sampled.
fn spectrum<'s>(
    machine: &impl Reducible,
    set: CurveSet,
    max_harmonics: u32,
    scratch: &'s mut [f64],
) -> Result<Spectrum<'s>, Error> {
    if max_harmonics > MAX_HARMONICS {
        return Err(RangeError::OutOfRange {
            what: "most harmonics",
            value: f64::from(max_harmonics),
            min: 0.0,
            max: f64::from(MAX_HARMONICS),
        }
        .into());
    }
    if machine.domain() != Domain::Turn {
        return Err(HarmonicError::Stroke.into());
    }
    machine.check_repeats()?;
    Spectrum::new(scratch, max_harmonics, set)
}

/// Finds the fewest harmonics of these curves and terms that meet the request, fills `words` with their coefficients, and returns their figures.
/// Curves of the machine that are not in the set count as error.
///
/// Coulomb friction F·|v′| becomes F·v′, which is smooth, if its magnitude has kinks only at zero; with `CONSTANT_COULOMB` in the set the value at φ
/// = 0 is subtracted first.
///
/// The 32 samples per turn at first are doubled until the terms after the stored harmonics have fallen so far that the rest, which no sample shows,
/// is bounded. Then the error is measured, in `T`, at 4·N + 1 other places.
///
/// **Accuracy**: `bound` and `torque_error` do not exceed the request; coefficients of a series are found to 1e-14 of its magnitude (test
/// `a_series_comes_back`). **Cost**: `samples` reductions, and four times as many for each number of harmonics that is checked; below 0.1 ms for a
/// slider-crank on a host (`docs/harmonics.md`).
///
/// # Errors
/// [`HarmonicError::Stroke`]; [`HarmonicError::NotConverged`], in particular for a curve with a kink; [`TableError`](crate::table::TableError) if J
/// cannot be proven positive between the samples; [`PoseError::NoInertia`](crate::machine::PoseError::NoInertia) if it is not positive at one;
/// buffers too short; the machine's errors.
pub fn fit<T: Circular + Number>(
    machine: &impl Reducible,
    set: CurveSet,
    request: &Request,
    scratch: &mut [f64],
    words: &mut [T],
) -> Result<Fit, Error>
where
    Harmonic<T>: Format<Number = T, Word = T, Constants = ()>,
{
    positive("torque error", request.torque_error)?;
    positive("largest speed", request.max_speed)?;
    positive("largest acceleration", request.max_acceleration)?;
    let max = request.max_cells;
    let mut spectrum = spectrum(machine, set, max, scratch)?;
    let (needed, given) = (words_len::<Harmonic<T>>(max, set), words.len());
    if given < needed {
        return Err(RangeError::BufferTooShort { needed, given }.into());
    }
    let mut reached = (f64::INFINITY, 0);
    while spectrum.can_grow() {
        spectrum.grow(machine)?;
        let samples = spectrum.samples();
        let unseen = unseen(&spectrum, request).unwrap_or(f64::INFINITY);
        let most = max.min(samples as u32 / 4);
        for harmonics in 0..=most {
            let left_out = left_out::<T>(&spectrum, request, set, harmonics as usize);
            // Terms beyond the samples' resolution are missing, and alias into others.
            let bound = left_out + 2.0 * unseen;
            let last = harmonics == most && !spectrum.can_grow();
            if bound > request.torque_error && !last {
                continue;
            }
            let count = words_len::<Harmonic<T>>(harmonics, set);
            let words = words.get_mut(..count).unwrap_or_default();
            fill(&spectrum, set, words);
            let table = Table::<Harmonic<T>>::new(words, Shape::harmonics(harmonics, set))
                .map_err(Error::Table)?;
            let (torque_error, worst) = measure(machine, &table, request, 4 * samples as u32 + 1)?;
            if torque_error < reached.0 {
                reached = (torque_error, harmonics);
            }
            if torque_error <= request.torque_error && bound <= request.torque_error {
                AnyModel::new(table).map_err(Error::Table)?;
                return Ok(Fit {
                    bound: bound.max(torque_error),
                    harmonics,
                    words: count,
                    bytes: count * size_of::<T>(),
                    torque_error,
                    worst,
                    samples: samples as u32,
                });
            }
            // An error this much larger than its bound comes from rounding, or from a term that the samples missed.
            if torque_error > 16.0 * bound {
                break;
            }
        }
    }
    Err(HarmonicError::NotConverged {
        asked: request.torque_error,
        reached: reached.0,
        harmonics: reached.1,
    }
    .into())
}

/// The largest error of the drive torque (N·m) within the range of the request, in the table's own arithmetic, at `places` places of a turn (an odd
/// number, so that they do not coincide with samples) and at the [`edge_places`], and its position (rad).
///
/// # Errors
/// The machine's errors.
pub fn measure<F: Format>(
    machine: &impl Reducible,
    table: &Table<'_, F>,
    request: &Request,
    places: u32,
) -> Result<(f64, f64), Error> {
    let mut worst = (0.0, 0.0);
    let even =
        (0..u64::from(places)).map(|k| Phase::from_bits(((k << 32) / u64::from(places)) as u32));
    for phase in even.chain(edge_places(machine).map(Phase::from_radians)) {
        let exact = machine.reduction(phase.radians())?;
        let error = torque_between(request, &table.si(phase, Domain::Turn), &exact);
        if error > worst.0 {
            worst = (error, phase.radians());
        }
    }
    Ok(worst)
}

/// √(a² + b²)
fn amplitude([a, b]: [f64; 2]) -> f64 {
    math::sqrt(a * a + b * b)
}

/// The sampled part of the bound: omitted harmonics and kinds, and the rounding of the rest to `T`.
fn left_out<T: Circular>(
    spectrum: &Spectrum<'_>,
    request: &Request,
    set: CurveSet,
    harmonics: usize,
) -> f64 {
    let rounding = |x: f64| x - T::from_f64(x).to_f64();
    let mut sum = 0.0;
    for curve in Curve::ALL {
        let kinds = in_use(set) >> 8 >> (2 * curve as u8);
        for k in 0..=spectrum.samples() / 2 {
            let [a, b] = spectrum.coefficient(curve, k);
            let (cosine, sine) = if k == 0 {
                (curve.is_in(set), true)
            } else {
                let kept = k <= harmonics;
                (kept && kinds & 1 != 0, kept && kinds & 2 != 0)
            };
            let missing = [
                if cosine { rounding(a) } else { a },
                if sine { rounding(b) } else { b },
            ];
            sum += weight(request, curve, k) * amplitude(missing);
        }
    }
    sum
}

/// A bound on the terms that N samples do not resolve, from the sums of the terms between N/8 and N/4 and between N/4 and N/2. Terms that fall like a
/// power of k keep the ratio q of such sums; those of smooth curves fall faster: the terms after the last sum are at most q/(1 − q) of it. They also
/// alias into the last sum, by up to half of it at the slowest accepted decay, k^−2.5; hence the factor 2. `None` if the terms fall more slowly, as
/// with a kink, unless they are rounding.
fn unseen(spectrum: &Spectrum<'_>, request: &Request) -> Option<f64> {
    const SLOWEST: f64 = 0.27;
    let samples = spectrum.samples();
    let sum = |range: core::ops::RangeInclusive<usize>, term: &dyn Fn(Curve, usize) -> f64| {
        let terms = range.flat_map(|k| Curve::ALL.map(|c| weight(request, c, k) * term(c, k)));
        terms.sum::<f64>()
    };
    let size = |curve, k| amplitude(spectrum.coefficient(curve, k));
    let last = sum(samples / 4 + 1..=samples / 2, &size);
    let before = sum(samples / 8 + 1..=samples / 4, &size);
    let sizes = Curve::ALL.map(|curve| spectrum.size(curve));
    let rounding = sum(samples / 4 + 1..=samples / 2, &|curve, _| {
        4.0 * f64::EPSILON * sizes[curve as usize]
    });
    if last <= rounding {
        return Some(last);
    }
    let ratio = last / before;
    (ratio <= SLOWEST).then(|| 2.0 * last * ratio / (1.0 - ratio))
}

/// The coefficients, in the order of [`Coefficient::of_word`].
fn fill<T: Circular>(spectrum: &Spectrum<'_>, set: CurveSet, words: &mut [T]) {
    for (word, slot) in words.iter_mut().enumerate() {
        if let Some(Coefficient { curve, kind }) = Coefficient::of_word(word, set) {
            *slot = T::from_f64(match kind {
                Kind::Mean => spectrum.coefficient(curve, 0)[0],
                Kind::Cosine(k) => spectrum.coefficient(curve, k as usize)[0],
                Kind::Sine(k) => spectrum.coefficient(curve, k as usize)[1],
            });
        }
    }
}
