//! The command line: declarations only.

pub mod bus;
pub mod catalogue;
pub mod search;
mod word;

use std::path::PathBuf;

use clap::builder::{PathBufValueParser, TypedValueParser};
use clap::{Args, Parser, Subcommand};

use self::search::Objectives;
use self::word::word;
use jred_machine::analysis::reduce::Over;
use jred_machine::export::{Choice, Form, LayoutChoice, Number};
use jred_report::list::inspection::Format as CheckFormat;
use jred_report::table::output::Format;

/// Reduced inertia, drive sizing, simulation and firmware tables for machines whose inertia depends on the angle.
#[derive(Debug, Parser)]
#[command(name = "jred", version, about, after_help = EXIT_CODES)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

const EXIT_CODES: &str = "Exit codes: 0 done, every rule holds; 1 a sizing rule is violated (or a torque error not \
     reached); 2 bad input.\nMachine files are described in docs/machine-file.md; machines/press.toml is one to start \
     from.";

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Reduced inertia J(φ), J′, J″, reduced torque and the motion's drive torque; points, forces and energies.
    Reduce(Reduce),
    /// Check the mechanism itself: freedoms, closure, dead centres, transmission angle, agreement of the methods.
    Check(Check),
    /// Check every motor and gearbox of the catalogue against the motion, and rank what fits.
    Size(Size),
    /// Vary quantities of the machine file over ranges, and size every machine.
    Vary(search::Vary),
    /// The gear ratio that suits each motor: best ratio, range, and the gearboxes in it.
    Ratio(search::Ratio),
    /// How much of each rule's limit every quantity of the machine file moves, and which breaks a rule first.
    Sensitivity(search::Sensitivity),
    /// How likely a drive holds its rules when quantities scatter within tolerances.
    Tolerance(search::Tolerance),
    /// Put the shares of a study that `--shard` wrote together again.
    Merge(search::Merge),
    /// The DC bus of one axis or several: power, voltage and brake resistor, and the worst of the phases between the axes.
    Bus(bus::Bus),
    /// Integrate the free motion under the motor torque of `[simulation]`.
    Simulate(Simulate),
    /// Write the smallest table for the firmware that meets a torque error.
    Export(Export),
    /// The rule sets that come with the tool, or the limits of one of them, each with its source.
    Rules(Rules),
    /// Divide a total gear ratio over stages so that the reduced inertia is smallest.
    Split(Split),
}

