//! Files on disk: the only module of the tool that reads them.
//!
//! Every read is limited in bytes. Reading from anything but a regular file (a pipe without a writer, a terminal, an endless device) is limited in
//! time too. The files read are recorded, so that no output overwrites one of them.

use std::cell::RefCell;
use std::collections::HashMap;
use std::fs::{File, Metadata};
use std::io::{Error, ErrorKind, Read, Result, Stdin};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{LazyLock, Mutex, PoisonError, mpsc};
use std::time::Duration;

use super::file::{Files, LARGE, size, too_large};
use crate::plain;
use crate::units::Fault;

/// Longest wait for the end of a pipe or a device.
const PATIENCE: Duration = Duration::from_secs(5);

/// A folder; names of files are relative to it.
impl Files for Path {
    fn shown(&self, file: &str) -> String {
        plain::path(self.join(file))
    }

    fn text(&self, file: &str, limit: u64) -> std::result::Result<String, Fault> {
        decoded(bytes_of(&self.join(file), limit)?)
    }
}

impl Files for PathBuf {
    fn shown(&self, file: &str) -> String {
        self.as_path().shown(file)
    }

    fn text(&self, file: &str, limit: u64) -> std::result::Result<String, Fault> {
        self.as_path().text(file, limit)
    }
}

thread_local! {
    /// Texts that stand for files.
    static TEXTS: RefCell<Vec<(PathBuf, String)>> = const { RefCell::new(Vec::new()) };
}

/// Runs `work`, for which each of `texts` stands for the file at its path on this thread. Files read before count as read no longer, unless
/// another thread is at such a work.
pub fn with_texts<T>(texts: Vec<(PathBuf, String)>, work: impl FnOnce() -> T) -> T {
    /// Ends the work, even by a panic.
    struct End(Vec<(PathBuf, String)>);
    impl Drop for End {
        fn drop(&mut self) {
            TEXTS.set(std::mem::take(&mut self.0));
            RUNNING.fetch_sub(1, Ordering::AcqRel);
        }
    }
    if RUNNING.fetch_add(1, Ordering::AcqRel) == 0 {
        FILES.lock().unwrap_or_else(PoisonError::into_inner).clear();
    }
    let _end = End(TEXTS.replace(texts));
    work()
}

/// How many threads are at a work with texts.
static RUNNING: AtomicUsize = AtomicUsize::new(0);

/// A folder with the texts of this thread, for any thread.
#[derive(Clone, Debug)]
pub struct Folder {
    path: PathBuf,
    texts: Vec<(PathBuf, String)>,
}

impl Folder {
    /// The folder at this path.
    pub fn new(path: PathBuf) -> Self {
        Self {
            path,
            texts: TEXTS.with_borrow(Clone::clone),
        }
    }
}

impl Files for Folder {
    fn shown(&self, file: &str) -> String {
        self.path.shown(file)
    }

    fn text(&self, file: &str, limit: u64) -> std::result::Result<String, Fault> {
        let path = self.path.join(file);
        match self.texts.iter().find(|(own, _)| *own == path) {
            Some((_, text)) => Ok(text.clone()),
            None => self.path.text(file, limit),
        }
    }
}

/// Whether there is a file at `path`, or a text that stands for it.
pub fn exists(path: &Path) -> bool {
    standing_in(path).is_some() || path.exists()
}

/// The text that stands for the file at `path`.
fn standing_in(path: &Path) -> Option<Vec<u8>> {
    TEXTS.with_borrow(|texts| {
        let text = texts.iter().find(|(own, _)| own == path);
        text.map(|(_, text)| text.clone().into_bytes())
    })
}

/// The text of the file at `path`, of at most `limit` bytes.
pub(crate) fn read(path: &Path, limit: u64) -> std::result::Result<String, Fault> {
    utf8(bytes_of(path, limit)?)
}

fn bytes_of(path: &Path, limit: u64) -> std::result::Result<Vec<u8>, Fault> {
    if let Some(text) = standing_in(path) {
        if let Ok(metadata) = path.metadata() {
            remember(path, &metadata);
        }
        return Ok(text);
    }
    bytes(path, limit).map_err(|error| fault(&error, path))
}

/// The text of standard input, of at most `limit` bytes; it is read once, however often it is asked for.
pub(crate) fn read_stdin(limit: u64) -> std::result::Result<String, Fault> {
    static TEXT: Mutex<Option<String>> = Mutex::new(None);
    let mut known = TEXT.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(text) = &*known {
        return Ok(text.clone());
    }
    let stdin = std::io::stdin();
    remember_stdin(&stdin);
    let bytes = limited(stdin.lock(), limit);
    let text = utf8(bytes.map_err(|error| fault(&error, Path::new("standard input")))?)?;
    Ok(known.insert(text).clone())
}

