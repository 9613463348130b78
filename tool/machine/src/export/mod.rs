//! `jred export`: the smallest table that meets a torque error, or the best one for its bytes, as an image or as source code, with a comparison of
//! other number types and layouts.

mod c_source;
mod candidate;
mod choice;
mod cost;
pub mod data;
mod fault;
mod figures;
mod form;
mod harmonic;
mod name;
mod pieces;
mod place;
mod plan;
mod proof;
mod reference;
mod search;
mod size;
mod slider_crank;
mod ticks;
mod ways;

pub use c_source::plan_c_source;
pub use candidate::{Answer, Candidate, Made};
pub use choice::{Choice, LayoutChoice, LayoutName, Number};
pub use cost::Core;
pub use form::Form;
pub use name::Name;
pub use plan::plan_source;
pub use proof::Proven;
pub use search::EXHAUSTIVE;
pub use ticks::Ticks;

use crc::{CRC_32_ISO_HDLC, Crc};
use jred::error::Error;
use jred::image::identify;
use jred::machine::{Machine, Reducible as _};
use jred::{Domain, Phase};

use crate::model::by_motion::ByMotion;
use crate::model::coordinate::Coordinate;
use crate::model::machine::MachineFile;
use crate::model::mechanism::AnyMechanism;
use crate::number::rounding::short;
use fault::NotReached;
use pieces::Searches;
use search::Goal;
use ways::BothWays;

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
    fn whole_machine(&self, file: &MachineFile) -> Result<Machine<AnyMechanism>, Error> {
        let ratio = file.drive_train.ratio();
        let machine = file.with_drive_train()?;
        Ok(machine.with_flywheel(self.rotor * ratio * ratio)?)
    }
}

/// Smallest piece as a share of the range: [`Pieces`](jred::Pieces) accepts no shorter one.
const SHORTEST: f64 = 1.0 / 65_536.0;

/// Most cells of all pieces together: their tables of every type and layout take 130 MB.
const MOST_CELLS: usize = 1 << 19;

/// A table ready to be written, and the results of the other types and layouts.
#[derive(Clone, Debug)]
pub struct Export {
    title: String,
    /// Whether the drive link turns or slides.
    pub coordinate: Coordinate,
    domain: Domain,
    /// Whether the range is cut; a turn with one edge has one piece, which begins there.
    in_pieces: bool,
    task: Task,
    /// Identifier of the machine.
    machine: u32,
    /// Branches of the drive train, whose losses and friction are in no table.
    branches: Vec<String>,
    /// Whether loads depend on the direction of travel.
    by_direction: bool,
    /// Size of every number type and layout.
    pub answers: Vec<(Number, LayoutName, Answer)>,
    /// Index of the chosen one.
    pub chosen: usize,
}

/// Why there is no table.
#[derive(Clone, Debug)]
pub enum Failure {
    /// The machine cannot be tabulated.
    Machine(Error),
    /// No table meets the torque error: the obstacle and the cure.
    NotReached(String),
    /// The request is impossible: too few bytes, or a piece that is too short.
    Impossible {
        /// Message.
        message: String,
        /// Cure.
        help: String,
    },
}

impl<E: Into<Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        Self::Machine(error.into())
    }
}

/// Refuses loads that depend on the motion.
fn check_timeless(file: &MachineFile) -> Result<(), Failure> {
    if let Some(ByMotion { what, cure }) = file.not_by_direction().next() {
        return Err(Failure::Impossible {
            message: format!(
                "{what}: that goes by [motion], and a table is over the position of the drive link alone"
            ),
            help: format!(
                "{cure}, for this command, and give the firmware what acts in one part of the motion as a torque of its own; a payload that \
                 comes and goes is a table each"
            ),
        });
    }
    Ok(())
}

impl Export {
    /// Searches for the requested table and its alternatives.
    ///
    /// # Errors
    /// The machine cannot be tabulated, or no table meets the request.
    pub fn new(file: &MachineFile, task: Task) -> Result<Self, Failure> {
        Self::found(file, task, false)
    }

