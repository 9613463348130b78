//! The rows of a motion in time.

use jred_file::number::columns::{Column, ColumnQuantity};

/// The output for a state, without time and energy columns.
pub(crate) struct OutputRow {
    pub(crate) figures: Vec<f64>,
    /// ½·J·ω² (J).
    pub(crate) kinetic: f64,
    /// Kinetic energy of carriages along their guides, not in `kinetic` (J).
    pub(crate) beyond: f64,
    /// Potential energy (J).
    pub(crate) potential: f64,
}

/// Works since the start (J).
#[derive(Clone, Copy)]
pub(crate) struct Works {
    pub(crate) motor: f64,
    /// Work of the brake at the motor's shaft, negative; `None` without a brake.
    pub(crate) brake: Option<f64>,
    /// Kinetic and potential energy brought by payloads, less the energy that they have taken away; `None` without payloads.
    pub(crate) payloads: Option<f64>,
    /// Work of the axes that move carriages along their guides.
    pub(crate) carriages: Option<f64>,
    pub(crate) process: f64,
    pub(crate) losses: f64,
}

/// Optional terms of the balance.
#[derive(Clone, Copy, Default)]
pub(crate) struct Terms {
    pub(crate) brake: bool,
    pub(crate) payloads: bool,
    pub(crate) carriages: bool,
}

/// The columns of a motion: the time, the `figures` of an [`OutputRow`], energies and their balance.
pub(crate) fn heads(figures: Vec<Column>, terms: Terms) -> impl Iterator<Item = Column> {
    let energies = [
        Some("kinetic energy"),
        Some("potential energy"),
        Some("motor work"),
        terms.brake.then_some("brake work"),
        terms.payloads.then_some("payload energy"),
        terms.carriages.then_some("carriage work"),
        Some("process work"),
        Some("losses"),
    ];
    let energies = energies.into_iter().flatten();
    let energies = energies.map(|name| Column::new(ColumnQuantity::Energy, name, "J"));
    let balance = Column::new(ColumnQuantity::EnergyBalance, "energy balance", "J");
    let time = std::iter::once(Column::new(ColumnQuantity::Time, "t", "s"));
    time.chain(figures).chain(energies).chain([balance])
}

/// A row of these columns at the time `t`, with the works since a start with the energy `start`; and the balance.
pub(crate) fn cells(
    t: f64,
    row: OutputRow,
    works: Works,
    start: f64,
) -> (impl Iterator<Item = f64>, f64) {
    let Works {
        motor,
        brake,
        payloads,
        carriages,
        process,
        losses,
    } = works;
    let some = [brake, payloads, carriages].into_iter().flatten();
    let given = motor + some.clone().sum::<f64>() + process;
    let kinetic = row.kinetic + row.beyond;
    let balance = kinetic + row.potential - start - given + losses;
    let before = [kinetic, row.potential, motor].into_iter().chain(some);
    let energies = before.chain([process, losses, balance]);
    let cells = std::iter::once(t).chain(row.figures).chain(energies);
    (cells, balance)
}
