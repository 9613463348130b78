//! The command line: declarations only.

pub mod balance;
pub mod bus;
pub mod catalogue;
pub mod documents;
pub mod drive;
pub mod export;
pub mod fastest;
pub mod gentlest;
pub mod help;
pub mod identify;
pub mod parts;
pub mod plan;
pub mod project;
pub mod require;
pub mod sampling;
pub mod search;
pub mod series;
pub mod simulate;
mod word;

use std::any::TypeId;
use std::ffi::OsString;
use std::path::PathBuf;

use clap::builder::{PathBufValueParser, TypedValueParser};
use clap::{Args, CommandFactory as _, FromArgMatches as _, Parser, Subcommand};

use self::documents::Documents;
use self::search::Objectives;
use self::word::word;
use jred_analysis::reduce::Over;
use jred_report::list::inspection::AnswerFormat;
use jred_report::table::output::Format;
use jred_report::units::UnitSystem;

/// Reduced inertia, drive sizing, simulation and firmware tables for machines whose inertia depends on the angle.
#[derive(Debug, Parser)]
#[command(name = "jred", version, after_help = EXIT_CODES)]
pub struct Cli {
    /// The command to run.
    #[command(subcommand)]
    pub command: Command,
    /// Units in which quantities are printed: SI if not given. Files and options may have either.
    #[arg(long, global = true, value_parser = word::<UnitSystem>())]
    pub units: Option<UnitSystem>,
}

impl Cli {
    /// The command line as users see it.
    pub fn declared() -> clap::Command {
        completed(Self::command())
    }

    /// Parses the command line; the first word is the name of the command.
    ///
    /// # Errors
    /// Words that the command does not accept.
    pub fn read(words: impl IntoIterator<Item = OsString>) -> Result<Self, clap::Error> {
        let mut command = Self::declared();
        let matches = command.try_get_matches_from_mut(words)?;
        Self::from_arg_matches(&matches).map_err(|error| error.format(&mut command))
    }
}

/// Lets numeric options accept negative values, so that errors concern the value and not an unknown option; adds the exit codes of most commands.
fn completed(command: clap::Command) -> clap::Command {
    let kinds = [
        TypeId::of::<f64>(),
        TypeId::of::<u8>(),
        TypeId::of::<u32>(),
        TypeId::of::<u64>(),
        TypeId::of::<usize>(),
    ];
    let number = |arg: clap::Arg| {
        let kind = arg.get_value_parser().type_id();
        let is_number = kinds.iter().any(|own| kind == *own);
        let takes = arg.get_action().takes_values() && !arg.is_positional();
        if takes && is_number {
            arg.allow_hyphen_values(true)
        } else {
            arg
        }
    };
    let command = command.mut_args(number).mut_subcommands(completed);
    if command.get_after_help().is_some() {
        return command;
    }
    command.after_help("Exit codes: 0 done; 2 bad input.")
}

const EXIT_CODES: &str = "Exit codes: 0 done, every rule satisfied; 1 a sizing rule is violated (or a torque error not \
     reached); 2 bad input.\n`jred new slider-crank` writes a machine file to start from; docs/machine-file.md describes \
     them. FILE may be - for standard input.";

