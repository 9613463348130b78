//! Options of `jred require`.

use std::path::PathBuf;

use clap::Args;

use super::sampling::{Accuracy, Steps};
use super::search::{efficiency, ratio};
use super::share;
use super::word::word;
use jred_report::table::output::Format;

/// `jred require`
#[derive(Debug, Args)]
#[command(
    after_help = "Exit codes: 0 done; 1 no gearbox can satisfy the rules at any ratio; 2 bad input.\n\
                  Add the offers to a catalogue (docs/catalogue.md) and judge them with `jred size FILE --catalogue FOLDER`."
)]
pub struct Require {
    /// Machine file, with a `[motion]`.
    pub file: PathBuf,
    /// Gear ratios, e.g. "7, 10, 25"; 1 is direct coupling. A comma separates two ratios; with semicolons between them, "3,5; 7,5", it is a decimal sign. If not given: the usual ratios of planetary gearboxes in the range of --within.
    #[arg(long, value_name = "RATIOS", allow_hyphen_values = true, value_parser = ratios)]
    pub ratios: Option<RatioList>,
    /// Only the usual ratios in this range, e.g. "3..10"; a direct drive has 1.
    #[arg(long, value_name = "FROM..TO", value_parser = ratio, conflicts_with = "ratios")]
    pub within: Option<[f64; 2]>,
    /// Largest speed of the motor for the usual ratios, e.g. "4500 rpm": 6000 rpm if not given.
    #[arg(long, value_name = "SPEED", conflicts_with = "ratios", value_parser = jred_file::argument::positive(&jred_file::units::kind::ANGULAR_SPEED))]
    pub max_speed: Option<f64>,
    /// Efficiency of the gearbox, above 0 to 1.
    #[arg(long, default_value = "0.95", value_parser = efficiency)]
    pub efficiency: f64,
    /// Inertia of the gearbox at its input, e.g. "0.5 kg cm^2"; zero if not given.
    #[arg(long, value_parser = jred_file::argument::positive(&jred_file::units::kind::INERTIA))]
    pub gearbox_inertia: Option<f64>,
    /// S1 torque above the least possible, e.g. 20%: the more, the wider is the window of rotor inertias.
    #[arg(long, default_value = "20%", value_parser = allowance)]
    pub allowance: f64,
    /// Rule set instead of that in the machine file: a name from `jred rules`, or a file; other entries of `[rules]` still apply.
    #[arg(long, value_name = "SET")]
    pub rules: Option<String>,
    /// Instants of the course.
    #[command(flatten)]
    pub course: Steps,
    /// Error of the integrals.
    #[command(flatten)]
    pub accuracy: Accuracy,
    /// Write the request for quotation as one self-contained HTML page.
    #[arg(long, value_name = "HTML", value_parser = super::output_file())]
    pub report: Option<PathBuf>,
    /// Output format.
    #[arg(long, value_parser = word::<Format>(), default_value_t)]
    pub format: Format,
}

/// Gear ratios, one of which may be direct coupling.
#[derive(Clone, Debug)]
pub struct RatioList {
    /// The ratios; `None` is direct coupling.
    pub ratios: Vec<Option<f64>>,
    /// Two ratios that can be meant as one with a decimal comma, as written: "3,5".
    pub doubtful: Option<String>,
}

/// Most ratios of a list.
const MOST: usize = 50;

fn ratios(text: &str) -> Result<RatioList, String> {
    let one = |word: &str| {
        let ratio: f64 = word.trim().parse().map_err(|_| {
            format!(
                "\"{}\" is not a ratio; write numbers such as \"7, 10, 25\"",
                word.trim()
            )
        })?;
        match ratio {
            _ if !(1e-4..=1e6).contains(&ratio) => Err(format!(
                "the ratio {ratio} is not between 0.0001 and 1000000"
            )),
            1.0 => Ok(None),
            _ => Ok(Some(ratio)),
        }
    };
    let mut list: Vec<Option<f64>> = Vec::new();
    let (separator, decimal) = match text.contains(';') {
        true => (';', text.replace(',', ".")),
        false => (',', text.to_owned()),
    };
    for ratio in decimal.split(separator).map(one) {
        let ratio = ratio?;
        if !list.contains(&ratio) {
            list.push(ratio);
        }
    }
    if list.len() > MOST {
        return Err(format!("{} ratios; at most {MOST} are listed", list.len()));
    }
    // In a list people mostly leave a blank behind the comma, or name more than two.
    let is_digits = |part: &str| part.bytes().all(|c| c.is_ascii_digit());
    let doubtful = text
        .split_once(',')
        .is_some_and(|(whole, rest)| is_digits(whole) && is_digits(rest));
    Ok(RatioList {
        ratios: list,
        doubtful: doubtful.then(|| text.to_owned()),
    })
}

fn allowance(text: &str) -> Result<f64, String> {
    let share = share(text).ok_or("write a share or a percentage, such as 0.2 or 20%")?;
    if (0.01..=10.0).contains(&share) {
        Ok(share)
    } else {
        let percent = 100.0 * share;
        Err(format!(
            "that is {percent} %; it must be between 1 and 1000 %: write 20% or 0.2"
        ))
    }
}
