//! The descriptions of keys in words, for the tables of the documentation, the schema for editors and the comments of a new machine file.

use super::{Key, KeyTable, Kinds, Need, ValueForm, ValueRange};
use crate::units::kind::{Kind, SHARE};

/// More words than these are not listed.
pub const MANY: usize = 9;

/// "length"
pub fn noun(kind: &Kind) -> &'static str {
    kind.name.trim_start_matches("an ").trim_start_matches("a ")
}

/// "pair of angles"
fn nouns([turns, slides]: Kinds, plural: &str) -> String {
    let [first, second] = [noun(turns), noun(slides)];
    if first == second {
        return format!("{first}{plural}");
    }
    format!("{first}{plural} or {second}{plural}")
}

fn limit(kinds: Kinds, limit: ValueRange) -> String {
    let shown = |si: f64| {
        if kinds[0].unit == SHARE.unit {
            format!("{} %", si * 100.0)
        } else {
            format!("{si} {}", kinds[0].unit)
        }
    };
    match limit {
        ValueRange::Any => String::new(),
        ValueRange::Positive => " > 0".to_owned(),
        ValueRange::NotNegative => " ≥ 0".to_owned(),
        ValueRange::UpTo(most) => format!(" > 0, ≤ {}", shown(most)),
        ValueRange::Within(most) => format!(" ≥ 0, ≤ {}", shown(most)),
        ValueRange::Between(least, most) => format!(", {} to {}", shown(least), shown(most)),
    }
}

/// "1 to 16 "
fn count([least, most]: [usize; 2]) -> String {
    match (least, most) {
        (_, usize::MAX) => String::new(),
        (least, most) if least == most => format!("{least} "),
        (0, most) => format!("up to {most} "),
        (least, most) => format!("{least} to {most} "),
    }
}

/// The form of a key's value; `words` are those of a choice.
fn value(form: ValueForm, words: &[&str]) -> String {
    match form {
        ValueForm::Quantity(kinds, bound) => nouns(kinds, "") + &limit(kinds, bound),
        ValueForm::Pair(kinds) => format!("pair of {}", nouns(kinds, "s")),
        ValueForm::Number([least, most]) if least > 0.0 && least < 1e-4 => {
            format!("number, {least:e} to {most:e}")
        }
        ValueForm::Number([least, most]) if least > -1e3 => format!("number, {least} to {most}"),
        ValueForm::Number(_) => "number".to_owned(),
        ValueForm::Count([_, u32::MAX]) => "whole number".to_owned(),
        ValueForm::Count([least, most]) => format!("whole number, {least} to {most}"),
        ValueForm::Text => "text".to_owned(),
        ValueForm::File => "CSV file".to_owned(),
        ValueForm::Name(what) => format!("name of {what}"),
        ValueForm::Flag => "`true`, `false`".to_owned(),
        ValueForm::Words(_) if words.len() > MANY => "word".to_owned(),
        ValueForm::Words(_) => {
            let quoted = words.iter().map(|word| format!("`\"{word}\"`"));
            quoted.collect::<Vec<_>>().join(", ")
        }
        ValueForm::Table(_) => "table".to_owned(),
        ValueForm::Tables(_, counts, _) => format!("list of {}tables", count(counts)),
        ValueForm::Named(inner) => format!("table of {}", many(*inner)),
        ValueForm::List(inner, counts) => format!("list of {}{}", count(counts), many(*inner)),
        ValueForm::Tuple(forms) => {
            let parts = forms.iter().map(|form| value(*form, &[]));
            format!("`[{}]`", parts.collect::<Vec<_>>().join(", "))
        }
        ValueForm::Any(forms) => {
            let parts = forms.iter().map(|form| match form {
                ValueForm::Words(words) => value(*form, words),
                form => value(*form, &[]),
            });
            parts.collect::<Vec<_>>().join(" or ")
        }
    }
}

/// Several of them.
fn many(form: ValueForm) -> String {
    match form {
        ValueForm::Text => "texts".to_owned(),
        ValueForm::Name(what) => format!("names of {what}"),
        ValueForm::Count(_) => "whole numbers".to_owned(),
        ValueForm::Quantity(kinds, _) => nouns(kinds, "s"),
        ValueForm::Pair(kinds) => format!("pairs of {}", nouns(kinds, "s")),
        ValueForm::Any(forms) => {
            let parts = forms.iter().map(|form| many(*form));
            parts.collect::<Vec<_>>().join(" or ")
        }
        ValueForm::Table(_) => "tables".to_owned(),
        form => value(form, &[]),
    }
}

/// The words by which a table chooses its keys.
pub fn words_of(table: &KeyTable, key: &Key) -> Vec<&'static str> {
    match key.form {
        ValueForm::Words([]) => table.variants.iter().map(|variant| variant.name).collect(),
        ValueForm::Words(words) => words.to_vec(),
        _ => Vec::new(),
    }
}

impl Key {
    /// Value, default and meaning of this key of `table`, in Markdown.
    pub fn says(&self, table: &KeyTable) -> String {
        let default = match (self.need, self.form) {
            (Need::Default(word), ValueForm::Words(_)) => format!(" (`\"{word}\"`)"),
            (Need::Default(text), ValueForm::Flag | ValueForm::Text) => format!(" (`{text}`)"),
            (Need::Default(_), ValueForm::Pair(_)) => " (0, 0)".to_owned(),
            (Need::Default(value), _) => format!(" ({value})"),
            _ => String::new(),
        };
        let says = value(self.form, &words_of(table, self)) + &default;
        // A help that begins with a default goes on with the value.
        match self.help {
            "" => says,
            help if help.starts_with('(') => format!("{says} {help}"),
            help => format!("{says}: {help}"),
        }
    }
}

/// A help without the addresses of its links.
pub fn plain(help: &str) -> String {
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
