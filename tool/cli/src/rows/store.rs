//! The file of a study's rows: a header that identifies the study, then one line per row, in order.
//!
//! The header is a JSON object: in JSON the first line, in CSV the cell `study` of the first row, so that spreadsheets and data
//! frames read the file as it is. It contains digests of machine and catalogue, so that
//! rows of different studies are never mixed. A file that was cut off while it was written is one of fewer rows. So it is
//! written where it belongs, unlike other outputs; it begins only where no file is, and is continued only if it is of this
//! study.

use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, Read as _, Seek as _, SeekFrom, Write as _};
use std::path::Path;

use jred_file::plain;
use miette::{IntoDiagnostic as _, Report, Result, WrapErr as _, miette};

use crate::output;
use jred_report::table::rows::RowFormat;
use jred_sizing::study::cell::Cell;
use jred_sizing::study::header::Header;

fn no_rows(path: &Path) -> Report {
    miette!(
        help = "name files written by `jred vary --out` or `jred tolerance --out`",
        "{} is not a file of rows: its first line is not a header",
        plain::path(path)
    )
}

/// The header as text.
///
/// # Errors
/// None that can be provoked.
pub fn study(header: &Header) -> Result<String> {
    serde_json::to_string(header).into_diagnostic()
}

/// How the rows of a file are written, by its first line.
///
/// # Errors
/// A line that begins no file of rows.
pub fn form(line: &str, path: &Path) -> Result<RowFormat> {
    match line {
        _ if line.starts_with('{') => Ok(RowFormat::Json),
        _ if line.starts_with("row,") && line.ends_with(",study,check") => Ok(RowFormat::Csv),
        _ => Err(no_rows(path)),
    }
}

/// Reads a header.
///
/// # Errors
/// A text that is none.
pub fn parse(json: &str, path: &Path) -> Result<Header> {
    let header: Header = serde_json::from_str(json).map_err(|_| no_rows(path))?;
    // Otherwise no row that is written below it could be read again.
    if header.columns.iter().all(|name| is_clean(name)) {
        Ok(header)
    } else {
        Err(no_rows(path))
    }
}

/// Whether a text contains nothing that no row does.
fn is_clean(text: &str) -> bool {
    !text.contains(|c: char| c.is_control() || c == char::REPLACEMENT_CHARACTER)
}

/// The longest line of a file of rows (bytes).
const MAX_LINE: u64 = 1 << 20;

/// Reads a line; whether there was one.
///
/// # Errors
/// The file cannot be read, or its line is longer than any row.
pub fn read_line(reader: &mut impl BufRead, line: &mut String, path: &Path) -> Result<bool> {
    line.clear();
    let mut bytes = Vec::new();
    let length = reader
        .take(MAX_LINE)
        .read_until(b'\n', &mut bytes)
        .into_diagnostic()
        .wrap_err_with(|| format!("cannot read {}", plain::path(path)))?;
    if length as u64 == MAX_LINE {
        return Err(miette!(
            help = "name files written by `jred vary --out` or `jred tolerance --out`",
            "{} is not a file of rows: it has a line of more than 1 MiB",
            plain::path(path)
        ));
    }
    // What is no UTF-8 becomes a character that no row has.
    line.push_str(&String::from_utf8_lossy(&bytes));
    Ok(length > 0)
}

/// Begins a file of rows, which must not exist yet; a pipe or a device may.
///
/// # Errors
/// A file that exists or cannot be written.
pub fn begin(path: &Path, lines: &str) -> Result<File> {
    let device = path.metadata().is_ok_and(|old| !old.is_file());
    let file = if device {
        output::patiently(path, output::PATIENCE)
    } else {
        OpenOptions::new().write(true).create_new(true).open(path)
    };
    let mut file = file.map_err(|error| match error.kind() {
        std::io::ErrorKind::AlreadyExists if !path.exists() => miette!(
            help = "name the file itself, or remove the link",
            "{} is a symbolic link that leads nowhere: no file begins behind it",
            plain::path(path)
        ),
        std::io::ErrorKind::AlreadyExists => miette!(
            help = "continue it with --resume, or choose another file",
            "{} already exists: not overwritten",
            plain::path(path)
        ),
        _ => output::failed(path, &error),
    })?;
    file.write_all(lines.as_bytes())
        .map_err(|error| output::failed(path, &error))?;
    Ok(file)
}

