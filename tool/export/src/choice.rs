//! Number types and layouts that a table can have, by name.

use jred::machine::{PoseError, Reducible};
use jred::number::Number as _;
use jred::table::Format as _;
use jred::{
    Cubic, Harmonic, Q15, Q31, Quadratic, Rows16, Scale, SliderCrankForm, Spline, Spline16,
};

/// Places at which a machine is sampled for its scale and its set of curves.
pub(crate) const PLACES: u32 = 1440;

jred_file::words! {
    /// Number type of a table.
    pub enum Number default F32 {
        /// Single precision, SI units.
        F32 = "f32",
        /// Fixed point with 32 bits, per-unit.
        I32 = "i32",
        /// Fixed point with 16 bits, per-unit: for processors without long multiplication.
        I16 = "i16",
    }
}

/// Layout of the curves in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayoutName {
    /// One word a curve and cell.
    Spline,
    /// Half a word a curve and cell.
    Spline16,
    /// Four words a curve and cell.
    Cubic,
    /// Three words a curve and cell.
    Quadratic,
    /// Packed words of 16-bit tables.
    Rows,
    /// Coefficients of short Fourier series.
    Harmonic,
    /// Lengths and masses of a slider-crank.
    SliderCrank,
}

jred_file::words! {
    /// The requested layout.
    pub enum LayoutChoice default Auto {
        /// One of the fastest on the core; with --max-bytes that with the fewest bytes.
        Auto = "auto",
        /// Control points of a cubic B-spline: smallest table.
        Spline = "spline",
        /// Control points in 16 bits, for i32: half that size.
        Spline16 = "spline16",
        /// Coefficients of a cubic per cell: faster tick.
        Cubic = "cubic",
        /// Coefficients of a quadratic per cell: fastest tick without long multiplication.
        Quadratic = "quadratic",
        /// Packed rows, for i16.
        Rows = "rows",
        /// Short Fourier series of a smooth machine that turns: the fewest bytes, f32.
        Harmonic = "harmonic",
        /// A slider-crank with constant loads in closed form, without a table: f32.
        SliderCrank = "slider-crank",
    }
}

jred_file::words! {
    /// Whether a table has the curve of 1/J.
    pub enum Choice default Auto {
        /// With it in fixed point, if the firmware asks for accelerations.
        Auto = "auto",
        /// With it.
        Yes = "yes",
        /// Without it.
        No = "no",
    }
}

impl Number {
    /// Every type.
    pub const ALL: [Self; 3] = [Self::F32, Self::I32, Self::I16];

    /// Name as the command line writes it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::F32 => f32::NAME,
            Self::I32 => Q31::NAME,
            Self::I16 => Q15::NAME,
        }
    }

    /// Name of the type in Rust.
    pub const fn scalar(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::I32 => "Q31",
            Self::I16 => "Q15",
        }
    }

    /// Whether numbers are per-unit, so that forward dynamics can avoid a division.
    pub const fn is_fixed(self) -> bool {
        !matches!(self, Self::F32)
    }

    /// The layouts that tables of this type can have.
    pub const fn layouts(self) -> &'static [LayoutName] {
        match self {
            Self::F32 => &[
                LayoutName::Spline,
                LayoutName::Cubic,
                LayoutName::Quadratic,
                LayoutName::Harmonic,
                LayoutName::SliderCrank,
            ],
            Self::I32 => &[
                LayoutName::Spline,
                LayoutName::Spline16,
                LayoutName::Cubic,
                LayoutName::Quadratic,
            ],
            Self::I16 => &[LayoutName::Rows],
        }
    }

    /// Machine units, before adaptation to the number of cells.
    pub(crate) fn scale(
        self,
        machine: &impl Reducible,
        [omega, alpha]: [f64; 2],
    ) -> Result<Scale, PoseError> {
        match self {
            Self::F32 => Ok(Scale::SI),
            Self::I32 => Scale::covering(machine, omega, alpha, PLACES),
            Self::I16 => Scale::limited_to(machine, omega, alpha, PLACES),
        }
    }
}

impl LayoutName {
    /// Name as the command line writes it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Spline => Spline::<f32>::NAME,
            Self::Spline16 => Spline16::NAME,
            Self::Cubic => Cubic::<f32>::NAME,
            Self::Quadratic => Quadratic::<f32>::NAME,
            Self::Rows => Rows16::NAME,
            Self::Harmonic => Harmonic::<f32>::NAME,
            Self::SliderCrank => SliderCrankForm::NAME,
        }
    }

    /// Unit of its size.
    pub const fn counted(self) -> &'static str {
        match self {
            Self::Harmonic => "harmonics",
            Self::SliderCrank => "coefficients",
            _ => "cells",
        }
    }

    /// The Rust type of the format for this number type.
    pub fn type_name(self, number: Number) -> String {
        let number = number.scalar();
        match self {
            Self::Spline => format!("Spline<{number}>"),
            Self::Spline16 => "Spline16".to_owned(),
            Self::Cubic => format!("Cubic<{number}>"),
            Self::Quadratic => format!("Quadratic<{number}>"),
            Self::Rows => "Rows16".to_owned(),
            Self::Harmonic => format!("Harmonic<{number}>"),
            Self::SliderCrank => "SliderCrankForm".to_owned(),
        }
    }
}

impl LayoutChoice {
    /// Name as the command line writes it.
    pub fn name(self) -> &'static str {
        let all = [
            LayoutName::Spline,
            LayoutName::Spline16,
            LayoutName::Cubic,
            LayoutName::Quadratic,
            LayoutName::Rows,
            LayoutName::Harmonic,
            LayoutName::SliderCrank,
        ];
        let mut allowed = all.iter().filter(|layout| self.allows(**layout));
        match (self, allowed.next()) {
            (Self::Auto, _) | (_, None) => "auto",
            (_, Some(layout)) => layout.name(),
        }
    }

    /// Whether this layout may be chosen.
    pub fn allows(self, layout: LayoutName) -> bool {
        match self {
            Self::Auto => layout != LayoutName::Harmonic,
            Self::Spline => layout == LayoutName::Spline,
            Self::Spline16 => layout == LayoutName::Spline16,
            Self::Cubic => layout == LayoutName::Cubic,
            Self::Quadratic => layout == LayoutName::Quadratic,
            Self::Rows => layout == LayoutName::Rows,
            Self::Harmonic => layout == LayoutName::Harmonic,
            Self::SliderCrank => layout == LayoutName::SliderCrank,
        }
    }
}
