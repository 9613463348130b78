//! The machine units of a model.

use super::{AnyModel, Model, Pieces};
use crate::curve::{CurveSet, Format};
use crate::number::{Number, Real};
use crate::{Domain, Scale};

/// The machine units and the range of the drive link of a [`Model`], an [`AnyModel`], or [`Pieces`]. Sealed.
///
/// The parts before and after a model, such as a [`Period`](crate::axis::Period) or a [`Transmission`](crate::axis::Transmission), take their units
/// from it, so that no separate scale can be that of another table. Used later with a model of other machine units, they are wrong; the compiler
/// distinguishes only the number types.
pub trait MachineUnits: crate::sealed::Sealed {
    /// Numbers of its tick.
    type Number: Number<Real = Self::Real>;
    /// Numbers of its range.
    type Real: Real;

    /// The machine units.
    fn scale(&self) -> &Scale;
    /// Range of the drive link.
    fn domain(&self) -> Domain<Self::Real>;
}

macro_rules! units {
    ([$($parameters:tt)*] $model:ty, |$this:ident| $scale:expr, $domain:expr) => {
        impl<F: Format, $($parameters)*> crate::sealed::Sealed for $model {}

        impl<F: Format, $($parameters)*> MachineUnits for $model {
            type Number = F::Number;
            type Real = <F::Number as Number>::Real;

            fn scale(&self) -> &Scale {
                let $this = self;
                $scale
            }
            fn domain(&self) -> Domain<Self::Real> {
                let $this = self;
                $domain
            }
        }
    };
}

units!([const SET: CurveSet] Model<'_, F, SET>, |model| model.table().scale(), model.table().domain());
units!([] AnyModel<'_, F>, |model| model.table().scale(), model.table().domain());
units!([const SET: CurveSet, const N: usize] Pieces<'_, F, SET, N>, |turn| &turn.scale, turn.domain);
