//! The schema of machine files for editors: `docs/schemas/machine-file.json`.

use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;

use jred_file::keys::MACHINE;
use jred_file::text::key::words::noun;
use jred_file::text::key::{Key, KeyTable, Kinds, Need, ValueForm, ValueRange};
use jred_file::units::kind::{Kind, SHARE};
use serde_json::{Map, Value, json};

use super::pattern::{is_share, quantity};
use super::tables::cell;
use super::{blesses, plain, root, words_of};

/// Where the schema is.
pub(super) fn path() -> PathBuf {
    root().join("docs/schemas/machine-file.json")
}

/// The definitions that other parts of the schema name.
#[derive(Default)]
struct Maker {
    quantities: Map<String, Value>,
    tables: Map<String, Value>,
}

/// A member, left out without a limit.
fn bound(object: &mut Value, name: &str, bound: Option<Value>) {
    if let Some(bound) = bound {
        object[name] = bound;
    }
}

/// "a viscous coefficient (force per speed)" is "viscous-coefficient-force-per-speed".
fn slug(kind: &Kind) -> String {
    let words = noun(kind).split(|c: char| !c.is_alphanumeric());
    words
        .filter(|word| !word.is_empty())
        .collect::<Vec<_>>()
        .join("-")
}

impl Maker {
    /// A quantity; the schema cannot compare numbers with units, so of its limits it knows the sign.
    fn quantity(&mut self, kinds: Kinds, limit: ValueRange) -> Value {
        let unsigned = match limit {
            ValueRange::Any => false,
            ValueRange::Between(least, _) => least >= 0.0,
            _ => true,
        };
        let mut kinds = kinds.to_vec();
        kinds.dedup_by_key(|kind| kind.name);
        let slugs: Vec<_> = kinds.iter().map(|kind| slug(kind)).collect();
        let name = slugs.join("-or-") + if unsigned { "-not-negative" } else { "" };
        let meaning = kinds
            .iter()
            .map(|kind| format!("{}: {}", kind.name, kind.units));
        let mut definition = json!({
            "description": meaning.collect::<Vec<_>>().join("; or "),
            "type": "string",
            "pattern": quantity(&kinds, unsigned),
            "examples": kinds.iter().map(|kind| kind.example.trim_start_matches('-')).collect::<Vec<_>>(),
        });
        if kinds.iter().any(|kind| is_share(kind)) {
            definition["type"] = json!(["number", "string"]);
            if unsigned {
                definition["minimum"] = json!(0);
            }
        }
        let reference = json!({ "$ref": format!("#/$defs/{name}") });
        self.quantities.insert(name, definition);
        reference
    }

    fn form(&mut self, form: ValueForm, words: &[&str]) -> Value {
        match form {
            ValueForm::Quantity(kinds, limit) => self.quantity(kinds, limit),
            ValueForm::Pair(kinds) => {
                let item = self.quantity(kinds, ValueRange::Any);
                json!({ "type": "array", "items": item, "minItems": 2, "maxItems": 2 })
            }
            ValueForm::Number([least, most]) => {
                let mut number = json!({ "type": "number" });
                bound(
                    &mut number,
                    "minimum",
                    (least > f64::MIN).then(|| json!(least)),
                );
                bound(
                    &mut number,
                    "maximum",
                    (most < f64::MAX).then(|| json!(most)),
                );
                number
            }
            ValueForm::Count([least, most]) => {
                let mut count = json!({ "type": "integer", "minimum": least });
                bound(
                    &mut count,
                    "maximum",
                    (most < u32::MAX).then(|| json!(most)),
                );
                count
            }
            ValueForm::Text | ValueForm::File | ValueForm::Name(_) => {
                json!({ "type": "string", "minLength": 1 })
            }
            ValueForm::Flag => json!({ "type": "boolean" }),
            ValueForm::Words(_) => json!({ "enum": words }),
            ValueForm::Table(table) => self.table(table),
            ValueForm::Tables(table, counts, _) => {
                let item = self.table(table);
                Self::list(&item, counts)
            }
            ValueForm::Named(inner) => {
                let inner = self.form(*inner, &[]);
                json!({ "type": "object", "additionalProperties": inner })
            }
            ValueForm::List(inner, counts) => {
                let item = self.form(*inner, &[]);
                Self::list(&item, counts)
            }
            ValueForm::Tuple(forms) => {
                let items: Vec<_> = forms.iter().map(|form| self.form(*form, &[])).collect();
                let count = items.len();
                json!({ "type": "array", "prefixItems": items, "minItems": count, "maxItems": count })
            }
            ValueForm::Any(forms) => {
                let any: Vec<_> = forms
                    .iter()
                    .map(|form| match form {
                        ValueForm::Words(words) => self.form(*form, words),
                        form => self.form(*form, &[]),
                    })
                    .collect();
                json!({ "anyOf": any })
            }
        }
    }

