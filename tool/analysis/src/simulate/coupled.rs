//! Several machines on one shaft: the drive train of each begins at the motor.
//!
//! One degree of freedom is left, the drive link of the first machine; the others move in proportion:
//!
//! ```text
//! φ_k = φ_k,0 + r_k·(φ − φ_0),   r_k = i_1/i_k          i_k: ratio of each drive train
//! T = Σ train_k(J_k·α_k + ½·J_k′·ω_k² − load_k)          at the motor's shaft, each train with its own direction of power
//! J = Σ J_k·r_k²                                         at the first drive link
//! ```

use std::f64::consts::TAU;

use jred::Domain;
use jred::machine::Reducible as _;

use super::{NotBeside, SimulationError};
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;
use jred_file::model::schedule::Schedule;
use jred_file::model::simulation::{Shaft, Simulation};

/// Tolerance within which a number of turns is whole: some rounding errors.
const TURNS_TOLERANCE: f64 = 1e-9;

/// A machine whose drive link moves in proportion to that of the first one: φ_k = offset + ratio·φ.
#[derive(Clone, Copy, Debug)]
pub struct GearedMachine<'a> {
    /// The machine.
    pub file: &'a MachineFile,
    offset: f64,
    ratio: f64,
}

impl<'a> GearedMachine<'a> {
    /// The first machine.
    pub const fn first(file: &'a MachineFile) -> Self {
        Self {
            file,
            offset: 0.0,
            ratio: 1.0,
        }
    }

    /// Position, speed and acceleration, from the values of the first drive link.
    pub fn state(&self, [phi, omega, alpha]: [f64; 3]) -> [f64; 3] {
        [
            self.offset + self.ratio * phi,
            self.ratio * omega,
            self.ratio * alpha,
        ]
    }

    /// Speed per speed of the first drive link.
    pub const fn ratio(&self) -> f64 {
        self.ratio
    }

    /// Positions of the first drive link at which this machine is not smooth: all within `turns` turns, each up to a number of turns.
    pub(crate) fn edges(&self, turns: u32) -> impl Iterator<Item = f64> + use<'a> {
        let Self {
            file,
            offset,
            ratio,
        } = *self;
        let turns = (f64::from(turns) * ratio.abs()).round().max(1.0) as u32;
        let edges = (0..).map_while(|k| file.machine.edge(k));
        edges.flat_map(move |edge| {
            (0..turns).map(move |k| (edge + TAU * f64::from(k) - offset) / ratio)
        })
    }
}

/// Whether machines have payloads, and moving carriages.
#[derive(Clone, Copy, Debug)]
pub(super) struct Guests {
    pub(super) payloads: bool,
    pub(super) carriages: bool,
}

impl Guests {
    pub(super) const fn any(self) -> bool {
        self.payloads || self.carriages
    }
}

/// Machines on one shaft.
#[derive(Clone, Debug)]
pub struct CoupledMachines<'a> {
    /// The machine whose drive link is the coordinate.
    pub first: &'a MachineFile,
    beside: Vec<GearedMachine<'a>>,
}

impl<'a> CoupledMachines<'a> {
    /// A machine alone.
    pub const fn alone(first: &'a MachineFile) -> Self {
        Self {
            first,
            beside: Vec::new(),
        }
    }

    /// Adds further machines, each with the position (rad) of its drive link at the start of the simulation.
    ///
    /// # Errors
    /// A machine that cannot run with others.
    pub fn with(
        mut self,
        others: impl IntoIterator<Item = (&'a MachineFile, f64)>,
        simulation: &Simulation,
    ) -> Result<Self, SimulationError> {
        for (file, start) in others {
            let refused = |why| {
                let title = file.title.clone();
                Err(SimulationError::NotBeside { title, why })
            };
            if simulation.at == Shaft::DriveLink {
                return refused(NotBeside::MotorAtDriveLink);
            }
            if slides(self.first) != slides(file) {
                return refused(NotBeside::TurnsAndSlides);
            }
            if file.variator.is_some() || self.first.variator.is_some() {
                return refused(NotBeside::Variator);
            }
            if let Domain::Stroke { .. } = file.machine.domain() {
                return refused(NotBeside::Stroke);
            }
            let ratio = self.first.drive_train.ratio() / file.drive_train.ratio();
            self.beside.push(GearedMachine {
                file,
                offset: start - ratio * simulation.start_angle,
                ratio,
            });
        }
        Ok(self)
    }

    /// The same machines with another first one, which differs only in its inertia.
    #[must_use]
    pub fn with_first<'b>(&self, first: &'b MachineFile) -> CoupledMachines<'b>
    where
        'a: 'b,
    {
        CoupledMachines {
            first,
            beside: self.beside.clone(),
        }
    }

    /// The titles of all.
    pub fn title(&self) -> String {
        let titles: Vec<&str> = self.all().map(|m| m.file.title.as_str()).collect();
        titles.join(" + ")
    }

    /// For example `, on one shaft with Feeder and Conveyor`; empty for a single machine.
    pub fn beside_in_words(&self) -> String {
        let beside = self.beside.iter().map(|m| m.file.title.as_str());
        let beside: Vec<&str> = beside.collect();
        if beside.is_empty() {
            return String::new();
        }
        format!(", on one shaft with {}", beside.join(" and "))
    }

    /// The kinds of masses that come, go or move by themselves.
    pub(super) fn guests(&self) -> Guests {
        let has = |such: fn(&Schedule) -> bool| {
            let mut all = self.all();
            all.any(|machine| such(&machine.file.schedule))
        };
        Guests {
            payloads: has(|schedule| !schedule.payloads().is_empty()),
            carriages: has(Schedule::flows),
        }
    }

    /// Whether all machines are in the same position after a turn of the first drive link.
    pub(super) fn go_by_turns(&self) -> bool {
        let whole =
            |ratio: f64| (ratio - ratio.round()).abs() <= TURNS_TOLERANCE * (1.0 + ratio.abs());
        self.all()
            .all(|machine| machine.file.machine.domain() == Domain::Turn && whole(machine.ratio()))
    }

    /// The machines besides the first.
    pub fn beside(&self) -> &[GearedMachine<'a>] {
        &self.beside
    }

    /// All machines.
    pub fn all(&self) -> impl Iterator<Item = GearedMachine<'a>> + '_ {
        std::iter::once(GearedMachine::first(self.first)).chain(self.beside.iter().copied())
    }
}

/// Whether the drive train begins at a sliding drive link, without stages.
fn slides(file: &MachineFile) -> bool {
    let coordinate = file.machine.mechanism().coordinate();
    coordinate == Coordinate::Length && file.drive_train.stages().is_empty()
}