/// Standard input may be a file, which must not be overwritten.
fn remember_stdin(stdin: &Stdin) {
    #[cfg(unix)]
    {
        use std::os::fd::AsFd as _;
        let file = stdin.as_fd().try_clone_to_owned().map(File::from);
        if let Ok(metadata) = file.and_then(|file| file.metadata())
            && metadata.is_file()
        {
            remember(Path::new("standard input"), &metadata);
        }
    }
    #[cfg(not(unix))]
    let _ = stdin;
}

fn fault(error: &Error, path: &Path) -> Fault {
    match error.kind() {
        ErrorKind::NotFound => Fault::new(
            "no such file",
            format!(
                "check the name and the folder; looked for {}",
                absolute(path)
            ),
        ),
        ErrorKind::PermissionDenied => Fault::new(
            "permission denied",
            format!("make {} readable", absolute(path)),
        ),
        ErrorKind::IsADirectory => Fault::new("it is a folder, not a file", "name the file in it"),
        ErrorKind::FileTooLarge => Fault::new(error.to_string(), LARGE),
        ErrorKind::TimedOut => Fault::new(error.to_string(), SLOW),
        _ => Fault::new(error.to_string(), format!("check {}", absolute(path))),
    }
}

/// Cure for an endless pipe or device.
pub const SLOW: &str = "name a regular file, or write the data to one first";

/// The content of the file at `path`, of at most `limit` bytes; a regular file is recorded as read.
///
/// # Errors
/// Errors of the system; [`ErrorKind::FileTooLarge`] above the limit; [`ErrorKind::TimedOut`] if `path` is not a regular file and does not end within
/// 5 s.
pub fn bytes(path: &Path, limit: u64) -> Result<Vec<u8>> {
    let metadata = path.metadata()?;
    if metadata.is_dir() {
        return Err(ErrorKind::IsADirectory.into());
    }
    if !metadata.is_file() {
        return stream(path, limit, PATIENCE);
    }
    remember(path, &metadata);
    if metadata.len() > limit {
        return Err(above(&size(metadata.len()), limit));
    }
    limited(File::open(path)?, limit)
}

/// The content of a pipe or a device. Opening a pipe waits for its writer; so a thread opens and reads it, which lives no longer than the program.
fn stream(path: &Path, limit: u64, patience: Duration) -> Result<Vec<u8>> {
    let (sender, receiver) = mpsc::channel();
    let path = path.to_owned();
    std::thread::spawn(move || {
        let _ = sender.send(File::open(path).and_then(|file| limited(file, limit)));
    });
    receiver.recv_timeout(patience).map_err(|_| {
        let message = format!(
            "it is not a regular file, and it did not end within {} s",
            patience.as_secs_f64()
        );
        Error::new(ErrorKind::TimedOut, message)
    })?
}

fn limited(file: impl Read, limit: u64) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.take(limit + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit {
        return Err(above(&format!("more than {}", size(limit)), limit));
    }
    Ok(bytes)
}

fn above(size: &str, limit: u64) -> Error {
    Error::new(ErrorKind::FileTooLarge, too_large(size, limit))
}

/// Identifies a file independently of its name, and thus links to it: device and inode.
#[cfg(unix)]
type Identity = (u64, u64);

#[cfg(unix)]
#[expect(
    clippy::unnecessary_wraps,
    reason = "the same function elsewhere can fail"
)]
fn identity(_: &Path, metadata: &Metadata) -> Option<Identity> {
    use std::os::unix::fs::MetadataExt as _;
    Some((metadata.dev(), metadata.ino()))
}

/// Identifies a file: its canonical path.
#[cfg(not(unix))]
type Identity = PathBuf;

#[cfg(not(unix))]
fn identity(path: &Path, _: &Metadata) -> Option<Identity> {
    path.canonicalize().ok()
}

/// The regular files that this process has read, with the path at the first read.
static FILES: LazyLock<Mutex<HashMap<Identity, PathBuf>>> = LazyLock::new(Mutex::default);

fn remember(path: &Path, metadata: &Metadata) {
    if let Some(identity) = identity(path, metadata) {
        let mut files = FILES.lock().unwrap_or_else(PoisonError::into_inner);
        files.entry(identity).or_insert_with(|| path.to_owned());
    }
}

