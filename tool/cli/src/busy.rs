//! Progress line with the running task and its time: on a terminal after one second; elsewhere, as in a log, every ten seconds,
//! unless the environment has `JRED_PROGRESS=never`.
//!
//! For commands without rows to count (`rows/run.rs` counts those). Ctrl-C ends the command at once: nothing is written before the result is
//! complete, and a file is written under a temporary name.

use std::cell::Cell;
use std::io::{IsTerminal as _, Write};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Commands shorter than this show nothing.
const PATIENCE: Duration = Duration::from_secs(1);

/// Interval at which the line is drawn.
const TICK: Duration = Duration::from_millis(200);

/// Interval between the lines of a log, in which a short command writes none.
const TICK_OF_LOGS: Duration = Duration::from_secs(10);

static LINE: Mutex<Option<ProgressLine>> = Mutex::new(None);

/// Completed rows and all rows; 0 if rows are not counted.
static ROWS: [AtomicU64; 2] = [AtomicU64::new(0), AtomicU64::new(0)];

struct ProgressLine {
    /// `None` in a log, from which nothing is removed.
    bar: Option<ProgressBar>,
    stop: Sender<()>,
    thread: JoinHandle<()>,
}

thread_local! {
    static SILENT: Cell<bool> = const { Cell::new(false) };
}

/// Whether no line is shown for the tasks of this thread.
pub fn silence(on: bool) {
    SILENT.set(on);
}

/// Starts the line for the task `what`, such as `checking the machine`.
pub fn begin(what: &'static str) {
    end();
    if SILENT.get() {
        return;
    }
    let line = if std::io::stderr().is_terminal() {
        ProgressLine::begin(what, ProgressDrawTarget::stderr(), PATIENCE)
    } else if std::env::var_os("JRED_PROGRESS").is_some_and(|word| word == "never") {
        return;
    } else {
        ProgressLine::in_log(what, std::io::stderr(), TICK_OF_LOGS)
    };
    *LINE.lock().unwrap_or_else(PoisonError::into_inner) = Some(line);
}

/// Runs `print`, which writes to stderr, without the line.
pub fn aside(print: impl FnOnce()) {
    match &*LINE.lock().unwrap_or_else(PoisonError::into_inner) {
        Some(ProgressLine { bar: Some(bar), .. }) => bar.suspend(print),
        _ => print(),
    }
}

/// Counts rows from now on, `done` of `of`: a bar on a terminal, a number in the line elsewhere.
pub fn rows(done: u64, of: u64) {
    if std::io::stderr().is_terminal() {
        end();
    }
    ROWS[0].store(done, Ordering::Relaxed);
    ROWS[1].store(of, Ordering::Relaxed);
}

/// Counts one more row.
pub fn row() {
    ROWS[0].fetch_add(1, Ordering::Relaxed);
}

/// Removes the line.
pub fn end() {
    let line = LINE.lock().unwrap_or_else(PoisonError::into_inner).take();
    if let Some(line) = line {
        line.end();
    }
}

