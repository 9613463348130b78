//! What a search needs of a number type and layout: the tables of [`jred::Model`], and those of 16-bit rows.

use std::marker::PhantomData;

use jred::table::Layout;
use jred::tabulate::{self, Request, Tabulated};
use jred::{Error, Image, Scalar, Scale, Usage, Validity, short};

use super::reference::Curves;
use super::search::Search;
use super::ticks::{self, Ticks};

/// A size to look at.
pub(super) struct Size<'s> {
    pub(super) search: &'s Search<'s>,
    pub(super) set: u8,
    pub(super) cells: u32,
    pub(super) scale: Scale,
}

/// A table with its image.
pub(super) struct Made {
    pub(super) found: Tabulated,
    /// The largest torque error: of what was measured place by place, and of the ticks.
    pub(super) error: f64,
    pub(super) usage: Usage,
    pub(super) ticks: Ticks,
    pub(super) row_bytes: usize,
    pub(super) words: Vec<u32>,
}

/// A number type and layout.
pub(super) trait Kind {
    /// What tables are made in.
    type Buffers: Default;
    /// Whether a table may have a curve of 1/J.
    const RECIPROCAL: bool;

    /// Bytes of an image.
    fn bytes(cells: u32, set: u8) -> usize;

    /// The machine units for so many cells over `span`.
    fn scale(scale: Scale, cells: u32, span: f64) -> Scale;

    /// The largest torque error at the places of the reference, and where: see [`Reference::error`](super::reference::Reference).
    fn look(
        size: &Size<'_>,
        buffers: &mut Self::Buffers,
        from: (usize, f64),
    ) -> Result<(f64, usize), Error>;

    /// The table and its image, if the table meets the request everywhere, its ticks included; `looked` is what
    /// [`look`](Self::look) has found.
    fn make(
        size: &Size<'_>,
        buffers: &mut Self::Buffers,
        request: &Request,
        looked: f64,
    ) -> Result<Option<Made>, Error>;
}

/// Tables of [`jred::Model`].
pub(super) struct Long<S, L>(PhantomData<(S, L)>);

/// Numbers that a table is made of.
pub(super) struct Buffers<W> {
    scratch: Vec<f64>,
    words: Vec<W>,
}

impl<W> Default for Buffers<W> {
    fn default() -> Self {
        Self {
            scratch: Vec::new(),
            words: Vec::new(),
        }
    }
}

impl<S: Scalar, L: Layout> Long<S, L> {
    /// The table of this size, checked for the tick, and what it uses of the number range.
    fn fill<'w>(
        size: &Size<'_>,
        buffers: &'w mut Buffers<S::Word>,
    ) -> Result<(jred::Table<'w, S, L>, Usage), Error> {
        let zero = bytemuck::Zeroable::zeroed();
        let Size {
            search,
            set,
            cells,
            scale,
        } = size;
        let Buffers { scratch, words } = buffers;
        scratch.resize(tabulate::scratch_len(*cells, *set), 0.0);
        words.resize(tabulate::words_len::<L>(*cells, *set), zero);
        let table = tabulate::fill::<S, L>(&search.knots, *set, *cells, scale, scratch, words)?;
        let span = S::span(search.domain);
        let usage = Usage::of(&table, span, scale).map_err(Error::Table)?;
        Ok((table, usage))
    }
}

impl<S: Scalar, L: Layout> Kind for Long<S, L> {
    type Buffers = Buffers<S::Word>;
    const RECIPROCAL: bool = S::FIXED;

    fn bytes(cells: u32, set: u8) -> usize {
        4 * jred::image_words::<S, L>(cells, set)
    }

    fn scale(scale: Scale, cells: u32, span: f64) -> Scale {
        if S::FIXED {
            scale.for_cells(cells, span)
        } else {
            scale
        }
    }

    fn look(
        size: &Size<'_>,
        buffers: &mut Self::Buffers,
        from: (usize, f64),
    ) -> Result<(f64, usize), Error> {
        let (table, _) = Self::fill(size, buffers)?;
        let reference = &size.search.reference;
        let [torque, speed, inertia] = [
            size.scale.torque(),
            size.scale.speed(),
            size.scale.inertia(),
        ]
        .map(f64::from);
        let per_position = f64::from(size.cells) / size.search.domain.span();
        let read = |phase| {
            let read = table.at(phase);
            Curves {
                inertia: read.inertia.to_f64() * inertia,
                slope: read.inertia_slope.to_f64() * inertia * per_position,
                load: read.load.to_f64() * torque,
                viscous: read.viscous.to_f64() * torque / speed,
                coulomb: read.coulomb.to_f64() * torque,
            }
        };
        Ok(reference.error(read, size.search.goal.range, from))
    }

