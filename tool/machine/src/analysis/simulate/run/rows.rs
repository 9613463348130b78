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

/// The columns of a motion: the time, the `figures` of a [`Row`], energies and their balance.
pub(in crate::analysis) fn heads(figures: Vec<Column>) -> impl Iterator<Item = Column> {
    let energies = [
        "kinetic energy",
        "potential energy",
        "motor work",
        "process work",
        "losses",
    ]
    .map(|name| Column::new(Quantity::Energy, name, "J"));
    let balance = Column::new(Quantity::EnergyBalance, "energy balance", "J");
    let time = std::iter::once(Column::new(Quantity::Time, "t", "s"));
    time.chain(figures).chain(energies).chain([balance])
}

/// A row of these columns at the time `t`, with the work of the motor, of the process loads, and the losses since a start with
/// the energy `start`; and the balance.
pub(in crate::analysis) fn cells(
    t: f64,
    row: Row,
    [motor, process, losses]: [f64; 3],
    start: f64,
) -> (impl Iterator<Item = f64>, f64) {
    let balance = row.kinetic + row.potential - start - motor - process + losses;
    let energies = [row.kinetic, row.potential, motor, process, losses, balance];
    let cells = std::iter::once(t).chain(row.figures).chain(energies);
    (cells, balance)
}
