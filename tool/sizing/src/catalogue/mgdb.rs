//! Reader for files of the Motor-Gearbox Database (github.com/ekrimsk/MGDB) in their original form: figures in SI, columns by name, "inf", "nan" or
//! an empty cell if the data sheet gives no value. docs/catalogue.md has the mapping.

use std::ops::Range;

use jred_file::plain;
use jred_file::text::csv::{self, CsvTable};
use jred_file::text::problem::Problem;

use super::column::Kind;
use super::entry::Entry;
use super::fault::{Remarks, Text};
use super::gearbox::Gearbox;
use super::lists::Listing;
use super::motor::{Motor, Thermal, Winding};
use crate::catalogue::Commutation;

/// Efficiency per stage if the database gives none: 608 of this maker's 613 gearboxes with a given efficiency have at least this one.
const STAGE_EFFICIENCY: f64 = 0.87;

/// Whether a header is in the format of the database.
pub(super) fn is_header(text: &str) -> bool {
    let titles: Vec<&str> = csv::header_of(text).split(',').map(str::trim).collect();
    ["key", "manufacturer", "ID"]
        .iter()
        .all(|t| titles.contains(t))
}

/// The rows of a file with their titles.
struct Sheet<'t> {
    name: &'t str,
    csv: CsvTable<'t>,
}

/// Plausible figures of a drive (SI); others are mistakes.
const RANGE: std::ops::RangeInclusive<f64> = 1e-15..=1e10;

impl Sheet<'_> {
    fn index(&self, title: &str) -> Option<usize> {
        self.csv.header().iter().position(|t| t == title)
    }

    fn word(&self, title: &str) -> &str {
        let index = self.index(title);
        index
            .and_then(|i| self.csv.row().get(i))
            .unwrap_or_default()
    }

    fn place(&self, title: &str) -> Range<usize> {
        self.csv.place(self.index(title).unwrap_or(0))
    }

    fn at_line(&self) -> String {
        format!("{}:{}", self.name, self.csv.line())
    }

    /// A value above zero; `None` if not given. A cell that is not a number counts as not given, with a warning.
    fn figure(&self, title: &str, remarks: &mut Remarks) -> Option<f64> {
        let word = self.word(title);
        if word.is_empty() {
            return None;
        }
        let value = word.parse::<f64>();
        // Infinity and NaN mean that the figure is not given.
        let wrong = |v: f64| v < 0.0 || v > 0.0 && v.is_finite() && !RANGE.contains(&v);
        if value.as_ref().map_or(true, |value| wrong(*value)) {
            remarks.add("cells that are not plausible numbers, treated as not given", || {
                format!(
                    "{}: {title} of \"{}\" is \"{}\", not a number from {:e} to {:e} or zero: treated as not given",
                    self.at_line(),
                    plain::cut(self.word("key")),
                    plain::cut(word),
                    RANGE.start(),
                    RANGE.end()
                )
            });
        }
        value.ok().filter(|value| RANGE.contains(value))
    }

    /// A value that every drive needs.
    fn needed(&self, title: &str) -> Result<f64, Problem> {
        let value = self.word(title).parse::<f64>().ok();
        value.filter(|v| RANGE.contains(v)).ok_or_else(|| {
            self.fault(
                title,
                "not a number in the range",
                format!(
                    "{title} is required in every row, in SI units, from {:e} to {:e}",
                    RANGE.start(),
                    RANGE.end()
                ),
            )
        })
    }

    fn fault(&self, title: &str, label: &'static str, help: String) -> Problem {
        let message = format!(
            "{title} of \"{}\" is \"{}\"",
            plain::cut(self.word("key")),
            plain::cut(self.word(title))
        );
        Problem::new(message)
            .at(self.place(title), label)
            .help(help)
    }

    fn key(&self) -> Result<String, Problem> {
        match self.word("key") {
            "" => Err(self.fault(
                "key",
                "required in every row",
                "give the row a key".to_owned(),
            )),
            key => Ok(key.to_owned()),
        }
    }

    fn source(&self) -> String {
        format!(
            "Motor-Gearbox Database, {}, row {}",
            self.name,
            self.word("key")
        )
    }
}

/// An entry with its line and position, or the fault of its row.
pub(super) type ReadRow = Result<(Entry, usize, Range<usize>), Problem>;

/// The rows of a file of motors or of gearboxes.
pub(super) fn entries(
    text: &Text,
    kind: Kind,
    remarks: &mut Remarks,
) -> Result<Vec<ReadRow>, Problem> {
    let mut sheet = Sheet {
        name: &text.name,
        csv: CsvTable::read(&text.text)?,
    };
    let mut rows = Vec::new();
    while let Some(row) = sheet.csv.advance() {
        let entry = row.and_then(|()| {
            Ok(if kind == Kind::Motors {
                Entry::Motor(Box::new(motor(&sheet, remarks)?), None)
            } else {
                Entry::Gearbox(Box::new(gearbox(&sheet, remarks)?))
            })
        });
        rows.push(entry.map(|entry| (entry, sheet.csv.line(), sheet.place("key"))));
    }
    Ok(rows)
}

