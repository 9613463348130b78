//! Everything that the command writes: to the terminal, and to files.
//!
//! A file is written beside its place and renamed when it is complete, so that an error, a full disk or a kill leaves what was
//! there. A file of a study's rows is different: it grows row by row, to be continued after an interruption
//! (`rows/store.rs`).

use std::ffi::OsString;
use std::fs::{File, Metadata, OpenOptions};
use std::io::{Error, ErrorKind, Result as IoResult, Write};
use std::path::{Path, PathBuf};

use jred_machine::plain;
use jred_machine::text::disk;
use miette::{
    GraphicalReportHandler, GraphicalTheme, IntoDiagnostic as _, Report, Result, WrapErr as _,
    miette,
};

/// Prints to stdout; a closed pipe (`jred … | head`) is no error.
///
/// # Errors
/// The text cannot be written, as on a full disk.
pub fn print(text: &str) -> Result<()> {
    let mut stdout = std::io::stdout();
    let written = stdout
        .write_all(plain::lines(text).as_bytes())
        .and_then(|()| stdout.flush());
    match written {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(error)
            .into_diagnostic()
            .wrap_err("cannot write the result"),
        _ => Ok(()),
    }
}

/// Prints a line to stderr.
pub fn say(line: &str) {
    eprintln!("{}", plain::lines(line));
}

/// Prints an error to stderr; `plainly`: without colours, every hidden character escaped.
pub fn complain(report: &Report, plainly: bool) {
    if !plainly {
        eprintln!("{report:?}");
        return;
    }
    let mut text = String::new();
    let handler = GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor());
    match handler.render_report(&mut text, report.as_ref()) {
        Ok(()) => say(&text),
        Err(_) => say(&report.to_string()),
    }
}

/// Refuses output files, each with its option, that this command has read, that stdout is redirected to, or that are one file
/// under two names. To be asked when everything is read and nothing is computed.
///
/// # Errors
/// One of them is.
pub fn check<'p>(files: impl IntoIterator<Item = (&'p str, &'p Option<PathBuf>)>) -> Result<()> {
    let mut others: Vec<(&str, &Path, PathBuf)> = Vec::new();
    for (option, path) in files {
        let Some(path) = path else {
            continue;
        };
        let shown = plain::path(path);
        if let Some(read) = disk::read_as(path) {
            let read = plain::path(read);
            return Err(miette!(
                help = "choose another file",
                "{option} names {shown}, which is {}: not overwritten",
                if read == shown {
                    "read by this command".to_owned()
                } else {
                    format!("the file {read} that this command reads")
                }
            ));
        }
        if is_stdout(path) {
            return Err(miette!(
                help = "choose another file",
                "{option} names {shown}, to which stdout is redirected: the result would be lost"
            ));
        }
        let place = place(path);
        if let Some((first, other, _)) = others.iter().find(|(.., known)| *known == place) {
            let also = plain::path(other);
            return Err(miette!(
                help = "use two different files",
                "{first} and {option} both name {}: one would overwrite the other",
                if also == shown {
                    shown
                } else {
                    format!("one file, {also} and {shown}")
                }
            ));
        }
        others.push((option, path, place));
    }
    Ok(())
}

/// Canonical path of a file that may not exist yet.
fn place(path: &Path) -> PathBuf {
    let of_folder = || {
        let folder = path.parent().filter(|folder| *folder != Path::new(""));
        let folder = folder.unwrap_or(Path::new(".")).canonicalize().ok()?;
        Some(folder.join(path.file_name()?))
    };
    let own = path.canonicalize().ok();
    own.or_else(of_folder).unwrap_or_else(|| path.to_owned())
}

/// Whether a path is the regular file that stdout is redirected to.
#[cfg(unix)]
fn is_stdout(path: &Path) -> bool {
    use std::os::fd::AsFd as _;
    use std::os::unix::fs::MetadataExt as _;
    let stdout = || {
        let file = File::from(std::io::stdout().as_fd().try_clone_to_owned().ok()?);
        let [own, other] = [file.metadata().ok()?, path.metadata().ok()?];
        Some(own.is_file() && (own.dev(), own.ino()) == (other.dev(), other.ino()))
    };
    stdout().unwrap_or(false)
}

#[cfg(not(unix))]
fn is_stdout(_: &Path) -> bool {
    false
}

/// Writes a file.
///
/// # Errors
/// It cannot be written; then it is as it was.
pub fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    let written = Output::create(path).and_then(|mut output| {
        output.write_all(bytes)?;
        output.finish()
    });
    written.map_err(|error| failed(path, &error))
}

/// The report of a file that cannot be written.
pub fn failed(path: &Path, error: &Error) -> Report {
    miette!("cannot write {}: {error}", plain::path(path))
}

/// A file in the making.
#[derive(Debug)]
pub struct Output {
    file: File,
    /// Where it is written, and where it belongs; nothing for a pipe or a device.
    places: Option<[PathBuf; 2]>,
}

impl Output {
    /// Begins a file.
    ///
    /// # Errors
    /// The old file must not be written, or its folder.
    pub fn create(path: &Path) -> IoResult<Self> {
        let old = match path.metadata() {
            Ok(old) => Some(old),
            Err(error) if error.kind() == ErrorKind::NotFound => None,
            Err(error) => return Err(error),
        };
        let write = |path: &Path| OpenOptions::new().write(true).open(path);
        if old.as_ref().is_some_and(|old| !old.is_file()) {
            let file = write(path)?;
            return Ok(Self { file, places: None });
        }
        let place = followed(path);
        if old.is_some() {
            // Who may not write a file must not replace it either.
            write(&place)?;
        }
        let (file, unfinished) = beside(&place)?;
        let output = Self {
            file,
            places: Some([unfinished, place]),
        };
        if let Some(permissions) = old.as_ref().map(Metadata::permissions) {
            output.file.set_permissions(permissions)?;
        }
        Ok(output)
    }

    /// Puts the complete file in its place.
    ///
    /// # Errors
    /// The disk is full, or something else is in that place.
    pub fn finish(mut self) -> IoResult<()> {
        let Some([unfinished, place]) = &self.places else {
            return self.file.flush();
        };
        self.file.sync_all()?;
        std::fs::rename(unfinished, place)?;
        self.places = None;
        Ok(())
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> IoResult<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> IoResult<()> {
        self.file.flush()
    }
}

impl Drop for Output {
    /// What is not finished leaves nothing behind.
    fn drop(&mut self) {
        if let Some([unfinished, _]) = &self.places {
            let _ = std::fs::remove_file(unfinished);
        }
    }
}

/// Where a symbolic link leads, so that the link stays: to a file that need not exist.
fn followed(path: &Path) -> PathBuf {
    let mut place = path.to_owned();
    for _ in 0..40 {
        let Ok(next) = place.read_link() else {
            break;
        };
        place = place.parent().unwrap_or(Path::new("")).join(next);
    }
    place
}

/// A new file in the folder of another one.
fn beside(place: &Path) -> IoResult<(File, PathBuf)> {
    let mut taken = 0;
    loop {
        let mut name = OsString::from(".jred-");
        name.push(format!("{}-{taken}.part", std::process::id()));
        let path = place.with_file_name(name);
        match OpenOptions::new().write(true).create_new(true).open(&path) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists && taken < 100 => taken += 1,
            opened => return Ok((opened?, path)),
        }
    }
}
