//! The machine units of a model.

use core::marker::PhantomData;

use super::{AnyModel, Model, Pieces};
use crate::curve::{CurveSet, Format};
use crate::number::error::{RangeError, positive};
use crate::number::{Bases, Number, Real};
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

/// The machine units of an image whose number type the caller knows, for the library for C: there the parts of an axis are made from `jred_info`.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct Units<N> {
    scale: Scale,
    domain: Domain<f32>,
    number: PhantomData<N>,
}

impl<N: Number<Real = f32>> Units<N> {
    /// These bases and this range.
    ///
    /// # Errors
    /// A base or a stroke that is not positive and finite.
    pub fn new(bases: Bases, domain: Domain<f32>) -> Result<Self, RangeError> {
        positive("the stroke", domain.span().into())?;
        Ok(Self {
            scale: Scale::new(bases)?,
            domain,
            number: PhantomData,
        })
    }
}

impl<N> crate::sealed::Sealed for Units<N> {}

impl<N: Number<Real = f32>> MachineUnits for Units<N> {
    type Number = N;
    type Real = f32;

    fn scale(&self) -> &Scale {
        &self.scale
    }
    fn domain(&self) -> Domain<f32> {
        self.domain
    }
}