/// Largest number of time steps of a cycle: --explain and the report, which recompute it for many machines, then take half a minute.
const MOST_STEPS: i64 = 200_000;

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Write a machine file to begin with: every key of a type with its meaning as a comment; without a type, list the types.
    New(help::New),
    /// Compute reduced inertia J(φ), J′ and J″, reduced torque and drive torque; points, forces, energies.
    Reduce(Reduce),
    /// Check the mechanism: degrees of freedom, closure, dead centres, transmission angle, agreement of methods.
    Check(Check),
    /// Check every drive in the catalogue against the motion, and rank the suitable ones.
    Size(Size),
    /// Size the machine for ranges of quantities in the machine file.
    Vary(search::Vary),
    /// Find the gear ratio for each motor: best ratio, suitable range, and gearboxes in it.
    Ratio(search::Ratio),
    /// State what a drive of any maker must be able to do at each gear ratio, for a request for quotation; no catalogue is needed.
    Require(require::Require),
    /// List the parameters to type into the drive: inertia, limits, encoder, gear, gains, in the words of CiA 402 and of makers.
    Drive(drive::Drive),
    /// Show how each quantity in the machine file affects the rules, and which violates one first.
    Sensitivity(search::Sensitivity),
    /// Estimate the probability that a drive satisfies its rules when quantities scatter within tolerances.
    Tolerance(search::Tolerance),
    /// Check the DC bus of one or more axes: power, voltage, brake resistor, and the worst phases between axes.
    Bus(bus::Bus),
    /// Choose the drives of all axes of a machine, their supply and brake resistor, and write one document.
    Project(project::Project),
    /// Simulate the motion under the motor, the loads, the brake and the controller in `[simulation]`; several machines on one shaft.
    Simulate(simulate::Simulate),
    /// Find the steady cycle under the motor in `[simulation]`, its fluctuation of speed, and the flywheel that smooths it.
    Steady(Steady),
    /// Find inertia, weight, friction and cogging of a real machine from logs of its drive, and compare them with the design.
    Identify(identify::Identify),
    /// Find the fastest motion within the limits of a drive: moves in minimum time.
    Fastest(Box<fastest::Fastest>),
    /// Find the motion with the least RMS torque, energy or peak torque for the moves of the machine file, and compare it with all motion laws.
    #[command(alias = "retime")]
    Gentlest(gentlest::Gentlest),
    /// Find counterweights and springs that minimise the torque of the drive, or the fluctuation of the reduced inertia.
    Balance(balance::Balance),
    /// Look into a catalogue, check one, or write an empty one to fill in.
    #[command(
        subcommand,
        after_help = "Exit codes: 0 done; 1 `catalogue check` finds figures that are probably wrong; 2 bad input."
    )]
    Catalogue(parts::Catalogue),
    /// Write a fast firmware table that meets a torque error.
    Export(export::Export),
    /// List the built-in rule sets, or the limits of one set with their sources.
    Rules(Rules),
    /// Divide a total gear ratio over stages for the smallest reduced inertia.
    Split(Split),
    /// Print the completion of commands and options for a shell.
    Completion(help::Completion),
    /// Print the manual page, or write those of all commands.
    Man(help::Man),
}

/// A file to write. "-" is refused: it suggests stdout, which is used for the result.
pub fn output_file() -> impl TypedValueParser<Value = PathBuf> {
    document("")
}

/// Kinds of documents, each with its option.
const DOCUMENTS: [(&str, &str); 4] = [
    ("html", "--report"),
    ("htm", "--report"),
    ("pdf", "--pdf"),
    ("xlsx", "--xlsx"),
];

/// A document to write with `option`; a name that ends as those of another option is refused.
pub fn document(option: &'static str) -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(move |path| {
        if path.as_os_str() == "-" {
            return Err(
                "stdout is used for the result: name a file (./- for a file of this name)"
                    .to_owned(),
            );
        }
        let own = |(end, _): &&(&str, &str)| {
            path.extension()
                .is_some_and(|e| e.eq_ignore_ascii_case(end))
        };
        match DOCUMENTS.iter().find(own) {
            Some((end, other)) if !option.is_empty() && *other != option => Err(format!(
                "{option} does not write a file of the kind .{end}: use {other}"
            )),
            _ => Ok(path),
        }
    })
}

