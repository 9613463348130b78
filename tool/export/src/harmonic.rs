//! The fewest harmonics that meet a torque error, or the most accurate ones for their bytes.

use jred::error::Error;
use jred::harmonic::{self, MAX_HARMONICS, fit, scratch_len, terms_in_use};
use jred::image::image_len;
use jred::number::RangeError;
use jred::table::{Shape, Table, Usage, words_len};
use jred::tabulate::{Request, TableFigures};
use jred::{CurveSet, Harmonic, Scale};

use crate::candidate::{RangeTable, SearchResult};
use crate::search::Search;

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
        let (looked, _) = self.torque_error(&table, 0, f64::INFINITY);
        let usage = Usage::of(&table).map_err(Error::Table)?;
        let mut found = TableFigures::default();
        found.cells = fitted.harmonics;
        found.bound = fitted.bound.max(measured);
        (found.torque_error, found.worst) = (measured, worst);
        self.with_image(&table, usage, Scale::SI, found, looked)
    }
}
