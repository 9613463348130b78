//! Layout of another program's CSV file, as the machine file describes it: lines above the header, titles, and their meaning.

use std::borrow::Cow;
use std::f64::consts::TAU;

use super::ColumnSpec;
use crate::text::csv;
use crate::text::item::Item;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::units::kind::{
    ACCELERATION, ANGLE, ANGULAR_ACCELERATION, ANGULAR_SPEED, CAM_ACCELERATION, CAM_TURNING,
    CAM_VELOCITY, Kind, SHARE, TORQUE, VELOCITY,
};
use crate::units::quantity::unit_of;
use crate::units::{Fault, unit};

/// The cure of a torque that is a share of one that the machine file cannot give.
pub(crate) const IN_NEWTON_METRES: &str = "write the torque in N m";

/// The layout of a file, as the machine file gives it.
#[derive(Default)]
pub(crate) struct Layout<'a> {
    /// The table of the machine file, for messages.
    pub(super) section: String,
    /// Lines above the header.
    skipped: usize,
    /// The titles of a file without a header, and the key that gives them.
    pub(super) titles: Option<(Vec<String>, Item<'a>)>,
    /// Assignment of the file's columns.
    pub(super) mapped: Option<Vec<ColumnMapping<'a>>>,
    /// Angle of one count (rad).
    count: Option<f64>,
    /// The rated torque (N·m) of the drive whose log this is: the torque may be a share of it.
    rated: Option<f64>,
    /// The key of the speed (rad/s) of a master or cam, and its value: velocities and accelerations of the file may be those at this speed.
    speed: Option<(&'static str, Option<f64>)>,
}

/// A column that the machine file assigns: its known name and its title in the file, with a unit if the title there has none.
pub(super) struct ColumnMapping<'a> {
    pub(super) name: &'a str,
    pub(super) title: Title,
    /// Without one an option of the command line names the column.
    item: Option<Item<'a>>,
}

impl ColumnMapping<'_> {
    pub(super) fn problem(&self, what: &str, label: &str) -> Problem {
        match &self.item {
            Some(item) => item.problem(what, label),
            None => Problem::new(format!("`{}` in --columns {what}", self.name)),
        }
    }
}

impl<'a> Layout<'a> {
    /// `skip_rows`, `header`, `columns` and `counts_per_turn`.
    pub(crate) fn read(section: &Section<'a>) -> Result<Self> {
        let skipped = section.get("skip_rows").map(|item| item.whole());
        let titles = match section.get("header") {
            Some(item) => {
                let list = item.list("title", "[\"t [s]\", \"phi [deg]\"]")?;
                let texts = list.iter().map(|title| Ok(title.text("t [s]")?.to_owned()));
                Some((texts.collect::<Result<Vec<_>>>()?, item))
            }
            None => None,
        };
        let mapped = match section.maybe_table("columns")? {
            Some(table) => {
                let entries = table.entries().into_iter();
                let mapped = entries.map(|(name, item)| {
                    let title = Title::of(item.text("Time (sec)")?);
                    let item = Some(item);
                    Ok(ColumnMapping { name, title, item })
                });
                Some(mapped.collect::<Result<Vec<_>>>()?)
            }
            None => None,
        };
        let count = section.get("counts_per_turn").map(|item| item.whole());
        let count = count.transpose()?.map(|count| TAU / f64::from(count));
        let skipped = skipped.transpose()?.unwrap_or(0) as usize;
        Ok(Self {
            section: section.title().to_owned(),
            skipped,
            titles,
            mapped,
            count,
            rated: None,
            speed: None,
        })
    }

    /// Titles of columns, counts of a turn and lines above the header, as options of the command line give them.
    pub(crate) fn of_options(
        columns: &'a [(String, String)],
        counts: Option<u32>,
        skipped: u32,
    ) -> Self {
        let mapped = columns.iter().map(|(name, title)| ColumnMapping {
            name,
            title: Title::of(title),
            item: None,
        });
        Self {
            skipped: skipped as usize,
            mapped: (!columns.is_empty()).then(|| mapped.collect()),
            count: counts.map(|count| TAU / f64::from(count)),
            ..Self::default()
        }
    }

