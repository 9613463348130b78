//! The units in which results are shown to people: SI, or inches and pounds.
//!
//! Results are computed and worded in SI. They are converted where they are rendered, as text, CSV or page; JSON stays in SI.

use std::borrow::Cow;
use std::cell::Cell as Slot;
use std::sync::LazyLock;

use jred_file::number::columns::{Column, Columns};
use jred_file::number::csv;
use jred_file::number::rounding::significant;
use jred_file::units::unit;

jred_file::words! {
    /// Units of results.
    pub enum UnitSystem default Si {
        /// N m, kg m^2, kg, m, N, kW, °C.
        Si = "si",
        /// lb in, lb in s^2, lb, in, lbf, hp, °F; JSON and the rows of studies stay in SI.
        Imperial = "imperial",
    }
}

thread_local! {
    static SHOWN: Slot<UnitSystem> = const { Slot::new(UnitSystem::Si) };
}

/// Chooses the units of this thread's results.
pub fn show_in(system: UnitSystem) {
    SHOWN.set(system);
}

/// Whether results are shown in SI.
pub(crate) fn is_si() -> bool {
    SHOWN.get() == UnitSystem::Si
}

/// A unit of results, and the one that replaces it.
pub(crate) struct Conversion {
    from: String,
    to: String,
    factor: f64,
    /// The number that zero becomes.
    zero: f64,
}

impl Conversion {
    /// The converted number.
    pub(crate) fn of(&self, x: f64) -> f64 {
        x * self.factor + self.zero
    }
}

/// Units, and those of data sheets in the United States; `lb` in a torque is a force.
const PAIRS: &str = "N m s/rad = lb in s/rad; N m/arcmin = lb in/arcmin; N m/rad = lb in/rad; N m/A = lb in/A; N m/kg = lb in/lb; N m/s = lb in/s; \
    mN m = oz in; kN m = lb in; N m = lb in; kg m^2/rad = lb in s^2/rad; kg m^2 = lb in s^2; kg cm^2 = lb in s^2; kg/m = lb/in; kg = lb; \
    N s/m = lbf s/in; N/mm = lbf/in; N/m = lbf/in; N/A = lbf/A; kN = lbf; N = lbf; m/s^3 = in/s^3; m/s^2 = in/s^2; m/s = in/s; \
    mm/s = in/s; m/rad = in/rad; mm = in; m = in; kW = hp; °C = °F; degC = degF; C = degF";

/// The conversions; the signs · and ² are kept.
static CONVERSIONS: LazyLock<Vec<Conversion>> = LazyLock::new(|| {
    let mut all = Vec::new();
    for (from, to) in PAIRS.split("; ").filter_map(|pair| pair.split_once(" = ")) {
        let is_force = from.contains('N') || to.contains("s^2");
        let forces = to.replace("lb in", "lbf in").replace("oz in", "ozf in");
        let size = |text: &str| unit::read_listed(&unit::tidy(text)).ok();
        let own = if is_force { size(&forces) } else { size(to) };
        let Some((si, own)) = size(from).zip(own) else {
            continue;
        };
        let printed = |text: &str| text.replace(' ', "·").replace("^2", "²").replace("^3", "³");
        for (from, to) in [
            (from.to_owned(), to.to_owned()),
            (printed(from), printed(to)),
        ] {
            all.push(Conversion {
                from,
                to,
                factor: si.scale / own.scale,
                zero: own.zero,
            });
        }
    }
    all
});

/// The conversion of a whole unit; `None`: it stays.
fn conversion(unit: &str) -> Option<&'static Conversion> {
    let unit = unit.trim();
    let mut all = CONVERSIONS.iter().filter(|_| !is_si());
    all.find(|own| own.from == unit)
}

/// A title with its unit in square brackets replaced, and the conversion of its numbers.
pub(crate) fn title(title: &str) -> (Cow<'_, str>, Option<&'static Conversion>) {
    let split = title.rsplit_once('[').and_then(|(name, rest)| {
        let (unit, rest) = rest.split_once(']')?;
        Some((name, conversion(unit)?, rest))
    });
    match split {
        Some((name, own, rest)) => (format!("{name}[{}]{rest}", own.to).into(), Some(own)),
        None => (title.into(), None),
    }
}

