//! A machine with curves in closed form, as a model in any format.

use jred::number::Number;
use jred::table::{Format, MAX_CELLS};
use jred::{CurveSet, Domain, Model, Scale, curves};

use crate::support::machines::Wave;
use crate::support::rows::Rows;

pub(crate) const WAVE: Wave = Wave {
    mean: 1.0,
    swing: 0.25,
    load: 3.0,
    viscous: 0.1,
    coulomb: 0.5,
    domain: Domain::Turn,
};

/// Calls `with` with a model of the wave.
pub(crate) fn with_model<F: Format, const SET: CurveSet>(
    scale: Scale,
    with: impl FnOnce(Model<'_, F, SET>),
) {
    with_model_of(&WAVE, scale, with);
}

/// As `with_model`, of another wave.
pub(crate) fn with_model_of<F: Format, const SET: CurveSet>(
    wave: &Wave,
    scale: Scale,
    with: impl FnOnce(Model<'_, F, SET>),
) {
    let cells = 128;
    let scale = if F::WHOLE_FACTOR {
        scale.for_cells(cells, wave.domain.span())
    } else {
        scale
    };
    let rows = Rows::<F>::of(wave, SET, cells, &scale).unwrap();
    with(Model::new(rows.table()).unwrap());
}

/// A model with this range and these machine units, of a machine with constant inertia.
pub(crate) fn in_units<F: Format>(
    domain: Domain,
    scale: Scale,
) -> Model<'static, F, { curves::INERTIA }> {
    let [torque, speed, inertia] = [scale.torque(), scale.speed(), scale.inertia()].map(f64::from);
    // If the velocity torque must be an integer multiple of the slope per cell: the number of cells that makes it one.
    let a_cell = 0.5 / domain.span() * inertia * speed * speed / torque;
    let is_whole = |cells: &u32| {
        let factor = a_cell * f64::from(*cells);
        factor > 0.5 && (factor - factor.round()).abs() < 3e-7 * factor
    };
    let cells = if F::WHOLE_FACTOR {
        (8..=MAX_CELLS).find(is_whole).expect("a number of cells")
    } else {
        8
    };
    let wave = Wave {
        domain,
        ..Wave::bare(0.5 * inertia, 0.0)
    };
    let rows = Rows::<F>::of(&wave, curves::INERTIA, cells, &scale).unwrap();
    let rows: &'static Rows<F> = Box::leak(Box::new(rows));
    rows.model(&scale)
}

pub(crate) fn si<N: Number>(
    scale: &Scale,
    [omega, alpha]: [f64; 2],
) -> (N::Speed, N::Acceleration) {
    (
        scale.omega(omega as f32).value,
        scale.alpha(alpha as f32).value,
    )
}
