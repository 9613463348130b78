//! Files that the command writes.
//!
//! A file is written under a temporary name next to its final one and renamed when it is complete, so that an error, a full disk or a kill leaves the
//! old file intact. Only if the new file cannot get the owner of the old one, the old one is overwritten in place. A file of a study's rows is
//! different: it grows row by row and can be continued after an interruption (`rows/store.rs`).

use std::ffi::OsString;
use std::fs::{File, Metadata, OpenOptions};
use std::io::{Error, ErrorKind, Result as IoResult, Stdout, Write};
use std::path::{Path, PathBuf};
use std::sync::mpsc;
use std::time::Duration;

use jiff::tz::TimeZone;
use jiff::{Timestamp, ZonedDateTime};
use jred_file::plain;
use jred_file::text::disk;
use miette::{Report, Result, miette};

/// Stdout, unless it is a file that this command has read.
///
/// # Errors
/// Stdout is such a file: `jred reduce press.toml >> press.toml`.
pub fn stdout() -> Result<Stdout> {
    let stdout = std::io::stdout();
    if let Some(read) = stdout_metadata().and_then(|own| disk::read_under(&own)) {
        return Err(miette!(
            help = "redirect stdout to another file",
            "stdout is redirected to {}, which this command reads: nothing is written to it",
            plain::path(read)
        ));
    }
    Ok(stdout)
}

/// Refuses output files, each with its option, that this command has read, that stdout is redirected to, or that are one file under two names. Call
/// it after reading and before computing.
///
/// # Errors
/// A refused file.
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
        let mut named = others.iter();
        let same = named.find(|(_, other, known)| *known == place || is_one(other, path));
        if let Some((first, other, _)) = same {
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

/// Canonical path of a file that may not exist yet, even behind a symbolic link.
fn place(path: &Path) -> PathBuf {
    let path = &followed(path);
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
    let (Some(stdout), Ok(path)) = (stdout_metadata(), path.metadata()) else {
        return false;
    };
    is_same(Ok(stdout), Ok(path))
}

#[cfg(not(unix))]
fn is_stdout(_: &Path) -> bool {
    false
}

/// Metadata of stdout.
#[cfg(unix)]
fn stdout_metadata() -> Option<Metadata> {
    use std::os::fd::AsFd as _;
    let stdout = std::io::stdout().as_fd().try_clone_to_owned().ok()?;
    File::from(stdout).metadata().ok()
}

#[cfg(not(unix))]
fn stdout_metadata() -> Option<Metadata> {
    None
}

/// Whether two paths are hard links of one regular file.
#[cfg(unix)]
fn is_one(one: &Path, other: &Path) -> bool {
    is_same(one.metadata(), other.metadata())
}

#[cfg(not(unix))]
fn is_one(_: &Path, _: &Path) -> bool {
    false
}

#[cfg(unix)]
fn is_same(one: IoResult<Metadata>, other: IoResult<Metadata>) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    let identity = |file: Metadata| file.is_file().then(|| (file.dev(), file.ino()));
    let [one, other] = [one, other].map(|file| file.ok().and_then(identity));
    one.is_some() && one == other
}

/// Writes a file.
///
/// # Errors
/// It cannot be written; the old file is then intact, unless it has another owner.
pub fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    let mut files = Files::default();
    files.add(path, bytes)?;
    files.finish()
}

/// Files of one result: all are complete before the first is renamed.
#[derive(Debug, Default)]
pub struct Files(Vec<(PathBuf, Output)>);

impl Files {
    /// Writes one more file.
    ///
    /// # Errors
    /// It cannot be written; then no file is renamed.
    pub fn add(&mut self, path: &Path, bytes: &[u8]) -> Result<()> {
        let begun = Output::create(path).and_then(|mut output| {
            output.write_all(bytes)?;
            Ok(output)
        });
        let output = begun.map_err(|error| failed(path, &error))?;
        self.0.push((path.to_owned(), output));
        Ok(())
    }

    /// Renames the files to their final names.
    ///
    /// # Errors
    /// The disk is full; the files after the one that fails are not renamed.
    pub fn finish(self) -> Result<()> {
        for (path, output) in self.0 {
            output.finish().map_err(|error| failed(&path, &error))?;
        }
        Ok(())
    }
}

/// The report of a file that cannot be written.
pub fn failed(path: &Path, error: &Error) -> Report {
    let help = match error.kind() {
        ErrorKind::NotFound => "make the folder first, or choose another one",
        ErrorKind::NotADirectory => "a part of this path is a file: name a folder",
        ErrorKind::IsADirectory => "name a file in this folder",
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            "choose a file and a folder that you may write"
        }
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            "free some space, or choose another disk"
        }
        ErrorKind::TimedOut => "start the program that reads it first, or name a regular file",
        _ => "choose another file",
    };
    miette!(help = help, "cannot write {}: {error}", plain::path(path))
}

