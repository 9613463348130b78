//! Parameters to type into a servo drive.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::answer::Answer;
use crate::answer::schema::Data;
use crate::table::reading::{ColumnKind, Reading};
use crate::table::rows::csv_line;
use jred_file::number::rounding::{down, rounded, significant};
use jred_file::plain;
use jred_file::problem;
use jred_file::text::problem::Result;
use jred_sizing::cell::Cell;
use jred_sizing::settings::{Figure, Setting, Settings};

/// The makers with their parameters.
const PARAMETERS: &str = include_str!("drive/parameters.toml");

/// Digits of a value whose decimals are not given.
const DIGITS: i32 = 4;

/// Inertia that varies by more than this factor over the cycle changes the speed of the loop noticeably.
const UNEVEN: f64 = 1.5;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Makers {
    maker: Vec<Maker>,
}

/// A maker of drives, or a profile.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(!deny_unknown_fields)]
pub struct Maker {
    /// Word of the maker on the command line.
    key: String,
    /// Name of the maker or profile.
    name: String,
    /// The maker as catalogues name it; none for a profile of many makers.
    #[serde(skip_serializing)]
    amplifiers: Option<String>,
    /// Source of names, units and ranges.
    source: String,
    /// The parameters.
    parameters: Vec<Parameter>,
}

/// A parameter: as the table gives it, and with its value for a drive.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(!deny_unknown_fields)]
struct Parameter {
    /// Number, as the maker writes it.
    number: String,
    /// Name.
    name: String,
    /// Value as typed; null if it is not given or beyond the range.
    #[serde(skip_deserializing)]
    #[schemars(!skip_deserializing)]
    value: Option<f64>,
    /// Unit of the value.
    #[serde(default)]
    #[schemars(!default)]
    unit: String,
    /// Range of the parameter as text, empty if it is not known.
    #[serde(skip_deserializing)]
    #[schemars(!skip_deserializing)]
    range: String,
    /// Where to read a value that is not given, the fault of one beyond the range, or the part that sets a limit.
    #[serde(skip_deserializing)]
    #[schemars(!skip_deserializing)]
    remark: String,
    /// Whether the value is beyond the range.
    #[serde(skip)]
    beyond: bool,
    /// The figure; without one the value is `factor`.
    #[serde(skip_serializing)]
    setting: Option<Setting>,
    #[serde(skip_serializing)]
    base: Option<Setting>,
    #[serde(skip_serializing)]
    factor: Option<f64>,
    #[serde(skip_serializing)]
    decimals: Option<i32>,
    /// Least value, and the largest if there is one.
    #[serde(skip_serializing, default, rename(deserialize = "range"))]
    limits: Vec<f64>,
}

/// A drive with its figures.
#[derive(Debug)]
pub struct DriveView<'a> {
    /// Title of the machine.
    pub title: &'a str,
    /// Name of the drive.
    pub drive: &'a str,
    /// Whether it satisfies its rules.
    pub holds: bool,
    /// Its figures.
    pub settings: &'a Settings,
    /// Name and maker of its amplifier.
    pub amplifier: Option<[&'a str; 2]>,
    /// The makers to write for.
    pub makers: &'a [Maker],
}

/// The JSON of `jred drive`.
#[derive(Serialize, JsonSchema)]
pub(crate) struct DriveData {
    /// Name of the drive.
    drive: String,
    /// Whether it satisfies its rules.
    holds: bool,
    /// The figures at the motor shaft.
    figures: Vec<Figure>,
    /// The parameters of each maker.
    makers: Vec<Maker>,
    /// Warnings.
    warnings: Vec<String>,
}

impl Data for DriveData {
    const FORM: &'static str = "jred-drive/1";
}

/// The known makers, or the one of this word.
///
/// # Errors
/// No maker of this word.
pub fn makers(key: Option<&str>) -> Result<Vec<Maker>> {
    let known = toml::from_str(PARAMETERS);
    let known: Makers = known.map_err(|error| problem!("parameters of drives: {error}"))?;
    let Some(key) = key else {
        return Ok(known.maker);
    };
    let words: Vec<&str> = known.maker.iter().map(|maker| maker.key.as_str()).collect();
    let fault = problem!(
        help = format!("write one of: {}", words.join(", ")),
        "there is no maker {}",
        plain::quoted(key)
    );
    let asked = known.maker.into_iter().find(|maker| maker.key == key);
    Ok(vec![asked.ok_or(fault)?])
}

