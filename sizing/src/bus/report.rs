//! The answer of `jred bus` as text, CSV and JSON.

use std::fmt::Write as _;

use miette::{Result, miette};
use serde_json::json;

use super::axes::Bounds;
use super::command::Answer;
use super::curve::PowerCurve;
use super::store::BusFigures;
use crate::cli::bus::Bus as Options;
use crate::output::{Columns, Format, short};
use crate::rule::Sense;

impl Answer {
    pub(super) fn text(&self, options: &Options) -> String {
        let mut text = String::new();
        for (k, axis) in self.axes.iter().enumerate() {
            let [drawn, back] = axis.curve.energies();
            let [least, most] = axis.curve.extremes();
            let broken = if axis.holds {
                ""
            } else {
                ", breaks a rule: see `jred size`"
            };
            let _ = writeln!(
                text,
                "{}. {}: {}{broken}\n   cycle {} s, draws {} W s (peak {} W), feeds back {} W s (peak {} W)",
                k + 1,
                axis.title,
                axis.drive,
                short(axis.curve.period()),
                short(drawn),
                short(most.max(0.0)),
                short(back),
                short((-least).max(0.0)),
            );
        }
        text.push('\n');
        if let (Some(figures), Some(power)) = (&self.in_step, &self.power) {
            let [least, most] = power.extremes();
            let _ = writeln!(
                text,
                "All axes in step, period {} s: peak drawn {} W, peak fed back {} W",
                short(power.period()),
                short(most.max(0.0)),
                short((-least).max(0.0)),
            );
            text += &line(figures, power.period());
        } else {
            text += "The cycles have no common period: only bounds can be given.\n";
        }
        if let (Some([voltage, resistor]), Some(power)) = (&self.worst, &self.power) {
            let _ = write!(
                text,
                "Phases with the highest voltage, {}: ",
                shown(&voltage.phases)
            );
            text += &line(&voltage.figures, power.period());
            let _ = write!(text, "Phases that burn most, {}: ", shown(&resistor.phases));
            text += &line(&resistor.figures, power.period());
            if self.axes.len() > 3 {
                text += "More than three axes: searched from several starts, a worse phase may exist; the bounds hold.\n";
            }
        }
        let Bounds {
            drawn,
            back,
            highest,
            resistor,
        } = self.bounds;
        let _ = writeln!(
            text,
            "At any phases: peak drawn at most {} W, peak fed back at most {} W, bus at most {} V, brake resistor at most {} W mean",
            short(drawn),
            short(back),
            volts(highest),
            short(resistor),
        );
        if let Some(saved) = self.saved() {
            let _ = writeln!(
                text,
                "One bus instead of one for each axis saves {} W",
                short(saved)
            );
        }
        if let Some(need) = &self.need {
            let proposal = match &self.proposal {
                Some(key) => format!("; {key} of the catalogue does"),
                None => "; the catalogue has none of which it is known".to_owned(),
            };
            let words = need.words();
            let _ = writeln!(text, "The bus {words}{proposal}");
        }
        if self.data.capacitance.is_none() {
            text += match self.data.resistor {
                Some(_) => {
                    "Capacitance of the DC bus not known: all that comes back goes into the brake resistor\n"
                }
                None => "Capacitance of the DC bus not known\n",
            };
        }
        text.push('\n');
        text + &self.verdicts(options)
    }

    /// A line for every check, and for every one that could not be done.
    fn verdicts(&self, options: &Options) -> String {
        let mut text = String::new();
        let checks = self.checks(options);
        for check in &checks {
            let verdict = match check.holds() {
                None => continue,
                Some(true) => "ok",
                Some(false) => "FAIL",
            };
            let limit = check.limit.map_or_else(
                || "any limit".to_owned(),
                |limit| format!("{} {}", short(limit), check.unit),
            );
            let _ = writeln!(
                text,
                "{} {} against {limit}: {verdict}",
                check.name,
                volts(check.figure)
            );
        }
        for words in self.not_checked(options) {
            let _ = writeln!(text, "NOT CHECKED: {words}");
        }
        text
    }

    pub(super) fn csv(&self) -> Result<String> {
        let power = self.power.as_ref().ok_or_else(|| {
            miette!(
                help = "use --format table or json, which give bounds",
                "the cycles have no common period"
            )
        })?;
        let mut columns = Columns::new(["t [s]", "power [W]", "voltage [V]"]);
        let trace = self.shared.bus().trace(power);
        let ends = std::iter::once(power.points().first().map_or(0.0, |p| p[1]))
            .chain(power.pieces().map(|(_, [_, b])| b));
        let mut t = 0.0;
        let lengths = std::iter::once(0.0).chain(power.pieces().map(|(h, _)| h));
        for (k, (p, h)) in ends.zip(lengths).enumerate() {
            t += h;
            columns.push([Some(t), Some(p), trace.get(k).map(|[_, volts]| *volts)]);
        }
        Ok(columns.write(Format::Csv, ""))
    }

    pub(super) fn json(&self, options: &Options) -> serde_json::Value {
        let finite = |x: f64| x.is_finite().then_some(x);
        let axes = self.axes.iter().map(|axis| {
            let [drawn, back] = axis.curve.energies();
            let [least, most] = axis.curve.extremes();
            json!({
                "title": axis.title,
                "drive": axis.drive,
                "holds": axis.holds,
                "period [s]": axis.curve.period(),
                "drawn [J]": drawn,
                "fed back [J]": back,
                "peak drawn [W]": most.max(0.0),
                "peak fed back [W]": (-least).max(0.0),
            })
        });
        let checks = self.checks(options).into_iter().map(|check| {
            json!({
                "check": check.name,
                "value": finite(check.figure),
                "limit": check.limit,
                "at least": check.sense == Sense::AtLeast,
                "unit": check.unit,
                "holds": check.holds(),
            })
        });
        json!({
            "schema": "jred-bus/1",
            "axes": axes.collect::<Vec<_>>(),
            "period [s]": self.power.as_ref().map(PowerCurve::period),
            "in step": self.in_step,
            "worst": self.worst.as_ref().map(|[voltage, resistor]| json!({
                "voltage": voltage,
                "resistor": resistor,
                "exhaustive": self.axes.len() <= 3,
            })),
            "bounds": {
                "peak drawn [W]": self.bounds.drawn,
                "peak fed back [W]": self.bounds.back,
                "highest voltage [V]": finite(self.bounds.highest),
                "resistor mean [W]": self.bounds.resistor,
            },
            "saved by sharing [W]": self.saved(),
            "brake resistor needed": self.need,
            "proposal": self.proposal,
            "checks": checks.collect::<Vec<_>>(),
            "not checked": self.not_checked(options),
            "holds": self.holds(options),
        })
    }
}

/// Voltage and resistor in words.
fn line(figures: &BusFigures, period: f64) -> String {
    format!(
        "bus up to {} V, supply {} W mean, brake resistor {} W mean, {} W peak, {} W s a pulse\n",
        volts(figures.highest),
        short((figures.supplied - figures.returned) / period),
        short(figures.burnt / period),
        short(figures.burnt_peak),
        short(figures.pulse),
    )
}

/// A figure that may have no bound.
fn volts(x: f64) -> String {
    if x.is_infinite() {
        "without bound".to_owned()
    } else if x.is_nan() {
        "–".to_owned()
    } else {
        short(x)
    }
}

fn shown(phases: &[f64]) -> String {
    let phases: Vec<String> = phases
        .iter()
        .map(|phase| format!("{} s", short(*phase)))
        .collect();
    phases.join(", ")
}
