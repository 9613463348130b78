//! Shared by the tests of the tool's packages, each of which includes it. Not every package uses all of it.
#![allow(dead_code)]

pub(crate) mod budget;
pub(crate) mod catalogue;
pub(crate) mod machines;
pub(crate) mod numerics;
pub(crate) mod press;
pub(crate) mod skip;

use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use serde_json::Value;

/// A machine file that is shipped.
pub(crate) fn shipped(name: impl AsRef<Path>) -> PathBuf {
    let machines = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    machines.join(name)
}

/// A file of the example press without its supply: tests give their own, or none.
pub(crate) fn press_file() -> PathBuf {
    static FILE: LazyLock<PathBuf> = LazyLock::new(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
        let unfinished = folder.join(format!("press-{}.part", std::process::id()));
        std::fs::write(&unfinished, press_text()).unwrap();
        let file = folder.join("press.toml");
        // Another test program may be writing it as well.
        std::fs::rename(unfinished, &file).unwrap();
        file
    });
    FILE.clone()
}

/// Its text.
pub(crate) fn press_text() -> String {
    let text = std::fs::read_to_string(shipped("press.toml")).unwrap();
    let (machine, _) = text.split_once("\n# The three-phase supply").unwrap();
    machine.to_owned()
}

/// The press with one text replaced, which must be there.
pub(crate) fn edited_press(from: &str, to: &str) -> String {
    edited(&press_text(), from, to)
}

/// `text` with the first `from` replaced, which must be there.
pub(crate) fn edited(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "the text has no {from:?}");
    text.replacen(from, to, 1)
}

/// The rows of a table of cases: `N` fields a line between `=>`; a line without one continues the line before, and one from
/// `//` on is a comment. `\n` is a line break, `␣` a space at the end of a field.
pub(crate) fn rows<const N: usize>(table: &str) -> Vec<[String; N]> {
    let lines = table.lines().map(str::trim);
    let mut rows: Vec<String> = Vec::new();
    for line in lines.filter(|line| !line.is_empty() && !line.starts_with("//")) {
        match rows.last_mut() {
            Some(row) if !line.contains("=>") => row.extend([" ", line]),
            _ => rows.push(line.to_owned()),
        }
    }
    let field = |text: &str| text.trim().replace("\\n", "\n").replace('␣', " ");
    let fields = |row: String| -> Vec<String> { row.split("=>").map(field).collect() };
    let row = |row| fields(row).try_into().unwrap();
    rows.into_iter().map(row).collect()
}

/// The phrases of a list with ` | ` between them.
pub(crate) fn phrases(list: &str) -> Vec<&str> {
    list.split(" | ").collect()
}

/// A folder of a test's own.
pub(crate) struct Folder(tempfile::TempDir);

impl Folder {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Writes a file and returns its path.
    pub(crate) fn file(&self, name: &str, contents: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path(name);
        std::fs::write(&path, contents).unwrap();
        path
    }
}

/// Named columns.
pub(crate) struct Columns {
    pub(crate) names: Vec<String>,
    pub(crate) rows: Vec<Vec<Option<f64>>>,
}

impl Columns {
    pub(crate) fn of_csv(text: &str) -> Self {
        let mut lines = text.lines();
        let names = lines.next().unwrap().split(',').map(String::from).collect();
        let cell = |cell: &str| (!cell.is_empty()).then(|| cell.parse().unwrap());
        let rows = lines.map(|line| line.split(',').map(cell).collect());
        Self {
            names,
            rows: rows.collect(),
        }
    }

    pub(crate) fn of_json(value: &Value) -> Self {
        let texts = |value: &Value| -> Vec<String> {
            let list = value.as_array().unwrap().iter();
            list.map(|name| name.as_str().unwrap().to_owned()).collect()
        };
        let row = |row: &Value| row.as_array().unwrap().iter().map(Value::as_f64).collect();
        Self {
            names: texts(&value["columns"]),
            rows: value["rows"].as_array().unwrap().iter().map(row).collect(),
        }
    }

    /// A column without gaps.
    pub(crate) fn get(&self, name: &str) -> Vec<f64> {
        let index = self.names.iter().position(|n| n == name);
        let index = index.unwrap_or_else(|| panic!("no column {name:?} in {:?}", self.names));
        let cell = |row: &Vec<Option<f64>>| row[index].unwrap();
        self.rows.iter().map(cell).collect()
    }
}

/// The largest magnitude.
pub(crate) fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// Checks |found − expected| ≤ `share` of |expected|.
pub(crate) fn near(what: &str, found: f64, expected: f64, share: f64) {
    within(what, found, expected, share * expected.abs());
}

/// Checks |found − expected| ≤ `most`.
#[track_caller]
pub(crate) fn within(what: &str, found: f64, expected: f64, most: f64) {
    if std::env::var_os("SHOW_AGREEMENT").is_some() {
        let relative = (found - expected) / expected.abs().max(f64::MIN_POSITIVE);
        println!(
            "{what}: {expected:.9}, off by {:.1e} ({relative:.1e})",
            found - expected
        );
    }
    // Written so that a NaN fails.
    assert!(
        (found - expected).abs() <= most,
        "{what}: found {found}, expected {expected}, off by {:e}, allowed {most:e}",
        found - expected
    );
}

/// The same for a value without a name.
#[track_caller]
pub(crate) fn close(found: f64, expected: f64, most: f64) {
    within("value", found, expected, most);
}

/// Checks a column against another, to a `share` of the expected column's largest magnitude.
pub(crate) fn near_column(what: &str, found: &[f64], expected: &[f64], share: f64) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let most = share * largest(expected);
    let mut worst = 0.0f64;
    for (row, (a, b)) in found.iter().zip(expected).enumerate() {
        worst = worst.max((a - b).abs());
        assert!(
            (a - b).abs() <= most,
            "{what}, row {row}: found {a}, expected {b}, off by {:e}, allowed {most:e}",
            a - b
        );
    }
    if std::env::var_os("SHOW_AGREEMENT").is_some() {
        println!(
            "{what}: worst {:.1e} of the largest",
            worst / largest(expected)
        );
    }
}
