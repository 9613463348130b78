//! The loop, run for every machine, way, pace and deviation.

use jred::Phase;
use jred::axis::MotionState;
use jred_file::model::machine::MachineFile;

use crate::Fault;
use crate::closed_loop::{Cascade, Figures, LEAD, Plant, Seen, Stepped, TICK, run};
use crate::feed_forward::{Ahead, Known, Way};
use crate::machine::{Altered, Case, Deviation, Paced};
use crate::plant::Integrated;

/// Paces of the motion, as shares of that of the file.
pub(crate) const PACES: [f64; 4] = [0.5, 0.75, 1.0, 1.25];

/// Cycles that are run; the last one is measured.
const CYCLES: u32 = 3;

/// A case with what its controller knows.
pub(crate) struct Bench<'f> {
    case: Case,
    file: &'f MachineFile,
    /// The machine as the controller knows it.
    model: Altered,
}

/// Results of a run.
#[derive(Clone, Copy)]
pub(crate) struct Found {
    /// RMS of the feedback torque (N·m).
    pub(crate) feedback: f64,
    /// Largest following error (rad).
    pub(crate) error: f64,
}

/// Which integrator moves the machine.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Solver {
    DormandPrince,
    Stepped,
}

impl<'f> Bench<'f> {
    pub(crate) fn new(case: Case, file: &'f MachineFile) -> Result<Self, Fault> {
        let model = case.machine(file, Deviation::None)?;
        Ok(Self { case, file, model })
    }

    /// The motion at a pace.
    fn paced(&self, pace: f64) -> Result<Paced<'f>, Fault> {
        let motion = self.file.required_motion()?;
        Ok(Paced { motion, pace })
    }

    /// Figures of a way at a pace, for a machine that deviates.
    pub(crate) fn found(
        &self,
        way: Way,
        pace: f64,
        deviation: Deviation,
        solver: Solver,
    ) -> Result<Found, Fault> {
        let mut figures = Figures::default();
        self.observe(way, pace, deviation, solver, |_, seen| figures.add(seen))?;
        Ok(Found {
            feedback: figures.mean_square().sqrt(),
            error: f64::from(figures.error),
        })
    }

    /// Observes the last cycle of a run; times are from its start (s).
    pub(crate) fn observe(
        &self,
        way: Way,
        pace: f64,
        deviation: Deviation,
        solver: Solver,
        mut observe: impl FnMut(f64, Seen),
    ) -> Result<(), Fault> {
        let motion = self.paced(pace)?;
        let fastest = self.paced(PACES.into_iter().fold(pace, f64::max))?;
        let known = Known::new(&self.model, self.paced(1.0)?, fastest.extremes())?;
        let machine = self.case.machine(self.file, deviation)?;
        let cycle = (motion.duration() / f64::from(TICK)).round() as u32;
        let first = (CYCLES - 1) * cycle;
        let observe = |tick: u32, seen: Seen| {
            if tick >= first {
                observe(f64::from(tick - first) * f64::from(TICK), seen);
            }
        };
        let [start, ..] = motion.at(0.0);
        let inertia = known.mean_inertia();
        known.with(way, |ahead| match solver {
            Solver::DormandPrince => {
                let plant = Integrated::new(&machine, start);
                follow(plant, motion, inertia, CYCLES * cycle, ahead, observe)
            }
            Solver::Stepped => {
                let plant = Stepped::new(&machine, start)?;
                follow(plant, motion, inertia, CYCLES * cycle, ahead, observe)
            }
        })?
    }
}

/// Runs a machine through a motion.
fn follow<P: Plant<Error: Into<Fault>>>(
    mut plant: P,
    motion: Paced,
    inertia: f32,
    ticks: u32,
    ahead: Ahead,
    observe: impl FnMut(u32, Seen),
) -> Result<(), Fault> {
    let mut controller = Cascade::new(inertia, plant.phi())?;
    let at = |time: f64| {
        let [phi, omega, alpha] = motion.at(time);
        MotionState {
            phase: Phase::from_radians(phi),
            omega: omega as f32,
            alpha: alpha as f32,
        }
    };
    let wanted = |tick: u32| {
        let time = f64::from(tick) * f64::from(TICK);
        [at(time), at(time + f64::from(LEAD))]
    };
    run(&mut plant, &mut controller, ticks, wanted, ahead, observe).map_err(Into::into)
}
