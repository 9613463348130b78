//! Assignment of a file's columns to the format's, and cures if it is ambiguous.

use super::layout::{self, ColumnMapping, Layout, Title};
use super::{ColumnSpec, CsvFault, Format, cell};
use crate::plain;
use crate::text::csv::{CsvTable, header_place};
use crate::text::problem::{Problem, quoted};
use crate::units::quantity::unit_of;
use crate::units::{self, did_you_mean};

/// For each title the index of the format's column, and the line of the machine file that assigns it; `None` if the column is ignored.
type Indices<'l> = Vec<Option<(usize, Option<&'l ColumnMapping<'l>>)>>;

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
        Some(_) => mapped(table, titles, format, layout)?,
        None => named(table, titles, format, layout)?,
    };
    let mut columns = Vec::new();
    for (at, (title, found)) in titles.iter().zip(indices).enumerate() {
        let known = found.and_then(|(index, _)| format.known.get(index));
        let (Some((index, mapping)), Some(known)) = (found, known) else {
            columns.push(None);
            continue;
        };
        let stated = mapping.and_then(|mapping| mapping.title.unit.as_deref());
        let unit = stated.or(title.unit.as_deref());
        if let (Some(mapping), Some(_)) = (mapping, stated)
            && let Err(fault) = layout.scale(unit, known.kind)
        {
            let problem = mapping.problem(&fault.message, &fault.label);
            return Err(CsvFault::InMachine(problem.help(fault.help)));
        }
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
    table: &CsvTable,
    titles: &[Title],
    format: &Format,
    layout: &'l Layout,
) -> Result<Indices<'l>, CsvFault> {
    let mut found: Indices = titles.iter().map(|_| None).collect();
    for mapped in layout.mapped.iter().flatten() {
        let fault = |what: &str, label: &str, help: String| {
            CsvFault::InMachine(mapped.problem(what, label).help(help))
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
        if found.iter().flatten().any(|(other, _)| *other == index) {
            let help = "name one column for each quantity".to_owned();
            return Err(fault(
                "names a second column for its quantity",
                "twice",
                help,
            ));
        }
        let places = mapped.title.places(titles);
        if let [first, second, ..] = places.as_slice() {
            let what = format!(
                "is the title of columns {} and {} of the file",
                first + 1,
                second + 1
            );
            return Err(fault(
                &what,
                "which of them?",
                own_titles(table, titles, layout),
            ));
        }
        let at = places.first();
        let Some((at, taken)) = at.and_then(|at| Some((at, found.get_mut(*at)?))) else {
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
        *taken = Some((index, Some(mapped)));
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
    let mapped = or_mapped(titles, format, layout);
    let mut found: Indices = Vec::new();
    for (at, title) in titles.iter().enumerate() {
        let fault =
            |message: String| Problem::new(message).at(table.title_place(at), "this column");
        let Some(index) = (format.known.iter()).position(|known| known.is(&title.name)) else {
            // A cell that ends with a separator has nothing after it.
            if title.whole.is_empty()
                || (format.ignored)(&title.name)
                || format.of_log && layout.is_foreign(title.unit.as_deref(), format.known)
            {
                found.push(None);
                continue;
            }
            let names: Vec<&str> = format.known.iter().flat_map(|k| k.names).copied().collect();
            let near = did_you_mean(&title.name, &names);
            return Err(
                fault(format!("unknown column \"{}\"", plain::cut(&title.whole)))
                    .help(format!("{near}{help}{mapped}"))
                    .into(),
            );
        };
        if found.iter().flatten().any(|(other, _)| *other == index) {
            return Err(fault(format!("duplicate column \"{}\"", title.name))
                .help(format!("remove one of the two; {help}{mapped}"))
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
    // CODESYS names the points of a cam X, Y, V, A, with a "d" in structured text.
    let is_cam = titles
        .iter()
        .map(|title| title.name.trim_start_matches('d'))
        .eq(["X", "Y", "V", "A"]);
    let mut free: Vec<bool> = titles.iter().map(|_| true).collect();
    let mut entries = Vec::new();
    for (order, known) in format.known.iter().enumerate() {
        let is_free = |at: &usize| free.get(*at) == Some(&true);
        let name = |title: &Title| {
            let point = is_cam.then(|| format!("d{}", title.name.trim_start_matches('d')));
            point.unwrap_or_else(|| title.name.clone())
        };
        let by_name = titles.iter().position(|title| known.is(&name(title)));
        let mut by_unit = titles
            .iter()
            .enumerate()
            .filter(|(at, title)| is_free(at) && !is_named(title) && measures(title, known));
        let one = by_unit.next().filter(|_| by_unit.next().is_none());
        let by_order = (bare && !is_cam && order < 2).then_some(order);
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
            None => format!(" [{}]", suggested_unit(known)),
            Some(_) => String::new(),
        };
        entries.push([known.key().to_owned(), plain::cut(&title.whole) + &unit]);
    }
    if entries.len() < 2 {
        return String::new();
    }
    let join = |quote: &str, equals: &str, comma: &str| {
        let each = entries.iter();
        let each = each.map(|[key, title]| format!("{key}{equals}{quote}{title}{quote}"));
        each.collect::<Vec<_>>().join(comma)
    };
    // A log has no section of a machine file, but options.
    let place = if layout.section.is_empty() {
        format!("give --columns \"{}\"", join("", "=", ","))
    } else {
        format!(
            "write into {}: columns = {{ {} }}",
            layout.section,
            join("\"", " = ", ", ")
        )
    };
    format!(
        "; or leave the file as it is and {place}, with the units that the file has: its other columns are then passed over"
    )
}

/// The unit to suggest for a column: angles in degrees have derivatives per degree.
fn suggested_unit(known: &ColumnSpec) -> String {
    match known.kind.unit {
        "%" => "1".to_owned(),
        unit => unit.replace("/rad", "/deg"),
    }
}

/// The line for the machine file that gives each column a title of its own.
fn own_titles(table: &CsvTable, titles: &[Title], layout: &Layout) -> String {
    let own = titles.iter().enumerate().map(|(at, title)| {
        let before = titles.iter().take(at);
        let same = before.filter(|other| other.whole == title.whole).count();
        let unit = title.unit.as_ref();
        let unit = unit.map_or_else(String::new, |unit| format!(" [{unit}]"));
        let number = if same == 0 {
            String::new()
        } else {
            format!(" {}", same + 1)
        };
        format!("\"{}{number}{unit}\"", plain::cut(&title.name))
    });
    let own: Vec<String> = own.collect();
    // A line of units below the titles is one more.
    let below = titles.iter().any(|title| {
        let unit = title.unit.as_ref();
        unit.is_some_and(|unit| !title.whole.contains(unit.as_str()))
    });
    let lines = table.header_lines() + usize::from(below);
    let above = match layout.titles {
        Some(_) => String::new(),
        None => format!("skip_rows = {lines} and "),
    };
    if layout.section.is_empty() {
        return "give the columns titles of their own in the header".to_owned();
    }
    format!(
        "give the columns titles of their own, in {}: {above}header = [{}]",
        layout.section,
        own.join(", ")
    )
}

/// Refuses a file that begins with numbers or with lines of text above its header, or whose cells are separated by spaces; the cure is a key for the
/// machine file.
pub(super) fn check_first_lines(
    text: &str,
    titles: &[Title],
    format: &Format,
    layout: &Layout,
) -> Result<(), CsvFault> {
    let section = &layout.section;
    let first = |message: &str, label: &str, help: String| {
        let problem = Problem::new(message).at(header_place(text), label);
        Err(CsvFault::from(problem.help(help)))
    };
    if titles.iter().all(|title| cell::is_number(&title.whole)) {
        let suggested: Vec<String> = (format.known.iter().take(titles.len()))
            .map(|known| format!("\"{} [{}]\"", known.key(), known.kind.unit))
            .collect();
        let help = if section.is_empty() {
            format!(
                "write a first line with the titles of its columns and their units: {}",
                suggested.join(",").replace('"', "")
            )
        } else {
            format!(
                "write the titles of its {} columns into {section}, with the units that the file has: header = [{}]",
                titles.len(),
                suggested.join(", ")
            )
        };
        let message = "the file has no header: its first line has numbers";
        return first(message, "numbers", help);
    }
    let named = |title: &Title| {
        let mut mapped = layout.mapped.iter().flatten();
        format.known.iter().any(|known| known.is(&title.name))
            || mapped.any(|mapped| title.is_meant_by(&mapped.title))
    };
    if titles.iter().any(named) {
        return Ok(());
    }
    if let Some(lines) = lines_above_header(text) {
        let message = format!(
            "the titles of the columns are not in the first line, but in line {}",
            lines + 1
        );
        return first(
            &message,
            "a title?",
            format!("write skip_rows = {lines} into {section}"),
        );
    }
    let mut rows = text.lines().filter(|line| !line.trim().is_empty()).skip(1);
    let spaced = |line: &str| {
        let mut cells = line.split_whitespace();
        line.trim().contains(' ') && cells.all(cell::is_number)
    };
    if titles.len() == 1 && rows.next().is_some_and(spaced) {
        let help = "separate the cells by semicolons, commas or tabs".to_owned();
        return first("the cells are separated by spaces", "one cell", help);
    }
    Ok(())
}

/// Number of lines above the header, if lines of text precede it: the last line without numbers before the rows of numbers, or the last but one above
/// a line of units.
fn lines_above_header(text: &str) -> Option<usize> {
    let cells = |line: &str| -> Vec<String> {
        let separator = ['\t', ';'].into_iter().find(|c| line.contains(*c));
        let cells = line.split(separator.unwrap_or(','));
        cells
            .map(|text| cell::unquoted(text.trim()).to_owned())
            .collect()
    };
    let lines = text.trim_start_matches('\u{feff}').lines().enumerate();
    let mut lines = lines.filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'));
    let mut above: Vec<(usize, Vec<String>)> = Vec::new();
    loop {
        let (at, line) = lines.next()?;
        let row = cells(line);
        if row.iter().all(|cell| cell::is_number(cell)) {
            break;
        }
        above.push((at, row));
    }
    let (_, row) = above.last()?;
    let is_unit = |cell: &String| layout::is_unit(cell.trim_matches(['[', ']', '(', ')']));
    if above.len() > 1 && row.iter().all(is_unit) {
        above.pop();
    }
    let (at, header) = above.last()?;
    (above.len() > 1 && !header.iter().any(|cell| cell::is_number(cell))).then_some(*at)
}
