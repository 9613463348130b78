//! The commands: read, compute, write.

pub mod bus;
mod core_error;
pub mod fastest;
pub mod ratio;
pub mod retime;
pub mod sensitivity;
pub mod size;
pub mod split;
pub mod steady;
mod suited;
pub mod tolerance;
pub mod vary;

use std::path::Path;

use miette::{Result, miette};

use crate::busy;
use crate::commands::core_error::core_report;
use crate::options;
use crate::output;
use jred::Reducible as _;
use jred_machine::analysis::contact::OneWay;
use jred_machine::analysis::duty::Duty;
use jred_machine::analysis::inspect::Findings;
use jred_machine::analysis::reduce;
use jred_machine::analysis::reduce::{Over, Sets, reduce};
use jred_machine::analysis::simulate;
use jred_machine::export::{Choice, Export, Failure, Form, LayoutChoice, Number, Task};
use jred_machine::model::machine::MachineFile;
use jred_machine::model::variator;
use jred_machine::plain;
use jred_machine::read;
use jred_report::list;
use jred_report::list::alternatives;
use jred_report::list::inspection;
use jred_report::page;
use jred_report::table::output as sheet;
use jred_report::table::output::Format;

/// How a command ended without an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Done {
    /// Every requirement is satisfied.
    Holds,
    /// The answer is no: a rule is violated by every drive, or a torque error is not reached.
    Violated,
    /// Interrupted by the user.
    Stopped,
}

/// Runs a command.
///
/// # Errors
/// Bad input, or a file that cannot be written.
pub fn run(command: &options::Command) -> Result<Done> {
    busy::begin(doing(command));
    let done = dispatch(command);
    busy::end();
    done
}

fn dispatch(command: &options::Command) -> Result<Done> {
    match command {
        options::Command::Reduce(options) => run_reduce(options),
        options::Command::Check(options) => run_check(options),
        options::Command::Size(options) => size::size(options),
        options::Command::Vary(options) => vary::vary(options),
        options::Command::Ratio(options) => ratio::ratio(options),
        options::Command::Sensitivity(options) => sensitivity::sensitivity(options),
        options::Command::Tolerance(options) => tolerance::tolerance(options),
        options::Command::Merge(options) => vary::run_merge(options),
        options::Command::Bus(options) => bus::run(options),
        options::Command::Simulate(options) => run_simulate(options),
        options::Command::Steady(options) => steady::steady(options),
        options::Command::Fastest(options) => fastest::fastest(options),
        options::Command::Retime(options) => retime::retime(options),
        options::Command::Export(options) => run_export(options),
        options::Command::Rules(options) => print(&list::rule_list::show(
            options.set.as_deref(),
            Path::new(""),
            options.format,
        )?),
        options::Command::Split(options) => print(&split::run(options)?),
    }
}

/// What a command does, for those who wait.
const fn doing(command: &options::Command) -> &'static str {
    use options::Command;
    match command {
        Command::Reduce(_) => "reducing the machine",
        Command::Check(_) => "checking the machine",
        Command::Size(_) => "checking drives",
        Command::Vary(_) | Command::Tolerance(_) => "reading machine and catalogue",
        Command::Ratio(_) => "seeking ratios",
        Command::Sensitivity(_) => "changing each quantity",
        Command::Merge(_) => "merging rows",
        Command::Bus(_) => "following the DC bus",
        Command::Simulate(_) => "following the motion",
        Command::Steady(_) => "seeking the steady cycle",
        Command::Fastest(_) => "seeking the fastest motion",
        Command::Retime(_) => "seeking the gentlest motion",
        Command::Export(_) => "seeking the smallest table",
        Command::Rules(_) => "reading rules",
        Command::Split(_) => "dividing the ratio",
    }
}

