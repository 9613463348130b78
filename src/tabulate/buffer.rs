//! A table and its memory.

use super::{Request, TableFigures, fill, tabulate};
use crate::curve::{CurveSet, Format, words_len};
use crate::error::Error;
use crate::machine::Reducible;
use crate::{Model, Scale};

/// Memory for tables of up to `CELLS` cells and `WORDS` words, for firmware that makes its own tables. Filling it returns the model over it.
///
/// ```
/// use jred::mechanism::{ScotchYoke, ScotchYokeDimensions};
/// # use core::f64::consts::FRAC_PI_2;
/// use jred::error::Error;
/// use jred::machine::{Link, Machine};
/// use jred::table::words_len;
/// use jred::tabulate::{TableBuffer, scratch_len};
/// use jred::{CurveSet, Phase, Scale, Spline, curves};
///
/// const SET: CurveSet = curves::INERTIA;
/// const CELLS: u32 = 32;
/// const WORDS: usize = words_len::<Spline<f32>>(CELLS, SET);
///
/// fn main() -> Result<(), Error> {
///     let dimensions = ScotchYokeDimensions { crank: 0.05, slot_angle: FRAC_PI_2 };
///     let yoke = ScotchYoke::new(dimensions, [Link::rotor(0.002)?, Link::point_mass(1.5)?])?;
///     let machine = Machine::new(yoke);
///     let mut scratch = [0.0; scratch_len(CELLS, SET)];
///     let mut buffer = TableBuffer::<Spline<f32>, SET, CELLS, WORDS>::new();
///     let model = buffer.fill(&machine, CELLS, &Scale::SI, &mut scratch)?;
///     assert!(model.torque(Phase::default(), 0.0, 1.0) > 0.0);
///     Ok(())
/// }
/// ```
///
/// A length other than the table's does not compile. 32 cells take 35 control points of J and 35 of the load:
///
/// ```
/// # use jred::tabulate::TableBuffer;
/// # use jred::{Spline, curves};
/// let buffer = TableBuffer::<Spline<f32>, { curves::LOAD }, 32, 70>::new();
/// ```
///
/// ```compile_fail,E0080
/// # use jred::tabulate::TableBuffer;
/// # use jred::{Spline, curves};
/// let buffer = TableBuffer::<Spline<f32>, { curves::LOAD }, 32, 35>::new();
/// ```
///
/// Nor does refilling it while the model over the last table is in use:
///
/// ```
/// # use jred::error::Error;
/// # use jred::machine::Machine;
/// # use jred::tabulate::TableBuffer;
/// # use jred::{Phase, Scale, Spline};
/// # type Buffer = TableBuffer::<Spline<f32>, 0, 32, 35>;
/// # fn twice(buffer: &mut Buffer, machine: &impl jred::machine::Reducible, scratch: &mut [f64]) -> Result<f32, Error> {
/// let before = buffer.fill(machine, 32, &Scale::SI, scratch)?.torque(Phase::default(), 0.0, 1.0);
/// let after = buffer.fill(machine, 32, &Scale::SI, scratch)?.torque(Phase::default(), 0.0, 1.0);
/// # Ok(after - before)
/// # }
/// ```
///
/// ```compile_fail,E0499
/// # use jred::error::Error;
/// # use jred::machine::Machine;
/// # use jred::tabulate::TableBuffer;
/// # use jred::{Phase, Scale, Spline};
/// # type Buffer = TableBuffer::<Spline<f32>, 0, 32, 35>;
/// # fn twice(buffer: &mut Buffer, machine: &impl jred::machine::Reducible, scratch: &mut [f64]) -> Result<f32, Error> {
/// let before = buffer.fill(machine, 32, &Scale::SI, scratch)?;
/// let after = buffer.fill(machine, 32, &Scale::SI, scratch)?;
/// # Ok(after.torque(Phase::default(), 0.0, 1.0) - before.torque(Phase::default(), 0.0, 1.0))
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct TableBuffer<F: Format, const SET: CurveSet, const CELLS: u32, const WORDS: usize> {
    words: [F::Word; WORDS],
}

impl<F: Format, const SET: CurveSet, const CELLS: u32, const WORDS: usize>
    TableBuffer<F, SET, CELLS, WORDS>
{
    /// Empty.
    #[must_use]
    pub fn new() -> Self {
        const {
            assert!(
                WORDS == words_len::<F>(CELLS, SET),
                "WORDS must be words_len::<F>(CELLS, SET)"
            );
        }
        Self {
            words: [F::Word::default(); WORDS],
        }
    }

    /// The model over a table of exactly `cells` cells.
    ///
    /// # Errors
    /// As [`fill`](fill()), and as [`Model::new`].
    pub fn fill(
        &mut self,
        machine: &impl Reducible,
        cells: u32,
        scale: &Scale,
        scratch: &mut [f64],
    ) -> Result<Model<'_, F, SET>, Error> {
        let table = fill::<F>(machine, SET, cells, scale, scratch, &mut self.words)?;
        Model::new(table).map_err(Error::Table)
    }

    /// The model over the smallest table of up to `CELLS` cells that meets the request, and its figures.
    ///
    /// # Errors
    /// As [`tabulate`](tabulate()).
    pub fn tabulate(
        &mut self,
        machine: &impl Reducible,
        request: &Request,
        scale: &Scale,
        scratch: &mut [f64],
    ) -> Result<(Model<'_, F, SET>, TableFigures), Error> {
        let request = request.with_max_cells(request.max_cells.min(CELLS));
        let found = tabulate::<F>(machine, SET, &request, scale, scratch, &mut self.words)?;
        let model = self.fill(machine, found.cells, &found.scale, scratch)?;
        Ok((model, found))
    }
}

impl<F: Format, const SET: CurveSet, const CELLS: u32, const WORDS: usize> Default
    for TableBuffer<F, SET, CELLS, WORDS>
{
    fn default() -> Self {
        Self::new()
    }
}