    fn make(
        size: &Size<'_>,
        buffers: &mut Self::Buffers,
        request: &Request,
        looked: f64,
    ) -> Result<Option<Made>, Error> {
        let Size {
            search,
            set,
            cells,
            scale,
        } = size;
        let (table, usage) = Self::fill(size, buffers)?;
        let found = tabulate::measure(search.machine, &table, request, scale)?;
        if found.bound > request.torque_error {
            return Ok(None);
        }
        let mut words = vec![0; jred::image_words::<S, L>(*cells, *set)];
        let mut encode = |error: f64| {
            let validity = validity(&found, request, error);
            jred::encode(&table, search.domain, scale, validity, &mut words).map(<[u32]>::to_vec)
        };
        let image = encode(found.bound)?;
        let image = Image::new(&image).map_err(ticks::refusal)?;
        let ticks = ticks::measure::<S, L>(&image, &search.reference, search.goal.range)?;
        let error = found.bound.max(looked).max(ticks.torque);
        if error > request.torque_error {
            return Ok(None);
        }
        let words = encode(error)?;
        Ok(Some(Made {
            found,
            error,
            usage,
            ticks,
            row_bytes: size_of_val(table.words()),
            words,
        }))
    }
}

/// Tables of 16-bit rows.
pub(super) struct Short;

impl Short {
    fn fill<'w>(size: &Size<'_>, buffers: &'w mut Buffers<u32>) -> Result<short::Table<'w>, Error> {
        let Size {
            search,
            set,
            cells,
            scale,
        } = size;
        let Buffers { scratch, words } = buffers;
        scratch.resize(short::scratch_len(*cells, *set), 0.0);
        words.resize(short::words_len(*cells, *set), 0);
        short::fill(&search.knots, *set, *cells, scale, scratch, words)
    }
}

impl Kind for Short {
    type Buffers = Buffers<u32>;
    const RECIPROCAL: bool = true;

    fn bytes(cells: u32, set: u8) -> usize {
        4 * short::image_words(cells, set)
    }

    fn scale(scale: Scale, _: u32, _: f64) -> Scale {
        scale
    }

    fn look(
        size: &Size<'_>,
        buffers: &mut Self::Buffers,
        from: (usize, f64),
    ) -> Result<(f64, usize), Error> {
        let table = Self::fill(size, buffers)?;
        let [torque, speed, inertia] = [
            size.scale.torque(),
            size.scale.speed(),
            size.scale.inertia(),
        ]
        .map(f64::from);
        let read = |phase| {
            let read = table.at(phase);
            Curves {
                inertia: read.inertia * inertia,
                slope: 2.0 * read.velocity * torque / (speed * speed),
                load: read.load * torque,
                viscous: read.viscous * torque / speed,
                coulomb: read.coulomb * torque,
            }
        };
        let range = size.search.goal.range;
        Ok(size.search.reference.error(read, range, from))
    }

    fn make(
        size: &Size<'_>,
        buffers: &mut Self::Buffers,
        request: &Request,
        looked: f64,
    ) -> Result<Option<Made>, Error> {
        let Size {
            search,
            set,
            cells,
            scale,
        } = size;
        let table = Self::fill(size, buffers)?;
        let found = short::measure(search.machine, &table, request, scale)?;
        if found.bound > request.torque_error {
            return Ok(None);
        }
        let mut words = vec![0; short::image_words(*cells, *set)];
        let mut encode = |error: f64| {
            let validity = validity(&found, request, error);
            short::encode(&table, search.domain, scale, validity, &mut words).map(<[u32]>::to_vec)
        };
        let image = encode(found.bound)?;
        let image = Image::new(&image).map_err(ticks::refusal)?;
        let ticks = ticks::measure_short(&image, &search.reference, search.goal.range)?;
        let error = found.bound.max(looked).max(ticks.torque);
        if error > request.torque_error {
            return Ok(None);
        }
        let words = encode(error)?;
        Ok(Some(Made {
            found,
            error,
            usage: short::usage(&table),
            ticks,
            row_bytes: size_of_val(table.words()),
            words,
        }))
    }
}

/// What the image says of itself: the error in single precision, not rounded down.
fn validity(found: &Tabulated, request: &Request, error: f64) -> Validity {
    let nearest = error as f32;
    let torque_error = if f64::from(nearest) < error {
        nearest.next_up()
    } else {
        nearest
    };
    Validity {
        torque_error,
        ..found.validity(request)
    }
}
