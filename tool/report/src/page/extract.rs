//! Tables of the page about a mechanism: the largest forces, and a few rows of the curves.

use jred::error::Error;

use super::mechanism::{POINTS, Source};
use jred_analysis::reduce::{Request, Sets, largest};
use jred_file::number::columns::{Column, ColumnQuantity, Columns};
use jred_file::number::rounding::{rounded, short};

/// Rows of each table.
const ROWS: usize = 13;

/// A table of the page.
pub(super) struct ExtractTable {
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
            let value = format!("{} {}", short(row.value), row.quantity.unit);
            let at = format!("{} = {} {}", row.over.name, short(row.at), row.over.unit);
            [row.quantity.name.clone(), value, at]
        })
        .collect())
}

/// Extracts of tables; the command line prints the whole ones.
pub(super) fn tables(source: &Source) -> Result<Vec<ExtractTable>, Error> {
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
        ExtractTable {
            heading,
            names: kept.iter().map(|(_, head)| head.title()).collect(),
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
