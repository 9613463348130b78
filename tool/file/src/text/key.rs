//! The keys of a table, described: what a key holds, whether it is needed, its limits, and what it means.
//!
//! A [`Section`](super::section::Section) reads by these descriptions; hints, the tables of the documentation and the schema for editors come from them too.

pub mod words;

use crate::units::kind::{
    ACCELERATION, ANGLE, ANGULAR_ACCELERATION, ANGULAR_JERK, ANGULAR_SPEED, FORCE, FORCE_RATE,
    JERK, Kind, LENGTH, TORQUE, TORQUE_RATE, VELOCITY,
};

/// The kind of a quantity where the coordinate is an angle, and where it is a length; elsewhere both are the same.
pub type Kinds = [&'static Kind; 2];

/// Positions, speeds, accelerations, jerks and efforts of an axis, or of the drive link.
pub const POSITION: Kinds = [&ANGLE, &LENGTH];
/// Its speeds.
pub const SPEED: Kinds = [&ANGULAR_SPEED, &VELOCITY];
/// Its accelerations.
pub const ACCELERATIONS: Kinds = [&ANGULAR_ACCELERATION, &ACCELERATION];
/// Its jerks.
pub const JERKS: Kinds = [&ANGULAR_JERK, &JERK];
/// The torque or force that drives it.
pub const EFFORT: Kinds = [&TORQUE, &FORCE];
/// How fast its effort changes.
pub const EFFORT_RATES: Kinds = [&TORQUE_RATE, &FORCE_RATE];

/// Limits of a quantity (SI).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ValueRange {
    /// Any value.
    Any,
    /// Greater than zero.
    Positive,
    /// Zero or more.
    NotNegative,
    /// Greater than zero, at most this.
    UpTo(f64),
    /// Zero or more, at most this.
    Within(f64),
    /// From the first to the second.
    Between(f64, f64),
}

