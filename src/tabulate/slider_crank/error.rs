//! Why a slider-crank has no closed form.

use core::fmt;

use crate::number::error::{Curable, error};

/// Why a slider-crank has no closed form: a curve is not a combination of its functions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum SliderCrankError {
    /// A load acts only in a part of the turn; its index in the list of loads.
    Window(usize),
    /// Constant friction at a point of the rod other than its pins; its index in the list of loads.
    RubbingRod(usize),
    /// A spring or a damper; its index in their list.
    Element(usize),
    /// A crank that swings over a stroke: the closed form covers the whole turn.
    Stroke,
}

impl fmt::Display for SliderCrankError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a slider-crank's closed form cannot hold ")?;
        match self {
            Self::Window(k) => write!(
                f,
                "load {k} (counted from 0), which acts in a part of the turn"
            ),
            Self::RubbingRod(k) => write!(
                f,
                "load {k} (counted from 0), which opposes the motion of a point of the rod between its pins"
            ),
            Self::Element(k) => write!(f, "spring or damper {k} (counted from 0)"),
            Self::Stroke => f.write_str("a crank with a stroke, only one that turns fully"),
        }
    }
}

error!(SliderCrankError);

impl Curable for SliderCrankError {
    fn write_cure(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Window(_) => {
                "use a table, of several pieces where the load begins or ends steeply"
            }
            Self::RubbingRod(_) | Self::Stroke => "use a table",
            Self::Element(_) => "use harmonics (harmonic::fit) or a table",
        })
    }
}
