//! Merges the shares of a study into the file that a single run would have written, byte by byte.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::fs::File;
use std::io::{BufRead as _, BufReader, BufWriter, Write as _};
use std::path::{Path, PathBuf};

use miette::{IntoDiagnostic as _, Report, Result, WrapErr as _, miette};

use super::store;
use jred_report::table::rows::RowFormat;
use jred_sizing::study::header::Header;

/// A share, read line by line.
struct Part {
    path: PathBuf,
    header: Header,
    form: RowFormat,
    reader: BufReader<File>,
}

impl Part {
    fn open(path: &Path) -> Result<Self> {
        let file = File::open(path)
            .into_diagnostic()
            .wrap_err_with(|| format!("cannot read {}", path.display()))?;
        let mut reader = BufReader::new(file);
        let mut line = String::new();
        reader.read_line(&mut line).into_diagnostic()?;
        let (header, form) = store::parse(line.trim_end(), path)?;
        if form == RowFormat::Csv {
            reader.read_line(&mut line).into_diagnostic()?;
        }
        Ok(Self {
            path: path.to_owned(),
            header,
            form,
            reader,
        })
    }

    /// The next row: its number and its line.
    fn next(&mut self) -> Result<Option<(u64, String)>> {
        let mut line = String::new();
        if self.reader.read_line(&mut line).into_diagnostic()? == 0 {
            return Ok(None);
        }
        let whole = line.strip_suffix('\n').map(ToOwned::to_owned);
        let row = whole.and_then(|line| Some((self.form.index(&line)?, line)));
        row.map(Some).ok_or_else(|| {
            miette!(
                help = "continue the share with --resume: it computes the incomplete row again",
                "{} contains an incomplete row: {:?}",
                self.path.display(),
                line.trim_end().chars().take(60).collect::<String>()
            )
        })
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
                first.path.display(),
                part.path.display()
            ));
        }
        if part.form != first.form {
            return Err(miette!(
                help = "use one --format for all shares",
                "{} and {} have different formats",
                first.path.display(),
                part.path.display()
            ));
        }
    }
    let header = Header {
        shard: None,
        ..first.header.clone()
    };
    let front = store::lines(&header, first.form)?;
    // An incomplete file does not get the final name.
    let mut unfinished = out.as_os_str().to_owned();
    unfinished.push(".part");
    let unfinished = PathBuf::from(unfinished);
    if out.exists() {
        return Err(miette!(
            help = "choose another file",
            "{} already exists: not overwritten",
            out.display()
        ));
    }
    let _ = std::fs::remove_file(&unfinished);
    let file = store::begin(&unfinished, &front)?;
    let merged = rows(&mut parts, header.rows, BufWriter::new(file));
    match merged {
        Ok(rows) => {
            std::fs::rename(&unfinished, out)
                .into_diagnostic()
                .wrap_err_with(|| format!("cannot write {}", out.display()))?;
            Ok(rows)
        }
        Err(error) => {
            let _ = std::fs::remove_file(&unfinished);
            Err(error)
        }
    }
}

/// Writes the rows in order, each exactly once.
fn rows(parts: &mut [Part], count: u64, mut out: BufWriter<File>) -> Result<u64> {
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
            let path = parts.get(k).map(|part| part.path.display().to_string());
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
    out.flush().into_diagnostic()?;
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