/// The path by which this process has read the file at `path`, if it has.
pub fn read_as(path: &Path) -> Option<PathBuf> {
    known(&identity(path, &path.metadata().ok()?)?)
}

/// [`read_as`] for an open file, by its device and inode; always `None` on systems without them.
pub fn read_under(metadata: &Metadata) -> Option<PathBuf> {
    known(&identity(Path::new(""), metadata)?)
}

fn known(identity: &Identity) -> Option<PathBuf> {
    let files = FILES.lock().unwrap_or_else(PoisonError::into_inner);
    files.get(identity).cloned()
}

/// The text of another program's file. Besides UTF-8 it can be UTF-16 with a byte order mark, or Latin-1 without control characters: spreadsheets
/// save text files in both.
fn decoded(bytes: Vec<u8>) -> std::result::Result<String, Fault> {
    let wide = match bytes.as_slice() {
        [0xff, 0xfe, rest @ ..] => Some((rest, u16::from_le_bytes as fn([u8; 2]) -> u16)),
        [0xfe, 0xff, rest @ ..] => Some((rest, u16::from_be_bytes as fn([u8; 2]) -> u16)),
        _ => None,
    };
    if let Some((rest, unit)) = wide {
        let units: Vec<u16> = rest
            .as_chunks::<2>()
            .0
            .iter()
            .map(|pair| unit(*pair))
            .collect();
        return String::from_utf16(&units).map_err(|_| {
            Fault::new(
                "it begins as UTF-16 text, but is not valid UTF-16",
                "save it as UTF-8 text",
            )
        });
    }
    let is_printed = |byte: &u8| matches!(byte, b'\t' | b'\n' | b'\r' | 0x20..=0x7e | 0xa0..);
    if std::str::from_utf8(&bytes).is_err() && bytes.iter().all(is_printed) {
        return Ok(bytes.into_iter().map(char::from).collect());
    }
    utf8(bytes)
}

/// The text of a file.
///
/// # Errors
/// It is not UTF-8; the message gives the line of the first invalid byte.
pub fn utf8(bytes: Vec<u8>) -> std::result::Result<String, Fault> {
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let before = error.as_bytes().iter().take(valid);
        let line = before.filter(|b| **b == b'\n').count() + 1;
        Fault::new(
            format!("it is not UTF-8 text: line {line} contains an invalid byte"),
            "save it as UTF-8 text; spreadsheets and images are not supported",
        )
    })
}

fn absolute(path: &Path) -> String {
    plain::path(std::path::absolute(path).as_deref().unwrap_or(path))
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn a_pipe_without_a_writer_does_not_hang() {
        let folder = tempfile::tempdir().unwrap();
        let pipe = folder.path().join("pipe");
        let made = std::process::Command::new("mkfifo").arg(&pipe).status();
        assert!(made.unwrap().success());
        let error = stream(&pipe, 10, Duration::from_millis(20)).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::TimedOut);
        assert_eq!(
            error.to_string(),
            "it is not a regular file, and it did not end within 0.02 s"
        );
    }

    #[test]
    fn a_pipe_with_a_writer_is_read_to_its_end() {
        let folder = tempfile::tempdir().unwrap();
        let pipe = folder.path().join("pipe");
        let made = std::process::Command::new("mkfifo").arg(&pipe).status();
        assert!(made.unwrap().success());
        let writer = std::thread::spawn({
            let pipe = pipe.clone();
            move || std::fs::write(pipe, "text")
        });
        assert_eq!(bytes(&pipe, 4).unwrap(), b"text");
        writer.join().unwrap().unwrap();
    }

    #[test]
    fn a_device_without_an_end_is_read_up_to_the_limit() {
        let error = bytes(Path::new("/dev/zero"), 1 << 20).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::FileTooLarge);
        assert_eq!(
            error.to_string(),
            "it has more than 1 MiB; the maximum is 1 MiB"
        );
    }

    #[test]
    fn a_file_that_was_read_is_known_by_all_its_names() {
        let folder = tempfile::tempdir().unwrap();
        let [file, hard, soft, other] =
            ["file", "hard", "soft", "other"].map(|name| folder.path().join(name));
        std::fs::write(&file, "text").unwrap();
        std::fs::write(&other, "text").unwrap();
        std::fs::hard_link(&file, &hard).unwrap();
        std::os::unix::fs::symlink(&file, &soft).unwrap();
        assert_eq!(read_as(&file), None);
        bytes(&file, 10).unwrap();
        for name in [&file, &hard, &soft] {
            assert_eq!(read_as(name).as_ref(), Some(&file));
        }
        assert_eq!(read_as(&other), None);
    }
}
