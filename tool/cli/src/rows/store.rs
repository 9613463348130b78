//! The file of a study's rows: a header that identifies the study, then one line per row, in order.
//!
//! The header is a JSON object: the first line in JSON, the cell `study` of the first row in CSV, so that spreadsheets and data frames read the file
//! as it is. It contains digests of machine and catalogue, so that rows of different studies are never mixed. A file that was cut off while it was
//! written is a valid file with fewer rows. Therefore it is written in place, unlike other outputs: a new file must not exist, and a resumed one must
//! belong to this study.

use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, Read as _, Seek as _, SeekFrom, Write as _};
use std::path::Path;

use jred_file::plain;
use miette::{IntoDiagnostic as _, Report, Result, WrapErr as _, miette};

use crate::output;
use jred_report::table::rows::RowFormat;
use jred_sizing::cell::Cell;
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
/// None in practice.
pub fn study(header: &Header) -> Result<String> {
    serde_json::to_string(header).into_diagnostic()
}

/// The row format of a file, from its first line.
///
/// # Errors
/// A line that does not start a file of rows.
pub fn form(line: &str, path: &Path) -> Result<RowFormat> {
    match line {
        _ if line.starts_with('{') => Ok(RowFormat::Json),
        _ if line.starts_with("row,") && line.ends_with(",study") => Ok(RowFormat::Csv),
        _ => Err(no_rows(path)),
    }
}

/// Reads a header.
///
/// # Errors
/// Text that is not a header.
pub fn parse(json: &str, path: &Path) -> Result<Header> {
    let header: Header = serde_json::from_str(json).map_err(|_| no_rows(path))?;
    // Otherwise the rows below it could not be read again.
    if header.columns.iter().all(|name| is_clean(name)) {
        Ok(header)
    } else {
        Err(no_rows(path))
    }
}

/// Whether a text contains only characters that rows may contain.
fn is_clean(text: &str) -> bool {
    !text.contains(|c: char| c.is_control() || c == char::REPLACEMENT_CHARACTER)
}

/// Longest line of a file of rows (bytes).
const MAX_LINE: u64 = 1 << 20;

/// Reads a line; returns whether there was one.
fn read_line(reader: &mut impl BufRead, line: &mut String, path: &Path) -> Result<bool> {
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
    // Invalid UTF-8 becomes a character that no row contains.
    line.push_str(&String::from_utf8_lossy(&bytes));
    Ok(length > 0)
}

/// Starts a file of rows, which must not exist yet; a pipe or a device may.
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
            "{} is a dangling symbolic link: no file is created through it",
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

/// Opens a file of rows to resume it: the file, cut after its last complete row, and its number of rows. Each row is passed to `seen`.
///
/// # Errors
/// A file of another study, a line that is not one of its rows, or rows out of order.
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
            if let (2, RowFormat::Csv, Some(found)) = (number, form, RowFormat::study_of(text)) {
                same(&parse(&found, path)?)?;
            }
            let expected = header.share().row(rows);
            let row = is_clean(text).then(|| form.row(text, &header.columns));
            let Some((index, cells)) = row.flatten() else {
                return Err(miette!(
                    help = format!(
                        "delete line {number} and all lines after it: --resume computes them again"
                    ),
                    "{shown} cannot be continued: line {number} is damaged, it is no row of this study: \"{}\"",
                    plain::cut(text)
                ));
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
    // An incomplete first line is written again.
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
