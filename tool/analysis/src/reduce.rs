//! `jred reduce`: the reduced link over a turn or a stroke, the motion of every point and link, the force in every joint,
//! and the drive torque of the motion.

use jred::error::Error;
use jred::machine::motion::State;
use jred::machine::{Frames, Machine, Mechanism as _};

use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::{MachineFile, Machines};
use jred_file::model::mechanism::AnyMechanism;
use jred_file::model::schedule::ScheduleInstant;
use jred_file::number::columns::{Column, ColumnQuantity, Columns};
use jred_file::number::rounding::position;

mod carriages;
mod curves;
mod energy;
mod largest;
mod points;
mod reactions;
mod rows;

pub use jred_file::model::axis::DrivePoint;
pub(crate) use largest::between_edges;
pub use largest::{Largest, largest};
pub use reactions::joints_with_force;
use rows::{RowMotion, row_at, rows, rows_at};
pub use rows::{not_contained, not_contained_at};

jred_file::words! {
    /// Variable that the rows run over.
    pub enum Over default Angle {
        /// Equal steps of the drive link's position over one turn or over its stroke.
        Angle = "angle",
        /// Equal time steps over the motion.
        Time = "time",
    }
}

/// Columns other than the position.
#[derive(Clone, Copy, Debug, Default)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each set is there or not, whatever the others"
)]
pub struct Sets {
    /// The reduced link and the motion's drive torque.
    pub curves: bool,
    /// Each link's share of J_red, with the curves.
    pub links: bool,
    /// The terms of the drive torque, which are also part of the curves.
    pub torques: bool,
    /// Points and links: positions, transfer functions, velocities and accelerations.
    pub points: bool,
    /// Forces by d'Alembert's principle.
    pub reactions: bool,
    /// Energies and generalised forces.
    pub energy: bool,
}

/// The request.
#[derive(Clone, Copy, Debug)]
pub struct Request {
    /// Variable that the rows run over.
    pub over: Over,
    /// Number of rows.
    pub positions: usize,
    /// The columns.
    pub sets: Sets,
    /// Speed and acceleration of the drive link at every position instead of those of the motion (rad/s, rad/s², or m/s,
    /// m/s²).
    pub state: Option<[f64; 2]>,
}

/// One row: the position of the machine, and its motion there, if known.
struct RowPose {
    now: ScheduleInstant,
    phi: f64,
    frames: Frames,
    state: Option<State<f64>>,
}

/// Data for the columns.
struct Source<'f> {
    file: &'f MachineFile,
    /// The machine with its drive train, without its schedule.
    machine: Machine<AnyMechanism>,
    /// The machines of the schedule.
    machines: Machines<'f>,
    coordinate: Coordinate,
}

impl<'f> Source<'f> {
    fn new(file: &'f MachineFile) -> Result<Self, Error> {
        Ok(Self {
            file,
            machine: file.with_drive_train()?,
            machines: Machines::of(file)?,
            coordinate: file.machine.mechanism().coordinate(),
        })
    }
}

/// The column of times.
fn time_column() -> Column {
    Column::new(ColumnQuantity::Time, "t", "s")
}

/// A set of columns.
trait Set {
    /// Their headers.
    fn heads(&self, source: &Source) -> Vec<Column>;

    /// Their values, one for each header.
    fn values(&self, source: &Source, place: &RowPose) -> Result<Vec<Option<f64>>, Error>;
}

/// The requested columns at every position.
///
/// # Errors
/// Errors of the machine.
pub fn reduce(file: &MachineFile, request: &Request) -> Result<Columns, Error> {
    let moves = file.motion.is_some() || request.state.is_some();
    let in_time = request.over == Over::Time || request.state.is_some();
    // Rows at given states have no time, so the position of a carriage is unknown.
    let of_motion = request.state.is_none();
    let kind = RowKind {
        moves,
        in_time,
        of_motion,
    };
    columns(file, request, kind, rows(file, request))
}

/// The requested columns at these positions, in their order. Without a given state they use that of the request, or of the motion if it passes each
/// position once.
///
/// # Errors
/// Errors of the machine.
pub fn reduce_at(
    file: &MachineFile,
    request: &Request,
    at: &[DrivePoint],
) -> Result<Columns, Error> {
    let given = at.iter().any(|at| at.state.is_some()) || request.state.is_some();
    let moves = file.motion.is_some() || given;
    let kind = RowKind {
        moves,
        in_time: given,
        of_motion: !given,
    };
    columns(file, request, kind, rows_at(file, request, at))
}

