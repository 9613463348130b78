//! The machines of the study, exact, and what the controller does not know about them.

use std::path::Path;

use jred::Domain;
use jred::machine::{Machine, PoseError, Reducible, Reduction};
use jred_analysis::checked;
use jred_file::model::machine::MachineFile;
use jred_file::model::mechanism::AnyMechanism;
use jred_file::model::motion::Motion;
use jred_file::model::with_mass::AttachedMass;

use crate::Fault;

/// A machine file, and what may be fixed to a link of it.
#[derive(Clone, Copy)]
pub(crate) struct Case {
    pub(crate) name: &'static str,
    file: &'static str,
    /// Share of the signed process loads: 0 for an idle stroke.
    process: f64,
    /// A payload (kg): the link, and the place on it (m).
    pub(crate) payload: f64,
    on: (&'static str, [f64; 2]),
}

/// The idle stroke of a press, an arm that carries parts, and a cam with two dwells.
pub(crate) const CASES: [Case; 3] = [
    Case {
        name: "press",
        file: "press.toml",
        process: 0.0,
        payload: 5.0,
        on: ("slider", [0.0, 0.0]),
    },
    Case {
        name: "four-bar",
        file: "four-bar.toml",
        process: 1.0,
        payload: 0.5,
        on: ("rocker", [0.4, 0.0]),
    },
    Case {
        name: "cam",
        file: "cam-oscillating.toml",
        process: 1.0,
        payload: 0.5,
        on: ("follower", [0.1, 0.0]),
    },
];

/// Differences between the machine and the controller's model of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Deviation {
    /// Nothing.
    None,
    /// A factor of J, J′ and J″.
    Inertia(f64),
    /// A factor of viscous and Coulomb friction.
    Friction(f64),
    /// The payload of the case.
    Payload,
    /// The signed process loads, where the model has none.
    Process,
}

/// A machine at its drive link, with factors.
pub(crate) struct Altered {
    machine: Machine<AnyMechanism>,
    inertia: f64,
    friction: f64,
    process: f64,
}

impl Case {
    /// Whether its process loads are left out.
    pub(crate) fn is_idle(&self) -> bool {
        self.process == 0.0
    }

    /// Reads its machine file.
    pub(crate) fn read(&self) -> Result<MachineFile, Fault> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
        Ok(checked::read(&folder.join(self.file))?)
    }

    /// The machine with its drive train, as it really is.
    pub(crate) fn machine(
        &self,
        file: &MachineFile,
        deviation: Deviation,
    ) -> Result<Altered, Fault> {
        let mut file = file.clone();
        if deviation == Deviation::Payload {
            let (name, at) = self.on;
            let names = file.machine.mechanism().link_names();
            let link = names.iter().position(|link| link == name);
            let link = link.ok_or_else(|| format!("{} has no link {name:?}", self.file))?;
            let mass = AttachedMass {
                link,
                at,
                mass: self.payload,
                inertia: 0.0,
            };
            file.rebuild([&mass], [])?;
        }
        let whole = Altered {
            machine: file.with_drive_train()?,
            inertia: 1.0,
            friction: 1.0,
            process: self.process,
        };
        Ok(match deviation {
            Deviation::None | Deviation::Payload => whole,
            Deviation::Inertia(inertia) => Altered { inertia, ..whole },
            Deviation::Friction(friction) => Altered { friction, ..whole },
            Deviation::Process => Altered {
                process: 1.0,
                ..whole
            },
        })
    }
}

impl Reducible for Altered {
    fn domain(&self) -> Domain {
        self.machine.domain()
    }

    fn reduction(&self, phi: f64) -> Result<Reduction, PoseError> {
        let mut reduction = self.machine.reduction(phi)?;
        reduction.inertia *= self.inertia;
        reduction.inertia_slope *= self.inertia;
        reduction.inertia_curvature *= self.inertia;
        reduction.viscous *= self.friction;
        reduction.coulomb *= self.friction;
        reduction.process *= self.process;
        Ok(reduction)
    }

    fn edge(&self, k: usize) -> Option<f64> {
        self.machine.edge(k)
    }

    fn check_repeats(&self) -> Result<(), PoseError> {
        self.machine.check_repeats()
    }
}

/// The motion of a file at a pace: 1 is that of the file.
#[derive(Clone, Copy)]
pub(crate) struct Paced<'f> {
    pub(crate) motion: &'f Motion,
    pub(crate) pace: f64,
}

impl Paced<'_> {
    /// Duration of a cycle (s).
    pub(crate) fn duration(&self) -> f64 {
        self.motion.duration() / self.pace
    }

    /// [φ, ω, α] at a time; one cycle follows the other.
    pub(crate) fn at(&self, time: f64) -> [f64; 3] {
        let state = self
            .motion
            .at((time * self.pace).rem_euclid(self.motion.duration()));
        let pace = self.pace;
        [state.phi, state.omega * pace, state.alpha * pace * pace]
    }

    /// The largest speed and acceleration.
    pub(crate) fn extremes(&self) -> [f64; 2] {
        const PLACES: u32 = 2000;
        let times = (0..PLACES).map(|k| self.duration() * f64::from(k) / f64::from(PLACES));
        times.map(|time| self.at(time)).fold(
            [0.0; 2],
            |[speed, acceleration]: [f64; 2], [_, omega, alpha]| {
                [speed.max(omega.abs()), acceleration.max(alpha.abs())]
            },
        )
    }
}