/// A sentence with its quantities converted; numbers keep their significant digits, at least three.
pub fn text(text: &str) -> Cow<'_, str> {
    if is_si() {
        return text.into();
    }
    let (mut shown, mut done) = (String::new(), 0);
    // Numbers before one with a unit that share it: "3 to 5 N m".
    let mut group: Vec<(usize, usize)> = Vec::new();
    let mut at = 0;
    while let Some((from, to)) = number(text, at) {
        at = to;
        let joined = group.last().and_then(|(_, end)| text.get(*end..from));
        if !joined.is_none_or(|between| [" to ", " of ", " and ", "–"].contains(&between)) {
            group.clear();
        }
        group.push((from, to));
        let Some(rest) = text
            .get(to..)
            .and_then(|rest| rest.strip_prefix([' ', '\u{a0}']))
        else {
            continue;
        };
        let whole = |own: &&Conversion| {
            let after = rest.strip_prefix(own.from.as_str());
            let part = |c: char| c.is_alphanumeric() || "^/·²³_°".contains(c);
            after.is_some_and(|after| !after.starts_with(part))
        };
        let Some(own) = CONVERSIONS.iter().find(whole) else {
            continue;
        };
        for (from, to) in group.drain(..) {
            shown += &text[done..from];
            shown += &converted(&text[from..to], own);
            done = to;
        }
        let gap = text.len() - rest.len();
        shown += &text[done..gap];
        shown += &own.to;
        done = gap + own.from.len();
        at = done;
    }
    if done == 0 {
        return text.into();
    }
    shown += &text[done..];
    shown.into()
}

/// The next number of a text from `start`: not a part of a word.
fn number(text: &str, start: usize) -> Option<(usize, usize)> {
    let bytes = text.as_bytes();
    let digit = |k: usize| bytes.get(k).is_some_and(u8::is_ascii_digit);
    let digits = |k: usize| (k..bytes.len()).take_while(|k| digit(*k)).count() + k;
    let mut at = start;
    loop {
        at += text.get(at..)?.find(|c: char| c.is_ascii_digit())?;
        let mut to = digits(at);
        if bytes.get(to) == Some(&b'.') && digit(to + 1) {
            to = digits(to + 1);
        }
        if matches!(bytes.get(to), Some(b'e' | b'E')) {
            let power = to + 1 + usize::from(matches!(bytes.get(to + 1), Some(b'-' | b'+')));
            if digit(power) {
                to = digits(power);
            }
        }
        let before = &text[..at];
        let sign = before.chars().next_back().filter(|c| "-−+".contains(*c));
        let before = before.strip_suffix(|c| Some(c) == sign).unwrap_or(before);
        let part = |c: char| c.is_alphanumeric() || "._^".contains(c);
        if !before.ends_with(part) {
            return Some((before.len(), to));
        }
        at = to;
    }
}

/// A number of a text converted.
fn converted(text: &str, own: &Conversion) -> String {
    let plain = text.replace('−', "-");
    let Ok(value) = plain.parse::<f64>() else {
        return text.to_owned();
    };
    let mantissa = plain.split(['e', 'E']).next().unwrap_or_default();
    let digits = mantissa.trim_start_matches(|c: char| !('1'..='9').contains(&c));
    let count = digits.chars().filter(char::is_ascii_digit).count();
    significant(own.of(value), count.clamp(3, 6) as i32)
}

/// A cell of words: its quantities, or, in a column with a unit, its bare numbers: "3" or "3 to 5".
pub(crate) fn cell(words: &str, own: Option<&Conversion>) -> String {
    const BETWEEN: &str = " to ";
    let parts = || words.trim().split(BETWEEN);
    match own {
        Some(own) if parts().all(|part| part.parse::<f64>().is_ok()) => {
            let shown = parts().map(|part| converted(part, own));
            shown.collect::<Vec<_>>().join(BETWEEN)
        }
        _ => text(words).into_owned(),
    }
}

/// Columns of numbers.
pub(crate) fn columns(columns: &Columns) -> Columns {
    let heads = columns.heads().iter();
    let own: Vec<_> = heads.clone().map(|head| conversion(&head.unit)).collect();
    let heads = heads.zip(&own).map(|(head, own)| Column {
        unit: own.map_or(head.unit.clone(), |own| own.to.clone()),
        ..head.clone()
    });
    let mut shown = Columns::new(heads);
    for row in columns.rows() {
        let values = row.iter().zip(&own);
        shown.push(values.map(|(x, own)| x.map(|x| own.map_or(x, |own| own.of(x)))));
    }
    shown
}

/// A table as CSV: numbers below a title with a unit, every digit.
pub(crate) fn table(text: String) -> String {
    if is_si() {
        return text;
    }
    // Comments stand above the header.
    let header = text.split_inclusive('\n');
    let header: usize = header
        .take_while(|l| l.starts_with('#'))
        .map(str::len)
        .sum();
    let (comments, rest) = text.split_at(header);
    let mut reader = ::csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .from_reader(rest.as_bytes());
    let mut records = reader.records().map_while(Result::ok);
    let titles = records.next().unwrap_or_default();
    let titles: Vec<_> = titles.iter().map(title).collect();
    let rows = records.map(|record| {
        let cells = record.iter().enumerate().map(|(k, cell)| {
            let own = titles.get(k).and_then(|(_, own)| *own);
            match (own, cell.parse::<f64>()) {
                (Some(own), Ok(x)) => csv::number(own.of(x)),
                _ => cell.to_owned(),
            }
        });
        cells.collect::<Vec<_>>()
    });
    let head = titles.iter().map(|(title, _)| title.as_ref());
    comments.to_owned() + &csv::row(head) + &csv::rows(rows)
}

#[cfg(test)]
mod tests;
