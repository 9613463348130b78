//! Number types and layouts that a table can have, by name.

use jred::table::{Cubic, Layout as _, Quadratic, Spline};
use jred::{Error, Q31, Reducible, Scalar as _, Scale};

use super::search::{Answer, Search};

/// Places at which a machine is sampled for its scale and its set of curves.
pub(super) const PLACES: u32 = 1440;

/// Number type of a table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Number {
    /// Single precision, SI units.
    #[default]
    F32,
    /// Fixed point with 32-bit words, per-unit.
    I32,
}

/// How the curves lie in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayoutName {
    /// One word a curve and cell.
    Spline,
    /// Four words a curve and cell.
    Cubic,
    /// Three words a curve and cell.
    Quadratic,
}

/// Which layout is asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum LayoutChoice {
    /// The one that takes the fewest bytes.
    #[default]
    Auto,
    /// Control points of a cubic B-spline: the smallest table.
    Spline,
    /// The coefficients of each cell's cubic: a faster tick.
    Cubic,
    /// The coefficients of each cell's quadratic: the fastest tick without a long multiplication.
    Quadratic,
}

/// Yes or no.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Choice {
    /// With it.
    Yes,
    /// Without it.
    #[default]
    No,
}

impl Number {
    /// Every type.
    pub const ALL: [Self; 2] = [Self::F32, Self::I32];

    /// Name as the command line writes it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::F32 => f32::NAME,
            Self::I32 => Q31::NAME,
        }
    }

    /// Name of the type in Rust.
    pub const fn scalar(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::I32 => "Q31",
        }
    }

    /// Whether numbers are per-unit, and forward dynamics can do without a division.
    pub const fn is_fixed(self) -> bool {
        !matches!(self, Self::F32)
    }

    /// The layouts that tables of this type can have.
    pub const fn layouts(self) -> &'static [LayoutName] {
        match self {
            Self::F32 | Self::I32 => &[
                LayoutName::Spline,
                LayoutName::Cubic,
                LayoutName::Quadratic,
            ],
        }
    }

    /// The machine units, but for what the number of cells asks for.
    pub(super) fn scale(
        self,
        machine: &impl Reducible,
        [omega, alpha]: [f64; 2],
    ) -> Result<Scale, Error> {
        match self {
            Self::F32 => Ok(Scale::SI),
            Self::I32 => Scale::covering(machine, omega, alpha, PLACES),
        }
    }

    /// What the search finds for this type and a layout of it.
    pub(super) fn search(self, layout: LayoutName, search: &Search<'_>) -> Result<Answer, Error> {
        match (self, layout) {
            (Self::F32, LayoutName::Spline) => search.run::<f32, Spline>(self, layout),
            (Self::F32, LayoutName::Cubic) => search.run::<f32, Cubic>(self, layout),
            (Self::F32, LayoutName::Quadratic) => search.run::<f32, Quadratic>(self, layout),
            (Self::I32, LayoutName::Spline) => search.run::<Q31, Spline>(self, layout),
            (Self::I32, LayoutName::Cubic) => search.run::<Q31, Cubic>(self, layout),
            (Self::I32, LayoutName::Quadratic) => search.run::<Q31, Quadratic>(self, layout),
        }
    }
}

impl LayoutName {
    /// Name as the command line writes it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Spline => Spline::NAME,
            Self::Cubic => Cubic::NAME,
            Self::Quadratic => Quadratic::NAME,
        }
    }

    /// Name of the type in Rust.
    pub const fn type_name(self) -> &'static str {
        match self {
            Self::Spline => "Spline",
            Self::Cubic => "Cubic",
            Self::Quadratic => "Quadratic",
        }
    }
}

impl LayoutChoice {
    /// Whether this layout may be taken.
    pub fn allows(self, layout: LayoutName) -> bool {
        match self {
            Self::Auto => true,
            Self::Spline => layout == LayoutName::Spline,
            Self::Cubic => layout == LayoutName::Cubic,
            Self::Quadratic => layout == LayoutName::Quadratic,
        }
    }
}
