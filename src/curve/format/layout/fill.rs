//! Fills a table with the polynomials of its curves.

use super::rounding::Points;
use super::{Constants, Layout, Word};
use crate::curve::curves::{self, has};
use crate::curve::samples::{Sample, Samples};
use crate::curve::{CurveSet, TableError, unfold};
use crate::math;
use crate::number::error::RangeError;
use crate::number::spline::{
    control_points, fit_bounded, fit_periodic, fit_quadratic_bounded, fit_quadratic_periodic,
};
use crate::number::{Kernel, Role};

/// Fills `words`, and returns the table's constants.
pub(super) fn fill<L: Layout, E: From<TableError> + From<RangeError>>(
    samples: &Samples<impl Fn(f64) -> Result<Sample, E>>,
    scratch: &mut [f64],
    words: &mut [Word<L>],
) -> Result<Constants<Word<L>>, E> {
    let (set, cells, periodic) = (samples.set, samples.cells as usize, samples.periodic());
    let rows = control_points(cells);
    let (values, control) = scratch
        .split_at_mut_checked(curves::width(set) * rows)
        .unwrap_or_default();
    let control = control.get_mut(..rows).unwrap_or_default();
    let knots = sample::<L, E>(samples, values)?;
    let mut constants = constants::<L, E>(samples, |column| {
        let values = values.get(column * rows..).and_then(|v| v.get(..knots));
        values.unwrap_or_default()
    })?;
    let middle = L::Number::exact(Role::Inertia, L::Number::raw(constants.inertia));
    for (column, role) in curves::roles(set) {
        let overflow = |cell| match role {
            // More cells help.
            Role::Reciprocal => TableError::Reciprocal { cell },
            _ => TableError::Overflow {
                base: role.base(),
                cell,
            },
        };
        let values = values
            .get_mut(column * rows..)
            .and_then(|v| v.get_mut(..knots));
        let values = values.unwrap_or_default();
        if role == Role::Inertia && middle != 0.0 {
            for value in values.iter_mut() {
                *value -= middle;
            }
        }
        if role == Role::Coulomb {
            unfold(values, periodic);
        }
        match (L::DEGREE, periodic) {
            (3, true) => fit_periodic(values, control)?,
            (3, false) => fit_bounded(values, control)?,
            (_, true) => fit_quadratic_periodic(values, control)?,
            (_, false) => fit_quadratic_bounded(values, control)?,
        }
        let mut gain = 1;
        if L::HALVES {
            gain = self::gain::<L>(role, control).ok_or(overflow(0))?;
            if let Some(slot) = constants.gains.get_mut(role as usize) {
                *slot = gain;
            }
        }
        for part in 0..L::COLUMN {
            let mut points: Points<'_, L> = Points {
                words: &mut *words,
                role,
                first: if L::HALVES {
                    column / 2
                } else {
                    column * L::COLUMN + part
                },
                pitch: <L as Layout>::ROW.pitch(set),
                upper: column % 2 == 1,
                gain: f64::from(gain),
            };
            for row in 0..cells + <L as Layout>::ROW.more {
                let control = [0, 1, 2, 3].map(|k| control.get(row + k).copied().unwrap_or(0.0));
                let value = L::stored(control).get(part).copied().unwrap_or(0.0);
                let cell = row.min(cells - 1) as u32;
                points.set(row, value).ok_or(overflow(cell))?;
            }
            if <L as Layout>::ROW.more > 0 && role == Role::Inertia {
                points.round_together(control, periodic.then_some(cells));
            }
        }
    }
    Ok(constants)
}

/// Samples of every curve of the set, in machine units, at the places that the format's spline passes through; returns their number. Samples of one
/// curve lie side by side.
fn sample<L: Layout, E>(
    samples: &Samples<impl Fn(f64) -> Result<Sample, E>>,
    values: &mut [f64],
) -> Result<usize, E> {
    let (set, cells) = (samples.set, samples.cells);
    let rows = control_points(cells as usize);
    let ends = !samples.periodic();
    let count = (cells + u32::from(ends) * u32::from(4 - L::DEGREE)) as usize;
    for k in 0..count {
        let place = k as f64;
        let cell = if L::DEGREE == 3 {
            place
        } else if ends {
            (place - 0.5).clamp(0.0, f64::from(cells))
        } else {
            place + 0.5
        };
        let point = samples.at_cell(cell)?;
        for (column, role) in curves::roles(set) {
            if let Some(slot) = values.get_mut(column * rows + k) {
                *slot = match role {
                    Role::Inertia => point.inertia,
                    Role::Load => point.load,
                    Role::Viscous => point.viscous,
                    Role::Coulomb => point.coulomb,
                    // Computed below from all samples of J.
                    Role::Reciprocal => 0.0,
                };
            }
        }
    }
    // The seed of the reciprocal is computed in units of the power of two below the least inertia.
    if let Some(column) = Role::Reciprocal.column(set) {
        let inertia = values.get(..count).unwrap_or_default();
        let least = inertia.iter().copied().fold(f64::INFINITY, f64::min);
        // A tenth lower, because a coarse curve overshoots.
        let unit = math::exp2(math::floor(math::log2(0.9 * least)));
        for k in 0..count {
            let inertia = values.get(k).copied().unwrap_or(1.0);
            if let Some(slot) = values.get_mut(column * rows + k) {
                *slot = unit / inertia;
            }
        }
    }
    Ok(count)
}

/// Constants of a table, in addition to its curves.
fn constants<'v, L: Layout, E: From<TableError>>(
    samples: &Samples<impl Fn(f64) -> Result<Sample, E>>,
    values: impl Fn(usize) -> &'v [f64],
) -> Result<Constants<Word<L>>, E> {
    let stored = |role: Role, value: f64| {
        let base = role.base();
        L::Number::word(role, value).ok_or(TableError::Overflow { base, cell: 0 })
    };
    let start = samples.at_cell(0.0)?;
    let constant = |bit: CurveSet, value: f64| if has(samples.set, bit) { value } else { 0.0 };
    // The middle of the range minimises the control points.
    let inertia = if <L as Layout>::ROW.more > 0 {
        let ends = values(0)
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), j| {
                (least.min(*j), most.max(*j))
            });
        0.5 * (ends.0 + ends.1)
    } else {
        0.0
    };
    let viscous = constant(curves::CONSTANT_VISCOUS, start.viscous);
    let coulomb = constant(curves::CONSTANT_COULOMB, start.coulomb);
    Ok(Constants {
        inertia: stored(Role::Inertia, inertia)?,
        viscous: stored(Role::Viscous, viscous)?,
        coulomb: stored(Role::Coulomb, coulomb)?,
        gains: [0; 5],
    })
}

/// The smallest integer gain with which all points of a curve fit into 16 bits.
fn gain<L: Layout>(role: Role, control: &[f64]) -> Option<u16> {
    // The sweeps of the rounding may move a point by a unit or two.
    const LARGEST: f64 = 32_760.0;
    let most = control
        .iter()
        .fold(0.0f64, |most, c| most.max(math::abs(*c)));
    let unit = L::unit(role);
    let gain = math::floor(most / unit / LARGEST) + 1.0;
    (gain <= f64::from(u16::MAX)).then_some(gain as u16)
}
