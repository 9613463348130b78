//! What a slider-crank's closed form cannot hold.

use core::fmt;

use crate::number::error::{Curable, error};

/// Why a slider-crank has no closed form: it has something whose curve is none of its functions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum SliderCrankError {
    /// A load acts in a part of the turn only; its place in the list of loads.
    Window(usize),
    /// Friction of constant size at a point of the rod other than its pins; its place in the list of loads.
    RubbingRod(usize),
    /// A spring or a damper; its place in their list.
    Element(usize),
    /// A crank that swings over a stroke: the closed form is of the whole turn.
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
