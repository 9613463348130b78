//! The coefficients of an identification, and their effect on the torque in the weak form.

use super::weight::{WINDOWS, Weights};
use crate::Phase;
use crate::curve::{Circular, Coefficient, Curve, CurveSet, Kind};

/// A coefficient: its effect, and the harmonic that it belongs to; a mean is cos 0φ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Column<T> {
    pub(super) effect: Effect,
    pub(super) order: u32,
    sine: bool,
    number: T,
    inverse: T,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Effect {
    /// Not identified: 0.
    None,
    Inertia,
    Load,
    Viscous,
    Coulomb,
    Cogging,
}

impl<T: Circular> Column<T> {
    pub(super) fn new(effect: Effect, order: u32, sine: bool) -> Self {
        let number = T::from_count(order);
        let [_, _, one] = T::CONSTANTS;
        Self {
            effect,
            order,
            sine,
            number,
            inverse: one / T::from_count(order.max(1)),
        }
    }

    /// Of a word of a table of harmonics; `None` if it cannot be identified.
    pub(super) fn of_word(word: usize, set: CurveSet) -> Option<Self> {
        let Coefficient { curve, kind } = Coefficient::of_word(word, set)?;
        let effect = match (curve, kind) {
            (Curve::Inertia, _) => Effect::Inertia,
            // A load with a mean is not conservative, and cannot be told from Coulomb friction in one direction.
            (Curve::Load, Kind::Mean) => Effect::None,
            (Curve::Load, _) => Effect::Load,
            (Curve::Viscous, Kind::Mean) => Effect::Viscous,
            (Curve::Coulomb | Curve::Constant, Kind::Mean) => Effect::Coulomb,
            _ => return None,
        };
        Some(match kind {
            Kind::Mean => Self::new(effect, 0, false),
            Kind::Cosine(k) => Self::new(effect, k, false),
            Kind::Sine(k) => Self::new(effect, k, true),
        })
    }

    /// Whether both are torques of the same harmonic of φ.
    pub(super) fn acts_as(&self, other: &Self) -> bool {
        let is_torque = matches!(self.effect, Effect::Load | Effect::Cogging);
        is_torque && self.order == other.order && self.sine == other.sine
    }

    /// Its harmonic at a place, and the derivative with respect to kφ.
    #[inline]
    fn at(&self, phase: Phase, wave: &mut Wave<T>) -> [T; 2] {
        let [c, s] = if self.effect == Effect::Cogging {
            let turned = phase.to_bits().wrapping_mul(self.order);
            let (sin, cos) = T::sin_cos_of(Phase::from_bits(turned));
            [cos, sin]
        } else {
            wave.of(self.order)
        };
        if self.sine { [s, c] } else { [c, -s] }
    }
}

/// cos kφ and sin kφ of rising orders, by rotation.
struct Wave<T> {
    order: u32,
    one: [T; 2],
    now: [T; 2],
}

impl<T: Circular> Wave<T> {
    fn new(phase: Phase) -> Self {
        let [zero, _, one] = T::CONSTANTS;
        let (sin, cos) = T::sin_cos_of(phase);
        Self {
            order: 0,
            one: [cos, sin],
            now: [one, zero],
        }
    }

    #[inline]
    fn of(&mut self, order: u32) -> [T; 2] {
        let [cos, sin] = self.one;
        while self.order < order {
            let [c, s] = self.now;
            self.now = [c * cos - s * sin, s * cos + c * sin];
            self.order += 1;
        }
        self.now
    }
}

/// Where a sample is, as the rows of the open windows see it.
pub(super) struct Place<T> {
    pub(super) phase: Phase,
    /// Angle since each window began (rad).
    pub(super) moved: [T; WINDOWS],
    /// ½ω², and the sign of ω.
    pub(super) half_square: T,
    pub(super) sign: T,
}

/// Adds a sample to the rows of all open windows: ∫[ẅ·G − ½w·g′·ω²], ∫w·g, −∫ẇ·φ, ∫w·sgn ω.
#[inline]
pub(super) fn accumulate<T: Circular, const N: usize>(
    rows: &mut [[T; WINDOWS]; N],
    columns: &[Column<T>; N],
    place: &Place<T>,
    weights: &Weights<T>,
) {
    let mut wave = Wave::new(place.phase);
    let [plain, first, second] = [&weights.plain, &weights.first, &weights.second];
    for (row, column) in rows.iter_mut().zip(columns) {
        let [g, slope] = column.at(place.phase, &mut wave);
        let torque = match column.effect {
            Effect::None => continue,
            Effect::Inertia if column.order == 0 => {
                for ((sum, w2), moved) in row.iter_mut().zip(second).zip(&place.moved) {
                    *sum = *sum + *w2 * *moved;
                }
                continue;
            }
            Effect::Inertia => {
                let integral = -slope * column.inverse;
                let slope = column.number * slope * place.half_square;
                for ((sum, w), w2) in row.iter_mut().zip(plain).zip(second) {
                    *sum = *sum + *w2 * integral - *w * slope;
                }
                continue;
            }
            Effect::Viscous => {
                for ((sum, w1), moved) in row.iter_mut().zip(first).zip(&place.moved) {
                    *sum = *sum - *w1 * *moved;
                }
                continue;
            }
            Effect::Load => -g,
            Effect::Coulomb => place.sign,
            Effect::Cogging => g,
        };
        for (sum, w) in row.iter_mut().zip(plain) {
            *sum = *sum + *w * torque;
        }
    }
}

/// A machine at a place: J, J′, J″, ∂T/∂φ of load and cogging, and b.
pub(super) struct Local<T> {
    pub(super) inertia: T,
    pub(super) slope: T,
    pub(super) curvature: T,
    pub(super) stiffness: T,
    pub(super) viscous: T,
}

impl<T: Circular> Local<T> {
    pub(super) fn new<const N: usize>(
        phase: Phase,
        columns: &[Column<T>; N],
        coefficients: &[T; N],
    ) -> Self {
        let [zero, ..] = T::CONSTANTS;
        let mut local = Self {
            inertia: zero,
            slope: zero,
            curvature: zero,
            stiffness: zero,
            viscous: zero,
        };
        let mut wave = Wave::new(phase);
        for (column, value) in columns.iter().zip(coefficients) {
            let (k, value) = (column.number, *value);
            let [g, slope] = column.at(phase, &mut wave);
            match column.effect {
                Effect::None | Effect::Coulomb => {}
                Effect::Inertia => {
                    local.inertia = local.inertia + value * g;
                    local.slope = local.slope + k * (value * slope);
                    local.curvature = local.curvature - k * k * (value * g);
                }
                Effect::Load => local.stiffness = local.stiffness - k * value * slope,
                Effect::Cogging => local.stiffness = local.stiffness + k * value * slope,
                Effect::Viscous => local.viscous = value,
            }
        }
        local
    }
}

/// The shares of J(φ) that the coefficients have; 0 for those of other curves.
pub(super) fn inertia_shares<T: Circular, const N: usize>(
    phase: Phase,
    columns: &[Column<T>; N],
) -> [T; N] {
    let [zero, ..] = T::CONSTANTS;
    let mut wave = Wave::new(phase);
    columns.map(|column| match column.effect {
        Effect::Inertia => column.at(phase, &mut wave)[0],
        _ => zero,
    })
}
