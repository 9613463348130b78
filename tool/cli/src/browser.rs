//! A browser that prints a page as PDF.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{Error, ErrorKind};
use std::path::{Path, absolute};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use jred_file::plain;
use miette::{Report, Result, miette};

/// Browsers with the same options, in the order in which they are tried.
const BROWSERS: [&str; 11] = [
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
    "microsoft-edge",
    "msedge",
    "brave-browser",
    "brave",
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    r"C:\Program Files\Google\Chrome\Application\chrome.exe",
    r"C:\Program Files (x86)\Microsoft\Edge\Application\msedge.exe",
];

const OPTIONS: &str = "--headless --disable-gpu --no-first-run --no-default-browser-check --disable-extensions \
                       --disable-background-networking --no-pdf-header-footer";

/// Time for a page. A slow computer needs some seconds.
const PATIENCE: Duration = Duration::from_secs(60);

/// Forbids the page everything but its own style: no script, which would move the mechanism, and no network.
const POLICY: &str = "<head>\n<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">";

/// Prints a page with the browser of the environment, or the first one that is installed.
///
/// # Errors
/// There is no browser, it fails, or it takes longer than a minute.
pub fn pdf(page: &str, path: &Path) -> Result<Vec<u8>> {
    let named = std::env::var_os("JRED_BROWSER").filter(|name| !name.is_empty());
    let browsers = named.map_or_else(|| BROWSERS.map(OsString::from).to_vec(), |name| vec![name]);
    printed(&browsers, page, path, PATIENCE)
}

/// Prints a page with the first of these browsers that is installed, within a time limit. Its temporary files are next to the PDF, if possible: a
/// browser in a sandbox often reads no others.
///
/// # Errors
/// As for [`pdf()`].
pub fn printed(browsers: &[OsString], page: &str, path: &Path, limit: Duration) -> Result<Vec<u8>> {
    let made = |error: Error| failed(&format!("it cannot be prepared: {error}"));
    let beside = path.parent().filter(|folder| *folder != Path::new(""));
    let beside = absolute(beside.unwrap_or(Path::new("."))).map_err(made)?;
    let place = tempfile::Builder::new().prefix("jred-").tempdir_in(beside);
    let place = place.or_else(|_| tempfile::tempdir()).map_err(made)?;
    let [from, to, log] = ["page.html", "page.pdf", "log"].map(|name| place.path().join(name));
    fs::write(from, page.replacen("<head>", POLICY, 1)).map_err(made)?;
    let errors = File::create(&log).map_err(made)?;
    let (name, mut child) = start(browsers, place.path(), &errors)?;
    let begun = Instant::now();
    let status = loop {
        match child.try_wait().map_err(made)? {
            None if begun.elapsed() < limit => sleep(Duration::from_millis(20)),
            None => {
                child.kill().and_then(|()| child.wait()).map_err(made)?;
                let limit = limit.as_secs_f64();
                return Err(failed(&format!("{name} did not end within {limit} s")));
            }
            Some(status) => break status,
        }
    };
    let pdf = fs::read(to).unwrap_or_default();
    if status.success() && pdf.starts_with(b"%PDF-") {
        return Ok(pdf);
    }
    let log = fs::read(log).unwrap_or_default();
    let log = String::from_utf8_lossy(&log);
    let last = plain::cut(log.lines().last().unwrap_or_default());
    Err(failed(&format!(
        "{name} ended with {status} and wrote no PDF: {last}"
    )))
}

/// Starts the first browser that is installed, in the folder of the page.
fn start(browsers: &[OsString], folder: &Path, log: &File) -> Result<(String, Child)> {
    let option = |option: &str, name: &str| {
        let mut option = OsString::from(option);
        option.push(folder.join(name));
        option
    };
    let mut names = Vec::new();
    for name in browsers {
        names.push(plain::path(name));
        // A name without a folder is searched for in PATH.
        let is_path = Path::new(name).components().count() > 1;
        let program = absolute(name).ok().filter(|_| is_path);
        let started = Command::new(program.map_or_else(|| name.clone(), OsString::from))
            .args(OPTIONS.split_whitespace())
            .arg("--host-resolver-rules=MAP * ~NOTFOUND")
            .args(is_root(folder).then_some("--no-sandbox"))
            .arg(option("--user-data-dir=", "profile"))
            .arg(option("--print-to-pdf=", "page.pdf"))
            .arg("page.html")
            .current_dir(folder)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(log.try_clone().map_or_else(|_| Stdio::null(), Stdio::from))
            .spawn();
        match started {
            Ok(child) => return Ok((plain::path(name), child)),
            Err(error) if error.kind() == ErrorKind::NotFound => {}
            Err(error) => {
                return Err(failed(&format!(
                    "{} cannot be started: {error}",
                    plain::path(name)
                )));
            }
        }
    }
    Err(failed(&format!(
        "no browser is found: {}",
        names.join(", ")
    )))
}

/// Whether root runs the command, for whom Chromium has no sandbox: then the new folder is root's.
#[cfg(unix)]
fn is_root(folder: &Path) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    folder.metadata().is_ok_and(|folder| folder.uid() == 0)
}

#[cfg(not(unix))]
fn is_root(_: &Path) -> bool {
    false
}

fn failed(why: &str) -> Report {
    miette!(
        help = "open the page of --report in any browser and print it; or install chromium; or name a browser of its kind in JRED_BROWSER",
        "the PDF cannot be printed: {why}"
    )
}
