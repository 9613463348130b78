//! A table that owns its memory.

use jred::error::Error;
use jred::machine::Reducible;
use jred::number::Role;
use jred::table::{Constants, Format, Shape, Table, TableError, words_len};
use jred::tabulate::{fill, scratch_len};
use jred::{CurveSet, Domain, Model, Scale};

/// Words of a table, and their meaning.
#[derive(Clone, Debug)]
pub(crate) struct Rows<F: Format> {
    pub(crate) words: Vec<F::Word>,
    pub(crate) constants: F::Constants,
    pub(crate) set: CurveSet,
    pub(crate) cells: u32,
    pub(crate) domain: Domain,
    pub(crate) scale: Scale,
}

impl<F: Format> Rows<F> {
    /// The table with exactly `cells` cells.
    pub(crate) fn of(
        machine: &impl Reducible,
        set: CurveSet,
        cells: u32,
        scale: &Scale,
    ) -> Result<Self, Error> {
        let mut scratch = vec![0.0; scratch_len(cells, set)];
        let mut words = vec![F::Word::default(); words_len::<F>(cells, set)];
        let table = fill::<F>(machine, set, cells, scale, &mut scratch, &mut words)?;
        let constants = *table.constants();
        Ok(Self {
            words,
            constants,
            set,
            cells,
            domain: machine.domain(),
            scale: *scale,
        })
    }

    /// Words as they are, without constants.
    pub(crate) fn plain(words: Vec<F::Word>, set: CurveSet, cells: u32, domain: Domain) -> Self {
        Self {
            words,
            constants: F::Constants::default(),
            set,
            cells,
            domain,
            scale: Scale::SI,
        }
    }

    fn in_units(&self, scale: &Scale) -> Result<Table<'_, F>, TableError> {
        let shape = Shape {
            set: self.set,
            cells: self.cells,
            domain: self.domain.to(),
            scale: *scale,
            constants: self.constants,
        };
        Table::new(&self.words, shape)
    }

    pub(crate) fn try_table(&self) -> Result<Table<'_, F>, TableError> {
        self.in_units(&self.scale)
    }

    pub(crate) fn table(&self) -> Table<'_, F> {
        self.try_table().unwrap()
    }

    pub(crate) fn try_model<const SET: CurveSet>(
        &self,
        scale: &Scale,
    ) -> Result<Model<'_, F, SET>, TableError> {
        Model::new(self.in_units(scale)?)
    }

    pub(crate) fn model<const SET: CurveSet>(&self, scale: &Scale) -> Model<'_, F, SET> {
        self.try_model(scale).unwrap()
    }
}

/// The meaning of a word, by the formats of `docs/table-image.md`.
pub(crate) trait Meaning: Copy + Default {
    const FIXED: bool;
    fn value(self, role: Role) -> f64;
    /// The nearest word.
    fn of(role: Role, value: f64) -> Self;
}

impl Meaning for f32 {
    const FIXED: bool = false;
    fn value(self, _: Role) -> f64 {
        f64::from(self)
    }
    fn of(_: Role, value: f64) -> Self {
        value as Self
    }
}

impl Meaning for f64 {
    const FIXED: bool = false;
    fn value(self, _: Role) -> f64 {
        self
    }
    fn of(_: Role, value: f64) -> Self {
        value
    }
}

impl Meaning for i32 {
    const FIXED: bool = true;
    fn value(self, role: Role) -> f64 {
        f64::from(self) / unit(role)
    }
    fn of(role: Role, value: f64) -> Self {
        (value * unit(role)).round_ties_even() as Self
    }
}

fn unit(role: Role) -> f64 {
    2.0f64.powi(match role {
        Role::Inertia | Role::Viscous => 30,
        Role::Load | Role::Coulomb => 29,
        Role::Reciprocal => 31,
    })
}

/// A format of polynomials, whose words are numbers.
pub(crate) trait Plain: Format<Word = Self::W, Constants = Constants<Self::W>> {
    type W: Meaning;
}

impl<W: Meaning, F: Format<Word = W, Constants = Constants<W>>> Plain for F {
    type W = W;
}

/// Of 32 bits.
pub(crate) trait Fixed:
    Format<Number = jred::Q31, Word = i32, Constants = Constants<i32>>
{
}

impl<F: Format<Number = jred::Q31, Word = i32, Constants = Constants<i32>>> Fixed for F {}