    fn list(item: &Value, [least, most]: [usize; 2]) -> Value {
        let mut list = json!({ "type": "array", "items": item });
        bound(&mut list, "minItems", (least > 0).then(|| json!(least)));
        bound(
            &mut list,
            "maxItems",
            (most < usize::MAX).then(|| json!(most)),
        );
        list
    }

    /// A table; one with a name is defined once.
    fn table(&mut self, table: &'static KeyTable) -> Value {
        let own: Vec<Key> = table.keys().copied().collect();
        if table.name.is_empty() {
            return self.object(&[table], &own, table.by);
        }
        if !self.tables.contains_key(table.name) {
            self.tables.insert(table.name.to_owned(), Value::Null);
            let definition = if table.variants.is_empty() {
                self.object(&[table], &own, table.by)
            } else {
                self.one_of(table, &own)
            };
            self.tables.insert(table.name.to_owned(), definition);
        }
        json!({ "$ref": format!("#/$defs/{}", table.name) })
    }

    /// A table whose further keys depend on a word, or on whether a key is there.
    fn one_of(&mut self, table: &'static KeyTable, own: &[Key]) -> Value {
        let mut objects = Vec::new();
        let by_word = own.iter().any(|key| key.name == table.by);
        if !by_word {
            objects.push(self.object(&[table], own, ""));
        }
        for variant in table.variants {
            let elsewhere =
                |key: &&Key| !variant.elsewhere.iter().any(|(name, _)| *name == key.name);
            let mut keys: Vec<Key> = own.iter().filter(elsewhere).copied().collect();
            keys.extend(variant.keys());
            let mut object = self.object(&[table, variant], &keys, variant.by);
            if by_word {
                object["title"] = json!(variant.name);
                object["properties"][table.by]["enum"] = json!([variant.name]);
            }
            objects.push(object);
        }
        json!({ "oneOf": objects })
    }

    /// A table with these keys; the key `by` decides which are used.
    fn object(&mut self, tables: &[&KeyTable], keys: &[Key], by: &str) -> Value {
        let table = tables[0];
        let mut properties = Map::new();
        for key in keys {
            properties.insert(key.name.to_owned(), self.property(table, key));
        }
        let always = |key: &&Key| key.need == Need::Required && key.only.is_empty();
        let required: Vec<_> = keys.iter().filter(always).map(|key| key.name).collect();
        let mut object =
            json!({ "type": "object", "properties": properties, "additionalProperties": false });
        if !required.is_empty() {
            object["required"] = json!(required);
        }
        let mut choices = choices(keys, by);
        let known = |name: &&&str| keys.iter().any(|key| key.name == **name);
        for (names, _) in tables.iter().flat_map(|table| table.either) {
            let names: Vec<_> = names.iter().filter(known).collect();
            let pairs = names.iter().enumerate().flat_map(|(k, one)| {
                let others = names.iter().skip(k + 1);
                others.map(move |other| json!({ "required": [one, other] }))
            });
            let pairs: Vec<_> = pairs.collect();
            if !pairs.is_empty() {
                choices.push(json!({ "not": { "anyOf": pairs } }));
            }
        }
        if !choices.is_empty() {
            object["allOf"] = json!(choices);
        }
        object
    }

    fn property(&mut self, table: &KeyTable, key: &Key) -> Value {
        let mut value = self.form(key.form, &words_of(table, key));
        // Some editors read nothing beside a reference.
        if value.get("$ref").is_some() {
            value = json!({ "allOf": [value] });
        }
        value["description"] = json!(plain(&cell(table, key, key.only)));
        if let Need::Default(default) = key.need {
            value["default"] = default_of(key.form, default);
        }
        value
    }
}