/// `jred reduce`
#[derive(Debug, Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is a switch of its own")]
pub struct Reduce {
    /// Machine file.
    pub file: PathBuf,
    /// Number of positions.
    #[arg(long, default_value_t = 36, value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
    pub positions: u32,
    /// Variable that the rows run over.
    #[arg(long, value_parser = word::<Over>(), default_value_t)]
    pub over: Over,
    /// These positions instead, each optionally followed by its speed and acceleration, e.g. "30 deg, 60 deg" or "30 deg, 60 rpm, 5 rad/s^2".
    #[arg(long, value_name = "STATES", allow_hyphen_values = true, conflicts_with_all = ["positions", "over"])]
    pub at: Option<String>,
    /// Also list each link's share of the reduced inertia.
    #[arg(long, conflicts_with_all = ["points", "reactions", "energy"])]
    pub links: bool,
    /// Instead of the curves: list every named point, centre of mass and link with transfer functions, velocities and
    /// accelerations.
    #[arg(long)]
    pub points: bool,
    /// Instead of the curves: list drive torque, joint forces, shaking force and moment by d'Alembert's principle.
    #[arg(long)]
    pub reactions: bool,
    /// Instead of the curves: list kinetic and potential energy and the generalised force of every load.
    #[arg(long)]
    pub energy: bool,
    /// Constant speed of the drive link instead of the motion, e.g. "60 rpm" ("0.2 m/s" for a sliding link).
    #[arg(long, allow_hyphen_values = true)]
    pub speed: Option<String>,
    /// Constant acceleration of the drive link, e.g. "120 rad/s^2" ("3 m/s^2"); zero if not given.
    #[arg(long, allow_hyphen_values = true, requires = "speed")]
    pub accel: Option<String>,
    /// Documents.
    #[command(flatten)]
    pub documents: Documents,
    /// Output format.
    #[arg(long, value_parser = word::<Format>(), default_value_t)]
    pub format: Format,
}

/// `jred check`
#[derive(Debug, Args)]
#[command(after_help = "Exit codes: 0 the mechanism can be used; 1 a check fails; 2 bad input.")]
pub struct Check {
    /// Machine file.
    pub file: PathBuf,
    /// Output format.
    #[arg(long, value_parser = word::<AnswerFormat>(), default_value_t)]
    pub format: AnswerFormat,
}

jred_file::words! {
    /// Form of an answer about drives.
    pub enum SizeFormat default Table {
        /// For reading.
        Table = "table",
        /// Comma-separated values.
        Csv = "csv",
        /// JSON, every digit.
        Json = "json",
        /// The chosen drive as submodel of the asset administration shell: IDTA 02021-1-0, Sizing of Power Drive Trains.
        Aas = "aas",
    }
}

impl SizeFormat {
    /// The form of the answer; `None`: the submodel replaces it.
    pub const fn of_answer(self) -> Option<Format> {
        match self {
            Self::Table => Some(Format::Table),
            Self::Csv => Some(Format::Csv),
            Self::Json => Some(Format::Json),
            Self::Aas => None,
        }
    }
}

jred_file::words! {
    /// Which motion drives are judged with.
    pub enum MotionChoice default Own {
        /// The motion of the machine file.
        Own = "own",
        /// The same moves in the same times with the least RMS torque for the smallest drive that is suitable with such a motion; see `jred gentlest`.
        Best = "best",
    }
}

