//! The rows of a motion in time.

use crate::number::columns::{Column, Quantity};

/// What is written about a state, without the time and the columns of energies.
pub(in crate::analysis) struct Row {
    pub(in crate::analysis) figures: Vec<f64>,
    /// ½·J·ω² (J).
    pub(in crate::analysis) kinetic: f64,
    /// Kinetic energy beyond that: of carriages along their guides (J).
    pub(in crate::analysis) beyond: f64,
    /// (J)
    pub(in crate::analysis) potential: f64,
}

/// What has been done since the start (J).
#[derive(Clone, Copy)]
pub(in crate::analysis) struct Works {
    pub(in crate::analysis) motor: f64,
    /// Of the brake at the motor's shaft, negative; `None`: there is none.
    pub(in crate::analysis) brake: Option<f64>,
    /// Kinetic and potential energy that payloads have brought, less what they have taken away; `None`: there are none.
    pub(in crate::analysis) payloads: Option<f64>,
    /// Of the axes that move carriages along their guides.
    pub(in crate::analysis) carriages: Option<f64>,
    pub(in crate::analysis) process: f64,
    pub(in crate::analysis) losses: f64,
}

/// Which of the terms of the balance there are that not every machine has.
#[derive(Clone, Copy, Default)]
pub(in crate::analysis) struct Terms {
    pub(in crate::analysis) brake: bool,
    pub(in crate::analysis) payloads: bool,
    pub(in crate::analysis) carriages: bool,
}

/// The columns of a motion: the time, the `figures` of a [`Row`], energies and their balance.
pub(in crate::analysis) fn heads(
    figures: Vec<Column>,
    terms: Terms,
) -> impl Iterator<Item = Column> {
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
