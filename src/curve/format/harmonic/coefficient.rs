//! The coefficients and their order.

use crate::CurveSet;
use core::fmt;

use crate::curve::curves;

/// The cosines and sines of curves in addition to their means: the upper bits of a set of curves.
///
/// A curve without terms is constant and takes one number. A machine that is symmetric about φ = 0 (a slider-crank without offset, with centres of
/// mass on the links' lines and weight along the guide) has even J and odd load: half the coefficients.
/// [`terms_in_use`](crate::harmonic::terms_in_use) finds the set.
pub mod terms {
    use crate::CurveSet;

    /// Cosines of J.
    pub const INERTIA_COS: CurveSet = 1 << 8;
    /// Sines of J.
    pub const INERTIA_SIN: CurveSet = 1 << 9;
    /// Cosines of the load.
    pub const LOAD_COS: CurveSet = 1 << 10;
    /// Sines of the load.
    pub const LOAD_SIN: CurveSet = 1 << 11;
    /// Cosines of the viscous coefficient.
    pub const VISCOUS_COS: CurveSet = 1 << 12;
    /// Sines of the viscous coefficient.
    pub const VISCOUS_SIN: CurveSet = 1 << 13;
    /// Cosines of the Coulomb friction.
    pub const COULOMB_COS: CurveSet = 1 << 14;
    /// Sines of the Coulomb friction.
    pub const COULOMB_SIN: CurveSet = 1 << 15;
    /// J and load of any machine; constant viscous and Coulomb friction.
    pub const GENERAL: CurveSet = INERTIA_COS | INERTIA_SIN | LOAD_COS | LOAD_SIN;
    /// J even, load odd; constant viscous and Coulomb friction.
    pub const SYMMETRIC: CurveSet = INERTIA_COS | LOAD_SIN;
    /// All.
    pub const ALL: CurveSet = 0xff00;
}

/// The terms of existing curves.
pub(crate) const fn in_use(set: CurveSet) -> CurveSet {
    let mut used = set & (terms::INERTIA_COS | terms::INERTIA_SIN);
    let mut curve = 1;
    while curve < 4 {
        if set & (1 << (curve - 1)) != 0 {
            used |= set & ((terms::INERTIA_COS | terms::INERTIA_SIN) << (2 * curve));
        }
        curve += 1;
    }
    used
}

/// Number of means: J and the curves of the set.
pub(crate) const fn means(set: CurveSet) -> usize {
    let mut means = 0;
    let mut curve = 0;
    while curve < Curve::ALL.len() {
        means += Curve::ALL[curve].is_in(set) as usize;
        curve += 1;
    }
    means
}

/// Number of coefficients of each harmonic.
pub(crate) const fn row(set: CurveSet) -> usize {
    in_use(set).count_ones() as usize
}

/// A curve of the reduced machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Curve {
    /// J (kg·m²).
    Inertia,
    /// −U′ + process (N·m).
    Load,
    /// b in −b·ω (N·m·s/rad).
    Viscous,
    /// The varying part of c in −c·sgn ω (N·m), signed: the tick uses its magnitude.
    Coulomb,
    /// The constant part of c (N·m).
    Constant,
}

impl Curve {
    pub(crate) const ALL: [Self; 5] = [
        Self::Inertia,
        Self::Load,
        Self::Viscous,
        Self::Coulomb,
        Self::Constant,
    ];

    /// Whether machines of this set have it. A constant b is the mean of a curve without terms.
    pub(crate) const fn is_in(self, set: CurveSet) -> bool {
        let bits = match self {
            Self::Inertia => return true,
            Self::Load => curves::LOAD,
            Self::Viscous => curves::VISCOUS | curves::CONSTANT_VISCOUS,
            Self::Coulomb => curves::COULOMB,
            Self::Constant => curves::CONSTANT_COULOMB,
        };
        set & bits != 0
    }
}

/// The part of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Kind {
    /// a₀, the mean over a turn.
    Mean,
    /// aₖ of cos kφ.
    Cosine(u32),
    /// bₖ of sin kφ.
    Sine(u32),
}

/// One coefficient, in the unit of its curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Coefficient {
    /// The curve.
    pub curve: Curve,
    /// The part of it.
    pub kind: Kind,
}

impl Coefficient {
    /// The meaning of the coefficient `word`, counted from 0. First the means of J and of the curves of `set`, constant Coulomb friction last; then
    /// for each harmonic, as far as the set has them, the cosine and sine of J, of the load, of the viscous coefficient, of the Coulomb friction.
    /// `None` after the last possible one.
    #[must_use]
    pub fn of_word(word: usize, set: CurveSet) -> Option<Self> {
        let mut present = Curve::ALL.into_iter().filter(|curve| curve.is_in(set));
        let Some(place) = word.checked_sub(means(set)) else {
            let kind = Kind::Mean;
            return present.nth(word).map(|curve| Self { curve, kind });
        };
        let row = row(set);
        let order = place.checked_div(row)? as u32 + 1;
        let used = in_use(set) >> 8;
        let bit = (0..8)
            .filter(|bit| used & (1 << bit) != 0)
            .nth(place % row)?;
        Some(Self {
            // Each of the first four has two bits.
            curve: *Curve::ALL.get(bit / 2)?,
            kind: if bit % 2 == 0 {
                Kind::Cosine(order)
            } else {
                Kind::Sine(order)
            },
        })
    }
}

impl fmt::Display for Coefficient {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.kind {
            Kind::Mean => f.write_str("the mean of ")?,
            Kind::Cosine(order) => write!(f, "cos {order}φ of ")?,
            Kind::Sine(order) => write!(f, "sin {order}φ of ")?,
        }
        f.write_str(match self.curve {
            Curve::Inertia => "J",
            Curve::Load => "the load",
            Curve::Viscous => "the viscous coefficient",
            Curve::Coulomb => "the Coulomb friction",
            Curve::Constant => "the constant Coulomb friction",
        })
    }
}