/// `jred size`
#[derive(Debug, Args)]
#[command(
    after_help = "Exit codes: 0 a drive satisfies every rule; 1 no drive in the catalogue does; 2 bad input."
)]
#[expect(clippy::struct_excessive_bools, reason = "each is a switch of its own")]
pub struct Size {
    /// Machine file, with a `[motion]`.
    pub file: PathBuf,
    /// Catalogue, rules and time steps.
    #[command(flatten)]
    pub supply: search::SizingOptions,
    /// Error of the integrals.
    #[command(flatten)]
    pub accuracy: sampling::Accuracy,
    /// Which motion the drives are judged with.
    #[arg(long, value_parser = word::<MotionChoice>(), default_value_t, conflicts_with = "rank")]
    pub motion: MotionChoice,
    /// Instead of the ranking: list the Pareto front over two or three of power, mass, price, energy, margin and
    /// temperature, e.g. "mass,energy".
    #[arg(long, value_name = "OBJECTIVES", value_parser = Objectives::read, conflicts_with_all = [
        "rank", "all_gearboxes", "full", "top", "nearest", "refused", "all", "explain", "why", "meter", "report", "pdf", "xlsx"
    ])]
    pub pareto: Option<Objectives>,
    /// Which drives are considered and how they are ranked.
    #[command(flatten)]
    pub search: search::SelectionOptions,
    /// Judge this drive alone: MOTOR+GEARBOX, or MOTOR for a direct drive, followed by " on AMPLIFIER" if there are several.
    #[arg(long, value_name = "MOTOR+GEARBOX", conflicts_with_all = [
        "pareto", "rank", "why", "maker", "motor", "gearbox", "ratio", "direct_only", "max_mass", "max_price"
    ])]
    pub drive: Option<String>,
    /// List every gearbox and amplifier of a motor instead of the first.
    #[arg(long)]
    pub all_gearboxes: bool,
    /// Print the duty, every rule with figure, limit and margin, what is not checked, and the ranking below the first screen.
    #[arg(long)]
    pub full: bool,
    /// Number of motors to rank, each with its first gearbox and amplifier, or of drives with --all-gearboxes: 10 if not given. In CSV and JSON the
    /// closest refused drives follow, which --nearest 0 leaves out.
    #[arg(long, value_name = "N")]
    pub top: Option<usize>,
    /// Number of refused drives to list in CSV and JSON and to explain with --explain, closest first.
    #[arg(long, default_value_t = 3)]
    pub nearest: usize,
    /// List every refused drive with its reasons.
    #[arg(long)]
    pub refused: bool,
    /// List every drive, ranked or refused.
    #[arg(long)]
    pub all: bool,
    /// Explain the best drive: contributions to its torque and inertia, how far gear ratio, cycle time, moving masses and
    /// process loads may change, and what would make the closest refused drives suitable.
    #[arg(long)]
    pub explain: bool,
    /// Show and explain this drive instead of the best one, and the reason for its rank: MOTOR+GEARBOX, or MOTOR for a
    /// direct drive, followed by " on AMPLIFIER" if there are several, or the name as printed. In CSV its rows come first
    /// and are not repeated.
    #[arg(long, value_name = "DRIVE")]
    pub why: Option<String>,
    /// Write the limits of the best drive, or of the drive of --why, for the duty meter in the firmware as Rust source
    /// (docs/duty-meter.md).
    #[arg(long, value_name = "RS", value_parser = output_file())]
    pub meter: Option<PathBuf>,
    /// Documents.
    #[command(flatten)]
    pub documents: Documents,
    /// Output format.
    #[arg(long, value_parser = word::<SizeFormat>(), default_value_t)]
    pub format: SizeFormat,
}

/// `jred rules`
#[derive(Debug, Args)]
pub struct Rules {
    /// Name of a set, or a file; lists all sets if not given.
    pub set: Option<String>,
    /// Output format.
    #[arg(long, value_parser = word::<Format>(), default_value_t)]
    pub format: Format,
}

