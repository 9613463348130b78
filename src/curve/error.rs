//! Why a table or a model is refused.

use core::fmt;

use super::MAX_CELLS;
use super::curves::{self, CurveSet};
use crate::Phase;
use crate::number::error::{Curable, error};
use crate::number::spline::MIN_CELLS;

/// Why words do not form a table, or a table does not form a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum TableError {
    /// Fewer than [`MIN_CELLS`] or more than [`MAX_CELLS`] cells; or too many harmonics.
    Cells(u32),
    /// The number of words does not match the cells and curves.
    Length {
        /// Words needed.
        needed: u32,
        /// Words given.
        given: u32,
    },
    /// A cell of this curve contains a number that is not finite or is outside the fixed-point range.
    Range {
        /// Position of the curve in a row.
        curve: u8,
        /// Index of the cell.
        cell: u32,
    },
    /// A curve does not fit the fixed-point range.
    Overflow {
        /// The base of the [`Scale`](crate::Scale) that is too small.
        base: &'static str,
        /// Index of the cell.
        cell: u32,
    },
    /// The reduced inertia is not positive everywhere in this cell.
    NoInertia {
        /// Index of the cell.
        cell: u32,
    },
    /// A periodic curve does not close: its last three rows differ from its first three.
    NotClosed {
        /// Position of the curve in a row.
        curve: u8,
    },
    /// At the speed base the torque ½·J′·ω² leaves the fixed-point range in this cell: increase the torque base or decrease the speed base.
    VelocityTorque {
        /// Index of the cell.
        cell: u32,
    },
    /// In fixed point the speed base is not one of [`Scale::for_cells`](crate::Scale::for_cells); in floating point the bases overflow, or J·ω² is
    /// not in the unit of torque, as a slider-crank needs.
    SpeedBase,
    /// At full speed and acceleration the torque may leave the fixed-point range in this cell: increase the torque base, or the inertia base (which
    /// decreases the acceleration base).
    TorqueRange {
        /// Index of the cell.
        cell: u32,
    },
    /// The constant part of b or c is negative or not finite.
    Constant,
    /// The starts of a turn's pieces are not in order, or a piece is shorter than 2⁻¹⁶ of a turn.
    Pieces,
    /// The models of a turn's pieces have different machine units, or the range of one is not the distance from its start to the next.
    PieceUnits,
    /// The table has another set of [`curves`] than the model; or the set, given here, has an unknown bit, a friction both as a curve and as a
    /// constant, or a reciprocal for floating point.
    Curves(CurveSet),
    /// The curve of the reciprocal inertia does not match the inertia in this cell.
    Reciprocal {
        /// Index of the cell.
        cell: u32,
    },
    /// The reduced inertia of harmonics is not positive here.
    NoInertiaAt {
        /// The phase of the drive link.
        phase: Phase,
    },
    /// The reduced inertia of harmonics is positive at every place checked, but so small that its curvature may make it zero between two of them.
    InertiaNotShown {
        /// Place of the smallest inertia.
        phase: Phase,
    },
    /// Harmonics, or a slider-crank, of a drive link that has a stroke.
    Stroke,
    /// Harmonics cannot be filled from samples: use `harmonic::fit`.
    Harmonics,
    /// A slider-crank cannot be filled from samples: use `slider_crank::form`.
    SliderCrank,
    /// The rod of a slider-crank in closed form is shorter than (r + |e|)/0.95, or a length is NaN.
    ShortRod,
    /// In this cell of a table of 16-bit rows, the stored velocity torque does not match the slope of the inertia.
    Slope {
        /// Index of the cell.
        cell: u32,
    },
}

/// The curves of a set, named as their constants.
const NAMES: [(CurveSet, &str); 6] = [
    (curves::LOAD, "LOAD"),
    (curves::VISCOUS, "VISCOUS"),
    (curves::COULOMB, "COULOMB"),
    (curves::RECIPROCAL, "RECIPROCAL"),
    (curves::CONSTANT_VISCOUS, "CONSTANT_VISCOUS"),
    (curves::CONSTANT_COULOMB, "CONSTANT_COULOMB"),
];

