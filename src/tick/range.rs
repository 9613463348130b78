//! What is proven of a model when it is built: no quantity leaves its number range in a tick.
//!
//! Every polynomial stays within its Bézier points, so the bounds hold everywhere in a cell, not only at the knots.

use crate::curve::{Layout, Role, Table, TableError, bezier, curves};
use crate::number::{Kernel, Scalar};
use crate::{Phase, Scale};

/// How much of the number range each quantity uses at most, over all phases and at full speed and acceleration: 1 is all of it
/// in fixed point. In floating point it is the quantity itself, in machine units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Usage {
    /// J
    pub inertia: f32,
    /// ½·J′·ω²
    pub velocity: f32,
    /// −U′ + process
    pub load: f32,
    /// b·ω
    pub viscous: f32,
    /// c
    pub coulomb: f32,
    /// The sum of all of them: the torque.
    pub torque: f32,
}

impl Usage {
    fn of_cell<S: Scalar, L: Layout>(table: &Table<'_, S, L>, cell: u32, per_slope: f32) -> Self {
        let most = |points: &[f32]| points.iter().fold(0.0f32, |most, p| most.max(p.abs()));
        let inertia = table.polynomial(cell, Role::Inertia);
        let [_, p1, p2, p3] = inertia;
        let slope = most(&[p1, p1 + p2, p1 + 2.0 * p2 + 3.0 * p3]);
        let constants = table.constants();
        let curve = |role: Role, constant: Option<S::Word>| {
            let constant = constant.map_or(0.0, |word| {
                S::approximate(role, S::widen(S::raw(word))).abs()
            });
            match role.column(table.curves()) {
                Some(_) => constant + most(&bezier(table.polynomial(cell, role))),
                None => constant,
            }
        };
        let mut usage = Self {
            inertia: most(&bezier(inertia)),
            velocity: slope * per_slope,
            load: curve(Role::Load, None),
            viscous: curve(Role::Viscous, Some(constants.viscous)),
            coulomb: curve(Role::Coulomb, Some(constants.coulomb)),
            torque: 0.0,
        };
        usage.torque = usage.inertia + usage.velocity + usage.load + usage.viscous + usage.coulomb;
        usage
    }

    /// Of a table whose range is `span` (2π, or the stroke) in these machine units.
    ///
    /// # Errors
    /// The first cell in which something does not fit: as [`Model::new`](super::Model::new).
    pub fn of<S: Scalar, L: Layout>(
        table: &Table<'_, S, L>,
        span: S::Span,
        scale: &Scale,
    ) -> Result<Self, TableError> {
        let per_slope =
            <f32 as Kernel>::velocity_factor(table.cells(), S::span_to_f32(span), scale, 1)
                .ok_or(TableError::SpeedBase)?;
        // Below 1 by more than the roundings of a tick and of these sums. Those of the slope count as often as the factor of
        // the velocity torque says: less than 8 units of Q30.
        let roundings = 1e-5 + per_slope * (8.0 / 1_073_741_824.0);
        let limit = if S::FIXED { 1.0 - roundings } else { 1e30 };
        let mut all = Self::default();
        for cell in 0..table.cells() {
            let usage = Self::of_cell(table, cell, per_slope);
            // NaN is not less than anything.
            let fits = |size: f32| size < limit;
            if !fits(usage.velocity) {
                return Err(TableError::VelocityTorque { cell });
            }
            if !fits(usage.torque) {
                return Err(TableError::TorqueRange { cell });
            }
            all = all.or(usage);
        }
        Ok(all)
    }

    /// The largest of each.
    pub(crate) fn or(self, other: Self) -> Self {
        Self {
            inertia: self.inertia.max(other.inertia),
            velocity: self.velocity.max(other.velocity),
            load: self.load.max(other.load),
            viscous: self.viscous.max(other.viscous),
            coulomb: self.coulomb.max(other.coulomb),
            torque: self.torque.max(other.torque),
        }
    }
}

/// What makes a model of a table: the factor of the velocity torque, and the constants of the reciprocal.
pub(crate) fn check<S: Scalar, L: Layout>(
    table: &Table<'_, S, L>,
    span: S::Span,
    scale: &Scale,
) -> Result<(S::Factor, S::Reciprocal), TableError> {
    let factor = S::velocity_factor(table.cells(), span, scale, L::step::<S>())
        .ok_or(TableError::SpeedBase)?;
    Usage::of(table, span, scale)?;
    let reciprocal = match curves::RECIPROCAL & table.curves() {
        0 => S::Reciprocal::default(),
        _ => reciprocal(table)?.0,
    };
    Ok((factor, reciprocal))
}

/// The constants of the reciprocal, the same in every cell; and the part of an acceleration that it errs by.
pub(super) fn reciprocal<S: Scalar, L: Layout>(
    table: &Table<'_, S, L>,
) -> Result<(S::Reciprocal, f32), TableError> {
    const PLACES: u64 = 4;
    // A seed may err more: Newton's step squares it.
    let limit = if L::NEWTON { 0.2 } else { 0.02 };
    let mut found = None;
    let mut most = 0.0f32;
    let places = u64::from(table.cells()) * PLACES;
    for place in 0..places {
        // In the middle of a quarter of a cell.
        let bits = ((2 * place + 1) << 31) / places;
        let cell = (place / PLACES) as u32;
        let refused = TableError::Reciprocal { cell };
        let phase = Phase::from_bits(bits as u32);
        let here = table.cell(phase, table.curves()).ok_or(refused)?;
        let reciprocal = here.reciprocal().ok_or(refused)?;
        let inertia = here.inertia().0;
        let (constants, error) = S::reciprocal_of(inertia, reciprocal).ok_or(refused)?;
        let close = error < limit;
        if *found.get_or_insert(constants) != constants || !close {
            return Err(refused);
        }
        most = most.max(if L::NEWTON { error * error } else { error });
    }
    // Between those places as well: Newton's step would overflow from an error of one half on.
    let unit = found.map_or(0.0, S::reciprocal_unit);
    for cell in 0..table.cells() {
        let product = product(
            bezier(table.polynomial(cell, Role::Inertia)),
            bezier(table.polynomial(cell, Role::Reciprocal)),
        );
        let close = |point: &f32| (1.0 - point / unit).abs() < 2.0 * limit;
        if !product.iter().all(close) {
            return Err(TableError::Reciprocal { cell });
        }
    }
    Ok((found.unwrap_or_default(), most))
}

/// The Bézier points of the product of two cubics.
fn product(a: [f32; 4], b: [f32; 4]) -> [f32; 7] {
    const BINOMIALS: [f32; 4] = [1.0, 3.0, 3.0, 1.0];
    const OF_SIX: [f32; 7] = [1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0];
    let mut product = [0.0; 7];
    for (i, (a, m)) in a.iter().zip(BINOMIALS).enumerate() {
        let slots = product.iter_mut().zip(OF_SIX).skip(i);
        for ((slot, of_six), (b, n)) in slots.zip(b.iter().zip(BINOMIALS)) {
            *slot += m * n / of_six * a * b;
        }
    }
    product
}