/// A file to write. "-" would be taken for stdout, which has the result.
pub fn output_file() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(|path| {
        if path.as_os_str() == "-" {
            return Err("stdout has the result itself: name a file (./- if it is to be called so)");
        }
        Ok(path)
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
    /// What the rows run over.
    #[arg(long, value_parser = word::<Over>(), default_value_t)]
    pub over: Over,
    /// Each link's share of the reduced inertia as well.
    #[arg(long, conflicts_with_all = ["points", "reactions", "energy"])]
    pub links: bool,
    /// Instead of the curves: every named point, centre of mass and link, with transfer functions, velocities and
    /// accelerations.
    #[arg(long)]
    pub points: bool,
    /// Instead of the curves: drive, joint forces, shaking force and moment by d'Alembert's principle.
    #[arg(long)]
    pub reactions: bool,
    /// Instead of the curves: kinetic and potential energy, and the generalised force of every load.
    #[arg(long)]
    pub energy: bool,
    /// Speed of the drive link at every position instead of the motion's, e.g. "60 rpm" ("0.2 m/s" of a sliding link).
    #[arg(long, allow_hyphen_values = true)]
    pub speed: Option<String>,
    /// Its acceleration, e.g. "120 rad/s^2" ("3 m/s^2"); zero if not given.
    #[arg(long, allow_hyphen_values = true, requires = "speed")]
    pub accel: Option<String>,
    /// Write a report about the mechanism: drawing, animation, curves; one self-contained HTML page.
    #[arg(long, value_name = "HTML", value_parser = output_file())]
    pub report: Option<PathBuf>,
    /// How to write the result.
    #[arg(long, value_parser = word::<Format>(), default_value_t)]
    pub format: Format,
}

/// `jred check`
#[derive(Debug, Args)]
pub struct Check {
    /// Machine file.
    pub file: PathBuf,
    /// How to write the result.
    #[arg(long, value_parser = word::<CheckFormat>(), default_value_t)]
    pub format: CheckFormat,
}

/// `jred size`
#[derive(Debug, Args)]
#[command(
    after_help = "Exit codes: 0 a drive holds every rule; 1 none of the catalogue does; 2 bad input."
)]
pub struct Size {
    /// Machine file, with a `[motion]`.
    pub file: PathBuf,
    /// What drives are made of, rules and time steps.
    #[command(flatten)]
    pub supply: search::SizingOptions,
    /// Instead of the ranking: the drives that no other beats in everything, over two or three of power, mass, price, energy,
    /// margin and temperature, e.g. "mass,energy".
    #[arg(long, value_name = "OBJECTIVES", value_parser = Objectives::read, conflicts_with_all = [
        "rank", "top", "nearest", "refused", "all", "explain", "why", "meter", "report"
    ])]
    pub pareto: Option<Objectives>,
    /// Which drives are considered, and which comes first.
    #[command(flatten)]
    pub search: search::Search,
    /// Number of ranked drives to list.
    #[arg(long, default_value_t = 10)]
    pub top: usize,
    /// Number of refused drives to list in CSV and JSON and to explain with --explain, those that miss by least first.
    #[arg(long, default_value_t = 3)]
    pub nearest: usize,
    /// List every refused drive with its reasons.
    #[arg(long)]
    pub refused: bool,
    /// List every drive, ranked or refused.
    #[arg(long)]
    pub all: bool,
    /// Say what torque and inertia of the best drive are made of, how far each of gear ratio, cycle time, moving masses and
    /// process loads may go, and what would have to change for the nearest refused drives to hold.
    #[arg(long)]
    pub explain: bool,
    /// Show and explain this drive instead of the best, and why it stands where it does: MOTOR+GEARBOX, or MOTOR for a direct
    /// drive, with " on AMPLIFIER" behind where there are several, or the name as printed. In CSV its rows come first, and not again.
    #[arg(long, value_name = "DRIVE")]
    pub why: Option<String>,
    /// Write the limits of the best drive, or of the one of --why, for the firmware's duty meter: Rust source to include
    /// (docs/duty-meter.md).
    #[arg(long, value_name = "RS", value_parser = output_file())]
    pub meter: Option<PathBuf>,
    /// Write a report: one self-contained HTML page. As PDF: print it from a browser, or
    /// `chromium --headless --no-pdf-header-footer --print-to-pdf=report.pdf report.html`.
    #[arg(long, value_name = "HTML", value_parser = output_file())]
    pub report: Option<PathBuf>,
    /// How to write the result.
    #[arg(long, value_parser = word::<Format>(), default_value_t)]
    pub format: Format,
}

/// `jred rules`
#[derive(Debug, Args)]
pub struct Rules {
    /// Name of a set, or a file; without one all sets are listed.
    pub set: Option<String>,
    /// How to write the result.
    #[arg(long, value_parser = word::<Format>(), default_value_t)]
    pub format: Format,
}

/// `jred simulate`
#[derive(Debug, Args)]
pub struct Simulate {
    /// Machine file, with a `[simulation]`.
    pub file: PathBuf,
    /// How to write the result.
    #[arg(long, value_parser = word::<Format>(), default_value_t)]
    pub format: Format,
    /// Write plots of speed, torque and energy: one self-contained HTML page.
    #[arg(long, value_name = "HTML", value_parser = output_file())]
    pub plot: Option<PathBuf>,
}

