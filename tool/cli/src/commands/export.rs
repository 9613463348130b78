//! `jred export`: the table for the firmware.

mod cia402;

use miette::{Result, miette};

use crate::busy;
use crate::commands::core_error::{core_report, duty_report};
use crate::commands::{Completion, print_answer, quantity, read_warned, warn};
use crate::options;
use crate::output;
use crate::terminal;
use jred::machine::Reducible as _;
use jred_analysis::duty::Duty;
use jred_export::{
    BLOCK_NAMES, Choice, Export, Failure, LayoutChoice, Name, Number, OutputForm, Task,
};
use jred_file::argument::{self, Argument};
use jred_file::model::axis::Axis;
use jred_file::model::machine::MachineFile;
use jred_file::model::variator;
use jred_file::plain;
use jred_file::read;
use jred_file::text::key::{ACCELERATIONS, EFFORT, SPEED};
use jred_report::list;
use jred_report::table::output::Format;
use jred_report::table::screen::Screen;

/// Positions where the pieces of the table meet; empty without `--pieces`.
fn edges(options: &options::export::Export, file: &MachineFile) -> Result<Vec<f64>> {
    let edges = match options.pieces.as_deref() {
        None => return Ok(Vec::new()),
        Some("auto") => (0..).map_while(|k| file.machine.edge(k)).collect(),
        Some(list) => {
            let drive = Axis::of_drive(file.machine.mechanism().coordinate());
            argument::drive_positions(list, file.machine.domain(), [&drive; 2]).map_err(|why| {
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
            read::name(&options.file)
        ));
    }
    Ok(edges)
}

/// The name of the table in a program, if one is given.
fn name(options: &options::export::Export) -> Result<Option<Name>> {
    let Some(text) = &options.name else {
        return Ok(None);
    };
    let checked = match options.format {
        OutputForm::C | OutputForm::Rust => Name::new(text),
        OutputForm::St | OutputForm::Plcopen => Name::for_plc(text, &BLOCK_NAMES),
        OutputForm::Image | OutputForm::Json | OutputForm::Cia402 => {
            return Err(miette!(
                help = "remove --name, or use --format c, rust, st or plcopen",
                "--name applies to source code; --format {} has no names",
                options.format
            ));
        }
    };
    let name = checked.map_err(|(why, other)| {
        miette!(
            help = format!("use --name {}", other.as_str()),
            "--name {} cannot be used: {why}",
            plain::quoted(text)
        )
    })?;
    Ok(Some(name))
}

/// The requested layout. A PLC evaluates splines only, in double precision.
fn layout(options: &options::export::Export) -> Result<LayoutChoice> {
    if !matches!(options.format, OutputForm::St | OutputForm::Plcopen) {
        return Ok(options.layout);
    }
    let format = options.format;
    let refused = match (options.number, options.layout, &options.pieces) {
        (_, _, Some(_)) => "--pieces",
        (Number::I32 | Number::I16, _, _) => "--type",
        (Number::F32, LayoutChoice::Auto | LayoutChoice::Spline, None) => {
            return Ok(LayoutChoice::Spline);
        }
        (Number::F32, _, None) => "--layout",
    };
    Err(miette!(
        help = format!("remove {refused}"),
        "--format {format} has one spline table, in LREAL: {refused} cannot change that"
    ))
}

/// Whether the table has a curve of 1/J; refuses options that do not go together.
fn reciprocal(options: &options::export::Export) -> Result<bool> {
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
            "{whole} a whole turn only, without pieces"
        ));
    }
    Ok(reciprocal)
}

