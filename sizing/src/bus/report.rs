//! The answer of `jred bus` as text and CSV.

use std::fmt::Write as _;

use miette::{Result, miette};

use super::axes::Bounds;
use super::command::Answer;
use super::curve::PowerCurve;
use super::store::BusFigures;
use super::verdict::Judged;
use crate::cli::bus::Bus as Options;
use crate::columns::Columns;
use crate::output::Format;
use crate::rounding::short;

impl Answer {
    pub(super) fn text(&self, options: &Options) -> String {
        let mut text = self.axes_text();
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
            text += &self.line(figures, power);
        } else {
            let _ = writeln!(
                text,
                "Judged by what holds at any phases: {}.",
                self.no_search()
            );
        }
        text += &self.worst_text();
        let Bounds {
            drawn,
            back,
            highest,
            resistor,
        } = self.bounds;
        let voltage = if highest.is_infinite() && self.data.capacitance.is_none() {
            "bus voltage not known".to_owned()
        } else {
            format!("bus at most {} V", volts(highest))
        };
        let _ = writeln!(
            text,
            "At any phases: peak drawn at most {} W, peak fed back at most {} W, {voltage}, a brake resistor at most {} W mean",
            short(drawn),
            short(back),
            short(resistor),
        );
        if let Some(saved) = self.saved() {
            let _ = writeln!(
                text,
                "Against a bus for each axis, with 1/{} of the capacitance and a brake resistor like this, one bus saves {} W mean in step",
                self.axes.len(),
                short(saved)
            );
        }
        text += &self.resistor_text(options);
        if self.data.capacitance.is_none() && self.data.resistor.is_some() {
            text += "Capacitance of the DC bus not known (capacitance in [supply]): all that comes back goes into the brake resistor\n";
        }
        text.push('\n');
        text + &self.verdicts(options) + &self.cures_text()
    }

    fn axes_text(&self) -> String {
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
                "{}. {}: {}{broken}\n   cycle {} s, draws {} J (peak {} W), feeds back {} J (peak {} W)",
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
        text
    }

    fn worst_text(&self) -> String {
        let mut text = String::new();
        let (Some(worst), Some(power)) = (&self.worst, &self.power) else {
            return text;
        };
        if self.axes.len() < 2 {
            return text;
        }
        let names = [
            "Phases with the highest voltage",
            "Phases that burn most",
            "Phases with the largest power burnt",
            "Phases with the largest pulse",
        ];
        let count = if self.data.resistor.is_some() { 4 } else { 1 };
        for (k, (name, phases)) in names.into_iter().zip(worst).enumerate().take(count) {
            // Phases that are the worst in several ways are printed once.
            let same = |other: &&super::axes::Worst| other.phases == phases.phases;
            if worst[..k].iter().any(|other| same(&other)) {
                continue;
            }
            text += name;
            for (other, also) in names.iter().zip(worst).take(count).skip(k + 1) {
                if same(&also) {
                    let rest = other.trim_start_matches("Phases ");
                    let _ = write!(text, " and {}", rest.trim_start_matches("with "));
                }
            }
            let _ = write!(text, ", {}: ", shown(&phases.phases));
            text += &self.line(&phases.figures, power);
        }
        if self.axes.len() > 3 {
            text += "More than three axes: searched from several starts, a worse phase may exist; the bounds hold.\n";
        }
        text
    }

    /// What the brake resistor lacks, or which one is needed.
    fn resistor_text(&self, options: &Options) -> String {
        let mut text = String::new();
        let lacks = self.lacks(options);
        if !lacks.is_empty() {
            let each: Vec<String> = lacks
                .iter()
                .map(|(what, by)| {
                    let (unit, of) = match what {
                        Judged::Mean => ("W", "mean power"),
                        Judged::Peak => ("W", "peak power"),
                        Judged::Pulse => ("J", "energy of a pulse"),
                        _ => ("Ohm", "resistance"),
                    };
                    format!("{} {unit} {of}", short(*by))
                })
                .collect();
            let _ = writeln!(text, "The brake resistor lacks {}", each.join(", "));
        }
        if let Some(conflict) = self.conflict(options) {
            let _ = writeln!(text, "NO BRAKE RESISTOR DOES: {}", conflict.words());
        }
        if let Some(need) = &self.need {
            let proposal = match &self.proposal {
                Some(key) => format!("; {key} of the catalogue does"),
                None => "; the catalogue has none of which it is known".to_owned(),
            };
            let needs = if self.data.resistor.is_some() {
                "A brake resistor that does: "
            } else {
                "The bus needs a brake resistor of "
            };
            let _ = writeln!(text, "{needs}{}{proposal}", need.figures());
        }
        text
    }

    /// By how much the brake resistor misses what is asked of it.
    pub(super) fn lacks(&self, options: &Options) -> Vec<(Judged, f64)> {
        let failed = self.failed(options).into_iter();
        let own = failed.filter(|check| check.what != Judged::Voltage);
        own.filter_map(|check| Some((check.what, (check.figure - check.limit?).abs())))
            .collect()
    }

    /// A line for every check, and for every one that could not be done.
    fn verdicts(&self, options: &Options) -> String {
        let mut text = String::new();
        for check in &self.checks(options) {
            let verdict = match check.holds() {
                None => continue,
                Some(true) => "ok",
                Some(false) => "FAIL",
            };
            let limit = check.limit.map_or_else(
                || "any limit".to_owned(),
                |limit| format!("{} {}", short(limit), check.unit()),
            );
            let _ = writeln!(
                text,
                "{} {} against {limit}: {verdict}",
                check.name(),
                volts(check.figure)
            );
        }
        for open in self.open(options) {
            let _ = writeln!(text, "NOT CHECKED: {}: {}", open.figure, open.words);
        }
        text
    }

    fn cures_text(&self) -> String {
        let mut text = String::new();
        if !self.cures.is_empty() {
            text += "\nAny one of these would do:\n";
        }
        for cure in &self.cures {
            let _ = writeln!(text, "- {}", cure.words);
        }
        text
    }

    pub(super) fn csv(&self) -> Result<String> {
        let power = self.power.as_ref().ok_or_else(|| {
            miette!(
                help = "use --format table or json, which give bounds",
                "power and voltage over a common period cannot be written: {}",
                self.no_search()
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

    /// Voltage, supply and resistor in words.
    fn line(&self, figures: &BusFigures, power: &PowerCurve) -> String {
        let period = power.period();
        let bounded = figures.highest.is_finite();
        let voltage = if !bounded && self.data.capacitance.is_none() {
            "bus voltage not known".to_owned()
        } else {
            format!("bus up to {} V", volts(figures.highest))
        };
        let supply = if bounded {
            format!(
                "{} W mean",
                short((figures.supplied - figures.returned) / period)
            )
        } else {
            // All that comes back is drawn again, or nothing of it.
            let [drawn, back] = power.energies();
            format!(
                "{} to {} W mean",
                short((drawn - back).max(0.0) / period),
                short(drawn / period)
            )
        };
        let resistor = if self.data.resistor.is_some() {
            format!(
                ", brake resistor {} W mean, {} W peak, {} J a pulse",
                short(figures.burnt / period),
                short(figures.burnt_peak),
                short(figures.pulse),
            )
        } else if self.data.regenerative {
            format!(", {} W mean fed back", short(figures.returned / period))
        } else {
            ", no brake resistor".to_owned()
        };
        format!("{voltage}, supply {supply}{resistor}\n")
    }
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
