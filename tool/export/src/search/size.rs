//! One size of a table of one format: evaluated, made, and ticked.

use jred::error::Error;
use jred::image::{Validity, encode, image_len};
use jred::table::{Format, Table, Usage, words_len};
use jred::tabulate::{self, Request, TableFigures};
use jred::{CurveSet, Image, Scale};

use crate::candidate::RangeTable;
use crate::search::Search;
use crate::ticks;

/// A size to evaluate.
pub(super) struct Size<'s> {
    pub(super) search: &'s Search<'s>,
    pub(super) set: CurveSet,
    pub(super) cells: u32,
    pub(super) scale: Scale,
}

/// Buffers for the numbers of a table.
pub(super) struct Buffers<F: Format> {
    scratch: Vec<f64>,
    words: Vec<F::Word>,
}

impl<F: Format> Default for Buffers<F> {
    fn default() -> Self {
        Self {
            scratch: Vec::new(),
            words: Vec::new(),
        }
    }
}

/// Bytes of an image.
pub(super) fn bytes<F: Format>(cells: u32, set: CurveSet) -> usize {
    4 * image_len::<F>(cells, set)
}

impl Size<'_> {
    /// The table of this size.
    fn fill<'w, F: Format>(&self, buffers: &'w mut Buffers<F>) -> Result<Table<'w, F>, Error> {
        let Self {
            search,
            set,
            cells,
            scale,
        } = self;
        let Buffers { scratch, words } = buffers;
        scratch.resize(tabulate::scratch_len(*cells, *set), 0.0);
        words.resize(words_len::<F>(*cells, *set), F::Word::default());
        tabulate::fill::<F>(&search.knots, *set, *cells, scale, scratch, words)
    }

    /// The largest torque error at the places of the reference, and its index: see [`Reference::error`](crate::reference::Reference). A table within
    /// the limit is sound: no tick of it leaves the number range.
    pub(super) fn look<F: Format>(
        &self,
        buffers: &mut Buffers<F>,
        start: usize,
        limit: f64,
    ) -> Result<(f64, usize), Error> {
        let table = self.fill(buffers)?;
        let found = self.search.torque_error(&table, start, limit);
        if found.0 <= limit {
            Usage::of(&table).map_err(Error::Table)?;
        }
        Ok(found)
    }

    /// The table and its image, if it meets the request everywhere, including its ticks; `looked` is the result of [`look`](Self::look).
    pub(super) fn make<F: Format>(
        &self,
        buffers: &mut Buffers<F>,
        request: &Request,
        looked: f64,
    ) -> Result<Option<RangeTable>, Error> {
        let search = self.search;
        let table = self.fill(buffers)?;
        let usage = Usage::of(&table).map_err(Error::Table)?;
        let found = tabulate::measure(&search.machine, &table, request)?;
        if found.bound > request.torque_error {
            return Ok(None);
        }
        let mut made = search.with_image(&table, usage, self.scale, found, looked)?;
        if made.error > request.torque_error {
            return Ok(None);
        }
        made.found.worst = search.machine.position(made.found.worst);
        made.ticks.worst = search.machine.position(made.ticks.worst);
        Ok(Some(made))
    }

    /// The torque error of a table in double precision, that is, without rounding, and its position.
    pub(super) fn without_rounding<F: Format>(&self) -> Result<(f64, f64), Error> {
        let (error, index) = self.look::<F>(&mut Buffers::default(), 0, f64::INFINITY)?;
        let worst = self.search.reference.places.get(index);
        Ok((
            error,
            worst.map_or(0.0, |place| self.search.machine.position(place.phi)),
        ))
    }
}

impl Search<'_> {
    /// The largest torque error of a table at the places of the reference, and its index: see
    /// [`Reference::error`](crate::reference::Reference::error).
    pub(crate) fn torque_error<F: Format>(
        &self,
        table: &Table<'_, F>,
        start: usize,
        limit: f64,
    ) -> (f64, usize) {
        let read = |phase| table.si(phase, self.domain);
        self.reference.error(read, self.goal.range, start, limit)
    }

    /// A table with its image, whose error is the largest of `found.bound`, `looked` and that of its ticks.
    pub(crate) fn with_image<F: Format>(
        &self,
        table: &Table<'_, F>,
        usage: Usage,
        scale: Scale,
        found: TableFigures,
        looked: f64,
    ) -> Result<RangeTable, Error> {
        let [omega, alpha] = self.goal.range;
        let mut words = vec![0; image_len::<F>(table.cells(), table.set())];
        let mut image = |error: f64| {
            let validity = Validity {
                max_speed: omega as f32,
                max_acceleration: alpha as f32,
                torque_error: rounded_up(error),
            };
            encode(table, validity, &mut words).map(<[u32]>::to_vec)
        };
        let made = image(found.bound)?;
        let made = Image::new(&made).map_err(ticks::refusal)?;
        let ticks = ticks::measure::<F>(&made, &self.reference, self.goal.range)?;
        let error = found.bound.max(looked).max(ticks.torque);
        Ok(RangeTable {
            range: self.machine.ends(),
            curves: table.set(),
            found,
            error,
            looked,
            ticks,
            usage,
            scale,
            row_bytes: size_of_val(table.words()),
            proof: None,
            words: image(error)?,
        })
    }
}

/// Converts to single precision, rounding up.
pub(crate) fn rounded_up(error: f64) -> f32 {
    let nearest = error as f32;
    if f64::from(nearest) < error {
        nearest.next_up()
    } else {
        nearest
    }
}
