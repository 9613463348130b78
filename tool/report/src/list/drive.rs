//! Parameters to type into a servo drive.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::answer::Answer;
use crate::answer::schema::Data;
use crate::table::reading::{ColumnKind, Reading};
use crate::table::rows::csv_line;
use jred_file::number::rounding::{rounded, significant};
use jred_file::problem;
use jred_file::text::problem::Result;
use jred_sizing::cell::Cell;
use jred_sizing::settings::{LimitedBy, Setting, Settings};

/// The words of the makers.
const PARAMETERS: &str = include_str!("drive/parameters.toml");

/// Digits of a value whose decimals are not given.
const DIGITS: i32 = 4;

/// Inertia that varies by more than this factor over the cycle changes the speed of the loop noticeably.
const UNEVEN: f64 = 1.5;

/// Figures, and makers with their parameters.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Makers {
    figure: Vec<Figure>,
    maker: Vec<Maker>,
}

/// A figure with its words.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Figure {
    setting: Setting,
    name: String,
    #[serde(default)]
    unit: String,
    #[serde(default = "one")]
    factor: f64,
    decimals: Option<i32>,
    #[serde(default)]
    missing: String,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Maker {
    key: String,
    name: String,
    source: String,
    parameters: Vec<Parameter>,
}

/// A parameter of a maker.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameter {
    number: String,
    name: String,
    #[serde(default)]
    unit: String,
    /// The figure; without one the value is `factor`.
    setting: Option<Setting>,
    base: Option<Setting>,
    #[serde(default = "one")]
    factor: f64,
    decimals: Option<i32>,
    /// Least value, and the largest if there is one.
    #[serde(default)]
    range: Vec<f64>,
}

const fn one() -> f64 {
    1.0
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
    /// The makers to write for.
    pub makers: &'a Makers,
}

/// The JSON of `jred drive`.
#[derive(Serialize, JsonSchema)]
pub(crate) struct DriveData {
    /// Name of the drive.
    drive: String,
    /// Whether it satisfies its rules.
    holds: bool,
    /// The figures at the motor shaft.
    figures: Vec<FigureData>,
    /// The parameters of each maker.
    makers: Vec<MakerData>,
    /// Warnings.
    warnings: Vec<String>,
}

#[derive(Serialize, JsonSchema)]
struct FigureData {
    /// The figure.
    setting: Setting,
    /// Its name.
    name: String,
    /// Its value in SI; null if it is not given.
    value: Option<f64>,
    /// The value as a person reads it, and its unit.
    #[serde(skip)]
    shown: (Option<f64>, String),
    /// Where to read a value that is not given, or the part that sets the torque limit.
    remark: String,
}

#[derive(Serialize, JsonSchema)]
struct MakerData {
    /// Word of the maker on the command line.
    key: String,
    /// Name of the maker or profile.
    name: String,
    /// Source of names, units and ranges.
    source: String,
    /// The parameters.
    parameters: Vec<ParameterData>,
}

#[derive(Serialize, JsonSchema)]
struct ParameterData {
    /// Number, as the maker writes it.
    number: String,
    /// Name.
    name: String,
    /// Value as typed; null if it is not given or beyond the range.
    value: Option<f64>,
    /// Unit of the value.
    unit: String,
    /// Range of the parameter as text, empty if it is not known.
    range: String,
    /// Where to read a value that is not given, or the fault of one beyond the range.
    #[schemars(with = "String")]
    remark: Remark,
}

/// The remark on a parameter.
#[derive(Serialize)]
#[serde(untagged)]
enum Remark {
    None(&'static str),
    Missing(String),
    Beyond(String),
}

impl Remark {
    fn text(&self) -> &str {
        match self {
            Self::None(text) => text,
            Self::Missing(text) | Self::Beyond(text) => text,
        }
    }
}

impl Data for DriveData {
    const FORM: &'static str = "jred-drive/1";
}

impl Makers {
    /// Reads the embedded table, of all makers or of one.
    ///
    /// # Errors
    /// No maker of this name.
    pub fn read(key: Option<&str>) -> Result<Self> {
        Self::parse(PARAMETERS, key)
    }

    fn parse(text: &str, key: Option<&str>) -> Result<Self> {
        let mut makers: Self =
            toml::from_str(text).map_err(|error| problem!("parameters of drives: {error}"))?;
        if let Some(key) = key {
            let known: Vec<String> = makers.maker.iter().map(|m| m.key.clone()).collect();
            makers.maker.retain(|maker| maker.key == key);
            if makers.maker.is_empty() {
                return Err(problem!(
                    help = format!("write one of: {}", known.join(", ")),
                    "there is no maker {}",
                    jred_file::plain::quoted(key)
                ));
            }
        }
        Ok(makers)
    }