/// `jred export`
#[derive(Debug, Args)]
pub struct Export {
    /// Machine file.
    pub file: PathBuf,
    /// What to write.
    #[arg(long, value_parser = word::<Form>(), default_value_t)]
    pub format: Form,
    /// Number type of the table.
    #[arg(long = "type", value_parser = word::<Number>(), default_value_t)]
    pub number: Number,
    /// How the curves lie in memory.
    #[arg(long, value_parser = word::<LayoutChoice>(), default_value_t)]
    pub layout: LayoutChoice,
    /// A curve of 1/J as well, with which fixed-point forward dynamics does without a division.
    #[arg(long, value_parser = word::<Choice>(), default_value_t)]
    pub reciprocal: Choice,
    /// Largest error of the drive torque, which acts at the drive link, e.g. "0.5 N m" ("5 N" of a sliding link); may be left
    /// out with --max-bytes.
    #[arg(
        long,
        required_unless_present = "max_bytes",
        allow_hyphen_values = true
    )]
    pub torque_error: Option<String>,
    /// Largest speed of the drive link, e.g. "90 rpm" ("0.2 m/s" of a sliding link); from the motion if not given.
    #[arg(long, allow_hyphen_values = true)]
    pub omega: Option<String>,
    /// Largest acceleration of the drive link, e.g. "120 rad/s^2" ("3 m/s^2"); if not given, that of the motion, or omega^2
    /// where the motion has none.
    #[arg(long, allow_hyphen_values = true)]
    pub alpha: Option<String>,
    /// Inertia of rotor and gearbox at the input of the drive train, e.g. "90 kg cm^2", to be moved as well.
    #[arg(long, value_parser = jred_machine::read::inertia_argument)]
    pub rotor_inertia: Option<f64>,
    /// Most cells to try.
    #[arg(long, default_value_t = 4096, value_parser = clap::value_parser!(u32).range(4..=65535))]
    pub max_cells: u32,
    /// Most bytes of the image, header and CRC included. Without --torque-error: the most exact table of so many bytes.
    #[arg(long)]
    pub max_bytes: Option<u32>,
    /// File to write; without one only what was found is printed (as JSON with --format json).
    #[arg(long, short, value_parser = output_file())]
    pub out: Option<PathBuf>,
}

/// `jred split`
#[derive(Debug, Args)]
pub struct Split {
    /// Total ratio, input speed over output speed.
    #[arg(long)]
    pub ratio: f64,
    /// Number of stages.
    #[arg(long, value_parser = clap::value_parser!(u8).range(2..=jred::synthesis::MAX_STAGES as i64))]
    pub stages: u8,
    /// Inertia of a stage's driver, e.g. "0.2 kg cm^2": once for all stages, or once for each.
    #[arg(long, required = true, value_parser = jred_machine::read::inertia_argument)]
    pub pinion: Vec<f64>,
    /// Inertia of a stage's driven wheel, once for all stages or once for each; if not given, it grows with the ratio as that
    /// of a wheel with the pinion's module and width.
    #[arg(long, value_parser = jred_machine::read::inertia_argument)]
    pub driven: Vec<f64>,
    /// Inertia of the load at the output, e.g. "0.5 kg m^2".
    #[arg(long, value_parser = jred_machine::read::inertia_argument)]
    pub load: Option<f64>,
    /// Smallest ratio of a stage.
    #[arg(long, default_value_t = 1.0)]
    pub min_ratio: f64,
    /// Largest ratio of a stage.
    #[arg(long, default_value_t = 10.0)]
    pub max_ratio: f64,
    /// Points of the curve over the split.
    #[arg(long, default_value_t = 25, value_parser = clap::value_parser!(u32).range(2..=10_000))]
    pub points: u32,
    /// How to write the result.
    #[arg(long, value_parser = word::<Format>(), default_value_t)]
    pub format: Format,
}
