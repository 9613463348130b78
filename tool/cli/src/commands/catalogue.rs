//! `jred catalogue`.

use std::fs;

use miette::{Result, miette};

use crate::commands::{Completion, print_answer};
use crate::options::parts::{self, Table};
use crate::output;
use crate::terminal;
use jred_file::plain;
use jred_file::units::closest;
use jred_report::list::catalogue::{checked, empty, list, part};
use jred_sizing::catalogue::{Catalogue, Parts, Sources};
use jred_sizing::select::filter::matches;

/// Runs `jred catalogue`.
///
/// # Errors
/// A catalogue that cannot be read, an unknown key, or a folder that cannot be written.
pub(super) fn run(options: &parts::Catalogue) -> Result<Completion> {
    match options {
        parts::Catalogue::List(options) => {
            let catalogue = options.catalogue.open()?;
            let (table, linear) = match options.table {
                Table::Motors => (Parts::Motors, false),
                Table::LinearMotors => (Parts::Motors, true),
                Table::Gearboxes => (Parts::Gearboxes, false),
                Table::Amplifiers => (Parts::Amplifiers, false),
                Table::Resistors => (Parts::Resistors, false),
            };
            let shows = |key: &str, maker: &str| {
                matches(&options.key, key) && matches(&options.maker, maker)
            };
            print_answer(&list(&catalogue, table, linear, shows), options.format)
        }
        parts::Catalogue::Show(options) => {
            let catalogue = options.catalogue.open()?;
            let answer = part(&catalogue, &options.key);
            let answer = answer.ok_or_else(|| unknown(&catalogue, &options.key))?;
            print_answer(&answer, options.format.into())
        }
        parts::Catalogue::Check(options) => {
            // Its warnings are part of the answer.
            let catalogue = Catalogue::open(&Sources {
                catalogues: options.catalogue.clone(),
                skip_broken_rows: options.skip_broken_rows,
                ..Sources::default()
            })?;
            print_answer(&checked(&catalogue), options.format.into())?;
            Ok(Completion::of(catalogue.warnings.is_empty()))
        }
        parts::Catalogue::New(options) => new(options),
    }
}

fn unknown(catalogue: &Catalogue, key: &str) -> miette::Report {
    let keys = Parts::ALL.iter().flat_map(|parts| {
        let rows = [false, true].map(|linear| parts.rows(catalogue, linear));
        rows.into_iter().flatten()
    });
    let keys = keys.filter_map(|row| row.first()?.text().map(str::to_owned));
    let near = closest(key, &keys.collect::<Vec<_>>());
    let near = near.map_or_else(String::new, |near| format!("; did you mean \"{near}\"?"));
    miette!(
        help = format!("`jred catalogue list motors` lists the keys of motors{near}"),
        "no part of the catalogue has the key {}",
        plain::quoted(key)
    )
}

fn new(options: &parts::New) -> Result<Completion> {
    let folder = &options.folder;
    let shown = plain::path(folder);
    if fs::read_dir(folder).is_ok_and(|mut entries| entries.next().is_some()) {
        return Err(miette!(
            help = "name a new folder",
            "{shown} is not empty: nothing is written"
        ));
    }
    fs::create_dir_all(folder).map_err(|error| {
        miette!(
            help = "name a folder that may be written",
            "{shown} cannot be made: {error}"
        )
    })?;
    for (name, text) in empty(options.linear) {
        output::write(&folder.join(name), text.as_bytes())?;
    }
    terminal::say(&format!(
        "empty catalogue written to {shown}; fill in motors.csv and the tables that you need, then run `jred catalogue check {shown}`"
    ));
    Ok(Completion::Holds)
}