/// The form of a key's value.
#[derive(Clone, Copy, Debug)]
pub enum ValueForm {
    /// A quantity.
    Quantity(Kinds, ValueRange),
    /// Two quantities of one kind.
    Pair(Kinds),
    /// A plain number within limits.
    Number([f64; 2]),
    /// A whole number within limits.
    Count([u32; 2]),
    /// A text.
    Text,
    /// The name of a file.
    File,
    /// The name of something in this machine: a link, a joint, a point.
    Name(&'static str),
    /// `true` or `false`.
    Flag,
    /// One of these words.
    Words(&'static [&'static str]),
    /// A table.
    Table(&'static KeyTable),
    /// A list of tables, from the first number to the second; the cure if there are more.
    Tables(&'static KeyTable, [usize; 2], &'static str),
    /// A table of points, or of other values of this form, whose keys are names that the user chooses.
    Named(&'static ValueForm),
    /// A list of values of this form, from the first number to the second.
    List(&'static ValueForm, [usize; 2]),
    /// A list of one value of each form.
    Tuple(&'static [ValueForm]),
    /// A value of any of these forms.
    Any(&'static [ValueForm]),
}

/// A quantity.
pub const fn quantity(kind: &'static Kind) -> ValueForm {
    ValueForm::Quantity([kind, kind], ValueRange::Any)
}

/// A quantity of the coordinate.
pub const fn of_axis(kinds: Kinds) -> ValueForm {
    ValueForm::Quantity(kinds, ValueRange::Any)
}

/// Two quantities.
pub const fn pair(kind: &'static Kind) -> ValueForm {
    ValueForm::Pair([kind, kind])
}

impl ValueForm {
    /// The value that messages propose, as a file gives it: `given`, or one of its kind.
    pub(crate) fn example(&self, given: &str, slides: bool) -> String {
        let side = usize::from(slides);
        match self {
            _ if !given.is_empty() => given.to_owned(),
            Self::Quantity(kinds, _) => format!("\"{}\"", kinds[side].example),
            Self::Pair(kinds) => {
                let kind = kinds[side];
                format!("[\"0 {}\", \"{}\"]", kind.unit, kind.example)
            }
            Self::Words([first, ..]) => format!("\"{first}\""),
            Self::Flag => "true".to_owned(),
            _ => "…".to_owned(),
        }
    }

    /// The first form that it may be of which `of` gives something.
    pub(crate) fn first<T>(self, of: impl Fn(Self) -> Option<T> + Copy) -> Option<T> {
        match self {
            Self::Any(forms) => forms.iter().find_map(|form| form.first(of)),
            form => of(form),
        }
    }

    /// The keys of the table that it may be.
    pub(crate) fn table(self) -> Option<&'static KeyTable> {
        self.first(|form| match form {
            Self::Table(table) | Self::Tables(table, ..) => Some(table),
            _ => None,
        })
    }

    /// The same quantity within limits.
    #[must_use]
    pub const fn limited(self, limit: ValueRange) -> Self {
        match self {
            Self::Quantity(kinds, _) => Self::Quantity(kinds, limit),
            other => other,
        }
    }

    /// A quantity greater than zero.
    #[must_use]
    pub const fn positive(self) -> Self {
        self.limited(ValueRange::Positive)
    }

    /// A quantity of zero or more.
    #[must_use]
    pub const fn not_negative(self) -> Self {
        self.limited(ValueRange::NotNegative)
    }
}

/// Whether a table needs a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// It is an error if the key is missing.
    Required,
    /// Its help states the meaning of its absence.
    Optional,
    /// This value, as a file would give it, is used if the key is missing.
    Default(&'static str),
}

/// A key of a table.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// Its name.
    pub name: &'static str,
    /// The form of its value.
    pub form: ValueForm,
    /// Whether it is needed.
    pub need: Need,
    /// The value that messages propose, as a file gives it; if empty, that of its kind.
    pub example: &'static str,
    /// The words of the table's choice with which the key is used; with all if empty.
    pub only: &'static [&'static str],
    /// Its meaning, in one line.
    pub help: &'static str,
}

/// A required key.
pub const fn key(name: &'static str, form: ValueForm, help: &'static str) -> Key {
    Key {
        name,
        form,
        need: Need::Required,
        example: "",
        only: &[],
        help,
    }
}

/// A key that may be missing.
pub const fn may(name: &'static str, form: ValueForm, help: &'static str) -> Key {
    Key {
        need: Need::Optional,
        ..key(name, form, help)
    }
}

impl Key {
    /// Used if the key is missing.
    #[must_use]
    pub const fn or(self, default: &'static str) -> Self {
        let need = Need::Default(default);
        Self { need, ..self }
    }

    /// The value that messages propose.
    #[must_use]
    pub const fn such_as(self, example: &'static str) -> Self {
        Self { example, ..self }
    }

    /// Another meaning of a key that several tables have.
    #[must_use]
    pub const fn meaning(self, help: &'static str) -> Self {
        Self { help, ..self }
    }

    /// Used with these words only.
    #[must_use]
    pub const fn only(self, only: &'static [&'static str]) -> Self {
        Self { only, ..self }
    }

    /// Whether it is used with a word.
    pub fn is_used_with(&self, word: &str) -> bool {
        self.only.is_empty() || self.only.contains(&word)
    }
}

/// The keys of a table.
#[derive(Debug)]
pub struct KeyTable {
    /// Its name in documents; without one its keys are listed with those of the table that it is in.
    pub name: &'static str,
    /// Its keys, in groups.
    pub keys: &'static [&'static [Key]],
    /// The key whose word decides which other keys are used; empty without such a key.
    pub by: &'static str,
    /// Tables of further keys, by that word.
    pub variants: &'static [&'static KeyTable],
    /// Keys that users look for here, and where they belong.
    pub elsewhere: &'static [(&'static str, &'static str)],
    /// Keys of which at most one is given, and what to do if more are.
    pub either: &'static [(&'static [&'static str], &'static str)],
}

/// The cure for one key too many.
pub const KEEP_ONE: &str = "keep one of them";

/// A table without descriptions: any key may be asked for.
pub static OPEN: KeyTable = KeyTable::of("", &[]);

impl KeyTable {
    /// A table of these keys.
    pub const fn of(name: &'static str, keys: &'static [&'static [Key]]) -> Self {
        Self {
            name,
            keys,
            by: "",
            variants: &[],
            elsewhere: &[],
            either: &[],
        }
    }

    /// The key whose word decides which keys are used.
    #[must_use]
    pub const fn by(self, by: &'static str) -> Self {
        Self { by, ..self }
    }

    /// Further keys, by the word of the key `by`.
    #[must_use]
    pub const fn variants(self, by: &'static str, variants: &'static [&'static Self]) -> Self {
        Self {
            by,
            variants,
            ..self
        }
    }

    /// Keys that users look for here, and where they belong.
    #[must_use]
    pub const fn elsewhere(self, elsewhere: &'static [(&'static str, &'static str)]) -> Self {
        Self { elsewhere, ..self }
    }

    /// Keys of which at most one is given, and what to do if more are.
    #[must_use]
    pub const fn either(self, either: &'static [(&'static [&'static str], &'static str)]) -> Self {
        Self { either, ..self }
    }

    /// Whether nothing is known of its keys.
    pub const fn is_open(&self) -> bool {
        self.keys.is_empty()
    }

    /// Its own keys.
    pub fn keys(&'static self) -> impl Iterator<Item = &'static Key> {
        self.keys.iter().copied().flatten()
    }

    /// The description of a key.
    pub fn key(&'static self, name: &str) -> Option<&'static Key> {
        self.keys().find(|key| key.name == name)
    }
}