    /// The same; `provable` excludes layouts that only `auto` would choose and that cannot be proven.
    fn found(file: &MachineFile, task: Task, provable: bool) -> Result<Self, Failure> {
        check_timeless(file)?;
        let machine = BothWays::new(file, &task)?;
        let coordinate = file.machine.mechanism().coordinate();
        let goal = Goal {
            torque_error: task.torque_error,
            range: [task.omega, task.alpha],
            max_cells: task.max_cells,
            max_bytes: task.max_bytes.map(|most| most as usize),
            reciprocal: task.reciprocal,
        };
        let domain = machine.domain();
        let pieces = pieces::between(domain, &task.edges);
        if let Some([from, to]) = pieces
            .iter()
            .find(|[from, to]| to - from < SHORTEST * domain.span() * (1.0 - 1e-9))
        {
            return Err(Failure::Impossible {
                message: format!(
                    "the piece from {} to {} is shorter than {} {}, 1/65536 of the range",
                    coordinate.place(*from),
                    coordinate.place(*to),
                    short(coordinate.shown(SHORTEST * domain.span())),
                    coordinate.unit()
                ),
                help: "make the load's ramp longer, or name positions that are farther apart with --pieces"
                    .to_owned(),
            });
        }
        if pieces.len() * task.max_cells as usize > MOST_CELLS {
            return Err(Failure::Impossible {
                message: format!(
                    "{} pieces of up to {} cells are too many cells; at most {MOST_CELLS}",
                    pieces.len(),
                    task.max_cells
                ),
                help: format!("use --max-cells {} or fewer", MOST_CELLS / pieces.len()),
            });
        }
        // A closed form covers the whole turn.
        let crank = slider_crank::plain(machine.same());
        if let (LayoutChoice::SliderCrank, Err(why)) = (task.layout, &crank) {
            return Err(why.failure(file));
        }
        let left_out = provable && task.layout == LayoutChoice::Auto;
        let crank = crank.ok().filter(|_| pieces.is_empty() && !left_out);
        let search = Searches::new(&machine, crank, &pieces, goal)?;
        let mut answers = Vec::new();
        for number in Number::ALL {
            for &layout in number.layouts() {
                // Harmonics are only searched on request.
                if layout == LayoutName::Harmonic && task.layout != LayoutChoice::Harmonic {
                    continue;
                }
                if layout == LayoutName::SliderCrank && search.crank.is_none() {
                    continue;
                }
                answers.push((number, layout, number.search(layout, &search)?));
            }
        }
        let Some(chosen) = choose(&task, &answers) else {
            return Err(NotReached {
                file,
                coordinate,
                task: &task,
                search: &search,
                answers: &answers,
            }
            .failure()?);
        };
        let id = task.machine.unwrap_or_else(|| identifier(&file.title));
        let tables = answers
            .iter_mut()
            .filter_map(|(_, _, answer)| match answer {
                Answer::Meets(candidate) => Some(&mut candidate.tables),
                _ => None,
            });
        for table in tables.flatten() {
            identify(&mut table.words, id).map_err(ticks::refusal)?;
        }
        Ok(Self {
            title: file.title.clone(),
            coordinate,
            domain,
            in_pieces: !pieces.is_empty(),
            task,
            machine: id,
            branches: (file.drive_train.branches().iter())
                .map(|branch| branch.name.clone())
                .collect(),
            by_direction: machine.same().is_none(),
            answers,
            chosen,
        })
    }

    /// The core that it was chosen for.
    pub const fn core(&self) -> Core {
        self.task.core
    }

    /// The chosen table.
    ///
    /// # Panics
    /// Never: the chosen answer is a table.
    pub fn chosen(&self) -> &Candidate {
        let answer = self.answers.get(self.chosen).map(|(_, _, answer)| answer);
        match answer {
            Some(Answer::Meets(candidate)) => candidate,
            _ => unreachable!("only what meets the request is chosen"),
        }
    }

    /// The table, if it covers the whole range.
    fn whole(&self) -> Option<&Made> {
        let table = self.chosen().tables.first();
        table.filter(|_| !self.in_pieces)
    }

    /// The phase at which a table's range begins.
    pub fn start(&self, table: &Made) -> Phase {
        self.domain.phase(table.range[0])
    }

    /// The largest drive link speed of the request.
    pub const fn omega(&self) -> f64 {
        self.task.omega
    }
}

/// The identifier of a machine with this title: its CRC-32, as in the image. Machines without a title have no identifier.
pub fn identifier(title: &str) -> u32 {
    Crc::<u32>::new(&CRC_32_ISO_HDLC).checksum(title.as_bytes())
}

/// The fastest table that meets the error: of those with up to a tenth more instructions than the fastest on the core, the one with the fewest bytes.
/// With a limit of bytes, the fewest bytes; without a required error, the least error. Of equal ones, the more accurate.
fn choose(task: &Task, answers: &[(Number, LayoutName, Answer)]) -> Option<usize> {
    let own = answers.iter().enumerate().filter_map(|(k, answer)| {
        let (number, layout, Answer::Meets(candidate)) = answer else {
            return None;
        };
        let asked = *number == task.number && task.layout.allows(*layout);
        let cost = task.core.instructions(*number, *layout);
        asked.then(|| (k, candidate, cost.unwrap_or(u32::MAX)))
    });
    let own: Vec<_> = own.collect();
    let by_cost = task.torque_error.is_some() && task.max_bytes.is_none();
    let fastest = own.iter().map(|(.., cost)| *cost).min()?;
    let fast = own
        .iter()
        .filter(|(.., cost)| !by_cost || *cost <= cost::as_fast(fastest));
    let rank = |candidate: &Candidate| {
        let bytes = match task.torque_error {
            Some(_) => candidate.bytes(),
            None => 0,
        };
        (bytes, candidate.error())
    };
    fast.map(|(k, candidate, _)| (k, rank(candidate)))
        .min_by(|(_, a), (_, b)| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)))
        .map(|(k, _)| *k)
}
