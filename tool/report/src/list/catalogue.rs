//! A catalogue: its parts, one of them with its partners, its gaps, and an empty one to fill in.

use std::fmt::Write as _;

use schemars::JsonSchema;
use serde::Serialize;

use crate::answer::Answer;
use crate::answer::schema::Data;
use crate::answer::sheet::Sheet;
use crate::table::reading::{ColumnKind, Reading};
use crate::table::rows::csv_line;
use jred_file::number::rounding::significant;
use jred_file::number::words::counted;
use jred_sizing::catalogue::{Catalogue, ColumnTitle, Gap, MotorKind, Parts};
use jred_sizing::cell::Cell;

/// The form of a list in JSON; its columns are those of the table.
pub(crate) const FORM: &str = "jred-catalogue/1";

/// The columns for reading, by name.
const fn read_columns(parts: Parts, linear: bool) -> &'static [&'static str] {
    match (parts, linear) {
        (Parts::Motors, false) => &[
            "key",
            "maker",
            "rated_torque",
            "rated_speed",
            "peak_torque",
            "rotor_inertia",
            "brake_torque",
            "mains_voltage",
            "figures_from",
        ],
        (Parts::Motors, true) => &[
            "key",
            "maker",
            "rated_force",
            "rated_speed",
            "peak_force",
            "moving_mass",
            "mains_voltage",
            "figures_from",
        ],
        (Parts::Gearboxes, _) => &[
            "key",
            "maker",
            "ratio",
            "rated_output_torque",
            "peak_output_torque",
            "rated_input_speed",
            "input_inertia",
            "max_motor_shaft",
            "figures_from",
        ],
        (Parts::Amplifiers, _) => &[
            "key",
            "maker",
            "rated_current",
            "peak_current",
            "peak_time",
            "mains_voltage",
            "capacitance",
            "figures_from",
        ],
        (Parts::Resistors, _) => &[
            "key",
            "maker",
            "resistance",
            "rated_power",
            "peak_power",
            "pulse_energy",
            "figures_from",
        ],
    }
}

/// The parts of a table whose key or maker matches, in the order of the catalogue. CSV is a table of a catalogue.
pub fn list(
    catalogue: &Catalogue,
    parts: Parts,
    linear: bool,
    shows: impl Fn(&str, &str) -> bool,
) -> Answer<'static> {
    let columns = parts.columns(linear);
    let mut rows = parts.rows(catalogue, linear);
    let all = rows.len();
    rows.retain(|row| match row.as_slice() {
        [key, maker, ..] => shows(
            key.text().unwrap_or_default(),
            maker.text().unwrap_or_default(),
        ),
        _ => false,
    });
    let place = |name: &&str| columns.iter().position(|column| column.name == *name);
    let read: Vec<usize> = read_columns(parts, linear)
        .iter()
        .filter_map(place)
        .collect();
    let picked = rows
        .iter()
        .map(|row| read.iter().map(|k| row[*k].clone()).collect());
    let titles = read.iter().map(|k| {
        let ColumnTitle { name, unit, .. } = columns[*k];
        let name = name.replace('_', " ");
        if unit.is_empty() {
            name
        } else {
            format!("{name} [{unit}]")
        }
    });
    let kinds = read.iter().map(|k| match columns[*k].name {
        "key" | "maker" | "figures_from" => ColumnKind::Words,
        _ => ColumnKind::Quantity,
    });
    let reading = Reading {
        kinds: kinds.collect(),
        ..Reading::new(titles, picked, read.len())
    };
    let shown = match rows.len() {
        0 => format!("no {} of {all} match", parts.name()),
        n if n == all => format!("{n} {}", parts.name()),
        n => format!("{n} of {all} {}", parts.name()),
    };
    // Columns that are empty everywhere say nothing.
    let used: Vec<usize> = (0..columns.len())
        .filter(|k| rows.iter().any(|row| row[*k] != Cell::Empty))
        .collect();
    Sheet {
        schema: FORM,
        title: shown,
        columns: used.iter().map(|k| columns[*k].header()).collect(),
        rows: (rows.iter())
            .map(|row| used.iter().map(|k| row[*k].clone()).collect())
            .collect(),
        reading: Some(reading),
        ..Sheet::default()
    }
    .answer()
}