fn run_reduce(options: &options::Reduce) -> Result<Done> {
    let file = read::read(&options.file)?;
    output::check([("--report", &options.report)])?;
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
    if let Some(path) = &options.report {
        let name = plain::path(&options.file);
        let page = page::mechanism_page(&name, &file, state).map_err(core_report)?;
        output::write(path, page.as_bytes())?;
    }
    let missing = match &at {
        Some(at) => reduce::not_contained_at(&file, &request, at),
        None => reduce::not_contained(&file, &request),
    };
    if !missing.is_empty() && !matches!(options.format, Format::Table) {
        let missing = missing.join("; ");
        output::say(&format!(
            "warning: {NOT_CONTAINED}{missing}: use --over time"
        ));
    }
    let passed = !(moves && columns.has_empty_cells());
    let title = reduce_title(&file, sets, (passed, at.is_some()), &missing);
    match options.format {
        Format::Table => {
            let mut text = String::new();
            if !largest.is_empty() {
                let sentences: Vec<String> =
                    largest.iter().map(reduce::Largest::sentence).collect();
                text += "largest: ";
                text += &sentences.join("; ");
                text += "\n";
            }
            if let Some(path) = &options.report {
                text += "report written to ";
                text += &plain::path(path);
                text += "\n";
            }
            print_parts(sheet::parts(&columns, Format::Table, &title).chain([text]))
        }
        Format::Json if sets.reactions => {
            let mut after = serde_json::Map::new();
            after.insert("title".into(), title.into());
            after.insert("largest".into(), serde_json::json!(largest));
            print_parts(sheet::json_parts(&columns, serde_json::Map::new(), after))
        }
        Format::Csv | Format::Json => print_parts(sheet::parts(&columns, options.format, &title)),
    }
}

/// What goes by the motion, and is not in rows without it.
const NOT_CONTAINED: &str = "not contained where no motion passes: ";

/// The lines above a listing: what it is, and what is not in it, because the motion does not pass every position, or at single positions
/// because they have no time.
fn reduce_title(
    file: &MachineFile,
    sets: Sets,
    (passed, single): (bool, bool),
    missing: &[String],
) -> String {
    let mut title = if sets.curves {
        format!(
            "{}: reduced to the drive link, flywheel and drive train included",
            file.title
        )
    } else {
        file.title.clone()
    };
    if sets.reactions {
        title += "\nforce of a joint: acts from the first on the second body listed by `jred check`; flywheel and \
                  drive train turn with the drive link";
    }
    if !passed {
        title += if single {
            "\nthe motion does not pass every position exactly once: give speeds with the positions"
        } else {
            "\nthe motion does not pass every position exactly once: use --over time"
        };
    }
    if !missing.is_empty() {
        title += "\n";
        title += NOT_CONTAINED;
        title += &missing.join("; ");
        title += ": use --over time";
    }
    title
}

/// Most numbers that are held at once: 320 MB.
const MOST_NUMBERS: usize = 20_000_000;

