//! The commands: read, compute, write.

pub mod balance;
pub mod bus;
mod catalogue;
mod core_error;
mod documents;
mod drive;
mod export;
pub mod fastest;
pub mod gentlest;
mod help;
mod identify;
mod plan;
mod project;
pub mod ratio;
mod reduce;
mod require;
pub mod sensitivity;
mod series;
mod simulate;
pub mod size;
pub mod split;
pub mod steady;
pub mod tolerance;
pub mod vary;

use std::path::Path;

use miette::{Result, miette};

use crate::busy;
use crate::commands::core_error::core_report;
use crate::options;
use crate::options::catalogue::CatalogueFiles;
use crate::terminal;
use jred_analysis::checked;
use jred_analysis::contact::OneWay;
use jred_analysis::inspect::Findings;
use jred_analysis::warnings::of_motion;
use jred_file::argument::Argument;
use jred_file::model::axis::Axis;
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;
use jred_file::plain;
use jred_file::read;
use jred_report::answer::Answer;
use jred_report::list::{contact, inspection, rule_list};
use jred_report::table::output::Format;
use jred_sizing::catalogue::{Catalogue, Drive};
use jred_sizing::motor::envelope::{Envelope, MotorLimits};
use jred_sizing::select::fit::fit_input;
use jred_sizing::select::named::named;
use jred_sizing::study::chosen::ChosenDrive;

/// Result of a command without an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Completion {
    /// Every requirement is satisfied.
    Holds,
    /// Every drive violates a rule, or a torque error is not reached.
    Violated,
    /// Interrupted by the user.
    Stopped,
}

impl Completion {
    const fn of(holds: bool) -> Self {
        if holds { Self::Holds } else { Self::Violated }
    }
}

/// Runs a command.
///
/// # Errors
/// Bad input, or a file that cannot be written.
pub fn run(command: &options::Command) -> Result<Completion> {
    busy::begin(doing(command));
    let done = dispatch(command);
    busy::end();
    done
}

fn dispatch(command: &options::Command) -> Result<Completion> {
    match command {
        options::Command::New(options) => help::new(options),
        options::Command::Completion(options) => help::completion(options),
        options::Command::Man(options) => help::man(options),
        options::Command::Reduce(options) => reduce::run(options),
        options::Command::Check(options) => run_check(options),
        options::Command::Size(options) => size::size(options),
        options::Command::Vary(options) => vary::vary(options),
        options::Command::Ratio(options) => ratio::ratio(options),
        options::Command::Require(options) => require::run(options),
        options::Command::Drive(options) => drive::run(options),
        options::Command::Sensitivity(options) => sensitivity::sensitivity(options),
        options::Command::Tolerance(options) => tolerance::tolerance(options),
        options::Command::Bus(options) => bus::run(options),
        options::Command::Project(options) => project::run(options),
        options::Command::Simulate(options) => simulate::run(options),
        options::Command::Steady(options) => steady::steady(options),
        options::Command::Identify(options) => identify::run(options),
        options::Command::Fastest(options) => fastest::fastest(options),
        options::Command::Gentlest(options) => gentlest::gentlest(options),
        options::Command::Balance(options) => balance::balance(options),
        options::Command::Export(options) => export::run(options),
        options::Command::Catalogue(options) => catalogue::run(options),
        options::Command::Rules(options) => {
            let Some(set) = &options.set else {
                return print_answer(&rule_list::all(), options.format);
            };
            let set = read::rule_set(set, Path::new(""))?;
            print_answer(&rule_list::answer(&set), options.format)
        }
        options::Command::Split(options) => print_answer(&split::run(options)?, options.format),
    }
}

/// Name of the task for the progress line.
const fn doing(command: &options::Command) -> &'static str {
    use options::Command;
    match command {
        Command::New(_) => "writing the machine file",
        Command::Completion(_) | Command::Man(_) => "writing",
        Command::Reduce(_) => "reducing the machine",
        Command::Check(_) => "checking the machine",
        Command::Size(_) => "checking drives",
        Command::Vary(_) | Command::Tolerance(_) => "reading machine and catalogue",
        Command::Ratio(_) => "searching gear ratios",
        Command::Require(_) => "computing requirements",
        Command::Drive(_) => "computing parameters",
        Command::Sensitivity(_) => "changing each quantity",
        Command::Bus(_) => "following the DC bus",
        Command::Project(_) => "choosing the drives",
        Command::Simulate(_) => "following the motion",
        Command::Steady(_) => "searching for the steady cycle",
        Command::Identify(_) => "identifying the machine",
        Command::Fastest(_) => "computing the fastest motion",
        Command::Gentlest(_) => "computing the gentlest motion",
        Command::Balance(_) => "computing counterweights and springs",
        Command::Catalogue(_) => "reading the catalogue",
        Command::Export(_) => "searching for the smallest table",
        Command::Rules(_) => "reading rules",
        Command::Split(_) => "dividing the ratio",
    }
}

