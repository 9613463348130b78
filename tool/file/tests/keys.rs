//! The descriptions of the keys: every one is read, the tables of the documentation and the schema for editors follow from them.
//!
//! `JRED_BLESS=1 cargo test -p jred-file keys` writes the tables and the schema anew.

mod described;
mod pattern;
mod schema;
mod tables;
mod validated;

use std::path::{Path, PathBuf};

use jred_file::keys::{MACHINE, RULE_SET};
use jred_file::text::key::{Form, Key, Table};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Whether files are written anew.
fn blesses() -> bool {
    std::env::var_os("JRED_BLESS").is_some()
}

/// The tables that a form holds.
fn tables_of(form: Form) -> Vec<&'static Table> {
    match form {
        Form::Table(table) | Form::Tables(table, ..) => vec![table],
        Form::Named(inner) | Form::List(inner, _) => tables_of(*inner),
        Form::Any(forms) | Form::Tuple(forms) => {
            forms.iter().copied().flat_map(tables_of).collect()
        }
        _ => Vec::new(),
    }
}

/// All tables with a name, each once.
fn named() -> Vec<&'static Table> {
    fn walk(table: &'static Table, found: &mut Vec<&'static Table>) {
        if !table.name.is_empty() {
            if found.iter().any(|known| known.name == table.name) {
                return;
            }
            found.push(table);
        }
        let inner = table.keys().flat_map(|key| tables_of(key.form));
        for table in inner.chain(table.variants.iter().copied()) {
            walk(table, found);
        }
    }
    let mut found = Vec::new();
    walk(&MACHINE, &mut found);
    walk(&RULE_SET, &mut found);
    found
}

/// A help without the addresses of its links.
fn plain(help: &str) -> String {
    let (mut plain, mut rest) = (String::new(), help);
    while let Some((before, link)) = rest.split_once('[') {
        plain += before;
        match link
            .split_once("](")
            .and_then(|(text, after)| Some((text, after.split_once(')')?.1)))
        {
            Some((text, after)) if !text.contains('[') && !text.contains(']') => {
                plain += text;
                rest = after;
            }
            _ => {
                plain.push('[');
                rest = link;
            }
        }
    }
    (plain + rest).replace("\\|", "|")
}

/// The words by which a table chooses its keys.
fn words_of(table: &Table, key: &Key) -> Vec<&'static str> {
    match key.form {
        Form::Words([]) => table.variants.iter().map(|variant| variant.name).collect(),
        Form::Words(words) => words.to_vec(),
        _ => Vec::new(),
    }
}

#[test]
fn links_are_left_out() {
    assert_eq!(plain("a [b](c.md#d) `[u, v]` e"), "a b `[u, v]` e");
}