/// The state of the drive link in the rows.
#[derive(Clone, Copy)]
struct RowKind {
    /// Some rows have a motion.
    moves: bool,
    /// Some have velocities and accelerations in time.
    in_time: bool,
    /// The motion is that of the file.
    of_motion: bool,
}

/// The columns of these rows.
fn columns(
    file: &MachineFile,
    request: &Request,
    kind: RowKind,
    rows: impl Iterator<Item = RowMotion>,
) -> Result<Columns, Error> {
    let source = Source::new(file)?;
    let mut sets = sets(&source, request.sets, kind)?;
    if kind.of_motion && file.schedule.flows() {
        let shares = request.sets.curves && request.sets.links;
        sets.push(Box::new(carriages::Carriages { shares }));
    }
    let mut heads = match request.over {
        Over::Angle => vec![],
        Over::Time => vec![time_column()],
    };
    heads.push(source.coordinate.column());
    heads.extend(sets.iter().flat_map(|set| set.heads(&source)));
    let mut columns = Columns::new(heads);
    for row in rows {
        let mut cells: Vec<Option<f64>> = row.time.into_iter().map(Some).collect();
        cells.push(Some(position(source.coordinate.shown(row.phi))));
        cells.extend(values(&source, &sets, &row)?);
        columns.push(cells);
    }
    Ok(columns)
}

/// The requested sets.
fn sets(
    source: &Source,
    sets: Sets,
    RowKind { moves, in_time, .. }: RowKind,
) -> Result<Vec<Box<dyn Set>>, Error> {
    let Sets {
        curves,
        links,
        torques,
        points,
        reactions,
        energy,
    } = sets;
    let mut sets: Vec<Box<dyn Set>> = Vec::new();
    if curves {
        sets.push(Box::new(curves::CurveColumns { links, moves }));
    } else if moves {
        sets.push(Box::new(curves::MotionColumns));
    }
    if torques {
        sets.push(Box::new(curves::TorqueColumns { sum: !reactions }));
    }
    if points {
        sets.push(Box::new(points::Points { in_time }));
    }
    if reactions {
        sets.push(Box::new(reactions::Reactions::new(source)?));
    }
    if energy {
        sets.push(Box::new(energy::Energy));
    }
    Ok(sets)
}

/// The values of the sets in a row.
fn values(
    source: &Source,
    sets: &[Box<dyn Set>],
    row: &RowMotion,
) -> Result<Vec<Option<f64>>, Error> {
    let place = RowPose {
        now: row.now,
        phi: row.phi,
        frames: source.machine.mechanism().frames(row.phi)?,
        state: row.state,
    };
    let mut values = Vec::new();
    for set in sets {
        values.extend(set.values(source, &place)?);
    }
    Ok(values)
}

/// Adds the columns of these sets to rows of a motion, each with its instant and φ, ω and α of the drive link, under names with the given `prefix`.
///
/// # Errors
/// Errors of the machine.
pub fn add_columns(
    file: &MachineFile,
    columns: &Columns,
    states: &[(ScheduleInstant, [f64; 3])],
    asked: Sets,
    prefix: &str,
) -> Result<Columns, Error> {
    let source = Source::new(file)?;
    let kind = RowKind {
        moves: false,
        in_time: true,
        of_motion: true,
    };
    let sets = sets(&source, asked, kind)?;
    let heads = sets.iter().flat_map(|set| set.heads(&source));
    let heads = heads.map(|head| Column {
        part: format!("{prefix}{}", head.part),
        name: format!("{prefix}{}", head.name),
        ..head
    });
    let mut wider = Columns::new(columns.heads().iter().cloned().chain(heads));
    for (row, (now, [phi, omega, alpha])) in columns.rows().iter().zip(states) {
        let state = RowMotion {
            now: *now,
            ..row_at(*phi, Some([*omega, *alpha]), None)
        };
        let more = values(&source, &sets, &state)?;
        wider.push(row.iter().copied().chain(more));
    }
    Ok(wider)
}
