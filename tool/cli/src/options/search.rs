//! Options of searches and studies: filters, ranking, rows.

use std::path::{Path, PathBuf};

use clap::Args;
use glob::Pattern;

use super::catalogue::CatalogueFiles;
use super::sampling::{Accuracy, Steps};
use super::word::word;
use jred_file::model::rules::RuleSet;
use jred_file::number::words::Word as _;
use jred_file::number::words::counted;
use jred_file::read;
use jred_file::text::problem::Problem;
use jred_report::table::output::Format;
use jred_report::table::rows::RowFormat;
use jred_sizing::catalogue::{Catalogue, CatalogueError};
use jred_sizing::select::filter::Filter;
use jred_sizing::select::rank::{Objective, rank};
use jred_sizing::select::size::Selection;
use jred_sizing::study::shard::Shard;

/// Which catalogue.
#[derive(Clone, Debug, Args)]
pub struct SizingOptions {
    /// Parts of drives.
    #[command(flatten)]
    pub catalogue: CatalogueFiles,
    /// Rule set instead of that in the machine file: a name from `jred rules`, or a file; other entries of `[rules]` still
    /// apply.
    #[arg(long, value_name = "SET")]
    pub rules: Option<String>,
    /// Instants of the course.
    #[command(flatten)]
    pub course: Steps,
}

/// Which drives are considered and how they are ranked.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Which drives")]
pub struct SelectionOptions {
    /// Rank by this instead of the smallest motor first.
    #[arg(long, value_parser = word::<Objective>())]
    pub rank: Option<Objective>,
    /// Only motors and gearboxes of matching makers; may be repeated.
    #[arg(long, value_name = "GLOB")]
    pub maker: Vec<Pattern>,
    /// Only motors whose key matches, e.g. "sgmsh-*"; may be repeated.
    #[arg(long, value_name = "GLOB")]
    pub motor: Vec<Pattern>,
    /// Only gearboxes whose key matches; may be repeated.
    #[arg(long, value_name = "GLOB")]
    pub gearbox: Vec<Pattern>,
    /// Only ratios in this range, e.g. "3..10"; a direct drive has 1.
    #[arg(long, value_name = "FROM..TO", value_parser = ratio)]
    pub ratio: Option<[f64; 2]>,
    /// Only direct drives (no gearbox).
    #[arg(long, conflicts_with = "gearbox")]
    pub direct_only: bool,
    /// Only drives up to this mass, e.g. "12 kg".
    #[arg(long, value_name = "MASS", value_parser = jred_file::argument::positive(&jred_file::units::kind::MASS))]
    pub max_mass: Option<f64>,
    /// Only drives up to this price, in the currency of the catalogue.
    #[arg(long, value_name = "PRICE", value_parser = price)]
    pub max_price: Option<f64>,
}

impl SizingOptions {
    /// The rule set of `--rules`, which replaces that of the machine file.
    ///
    /// # Errors
    /// Unknown set, or an error in its file.
    pub fn rule_set(&self) -> Result<Option<RuleSet>, Problem> {
        let named = self.rules.as_deref();
        named
            .map(|word| read::rule_set(word, Path::new("")))
            .transpose()
    }
}

impl SelectionOptions {
    /// Removes drives that do not pass the filter and ranks the rest; returns a sentence for each decision without data.
    pub fn apply(&self, filter: &Filter, selection: &mut Selection) -> Vec<String> {
        let unknown = filter.sift(selection);
        let mut gaps = Vec::new();
        for (n, what) in [(unknown.mass, "mass"), (unknown.price, "price")] {
            if n > 0 {
                let drives = counted(n, "drive", "drives");
                gaps.push(format!("{drives} left out: no data for the {what}"));
            }
        }
        if let Some(objective) = self.rank {
            match rank(selection, objective) {
                0 => {}
                n if n == selection.fit.len() => {
                    gaps.push(format!(
                        "no suitable drive has data for the {objective}: not ranked by it"
                    ));
                }
                n => gaps.push(format!(
                    "{n} suitable drives ranked last: no data for their {objective}"
                )),
            }
        }
        gaps
    }

    /// Checks that compared prices are in one currency.
    ///
    /// # Errors
    /// Different currencies.
    pub fn check(
        &self,
        catalogue: &Catalogue,
        objectives: &[Objective],
    ) -> Result<(), CatalogueError> {
        let ranked = self
            .rank
            .iter()
            .chain(objectives)
            .any(|o| *o == Objective::Price);
        if ranked || self.max_price.is_some() {
            catalogue.one_currency()?;
        }
        Ok(())
    }