/// Refuses more numbers than are held.
fn check_size(file: &MachineFile, request: &reduce::Request) -> Result<()> {
    let two = reduce::Request {
        positions: 2,
        ..*request
    };
    // A machine that cannot take these positions is refused where it cannot take one of its own.
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

/// Warns on standard error if a contact separates at this speed and acceleration; the result is computed nevertheless.
fn warn(file: &MachineFile, state: [f64; 2]) -> Result<()> {
    if let Some(words) = OneWay::warning(&file.machine, state).map_err(core_report)? {
        output::say(&words);
    }
    Ok(())
}

/// Speed and acceleration of the command line.
fn state(options: &options::Reduce, file: &MachineFile) -> Result<Option<[f64; 2]>> {
    let Some(speed) = &options.speed else {
        return Ok(None);
    };
    let coordinate = file.machine.mechanism().coordinate();
    let refused = |name: &str, text: &str, why: &str| {
        miette!("--{name} {} cannot be used: {why}", plain::quoted(text))
    };
    let omega =
        read::drive_speed(speed, coordinate).map_err(|why| refused("speed", speed, &why))?;
    let alpha = match &options.accel {
        Some(accel) => read::drive_acceleration(accel, coordinate)
            .map_err(|why| refused("accel", accel, &why))?,
        None => 0.0,
    };
    Ok(Some([omega, alpha]))
}

/// The positions of the command line, and their states.
fn states(options: &options::Reduce, file: &MachineFile) -> Result<Option<Vec<reduce::At>>> {
    let Some(text) = &options.at else {
        return Ok(None);
    };
    let domain = file.machine.domain();
    let states = read::drive_states(text, domain, file.machine.mechanism().coordinate());
    let states = states.map_err(|why| {
        miette!(
            help = "write positions with commas between them, such as \"30 deg, 60 deg\", each with its speed and acceleration, if you like: \"30 deg, 60 rpm, 5 rad/s^2, 60 deg, 90 rpm\"",
            "--at {} cannot be used: {why}",
            plain::quoted(text)
        )
    })?;
    Ok(Some(states))
}

fn run_check(options: &options::Check) -> Result<Done> {
    let file = read::read(&options.file)?;
    let findings = Findings::of(&file).map_err(core_report)?;
    match options.format {
        inspection::Format::Table => print(&inspection::text(&findings))?,
        inspection::Format::Json => print(&format!("{:#}\n", inspection::json(&findings)))?,
    };
    Ok(if findings.holds() {
        Done::Holds
    } else {
        Done::Violated
    })
}

fn run_simulate(options: &options::Simulate) -> Result<Done> {
    let file = read::read(&options.file)?;
    output::check([("--plot", &options.plot)])?;
    let simulation = file.simulation.as_ref().ok_or_else(|| {
        miette!(
            help = "add a [simulation] with start_angle, duration, output_step and torque; docs/machine-file.md shows how",
            "{} has no [simulation]",
            plain::path(&options.file)
        )
    })?;
    let found = simulate::simulate(&file, simulation)?;
    if let Some(path) = &options.plot {
        let page = page::simulation_page(&file, simulation, &found.columns);
        output::write(path, page.as_bytes())?;
    }
    let done = print_parts(list::simulation::write(
        &file,
        simulation,
        &found,
        options.format,
    ))?;
    // The rows up to there are written before the reason is.
    found.ended.map_or(Ok(done), |error| Err(error.into()))
}

/// Where the pieces of the table meet; nowhere without `--pieces`.
fn edges(options: &options::Export, file: &MachineFile) -> Result<Vec<f64>> {
    let edges = match options.pieces.as_deref() {
        None => return Ok(Vec::new()),
        Some("auto") => (0..).map_while(|k| file.machine.edge(k)).collect(),
        Some(list) => {
            let coordinate = file.machine.mechanism().coordinate();
            read::drive_positions(list, file.machine.domain(), coordinate).map_err(|why| {
                miette!(
                    help = "write positions with a comma between them, such as \"60 deg, 75 deg\", or auto",
                    "--pieces {list:?} cannot be used: {why}"
                )
            })?
        }
    };
    if edges.is_empty() {
        return Err(miette!(
            help =
                "name the positions, for example --pieces \"60 deg, 75 deg\", or remove --pieces",
            "{} has no load with between, no disc cam and no Geneva drive, so there are no edges for --pieces auto",
            plain::path(&options.file)
        ));
    }
    Ok(edges)
}

fn run_export(options: &options::Export) -> Result<Done> {
    let file = read::read(&options.file)?;
    output::check([("--out", &options.out)])?;
    variator::refuse(&file, "export")?;
    let reciprocal = match options.reciprocal {
        Choice::Auto => options.forward && options.number != Number::F32,
        Choice::Yes => true,
        Choice::No => false,
    };
    if reciprocal && options.number == Number::F32 {
        return Err(miette!(
            help = "remove --reciprocal, or use --type i32",
            "f32 tables have no curve of 1/J: in floating point, the tick divides"
        ));
    }
    let layouts = options.number.layouts();
    if !layouts.iter().any(|layout| options.layout.allows(*layout)) {
        let names: Vec<&str> = layouts.iter().map(|layout| layout.name()).collect();
        return Err(miette!(
            help = format!("remove --layout, or use one of: {}", names.join(", ")),
            "{} tables have no layout {}",
            options.number.name(),
            options.layout.name()
        ));
    }
    let whole = match options.layout {
        LayoutChoice::Harmonic => Some("harmonics describe"),
        LayoutChoice::SliderCrank => Some("a closed form describes"),
        _ => None,
    };
    if let (Some(whole), true) = (whole, options.pieces.is_some()) {
        return Err(miette!(
            help = "remove --pieces, or take another --layout",
            "{whole} a whole turn, not a piece of one"
        ));
    }
    let coordinate = file.machine.mechanism().coordinate();
    let quantity = |name: &str, text: &Option<String>, read: read::Reader| {
        let value = text.as_deref().map(|text| {
            read(text, coordinate)
                .map_err(|why| miette!("--{name} {} cannot be used: {why}", plain::quoted(text)))
        });
        value.transpose()
    };
    let torque_error = quantity("torque-error", &options.torque_error, read::drive_effort)?;
    let omega = quantity("omega", &options.omega, read::largest_speed)?;
    let alpha = quantity("alpha", &options.alpha, read::largest_acceleration)?;
    let (omega, alpha) = range([omega, alpha], &file)?;
    let task = Task {
        number: options.number,
        layout: options.layout,
        forward: options.forward,
        reciprocal,
        torque_error,
        max_bytes: options.max_bytes,
        max_cells: options.max_cells,
        omega,
        alpha,
        rotor: options.rotor_inertia.unwrap_or(0.0),
        edges: edges(options, &file)?,
        machine: options.machine_id,
    };
    let export = match Export::new(&file, task) {
        Ok(export) => export,
        Err(Failure::NotReached(why)) => {
            output::say(&why);
            return Ok(Done::Violated);
        }
        Err(Failure::Impossible { message, help }) => {
            return Err(miette!(help = help, "{message}"));
        }
        Err(Failure::Machine(error)) => return Err(core_report(error)),
    };
    if let Some(out) = &options.out {
        let bytes = export.write(options.format).ok_or_else(|| {
            miette!(
                help = "use --format rust, c or json",
                "one image cannot hold the tables of several pieces"
            )
        })?;
        output::write(out, &bytes)?;
    }
    warn(&file, [omega, 0.0])?;
    match (&options.out, options.format) {
        (None, Form::Json) => print(&format!("{:#}\n", export.json())),
        (None, _) => print(&format!(
            "{}\n{}nothing written: use --out to write a file\n",
            export.summary(),
            alternatives::alternatives(&export)
        )),
        (Some(out), _) => print(&format!(
            "{}\n{}written to {}\n",
            export.summary(),
            alternatives::alternatives(&export),
            plain::path(out)
        )),
    }
}

/// Largest speed and acceleration: as given, else those of the motion. Where there is no acceleration, at constant speed or
/// without a motion, the speed reached within a radian stands in.
fn range(given: [Option<f64>; 2], file: &MachineFile) -> Result<(f64, f64)> {
    match (given, &file.motion) {
        ([Some(omega), Some(alpha)], _) => return Ok((omega, alpha)),
        ([Some(omega), None], None) => return Ok((omega, omega * omega)),
        _ => {}
    }
    let motion = file.motion_or("the table needs a largest speed: give --omega, or ")?;
    let duty = Duty::new(file, motion, jred_machine::analysis::duty::STEPS).map_err(core_report)?;
    let [omega, alpha] = given;
    let omega = omega.unwrap_or(duty.figures(|i| i.omega).peak());
    let moved = duty.figures(|i| i.alpha).peak();
    let own = if moved > 0.0 { moved } else { omega * omega };
    Ok((omega, alpha.unwrap_or(own)))
}

/// Prints to stdout.
pub(crate) fn print(text: &str) -> Result<Done> {
    output::print(text).map(|()| Done::Holds)
}

/// Prints a text in parts.
fn print_parts(parts: impl IntoIterator<Item = String>) -> Result<Done> {
    output::print_parts(parts)?;
    Ok(Done::Holds)
}
