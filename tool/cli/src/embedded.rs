//! The command in another program: what it prints is returned, and texts can stand for files.

use std::ffi::OsString;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use jred_file::text::disk;
use jred_report::units::show_in;
use miette::{Report, miette};

use crate::commands::{self, Completion};
use crate::options::Cli;
use crate::options::help::FIRST;
use crate::terminal;
use jred_file::plain;

/// The result of a command.
#[derive(Clone, Debug)]
pub struct Ran {
    /// Exit code: 0, or 1 where a rule is violated.
    pub code: u8,
    /// Standard output.
    pub out: String,
    /// Warnings and messages.
    pub messages: Vec<String>,
}

/// Exit code of a finished command; 130 is that of a shell for a program ended by Ctrl-C.
const fn code(done: Completion) -> u8 {
    match done {
        Completion::Holds => 0,
        Completion::Violated => 1,
        Completion::Stopped => 130,
    }
}

/// A command line.
fn behind_name(words: impl IntoIterator<Item = OsString>) -> impl Iterator<Item = OsString> {
    std::iter::once("jred".into()).chain(words)
}

/// A refused command line: its tips are the cure, the usage is left out.
fn refusal(text: &str) -> Report {
    let parts = || text.trim().split("\n\n").map(str::trim);
    let message = parts().next().unwrap_or(text);
    let message = message.trim_start_matches("error: ");
    let tips: Vec<&str> = parts()
        .filter_map(|part| part.strip_prefix("tip: "))
        .collect();
    if tips.is_empty() {
        return miette!("{message}");
    }
    miette!(help = tips.join("; "), "{message}")
}

/// Runs the command with these words behind `jred`. Each of `files` stands for the file at its path; `stop` ends the rows of a study.
///
/// # Errors
/// Those of the command; a wrong command line.
pub fn run(
    words: &[String],
    files: Vec<(PathBuf, String)>,
    stop: &Arc<AtomicBool>,
) -> Result<Ran, Report> {
    let cli = match Cli::read(behind_name(words.iter().map(OsString::from))) {
        Ok(cli) => cli,
        Err(error) if error.exit_code() == 0 => {
            return Ok(Ran {
                code: 0,
                out: error.render().to_string(),
                messages: Vec::new(),
            });
        }
        Err(error) => {
            return Err(refusal(&error.render().to_string()));
        }
    };
    let (done, kept) = terminal::kept(stop, || {
        show_in(cli.units.unwrap_or_default());
        disk::with_texts(files, || commands::run(&cli.command))
    });
    Ok(Ran {
        code: code(done?),
        out: kept.out,
        messages: kept.messages,
    })
}

/// The command of a terminal, with these words behind `jred`; returns its exit code.
pub fn command(given: Vec<OsString>) -> u8 {
    let words = given.iter().map(|word| word.to_string_lossy().into_owned());
    let words: Vec<String> = words.collect();
    if words.is_empty() {
        terminal::say(FIRST);
        return 2;
    }
    // Colours are control characters. If an argument contains control characters, errors are printed without colours, so that all of them can be
    // escaped.
    let plainly = words.iter().any(|word| plain::hidden(word).is_some());
    let cli = match Cli::read(behind_name(given)) {
        Err(error)
            if error.use_stderr() && (plainly || !words.iter().all(|w| plain::is_short(w))) =>
        {
            terminal::say(cut(error.render().to_string(), &words).trim_end());
            return 2;
        }
        Err(error) => {
            // A help text is no error: it goes to stdout, and the code is 0.
            let _ = error.print();
            return error.exit_code() as u8;
        }
        Ok(cli) => cli,
    };
    show_in(cli.units.unwrap_or_default());
    match commands::run(&cli.command) {
        Ok(done) => code(done),
        Err(report) => {
            terminal::complain(&report, plainly);
            2
        }
    }
}

/// A message in which long command-line words and values are cut, and hidden characters such as line ends escaped.
fn cut(mut message: String, words: &[String]) -> String {
    for word in words {
        let value = word
            .split_once('=')
            .map_or(word.as_str(), |(_, value)| value);
        for long in [word, value] {
            if !plain::is_short(long) || plain::hidden(long).is_some() {
                message = message.replace(long, &plain::cut(long));
            }
        }
    }
    message
}
