//! Assignment of a file's columns to the format's, and cures if it is ambiguous.

use super::layout::{Layout, Title};
use super::{ColumnSpec, CsvFault, Format};
use crate::plain;
use crate::text::csv::{CsvTable, header_place};
use crate::text::problem::{Problem, quoted};
use crate::units::quantity::unit_of;
use crate::units::{self, did_you_mean};

/// For each title the index of the format's column, and its unit if the machine file gives it; `None` if the column is ignored.
type Indices<'l> = Vec<Option<(usize, Option<&'l str>)>>;

/// A column of the format: its index, its unit, and the size of the unit (SI).
pub(super) type ColumnMatch = (usize, Option<String>, f64);

/// For each title the column of the format; `None` if the column is ignored.
pub(super) fn columns(
    table: &CsvTable,
    titles: &[Title],
    format: &Format,
    layout: &Layout,
) -> Result<Vec<Option<ColumnMatch>>, CsvFault> {
    let indices = match &layout.mapped {
        Some(_) => mapped(titles, format, layout)?,
        None => named(table, titles, format, layout)?,
    };
    let mut columns = Vec::new();
    for (at, (title, found)) in titles.iter().zip(indices).enumerate() {
        let known = found.and_then(|(index, _)| format.known.get(index));
        let (Some((index, unit)), Some(known)) = (found, known) else {
            columns.push(None);
            continue;
        };
        let unit = unit.or(title.unit.as_deref());
        let scale = table.unit(at, &[known.kind], |_| {
            let scale = layout.scale(unit, known.kind);
            scale.map_err(|fault| match unit {
                Some(_) => fault,
                None => units::Fault {
                    help: format!("{}{}", fault.help, or_mapped(titles, format, layout)),
                    ..fault
                },
            })
        })?;
        columns.push(Some((index, unit.map(ToOwned::to_owned), scale)));
    }
    Ok(columns)
}

/// Assignment by the titles in the machine file; other columns are ignored.
fn mapped<'l>(
    titles: &[Title],
    format: &Format,
    layout: &'l Layout,
) -> Result<Indices<'l>, CsvFault> {
    let mut found = vec![None; titles.len()];
    for mapped in layout.mapped.iter().flatten() {
        let fault = |what: &str, label: &str, help: String| {
            CsvFault::InMachine(mapped.item.problem(what, label).help(help))
        };
        let known = format.known.iter();
        let Some(index) = known.clone().position(|known| known.is(mapped.name)) else {
            let names: Vec<&str> = known.map(ColumnSpec::key).collect();
            let near = did_you_mean(mapped.name, &names);
            return Err(fault(
                "is no column that is read here",
                "unknown",
                format!("{near}possible: {}", quoted(&names)),
            ));
        };
        let at = titles
            .iter()
            .position(|title| title.is_meant_by(&mapped.title));
        let Some((at, taken)) = at.and_then(|at| Some((at, found.get_mut(at)?))) else {
            let titles: Vec<&str> = titles.iter().map(|title| title.whole.as_str()).collect();
            let asked = &mapped.title.whole;
            return Err(fault(
                &format!(
                    "is \"{}\", which is no title of the file",
                    plain::cut(asked)
                ),
                "not in the file",
                format!(
                    "{}its titles: {}",
                    did_you_mean(asked, &titles),
                    quoted(&titles)
                ),
            ));
        };
        if taken.is_some() {
            let what = format!("names column {} of the file once more", at + 1);
            let help = "give each column one meaning".to_owned();
            return Err(fault(&what, "twice", help));
        }
        *taken = Some((index, mapped.title.unit.as_deref()));
    }
    Ok(found)
}

