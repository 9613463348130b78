//! The tables of keys in the documentation.

use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;

use jred_file::text::key::words::MANY;
use jred_file::text::key::{Key, KeyTable, Need, ValueForm};

use super::{blesses, named, root};

/// The second column of a row.
pub(super) fn cell(table: &KeyTable, key: &Key, only: &[&str]) -> String {
    let with = match only {
        [] => String::new(),
        only => format!("{}: ", only.join(", ")),
    };
    with + &key.says(table)
}

/// Which keys of a table are shown: all, those with a word only, all but those of some words.
#[derive(Clone, Copy)]
enum Shown<'n> {
    All,
    With(&'n str),
    Without(&'n str),
}

impl<'n> Shown<'n> {
    /// `motion`, `motion/profile`, `motion, without profile`, `branch, without belt, friction`
    fn of(name: &'n str) -> (&'n str, Self) {
        if let Some((name, words)) = name.split_once(", without ") {
            return (name, Self::Without(words));
        }
        match name.split_once('/') {
            Some((name, word)) => (name, Self::With(word)),
            None => (name, Self::All),
        }
    }

    fn has(self, key: &Key) -> bool {
        match self {
            Self::All => true,
            Self::With(word) => key.only == [word],
            Self::Without(words) => !words.split(", ").any(|word| key.only == [word]),
        }
    }
}

/// Rows of keys with the same second column are one; `with` are the words with which the table is used.
fn rows(
    table: &'static KeyTable,
    path: &str,
    with: &[&str],
    shown: Shown,
    found: &mut Vec<(Vec<String>, String)>,
) {
    // A key that a table needs is not needed if the table is not.
    let (outer, may) = path
        .strip_prefix('?')
        .map_or((path, false), |path| (path, true));

    for key in table.keys().filter(|key| shown.has(key)) {
        let name = format!("{outer}{}", key.name);
        let needed = key.need == Need::Required;
        let only = match shown {
            Shown::With(_) => &[],
            _ if key.only.is_empty() => with,
            _ => key.only,
        };
        let inner = match key.form {
            ValueForm::Table(inner) | ValueForm::Tables(inner, ..) if inner.name.is_empty() => {
                Some(inner)
            }
            _ => None,
        };
        if inner.is_none() || !key.help.is_empty() {
            let bold = match (needed, may) {
                (true, false) => format!("**`{name}`**"),
                (true, true) => format!("`{outer}`**`{}`**", key.name),
                _ => format!("`{name}`"),
            };
            let cell = cell(table, key, only);
            match found.iter_mut().find(|(_, known)| *known == cell) {
                Some((names, _)) => names.push(bold),
                None => found.push((vec![bold], cell)),
            }
        }
        if let Some(inner) = inner {
            let mark = if needed && !may { "" } else { "?" };
            rows(inner, &format!("{mark}{name}."), only, Shown::All, found);
        }
    }
}

/// The table of a page in `docs/` or, if `deep`, in a folder of it: there links lead up first.
fn markdown(table: &'static KeyTable, shown: Shown, deep: bool) -> String {
    let mut found = Vec::new();
    rows(table, "", &[], shown, &mut found);
    // The keys of every link come last.
    let common = |names: &[String]| {
        ["mass", "inertia", "com"].iter().any(|key| {
            names[0]
                .trim_matches(['*', '`'])
                .ends_with(&format!(".{key}"))
        })
    };
    found.sort_by_key(|(names, _)| common(names));
    // The sections of a machine file have their own tables.
    if table.name == "machine" {
        found.retain(|(_, cell)| !cell.starts_with("table") && !cell.starts_with("list of"));
    }
    let mut text = String::from("\n| Key | Value (default) and meaning |\n|---|---|\n");
    for (mut names, cell) in found {
        if names.len() > MANY + 1 {
            names.truncate(2);
            names.push("…".to_owned());
        }
        writeln!(text, "| {} | {cell} |", names.join(", ")).unwrap();
    }
    if deep {
        text = text
            .replace("](", "](../")
            .replace("](../#", "](#")
            .replace("](../mechanisms/", "](");
    }
    text + "\n"
}

fn pages() -> Vec<PathBuf> {
    let folders = ["docs", "docs/commands", "docs/mechanisms"].map(|folder| root().join(folder));
    let entries = folders
        .iter()
        .flat_map(|folder| fs::read_dir(folder).unwrap());
    let paths = entries.map(|entry| entry.unwrap().path());
    let mut paths: Vec<_> = paths
        .filter(|path| path.extension().is_some_and(|end| end == "md"))
        .collect();
    paths.sort();
    paths
}

/// Between `<!-- keys: NAME -->` and `<!-- end -->` is the table of that name, and every table is somewhere.
#[test]
fn the_tables_of_keys_are_those_of_the_descriptions() {
    let tables = named();
    let mut shown = Vec::new();
    for page in pages() {
        let text = fs::read_to_string(&page).unwrap();
        let deep = !page.parent().unwrap().ends_with("docs");
        let mut parts = text.split("<!-- keys: ");
        let mut made = parts.next().unwrap().to_owned();
        for part in parts {
            let (name, rest) = part.split_once(" -->\n").unwrap();
            let (_, after) = rest
                .split_once("<!-- end -->")
                .unwrap_or_else(|| panic!("{}: no end of {name}", page.display()));
            let (of, keys) = Shown::of(name);
            let table = tables.iter().find(|table| table.name == of);
            let table = table.unwrap_or_else(|| panic!("{}: no table {of}", page.display()));
            shown.push(of.to_owned());
            write!(
                made,
                "<!-- keys: {name} -->\n{}<!-- end -->{after}",
                markdown(table, keys, deep)
            )
            .unwrap();
        }
        if blesses() {
            fs::write(&page, &made).unwrap();
        } else {
            assert!(
                made == text,
                "{}: JRED_BLESS=1 writes its tables anew",
                page.display()
            );
        }
    }
    // A carriage moves like the drive link.
    shown.push("carriage.motion".to_owned());
    let mut missing: Vec<_> = tables.iter().map(|table| table.name).collect();
    missing.retain(|name| !shown.iter().any(|known| known == name));
    assert!(missing.is_empty(), "not in the documentation: {missing:?}");
}
