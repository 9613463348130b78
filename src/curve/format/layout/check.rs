//! Proofs about a table when it is created: no quantity leaves its number range in a tick.
//!
//! Every polynomial stays within its Bézier points, so that the bounds apply everywhere in a cell, not only at the knots.

use super::Layout;
use super::cell::{Cell, polynomial, wide};
use crate::curve::format::Runs;
use crate::curve::{CurveSet, Table, TableError, Usage, curves};
use crate::math::Real;
use crate::number::{Kernel, Number, Role};
use crate::{Domain, Phase};

/// Checks every cell, for [`Table::new`].
pub(super) fn table<L: Layout>(table: &Table<'_, L>) -> Result<(), TableError> {
    for role in [Role::Viscous, Role::Coulomb] {
        // Friction does not drive. NaN is refused, too.
        if !(0.0..1e30).contains(&constant(table, role)) {
            return Err(TableError::Constant);
        }
    }
    for cell in 0..table.cells() {
        for (column, role) in curves::roles(table.set()) {
            if !L::Number::is_sound(wide(table, cell, role)) {
                let curve = column as u8;
                return Err(TableError::Range { curve, cell });
            }
        }
        if !is_positive(polynomial(table, cell, Role::Inertia)) {
            return Err(TableError::NoInertia { cell });
        }
    }
    if matches!(table.domain(), Domain::Turn) {
        check_closed(table)?;
    }
    Ok(())
}

/// A constant b or c in machine units.
fn constant<L: Layout>(table: &Table<'_, L>, role: Role) -> f32 {
    let word = match role {
        Role::Viscous => table.constants().viscous,
        _ => table.constants().coulomb,
    };
    L::Number::approximate(role, L::Number::widen(L::Number::raw(word)))
}

/// Checks that the rows after the cells repeat the first ones.
fn check_closed<L: Layout>(table: &Table<'_, L>) -> Result<(), TableError> {
    let pitch = <L as Layout>::ROW.pitch(table.set()).max(1);
    let end = table.cells() as usize * pitch;
    for k in 0..<L as Layout>::ROW.more * pitch {
        if table.words().get(k) != table.words().get(end + k) {
            let curve = (k % pitch * if L::HALVES { 2 } else { 1 }) as u8;
            return Err(TableError::NotClosed { curve });
        }
    }
    Ok(())
}

/// Whether the cubic of a cell is positive throughout, by its Bézier points (sufficient; the tabulator adds cells until it is true).
fn is_positive(polynomial: [f32; 4]) -> bool {
    let hull = bezier(polynomial);
    // Above the roundings of these sums, so that a cell that dips a few units below zero does not pass.
    let rounding = 1e-6 * hull.iter().fold(0.0f32, |most, b| most.max(b.abs()));
    hull.iter().all(|b| *b > rounding)
}

/// The Bézier points of a cubic, which bound it.
fn bezier([p0, p1, p2, p3]: [f32; 4]) -> [f32; 4] {
    [
        p0,
        p0 + p1 / 3.0,
        p0 + (2.0 * p1 + p2) / 3.0,
        p0 + p1 + p2 + p3,
    ]
}

fn usage_of_cell<L: Layout>(table: &Table<'_, L>, cell: u32, per_slope: f32) -> Usage {
    let most = |points: &[f32]| points.iter().fold(0.0f32, |most, p| most.max(p.abs()));
    let inertia = polynomial(table, cell, Role::Inertia);
    let [_, p1, p2, p3] = inertia;
    let slope = most(&[p1, p1 + p2, p1 + 2.0 * p2 + 3.0 * p3]);
    let curve = |role: Role| match role.column(table.set()) {
        Some(_) => most(&bezier(polynomial(table, cell, role))),
        None => 0.0,
    };
    let mut usage = Usage {
        inertia: most(&bezier(inertia)),
        velocity: slope * per_slope,
        load: curve(Role::Load),
        viscous: curve(Role::Viscous) + constant(table, Role::Viscous),
        coulomb: curve(Role::Coulomb) + constant(table, Role::Coulomb),
        torque: 0.0,
    };
    usage.torque = usage.inertia + usage.velocity + usage.load + usage.viscous + usage.coulomb;
    usage
}