    /// Names of the given options that exclude drives.
    pub fn given(&self) -> String {
        let given = [
            ("--maker", !self.maker.is_empty()),
            ("--motor", !self.motor.is_empty()),
            ("--gearbox", !self.gearbox.is_empty()),
            ("--ratio", self.ratio.is_some()),
            ("--direct-only", self.direct_only),
            ("--max-mass", self.max_mass.is_some()),
            ("--max-price", self.max_price.is_some()),
        ];
        let given = given.into_iter().filter(|(_, is_given)| *is_given);
        let names: Vec<&str> = given.map(|(name, _)| name).collect();
        names.join(", ")
    }

    /// The filter of these options.
    pub fn filter(&self) -> Filter {
        Filter {
            makers: self.maker.clone(),
            motors: self.motor.clone(),
            gearboxes: self.gearbox.clone(),
            ratio: self.ratio,
            direct_only: self.direct_only,
            max_mass: self.max_mass,
            max_price: self.max_price,
            drive: None,
        }
    }
}

pub(super) fn ratio(text: &str) -> Result<[f64; 2], String> {
    let shape = "write FROM..TO, such as 3..10";
    let parts = text.split_once("..");
    let parsed = parts.and_then(|(a, b)| Some([a.trim().parse().ok()?, b.trim().parse().ok()?]));
    let [from, to]: [f64; 2] = parsed.ok_or(shape)?;
    if from > 0.0 && from <= to && to.is_finite() {
        Ok([from, to])
    } else {
        Err(format!("no ratio lies between {from} and {to}; {shape}"))
    }
}

fn price(text: &str) -> Result<f64, String> {
    let price: f64 = text.parse().map_err(|_| "write a plain number")?;
    if price > 0.0 && price.is_finite() {
        Ok(price)
    } else {
        Err("it must be greater than zero".to_owned())
    }
}

/// Two or three objectives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Objectives(pub Vec<Objective>);

impl Objectives {
    /// Reads objectives separated by commas.
    ///
    /// # Errors
    /// Fewer than two or more than three objectives, or an unknown one.
    pub fn read(text: &str) -> Result<Self, String> {
        objectives(text).map(Self)
    }
}

fn objectives(text: &str) -> Result<Vec<Objective>, String> {
    let words: Vec<&str> = text.split(',').map(str::trim).collect();
    let read = words
        .iter()
        .map(|word| Objective::of_word(&word.to_lowercase()));
    let found = read.collect::<Option<Vec<_>>>().ok_or_else(|| {
        "an objective is one of power, mass, price, energy, margin, temperature".to_owned()
    })?;
    let twice = found
        .iter()
        .enumerate()
        .any(|(k, o)| found.iter().take(k).any(|other| other == o));
    if !(2..=3).contains(&found.len()) || twice {
        return Err("give two or three different objectives, such as mass,energy".to_owned());
    }
    Ok(found)
}

/// Output options of a study.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Rows")]
pub struct RowOptions {
    /// Format of the rows; a file contains CSV or JSON lines.
    #[arg(long, value_parser = word::<RowFormat>(), default_value_t)]
    pub format: RowFormat,
    /// File to write the rows to, as they are computed.
    #[arg(long, short, value_parser = super::output_file())]
    pub out: Option<PathBuf>,
    /// Continue an interrupted file.
    #[arg(long, requires = "out")]
    pub resume: bool,
    /// Compute only a share of the rows, INDEX/COUNT with INDEX from 0: "0/8" to "7/8". A share is a task of a job array.
    #[arg(long, value_name = "INDEX/COUNT", requires = "out")]
    pub shard: Option<Shard>,
}

/// `jred vary`
#[derive(Debug, Args)]
#[command(
    after_help = "Exit codes: 0 at least one machine has a drive that satisfies every rule; 1 no machine has one (with \
                  --shard always 0); 2 bad input; 130 interrupted before the last row."
)]
pub struct Vary {
    /// Machine file, with a `[motion]`.
    pub file: PathBuf,
    /// A quantity and its values: PATH=FROM..TO UNIT:COUNT, followed by `:log` for equal ratios, or PATH=A,B,C UNIT; may be
    /// repeated for all combinations.
    #[arg(
        long,
        required = true,
        value_name = "PATH=VALUES",
        allow_hyphen_values = true
    )]
    pub vary: Vec<String>,
    /// Catalogue and time steps.
    #[command(flatten)]
    pub supply: SizingOptions,
    /// Error of the integrals.
    #[command(flatten)]
    pub accuracy: Accuracy,
    /// Rows.
    #[command(flatten)]
    pub rows: RowOptions,
    /// Which drives.
    #[command(flatten)]
    pub search: SelectionOptions,
}

