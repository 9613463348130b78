//! Machine files, changed value by value, so that most of them are still accepted.

use rand::{Rng, RngExt as _};
use toml::{Table, Value};

/// Replacements of a number: factors and values.
const FACTORS: [f64; 12] = [
    0.0, -1.0, 1e-12, 1e-6, 1e-3, 0.1, 0.5, 0.999_999, 1.000_001, 2.0, 1e3, 1e6,
];
const NUMBERS: [&str; 10] = [
    "0", "-0", "1", "1e-300", "1e300", "1e-9", "1e9", "90", "180", "360",
];

/// Largest number of changes to one machine.
const CHANGES: usize = 3;

/// Machines to change, and values to change them with.
#[derive(Debug)]
pub struct Machines {
    machines: Vec<Table>,
    /// Every key with each of its values.
    values: Vec<(String, Value)>,
}

impl Machines {
    /// The machines of these texts; texts that are not TOML are left out.
    pub fn new(texts: &[Vec<u8>]) -> Self {
        let texts = texts
            .iter()
            .filter_map(|text| std::str::from_utf8(text).ok());
        let machines: Vec<Table> = texts.filter_map(|text| text.parse().ok()).collect();
        let mut values = Vec::new();
        for machine in &machines {
            gather(machine, &mut values);
        }
        Self { machines, values }
    }

    /// One of them with a few changes: a number scaled or replaced, a unit changed, a value taken from elsewhere, a key removed or added.
    ///
    /// # Panics
    /// There are no machines.
    pub fn mutated(&self, rng: &mut impl Rng) -> String {
        let mut machine = self.machines[rng.random_range(0..self.machines.len())].clone();
        for _ in 0..rng.random_range(1..=CHANGES) {
            self.change(rng, &mut machine);
        }
        // A title may contain anything, and could be mistaken for a result.
        machine.insert("title".to_owned(), "A machine".into());
        machine.to_string()
    }

    /// Changes one value of a table, reached by a random descent.
    fn change(&self, rng: &mut impl Rng, table: &mut Table) {
        let keys: Vec<String> = table.keys().cloned().collect();
        if keys.is_empty() || rng.random_ratio(1, 12) {
            let (key, value) = self.values[rng.random_range(0..self.values.len())].clone();
            table.insert(key, value);
            return;
        }
        let key = &keys[rng.random_range(0..keys.len())];
        if rng.random_ratio(1, 24) {
            table.remove(key);
            return;
        }
        if let Some(value) = table.get_mut(key) {
            self.change_value(rng, key, value);
        }
    }

    fn change_value(&self, rng: &mut impl Rng, key: &str, value: &mut Value) {
        match value {
            Value::Table(table) => self.change(rng, table),
            Value::Array(array) if !array.is_empty() => {
                let place = rng.random_range(0..array.len());
                match rng.random_range(0..8) {
                    0 => drop(array.remove(place)),
                    1 => array.insert(place, array[place].clone()),
                    2 => array.reverse(),
                    _ => self.change_value(rng, key, &mut array[place]),
                }
            }
            Value::String(text) if !rng.random_ratio(1, 4) => *text = quantity(rng, text),
            Value::Float(number) => *number *= FACTORS[rng.random_range(0..FACTORS.len())],
            Value::Integer(number) => {
                let more = [number.wrapping_add(1), number.wrapping_mul(1000)];
                let numbers = [0, -1, 1, 2, more[0], more[1], i64::MAX];
                *number = numbers[rng.random_range(0..numbers.len())];
            }
            Value::Boolean(truth) => *truth = !*truth,
            // The value of the same key in another machine, or anything.
            _ => {
                let same: Vec<&Value> = self
                    .values
                    .iter()
                    .filter(|(k, _)| k == key)
                    .map(|(_, v)| v)
                    .collect();
                *value = match same.len() {
                    0 => self.values[rng.random_range(0..self.values.len())]
                        .1
                        .clone(),
                    count => same[rng.random_range(0..count)].clone(),
                };
            }
        }
    }
}

fn gather(table: &Table, values: &mut Vec<(String, Value)>) {
    for (key, value) in table {
        values.push((key.clone(), value.clone()));
        match value {
            Value::Table(inner) => gather(inner, values),
            Value::Array(array) => array
                .iter()
                .filter_map(Value::as_table)
                .for_each(|inner| gather(inner, values)),
            _ => {}
        }
    }
}

/// A quantity with another number or another unit; other texts are unchanged.
fn quantity(rng: &mut impl Rng, text: &str) -> String {
    let (number, unit) = text.split_once(' ').unwrap_or((text, ""));
    let Ok(figure) = number.parse::<f64>() else {
        return text.to_owned();
    };
    let unit = if rng.random_ratio(1, 16) {
        ["mm", "deg", "rad", "kg", "N", "N m", "s", "rpm", ""][rng.random_range(0..9)]
    } else {
        unit
    };
    let number = if rng.random_ratio(1, 4) {
        NUMBERS[rng.random_range(0..NUMBERS.len())].to_owned()
    } else {
        (figure * FACTORS[rng.random_range(0..FACTORS.len())]).to_string()
    };
    format!("{number} {unit}").trim_end().to_owned()
}