    fn missing(&self, setting: Setting) -> String {
        let figure = self.figure.iter().find(|figure| figure.setting == setting);
        let cure = figure.map_or("", |figure| figure.missing.as_str());
        format!("not given; {cure}")
    }
}

/// A value as it is typed.
fn typed(value: f64, decimals: Option<i32>) -> f64 {
    let text = match decimals {
        Some(decimals) => {
            let scale = 10.0_f64.powi(decimals);
            return (value * scale).round() / scale + 0.0;
        }
        None => significant(value, DIGITS),
    };
    text.parse().unwrap_or(value) + 0.0
}

impl Parameter {
    fn data(&self, settings: &Settings, makers: &Makers) -> ParameterData {
        let asked = [self.setting, self.base];
        let mut given = asked.into_iter().flatten();
        let unknown = given.find(|s| settings.get(*s).is_none());
        let [value, base] = asked.map(|s| s.map_or(Some(1.0), |s| settings.get(s)));
        let value =
            (value.zip(base)).map(|(value, base)| typed(value / base * self.factor, self.decimals));
        let least = self.range.first().copied().unwrap_or(f64::NEG_INFINITY);
        let most = self.range.get(1).copied().unwrap_or(f64::INFINITY);
        let range = match self.range.as_slice() {
            [least, most] => format!("{} to {}", rounded(*least), whole(*most)),
            [least] => format!("from {}", rounded(*least)),
            _ => String::new(),
        };
        let beyond = value.filter(|value| !(least..=most).contains(value));
        let remark = match (unknown, beyond) {
            (Some(setting), _) => Remark::Missing(makers.missing(setting)),
            (None, Some(value)) => Remark::Beyond(format!(
                "{} is beyond the range {range}: choose another motor or gear ratio, or set the nearest value and check the motion",
                whole(value)
            )),
            _ => Remark::None(""),
        };
        ParameterData {
            number: self.number.clone(),
            name: self.name.clone(),
            value: value.filter(|_| beyond.is_none()),
            unit: self.unit.clone(),
            range,
            remark,
        }
    }
}

/// The part that sets the torque limit.
fn limit_words(settings: &Settings) -> String {
    let by = match settings.limited_by {
        LimitedBy::Peak => "peak torque of motor and amplifier",
        LimitedBy::Gearbox => "T2B/i of the gearbox",
        LimitedBy::Cycle => "largest torque of the cycle, above T2B/i of the gearbox",
    };
    let unknown = "; the peak torque of motor and amplifier is not given";
    format!("{by}{}", if settings.peak_known { "" } else { unknown })
}

/// A number with all its digits.
fn whole(value: f64) -> String {
    format!("{value}")
}

impl DriveView<'_> {
    fn data(&self) -> DriveData {
        let Self {
            settings, makers, ..
        } = *self;
        let figures = makers.figure.iter().map(|figure| {
            let value = settings.get(figure.setting);
            FigureData {
                setting: figure.setting,
                name: figure.name.clone(),
                value,
                shown: (
                    value.map(|value| typed(value * figure.factor, figure.decimals)),
                    figure.unit.clone(),
                ),
                remark: match (value, figure.setting) {
                    (None, setting) => makers.missing(setting),
                    (Some(_), Setting::TorqueLimit) => limit_words(settings),
                    _ => String::new(),
                },
            }
        });
        let each = makers.maker.iter().map(|maker| MakerData {
            key: maker.key.clone(),
            name: maker.name.clone(),
            source: maker.source.clone(),
            parameters: (maker.parameters.iter())
                .map(|parameter| parameter.data(settings, makers))
                .collect(),
        });
        let each: Vec<MakerData> = each.collect();
        DriveData {
            drive: self.drive.to_owned(),
            holds: self.holds,
            warnings: self.warnings(&each),
            figures: figures.collect(),
            makers: each,
        }
    }

    fn warnings(&self, makers: &[MakerData]) -> Vec<String> {
        let get = |setting| self.settings.get(setting);
        let mut warnings = Vec::new();
        if !self.holds {
            warnings
                .push("this drive violates a rule: `jred size FILE --full` names it".to_owned());
        }
        let torques = get(Setting::TorqueLimit).zip(get(Setting::CyclePeakTorque));
        if let Some((limit, peak)) = torques.filter(|(limit, peak)| peak > limit) {
            warnings.push(format!(
                "the cycle takes {} N m, more than the torque limit, {} N m: choose a stronger drive, or a slower motion",
                significant(peak, DIGITS),
                significant(limit, DIGITS)
            ));
        }
        let rotor = get(Setting::RotorInertia).unwrap_or(0.0);
        let inertias = get(Setting::LeastLoadInertia).zip(get(Setting::LargestLoadInertia));
        if let Some((least, most)) = inertias {
            let times = (most + rotor) / (least + rotor);
            if times > UNEVEN {
                warnings.push(format!(
                    "the total inertia varies by the factor {} over the cycle: a constant inertia fits the mean only, and the speed loop is fastest where it is least; \
                     for the whole J(φ) see `jred export`",
                    significant(times, 3)
                ));
            }
        }
        if get(Setting::Direction).is_some_and(|direction| direction < 0.0) {
            warnings.push(
                "the drive train reverses: the motor turns against the drive link; positions and torques have the motor's sign, \
                 so reverse the polarity (CiA 402: 192 in 0x607E) only where the controller gives those of the drive link"
                    .to_owned(),
            );
        }
        for maker in makers {
            warnings.extend(maker.parameters.iter().filter_map(|p| match &p.remark {
                Remark::Beyond(fault) => Some(format!("{} {}: {fault}", maker.name, p.number)),
                Remark::None(_) | Remark::Missing(_) => None,
            }));
        }
        warnings
    }