/// `jred ratio`
#[derive(Debug, Args)]
#[command(
    after_help = "Exit codes: 0 at least one motor satisfies every rule at some ratio; 1 none does; 2 bad input."
)]
pub struct Ratio {
    /// Machine file, with a `[motion]`.
    pub file: PathBuf,
    /// Catalogue and time steps.
    #[command(flatten)]
    pub supply: SizingOptions,
    /// Error of the integrals.
    #[command(flatten)]
    pub accuracy: Accuracy,
    /// Efficiency of the gearbox, above 0 to 1.
    #[arg(long, default_value_t = 1.0, value_parser = efficiency)]
    pub efficiency: f64,
    /// Inertia of the gearbox at its input, e.g. "0.5 kg cm^2"; zero if not given.
    #[arg(long, value_parser = jred_file::argument::not_negative(&jred_file::units::kind::INERTIA))]
    pub gearbox_inertia: Option<f64>,
    /// Only motors whose key matches, e.g. "sgmsh-*"; may be repeated.
    #[arg(long, value_name = "GLOB")]
    pub motor: Vec<Pattern>,
    /// Show at most N suitable motors, smallest first; the others are counted.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub top: Option<u32>,
    /// Output format.
    #[arg(long, value_parser = word::<Format>(), default_value_t)]
    pub format: Format,
}

pub(super) fn efficiency(text: &str) -> Result<f64, String> {
    let parsed = match text.strip_suffix('%') {
        Some(percent) => percent.trim().parse::<f64>().map(|x| x / 100.0),
        None => text.parse(),
    };
    let efficiency = parsed.map_err(|_| "write a share such as 0.97 or \"97 %\"")?;
    if efficiency > 0.0 && efficiency <= 1.0 {
        Ok(efficiency)
    } else {
        Err("it must be above 0 and at most 1".to_owned())
    }
}

/// `jred sensitivity`
#[derive(Debug, Args)]
#[command(
    after_help = "Exit codes: 0 the drive satisfies every rule; 1 it violates one; 2 bad input."
)]
pub struct Sensitivity {
    /// Machine file, with a `[motion]`.
    pub file: PathBuf,
    /// The drive: MOTOR+GEARBOX, or MOTOR for a direct drive; if not given, the best drive in the catalogue.
    #[arg(long, value_name = "MOTOR+GEARBOX")]
    pub drive: Option<String>,
    /// Step of the finite differences (%).
    #[arg(long, default_value_t = 1.0, value_parser = percent)]
    pub change: f64,
    /// Largest change of each quantity in search of the first violation (%).
    #[arg(long, default_value_t = 50.0, value_parser = percent)]
    pub most: f64,
    /// Catalogue and time steps.
    #[command(flatten)]
    pub supply: SizingOptions,
    /// Error of the integrals.
    #[command(flatten)]
    pub accuracy: Accuracy,
    /// Which drives.
    #[command(flatten)]
    pub search: SelectionOptions,
    /// Output format.
    #[arg(long, value_parser = word::<Format>(), default_value_t)]
    pub format: Format,
}

fn percent(text: &str) -> Result<f64, String> {
    let text = text.trim().trim_end_matches('%').trim_end();
    let percent: f64 = text.parse().map_err(|_| "write a percentage, such as 1")?;
    if percent > 0.0 && percent < 100.0 {
        Ok(percent)
    } else {
        Err("it must be between 0 and 100 %".to_owned())
    }
}

/// `jred tolerance`
#[derive(Debug, Args)]
#[command(
    after_help = "Exit codes: 0 every machine drawn satisfies every rule; 1 one does not, or cannot be built as drawn; \
                  2 bad input; 130 interrupted before the last machine."
)]
pub struct Tolerance {
    /// Machine file, with a `[motion]`.
    pub file: PathBuf,
    /// A tolerance in addition to those in `[tolerance]`, or in place of one of them: PATH=5%, PATH=0.1mm, PATH=normal:2%.
    #[arg(long, value_name = "PATH=AMOUNT")]
    pub tolerance: Vec<String>,
    /// Number of machines to draw.
    #[arg(long, default_value_t = 1000, value_parser = clap::value_parser!(u64).range(1..=100_000_000))]
    pub samples: u64,
    /// Seed of the random numbers.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// The drive: MOTOR+GEARBOX, or MOTOR for a direct drive; if not given, the best drive in the catalogue.
    #[arg(long, value_name = "MOTOR+GEARBOX")]
    pub drive: Option<String>,
    /// Catalogue and time steps.
    #[command(flatten)]
    pub supply: SizingOptions,
    /// Which drives.
    #[command(flatten)]
    pub search: SelectionOptions,
    /// Rows.
    #[command(flatten)]
    pub rows: RowOptions,
}