/// Runs the command.
///
/// # Errors
/// Bad input, or a file that cannot be written.
pub(super) fn run(options: &options::export::Export) -> Result<Completion> {
    let file = read_warned(&options.file)?;
    output::check([("--out", &options.out)])?;
    let name = name(options)?;
    if options.format == OutputForm::Cia402 {
        return cia402::run(options, &file);
    }
    let of_drive = [
        ("--rated-torque", options.rated_torque.is_some()),
        ("--drive", options.drive.is_some()),
    ];
    let of_drive = of_drive
        .into_iter()
        .filter_map(|(name, given)| given.then_some(name));
    if let Some(name) = of_drive.chain(options.catalogue.given()).next() {
        return Err(miette!(
            help = format!("remove {name}, or use --format cia402"),
            "{name} applies to --format cia402; --format {} is a table over the position",
            options.format
        ));
    }
    file.refuse_joint_friction("export")?;
    variator::refuse(&file, "export")?;
    let layout = layout(options)?;
    let reciprocal = reciprocal(options)?;
    let coordinate = file.machine.mechanism().coordinate();
    let given = |name: &str, text: &Option<String>, argument: Argument| {
        quantity(name, text.as_deref(), argument, coordinate)
    };
    let torque_error = given(
        "torque-error",
        &options.torque_error,
        Argument::positive(EFFORT),
    )?;
    let omega = given("omega", &options.omega, Argument::positive(SPEED))?;
    let alpha = given("alpha", &options.alpha, Argument::positive(ACCELERATIONS))?;
    let (omega, alpha) = range([omega, alpha], &file)?;
    let task = Task {
        number: options.number,
        layout,
        core: options.core,
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
    busy::begin("searching for the table of every type and layout");
    let found = if options.prove {
        busy::begin("proving the error of the table");
        Export::proven(&file, &task, &mut |_| true)
    } else {
        Export::new(&file, task.clone())
    };
    let export = match found {
        Ok(export) => export,
        Err(Failure::NotReached(why)) => {
            terminal::say(&list::export::not_reached(&why, &task, coordinate));
            return Ok(Completion::Violated);
        }
        Err(Failure::Impossible(why)) => {
            return Err(list::export::impossible(&why, &file, &task).into());
        }
        Err(Failure::Machine(error)) => return Err(core_report(error)),
    };
    let mut says = "nothing written: use --out to write a file".to_owned();
    if let Some(out) = &options.out {
        let file = out.file_name().unwrap_or_default().to_string_lossy();
        let own = name_of_file(options.format, &file);
        let bytes = contents(options.format, &export, name.as_ref().or(own.as_ref()))?;
        output::write(out, &bytes)?;
        let changed = own.filter(|_| name.is_none());
        let changed = changed.and_then(|name| name.changed(&file));
        says = format!(
            "written to {}{}",
            plain::path(out),
            changed.unwrap_or_default()
        );
    }
    warn(&file, [omega, 0.0])?;
    let done = show(options, &export, says)?;
    Ok(if options.prove && !proof_holds(&export) {
        Completion::Violated
    } else {
        done
    })
}

/// The name of the table in a file of this name, in C and in a PLC.
fn name_of_file(format: OutputForm, file: &str) -> Option<Name> {
    match format {
        OutputForm::St | OutputForm::Plcopen => Some(Name::for_plc_of_file(file, &BLOCK_NAMES)),
        OutputForm::C => Some(Name::of_file(file)),
        _ => None,
    }
}

/// The contents of a file.
fn contents(format: OutputForm, export: &Export, name: Option<&Name>) -> Result<Vec<u8>> {
    let commented = |code: &str| list::export::commented(export, code).into_bytes();
    let one_table = || {
        miette!(
            help = "use --format rust, c or json",
            "one image cannot hold the tables of several pieces"
        )
    };
    let about = || list::export::about_plc(export);
    Ok(match (format, name) {
        (OutputForm::Image, _) => export.image().ok_or_else(one_table)?,
        (OutputForm::St, Some(name)) => {
            let text = export.structured_text(name, &about());
            text.ok_or_else(one_table)?.into_bytes()
        }
        (OutputForm::Plcopen, Some(name)) => {
            let text = export.plcopen(name, &about(), &output::today());
            text.ok_or_else(one_table)?.into_bytes()
        }
        (OutputForm::Rust, _) => commented(&export.rust_source(name)),
        (OutputForm::C, Some(name)) => commented(&export.c_source(name)),
        // `cia402` has no table, and writes its file itself; C and a PLC always have a name.
        _ => {
            let answer = list::export::answer(export);
            let parts = answer.write(Format::Json, Screen::default());
            parts.collect::<String>().into_bytes()
        }
    })
}

/// Prints the table, and what was written.
fn show(options: &options::export::Export, export: &Export, written: String) -> Result<Completion> {
    let mut answer = list::export::answer(export);
    let format = match (&options.out, options.format) {
        (None, OutputForm::Json) => Format::Json,
        _ => Format::Table,
    };
    answer.sentence(written);
    print_answer(&answer, format)
}

/// Whether the error of the table is proven and within the allowed one; otherwise reports why not.
fn proof_holds(export: &Export) -> bool {
    let (words, cure) = match (export.proof(), export.excess()) {
        (Some(Err(why)), _) => (
            format!("the error of the table is not proven: {why}"),
            "without --prove it is estimated",
        ),
        (_, Some(_)) => (
            list::export::exceeded(export),
            "allow more cells with --max-cells, a larger --torque-error, or take another --layout or --type",
        ),
        _ => return true,
    };
    terminal::say(&format!("{words}; {cure}"));
    false
}

/// Largest speed and acceleration: as given, otherwise those of the motion. Without an acceleration (constant speed, or no motion) ω² is used, the
/// acceleration that reaches ω within half a radian, or half a metre.
fn range(given: [Option<f64>; 2], file: &MachineFile) -> Result<(f64, f64)> {
    match (given, &file.motion) {
        ([Some(omega), Some(alpha)], _) => return Ok((omega, alpha)),
        ([Some(omega), None], None) => return Ok((omega, omega * omega)),
        _ => {}
    }
    let motion = file.motion_or("the table needs a largest speed: give --omega, or ")?;
    let duty =
        Duty::new(file, motion, jred_analysis::duty::Sampling::default()).map_err(duty_report)?;
    let [omega, alpha] = given;
    let omega = omega.unwrap_or(duty.figures(|i| i.omega).peak());
    let moved = duty.figures(|i| i.alpha).peak();
    let own = if moved > 0.0 { moved } else { omega * omega };
    Ok((omega, alpha.unwrap_or(own)))
}