fn run_check(options: &options::Check) -> Result<Completion> {
    let file = checked::read(&options.file)?;
    let findings = Findings::of(&file).map_err(core_report)?;
    print_answer(&inspection::answer(&findings), options.format.into())?;
    Ok(Completion::of(findings.holds()))
}

/// Prints to stdout.
pub(crate) fn print(text: &str) -> Result<Completion> {
    terminal::print(text).map(|()| Completion::Holds)
}

/// Prints an answer.
fn print_answer(answer: &Answer, format: Format) -> Result<Completion> {
    print_parts(answer.write(format, terminal::screen()))
}

/// Prints a text in parts.
fn print_parts(parts: impl IntoIterator<Item = String>) -> Result<Completion> {
    terminal::print_parts(parts)?;
    Ok(Completion::Holds)
}

/// Warns on standard error if a contact separates at this speed and acceleration; the result is computed anyway.
fn warn(file: &MachineFile, state: [f64; 2]) -> Result<()> {
    if let Some(parted) = OneWay::separation(&file.machine, state).map_err(core_report)? {
        terminal::warn(&contact::warning(&parted));
    }
    Ok(())
}

/// The named drive of a catalogue, reduced to motors that match the machine's input.
fn drive_named(mut catalogue: Catalogue, name: &str, file: &MachineFile) -> Result<ChosenDrive> {
    fit_input(&mut catalogue, file)?;
    Ok(ChosenDrive::of(&named(&catalogue, name)?.1, &catalogue))
}

/// The drive of `--drive`, if given; a catalogue without it is an error.
fn drive_asked(
    name: Option<&str>,
    files: &CatalogueFiles,
    file: &MachineFile,
) -> Result<Option<ChosenDrive>> {
    match (name, files.given().next()) {
        (Some(name), _) => drive_named(files.open()?, name, file).map(Some),
        (None, Some(option)) => Err(miette!(
            help = "give --drive MOTOR+GEARBOX, or leave the catalogue out",
            "{option} is read for a drive, and no --drive is given"
        )),
        (None, None) => Ok(None),
    }
}

/// The limits of a drive at the machine's supply. Warns of assumptions, and of a drive for another supply.
fn envelope(drive: &Drive, file: &MachineFile) -> Envelope {
    warn_of_supply(drive, file);
    let envelope = Envelope::at(drive.motor, drive.amplifier, &file.site);
    for assumption in envelope.assumptions() {
        terminal::warn(&assumption.clone());
    }
    envelope
}

/// Warns if a drive is not made for the supply.
fn warn_of_supply(drive: &Drive, file: &MachineFile) {
    let limits = MotorLimits::new(drive.motor, drive.amplifier, &file.site);
    if let Some(unfit) = limits.unfit(&file.rules) {
        terminal::warn(&unfit.clone());
    }
}

/// A quantity of the command line.
fn quantity(
    name: &str,
    text: Option<&str>,
    argument: Argument,
    coordinate: Coordinate,
) -> Result<Option<f64>> {
    let value = text.map(|text| {
        argument
            .read(text, coordinate)
            .map_err(|why| miette!("--{name} {} cannot be used: {why}", plain::quoted(text)))
    });
    value.transpose()
}

/// A speed or an acceleration of the drive link, given for the axis.
fn rate(name: &str, text: Option<&str>, argument: Argument, axis: &Axis) -> Result<Option<f64>> {
    let given = quantity(name, text, argument, axis.coordinate)?;
    Ok(given.map(|rate| axis.drive_rate(rate)))
}

/// Sentence with the path of a written motion and its use.
fn profile_written(file: &MachineFile, path: &Path) -> String {
    let evenly = file.axis() != Axis::of_drive(file.machine.mechanism().coordinate());
    let of = match file.motion.as_ref().map(|motion| motion.tool().is_some()) {
        Some(true) if evenly => ", `of` as it is",
        Some(true) => ", without `of`",
        None if evenly => ", `of` naming the part that moves",
        _ => "",
    };
    format!(
        "profile written to {}; as [motion]: type = \"profile\", file = \"…\" with its path from the machine file{of}",
        plain::path(path)
    )
}

/// Warns of noise and wrong rows of a recorded motion, and of implausible speeds.
fn warn_of_motion(file: &MachineFile) {
    for warning in of_motion(file) {
        terminal::warn(&warning);
    }
}

/// A machine file, with the warnings of its motion.
fn read_warned(path: &Path) -> Result<MachineFile> {
    let file = checked::read(path)?;
    warn_of_motion(&file);
    Ok(file)
}
