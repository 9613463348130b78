//! The search for the requested table, and its result.

use crc::{CRC_32_ISO_HDLC, Crc};
use jred::image::identify;
use jred::machine::Reducible as _;
use jred::{Domain, Phase};

use crate::candidate::{Candidate, RangeTable, SearchResult};
use crate::choice::{LayoutChoice, LayoutName, Number};
use crate::cost;
use crate::directions::MachineByDirection;
use crate::failure::{Failure, Impossible};
use crate::fault::SearchFailure;
use crate::pieces::{self, Searches};
use crate::search::TableRequirements;
use crate::slider_crank;
use crate::task::Task;
use crate::ticks;
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;

/// Smallest piece as a share of the range: [`Pieces`](jred::Pieces) accepts no shorter one.
const SHORTEST: f64 = 1.0 / 65_536.0;

/// Most cells of all pieces together: their tables of every type and layout take 130 MB.
const MOST_CELLS: usize = 1 << 19;

/// A table ready to be written, and the results of the other types and layouts.
#[derive(Clone, Debug)]
pub struct Export {
    /// Title of the machine.
    pub title: String,
    /// Whether the drive link turns or slides.
    pub coordinate: Coordinate,
    pub(crate) domain: Domain,
    /// Whether the range is cut; a turn with one edge has one piece, which begins there.
    pub(crate) in_pieces: bool,
    /// The request.
    pub task: Task,
    /// Identifier of the machine.
    pub machine: u32,
    /// Branches of the drive train, whose losses and friction are in no table.
    pub branches: Vec<String>,
    /// Whether loads depend on the direction of travel.
    pub by_direction: bool,
    /// Size of every number type and layout.
    pub answers: Vec<(Number, LayoutName, SearchResult)>,
    /// Index of the chosen one.
    pub chosen: usize,
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
    pub(crate) fn found(file: &MachineFile, task: Task, provable: bool) -> Result<Self, Failure> {
        if let Some(part) = file.not_by_direction().next() {
            return Err(Failure::Impossible(Impossible::ByMotion(part)));
        }
        let machine = MachineByDirection::new(file, &task)?;
        let coordinate = file.machine.mechanism().coordinate();
        let goal = TableRequirements {
            torque_error: task.torque_error,
            range: [task.omega, task.alpha],
            max_cells: task.max_cells,
            max_bytes: task.max_bytes.map(|most| most as usize),
            reciprocal: task.reciprocal,
        };
        let domain = machine.domain();
        let pieces = pieces::between(domain, &task.edges);
        let shortest = SHORTEST * domain.span();
        if let Some(&range) = pieces
            .iter()
            .find(|[from, to]| to - from < shortest * (1.0 - 1e-9))
        {
            return Err(Failure::Impossible(Impossible::ShortPiece {
                range,
                shortest,
            }));
        }
        if pieces.len() * task.max_cells as usize > MOST_CELLS {
            return Err(Failure::Impossible(Impossible::TooManyCells {
                pieces: pieces.len(),
                most: MOST_CELLS,
            }));
        }
        // A closed form covers the whole turn.
        let crank = slider_crank::plain(machine.same());
        if let (LayoutChoice::SliderCrank, Err(why)) = (task.layout, &crank) {
            return Err(Failure::Impossible(Impossible::NoClosedForm(why.clone())));
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
                answers.push((number, layout, search.answer(number, layout)?));
            }
        }
        let Some(chosen) = choose(&task, &answers) else {
            return Err(SearchFailure {
                file,
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
                SearchResult::Meets(candidate) => Some(&mut candidate.tables),
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

    /// The chosen table.
    ///
    /// # Panics
    /// Never: the chosen answer is a table.
    pub fn chosen(&self) -> &Candidate {
        let answer = self.answers.get(self.chosen).map(|(_, _, answer)| answer);
        match answer {
            Some(SearchResult::Meets(candidate)) => candidate,
            _ => unreachable!("only what meets the request is chosen"),
        }
    }

    /// The number type and layout that were chosen.
    pub fn kind(&self) -> (Number, LayoutName) {
        let chosen = self.chosen();
        (chosen.number, chosen.layout)
    }

    /// The table, if it covers the whole range.
    pub fn whole(&self) -> Option<&RangeTable> {
        let table = self.chosen().tables.first();
        table.filter(|_| !self.in_pieces)
    }

    /// The phase at which a table's range begins.
    pub fn start(&self, table: &RangeTable) -> Phase {
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
fn choose(task: &Task, answers: &[(Number, LayoutName, SearchResult)]) -> Option<usize> {
    let own = answers.iter().enumerate().filter_map(|(k, answer)| {
        let (number, layout, SearchResult::Meets(candidate)) = answer else {
            return None;
        };
        let cost = task.core.instructions(*number, *layout);
        (task.asks(*number, *layout)).then(|| (k, candidate, cost.unwrap_or(u32::MAX)))
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
