//! Merges the shares of a study into the file that a single run would have written, byte by byte.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::io::{BufReader, BufWriter, Error, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

use jred_machine::plain;
use jred_machine::text::disk;
use miette::{IntoDiagnostic as _, Report, Result, WrapErr as _, miette};

use super::store;
use crate::output::{self, Output};
use jred_report::table::rows::RowFormat;
use jred_sizing::study::header::Header;

/// The largest share that comes from a pipe (bytes); files are read line by line.
const MAX_PIPE: u64 = 64 << 20;

/// A share, read line by line.
struct Part {
    path: PathBuf,
    header: Header,
    form: RowFormat,
    reader: BufReader<Box<dyn Read>>,
    /// Lines read.
    lines: u64,
}

impl Part {
    fn open(path: &Path) -> Result<Self> {
        let file = disk::open(path, MAX_PIPE)
            .into_diagnostic()
            .wrap_err_with(|| format!("cannot read {}", plain::path(path)))?;
        let mut reader = BufReader::new(file);
        let mut line = String::new();
        store::read_line(&mut reader, &mut line, path)?;
        let (header, form) = store::parse(line.trim_end(), path)?;
        let mut lines = 1;
        if form == RowFormat::Csv {
            lines += 1;
            store::read_line(&mut reader, &mut line, path)?;
        }
        Ok(Self {
            path: path.to_owned(),
            header,
            form,
            reader,
            lines,
        })
    }

    /// The next row: its number and its line.
    fn next(&mut self) -> Result<Option<(u64, String)>> {
        let mut line = String::new();
        if !store::read_line(&mut self.reader, &mut line, &self.path)? {
            return Ok(None);
        }
        self.lines += 1;
        let whole = line.strip_suffix('\n').map(ToOwned::to_owned);
        let Some(whole) = whole else {
            return Err(miette!(
                help = "continue the share with --resume: it computes the incomplete row again",
                "{} contains an incomplete row: \"{}\"",
                plain::path(&self.path),
                plain::cut(line.trim_end())
            ));
        };
        match store::row(self.form, &self.header.columns, &whole) {
            Some((index, _)) => Ok(Some((index, whole))),
            None => Err(store::damaged(
                &format!("{} cannot be merged", plain::path(&self.path)),
                self.lines,
                &whole,
            )),
        }
    }
}

/// Merges shares into the file `out`; the number of rows.
///
/// # Errors
/// Shares of different studies; rows that are missing or there twice; a file that exists already.
pub fn merge(out: &Path, paths: &[PathBuf]) -> Result<u64> {
    let mut parts = paths
        .iter()
        .map(|path| Part::open(path))
        .collect::<Result<Vec<_>>>()?;
    let Some(first) = parts.first() else {
        return Err(miette!("name the files to merge"));
    };
    for part in &parts {
        if let Some(words) = first.header.difference(&part.header) {
            return Err(miette!(
                help = "merge shares of one study only",
                "{} and {} come from different studies: they differ in {words}",
                plain::path(&first.path),
                plain::path(&part.path)
            ));
        }
        if part.form != first.form {
            return Err(miette!(
                help = "use one --format for all shares",
                "{} and {} have different formats",
                plain::path(&first.path),
                plain::path(&part.path)
            ));
        }
    }
    let header = Header {
        shard: None,
        ..first.header.clone()
    };
    let front = store::lines(&header, first.form)?;
    output::check([("the first argument", &Some(out.to_owned()))])?;
    let failed = |error: Error| match error.kind() {
        ErrorKind::AlreadyExists => miette!(
            help = "choose another file",
            "{} already exists: not overwritten",
            plain::path(out)
        ),
        _ => output::failed(out, &error),
    };
    let mut file = BufWriter::new(Output::create_new(out).map_err(failed)?);
    file.write_all(front.as_bytes()).map_err(failed)?;
    let rows = rows(&mut parts, header.rows, &mut file)?;
    let file = file
        .into_inner()
        .map_err(|error| failed(error.into_error()))?;
    file.finish().map_err(failed)?;
    Ok(rows)
}

/// Writes the rows in order, each exactly once.
fn rows(parts: &mut [Part], count: u64, out: &mut impl Write) -> Result<u64> {
    let mut heap = BinaryHeap::new();
    for (k, part) in parts.iter_mut().enumerate() {
        if let Some((index, line)) = part.next()? {
            heap.push(Reverse((index, k, line)));
        }
    }
    let mut expected = 0;
    while let Some(Reverse((index, k, line))) = heap.pop() {
        if index > expected {
            return Err(missing(expected, Some(index)));
        }
        if index < expected {
            let path = parts.get(k).map(|part| plain::path(&part.path));
            return Err(miette!(
                help = "name every share once",
                "row {index} appears twice, the second time in {}",
                path.unwrap_or_default()
            ));
        }
        writeln!(out, "{line}").into_diagnostic()?;
        expected += 1;
        if let Some(part) = parts.get_mut(k)
            && let Some((index, line)) = part.next()?
        {
            heap.push(Reverse((index, k, line)));
        }
    }
    if expected < count {
        return Err(missing(expected, None));
    }
    if expected > count {
        return Err(miette!(
            "there are {expected} rows, but the study has {count}"
        ));
    }
    Ok(expected)
}

fn missing(from: u64, next: Option<u64>) -> Report {
    let words = next.map_or("and all rows after it".to_owned(), |next| {
        match next - from {
            1 => "alone".to_owned(),
            _ => format!("to row {}", next - 1),
        }
    });
    miette!(
        help = "name all shares, and complete the interrupted ones with --resume",
        "row {from} {words} is missing"
    )
}