impl fmt::Display for TableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Cells(cells) => write!(
                f,
                "a table of {cells} cells: {MIN_CELLS} to {MAX_CELLS} are possible"
            ),
            Self::Length { needed, given } => {
                write!(f, "the table has {given} words, but needs {needed}")
            }
            Self::Range { curve, cell } => write!(
                f,
                "curve {curve} of the table leaves the number range in cell {cell}"
            ),
            Self::Overflow { cell, .. } => write!(
                f,
                "a curve leaves the fixed-point range in table cell {cell}"
            ),
            Self::NoInertia { cell } => write!(
                f,
                "the reduced inertia is not positive everywhere in cell {cell}"
            ),
            Self::NotClosed { curve } => {
                write!(f, "curve {curve} of the table does not close after a turn")
            }
            Self::VelocityTorque { cell } => {
                write!(f, "the torque of J' leaves the number range in cell {cell}")
            }
            Self::SpeedBase => write!(f, "the speed base does not suit the number of cells"),
            Self::TorqueRange { cell } => write!(
                f,
                "at full speed and acceleration the torque leaves the number range in cell {cell}"
            ),
            Self::Constant => write!(
                f,
                "the constant part of the friction is negative or not a finite number"
            ),
            Self::Pieces => write!(
                f,
                "the pieces of a turn must start one after another, each at least 1/65536 of a turn long"
            ),
            Self::PieceUnits => write!(f, "the models of a turn's pieces do not belong together"),
            Self::Curves(set) => {
                write!(f, "the table has J")?;
                for (bit, name) in NAMES {
                    if set & bit != 0 {
                        write!(f, " | {name}")?;
                    }
                }
                write!(
                    f,
                    " (set {set}): another set than the model's type says, or one that this format cannot have"
                )
            }
            Self::NoInertiaAt { phase } => write!(
                f,
                "the reduced inertia of the harmonics is not positive at φ = {}",
                Degrees(phase)
            ),
            Self::InertiaNotShown { phase } => write!(
                f,
                "the reduced inertia of the harmonics comes too close to zero at φ = {} to be shown positive",
                Degrees(phase)
            ),
            Self::Stroke => write!(
                f,
                "harmonics and a slider-crank's closed form need a drive link that turns fully, but this one has a stroke"
            ),
            Self::SliderCrank => write!(
                f,
                "a slider-crank's closed form is not filled place by place"
            ),
            Self::ShortRod => write!(
                f,
                "the rod is too short for the closed form: (r + |e|)/l is above 0.95"
            ),
            Self::Harmonics => write!(f, "harmonics are not filled place by place"),
            Self::Slope { cell } => write!(
                f,
                "the velocity torque in cell {cell} is not that of the slope of the inertia"
            ),
            Self::Reciprocal { cell } => write!(
                f,
                "the curve of the reciprocal inertia does not belong to that of the inertia in cell {cell}"
            ),
        }
    }
}

error!(TableError);

impl Curable for TableError {
    fn write_cure(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Overflow { base, .. } => return write!(f, "choose a larger {base} base"),
            Self::NoInertia { .. } => "use more cells",
            Self::VelocityTorque { .. } => "choose a larger torque base or a smaller speed base",
            Self::SpeedBase => "take Scale::for_cells",
            Self::TorqueRange { .. } => {
                "choose a larger torque base, or a larger inertia base for less acceleration"
            }
            Self::PieceUnits => {
                "make them in the same machine units, each over the range from its start to the next"
            }
            Self::NoInertiaAt { .. } => "give the drive link an inertia, or use more harmonics",
            Self::InertiaNotShown { .. } => "give the drive link an inertia",
            Self::Stroke | Self::ShortRod => "use a table",
            Self::SliderCrank => "use slider_crank::form",
            Self::Harmonics => "use harmonic::fit",
            Self::Slope { .. } => "take the span and the scale that the table was made with",
            _ => "",
        })
    }
}

/// A phase in degrees, rounded down to hundredths, in integers.
struct Degrees(Phase);

impl fmt::Display for Degrees {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let hundredths = (u64::from(self.0.to_bits()) * 36_000) >> 32;
        write!(f, "{}.{:02}°", hundredths / 100, hundredths % 100)
    }
}
