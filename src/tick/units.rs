//! The machine units that belong to a model.

use super::{AnyModel, Model, Pieces};
use crate::curve::{Format, Set};
use crate::number::{Number, Real};
use crate::{Domain, Scale};

/// What has machine units and a range of the drive link: a [`Model`], an [`AnyModel`], or [`Pieces`]. Sealed.
///
/// What stands before and after a model, such as a [`Period`](crate::axis::Period) or a [`Transmission`](crate::axis::Transmission), takes its units
/// from here: no scale is given beside the model that could be that of another table. Used with another model later, they are wrong if its machine units
/// are others; the compiler tells only the number types apart.
pub trait MachineUnits: crate::sealed::Sealed {
    /// Numbers that its tick takes and gives.
    type Number: Number<Real = Self::Real>;
    /// What its range is in.
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

units!([const SET: Set] Model<'_, F, SET>, |model| model.table().scale(), model.table().domain());
units!([] AnyModel<'_, F>, |model| model.table().scale(), model.table().domain());
units!([const SET: Set, const N: usize] Pieces<'_, F, SET, N>, |turn| &turn.scale, turn.domain);