    /// The layout of a table over the angle of a master, whose speed (rad/s) is the value of `key`.
    pub(crate) fn at_speed(self, key: &'static str, speed: Option<f64>) -> Self {
        Self {
            speed: Some((key, speed)),
            ..self
        }
    }

    /// The layout of a log of a drive with this rated torque (N·m), if it is known.
    pub(crate) fn at_rated_torque(self, rated: Option<f64>) -> Self {
        Self { rated, ..self }
    }

    /// The text with the lines above the header made comments; all bytes keep their positions. The first of them can be the line with which Excel
    /// names the separator.
    pub(super) fn without_skipped<'t>(&self, text: &'t str) -> Cow<'t, str> {
        let start = text.trim_start_matches('\u{feff}').as_bytes();
        let skipped = if matches!(start, [b's' | b'S', b'e' | b'E', b'p' | b'P', b'=', ..]) {
            self.skipped.max(1)
        } else {
            self.skipped
        };
        if skipped == 0 {
            return Cow::Borrowed(text);
        }
        let mut out = String::with_capacity(text.len());
        for (k, line) in text.split_inclusive('\n').enumerate() {
            let first = line.chars().next().filter(|c| !c.is_whitespace());
            match first {
                Some(first) if k < skipped => {
                    let length = first.len_utf8();
                    out.extend(std::iter::repeat_n('#', length));
                    out += line.get(length..).unwrap_or_default();
                }
                _ => out += line,
            }
        }
        Cow::Owned(out)
    }

    /// The size (SI) of a column's unit; counts are possible too.
    pub(super) fn scale(
        &self,
        unit: Option<&str>,
        kind: &'static Kind,
    ) -> std::result::Result<f64, Fault> {
        let text = unit.unwrap_or_default();
        let kinds = [&ANGLE, &ANGULAR_SPEED, &ANGULAR_ACCELERATION];
        let counted = counts(text).and_then(|order| kinds.get(order));
        if counted.is_some_and(|own| own.dimension == kind.dimension) {
            return self.count.ok_or_else(|| {
                Fault::new(
                    "is in counts",
                    format!(
                        "write the counts of a turn into {}: counts_per_turn = 8192",
                        self.section
                    ),
                )
            });
        }
        if text == "1" && kind.dimension == SHARE.dimension {
            return Ok(1.0);
        }
        if let Some(share) = share(text).filter(|_| kind.dimension == TORQUE.dimension) {
            let rated = self.rated.map(|rated| share * rated);
            return rated.ok_or_else(|| {
                Fault::new(
                    "is a share of the rated torque",
                    IN_NEWTON_METRES.to_owned(),
                )
            });
        }
        if let (Some((key, speed)), Some((scale, order))) = (self.speed, over_time(text, kind)) {
            return speed.map(|speed| scale / speed.powi(order)).ok_or_else(|| {
                Fault::new(
                    "is over the time, not over the angle",
                    format!(
                        "write the speed for which the file gives it into {}: {key} = \"60 rpm\"",
                        self.section
                    ),
                )
            });
        }
        unit_of(text, &[kind]).map(|(unit, _)| unit.scale)
    }

    /// Whether a unit is a unit of none of these columns.
    pub(super) fn is_foreign(&self, unit: Option<&str>, known: &[ColumnSpec]) -> bool {
        let fits = |known: &ColumnSpec| self.scale(unit, known.kind).is_ok();
        unit.is_some_and(|unit| unit::read_listed(unit).is_ok()) && !known.iter().any(fits)
    }
}

/// The size (SI) of a unit over the time for a derivative by an angle, and the order of the derivative.
fn over_time(text: &str, kind: &Kind) -> Option<(f64, i32)> {
    let (over, order) = [
        (&CAM_VELOCITY, &VELOCITY, 1),
        (&CAM_ACCELERATION, &ACCELERATION, 2),
        (&SHARE, &ANGULAR_SPEED, 1),
        (&CAM_TURNING, &ANGULAR_ACCELERATION, 2),
    ]
    .into_iter()
    .find_map(|(own, over, order)| (own.dimension == kind.dimension).then_some((over, order)))?;
    unit_of(text, &[over])
        .ok()
        .map(|(unit, _)| (unit.scale, order))
}