/// A value as it is typed.
fn typed(value: f64, decimals: Option<i32>, is_limit: bool) -> f64 {
    let typed = match decimals {
        Some(decimals) => {
            let scale = 10.0_f64.powi(decimals);
            let scaled = value * scale;
            // A limit is never rounded up; only the error of a decimal fraction is.
            let rounded = if is_limit {
                (scaled * (1.0 + 1e-9)).floor()
            } else {
                scaled.round()
            };
            rounded / scale
        }
        None if is_limit => down(value),
        None => significant(value, DIGITS).parse().unwrap_or(value),
    };
    // Without -0.
    typed + 0.0
}

impl Parameter {
    /// The base of the value of which this is the exact one: a limit is a share of what the drive knows, so of the base as it is typed.
    fn base_of(&self, exact: f64, is_limit: bool, parameters: &[Self]) -> f64 {
        let is_base = |p: &&Self| p.base.is_none() && p.setting.is_some() && p.setting == self.base;
        let known = parameters.iter().find(is_base).filter(|_| is_limit);
        let known = known.map(|p| {
            let factor = p.factor.unwrap_or(1.0);
            typed(exact * factor, p.decimals, false) / factor
        });
        known.filter(|known| *known > 0.0).unwrap_or(exact)
    }

    /// Sets value, range and remark; `parameters` are those of the maker.
    fn fill(&mut self, settings: &Settings, parameters: &[Self]) {
        let least = self.limits.first().copied().unwrap_or(f64::NEG_INFINITY);
        let largest = self.limits.get(1).copied().unwrap_or(f64::INFINITY);
        self.range = match self.limits.len() {
            0 => String::new(),
            1 => format!("from {}", rounded(least)),
            _ => format!("{} to {largest}", rounded(least)),
        };
        let of = |setting: Option<Setting>| setting.map_or((1.0, ""), |s| settings.get(s));
        let [(value, remark), (base, of_base)] = [of(self.setting), of(self.base)];
        let is_limit = matches!(
            self.setting,
            Some(
                Setting::TorqueLimit
                    | Setting::PeakCurrent
                    | Setting::CurrentLimit
                    | Setting::SpeedLimit
            )
        );
        let without_base = base.is_nan() && !value.is_nan();
        let base = self.base_of(base, is_limit, parameters);
        let value = value / base * self.factor.unwrap_or(1.0);
        let value = value
            .is_finite()
            .then(|| typed(value, self.decimals, is_limit));
        self.value = value.filter(|value| (least..=largest).contains(value));
        self.beyond = self.value != value;
        self.remark = match value {
            Some(value) if self.beyond => {
                let cure = match self.setting {
                    Some(Setting::Bandwidth | Setting::SpeedGain | Setting::PositionGain) => {
                        bandwidth(value > largest)
                    }
                    Some(Setting::IntegralTime) => bandwidth(value < least),
                    _ => {
                        "choose another motor or gear ratio, or set the nearest value and check the motion"
                    }
                };
                format!("{value} is beyond the range {}: {cure}", self.range)
            }
            _ => if without_base { of_base } else { remark }.to_owned(),
        };
    }
}

/// The cure of a value that follows from too high a bandwidth, or too low a one.
const fn bandwidth(is_high: bool) -> &'static str {
    if is_high {
        "give a lower --bandwidth"
    } else {
        "give a higher --bandwidth"
    }
}

/// A table whose column "value" has numbers with all their digits.
fn table<const N: usize>(columns: [&str; N], rows: Vec<Vec<Cell>>) -> Reading {
    let kind = |column: &&str| match *column {
        "value" => ColumnKind::Quantity,
        _ => ColumnKind::Words,
    };
    Reading {
        kinds: columns.iter().map(kind).collect(),
        ..Reading::new(columns, rows, 3)
    }
}

/// A number with all its digits.
fn whole(value: Option<f64>) -> Cell {
    value.map_or(Cell::Empty, |value| value.to_string().into())
}

