//! Tables of the page about a mechanism: the largest forces, and a few rows of the curves.

use jred::Error;

use super::mechanism::{POINTS, Source};
use jred_machine::analysis::reduce::{Request, Sets, largest};
use jred_machine::number::columns::Columns;
use jred_machine::number::rounding::{rounded, short};

/// Rows of each table.
const ROWS: usize = 13;

/// A table of the page.
pub(super) struct Table {
    pub(super) heading: &'static str,
    pub(super) names: Vec<String>,
    pub(super) rows: Vec<Vec<String>>,
}

/// Name, value and place of the largest forces.
pub(super) fn largest_forces(source: &Source) -> Result<Vec<[String; 3]>, Error> {
    if !source.moves() {
        return Ok(Vec::new());
    }
    let request = Request {
        over: source.over,
        positions: POINTS,
        sets: Sets::default(),
        state: source.state,
    };
    let rows = largest(source.file, &request)?;
    Ok(rows
        .iter()
        .map(|row| {
            let (name, unit) = row.quantity.split_once(" [").unwrap_or((&row.quantity, ""));
            let (over, over_unit) = row.over.split_once(" [").unwrap_or((&row.over, ""));
            let value = format!("{} {}", short(row.value), unit.trim_end_matches(']'));
            let at = format!(
                "{over} = {} {}",
                short(row.at),
                over_unit.trim_end_matches(']')
            );
            [name.to_owned(), value, at]
        })
        .collect())
}

/// Extracts; the whole tables come from the command line.
pub(super) fn tables(source: &Source) -> Result<Vec<Table>, Error> {
    let table = |heading, columns: &Columns, wanted: &dyn Fn(&str) -> bool| {
        let names = columns.names().iter().enumerate();
        let kept: Vec<(usize, &String)> = names
            .filter(|(k, name)| *k < 2 && !name.contains("red") || wanted(name))
            .collect();
        Table {
            heading,
            names: kept.iter().map(|(_, name)| (*name).clone()).collect(),
            rows: columns
                .rows()
                .iter()
                .map(|row| {
                    let cells = kept.iter().map(|(k, _)| row[*k]);
                    cells.map(|x| x.map_or(String::new(), rounded)).collect()
                })
                .collect(),
        }
    };
    let curves = Sets {
        curves: true,
        ..Sets::default()
    };
    let points = Sets {
        points: true,
        ..Sets::default()
    };
    let named: Vec<String> = source
        .file
        .machine
        .mechanism()
        .points()
        .iter()
        .map(|point| format!("{} ", point.name))
        .collect();
    let mut tables = vec![table(
        "Extract of the curves",
        &source.columns(curves, ROWS)?,
        &|name| name.contains("red [") || name.contains("red' ") || name.ends_with("_drive [N m]"),
    )];
    if !named.is_empty() {
        tables.push(table(
            "Extract of the points",
            &source.columns(points, ROWS)?,
            &|name| {
                let own = named.iter().any(|point| name.starts_with(point.as_str()));
                own && [" x [", " y [", " v [", " a ["]
                    .iter()
                    .any(|part| name.contains(part))
            },
        ));
    }
    Ok(tables)
}
