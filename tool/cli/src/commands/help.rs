//! `jred new`, `jred completion`, `jred man`.

use clap_mangen::Man;
use miette::{IntoDiagnostic as _, Result, miette};

use crate::commands::{Completion, print};
use crate::options::{Cli, help};
use crate::output;
use crate::terminal;
use jred_file::keys::starter;
use jred_file::plain;

/// Runs `jred new`.
///
/// # Errors
/// A file that exists or cannot be written.
pub(super) fn new(options: &help::New) -> Result<Completion> {
    let text = options.kind.as_ref();
    let Some(text) = text.and_then(|kind| starter::machine_file(kind, options.all)) else {
        let widest = starter::types().map(|(name, _)| name.len()).max();
        let width = widest.unwrap_or_default();
        let screen = terminal::screen();
        let title = "Types of machines; `jred new TYPE --out FILE` writes a machine file:";
        let mut text = String::new();
        screen.fill(&mut text, "", "", title);
        text.push('\n');
        let rest = " ".repeat(width + 4);
        for (name, about) in starter::types() {
            screen.fill(&mut text, &format!("  {name:width$}  "), &rest, about);
        }
        return print(&text);
    };
    let Some(path) = &options.out else {
        return print(&text);
    };
    let shown = plain::path(path);
    if !options.force && path.symlink_metadata().is_ok() {
        return Err(miette!(
            help = "name a new file, or overwrite this one with --force",
            "{shown} exists: nothing is written"
        ));
    }
    output::write(path, text.as_bytes())?;
    terminal::say(&format!(
        "machine file written to {shown}; put in your values, then run `jred size {shown}`"
    ));
    Ok(Completion::Holds)
}

/// Runs `jred completion`.
///
/// # Errors
/// The script cannot be printed.
pub(super) fn completion(options: &help::Completion) -> Result<Completion> {
    let mut script = Vec::new();
    clap_complete::generate(options.shell, &mut Cli::declared(), "jred", &mut script);
    print(&String::from_utf8(script).into_diagnostic()?)
}

/// Runs `jred man`.
///
/// # Errors
/// A page that cannot be written.
pub(super) fn man(options: &help::Man) -> Result<Completion> {
    let mut command = Cli::declared().disable_help_subcommand(true);
    command.build();
    let Some(folder) = &options.out else {
        let (_, page) = page(&command)?;
        return print(&String::from_utf8(page).into_diagnostic()?);
    };
    let mut pages = output::Files::default();
    let mut left = vec![&command];
    while let Some(command) = left.pop() {
        left.extend(command.get_subcommands());
        let (name, page) = page(command)?;
        pages.add(&folder.join(name), &page)?;
    }
    pages.finish()?;
    Ok(Completion::Holds)
}

/// The name and the text of a manual page.
fn page(command: &clap::Command) -> Result<(String, Vec<u8>)> {
    let man = Man::new(command.clone());
    let mut page = Vec::new();
    man.render(&mut page).into_diagnostic()?;
    Ok((man.get_filename(), page))
}
