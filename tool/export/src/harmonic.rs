//! The fewest harmonics that meet a torque error, or the most accurate ones for their bytes.

use jred::error::Error;
use jred::harmonic::{self, MAX_HARMONICS, fit, scratch_len, terms_in_use};
use jred::image::{Validity, encode, image_len};
use jred::machine::Reducible as _;
use jred::number::RangeError;
use jred::table::{Shape, Table, Usage, words_len};
use jred::tabulate::{Request, TableFigures};
use jred::{CurveSet, Harmonic, Image, Scale};

use crate::candidate::{RangeTable, SearchResult};
use crate::search::Search;
use crate::search::rounded_up;
use crate::ticks;

type F = Harmonic<f32>;

/// How often the required error is reduced because ticks in single precision exceed the allowed one.
const ATTEMPTS: u32 = 8;

impl Search<'_> {
    /// The harmonics of this range.
    ///
    /// # Errors
    /// Errors of the machine.
    pub(crate) fn harmonics(&self) -> Result<SearchResult<RangeTable>, Error> {
        let most = self.goal.max_cells.min(MAX_HARMONICS);
        let mut scratch = vec![0.0; scratch_len(most)];
        let set = match terms_in_use(&self.machine, self.set, most, &mut scratch) {
            Ok(terms) => self.set | terms,
            // A stroke.
            Err(error @ Error::Harmonic(_)) => return Ok(SearchResult::Refused(error)),
            Err(error) => return Err(error),
        };
        let bytes = |harmonics: u32| 4 * image_len::<F>(harmonics, set);
        let fits = |harmonics: &u32| {
            self.goal
                .max_bytes
                .is_none_or(|most| bytes(*harmonics) <= most)
        };
        let Some(most) = (0..=most).rev().find(fits) else {
            return Ok(SearchResult::TooLarge(bytes(0)));
        };
        // Without a limit on the torque error, the tolerance starts at the largest torque and is halved until even the most harmonics miss it.
        // With a limit it is reduced slightly, repeatedly.
        let [omega, alpha] = self.goal.range;
        let peak = |place: &crate::reference::ReferencePoint| {
            place.exact.torque(omega, alpha).total().abs()
        };
        let peaks = self.reference.places.iter().map(peak);
        let allowed = self.goal.torque_error;
        let (mut asked, less, attempts) = match allowed {
            Some(allowed) => (allowed, 0.8, ATTEMPTS),
            None => (peaks.fold(0.0, f64::max), 0.5, u32::MAX),
        };
        let (mut best, mut refused): (Option<RangeTable>, _) = (None, None);
        for _ in 0..attempts {
            match self.fitted(set, most, asked) {
                Ok(found) if allowed.is_some_and(|allowed| found.error <= allowed) => {
                    return Ok(SearchResult::Meets(Box::new(found)));
                }
                Ok(found) => {
                    if best.as_ref().is_none_or(|best| found.error < best.error) {
                        best = Some(found);
                    }
                }
                Err(error @ (Error::Harmonic(_) | Error::Table(_))) => {
                    refused = Some(error);
                    break;
                }
                Err(error) => return Err(error),
            }
            asked *= less;
        }
        let sound = RangeError::NotFinite("torque error of the harmonics");
        Ok(match (best, allowed) {
            (None, _) => SearchResult::Refused(refused.unwrap_or(sound.into())),
            (Some(best), None) => SearchResult::Meets(Box::new(best)),
            (Some(best), Some(_)) => SearchResult::Misses(Box::new(best)),
        })
    }

    /// The fewest harmonics whose coefficients meet this error, and the accuracy of their ticks.
    fn fitted(&self, set: CurveSet, most: u32, torque_error: f64) -> Result<RangeTable, Error> {
        let [omega, alpha] = self.goal.range;
        let request = Request::new(torque_error)
            .with_max_speed(omega)
            .with_max_acceleration(alpha)
            .with_max_cells(most);
        let mut scratch = vec![0.0; scratch_len(most)];
        let mut words = vec![0.0; words_len::<F>(most, set)];
        let fitted = fit::<f32>(&self.machine, set, &request, &mut scratch, &mut words)?;
        words.truncate(fitted.words);
        let table = Table::<F>::new(&words, Shape::harmonics(fitted.harmonics, set))
            .map_err(Error::Table)?;
        let places = 4 * fitted.samples + 1;
        let (measured, worst) = harmonic::measure(&self.machine, &table, &request, places)?;
        let domain = self.machine.domain();
        let read = |phase| table.si(phase, domain);
        let (looked, _) = self
            .reference
            .error(read, self.goal.range, 0, f64::INFINITY);
        let mut image = vec![0; image_len::<F>(fitted.harmonics, set)];
        let mut written = |error: f64| {
            let validity = Validity {
                max_speed: omega as f32,
                max_acceleration: alpha as f32,
                torque_error: rounded_up(error),
            };
            encode(&table, validity, &mut image).map(<[u32]>::to_vec)
        };
        let bound = fitted.bound.max(measured);
        let made = written(bound)?;
        let made = Image::new(&made).map_err(ticks::refusal)?;
        let ticks = ticks::measure::<F>(&made, &self.reference, self.goal.range)?;
        let error = bound.max(looked).max(ticks.torque);
        let mut found = TableFigures::default();
        found.cells = fitted.harmonics;
        (found.torque_error, found.bound, found.worst) = (measured, bound, worst);
        Ok(RangeTable {
            range: self.machine.ends(),
            curves: set,
            found,
            error,
            looked,
            ticks,
            usage: Usage::of(&table).map_err(Error::Table)?,
            scale: Scale::SI,
            row_bytes: fitted.bytes,
            proof: None,
            words: written(error)?,
        })
    }
}
