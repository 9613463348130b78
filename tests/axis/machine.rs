//! A machine whose curves can be written down, as a model in any format.

use jred::number::Number;
use jred::table::Format;
use jred::{Domain, Model, Scale, Set};

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
pub(crate) fn with_model<F: Format, const SET: Set>(
    scale: Scale,
    with: impl FnOnce(Model<'_, F, SET>),
) {
    with_model_of(&WAVE, scale, with);
}

/// As `with_model`, of another wave.
pub(crate) fn with_model_of<F: Format, const SET: Set>(
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

pub(crate) fn si<N: Number>(scale: &Scale, [omega, alpha]: [f64; 2]) -> [N; 2] {
    [
        scale.omega(omega as f32).value,
        scale.alpha(alpha as f32).value,
    ]
}
