//! The file of a study's rows: a header that identifies the study, then one line per row, in order.
//!
//! The header is a JSON object on the first line (in CSV behind `# `). It contains digests of machine and catalogue, so that
//! rows of different studies are never mixed. A file that was cut off while it was written is one of fewer rows.

use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, Seek as _, SeekFrom};
use std::path::Path;

use miette::{IntoDiagnostic as _, Report, Result, WrapErr as _, miette};

use jred_report::table::rows::RowFormat;
use jred_sizing::study::header::Header;

fn no_rows(path: &Path) -> Report {
    miette!(
        help = "name files written by `jred vary --out` or `jred tolerance --out`",
        "{} is not a file of rows: its first line is not a header",
        path.display()
    )
}

/// The lines in front of the rows.
///
/// # Errors
/// None that can be provoked.
pub fn lines(header: &Header, form: RowFormat) -> Result<String> {
    let json = serde_json::to_string(header).into_diagnostic()?;
    Ok(format!(
        "{}{json}\n{}",
        form.mark(),
        form.names(&header.columns)
    ))
}

/// Reads a header from the first line of a file.
///
/// # Errors
/// A line that is none.
pub fn parse(line: &str, path: &Path) -> Result<(Header, RowFormat)> {
    let form = if line.starts_with("# ") {
        RowFormat::Csv
    } else {
        RowFormat::Json
    };
    let json = line.strip_prefix(form.mark()).unwrap_or(line);
    let header = serde_json::from_str(json).map_err(|_| no_rows(path))?;
    Ok((header, form))
}

/// Begins a file of rows, which must not exist yet.
///
/// # Errors
/// A file that exists or cannot be written.
pub fn begin(path: &Path, lines: &str) -> Result<File> {
    let mut file = OpenOptions::new()
        .write(true)
        .create_new(true)
        .open(path)
        .map_err(|error| match error.kind() {
            std::io::ErrorKind::AlreadyExists => miette!(
                help = "continue it with --resume, or choose another file",
                "{} already exists: not overwritten",
                path.display()
            ),
            _ => miette!("cannot write {}: {error}", path.display()),
        })?;
    std::io::Write::write_all(&mut file, lines.as_bytes())
        .into_diagnostic()
        .wrap_err_with(|| format!("cannot write {}", path.display()))?;
    Ok(file)
}

/// Opens a file of rows to continue it: the file, cut after its last whole row, and number of rows in it. Each row is
/// shown to `seen`.
///
/// # Errors
/// A file of another study, or rows out of order.
pub fn resume(
    path: &Path,
    header: &Header,
    form: RowFormat,
    seen: &mut dyn FnMut(u64, &str),
) -> Result<(File, u64)> {
    let shown = path.display();
    let unreadable = || format!("cannot read {shown}");
    let lines = lines(header, form)?;
    let mut file = OpenOptions::new()
        .read(true)
        .write(true)
        .open(path)
        .into_diagnostic()
        .wrap_err_with(unreadable)?;
    let mut reader = BufReader::new(&file);
    let (mut line, mut end, mut rows) = (String::new(), 0u64, 0u64);
    let mut number = 0usize;
    let fronts = lines.lines().count();
    loop {
        line.clear();
        let length = reader
            .read_line(&mut line)
            .into_diagnostic()
            .wrap_err_with(unreadable)?;
        if length == 0 || !line.ends_with('\n') {
            break;
        }
        let text = line.trim_end_matches('\n');
        if number == 0 {
            let (found, found_form) = parse(text, path)?;
            if let Some(words) = header.difference(&found) {
                return Err(miette!(
                    help = "repeat the command that started the file, or write to another file",
                    "{shown} cannot be continued: it differs in {words}"
                ));
            }
            if found_form != form || found.share() != header.share() {
                return Err(miette!(
                    help = "repeat --format and --shard of the command that started the file",
                    "{shown} cannot be continued: it has another format or contains another share"
                ));
            }
        } else if number >= fronts {
            let expected = header.share().row(rows);
            if form.index(text) != Some(expected) {
                return Err(miette!(
                    help = "write to another file",
                    "{shown} cannot be continued: line {} should be row {expected}",
                    number + 1
                ));
            }
            seen(expected, text);
            rows += 1;
        }
        end += length as u64;
        number += 1;
    }
    drop(reader);
    // A header that was cut off is written again.
    if number < fronts {
        let text = std::fs::read_to_string(path)
            .into_diagnostic()
            .wrap_err_with(unreadable)?;
        if !lines.starts_with(&text) {
            return Err(no_rows(path));
        }
        end = 0;
        rows = 0;
    }
    file.set_len(end).into_diagnostic()?;
    file.seek(SeekFrom::Start(end)).into_diagnostic()?;
    if number < fronts {
        std::io::Write::write_all(&mut file, lines.as_bytes()).into_diagnostic()?;
    }
    Ok((file, rows))
}