    /// The figures at the motor shaft, and the parameters of each maker.
    pub fn answer(&self) -> Answer<'static> {
        let data = self.data();
        let title = format!("{}: parameters of the drive {}", self.title, self.drive);
        let mut answer = Answer::new(self.title, &data).titled(title);
        for warning in &data.warnings {
            answer.warning(warning.clone());
        }
        let value = |value: Option<f64>| value.map_or(Cell::Empty, |v| Cell::Text(whole(v)));
        answer.heading("figures at the motor shaft");
        answer.table(Reading {
            columns: ["figure", "value", "unit", "remark"]
                .map(str::to_owned)
                .into(),
            kinds: vec![
                ColumnKind::Words,
                ColumnKind::Quantity,
                ColumnKind::Words,
                ColumnKind::Words,
            ],
            rows: (data.figures.iter())
                .map(|f| {
                    let words = [&f.shown.1, &f.remark].map(|text| text.as_str().into());
                    let [unit, remark] = words;
                    vec![f.name.as_str().into(), value(f.shown.0), unit, remark]
                })
                .collect(),
            whole: 3,
            ..Reading::default()
        });
        let heads = ["maker", "parameter", "name", "value", "unit"];
        let mut csv = csv_line(heads.into_iter().map(Cell::from));
        for maker in &data.makers {
            answer.heading(maker.name.clone());
            let rows = maker.parameters.iter().map(|p| {
                let [number, name, unit, range] =
                    [&p.number, &p.name, &p.unit, &p.range].map(|t| t.as_str().into());
                vec![
                    number,
                    name,
                    value(p.value),
                    unit,
                    range,
                    p.remark.text().into(),
                ]
            });
            let columns = ["parameter", "name", "value", "unit", "range", "remark"];
            answer.table(Reading {
                columns: columns.map(str::to_owned).into(),
                kinds: [
                    &[ColumnKind::Words; 2][..],
                    &[ColumnKind::Quantity],
                    &[ColumnKind::Words; 3],
                ]
                .concat(),
                rows: rows.collect(),
                whole: 3,
                ..Reading::default()
            });
            answer.sentence(format!("source: {}", maker.source));
            for p in &maker.parameters {
                let number = p.value.map_or(Cell::Empty, Cell::from);
                let words = [&maker.key, &p.number, &p.name].map(|t| Cell::from(t.as_str()));
                csv += &csv_line(words.into_iter().chain([number, p.unit.as_str().into()]));
            }
        }
        answer.csv(csv);
        answer
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [&str; 5] = ["cia402", "ax8000", "sigma-7", "akd", "ax5000"];

    #[test]
    fn every_maker_is_read_by_its_word() {
        let all = Makers::read(None).unwrap();
        let keys: Vec<&str> = all.maker.iter().map(|maker| maker.key.as_str()).collect();
        assert_eq!(keys, ALL);
        for key in ALL {
            assert_eq!(Makers::read(Some(key)).unwrap().maker.len(), 1);
        }
        let fault = Makers::read(Some("nobody")).unwrap_err().to_string();
        assert!(fault.contains("there is no maker \"nobody\""), "{fault}");
    }

    /// Every parameter has a figure with words for the case that it is unknown, a source and an ordered range; no parameter is there twice.
    #[test]
    fn parameters_are_complete() {
        let all = Makers::read(None).unwrap();
        for maker in &all.maker {
            assert!(!maker.source.is_empty());
            let mut numbers: Vec<_> = maker.parameters.iter().map(|p| &p.number).collect();
            numbers.sort();
            numbers.dedup();
            assert_eq!(numbers.len(), maker.parameters.len(), "{}", maker.name);
            for p in &maker.parameters {
                assert!(p.range.is_sorted() && p.range.len() <= 2, "{}", p.number);
                for setting in [p.setting, p.base].into_iter().flatten() {
                    assert!(all.figure.iter().any(|f| f.setting == setting));
                }
            }
        }
    }

    #[test]
    fn a_word_that_no_parameter_has_is_refused() {
        let wrong = format!("{PARAMETERS}\n[[maker]]\nkey = 1\n");
        assert!(Makers::parse(&wrong, None).is_err());
        let wrong = PARAMETERS.replacen("setting = \"rated-torque\"", "setting = \"wrong\"", 1);
        assert!(Makers::parse(&wrong, None).is_err());
    }

    #[test]
    fn values_are_rounded_as_typed() {
        assert_eq!(typed(3269.23, Some(0)).to_string(), "3269");
        assert_eq!(typed(0.012_345_6, None).to_string(), "0.01235");
        assert_eq!(typed(-0.2, Some(0)).to_string(), "0");
    }
}
