//! Tables and ticks in 16 bits.

mod curves;
mod image;
mod integer;
mod number;
mod press;
mod refused;
mod tick;

use jred::short::{Constants, Model, Table, fill, scratch_len, words_len};
use jred::{Domain, Error, Q15, Reducible, Scale, TableError};

/// A table with the memory it lies in.
#[derive(Clone, Debug)]
struct Short {
    words: Vec<u32>,
    constants: Constants,
    set: u8,
    cells: u32,
    domain: Domain,
    scale: Scale,
}

impl Short {
    fn of(machine: &impl Reducible, set: u8, cells: u32, scale: &Scale) -> Result<Self, Error> {
        let mut scratch = vec![0.0; scratch_len(cells, set)];
        let mut words = vec![0; words_len(cells, set)];
        let constants = fill(machine, set, cells, scale, &mut scratch, &mut words)?.constants();
        Ok(Self {
            words,
            constants,
            set,
            cells,
            domain: machine.domain(),
            scale: *scale,
        })
    }

    fn try_table(&self) -> Result<Table<'_>, TableError> {
        Table::new(&self.words, self.constants, self.set, self.cells)
    }

    fn table(&self) -> Table<'_> {
        self.try_table().unwrap()
    }

    fn model<const SET: u8>(&self) -> Model<'_, SET> {
        Model::for_domain(self.table(), self.domain, &self.scale).unwrap()
    }
}

/// Units of 2⁻¹⁵.
fn units(number: Q15) -> f64 {
    f64::from(number.to_bits())
}

fn q15(bits: i16) -> Q15 {
    Q15::from_bits(bits)
}