impl DriveView<'_> {
    fn data(&self) -> DriveData {
        let mut makers = self.makers.to_vec();
        for Maker { parameters, .. } in &mut makers {
            let all = parameters.clone();
            for parameter in &mut *parameters {
                parameter.fill(self.settings, &all);
            }
            parameters.sort_by_key(|parameter| parameter.value.is_none());
        }
        let mut figures = self.settings.figures().to_vec();
        figures.sort_by_key(|figure| figure.value.is_none());
        DriveData {
            drive: self.drive.to_owned(),
            holds: self.holds,
            figures,
            warnings: self.warnings(&makers),
            makers,
        }
    }

    fn warnings(&self, makers: &[Maker]) -> Vec<String> {
        // No comparison holds for a figure that is not given.
        let get = |setting| self.settings.get(setting).0;
        let mut warnings = Vec::new();
        if !self.holds {
            warnings
                .push("this drive violates a rule: `jred size FILE --full` names it".to_owned());
        }
        let (peak, limit) = (get(Setting::CyclePeakTorque), get(Setting::TorqueLimit));
        if peak > limit {
            warnings.push(format!(
                "the cycle takes {} N m, more than the torque limit, {} N m: choose a stronger drive, or a slower motion",
                significant(peak, DIGITS),
                significant(limit, DIGITS)
            ));
        }
        let rotor = get(Setting::RotorInertia);
        let [least, largest] =
            [Setting::LeastLoadInertia, Setting::LargestLoadInertia].map(|load| rotor + get(load));
        if largest / least > UNEVEN {
            warnings.push(format!(
                "the total inertia varies by the factor {} over the cycle: a constant inertia fits the mean only, and the speed loop is fastest where it is least; \
                 for the whole J(φ) see `jred export`",
                significant(largest / least, 3)
            ));
        }
        if get(Setting::Direction) < 0.0 {
            warnings.push(
                "the drive train reverses: the motor turns against the drive link; positions and torques have the motor's sign; \
                 where the controller gives positions of the drive link, reverse the polarity (CiA 402: 192 in 0x607E), which leaves torques as they are"
                    .to_owned(),
            );
        }
        if let Some([amplifier, of]) = self.amplifier {
            let is_other = |name: &&str| !name.eq_ignore_ascii_case(of);
            let mut others: Vec<&str> = makers
                .iter()
                .filter_map(|maker| maker.amplifiers.as_deref())
                .filter(is_other)
                .collect();
            others.sort_unstable();
            others.dedup();
            if !others.is_empty() {
                warnings.push(format!(
                    "the amplifier {amplifier} is of {of}: the parameters of {} are for another amplifier on this motor, whose currents are not checked",
                    others.join(" and ")
                ));
            }
        }
        for maker in makers {
            let beyond = maker.parameters.iter().filter(|parameter| parameter.beyond);
            warnings.extend(beyond.map(|p| format!("{} {}: {}", maker.name, p.number, p.remark)));
        }
        warnings
    }

    /// The figures at the motor shaft, and the parameters of each maker.
    pub fn answer(&self) -> Answer<'static> {
        let data = self.data();
        let title = format!("{}: parameters of the drive {}", self.title, self.drive);
        let mut answer = Answer::new(self.title, &data).titled(title);
        for warning in data.warnings {
            answer.warning(warning);
        }
        answer.heading("figures at the motor shaft");
        let figures = data.figures.into_iter().map(|figure| {
            let (unit, factor) = figure.unit;
            let decimals = (unit == "counts").then_some(0);
            let value = figure
                .value
                .map(|value| typed(value * factor, decimals, false));
            let remark = figure.remark.into();
            vec![figure.name.into(), whole(value), unit.into(), remark]
        });
        answer.table(table(
            ["figure", "value", "unit", "remark"],
            figures.collect(),
        ));
        let heads = ["maker", "parameter", "name", "value", "unit"].map(Cell::from);
        let mut csv = csv_line(heads.into_iter());
        for maker in data.makers {
            answer.heading(maker.name);
            let mut rows = Vec::new();
            for p in maker.parameters {
                let [number, name, unit, range, remark] =
                    [p.number, p.name, p.unit, p.range, p.remark].map(Cell::from);
                let key = maker.key.as_str().into();
                let value = p.value.into();
                let cells = [key, number.clone(), name.clone(), value, unit.clone()];
                csv += &csv_line(cells.into_iter());
                rows.push(vec![number, name, whole(p.value), unit, range, remark]);
            }
            let columns = ["parameter", "name", "value", "unit", "range", "remark"];
            answer.table(table(columns, rows));
            answer.sentence(format!("source: {}", maker.source));
        }
        answer.csv(csv);
        answer
    }
}

#[cfg(test)]
mod tests;