impl ProgressLine {
    /// Draws the line on `screen` once `patience` has passed.
    fn begin(what: &'static str, screen: ProgressDrawTarget, patience: Duration) -> Self {
        let style = ProgressStyle::with_template("{spinner} {msg}: {elapsed}; Ctrl-C stops it");
        let bar = ProgressBar::with_draw_target(None, screen)
            .with_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()))
            .with_message(what);
        let (stop, stopped) = channel();
        let drawn = bar.clone();
        let thread = std::thread::spawn(move || {
            let waits = |time| stopped.recv_timeout(time) == Err(RecvTimeoutError::Timeout);
            if waits(patience) {
                drawn.tick();
                while waits(TICK) {
                    drawn.tick();
                }
            }
        });
        Self {
            bar: Some(bar),
            stop,
            thread,
        }
    }

    /// Writes a line to a log after every `tick`.
    fn in_log(what: &'static str, mut log: impl Write + Send + 'static, tick: Duration) -> Self {
        let (stop, stopped) = channel();
        let begun = Instant::now();
        let thread = std::thread::spawn(move || {
            while stopped.recv_timeout(tick) == Err(RecvTimeoutError::Timeout) {
                let [done, of] = [&ROWS[0], &ROWS[1]].map(|rows| rows.load(Ordering::Relaxed));
                let rows = match of {
                    0 => String::new(),
                    _ => format!(", {done} of {of} rows"),
                };
                let seconds = begun.elapsed().as_secs();
                // A log that cannot be written does not stop the command.
                let _ = writeln!(log, "{what}: {seconds} s{rows}");
            }
        });
        Self {
            bar: None,
            stop,
            thread,
        }
    }

    /// Removes the line.
    fn end(self) {
        drop(self.stop);
        // The thread cannot fail.
        let _ = self.thread.join();
        if let Some(bar) = self.bar {
            bar.finish_and_clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io::Result;
    use std::sync::mpsc::Receiver;

    use indicatif::TermLike;

    use super::*;

    /// Commands to a terminal.
    #[derive(Debug, PartialEq)]
    enum TerminalEvent {
        Text(String),
        ClearLine,
    }

    #[derive(Debug)]
    struct Screen(Sender<TerminalEvent>);

    impl Screen {
        fn begin() -> (ProgressDrawTarget, Receiver<TerminalEvent>) {
            let (sender, told) = channel();
            let screen = Box::new(Self(sender));
            (ProgressDrawTarget::term_like(screen), told)
        }

        fn tell(&self, told: TerminalEvent) {
            // The test may have ended.
            let _ = self.0.send(told);
        }
    }

    impl TermLike for Screen {
        fn width(&self) -> u16 {
            80
        }
        fn move_cursor_up(&self, _: usize) -> Result<()> {
            Ok(())
        }
        fn move_cursor_down(&self, _: usize) -> Result<()> {
            Ok(())
        }
        fn move_cursor_right(&self, _: usize) -> Result<()> {
            Ok(())
        }
        fn move_cursor_left(&self, _: usize) -> Result<()> {
            Ok(())
        }
        fn write_line(&self, text: &str) -> Result<()> {
            self.tell(TerminalEvent::Text(text.to_owned()));
            Ok(())
        }
        fn write_str(&self, text: &str) -> Result<()> {
            self.tell(TerminalEvent::Text(text.to_owned()));
            Ok(())
        }
        fn clear_line(&self) -> Result<()> {
            self.tell(TerminalEvent::ClearLine);
            Ok(())
        }
        fn flush(&self) -> Result<()> {
            Ok(())
        }
    }

    /// Text written to a log.
    struct Log(Sender<String>);

    impl Write for Log {
        fn write(&mut self, text: &[u8]) -> Result<usize> {
            // The test may have ended.
            let _ = self.0.send(String::from_utf8_lossy(text).into_owned());
            Ok(text.len())
        }
        fn flush(&mut self) -> Result<()> {
            Ok(())
        }
    }

    /// A log gets whole lines with the completed rows; a short command writes none.
    #[test]
    fn a_log_gets_lines() {
        let (sender, written) = channel();
        rows(3, 8);
        let line = ProgressLine::in_log("sizing", Log(sender), Duration::ZERO);
        let mut text = String::new();
        // Waits for the second line without a timeout.
        while text.matches('\n').count() < 2 {
            text += &written.recv().expect("it goes on");
        }
        line.end();
        rows(0, 0);
        let first = text.lines().next().unwrap_or_default();
        assert!(
            first.starts_with("sizing: ") && first.ends_with(" s, 3 of 8 rows"),
            "{first}"
        );
        let (sender, written) = channel();
        ProgressLine::in_log("sizing", Log(sender), Duration::from_secs(3600)).end();
        assert_eq!(written.iter().count(), 0);
    }

    fn shows(told: &TerminalEvent) -> bool {
        matches!(told, TerminalEvent::Text(text) if text.contains("checking the machine: "))
    }

    /// The line is removed from the screen completely.
    #[test]
    fn the_line_says_what_is_done_and_goes() {
        let (screen, told) = Screen::begin();
        let line = ProgressLine::begin("checking the machine", screen, Duration::ZERO);
        // Waits for the line without a timeout.
        assert!(told.iter().any(|told| shows(&told)));
        line.end();
        let rest: Vec<TerminalEvent> = told.iter().collect();
        let cleared = rest
            .iter()
            .rposition(|told| *told == TerminalEvent::ClearLine);
        assert!(!rest[cleared.expect("it is cleared")..].iter().any(shows));
    }

    #[test]
    fn a_short_command_shows_nothing() {
        let (screen, told) = Screen::begin();
        let line = ProgressLine::begin("checking the machine", screen, Duration::from_secs(3600));
        line.end();
        assert!(!told.iter().any(|told| shows(&told)));
    }
}
