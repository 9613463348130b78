//! A line on a terminal that says what is done and for how long, from the second second on.
//!
//! A command without rows to count (`rows/run.rs` counts those) shows that it is at work. Ctrl-C ends it at once: until its
//! result is complete it has written nothing, and a file is written beside its place.

use std::io::IsTerminal as _;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

/// A command that is shorter shows nothing.
const PATIENCE: Duration = Duration::from_secs(1);

/// How often the line is drawn.
const TICK: Duration = Duration::from_millis(200);

static LINE: Mutex<Option<Line>> = Mutex::new(None);

struct Line {
    bar: ProgressBar,
    stop: Sender<()>,
    thread: JoinHandle<()>,
}

/// Begins to show that `what` is done, such as `checking the machine`; nothing where stderr is no terminal.
pub fn begin(what: &'static str) {
    if !std::io::stderr().is_terminal() {
        return;
    }
    end();
    let style = ProgressStyle::with_template("{spinner} {msg}: {elapsed}; Ctrl-C stops it");
    let bar = ProgressBar::new_spinner()
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()))
        .with_message(what);
    let (stop, stopped) = channel();
    let drawn = bar.clone();
    let thread = std::thread::spawn(move || {
        let waits = |time| stopped.recv_timeout(time) == Err(RecvTimeoutError::Timeout);
        if waits(PATIENCE) {
            drawn.tick();
            while waits(TICK) {
                drawn.tick();
            }
        }
    });
    *LINE.lock().unwrap_or_else(PoisonError::into_inner) = Some(Line { bar, stop, thread });
}

/// Runs `print`, which writes to stderr, without the line.
pub fn aside(print: impl FnOnce()) {
    match &*LINE.lock().unwrap_or_else(PoisonError::into_inner) {
        Some(line) => line.bar.suspend(print),
        None => print(),
    }
}

/// Takes the line away.
pub fn end() {
    let line = LINE.lock().unwrap_or_else(PoisonError::into_inner).take();
    if let Some(Line { bar, stop, thread }) = line {
        drop(stop);
        // It does nothing that could fail.
        let _ = thread.join();
        bar.finish_and_clear();
    }
}