/// The JSON of `jred catalogue show`.
#[derive(Serialize, JsonSchema)]
pub(crate) struct PartData {
    /// The table.
    table: &'static str,
    /// Its figures: a number or a text under the name of each column, with its unit.
    figures: std::collections::BTreeMap<String, serde_json::Value>,
    /// Keys of the amplifiers of a motor.
    amplifiers: Vec<String>,
    /// Missing figures, and the rules that need them.
    gaps: Vec<Gap>,
}

impl Data for PartData {
    const FORM: &'static str = "jred-catalogue-part/1";
}

/// Every figure of the part with this key, its partners and its gaps; `None`: no such part.
pub fn part(catalogue: &Catalogue, key: &str) -> Option<Answer<'static>> {
    for parts in Parts::ALL {
        for linear in [false, true] {
            let rows = parts.rows(catalogue, linear);
            let is_it = |cell: Option<&Cell>| {
                let text = cell.and_then(Cell::text);
                text.is_some_and(|text| text.eq_ignore_ascii_case(key))
            };
            let found = rows
                .into_iter()
                .find(|row| is_it(row.first()) || is_it(row.get(2)));
            if let Some(row) = found {
                let key = row.first().and_then(Cell::text).unwrap_or(key);
                return Some(of_part(catalogue, parts, linear, key, &row));
            }
        }
    }
    None
}

fn of_part(
    catalogue: &Catalogue,
    parts: Parts,
    linear: bool,
    key: &str,
    row: &[Cell],
) -> Answer<'static> {
    let columns = parts.columns(linear);
    let given = columns
        .iter()
        .zip(row)
        .filter(|(_, cell)| **cell != Cell::Empty);
    let figures = given
        .clone()
        .map(|(column, cell)| (column.header(), cell.json()));
    let motor = (catalogue.motors.iter().position(|motor| motor.key == key))
        .filter(|_| parts == Parts::Motors);
    let amplifiers: Vec<String> = motor.map_or_else(Vec::new, |index| {
        let amplifiers = catalogue.amplifiers_of(index).into_iter();
        amplifiers.map(|amplifier| amplifier.key.clone()).collect()
    });
    let gaps = catalogue.gaps_of(parts, key);
    let data = PartData {
        table: parts.name(),
        figures: figures.collect(),
        amplifiers: amplifiers.clone(),
        gaps: gaps.clone(),
    };
    let title = format!("{key}, of the {}", parts.name());
    let mut answer = Answer::new(title, &data);
    for (column, cell) in given {
        let value = match cell {
            Cell::Number(x) => format!("{} {}", significant(*x, 6), column.unit),
            Cell::Text(text) => text.clone(),
            Cell::Empty => continue,
        };
        answer.fact(column.name.replace('_', " "), value.trim_end());
    }
    if parts == Parts::Motors {
        let amplifiers = match amplifiers.as_slice() {
            [] => "none of the catalogue".to_owned(),
            keys => keys.join(", "),
        };
        answer.fact("amplifiers", amplifiers);
    }
    if !gaps.is_empty() {
        answer.heading(MISSING);
        let row = |gap: &Gap| vec![names(gap).into(), cost(gap).into()];
        answer.table(Reading::new(["column", "cost"], gaps.iter().map(row), 1));
    }
    answer
}

/// The cost of a gap.
fn cost(gap: &Gap) -> String {
    let rules: Vec<&str> = gap.rules.iter().map(|rule| rule.name()).collect();
    match (rules.is_empty(), gap.costs) {
        (true, costs) => costs.to_owned(),
        (false, "") => format!("not checked: {}", rules.join(", ")),
        (false, costs) => format!("not checked: {} ({costs})", rules.join(", ")),
    }
}

