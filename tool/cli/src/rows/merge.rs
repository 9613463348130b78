//! Merges the shares of a study into the file that a single run would have written, byte by byte.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::io::{BufReader, BufWriter, Error, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

use jred_file::plain;
use jred_file::text::disk;
use miette::{IntoDiagnostic as _, Report, Result, WrapErr as _, miette};

use super::store;
use crate::output::{self, Output};
use jred_report::table::rows::{RowFormat, with_study};
use jred_sizing::study::header::Header;

/// Largest share from a pipe (bytes); files are read line by line.
const MAX_PIPE: u64 = 64 << 20;

/// A share, read line by line.
struct ShardFile {
    path: PathBuf,
    form: RowFormat,
    /// `None`: a share without rows, in CSV.
    header: Option<Header>,
    /// Column names of CSV.
    names: String,
    reader: BufReader<Box<dyn Read>>,
    /// The row read with the header.
    first: Option<String>,
    /// Lines read.
    lines: u64,
}

impl ShardFile {
    fn open(path: &Path) -> Result<Self> {
        let file = disk::open(path, MAX_PIPE)
            .into_diagnostic()
            .wrap_err_with(|| format!("cannot read {}", plain::path(path)))?;
        let mut part = Self {
            path: path.to_owned(),
            form: RowFormat::Json,
            header: None,
            names: String::new(),
            reader: BufReader::new(file),
            first: None,
            lines: 0,
        };
        let mut line = String::new();
        part.read(&mut line)?;
        part.form = store::form(line.trim_end(), path)?;
        if part.form == RowFormat::Json {
            part.header = Some(store::parse(line.trim_end(), path)?);
            return Ok(part);
        }
        line.trim_end().clone_into(&mut part.names);
        if part.read(&mut line)? {
            let Some((study, _)) = RowFormat::study_of(line.trim_end()) else {
                return Err(part.damaged(line.trim_end()));
            };
            part.header = Some(store::parse(&study, path)?);
            part.first = Some(line);
        }
        Ok(part)
    }

    fn read(&mut self, line: &mut String) -> Result<bool> {
        let read = store::read_line(&mut self.reader, line, &self.path)?;
        self.lines += u64::from(read);
        Ok(read)
    }

    fn damaged(&self, line: &str) -> Report {
        let what = format!("{} cannot be merged", plain::path(&self.path));
        store::damaged(&what, self.lines, line)
    }

    /// The next row: its number and its line.
    fn next(&mut self) -> Result<Option<(u64, String)>> {
        let mut line = String::new();
        match self.first.take() {
            Some(first) => line = first,
            None => {
                if !self.read(&mut line)? {
                    return Ok(None);
                }
            }
        }
        let Some(whole) = line.strip_suffix('\n') else {
            return Err(miette!(
                help = "continue the share with --resume: it computes the incomplete row again",
                "{} contains an incomplete row: \"{}\"",
                plain::path(&self.path),
                plain::cut(line.trim_end())
            ));
        };
        let columns = self.header.as_ref().map(|header| header.columns.as_slice());
        match store::row(self.form, columns.unwrap_or_default(), whole) {
            Some((index, _)) => Ok(Some((index, whole.to_owned()))),
            None => Err(self.damaged(whole)),
        }
    }
}

/// Merges shares into the file `out`; returns the number of rows.
///
/// # Errors
/// Shares of different studies; missing or duplicate rows; an existing file.
pub fn merge(out: &Path, paths: &[PathBuf]) -> Result<u64> {
    let mut parts = paths
        .iter()
        .map(|path| ShardFile::open(path))
        .collect::<Result<Vec<_>>>()?;
    if parts.is_empty() {
        return Err(miette!("name the files to merge"));
    }
    let with_rows = parts
        .iter()
        .find_map(|part| Some((part, part.header.as_ref()?)));
    let Some((first, header)) = with_rows else {
        return Err(miette!(
            help = "name all shares",
            "none of the files contains a row"
        ));
    };
    for part in &parts {
        let words = match &part.header {
            Some(other) => header.difference(other),
            None => (part.names != first.names).then(|| "the columns".to_owned()),
        };
        if part.form != first.form {
            return Err(miette!(
                help = "use one --format for all shares",
                "{} and {} have different formats",
                plain::path(&first.path),
                plain::path(&part.path)
            ));
        }
        if let Some(words) = words {
            return Err(miette!(
                help = "merge shares of one study only",
                "{} and {} come from different studies: they differ in {words}",
                plain::path(&first.path),
                plain::path(&part.path)
            ));
        }
    }
    let form = first.form;
    let header = Header {
        shard: None,
        ..header.clone()
    };
    let study = store::study(&header)?;
    let front = form.front(&study, &header.columns);
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
    let rows = rows(&mut parts, &header, &study, &mut file)?;
    let file = file
        .into_inner()
        .map_err(|error| failed(error.into_error()))?;
    file.finish().map_err(failed)?;
    Ok(rows)
}

/// Writes the rows in order, each exactly once.
fn rows(
    parts: &mut [ShardFile],
    header: &Header,
    study: &str,
    out: &mut impl Write,
) -> Result<u64> {
    let count = header.rows;
    let mut heap = BinaryHeap::new();
    for (k, part) in parts.iter_mut().enumerate() {
        if let Some((index, line)) = part.next()? {
            heap.push(Reverse((index, k, line)));
        }
    }
    let is_csv = parts
        .first()
        .is_some_and(|part| part.form == RowFormat::Csv);
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
        // The first row of each share names its study; the first row of the whole names the whole study.
        let line = match RowFormat::study_of(&line) {
            Some((_, cells)) if is_csv => with_study(cells, (index == 0).then_some(study)),
            _ => line + "\n",
        };
        out.write_all(line.as_bytes()).into_diagnostic()?;
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
