//! Tables of the page about a mechanism: the largest forces, and a few rows of the curves.

use jred::error::Error;

use super::mechanism::{POINTS, Source};
use super::section::Section;
use crate::table::reading::Reading;
use jred_analysis::reduce::{Request, Sets, largest};
use jred_file::number::columns::{Column, ColumnQuantity, Columns};
use jred_file::number::rounding::{rounded, short};
use jred_sizing::cell::Cell;

/// Rows of each table.
const ROWS: usize = 13;

/// Name, value and place of the largest forces; `None` without a motion.
pub(super) fn largest_forces(source: &Source) -> Result<Option<Section>, Error> {
    if !source.moves() {
        return Ok(None);
    }
    let request = Request {
        over: source.over,
        positions: POINTS,
        sets: Sets::default(),
        state: source.state,
    };
    let rows = largest(source.file, &request)?;
    let rows = rows.iter().map(|row| {
        let value = format!("{} {}", short(row.value), row.quantity.unit);
        let at = format!("{} = {} {}", row.over.name, short(row.at), row.over.unit);
        [row.quantity.name.clone(), value, at]
            .map(Cell::Text)
            .to_vec()
    });
    let rows: Vec<Vec<Cell>> = rows.collect();
    if rows.is_empty() {
        return Ok(None);
    }
    let columns = ["force", "value", "at"].map(str::to_owned).to_vec();
    Ok(Some(section("Largest forces", columns, rows)))
}

fn section(heading: &str, columns: Vec<String>, rows: Vec<Vec<Cell>>) -> Section {
    let whole = 1;
    Section::read(heading, |answer| {
        answer.table(Reading::new(columns, rows, whole));
    })
}

/// Extracts of tables; the command line prints the whole ones.
pub(super) fn tables(source: &Source) -> Result<Vec<Section>, Error> {
    let table = |heading, columns: &Columns, wanted: &dyn Fn(&Column) -> bool| {
        let along = [
            ColumnQuantity::Time,
            ColumnQuantity::Position,
            ColumnQuantity::DriveSpeed,
        ];
        let heads = columns.heads().iter().enumerate();
        let kept: Vec<(usize, &Column)> = heads
            .filter(|(k, head)| *k < 2 && along.contains(&head.quantity) || wanted(head))
            .collect();
        let row = |row: &Vec<Option<f64>>| {
            let cells = kept
                .iter()
                .map(|(k, _)| row[*k].map_or(Cell::Empty, |x| rounded(x).into()));
            cells.collect()
        };
        let names = kept.iter().map(|(_, head)| head.title()).collect();
        section(heading, names, columns.rows().iter().map(row).collect())
    };
    let curves = Sets {
        curves: true,
        ..Sets::default()
    };
    let points = Sets {
        points: true,
        ..Sets::default()
    };
    let named = source.file.machine.mechanism().points();
    let mut tables = vec![table(
        "Extract of the curves",
        &source.columns(curves, ROWS)?,
        &|head| {
            let wanted = [
                ColumnQuantity::ReducedInertia,
                ColumnQuantity::InertiaSlope,
                ColumnQuantity::DriveEffort,
            ];
            wanted.contains(&head.quantity)
        },
    )];
    if !named.is_empty() {
        tables.push(table(
            "Extract of the points",
            &source.columns(points, ROWS)?,
            &|head| {
                let wanted = [
                    ColumnQuantity::Coordinate,
                    ColumnQuantity::Speed,
                    ColumnQuantity::Acceleration,
                ];
                wanted.contains(&head.quantity) && named.iter().any(|p| p.name == head.part)
            },
        ));
    }
    Ok(tables)
}