/// Assignment by the names of the format.
fn named<'l>(
    table: &CsvTable,
    titles: &[Title],
    format: &Format,
    layout: &Layout,
) -> Result<Indices<'l>, CsvFault> {
    let help = format!(
        "the first line gives column names with units: {}",
        format.example
    );
    let mut found: Indices = Vec::new();
    for (at, title) in titles.iter().enumerate() {
        let fault =
            |message: String| Problem::new(message).at(table.title_place(at), "this column");
        let Some(index) = (format.known.iter()).position(|known| known.is(&title.name)) else {
            if (format.ignored)(&title.name) {
                found.push(None);
                continue;
            }
            let names: Vec<&str> = format.known.iter().flat_map(|k| k.names).copied().collect();
            let near = did_you_mean(&title.name, &names);
            let mapped = or_mapped(titles, format, layout);
            return Err(
                fault(format!("unknown column \"{}\"", plain::cut(&title.whole)))
                    .help(format!("{near}{help}{mapped}"))
                    .into(),
            );
        };
        if found.iter().flatten().any(|(other, _)| *other == index) {
            return Err(fault(format!("duplicate column \"{}\"", title.name))
                .help(format!("remove one of the two; {help}"))
                .into());
        }
        found.push(Some((index, None)));
    }
    Ok(found)
}

/// A line for the machine file that assigns the columns, as an addition to another cure: by names, by units, or by order if the columns have neither.
/// Empty if fewer than two columns can be assigned.
fn or_mapped(titles: &[Title], format: &Format, layout: &Layout) -> String {
    let measures = |title: &Title, known: &ColumnSpec| {
        let unit = title.unit.as_deref().unwrap_or_default();
        !unit.is_empty() && unit_of(unit, &[known.kind]).is_ok()
    };
    let is_named = |title: &Title| format.known.iter().any(|known| known.is(&title.name));
    let bare = titles.iter().all(|title| title.unit.is_none());
    let mut free: Vec<bool> = titles.iter().map(|_| true).collect();
    let mut entries = Vec::new();
    for (order, known) in format.known.iter().enumerate() {
        let is_free = |at: &usize| free.get(*at) == Some(&true);
        let by_name = titles.iter().position(|title| known.is(&title.name));
        let mut by_unit = titles
            .iter()
            .enumerate()
            .filter(|(at, title)| is_free(at) && !is_named(title) && measures(title, known));
        let one = by_unit.next().filter(|_| by_unit.next().is_none());
        let by_order = (bare && order < 2).then_some(order);
        let found = by_name.or(one.map(|(at, _)| at)).or(by_order);
        let Some((at, title)) = found
            .filter(is_free)
            .and_then(|at| Some((at, titles.get(at)?)))
        else {
            continue;
        };
        if let Some(free) = free.get_mut(at) {
            *free = false;
        }
        let unit = match title.unit {
            None => format!(" [{}]", known.kind.unit),
            Some(_) => String::new(),
        };
        entries.push(format!(
            "{} = \"{}{unit}\"",
            known.key(),
            plain::cut(&title.whole)
        ));
    }
    if entries.len() < 2 {
        return String::new();
    }
    format!(
        "; or leave the file as it is and write into {}: columns = {{ {} }}, with the units that the file has: its other columns are then \
         passed over",
        layout.section,
        entries.join(", ")
    )
}

/// Refuses a file that begins with numbers or with lines of text above its header; the cure is a key for the machine file.
pub(super) fn check_first_lines(
    text: &str,
    titles: &[Title],
    format: &Format,
    layout: &Layout,
) -> Result<(), CsvFault> {
    let is_number = |title: &Title| title.whole.replace(',', ".").parse::<f64>().is_ok();
    let section = &layout.section;
    if titles.iter().all(is_number) {
        let suggested: Vec<String> = (format.known.iter().take(titles.len()))
            .map(|known| format!("\"{} [{}]\"", known.key(), known.kind.unit))
            .collect();
        let help = format!(
            "write the titles of its {} columns into {section}, with the units that the file has: header = [{}]",
            titles.len(),
            suggested.join(", ")
        );
        return Err(
            Problem::new("the file has no header: its first line has numbers")
                .at(header_place(text), "numbers")
                .help(help)
                .into(),
        );
    }
    let separated = |line: &str| line.contains([',', ';', '\t']);
    let lines = text.lines().position(separated);
    if let (1, Some(lines @ 1..)) = (titles.len(), lines) {
        let message = "the first line has one column, the lines below it have more";
        let help = format!(
            "the header is line {}: write skip_rows = {lines} into {section}",
            lines + 1
        );
        return Err(Problem::new(message)
            .at(header_place(text), "a title?")
            .help(help)
            .into());
    }
    Ok(())
}
