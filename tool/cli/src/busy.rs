//! A line on a terminal that says what is done and for how long, from the second second on.
//!
//! A command without rows to count (`rows/run.rs` counts those) shows that it is at work. Ctrl-C ends it at once: until its
//! result is complete it has written nothing, and a file is written beside its place.

use std::io::IsTerminal as _;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

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
    let line = Line::begin(what, ProgressDrawTarget::stderr(), PATIENCE);
    *LINE.lock().unwrap_or_else(PoisonError::into_inner) = Some(line);
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
    if let Some(line) = line {
        line.end();
    }
}

impl Line {
    /// Begins to draw the line on `screen` when so much time has passed.
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
        Self { bar, stop, thread }
    }

    /// Takes it away.
    fn end(self) {
        drop(self.stop);
        // It does nothing that could fail.
        let _ = self.thread.join();
        self.bar.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use std::io::Result;
    use std::sync::mpsc::Receiver;

    use indicatif::TermLike;

    use super::*;

    /// What a terminal is told to do.
    #[derive(Debug, PartialEq)]
    enum Told {
        Text(String),
        ClearLine,
    }

    #[derive(Debug)]
    struct Screen(Sender<Told>);

    impl Screen {
        fn begin() -> (ProgressDrawTarget, Receiver<Told>) {
            let (sender, told) = channel();
            let screen = Box::new(Self(sender));
            (ProgressDrawTarget::term_like(screen), told)
        }

        fn tell(&self, told: Told) {
            // A test that has seen enough looks no more.
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
            self.tell(Told::Text(text.to_owned()));
            Ok(())
        }
        fn write_str(&self, text: &str) -> Result<()> {
            self.tell(Told::Text(text.to_owned()));
            Ok(())
        }
        fn clear_line(&self) -> Result<()> {
            self.tell(Told::ClearLine);
            Ok(())
        }
        fn flush(&self) -> Result<()> {
            Ok(())
        }
    }

    fn shows(told: &Told) -> bool {
        matches!(told, Told::Text(text) if text.contains("checking the machine: "))
    }

    /// Nothing of the line stays on the screen.
    #[test]
    fn the_line_says_what_is_done_and_goes() {
        let (screen, told) = Screen::begin();
        let line = Line::begin("checking the machine", screen, Duration::ZERO);
        // Waits for the line, however long it takes.
        assert!(told.iter().any(|told| shows(&told)));
        line.end();
        let rest: Vec<Told> = told.iter().collect();
        let cleared = rest.iter().rposition(|told| *told == Told::ClearLine);
        assert!(!rest[cleared.expect("it is cleared")..].iter().any(shows));
    }

    #[test]
    fn a_short_command_shows_nothing() {
        let (screen, told) = Screen::begin();
        let line = Line::begin("checking the machine", screen, Duration::from_secs(3600));
        line.end();
        assert!(!told.iter().any(|told| shows(&told)));
    }
}