/// A file that is being written.
#[derive(Debug)]
pub struct Output {
    file: File,
    /// Temporary and final path; `None` for a file written in place.
    places: Option<[PathBuf; 2]>,
}

impl Output {
    /// Starts a file that replaces an old one.
    ///
    /// # Errors
    /// No permission to write the old file or its folder.
    pub fn create(path: &Path) -> IoResult<Self> {
        let old = match path.metadata() {
            Ok(old) => Some(old),
            Err(error) if error.kind() == ErrorKind::NotFound => None,
            Err(error) => return Err(error),
        };
        let write = |path: &Path| OpenOptions::new().write(true).open(path);
        let write_special = |path: &Path| patiently(path, PATIENCE);
        let in_place = |file| Self { file, places: None };
        let place = followed(path);
        // A file without write permission must not be replaced either.
        let old = match old {
            Some(old) if !old.is_file() => return Ok(in_place(write_special(path)?)),
            Some(old) => Some((write(&place)?, old)),
            None => None,
        };
        let (file, unfinished) = beside(&place)?;
        let output = Self {
            file,
            places: Some([unfinished, place]),
        };
        if let Some((file, old)) = old {
            if !is_given_to_owner(&output.file, &old) {
                file.set_len(0)?;
                return Ok(in_place(file));
            }
            output.file.set_permissions(old.permissions())?;
        }
        Ok(output)
    }

    /// Renames the complete file to its final name.
    ///
    /// # Errors
    /// The disk is full.
    pub fn finish(mut self) -> IoResult<()> {
        if self.file.metadata()?.is_file() {
            self.file.sync_all()?;
        }
        if let Some([unfinished, place]) = &self.places {
            std::fs::rename(unfinished, place)?;
        }
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
    /// Removes an unfinished file.
    fn drop(&mut self) {
        if let Some([unfinished, _]) = &self.places {
            let _ = std::fs::remove_file(unfinished);
        }
    }
}

/// Time to wait for the reader of a pipe.
pub const PATIENCE: Duration = Duration::from_secs(5);

/// Opens a pipe or a device for writing. Opening a pipe blocks until it has a reader, so a thread does it, which ends with the program.
///
/// # Errors
/// It cannot be written, or has no reader.
pub fn patiently(path: &Path, patience: Duration) -> IoResult<File> {
    let (sender, receiver) = mpsc::channel();
    let path = path.to_owned();
    std::thread::spawn(move || {
        let _ = sender.send(OpenOptions::new().write(true).open(path));
    });
    receiver.recv_timeout(patience).map_err(|_| {
        let message = format!(
            "it is a pipe, and no program has read it within {} s",
            patience.as_secs_f64()
        );
        Error::new(ErrorKind::TimedOut, message)
    })?
}

/// The target of a symbolic link, which need not exist; the link itself is kept.
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

/// Gives a new file the owner and group of the old one; returns whether that worked.
#[cfg(unix)]
fn is_given_to_owner(new: &File, old: &Metadata) -> bool {
    use std::os::unix::fs::{MetadataExt as _, fchown};
    let is_own = |new: Metadata| (new.uid(), new.gid()) == (old.uid(), old.gid());
    new.metadata().is_ok_and(is_own) || fchown(new, Some(old.uid()), Some(old.gid())).is_ok()
}

#[cfg(not(unix))]
fn is_given_to_owner(_: &File, _: &Metadata) -> bool {
    true
}

/// A new file in the folder of another one; skips names left by killed runs.
fn beside(place: &Path) -> IoResult<(File, PathBuf)> {
    let mut taken = 0u64;
    loop {
        let mut name = OsString::from(".jred-");
        name.push(format!("{}-{taken}.part", std::process::id()));
        let path = place.with_file_name(name);
        match OpenOptions::new().write(true).create_new(true).open(&path) {
            Ok(file) => return Ok((file, path)),
            Err(error) if error.kind() == ErrorKind::AlreadyExists => taken += 1,
            Err(error) => {
                let folder = place.parent().filter(|folder| *folder != Path::new(""));
                let folder = plain::path(folder.unwrap_or(Path::new(".")));
                let message = format!("no file can be made in the folder {folder}: {error}");
                return Err(Error::new(error.kind(), message));
            }
        }
    }
}

/// The day of the run: that of `SOURCE_DATE_EPOCH` (seconds), else today.
pub(crate) fn today() -> String {
    let epoch = std::env::var("SOURCE_DATE_EPOCH").ok();
    let fixed = epoch.and_then(|seconds| Timestamp::from_second(seconds.parse().ok()?).ok());
    let now = fixed.map_or_else(ZonedDateTime::now, |fixed| {
        fixed.to_zoned_datetime(TimeZone::UTC)
    });
    now.date().to_string()
}
