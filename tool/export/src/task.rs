//! The request, and why it is rejected.

use jred::error::Error;
use jred::machine::Machine;

use crate::choice::{LayoutChoice, Number};
use crate::cost::Core;
use crate::fault::{Alternative, BestFit, NotReached};
use crate::slider_crank::NoClosedForm;
use jred_file::model::by_motion::ByMotion;
use jred_file::model::machine::MachineFile;
use jred_file::model::mechanism::AnyMechanism;

/// The request. At least one of torque error and bytes is given; bytes only without edges.
#[derive(Clone, Debug)]
pub struct Task {
    /// Number type.
    pub number: Number,
    /// Layout.
    pub layout: LayoutChoice,
    /// The core that the firmware runs on: of the layouts that meet the error, one with the fewest instructions there is chosen.
    pub core: Core,
    /// Whether the firmware also needs accelerations.
    pub forward: bool,
    /// Whether fixed-point tables get the curve of 1/J.
    pub reciprocal: bool,
    /// Largest error of the drive torque (N·m, or N); without it, the least possible one.
    pub torque_error: Option<f64>,
    /// Most bytes of the image.
    pub max_bytes: Option<u32>,
    /// Largest number of cells to try.
    pub max_cells: u32,
    /// Largest speed (rad/s, or m/s).
    pub omega: f64,
    /// Largest acceleration (rad/s², or m/s²).
    pub alpha: f64,
    /// Inertia of rotor and gearbox at the input of the drive train (kg·m²).
    pub rotor: f64,
    /// Borders of pieces with a table each (rad, or m); empty for one table of the whole range.
    pub edges: Vec<f64>,
    /// Identifier of the machine in the image; if not given, derived from the title.
    pub machine: Option<u32>,
}

impl Task {
    /// The machine with its drive train and with the rotor.
    pub(crate) fn whole_machine(&self, file: &MachineFile) -> Result<Machine<AnyMechanism>, Error> {
        let ratio = file.drive_train.ratio();
        let machine = file.with_drive_train()?;
        Ok(machine.with_flywheel(self.rotor * ratio * ratio)?)
    }
}

/// Why there is no table.
#[derive(Clone, Debug)]
pub enum Failure {
    /// The machine cannot be tabulated.
    Machine(Error),
    /// No table meets the torque error.
    NotReached(NotReached),
    /// The request is impossible.
    Impossible(Impossible),
}

/// Why a request is impossible.
#[derive(Clone, Debug)]
pub enum Impossible {
    /// A part of the machine depends on the motion.
    ByMotion(ByMotion),
    /// Viscous friction depends on the direction of travel.
    ViscousByDirection {
        /// The position (rad, or m).
        at: f64,
    },
    /// Loads by direction drive the motion.
    DrivingLoads {
        /// The position (rad, or m).
        at: f64,
        /// How much less they take forwards than backwards, together with friction (N·m, or N).
        excess: f64,
    },
    /// The closed form does not hold the machine.
    NoClosedForm(NoClosedForm),
    /// A piece is too short.
    ShortPiece {
        /// Its ends (rad, or m).
        range: [f64; 2],
        /// The shortest possible one (rad, or m).
        shortest: f64,
    },
    /// The pieces have too many cells together.
    TooManyCells {
        /// Number of pieces.
        pieces: usize,
        /// Most cells of all pieces together.
        most: usize,
    },
    /// The pieces have no common machine units.
    PieceUnits,
    /// No table fits into the bytes.
    DoesNotFit {
        /// The most accurate table that fits, but does not meet the torque error.
        best: Option<BestFit>,
        /// Bytes of the smallest image.
        smallest: Option<usize>,
        /// Tables of other layouts and types that meet the request.
        alternatives: Vec<Alternative>,
    },
}

impl<E: Into<Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        Self::Machine(error.into())
    }
}