/// The order of the time derivative of "counts", "counts/s" or "counts/s^2".
fn counts(text: &str) -> Option<usize> {
    const COUNTS: [&str; 6] = ["counts", "count", "cnt", "inc", "incs", "increments"];
    let tidy = unit::tidy(text);
    let (word, per) = tidy.split_once('/').unwrap_or((&tidy, ""));
    let order = ["", "s", "s^2"].iter().position(|times| *times == per)?;
    COUNTS.contains(&word.trim()).then_some(order)
}

/// The size of a unit for shares of a rated torque: "per mille", "%" or "0.1%".
pub(crate) fn share(text: &str) -> Option<f64> {
    match text.replace(' ', "").to_lowercase().as_str() {
        "permille" | "‰" | "0.1%" => Some(1e-3),
        "%" => Some(1e-2),
        _ => None,
    }
}

/// Whether a text is the unit of a column.
pub(super) fn is_unit(text: &str) -> bool {
    text == "1" || counts(text).is_some() || csv::is_unit(text)
}

/// A title of a column: its name and its unit.
#[derive(Clone, Debug)]
pub(super) struct Title {
    pub(super) whole: String,
    pub(super) name: String,
    pub(super) unit: Option<String>,
}

impl Title {
    /// Splits `phi [deg]` and `Time (sec)`. Round brackets that do not contain a unit belong to the name.
    pub(super) fn of(whole: &str) -> Self {
        let whole = whole.trim();
        let bracketed = whole.strip_suffix(']').and_then(|t| t.rsplit_once('['));
        let rounded = whole.strip_suffix(')').and_then(|t| t.rsplit_once('('));
        let rounded = rounded.filter(|(_, unit)| is_unit(unit.trim()));
        let (name, unit) = bracketed.or(rounded).map_or((whole, None), |(name, unit)| {
            (name.trim_end(), Some(unit.trim().to_owned()))
        });
        Self {
            whole: whole.to_owned(),
            name: name.to_owned(),
            unit,
        }
    }

    /// The title with the part after the last underscore as its unit, as in "time_s", if the rest is a known name.
    pub(super) fn underscored(self, known: &[ColumnSpec]) -> Self {
        let is_known = |name: &str| known.iter().any(|known| known.is(name));
        if self.unit.is_some() || is_known(&self.name) {
            return self;
        }
        match self.whole.rsplit_once('_') {
            Some((name, unit)) if is_known(name) && is_unit(unit) => Self {
                name: name.to_owned(),
                unit: Some(unit.to_owned()),
                whole: self.whole.clone(),
            },
            _ => self,
        }
    }

    /// Whether a title in the machine file refers to this one.
    pub(super) fn is_meant_by(&self, asked: &Self) -> bool {
        let same = |a: &str, b: &str| a.to_lowercase() == b.to_lowercase();
        let units = match (&self.unit, &asked.unit) {
            (Some(own), Some(asked)) => unit::tidy(own) == unit::tidy(asked),
            _ => true,
        };
        same(&self.whole, &asked.whole) || same(&self.name, &asked.name) && units
    }

    /// The places of the titles that this one of the machine file refers to: those that are the same text, else those with its name.
    pub(super) fn places(&self, titles: &[Self]) -> Vec<usize> {
        let of = |is: &dyn Fn(&Self) -> bool| -> Vec<usize> {
            let titles = titles.iter().enumerate();
            titles
                .filter(|(_, title)| is(title))
                .map(|(at, _)| at)
                .collect()
        };
        let same = of(&|title| title.whole.to_lowercase() == self.whole.to_lowercase());
        if same.is_empty() {
            of(&|title| title.is_meant_by(self))
        } else {
            same
        }
    }
}
