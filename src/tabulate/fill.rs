//! Fills a table of a given size.

use super::rounding::Points;
use super::unfold::unfold;
use super::{scratch_len, words_len};
use crate::curve::{
    Constants, Layout, MAX_CELLS, MIN_CELLS, Role, Table, TableError, control_points, curves,
    fit_bounded, fit_periodic, fit_quadratic_bounded, fit_quadratic_periodic,
};
use crate::machine::reduction::{Reducible, Reduction};
use crate::number::Scalar;
use crate::{Domain, Error, Scale, math};

/// Fills `words` with the table of exactly `cells` cells and of this set of curves, and returns it.
///
/// A constant of the set is the machine's value; the least of them if there is a curve as well, which is what is left. Coulomb
/// friction is stored with a sign that changes where its magnitude has a kink at zero (see [`curves::COULOMB`]).
///
/// # Errors
/// Those of the machine; curves that do not repeat with the turn of the drive link; buffers too short; a curve outside the
/// number range of `scale`.
pub fn fill<'w, S: Scalar, L: Layout>(
    machine: &impl Reducible,
    set: u8,
    cells: u32,
    scale: &Scale,
    scratch: &mut [f64],
    words: &'w mut [S::Word],
) -> Result<Table<'w, S, L>, Error> {
    if cells < MIN_CELLS as u32 || cells > MAX_CELLS {
        return Err(Error::Table(TableError::Cells(cells)));
    }
    let width = curves::width(set);
    let rows = control_points(cells as usize);
    let (given, needed) = (scratch.len(), scratch_len(cells, set));
    let too_short = Error::BufferTooShort { needed, given };
    let (samples, control) = scratch
        .get_mut(..needed)
        .and_then(|s| s.split_at_mut_checked(width * rows))
        .ok_or(too_short)?;
    let (given, needed) = (words.len(), words_len::<L>(cells, set));
    let too_short = Error::BufferTooShort { needed, given };
    let words = words.get_mut(..needed).ok_or(too_short)?;

    let domain = machine.domain();
    let periodic = domain == Domain::Turn;
    if periodic {
        machine.check_repeats()?;
    }
    let knots = sample::<L>(machine, set, cells, scale, samples)?;
    let constants = constants::<S, L>(machine, set, scale, |column| {
        let samples = samples.get(column * rows..).and_then(|s| s.get(..knots));
        samples.unwrap_or_default()
    })?;
    let mut gains = [0u16; 5];
    for (column, role) in curves::roles(set) {
        let overflow = |cell| match role {
            // More cells cure it.
            Role::Reciprocal => Error::Table(TableError::Reciprocal { cell }),
            _ => Error::Overflow {
                base: base_name(role),
                cell,
            },
        };
        let samples = samples
            .get_mut(column * rows..)
            .and_then(|s| s.get_mut(..knots));
        let samples = samples.unwrap_or_default();
        let constant = constants.of(role);
        if constant != 0.0 {
            for sample in samples.iter_mut() {
                *sample -= constant;
            }
        }
        if role == Role::Coulomb {
            unfold(samples, periodic);
        }
        match (L::DEGREE, periodic) {
            (3, true) => fit_periodic(samples, control)?,
            (3, false) => fit_bounded(samples, control)?,
            (_, true) => fit_quadratic_periodic(samples, control)?,
            (_, false) => fit_quadratic_bounded(samples, control)?,
        }
        let gain = if L::HALVES {
            let gain = gain::<S>(role, control).ok_or(overflow(0))?;
            if let Some(slot) = gains.get_mut(role as usize) {
                *slot = gain;
            }
            f64::from(gain)
        } else {
            1.0
        };
        let halves = L::HALVES.then_some(column % 2 == 1);
        for part in 0..L::COLUMN {
            let mut points: Points<'_, S> = Points {
                words: &mut *words,
                role,
                first: if L::HALVES {
                    column / 2
                } else {
                    column * L::COLUMN + part
                },
                pitch: L::pitch(set),
                upper: halves,
                gain,
            };
            for row in 0..cells as usize + L::MORE_ROWS {
                let control = [0, 1, 2, 3].map(|k| control.get(row + k).copied().unwrap_or(0.0));
                let value = L::stored::<S>(control).get(part).copied().unwrap_or(0.0);
                let cell = row.min(cells as usize - 1) as u32;
                points.set(row, value).ok_or(overflow(cell))?;
            }
            if L::MORE_ROWS > 0 && role == Role::Inertia {
                points.round_together(control, periodic.then_some(cells as usize));
            }
        }
    }
    let constants = constants.words::<S>(gains)?;
    let table = Table::with_constants(words, constants, set, cells, periodic);
    table.map_err(|error| match error {
        TableError::Range { curve, cell } => Error::Overflow {
            base: curves::roles(set)
                .find(|(column, _)| *column == usize::from(curve))
                .map_or("torque", |(_, role)| base_name(role)),
            cell,
        },
        TableError::NoInertia { cell } => Error::NoInertia {
            phi: domain.position(f64::from(cell) / f64::from(cells)),
        },
        other => Error::Table(other),
    })
}