/// The JSON of `jred catalogue check`.
#[derive(Serialize, JsonSchema)]
pub(crate) struct CheckedData {
    /// Number of motors, without those that differ only in their brake.
    motors: usize,
    gearboxes: usize,
    amplifiers: usize,
    resistors: usize,
    /// Number of possible drives.
    drives: usize,
    /// Figures that are probably wrong, with file and line.
    warnings: Vec<String>,
    /// Missing figures, and the rules that then are not checked.
    gaps: Vec<Gap>,
}

impl Data for CheckedData {
    const FORM: &'static str = "jred-catalogue-check/1";
}

/// The judgement of a catalogue that could be read: probable errors and gaps.
pub fn checked(catalogue: &Catalogue) -> Answer<'static> {
    let motors = catalogue
        .motors
        .iter()
        .filter(|motor| !motor.brake_is_optional);
    let linear = catalogue
        .motors
        .iter()
        .filter(|motor| motor.kind == MotorKind::Linear)
        .count();
    let gaps = catalogue.gaps();
    let data = CheckedData {
        motors: motors.count(),
        gearboxes: catalogue.gearboxes.len(),
        amplifiers: catalogue.amplifiers.len(),
        resistors: catalogue.resistors.len(),
        drives: catalogue.count(),
        warnings: catalogue.warnings.clone(),
        gaps: gaps.clone(),
    };
    let mut answer = Answer::new("catalogue", &data).titled("The catalogue can be used");
    let linear = match linear {
        0 => String::new(),
        n => format!(", {n} of them linear"),
    };
    let [gearboxes, amplifiers, resistors] = [
        (data.gearboxes, "gearbox", "gearboxes"),
        (data.amplifiers, "amplifier", "amplifiers"),
        (data.resistors, "brake resistor", "brake resistors"),
    ]
    .map(|(n, one, many)| counted(n, one, many));
    answer.fact(
        "parts",
        format!(
            "{}{linear}, {gearboxes}, {amplifiers}, {resistors}",
            counted(data.motors, "motor", "motors")
        ),
    );
    answer.fact(
        "drives",
        counted(data.drives, "combination", "combinations"),
    );
    for warning in &catalogue.warnings {
        answer.warning(warning.clone());
    }
    if gaps.is_empty() {
        answer.sentence("No figure is missing that a rule needs.");
        return answer;
    }
    answer.heading(MISSING);
    let rows = gaps.iter().map(|gap| {
        let missing = format!("{} of {}", gap.missing, gap.of);
        [gap.table.to_owned(), names(gap), missing, cost(gap)]
            .map(Cell::from)
            .to_vec()
    });
    answer.table(Reading::new(
        ["table", "column", "without it", "cost"],
        rows,
        3,
    ));
    answer
}

const MISSING: &str = "missing figures, and what they cost";

/// The columns of which one would do.
fn names(gap: &Gap) -> String {
    gap.columns.join(" or ")
}

/// The empty tables of a new catalogue: file name and text. Each column is explained in a comment, with its unit.
pub fn empty(linear: bool) -> Vec<(String, String)> {
    let tables = Parts::ALL.map(|parts| {
        let columns = parts.columns(linear);
        let mut text = format!(
            "# {}: one row for each. A table may stay empty. Remove the columns that you have no figures for; leave a cell empty if a data sheet has no figure.\n\
             # Units may be changed in the header. `jred catalogue check FOLDER` judges the rows.\n",
            capital(parts.name())
        );
        for column in &columns {
            let _ = writeln!(text, "#   {}: {}", column.header(), column.help);
        }
        text += &csv_line(columns.iter().map(|column| Cell::from(column.header())));
        (format!("{}.csv", parts.name()), text)
    });
    let mut tables = tables.to_vec();
    tables.push((
        "compatibility.csv".to_owned(),
        "# Which amplifiers run a motor, as its maker states it; keys separated by semicolons, KEY* for all that begin so.\n\
         motor,amplifiers\n"
            .to_owned(),
    ));
    tables
}

fn capital(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_uppercase().chain(letters).collect()
    })
}
