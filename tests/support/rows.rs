//! A table with the memory it lies in.

use std::marker::PhantomData;

use jred::table::{Constants, Layout, Role, Spline};
use jred::tabulate::{fill, scratch_len, words_len};
use jred::{Domain, Error, Model, Reducible, Scalar, Scale, Table, TableError};

/// Words and constants of a table, and what else it takes to read them.
#[derive(Clone)]
pub(crate) struct Rows<S: Scalar, L: Layout = Spline> {
    pub(crate) words: Vec<S::Word>,
    pub(crate) constants: Constants<S::Word>,
    pub(crate) set: u8,
    pub(crate) cells: u32,
    pub(crate) domain: Domain,
    pub(crate) layout: PhantomData<L>,
}

impl<S: Scalar, L: Layout> Rows<S, L> {
    /// The table with exactly `cells` cells.
    pub(crate) fn of(
        machine: &impl Reducible,
        set: u8,
        cells: u32,
        scale: &Scale,
    ) -> Result<Self, Error> {
        let mut scratch = vec![0.0; scratch_len(cells, set)];
        let mut words = vec![zero::<S>(); words_len::<L>(cells, set)];
        let constants =
            fill::<S, L>(machine, set, cells, scale, &mut scratch, &mut words)?.constants();
        Ok(Self {
            words,
            constants,
            set,
            cells,
            domain: machine.domain(),
            layout: PhantomData,
        })
    }

    /// Words as they are, without constants.
    pub(crate) fn plain(words: Vec<S::Word>, set: u8, cells: u32, domain: Domain) -> Self {
        let constants = Constants {
            inertia: zero::<S>(),
            viscous: zero::<S>(),
            coulomb: zero::<S>(),
            gains: [zero::<S>(); 5],
        };
        Self {
            words,
            constants,
            set,
            cells,
            domain,
            layout: PhantomData,
        }
    }

    pub(crate) fn try_table(&self) -> Result<Table<'_, S, L>, TableError> {
        let periodic = self.domain == Domain::Turn;
        Table::with_constants(&self.words, self.constants, self.set, self.cells, periodic)
    }

    pub(crate) fn table(&self) -> Table<'_, S, L> {
        self.try_table().unwrap()
    }

    pub(crate) fn try_model<const SET: u8>(
        &self,
        scale: &Scale,
    ) -> Result<Model<'_, S, SET, L>, TableError> {
        Model::for_domain(self.try_table()?, self.domain, scale)
    }

    pub(crate) fn model<const SET: u8>(&self, scale: &Scale) -> Model<'_, S, SET, L> {
        self.try_model(scale).unwrap()
    }
}

/// The word of the number 0.
pub(crate) fn zero<S: Scalar>() -> S::Word {
    S::word(Role::Inertia, 0.0).unwrap()
}
