//! Named columns of numbers: what an analysis gives.

/// Named columns of numbers; `None` is an empty cell.
#[derive(Clone, Debug, Default)]
pub struct Columns {
    names: Vec<String>,
    rows: Vec<Vec<Option<f64>>>,
}

impl Columns {
    /// Columns with these names; each name carries its unit, as "omega [rad/s]".
    pub fn new(names: impl IntoIterator<Item = impl Into<String>>) -> Self {
        Self {
            names: names.into_iter().map(Into::into).collect(),
            rows: Vec::new(),
        }
    }

    /// Adds a row with one value for each column.
    pub fn push(&mut self, row: impl IntoIterator<Item = impl Into<Option<f64>>>) {
        let row: Vec<Option<f64>> = row.into_iter().map(Into::into).collect();
        debug_assert_eq!(row.len(), self.names.len());
        self.rows.push(row);
    }

    /// The names.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Whether a value is missing anywhere.
    pub fn has_empty_cells(&self) -> bool {
        self.rows.iter().flatten().any(Option::is_none)
    }

    /// The rows.
    pub fn rows(&self) -> &[Vec<Option<f64>>] {
        &self.rows
    }
}
