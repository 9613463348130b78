//! The option `--vary`: a quantity and its values.
//!
//! ```text
//! slider.mass=50..120kg:8        eight values in equal steps, ends included
//! slider.mass=50..120kg:8:log    in equal ratios
//! slider.mass=50,60,80kg         these values
//! ```

use jred_file::math;
use jred_file::plain;
use jred_file::problem;
use jred_file::text::problem::{Problem, Result};

use super::edit::Document;
use jred_file::units::literal::{self, Literal};

/// Most values of one axis.
const MOST_STEPS: u32 = 1_000_000;

/// One quantity and the values that it takes.
#[derive(Clone, Debug, PartialEq)]
pub struct Variation {
    /// Index of the quantity in the document.
    pub quantity: usize,
    /// Its full path.
    pub path: String,
    /// Unit of the values.
    pub unit: String,
    /// The values.
    pub values: Vec<f64>,
}

/// How to write `--vary`, for messages.
const SHAPE: &str = "write --vary slider.mass=50..120kg:8 for eight values in equal steps, …:8:log for equal ratios, \
                     or a list: slider.mass=50,60,80kg";

impl Variation {
    /// Reads one `--vary`.
    ///
    /// # Errors
    /// The quantity does not exist, the unit is of another kind, or the range has no values.
    pub fn parse(document: &Document, text: &str) -> Result<Self> {
        let wrong = |why: Problem| {
            let shown = plain::quoted(text);
            problem!(help = SHAPE, "--vary {shown} cannot be used: {why}")
        };
        let (path, range) = text
            .split_once('=')
            .ok_or_else(|| wrong(problem!("it has no \"=\"")))?;
        let quantity = document.find(path.trim())?;
        let own = document
            .quantities()
            .get(quantity)
            .ok_or_else(|| wrong(problem!("no such quantity")))?;
        let (values, last) = match range.split_once("..") {
            Some((from, rest)) => between(from, rest),
            None => list(range),
        }
        .map_err(wrong)?;
        if !last.is_like(&own.literal) {
            return Err(problem!(
                help = format!(
                    "the machine file says {}: write a unit of the same kind",
                    own.shown()
                ),
                "--vary {} cannot be used: \"{}\" is not a unit of {}",
                plain::quoted(text),
                last.unit,
                own.path
            ));
        }
        Ok(Self {
            quantity,
            path: own.path.clone(),
            unit: last.unit,
            values,
        })
    }

    /// Name of its column: the path and the unit.
    pub fn column(&self) -> String {
        if self.unit.is_empty() {
            self.path.clone()
        } else {
            format!("{} [{}]", self.path, self.unit)
        }
    }
}

/// The values of a range from `from` to the end and number of values in `rest`, and its end.
fn between(from: &str, rest: &str) -> Result<(Vec<f64>, Literal)> {
    let Some((to, steps)) = rest.split_once(':') else {
        return Err(problem!(
            "the number of values is missing: add for example \":8\""
        ));
    };
    let end = literal::read(to).map_err(|why| problem!("the end {} {why}", plain::quoted(to)))?;
    let values = spread(start(from, &end)?, end.number, steps)?;
    Ok((values, end))
}

/// The start of a range: a number, with the unit of the end or without one.
fn start(text: &str, end: &Literal) -> Result<f64> {
    let from =
        literal::read(text).map_err(|why| problem!("the start {} {why}", plain::quoted(text)))?;
    if from.unit.is_empty() || from.unit == end.unit {
        return Ok(from.number);
    }
    Err(problem!(
        "its ends are in \"{}\" and \"{}\"; use one unit",
        from.unit,
        end.unit
    ))
}

