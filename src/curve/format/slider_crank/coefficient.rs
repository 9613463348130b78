//! The coefficients and their order.

use core::fmt;

use crate::CurveSet;
use crate::curve::curves;

/// Terms of a slider-crank in addition to the curves themselves: the upper bits of a set of curves, one for each coefficient.
///
/// The curves are in [`curves`]: `LOAD` adds the coefficient of X, `VISCOUS` of X², `COULOMB` of |X|, and `CONSTANT_VISCOUS`, `CONSTANT_COULOMB`
/// those independent of φ. [`slider_crank::set_in_use`](crate::slider_crank::set_in_use) finds the set.
pub mod terms {
    use crate::CurveSet;

    /// The rod's centre of mass is not on the line through its pins: J has a part in X·cos φ.
    pub const INERTIA_COS: CurveSet = 1 << 8;
    /// Weight and forces: the part of the load in sin φ.
    pub const LOAD_SIN: CurveSet = 1 << 9;
    /// Weight and forces: the part of the load in cos φ.
    pub const LOAD_COS: CurveSet = 1 << 10;
    /// A constant moment on the crank.
    pub const LOAD_CONSTANT: CurveSet = 1 << 11;
    /// A constant moment on the rod: the part of the load in Ψ.
    pub const LOAD_ROD: CurveSet = 1 << 12;
    /// Viscous friction of the rod: the part of b in X·sin φ.
    pub const VISCOUS_SIN: CurveSet = 1 << 13;
    /// Viscous friction at a point off the rod's line: the part of b in X·cos φ.
    pub const VISCOUS_COS: CurveSet = 1 << 14;
    /// Coulomb friction of the rod's rotation: the part of c in |Ψ|.
    pub const COULOMB_ROD: CurveSet = 1 << 15;
    /// All.
    pub const ALL: CurveSet = 0xff00;
}

/// A coefficient: its function of φ, and its unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(usize)]
pub enum Coefficient {
    /// λ = r/l, with the sign of cos ψ: negative for a slider on the left.
    Ratio,
    /// e/l, with the sign of cos ψ.
    Offset,
    /// J: constant part (kg·m²).
    Inertia,
    /// J: of X² (kg·m²).
    InertiaSquare,
    /// J: of X·sin φ (kg·m²).
    InertiaSin,
    /// J: of X·cos φ (kg·m²).
    InertiaCos,
    /// Load: of X (N·m).
    Load,
    /// Load: of sin φ (N·m).
    LoadSin,
    /// Load: of cos φ (N·m).
    LoadCos,
    /// Load: constant part (N·m).
    LoadConstant,
    /// Load: of Ψ (N·m).
    LoadRod,
    /// b: of X² (N·m·s/rad).
    ViscousSquare,
    /// b: of X·sin φ (N·m·s/rad).
    ViscousSin,
    /// b: of X·cos φ (N·m·s/rad).
    ViscousCos,
    /// b: constant part (N·m·s/rad).
    Viscous,
    /// c: of |X| (N·m).
    Coulomb,
    /// c: of |Ψ| (N·m).
    CoulombRod,
    /// c: constant part (N·m).
    CoulombConstant,
}

/// Greatest number of coefficients.
pub(crate) const COEFFICIENTS: usize = 18;

impl Coefficient {
    /// In the order of a table's words.
    pub const ALL: [Self; COEFFICIENTS] = [
        Self::Ratio,
        Self::Offset,
        Self::Inertia,
        Self::InertiaSquare,
        Self::InertiaSin,
        Self::InertiaCos,
        Self::Load,
        Self::LoadSin,
        Self::LoadCos,
        Self::LoadConstant,
        Self::LoadRod,
        Self::ViscousSquare,
        Self::ViscousSin,
        Self::ViscousCos,
        Self::Viscous,
        Self::Coulomb,
        Self::CoulombRod,
        Self::CoulombConstant,
    ];

    /// The bits of the set that it needs.
    pub(crate) const fn bits(self) -> CurveSet {
        match self {
            Self::Ratio | Self::Offset | Self::Inertia | Self::InertiaSquare | Self::InertiaSin => {
                curves::INERTIA
            }
            Self::InertiaCos => terms::INERTIA_COS,
            Self::Load => curves::LOAD,
            Self::LoadSin => curves::LOAD | terms::LOAD_SIN,
            Self::LoadCos => curves::LOAD | terms::LOAD_COS,
            Self::LoadConstant => curves::LOAD | terms::LOAD_CONSTANT,
            Self::LoadRod => curves::LOAD | terms::LOAD_ROD,
            Self::ViscousSquare => curves::VISCOUS,
            Self::ViscousSin => curves::VISCOUS | terms::VISCOUS_SIN,
            Self::ViscousCos => curves::VISCOUS | terms::VISCOUS_COS,
            Self::Viscous => curves::CONSTANT_VISCOUS,
            Self::Coulomb => curves::COULOMB,
            Self::CoulombRod => curves::COULOMB | terms::COULOMB_ROD,
            Self::CoulombConstant => curves::CONSTANT_COULOMB,
        }
    }

    /// Whether machines of this set have it.
    pub(crate) const fn is_in(self, set: CurveSet) -> bool {
        set & self.bits() == self.bits()
    }

    /// Position of its curve: J, load, b, c; the lengths count as J.
    pub(crate) const fn curve(self) -> u8 {
        match self.bits() & curves::ALL {
            curves::LOAD => 1,
            curves::VISCOUS => 2,
            curves::COULOMB => 3,
            _ => match self {
                Self::Viscous => 2,
                Self::CoulombConstant => 3,
                _ => 0,
            },
        }
    }
}

/// Words of a table.
pub(crate) const fn words(set: CurveSet) -> usize {
    let (mut words, mut k) = (0, 0);
    while k < COEFFICIENTS {
        words += Coefficient::ALL[k].is_in(set) as usize;
        k += 1;
    }
    words
}

/// Whether every term has its curve.
pub(crate) const fn is_known(set: CurveSet) -> bool {
    let curves =
        curves::ALL | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB | terms::INERTIA_COS;
    let (mut known, mut k) = (curves, 0);
    while k < COEFFICIENTS {
        if Coefficient::ALL[k].is_in(set) {
            known |= Coefficient::ALL[k].bits();
        }
        k += 1;
    }
    set & !known == 0
}

impl fmt::Display for Coefficient {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Ratio => "r/l",
            Self::Offset => "e/l",
            Self::Inertia => "the constant part of J",
            Self::InertiaSquare => "X² of J",
            Self::InertiaSin => "X·sin φ of J",
            Self::InertiaCos => "X·cos φ of J",
            Self::Load => "X of the load",
            Self::LoadSin => "sin φ of the load",
            Self::LoadCos => "cos φ of the load",
            Self::LoadConstant => "the constant part of the load",
            Self::LoadRod => "Ψ of the load",
            Self::ViscousSquare => "X² of b",
            Self::ViscousSin => "X·sin φ of b",
            Self::ViscousCos => "X·cos φ of b",
            Self::Viscous => "the constant part of b",
            Self::Coulomb => "|X| of c",
            Self::CoulombRod => "|Ψ| of c",
            Self::CoulombConstant => "the constant part of c",
        })
    }
}