/// Samples of every curve of the set, in machine units, at the places that the layout's spline passes through; returns their
/// number. Samples of one curve lie side by side.
fn sample<L: Layout>(
    machine: &impl Reducible,
    set: u8,
    cells: u32,
    scale: &Scale,
    samples: &mut [f64],
) -> Result<usize, Error> {
    let domain = machine.domain();
    let rows = control_points(cells as usize);
    let ends = domain != Domain::Turn;
    let count = cells + u32::from(ends) * u32::from(4 - L::DEGREE);
    for k in 0..count {
        let knot = if L::DEGREE == 3 {
            f64::from(k)
        } else if ends {
            (f64::from(k) - 0.5).clamp(0.0, f64::from(cells))
        } else {
            f64::from(k) + 0.5
        };
        let phi = domain.position(knot / f64::from(cells));
        let point = machine.reduction(phi)?;
        for (column, role) in curves::roles(set) {
            if let Some(slot) = samples.get_mut(column * rows + k as usize) {
                *slot = machine_units(&point, role, scale);
            }
        }
    }
    // The seed of the reciprocal is that of the inertia in units of the power of two below the least.
    if let Some(column) = Role::Reciprocal.column(set) {
        let inertia = samples.get(..count as usize).unwrap_or_default();
        let least = inertia.iter().copied().fold(f64::INFINITY, f64::min);
        // A tenth below, for what a coarse curve overshoots.
        let unit = math::exp2(math::floor(math::log2(0.9 * least)));
        for k in 0..count as usize {
            let inertia = samples.get(k).copied().unwrap_or(1.0);
            if let Some(slot) = samples.get_mut(column * rows + k) {
                *slot = unit / inertia;
            }
        }
    }
    Ok(count as usize)
}

/// What a table has beside its curves, in machine units and rounded as it will be stored.
fn constants<'s, S: Scalar, L: Layout>(
    machine: &impl Reducible,
    set: u8,
    scale: &Scale,
    samples: impl Fn(usize) -> &'s [f64],
) -> Result<Constants<f64>, Error> {
    let start = machine.reduction(machine.domain().position(0.0))?;
    let stored = |role: Role, value: f64| -> Result<f64, Error> {
        let base = base_name(role);
        let word = S::word(role, value).ok_or(Error::Overflow { base, cell: 0 })?;
        Ok(S::exact(role, S::raw(word)))
    };
    let range = |column: usize| {
        samples(column)
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), j| {
                (least.min(*j), most.max(*j))
            })
    };
    // The middle of the range: every control point is then as small as it can be.
    let inertia = if L::OFFSET {
        0.5 * (range(0).0 + range(0).1)
    } else {
        0.0
    };
    // Beside a curve the least value: what is left of a magnitude is one, too.
    let constant = |bit: u8, role: Role| match role.column(set) {
        _ if set & bit == 0 => 0.0,
        Some(column) => range(column).0,
        None => machine_units(&start, role, scale),
    };
    Ok(Constants {
        inertia: stored(Role::Inertia, inertia)?,
        viscous: stored(
            Role::Viscous,
            constant(curves::CONSTANT_VISCOUS, Role::Viscous),
        )?,
        coulomb: stored(
            Role::Coulomb,
            constant(curves::CONSTANT_COULOMB, Role::Coulomb),
        )?,
        gains: [0.0; 5],
    })
}

/// The least whole number that brings all of a curve's points into 16 bits.
fn gain<S: Scalar>(role: Role, control: &[f64]) -> Option<u16> {
    // Sweeps of the rounding may move a point by a unit or two.
    const LARGEST: f64 = 32_760.0;
    let most = control
        .iter()
        .fold(0.0f64, |most, c| most.max(math::abs(*c)));
    let unit = S::exact(role, S::raw(S::whole(1)));
    let gain = math::floor(most / unit / LARGEST) + 1.0;
    (gain <= f64::from(u16::MAX)).then_some(gain as u16)
}

impl Constants<f64> {
    fn of(&self, role: Role) -> f64 {
        match role {
            Role::Inertia => self.inertia,
            Role::Viscous => self.viscous,
            Role::Coulomb => self.coulomb,
            Role::Load | Role::Reciprocal => 0.0,
        }
    }

    fn words<S: Scalar>(&self, gains: [u16; 5]) -> Result<Constants<S::Word>, Error> {
        let word = |role: Role| {
            let base = base_name(role);
            S::word(role, self.of(role)).ok_or(Error::Overflow { base, cell: 0 })
        };
        Ok(Constants {
            inertia: word(Role::Inertia)?,
            viscous: word(Role::Viscous)?,
            coulomb: word(Role::Coulomb)?,
            gains: gains.map(S::whole),
        })
    }
}

/// A curve at one position in machine units; that of the reciprocal follows from all of them.
fn machine_units(point: &Reduction, role: Role, scale: &Scale) -> f64 {
    let (torque, speed) = (f64::from(scale.torque()), f64::from(scale.speed()));
    match role {
        Role::Inertia => point.inertia[0] / f64::from(scale.inertia()),
        Role::Load => point.load_torque() / torque,
        Role::Viscous => point.viscous * speed / torque,
        Role::Coulomb => point.coulomb / torque,
        Role::Reciprocal => 0.0,
    }
}

/// The base to enlarge when a curve does not fit.
fn base_name(role: Role) -> &'static str {
    if role == Role::Inertia {
        "inertia"
    } else {
        "torque"
    }
}
