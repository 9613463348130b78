//! The loop, run for every machine, way, pace and deviation.

use jred::Phase;
use jred::axis::MotionState;
use jred_file::model::machine::MachineFile;

use crate::Fault;
use crate::closed_loop::{COUNTS, Cascade, Figures, LEAD, Plant, Seen, Stepped, TICK, run};
use crate::feed_forward::{Ahead, Known, Way, mean_inertia};
use crate::machine::{Altered, Case, Deviation, Paced};
use crate::plant::Integrated;

/// Paces of the motion, as shares of that of the file.
pub(crate) const PACES: [f64; 4] = [0.5, 0.75, 1.0, 1.25];

/// The fastest pace, which the tables are made for.
pub(crate) const FASTEST: f64 = 1.4;

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

/// A run: the machine, its pace, and how it is simulated.
#[derive(Clone, Copy)]
pub(crate) struct Run {
    pub(crate) pace: f64,
    pub(crate) deviation: Deviation,
    /// Counts of the encoder in a turn of the drive link.
    pub(crate) counts: u32,
    /// Whether the machine moves in fixed steps, as on a Cortex-M.
    pub(crate) stepped: bool,
}

impl Run {
    /// As the controller knows the machine, at the pace of its file.
    pub(crate) const NOMINAL: Self = Self {
        pace: 1.0,
        deviation: Deviation::None,
        counts: COUNTS,
        stepped: false,
    };

    pub(crate) const fn at(pace: f64) -> Self {
        Self {
            pace,
            ..Self::NOMINAL
        }
    }

    pub(crate) const fn with(deviation: Deviation) -> Self {
        Self {
            deviation,
            ..Self::NOMINAL
        }
    }
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

    /// Figures of runs with a way to feed forward.
    pub(crate) fn found(&self, way: Way, runs: &[Run]) -> Result<Vec<Found>, Fault> {
        self.with(way, |ahead| {
            let runs = runs.iter().map(|run| {
                let mut figures = Figures::default();
                self.observe(ahead, *run, |_, seen| figures.add(seen))?;
                Ok(Found {
                    feedback: figures.mean_square().sqrt(),
                    error: f64::from(figures.error),
                })
            });
            runs.collect()
        })
    }

    /// Does something with a way to feed forward.
    pub(crate) fn with<T>(
        &self,
        way: Way,
        act: impl FnOnce(Ahead) -> Result<T, Fault>,
    ) -> Result<T, Fault> {
        let fastest = self.paced(FASTEST)?.extremes();
        Known::new(&self.model, self.paced(1.0)?, fastest)?.with(way, act)?
    }

    /// Observes the last cycle of a run; times are from its start (s).
    pub(crate) fn observe(
        &self,
        ahead: Ahead,
        run: Run,
        mut observe: impl FnMut(f64, Seen),
    ) -> Result<(), Fault> {
        let motion = self.paced(run.pace)?;
        let machine = self.case.machine(self.file, run.deviation)?;
        let cycle = (motion.duration() / f64::from(TICK)).round() as u32;
        let first = (CYCLES - 1) * cycle;
        let observe = |tick: u32, seen: Seen| {
            if tick >= first {
                observe(f64::from(tick - first) * f64::from(TICK), seen);
            }
        };
        let [start, ..] = motion.at(0.0);
        let controller = Cascade::new(mean_inertia(&self.model)?, run.counts, start)?;
        let ticks = CYCLES * cycle;
        if run.stepped {
            let plant = Stepped::new(&machine, start)?;
            follow(plant, controller, motion, ticks, ahead, observe)
        } else {
            let plant = Integrated::new(&machine, start);
            follow(plant, controller, motion, ticks, ahead, observe)
        }
    }
}

/// Runs a machine through a motion.
fn follow<P: Plant<Error: Into<Fault>>>(
    mut plant: P,
    mut controller: Cascade,
    motion: Paced,
    ticks: u32,
    ahead: Ahead,
    observe: impl FnMut(u32, Seen),
) -> Result<(), Fault> {
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