/// The number and the cells of a line; `None`: it is no row of these columns, or contains what no row does.
pub fn row(form: RowFormat, columns: &[String], line: &str) -> Option<(u64, Vec<Cell>)> {
    is_clean(line).then(|| form.row(line, columns))?
}

/// What is said of a line that is no row; `what` names the file and what cannot be done with it.
pub fn damaged(what: &str, line: u64, text: &str) -> Report {
    miette!(
        help = format!("delete line {line} and all lines after it: --resume computes them again"),
        "{what}: line {line} is damaged, it is no row of this study: \"{}\"",
        plain::cut(text)
    )
}

/// Opens a file of rows to continue it: the file, cut after its last whole row, and number of rows in it. Each row is
/// shown to `seen`.
///
/// # Errors
/// A file of another study, a line that is no row of it, or rows out of order.
pub fn resume(
    path: &Path,
    header: &Header,
    form: RowFormat,
    seen: &mut dyn FnMut(u64, &[Cell]),
) -> Result<(File, u64)> {
    let shown = plain::path(path);
    let front = form.front(&study(header)?, &header.columns);
    let mut file = OpenOptions::new()
        .read(true)
        .write(true)
        .open(path)
        .into_diagnostic()
        .wrap_err_with(|| format!("cannot read {shown}"))?;
    let mut reader = BufReader::new(&file);
    let mut line = String::new();
    let (mut end, mut rows) = (0u64, 0u64);
    let mut number = 0u64;
    let same = |found: &Header| {
        if let Some(words) = header.difference(found) {
            return Err(miette!(
                help = "repeat the command that started the file, or write to another file",
                "{shown} cannot be continued: it differs in {words}"
            ));
        }
        if found.share() != header.share() {
            return Err(other_form(&shown));
        }
        Ok(())
    };
    loop {
        if !read_line(&mut reader, &mut line, path)? || !line.ends_with('\n') {
            break;
        }
        let text = line.trim_end_matches('\n');
        number += 1;
        if number == 1 {
            let found = self::form(text, path)?;
            if found == RowFormat::Json {
                same(&parse(text, path)?)?;
            }
            if found != form {
                return Err(other_form(&shown));
            }
        } else {
            if let (2, RowFormat::Csv, Some((found, _))) = (number, form, RowFormat::study_of(text))
            {
                same(&parse(&found, path)?)?;
            }
            let expected = header.share().row(rows);
            let Some((index, cells)) = row(form, &header.columns, text) else {
                let what = format!("{shown} cannot be continued");
                return Err(damaged(&what, number, text));
            };
            if index != expected {
                return Err(miette!(
                    help = "write to another file",
                    "{shown} cannot be continued: line {number} should be row {expected}"
                ));
            }
            seen(expected, &cells);
            rows += 1;
        }
        end += line.len() as u64;
    }
    drop(reader);
    // A first line that was cut off is written again.
    if number == 0 && !front.starts_with(&line) {
        return Err(no_rows(path));
    }
    file.set_len(end).into_diagnostic()?;
    file.seek(SeekFrom::Start(end)).into_diagnostic()?;
    if number == 0 {
        file.write_all(front.as_bytes()).into_diagnostic()?;
    }
    Ok((file, rows))
}

fn other_form(shown: &str) -> Report {
    miette!(
        help = "repeat --format and --shard of the command that started the file",
        "{shown} cannot be continued: it has another format or contains another share"
    )
}
