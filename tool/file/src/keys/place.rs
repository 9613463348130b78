//! The description of a place in a machine file, by its path.

use toml::{Table, Value};

use super::MACHINE;
use super::starter::keys_of;
use crate::text::key::{Key, KeyTable, ValueForm, of_axis};

/// A described place.
#[derive(Clone, Copy, Debug)]
pub struct Place<'v> {
    /// The form of its value.
    pub form: ValueForm,
    /// Its value.
    pub value: Option<&'v Value>,
    /// The last key of its path, with the table that lists it; `None` at the top of the file.
    pub key: Option<(&'static KeyTable, &'static Key)>,
}

impl<'v> Place<'v> {
    /// The place at a path of keys; an element of a list has its number, from 1, or its `name`.
    pub fn at(file: &'v Value, path: &[String]) -> Option<Self> {
        let top = Self {
            form: ValueForm::Table(&MACHINE),
            value: Some(file),
            key: None,
        };
        path.iter().try_fold(top, Self::step)
    }

    /// The keys that it may have, each with the table that lists it.
    pub fn keys(&self) -> Vec<(&'static KeyTable, &'static Key)> {
        let values = self.value.and_then(Value::as_table);
        match self.form {
            ValueForm::Table(table) | ValueForm::Tables(table, ..) => keys_of(table, values),
            ValueForm::Any(forms) => {
                let of = |form: &ValueForm| {
                    Self {
                        form: *form,
                        ..*self
                    }
                    .keys()
                };
                forms.iter().flat_map(of).collect()
            }
            _ => Vec::new(),
        }
    }

    fn step(self, step: &String) -> Option<Self> {
        let inner = |form: ValueForm| Self {
            form,
            value: self.value.and_then(|value| child(value, step)),
            ..self
        };
        let number = || step.parse::<usize>().ok()?.checked_sub(1);
        match self.form {
            ValueForm::Table(table) => {
                let values = self.value.and_then(Value::as_table);
                let key = keys_of(table, values);
                let key = key.into_iter().find(|(_, key)| key.name == step)?;
                Some(Self {
                    key: Some(key),
                    ..inner(key.1.form)
                })
            }
            ValueForm::Tables(table, ..) => Some(inner(ValueForm::Table(table))),
            ValueForm::Named(form) | ValueForm::List(form, _) => Some(inner(*form)),
            ValueForm::Pair(kinds) => number().map(|_| inner(of_axis(kinds))),
            ValueForm::Tuple(forms) => Some(inner(*forms.get(number()?)?)),
            ValueForm::Any(forms) => forms.iter().find_map(|form| {
                Self {
                    form: *form,
                    ..self
                }
                .step(step)
            }),
            _ => None,
        }
    }
}

/// The value of a table or list under a key, a number or a name.
fn child<'v>(value: &'v Value, step: &str) -> Option<&'v Value> {
    match value {
        Value::Table(table) => table.get(step),
        Value::Array(list) => {
            let name = |value: &&Value| {
                let table: Option<&Table> = value.as_table();
                table.and_then(|table| table.get("name")?.as_str()) == Some(step)
            };
            let number = step.parse::<usize>().ok();
            let numbered = || list.get(number?.checked_sub(1)?);
            list.iter().find(name).or_else(numbered)
        }
        _ => None,
    }
}