/// In fixed point this proves that no torque leaves the number range for any speed and acceleration in it.
pub(super) fn usage<L: Layout>(table: &Table<'_, L>) -> Result<Usage, TableError> {
    let span = table.domain().span().to_f32();
    let per_slope = <f32 as Kernel>::velocity_factor(table.cells(), span, table.scale(), 1)
        .ok_or(TableError::SpeedBase)?;
    // Below 1 by more than the roundings of a tick and of these sums. Those of the slope are multiplied by the factor of the velocity torque: less
    // than 8 units of Q30.
    let roundings = 1e-5 + per_slope * (8.0 / 1_073_741_824.0);
    let limit = if L::Number::FIXED {
        1.0 - roundings
    } else {
        1e30
    };
    let mut all = Usage::default();
    for cell in 0..table.cells() {
        let usage = usage_of_cell(table, cell, per_slope);
        // A comparison with NaN is false.
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

/// Values of a checked table that a model needs.
#[derive(Clone, Copy, Debug)]
pub struct LayoutTick<'a, L: Layout> {
    pub(super) rows: L::Rows<'a>,
    /// Factor of the velocity torque.
    pub(super) factor: <L::Number as Kernel>::Factor,
    pub(super) reciprocal: <L::Number as Kernel>::Reciprocal,
}

impl<L: Layout> LayoutTick<'_, L> {
    #[inline(always)]
    pub(super) fn moved<'a>(&self, table: &Table<'a, L>, set: CurveSet) -> LayoutTick<'a, L> {
        let row = <L as Layout>::ROW;
        let rows = table.cells() + row.more as u32;
        LayoutTick {
            rows: Runs::counted(table.words(), row.pitch(set), rows),
            factor: self.factor,
            reciprocal: self.reciprocal,
        }
    }
}

pub(super) fn model<'a, L: Layout>(table: &Table<'a, L>) -> Result<LayoutTick<'a, L>, TableError> {
    let (span, scale) = (table.domain().span(), table.scale());
    let factor = L::Number::velocity_factor(table.cells(), span, scale, L::STEP)
        .ok_or(TableError::SpeedBase)?;
    usage(table)?;
    let reciprocal = if curves::has(table.set(), curves::RECIPROCAL) {
        reciprocal(table)?.0
    } else {
        <L::Number as Kernel>::Reciprocal::default()
    };
    Ok(LayoutTick {
        rows: L::rows(table.words(), table.set()),
        factor,
        reciprocal,
    })
}

/// The constants of the reciprocal, the same in every cell; and its relative error in an acceleration, the largest at four places of every cell.
pub(super) fn reciprocal<L: Layout>(
    table: &Table<'_, L>,
) -> Result<(<L::Number as Kernel>::Reciprocal, f32), TableError> {
    const PLACES: u64 = 4;
    // A seed may have a larger error: Newton's step squares it.
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
        let here = Cell::at(table, phase).ok_or(refused)?;
        let reciprocal = here.curve(Role::Reciprocal).ok_or(refused)?;
        let inertia = here.inertia().0;
        let (constants, error) = L::Number::reciprocal_of(inertia, reciprocal).ok_or(refused)?;
        let close = error < limit;
        if *found.get_or_insert(constants) != constants || !close {
            return Err(refused);
        }
        most = most.max(if L::NEWTON { error * error } else { error });
    }
    // Between those places, too: Newton's step would overflow from an error of one half on.
    let unit = found.map_or(0.0, L::Number::reciprocal_unit);
    for cell in 0..table.cells() {
        let product = product(
            bezier(polynomial(table, cell, Role::Inertia)),
            bezier(polynomial(table, cell, Role::Reciprocal)),
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