fn motor(sheet: &Sheet, remarks: &mut Remarks) -> Result<Motor, Problem> {
    let mut figure = |title| sheet.figure(title, remarks);
    let torque_constant = figure("k_t");
    let rated_current = figure("I_nom");
    let no_load_current = figure("I_nl");
    let no_load_speed = figure("omega_nl");
    let voltage_constant = figure("k_e").or(torque_constant);
    let rated_torque = torque_constant.zip(rated_current).map(|(k, i)| k * i);
    // No-load torque of the motor.
    let lost = torque_constant.zip(no_load_current).map(|(k, i)| k * i);
    let coulomb = figure("coulomb_friction");
    let viscous = figure("viscous_friction");
    let friction = match (coulomb, viscous, lost, no_load_speed) {
        (Some(coulomb), None, Some(lost), Some(speed)) => {
            [coulomb, ((lost - coulomb) / speed).max(0.0)]
        }
        (None, None, Some(lost), _) => [lost, 0.0],
        _ => [coulomb.unwrap_or(0.0), viscous.unwrap_or(0.0)],
    };
    Ok(Motor {
        key: sheet.key()?,
        maker: sheet.word("manufacturer").replace('_', " "),
        model: sheet.word("ID").to_owned(),
        rated_torque,
        rated_speed: figure("max_cont_speed"),
        peak_torque: figure("max_int_torque"),
        max_speed: figure("max_int_speed"),
        max_power: figure("max_cont_power"),
        no_load_speed,
        rotor_inertia: sheet.needed("inertia")?,
        friction,
        winding: Winding {
            torque_constant,
            voltage_constant,
            resistance: figure("R"),
            inductance: figure("L"),
            rated_current,
            no_load_current,
            commutation: Commutation::Block,
            ..Winding::default()
        },
        thermal: Thermal {
            winding_resistance: figure("Rth1"),
            housing_resistance: figure("Rth2"),
            ..Thermal::default()
        },
        bus_voltage: figure("V"),
        mass: figure("mass"),
        from_maker: false,
        source: sheet.source(),
        ..Motor::default()
    })
}

fn gearbox(sheet: &Sheet, remarks: &mut Remarks) -> Result<Gearbox, Problem> {
    let ratio = sheet.needed("ratio")?;
    let reverses = match sheet.word("direction").parse::<f64>() {
        Ok(direction) => direction < 0.0,
        Err(_) if sheet.word("direction").is_empty() => false,
        Err(_) => {
            let help =
                "write 1 if output and input turn in the same direction, -1 if not".to_owned();
            return Err(sheet.fault("direction", "not a number", help));
        }
    };
    let mut figure = |title| sheet.figure(title, remarks);
    let stages = figure("stages").map(|n| n.round() as u32);
    let stated = figure("efficiency");
    let inertia = figure("inertia").unwrap_or(0.0);
    let [rated_torque, peak_torque] = ["max_cont_torque", "max_int_torque"].map(&mut figure);
    let mass = figure("mass");
    let efficiency = stated.unwrap_or_else(|| {
        remarks.add("gearboxes without an efficiency", || {
            format!(
                "{}: efficiency of \"{}\" not given; using {STAGE_EFFICIENCY} per stage",
                sheet.at_line(),
                sheet.word("key")
            )
        });
        STAGE_EFFICIENCY.powi(stages.unwrap_or(1) as i32)
    });
    if efficiency > 1.0 {
        let help = "a share from 0 to 1 is expected".to_owned();
        return Err(sheet.fault("efficiency", "above 1", help));
    }
    Ok(Gearbox {
        key: sheet.key()?,
        maker: sheet.word("manufacturer").replace('_', " "),
        model: sheet.word("ID").to_owned(),
        ratio,
        reverses,
        stages,
        rated_torque,
        peak_torque,
        inertia,
        efficiency,
        efficiency_assumed: stated.is_none(),
        back_efficiency: efficiency,
        mass,
        from_maker: false,
        source: sheet.source(),
        ..Gearbox::default()
    })
}

/// A compatibility file: no header; motor key, then gearbox keys.
pub(super) fn listings(text: &Text, mut take: impl FnMut(Result<Listing, Problem>)) {
    let mut table = CsvTable::without_header(&text.text);
    while let Some(row) = table.advance() {
        take(row.map(|()| {
            let at = table.place(0);
            let mut keys = table.row().iter().map(ToOwned::to_owned);
            Listing {
                at,
                motor: keys.next().unwrap_or_default(),
                gearboxes: Some(keys.filter(|key| !key.is_empty()).collect()),
                direct: true,
                amplifiers: None,
            }
        }));
    }
}
