//! The rows of a motion in time.

use crate::number::columns::{Column, Quantity};

/// What is written about a state, without the time and the columns of energies.
pub(in crate::analysis) struct Row {
    pub(in crate::analysis) figures: Vec<f64>,
    /// (J)
    pub(in crate::analysis) kinetic: f64,
    /// (J)
    pub(in crate::analysis) potential: f64,
}

/// What has been done since the start (J).
#[derive(Clone, Copy)]
pub(in crate::analysis) struct Works {
    pub(in crate::analysis) motor: f64,
    /// Of the brake at the motor's shaft, negative; `None`: there is none.
    pub(in crate::analysis) brake: Option<f64>,
    pub(in crate::analysis) process: f64,
    pub(in crate::analysis) losses: f64,
}

/// The columns of a motion: the time, the `figures` of a [`Row`], energies and their balance.
pub(in crate::analysis) fn heads(
    figures: Vec<Column>,
    has_brake: bool,
) -> impl Iterator<Item = Column> {
    let energies = [
        Some("kinetic energy"),
        Some("potential energy"),
        Some("motor work"),
        has_brake.then_some("brake work"),
        Some("process work"),
        Some("losses"),
    ];
    let energies = energies.into_iter().flatten();
    let energies = energies.map(|name| Column::new(Quantity::Energy, name, "J"));
    let balance = Column::new(Quantity::EnergyBalance, "energy balance", "J");
    let time = std::iter::once(Column::new(Quantity::Time, "t", "s"));
    time.chain(figures).chain(energies).chain([balance])
}

/// A row of these columns at the time `t`, with what has been done since a start with the energy `start`; and the balance.
pub(in crate::analysis) fn cells(
    t: f64,
    row: Row,
    works: Works,
    start: f64,
) -> (impl Iterator<Item = f64>, f64) {
    let Works {
        motor,
        brake,
        process,
        losses,
    } = works;
    let given = motor + brake.unwrap_or(0.0) + process;
    let balance = row.kinetic + row.potential - start - given + losses;
    let before = [row.kinetic, row.potential, motor].into_iter().chain(brake);
    let energies = before.chain([process, losses, balance]);
    let cells = std::iter::once(t).chain(row.figures).chain(energies);
    (cells, balance)
}
