//! Setup of a run.

use std::cell::Cell;

use super::edges::Edges;
use super::{MOST_STEPS, Run};
use crate::simulate::coupled::CoupledMachines;
use crate::simulate::observe::{ControlStatistics, EffortSums, Observer};
use crate::simulate::watch::Watch;
use jred_file::model::simulation::Simulation;
use jred_file::number::numerics::dormand_prince::Accuracy;

impl<'a, P> Run<'a, P> {
    /// The initial state of a run.
    pub(super) fn new(
        plant: &'a P,
        machines: &CoupledMachines<'a>,
        simulation: &Simulation,
        observer: &'a mut dyn Observer,
    ) -> Self {
        let file = machines.first;
        Self {
            plant,
            file,
            accuracy: Accuracy {
                tolerance: simulation.tolerance,
                most_steps: MOST_STEPS,
            },
            watch: Watch::new(machines),
            stops: simulation.end_stops,
            ends: simulation.ends(file).map(|[from, to]| {
                // The end of a stroke may be exceeded by rounding.
                let slack = if simulation.end_stops.is_some() {
                    0.0
                } else {
                    1e-9 * (to - from)
                };
                [from - slack, to + slack]
            }),
            impacts: None,
            turned: None,
            begin: None,
            direction: 0.0,
            inside: [f64::NEG_INFINITY, f64::INFINITY],
            edges: Edges::of(machines),
            edge: f64::INFINITY,
            steps: Cell::new(0),
            halt: None,
            driven: None,
            rest: None,
            turned_back: None,
            stuck: None,
            controlling: ControlStatistics::default(),
            has_payloads: machines.guests().payloads,
            giving: EffortSums::default(),
            to_speed: simulation.to_speed,
            reached: None,
            held: None,
            observer,
        }
    }
}
