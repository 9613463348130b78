//! The command `jred`.
#![forbid(unsafe_code)]

use std::process::ExitCode;

use jred_cli::commands::{Completion, run};
use jred_cli::options::Cli;
use jred_cli::terminal;
use jred_file::plain;
use jred_report::units::show_in;

fn main() -> ExitCode {
    let words = std::env::args_os().map(|word| word.to_string_lossy().into_owned());
    let words: Vec<String> = words.collect();
    // Colours are control characters. If an argument contains control characters, errors are printed without colours, so that all of them can be
    // escaped.
    let plainly = words.iter().any(|word| plain::hidden(word).is_some());
    let cli = match Cli::read(std::env::args_os()) {
        Err(error)
            if error.use_stderr() && (plainly || !words.iter().all(|w| plain::is_short(w))) =>
        {
            terminal::say(cut(error.render().to_string(), &words).trim_end());
            return ExitCode::from(2);
        }
        // Exits with 2 on a wrong command line, with 0 after a help text.
        parsed => parsed.unwrap_or_else(|error| error.exit()),
    };
    show_in(cli.units.unwrap_or_default());
    match run(&cli.command) {
        Ok(Completion::Holds) => ExitCode::SUCCESS,
        Ok(Completion::Violated) => ExitCode::from(1),
        // The shell convention for a program ended by Ctrl-C.
        Ok(Completion::Stopped) => ExitCode::from(130),
        Err(report) => {
            terminal::complain(&report, plainly);
            ExitCode::from(2)
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