/// The values from `from` to `to`.
fn spread(from: f64, to: f64, steps: &str) -> Result<Vec<f64>> {
    let (steps, log) = match steps.split_once(':') {
        None => (steps, false),
        Some((steps, "log")) => (steps, true),
        Some((_, other)) => {
            return Err(problem!(
                "{} is not valid after the number of values; only \"log\" is",
                plain::quoted(other)
            ));
        }
    };
    let steps: u32 = (steps.trim().parse())
        .map_err(|_| problem!("{} is not a number of values", plain::quoted(steps)))?;
    if !(1..=MOST_STEPS).contains(&steps) {
        return Err(problem!("{steps} values, but it must be 1 to {MOST_STEPS}"));
    }
    let empty = from.total_cmp(&to).is_eq();
    if empty && steps > 1 {
        return Err(problem!(
            "its range from {from} to {to} is empty, but {steps} values are requested"
        ));
    }
    if !empty && steps == 1 {
        return Err(problem!(
            "for one value, write the value instead of a range"
        ));
    }
    if log && !(from > 0.0 && to > 0.0) {
        return Err(problem!("equal ratios require ends greater than zero"));
    }
    let last = f64::from(steps - 1).max(1.0);
    let at = |k: u32| {
        let part = f64::from(k) / last;
        match k {
            0 => from,
            _ if k == steps - 1 => to,
            _ if log => tidy(from * math::pow(to / from, part)),
            _ => tidy(from + (to - from) * part),
        }
    };
    Ok((0..steps).map(at).collect())
}

/// The number with twelve digits, as written in the file and in the row.
fn tidy(x: f64) -> f64 {
    format!("{x:.11e}").parse().unwrap_or(x)
}

/// A list of values; those before the last may omit the unit.
fn list(text: &str) -> Result<(Vec<f64>, Literal)> {
    let (front, last) = text.rsplit_once(',').unwrap_or(("", text));
    let end = literal::read(last).map_err(|why| problem!("{} {why}", plain::quoted(last)))?;
    let front = front.split(',').filter(|_| !front.is_empty());
    let mut values = front
        .map(|text| start(text, &end))
        .collect::<Result<Vec<f64>>>()?;
    values.push(end.number);
    Ok((values, end))
}

/// Every combination of the values of several axes; the last axis varies fastest.
#[derive(Clone, Debug)]
pub struct Grid {
    /// The axes.
    pub axes: Vec<Variation>,
    count: u64,
}

/// Most machines of one study.
pub const MOST_MACHINES: u64 = 100_000_000;

impl Grid {
    /// The combinations of the axes.
    ///
    /// # Errors
    /// There are too many combinations, or a quantity is varied twice.
    pub fn new(axes: Vec<Variation>) -> Result<Self> {
        for (k, axis) in axes.iter().enumerate() {
            if axes
                .iter()
                .take(k)
                .any(|other| other.quantity == axis.quantity)
            {
                return Err(problem!(
                    help = "two --vary name this quantity, perhaps by two paths: remove one of the two",
                    "{} is varied twice",
                    axis.path
                ));
            }
        }
        let product = axes
            .iter()
            .try_fold(1u64, |n, axis| n.checked_mul(axis.values.len() as u64));
        let count = product.filter(|n| *n <= MOST_MACHINES).ok_or_else(|| {
            let counts: Vec<String> = axes.iter().map(|a| a.values.len().to_string()).collect();
            problem!(
                help = "use fewer values, or vary fewer quantities",
                "{} machines are too many: one study sizes at most {MOST_MACHINES}",
                counts.join(" × ")
            )
        })?;
        Ok(Self { axes, count })
    }

    /// Number of combinations.
    pub const fn count(&self) -> u64 {
        self.count
    }

    /// The values of combination number `row`, one for each axis.
    pub fn values(&self, row: u64) -> Vec<f64> {
        let mut rest = row;
        let mut values: Vec<f64> = (self.axes.iter().rev())
            .map(|axis| {
                let n = axis.values.len() as u64;
                let k = (rest % n) as usize;
                rest /= n;
                axis.values.get(k).copied().unwrap_or(f64::NAN)
            })
            .collect();
        values.reverse();
        values
    }
}
