//! Reading the golden data in `tests/data`.

use serde_json::Value;

/// One case.
pub(crate) struct Case(Value);

impl Case {
    /// From the text of the file.
    pub(crate) fn new(text: &str) -> Self {
        Self(serde_json::from_str(text).unwrap())
    }

    /// A number of the inputs, by path such as `/crank_com/0`.
    pub(crate) fn input(&self, path: &str) -> f64 {
        number(&self.0, &format!("/inputs{path}"))
    }

    /// A number of the prescribed motion.
    pub(crate) fn motion(&self, name: &str) -> f64 {
        number(&self.0, &format!("/prescribed_motion/{name}"))
    }

    /// One of the expected values.
    pub(crate) fn value(&self, name: &str) -> f64 {
        self.0["expected"]["values"][name].as_f64().unwrap()
    }

    /// One of the exact rationals, as numerator and denominator.
    pub(crate) fn rational(&self, name: &str) -> [f64; 2] {
        let text = self.0["expected"]["exact"][name].as_str().unwrap();
        let (top, bottom) = text.split_once('/').unwrap();
        [top, bottom].map(|n| n.parse().unwrap())
    }

    /// One of the expected tables.
    pub(crate) fn table(&self, name: &str) -> Table {
        let table = &self.0["expected"]["tables"][name];
        let columns = table["columns"].as_array().unwrap().iter();
        let rows = table["rows"].as_array().unwrap().iter();
        Table {
            columns: columns.map(|c| c.as_str().unwrap().to_owned()).collect(),
            rows: rows
                .map(|row| {
                    row.as_array()
                        .unwrap()
                        .iter()
                        .map(|x| x.as_f64().unwrap())
                        .collect()
                })
                .collect(),
        }
    }
}

fn number(value: &Value, path: &str) -> f64 {
    let found = value.pointer(path).and_then(Value::as_f64);
    found.unwrap_or_else(|| panic!("no number at {path}"))
}

/// A table with named columns.
pub(crate) struct Table {
    columns: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Table {
    /// One column.
    pub(crate) fn column(&self, name: &str) -> Vec<f64> {
        let index = self.columns.iter().position(|c| c == name).unwrap();
        self.rows.iter().map(|row| row[index]).collect()
    }

    /// Compares a computed column with the golden one, relative to its largest magnitude; returns the largest error.
    #[track_caller]
    pub(crate) fn compare(&self, name: &str, found: &[f64], budget: f64) {
        let expected = self.column(name);
        assert_eq!(found.len(), expected.len(), "{name}");
        let size = super::largest(expected.iter().copied());
        assert!(size > 0.0, "{name}: nothing to compare");
        let errors = found.iter().zip(&expected).map(|(f, e)| (f - e) / size);
        println!("{name}: {:.1e} of the largest", super::largest(errors));
        for (row, (f, e)) in found.iter().zip(&expected).enumerate() {
            super::assert_near(&format!("{name}, row {row}"), *f, *e, budget * size);
        }
    }
}