/// `jred steady`
#[derive(Debug, Args)]
#[command(after_help = "Exit codes: 0 done; 2 bad input, or there is no steady cycle.")]
pub struct Steady {
    /// Machine file. Further ones are machines on the same motor shaft, each with its own drive train, which make whole turns while the first one
    /// makes one.
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Lead of a further machine's drive link over the start in its `[simulation]`, e.g. "180 deg"; one for each of them, in order.
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true, value_parser = jred_file::argument::any(&jred_file::units::kind::ANGLE))]
    pub phase: Vec<f64>,
    /// Coefficient of speed fluctuation that a flywheel is to reach, e.g. 0.02 or 2%: find its inertia.
    #[arg(long, value_parser = fluctuation)]
    pub delta: Option<f64>,
    /// Constant torque of the motor instead of that in `[simulation]`, e.g. "20 N m".
    #[arg(long, allow_hyphen_values = true, value_parser = jred_file::argument::any(&jred_file::units::kind::TORQUE))]
    pub torque: Option<f64>,
    /// Mean speed of the drive link over the time, e.g. "300 rpm": find the size of the motor torque for it, or a constant torque if `[simulation]`
    /// gives no motor. A torque below zero brakes a machine that the process drives. A negative speed turns the machine backwards.
    #[arg(
        long,
        value_name = "SPEED",
        allow_hyphen_values = true,
        conflicts_with = "torque"
    )]
    pub mean_speed: Option<String>,
    /// Find the size of the loads of this name for that mean speed, with the motor unchanged.
    #[arg(long, value_name = "LOAD", requires = "mean_speed")]
    pub scale: Option<String>,
    /// Turns of the drive link in a cycle; as many as the loads need, if not given.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=64))]
    pub turns: Option<u32>,
    /// Number of positions in the list for each turn; the list ends with the end of the cycle.
    #[arg(long, default_value_t = 36, value_parser = clap::value_parser!(u32).range(2..=10_000))]
    pub positions: u32,
    /// Documents.
    #[command(flatten)]
    pub documents: Documents,
    /// Output format.
    #[arg(long, value_parser = word::<Format>(), default_value_t)]
    pub format: Format,
}

/// A share, or a percentage.
fn share(text: &str) -> Option<f64> {
    let (number, scale) = match text.trim().strip_suffix('%') {
        Some(percent) => (percent.trim_end(), 0.01),
        None => (text, 1.0),
    };
    let number: f64 = number.parse().ok()?;
    Some(number * scale)
}

/// A coefficient of speed fluctuation.
fn fluctuation(text: &str) -> Result<f64, String> {
    let delta = share(text).ok_or("write a number or a percentage, such as 0.02 or 2%")?;
    if (1e-6..=1.0).contains(&delta) {
        Ok(delta)
    } else {
        Err("it must be a number from 0.000001 to 1, or a percentage up to 100%".to_owned())
    }
}

/// A ratio of one stage or of several.
fn ratio(text: &str) -> Result<f64, String> {
    let ratio: f64 = text.parse().map_err(|_| "write a plain number")?;
    if ratio.is_finite() && ratio.abs() <= 1e6 {
        Ok(ratio)
    } else {
        Err("it must be a number up to 1e6".to_owned())
    }
}

/// `jred split`
#[derive(Debug, Args)]
pub struct Split {
    /// Total ratio, input speed over output speed.
    #[arg(long, value_parser = ratio)]
    pub ratio: f64,
    /// Number of stages.
    #[arg(long, value_parser = clap::value_parser!(u8).range(2..=jred::mechanism::synthesis::MOST_STAGES as i64))]
    pub stages: u8,
    /// Inertia of the driver of a stage, e.g. "0.2 kg cm^2": once for all stages, or once for each.
    #[arg(long, required = true, value_parser = jred_file::argument::positive(&jred_file::units::kind::INERTIA))]
    pub pinion: Vec<f64>,
    /// Inertia of the driven wheel of a stage, once for all stages or once for each; if not given, it grows with the ratio
    /// like that of a wheel with the module and width of the pinion.
    #[arg(long, value_parser = jred_file::argument::positive(&jred_file::units::kind::INERTIA))]
    pub driven: Vec<f64>,
    /// Inertia of the load at the output, e.g. "0.5 kg m^2".
    #[arg(long, value_parser = jred_file::argument::positive(&jred_file::units::kind::INERTIA))]
    pub load: Option<f64>,
    /// Smallest ratio of a stage.
    #[arg(long, default_value_t = 1.0, value_parser = ratio)]
    pub min_ratio: f64,
    /// Largest ratio of a stage.
    #[arg(long, default_value_t = 10.0, value_parser = ratio)]
    pub max_ratio: f64,
    /// Number of points of the curve over the split.
    #[arg(long, default_value_t = 25, value_parser = clap::value_parser!(u32).range(2..=10_000))]
    pub points: u32,
    /// Output format.
    #[arg(long, value_parser = word::<Format>(), default_value_t)]
    pub format: Format,
}
