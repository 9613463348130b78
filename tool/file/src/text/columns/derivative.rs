//! Whether a column can be the derivative of another one.

use super::Columns;
use crate::number::rounding::short;
use crate::text::problem::{Problem, Result};

/// Rows from which the trapezoidal rule is close for any curve that is a table.
const MANY: usize = 20;

/// The range of the way by the derivative in shares of the way itself; the lower end with many rows only, for few can all be dead centres.
const SHARES: [f64; 2] = [0.4, 3.0];

impl Columns {
    /// Checks that column `slope` can be the derivative of column `of` over `x`, all in SI units: the way ∫|s′|·dx by the trapezoidal rule is about the
    /// way Σ|Δs|. A wrong unit of an angle is a factor of 57.
    ///
    /// # Errors
    /// It cannot.
    pub(crate) fn check_slope(&self, of: usize, slope: usize, x: &[f64]) -> Result<()> {
        let (Some(values), Some(slopes)) = (self.get(of), self.get(slope)) else {
            return Ok(());
        };
        let way: f64 = values.windows(2).map(|s| (s[1] - s[0]).abs()).sum();
        let pairs = x.windows(2).zip(slopes.windows(2));
        let by_slope: f64 = pairs
            .map(|(x, v)| 0.5 * (x[1] - x[0]) * (v[0].abs() + v[1].abs()))
            .sum();
        let [low, high] = SHARES;
        let low = if values.len() >= MANY { low } else { 0.0 };
        if way == 0.0 && by_slope == 0.0 || (low * way..=high * way).contains(&by_slope) {
            return Ok(());
        }
        let header = |index: usize| self.headers.get(index).map_or("", |(header, _)| header);
        let ratio = if way == 0.0 {
            "infinitely".to_owned()
        } else {
            format!("{} times", short(by_slope / way))
        };
        Err(Problem::new(format!(
            "the column \"{}\" is not the derivative of \"{}\": its integral is {ratio} as long",
            header(slope),
            header(of)
        ))
        .at(self.place(0), "first row")
        .help("check both units: per degree and per radian differ by 57.3; or leave the derivatives out with `columns`"))
    }
}
