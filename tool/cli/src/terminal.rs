//! Stdout and stderr: results, messages, width and colours of the terminal.
//!
//! A message that cannot be written to stderr is dropped; results and exit code are unaffected. Nothing else in the command writes to stdout or
//! stderr.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::io::{ErrorKind, IsTerminal as _, Write as _};
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, PoisonError};

use miette::{
    GraphicalReportHandler, GraphicalTheme, IntoDiagnostic as _, Report, Result, WrapErr as _,
};

use terminal_size::{Height, Width};

use crate::busy;
use crate::output::stdout;
use jred_file::plain;
use jred_report::table::screen::Screen;
use jred_report::units;

/// Output of a command on its thread, kept instead of printed.
#[derive(Debug, Default)]
pub struct Kept {
    /// Standard output.
    pub out: String,
    /// Warnings and messages.
    pub messages: Vec<String>,
    stop: Arc<AtomicBool>,
}

thread_local! {
    static KEPT: RefCell<Option<Kept>> = const { RefCell::new(None) };
}

/// Runs a command of which nothing is printed, and returns what it would print. `stop` ends its rows.
pub fn kept<T>(stop: &Arc<AtomicBool>, run: impl FnOnce() -> T) -> (T, Kept) {
    /// Prints again, even after a panic.
    struct End;
    impl Drop for End {
        fn drop(&mut self) {
            KEPT.set(None);
            busy::silence(false);
        }
    }
    let _end = End;
    KEPT.set(Some(Kept {
        stop: Arc::clone(stop),
        ..Kept::default()
    }));
    busy::silence(true);
    let done = run();
    (done, KEPT.take().unwrap_or_default())
}

/// Whether output is kept: the command runs in another program.
fn is_kept() -> bool {
    KEPT.with_borrow(Option::is_some)
}

/// The flag by which another program ends the rows of this command; `None` in a terminal.
pub fn stop_of_program() -> Option<Arc<AtomicBool>> {
    KEPT.with_borrow(|kept| kept.as_ref().map(|kept| Arc::clone(&kept.stop)))
}

/// Keeps an output, if outputs are kept.
fn keep(how: impl FnOnce(&mut Kept)) -> bool {
    KEPT.with_borrow_mut(|kept| kept.as_mut().map(how).is_some())
}

/// Prints to stdout; a closed pipe (`jred … | head`) is not an error.
///
/// # Errors
/// The text cannot be written, for example to a full disk.
pub fn print(text: &str) -> Result<()> {
    print_parts(std::iter::once(text))
}

/// The same for a text in parts; after a closed pipe the remaining parts are not computed.
///
/// # Errors
/// As for [`print()`].
pub fn print_parts(parts: impl IntoIterator<Item = impl AsRef<str>>) -> Result<()> {
    if is_kept() {
        for part in parts {
            keep(|kept| kept.out += &plain::lines(part.as_ref()));
        }
        return Ok(());
    }
    let mut stdout = stdout()?;
    let coloured = stdout.is_terminal() && has_colour();
    for part in parts {
        if stdout.is_terminal() {
            busy::end();
        }
        let text = plain::lines(part.as_ref());
        let written = stdout
            .write_all(
                if coloured {
                    painted(&text).into()
                } else {
                    text
                }
                .as_bytes(),
            )
            .and_then(|()| stdout.flush());
        match written {
            Err(error) if error.kind() == ErrorKind::BrokenPipe => break,
            Err(error) => {
                return Err(error)
                    .into_diagnostic()
                    .wrap_err("cannot write the result");
            }
            Ok(()) => {}
        }
    }
    Ok(())
}

/// Whether the terminal shows colours and the user wants them: <https://no-color.org>.
fn has_colour() -> bool {
    let set = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty());
    set("NO_COLOR").is_none() && set("TERM").is_none_or(|term| term != "dumb")
}

/// Colours the verdicts at line ends and the word "warning".
fn painted(text: &str) -> String {
    const GREEN: &str = "32";
    const YELLOW: &str = "33";
    const RED: &str = "1;31";
    let paint = |colour: &str, word: &str| format!("\u{1b}[{colour}m{word}\u{1b}[0m");
    let line = |line: &str| {
        if let Some(rest) = line.strip_prefix("warning:") {
            return paint(YELLOW, "warning:") + rest;
        }
        let verdicts = [(" ok", GREEN), (" warning", YELLOW), (" FAIL", RED)];
        let end = line.trim_end_matches([' ', '\n']);
        for (word, colour) in verdicts {
            if let Some(start) = end.strip_suffix(word) {
                return format!("{start}{}{}", paint(colour, word), &line[end.len()..]);
            }
        }
        line.to_owned()
    };
    text.split_inclusive('\n').map(line).collect()
}

/// The screen of stdout; 80 columns if it is not a terminal.
pub fn screen() -> Screen {
    screen_of(terminal_size::terminal_size_of(std::io::stdout()))
}

/// Widths below 40 columns are taken as 40.
fn screen_of(terminal: Option<(Width, Height)>) -> Screen {
    Screen {
        width: terminal.map(|(width, _)| usize::from(width.0).max(40)),
    }
}

/// Prints lines to stderr, wrapped to the width of a terminal.
pub fn say(lines: &str) {
    if keep(|kept| kept.messages.push(plain::lines(lines).into_owned())) {
        return;
    }
    let terminal = terminal_size::terminal_size_of(std::io::stderr());
    let screen = screen_of(terminal);
    let mut text = String::new();
    for line in plain::lines(lines).lines() {
        screen.fill(&mut text, "", "", line);
    }
    busy::aside(|| message(text.trim_end_matches('\n')));
}

/// Prints a warning to stderr, once: repeated runs produce the same warnings.
pub fn warn(line: &str) {
    static SAID: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());
    if keep(|kept| kept.messages.push(units::text(line).into_owned())) {
        return;
    }
    let mut said = SAID.lock().unwrap_or_else(PoisonError::into_inner);
    if said.insert(line.to_owned()) {
        say(&format!("warning: {}", units::text(line)));
    }
}

/// Writes a line to stderr; dropped if it cannot be written, for example to a full disk or a closed pipe.
fn message(line: &str) {
    let mut stderr = std::io::stderr();
    let _ = writeln!(stderr, "{line}").and_then(|()| stderr.flush());
}

/// Prints an error to stderr; `plainly`: without colours, every hidden character escaped.
pub fn complain(report: &Report, plainly: bool) {
    busy::end();
    if !plainly {
        message(&format!("{report:?}"));
        return;
    }
    let mut text = String::new();
    let handler = GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor());
    match handler.render_report(&mut text, report.as_ref()) {
        Ok(()) => say(&text),
        Err(_) => say(&report.to_string()),
    }
}
