//! A CSV table with units in its header, read row by row.

use std::ops::Range;

use jred_file::plain;
use jred_file::text::csv::{self, name_and_unit};
use jred_file::text::problem::Problem;
use jred_file::units::did_you_mean;

use super::cell::TableCell;
use super::column::{Column, Kind, Unit};
use super::row::{CatalogueRow, Cells, Syntax};

/// A CSV file with its parsed header.
pub(super) struct CatalogueTable<'t> {
    kind: Kind,
    columns: [Option<(usize, Unit)>; Column::COUNT],
    currency: String,
    csv: csv::CsvTable<'t>,
}

impl<'t> CatalogueTable<'t> {
    /// Reads the header; `None` if it is missing.
    pub(super) fn read(text: &'t str, kind: Kind) -> Result<Option<Self>, Problem> {
        let mut table = Self {
            kind,
            columns: [const { None }; Column::COUNT],
            currency: String::new(),
            csv: csv::CsvTable::read(text)?,
        };
        let titles: Vec<String> = table.csv.header().iter().map(ToOwned::to_owned).collect();
        if titles.iter().all(String::is_empty) {
            return Ok(None);
        }
        for (index, title) in titles.iter().enumerate() {
            table.column(index, title)?;
        }
        Ok(Some(table))
    }

    fn column(&mut self, index: usize, title: &str) -> Result<(), Problem> {
        let (name, unit) = name_and_unit(title);
        let at = self.csv.title_place(index);
        let Some(column) = Column::of(self.kind).find(|c| c.name() == name) else {
            return Err(unknown(name, self.kind, Syntax::Csv, at));
        };
        let holds = column.holds();
        let of_price = column == Column::Price;
        if of_price {
            unit.unwrap_or_default().clone_into(&mut self.currency);
        }
        let unit = self.csv.unit(index, holds.kinds(), |unit| {
            holds.unit(if of_price { "" } else { unit })
        })?;
        match self.columns[column as usize].replace((index, unit)) {
            None => Ok(()),
            Some(_) => Err(Problem::new(format!("duplicate column \"{name}\""))
                .at(at, "twice in this header")
                .help("keep one of the two")),
        }
    }

    /// Calls `take` with every row and its line number, or with the fault that makes it unreadable.
    pub(super) fn each(
        mut self,
        mut take: impl FnMut(Result<(CatalogueRow<'_>, usize), Problem>),
    ) -> usize {
        let mut count = 0;
        while let Some(read) = self.csv.advance() {
            count += 1;
            take(read.map(|()| (CatalogueRow::new(self.kind, &self), self.csv.line())));
        }
        count
    }
}

/// The fault of a name that is not a column of this table.
pub(super) fn unknown(name: &str, kind: Kind, form: Syntax, at: Range<usize>) -> Problem {
    let names: Vec<&str> = Column::of(kind).map(Column::name).collect();
    let near = did_you_mean(name, &names);
    let elsewhere = Column::ALL.iter().find(|column| column.name() == name);
    let elsewhere = elsewhere.and_then(|column| column.kinds().first());
    let column = form.column();
    let table = |kind: Kind| match form {
        Syntax::Csv => kind.plural().to_owned(),
        Syntax::Toml => format!("[[{}]]", kind.singular()),
    };
    let elsewhere = elsewhere.map_or(String::new(), |kind| {
        format!("It is a {column} of {}. ", table(*kind))
    });
    let (label, all) = match form {
        Syntax::Csv => ("not a column of this table", "Columns"),
        Syntax::Toml => ("not a key of this table", "Keys"),
    };
    Problem::new(format!("unknown {column} \"{}\"", plain::cut(name)))
        .at(at, label)
        .help(format!(
            "{elsewhere}{near}{all} of {}: {}",
            table(kind),
            names.join(", ")
        ))
}

impl Cells for CatalogueTable<'_> {
    fn cell(&self, column: Column) -> Option<TableCell<'_>> {
        let (index, unit) = self.columns[column as usize].as_ref()?;
        let text = self.csv.row().get(*index)?;
        (!text.is_empty()).then_some(TableCell {
            text,
            unit: Some(unit),
            separator: self.csv.separator(),
        })
    }

    fn place(&self, column: Column) -> Range<usize> {
        let column = self.columns[column as usize].as_ref();
        self.csv.place(column.map_or(0, |(index, _)| *index))
    }

    fn has(&self, column: Column) -> bool {
        self.columns[column as usize].is_some()
    }

    fn given(&self, column: Column) -> bool {
        self.has(column)
    }

    fn header(&self) -> Range<usize> {
        let start = self.csv.title_place(0).start;
        start..start
    }

    fn currency(&self) -> &str {
        &self.currency
    }

    fn form(&self) -> Syntax {
        Syntax::Csv
    }
}
