//! `jred reduce`: the reduced link, its parts and the forces.

use miette::{Result, miette};

use crate::commands::core_error::core_report;
use crate::commands::{Completion, documents, quantity, warn};
use crate::options;
use crate::output;
use crate::terminal;
use jred::machine::Reducible as _;
use jred_analysis::checked;
use jred_analysis::reduce;
use jred_analysis::reduce::{Over, Sets, reduce};
use jred_file::argument::{self, Argument};
use jred_file::model::axis::Axis;
use jred_file::model::machine::MachineFile;
use jred_file::model::variator;
use jred_file::plain;
use jred_file::read;
use jred_file::text::key::{ACCELERATIONS, SPEED};
use jred_report::list::{self, reduction::not_contained};
use jred_report::page;
use jred_report::table::output::Format;

/// Runs the command.
///
/// # Errors
/// Bad input, or a file that cannot be written.
pub(super) fn run(options: &options::Reduce) -> Result<Completion> {
    let file = checked::read(&options.file)?;
    output::check(options.documents.files())?;
    variator::refuse(&file, "reduce")?;
    if options.over == Over::Time {
        if options.speed.is_some() {
            return Err(miette!(
                help = "use either --over time or --speed",
                "with --over time, the motion of the machine file gives the speed"
            ));
        }
        file.required_motion()?;
    }
    let state = state(options, &file)?;
    let at = states(options, &file)?;
    let given = at.iter().flatten().any(|at| at.state.is_some());
    let moves = file.motion.is_some() || state.is_some() || given;
    if (options.reactions || options.energy) && !moves {
        let instead = "forces and energies need a speed: give one, for example --speed \"60 rpm\" (\"0 rpm\" for a machine at rest), or ";
        file.motion_or(instead)?;
    }
    let sets = Sets {
        torques: false,
        curves: !(options.points || options.reactions || options.energy),
        links: options.links,
        points: options.points,
        reactions: options.reactions,
        energy: options.energy,
    };
    let request = reduce::Request {
        over: options.over,
        positions: options.positions as usize,
        sets,
        state,
    };
    check_size(&file, &request)?;
    let largest = if sets.reactions && at.is_none() {
        reduce::largest(&file, &request).map_err(core_report)?
    } else {
        Vec::new()
    };
    let columns = match &at {
        Some(at) => reduce::reduce_at(&file, &request, at),
        None => reduce(&file, &request),
    };
    let columns = columns.map_err(core_report)?;
    if let Some(state) = state {
        warn(&file, state)?;
    }
    let missing = match &at {
        Some(at) => reduce::not_contained_at(&file, &request, at),
        None => reduce::not_contained(&file, &request),
    };
    if !missing.is_empty() && !matches!(options.format, Format::Table) {
        terminal::say(&format!("warning: {}", not_contained(&missing)));
    }
    // At a change point the joint forces are missing; time, position and speed are not.
    let cells = if sets.reactions { 3 } else { usize::MAX };
    let passed = !(moves && columns.has_empty_cells(cells));
    let view = list::reduction::ReductionView {
        file: &file,
        sets,
        columns: &columns,
        largest: &largest,
        passed,
        is_at_positions: at.is_some(),
        not_contained: &missing,
    };
    let answer = view.answer();
    let page = || {
        let name = read::name(&options.file);
        page::mechanism_page(&name, &file, state).map_err(core_report)
    };
    documents::finish(&options.documents, answer, page, options.format)
}

/// Largest number of values in memory: 320 MB.
const MOST_NUMBERS: usize = 20_000_000;

/// Refuses requests for more values.
fn check_size(file: &MachineFile, request: &reduce::Request) -> Result<()> {
    let two = reduce::Request {
        positions: 2,
        ..*request
    };
    // A machine that fails at these two positions reports its error later.
    let Ok(columns) = reduce(file, &two) else {
        return Ok(());
    };
    let columns = columns.heads().len();
    let most = MOST_NUMBERS / columns.max(1);
    if request.positions <= most {
        return Ok(());
    }
    Err(miette!(
        help = format!("use --positions {most} or fewer"),
        "{} positions of {columns} columns are too many numbers; at most {MOST_NUMBERS}",
        request.positions
    ))
}

/// Speed and acceleration of the command line.
fn state(options: &options::Reduce, file: &MachineFile) -> Result<Option<[f64; 2]>> {
    let coordinate = file.machine.mechanism().coordinate();
    let given = |name: &str, text: &Option<String>, kinds| {
        quantity(name, text.as_deref(), Argument::any(kinds), coordinate)
    };
    let Some(omega) = given("speed", &options.speed, SPEED)? else {
        return Ok(None);
    };
    let alpha = given("accel", &options.accel, ACCELERATIONS)?;
    Ok(Some([omega, alpha.unwrap_or(0.0)]))
}

/// The positions of the command line with their states.
fn states(
    options: &options::Reduce,
    file: &MachineFile,
) -> Result<Option<Vec<reduce::DrivePoint>>> {
    let Some(text) = &options.at else {
        return Ok(None);
    };
    let domain = file.machine.domain();
    let drive = Axis::of_drive(file.machine.mechanism().coordinate());
    let states = argument::drive_states(text, domain, [&drive, &file.axis()]);
    let states = states.map_err(|why| {
        miette!(
            help = "write positions with commas between them, such as \"30 deg, 60 deg\", each with its speed and acceleration, if you like: \"30 deg, 60 rpm, 5 rad/s^2, 60 deg, 90 rpm\"",
            "--at {} cannot be used: {why}",
            plain::quoted(text)
        )
    })?;
    Ok(Some(states))
}