/// A default as a file gives it.
pub(super) fn default_of(form: ValueForm, default: &str) -> Value {
    match form {
        ValueForm::Quantity([kind, _], _) if default == "0" && kind.unit != SHARE.unit => {
            json!(format!("0 {}", kind.unit))
        }
        ValueForm::Pair([kind, _]) => {
            let zero = format!("0 {}", kind.unit);
            json!([zero, zero])
        }
        ValueForm::Any([first, ..]) => default_of(*first, default),
        ValueForm::Number(_) | ValueForm::Count(_) | ValueForm::Flag => {
            serde_json::from_str(default).unwrap()
        }
        ValueForm::Quantity(..) if default == "0" => json!(0),
        _ => json!(default),
    }
}

/// For each word of the key `by` the other keys that are used with it, and those that are required.
fn choices(keys: &[Key], by: &str) -> Vec<Value> {
    let Some(chooser) = keys.iter().find(|key| key.name == by) else {
        return Vec::new();
    };
    let ValueForm::Words(words) = chooser.form else {
        return Vec::new();
    };
    let mut groups: Vec<(Vec<&str>, Vec<&str>, Vec<&str>)> = Vec::new();
    for word in words {
        let used = keys.iter().filter(|key| key.is_used_with(word));
        let needed = used
            .clone()
            .filter(|key| key.need == Need::Required && !key.only.is_empty());
        let needed: Vec<_> = needed.map(|key| key.name).collect();
        let used: Vec<_> = used.map(|key| key.name).collect();
        match groups
            .iter_mut()
            .find(|group| group.1 == used && group.2 == needed)
        {
            Some((words, ..)) => words.push(word),
            None => groups.push((vec![word], used, needed)),
        }
    }
    let default = match chooser.need {
        Need::Default(default) => default,
        _ => "",
    };
    let choice = |(words, used, needed): (Vec<&str>, Vec<&str>, Vec<&str>)| {
        let mut when = json!({ "properties": { by: { "enum": words } } });
        if !words.contains(&default) {
            when["required"] = json!([by]);
        }
        let mut then = json!({ "propertyNames": { "enum": used } });
        if !needed.is_empty() {
            then["required"] = json!(needed);
        }
        json!({ "if": when, "then": then })
    };
    groups.into_iter().map(choice).collect()
}

/// The schema of machine files.
pub(super) fn schema() -> Value {
    let mut maker = Maker::default();
    let keys: Vec<Key> = MACHINE.keys().copied().collect();
    let mut schema = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Machine file of jred",
        "description": "A machine with its motion and drive train; docs/machine-file.md explains it. The schema knows keys, words and units; `jred check` checks the machine.",
    });
    let top = maker.object(&[&MACHINE], &keys, "");
    schema
        .as_object_mut()
        .unwrap()
        .extend(top.as_object().unwrap().clone());
    let mut definitions = maker.tables;
    definitions.extend(maker.quantities);
    definitions.sort_keys();
    schema["$defs"] = Value::Object(definitions);
    schema
}

/// A value that fits into a line stays on one line.
fn printed(value: &Value, indent: usize, text: &mut String) {
    let line = value.to_string();
    let (open, close, entries): (_, _, Vec<(String, &Value)>) = match value {
        Value::Object(map) => {
            let entries = map.iter().map(|(key, value)| (format!("{key:?}: "), value));
            ('{', '}', entries.collect())
        }
        Value::Array(items) => {
            let entries = items.iter().map(|value| (String::new(), value));
            ('[', ']', entries.collect())
        }
        _ => (' ', ' ', Vec::new()),
    };
    if entries.is_empty() || line.chars().count() + indent <= LINE {
        *text += &line;
        return;
    }
    text.push(open);
    let last = entries.len() - 1;
    for (k, (key, value)) in entries.into_iter().enumerate() {
        write!(text, "\n{:indent$}  {key}", "").unwrap();
        printed(value, indent + 2, text);
        if k < last {
            text.push(',');
        }
    }
    write!(text, "\n{:indent$}{close}", "").unwrap();
}

/// Longest line of the schema's text, where a value may be broken.
const LINE: usize = 160;

#[test]
fn the_schema_is_that_of_the_descriptions() {
    let mut text = String::new();
    printed(&schema(), 0, &mut text);
    text.push('\n');
    if blesses() {
        fs::write(path(), &text).unwrap();
    }
    let written = fs::read_to_string(path()).unwrap_or_default();
    assert!(
        written == text,
        "JRED_BLESS=1 writes {} anew",
        path().display()
    );
}
