//! The identified machine against its design.

mod curves_file;
mod friction;
mod words;

use std::f64::consts::TAU;

use miette::{Report, miette};
use schemars::JsonSchema;
use serde::Serialize;

use crate::answer::Answer;
use crate::answer::schema::Data;
use crate::table::reading::Reading;
use jred_analysis::identify::{
    CurvePoint, Estimate, Fault, Identified, OTHER, Repair, Shaft, shift, without_mean,
};
use jred_file::model::machine::MachineFile;
use jred_file::number::rounding::{percent, short};
use jred_sizing::cell::Cell;

use words::of_log;
pub use words::{refusal, unreadable};

/// Rows between those of the table for reading.
const EVERY: usize = 30;

/// J is a constant above the design if the rest is less than this share of it; a smaller share of the design's maximum is a tolerance.
const REST: f64 = 0.25;
const ADDED: f64 = 0.02;

/// The design at an angle.
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
pub struct Designed {
    /// J (kg·m²).
    pub inertia: f64,
    /// U′ of weight and springs (N·m).
    pub potential_slope: f64,
    /// b (N·m·s/rad).
    pub viscous: f64,
    /// c (N·m).
    pub coulomb: f64,
}

/// V′ of the design as a log shows it: in one direction with the part of Coulomb friction that depends on the angle.
pub fn slopes(designed: &[Designed], direction: Option<f64>) -> Vec<f64> {
    let sign = direction.unwrap_or(0.0);
    let friction = without_mean(designed.iter().map(|at| at.coulomb)).into_iter();
    let friction = friction.chain(std::iter::repeat(0.0));
    let each = designed.iter().zip(friction);
    each.map(|(at, c)| at.potential_slope + sign * c).collect()
}

/// The result of one log.
#[derive(Clone, Debug)]
pub struct LogResult {
    /// Its name.
    pub name: String,
    /// Repaired faults of its rows.
    pub repairs: Vec<Repair>,
    /// The machine.
    pub found: Identified,
    /// The orders of cogging that were asked for.
    pub cogging: Vec<u32>,
    /// Counts of a turn of the encoder, if given.
    pub counts: Option<f64>,
    /// A count of the encoder at the drive link (rad), if known.
    pub encoder_step: Option<f64>,
    /// The signs that were turned.
    pub signs: Signs,
    /// The shaft that it is taken to be of.
    pub shaft: Shaft,
    /// Position of the log at φ = 0 (rad), at the shaft of the log.
    pub zero: f64,
    /// Signed ratio of that shaft to the drive link.
    pub ratio: f64,
}

impl LogResult {
    /// Whether a sign, a scale or the shaft is wrong, from which wrong curves follow.
    fn is_misread(&self) -> bool {
        let mut faults = self.found.faults.iter();
        faults.any(|fault| {
            matches!(
                fault,
                Fault::Reversed { .. }
                    | Fault::Mirrored
                    | Fault::Scale { .. }
                    | Fault::Shaft
                    | Fault::Torque { .. }
            )
        })
    }
}

/// Which signs of a log were turned.
#[derive(Clone, Copy, Debug, Default)]
pub struct Signs {
    /// Its torque.
    pub torque: bool,
    /// Its position.
    pub position: bool,
}

/// Results of all logs, and the design.
#[derive(Clone, Debug)]
pub struct IdentifyView<'a> {
    /// The machine.
    pub file: &'a MachineFile,
    /// The design at the angles of the identified curves.
    pub designed: Vec<Designed>,
    /// The logs.
    pub logs: Vec<LogResult>,
}

/// The JSON of `jred identify`.
#[derive(Serialize, JsonSchema)]
pub(crate) struct IdentifyData<'a> {
    /// The mean of the logs, with the bands of that mean: curves over the angle.
    curves: Vec<CurvePoint>,
    /// The design at the same angles.
    designed: &'a [Designed],
    /// Largest deviation of J from the design, as a share of the designed maximum.
    deviation: f64,
    /// Where it is (rad).
    deviation_at: f64,
    /// Largest difference of J between the logs, as a share of the maximum; null for one log.
    repeatability: Option<f64>,
    /// Each log.
    logs: Vec<&'a Identified>,
}

impl Data for IdentifyData<'_> {
    const FORM: &'static str = "jred-identify/1";
}

/// A deviation of a curve from the design.
struct Deviation {
    at: usize,
    share: f64,
}

impl IdentifyView<'_> {
    /// Whether a fault spoils a result.
    pub fn has_fault(&self) -> bool {
        let all = self.logs.iter().flat_map(|log| &log.found.faults);
        let other = deviation(&self.curves(), |p| p.inertia.value, &self.inertias());
        other.share.abs() > OTHER
            || all
                .into_iter()
                .any(|fault| !matches!(fault, Fault::Spikes { .. } | Fault::Cogging { .. }))
    }

    /// Refuses logs whose mean says nothing.
    ///
    /// # Errors
    /// Two logs have different zeros, or not the same directions.
    pub fn refuse_unlike(&self) -> Result<(), Report> {
        let Some((first, others)) = self.logs.split_first() else {
            return Ok(());
        };
        for other in others {
            if other.found.direction() != first.found.direction() {
                return Err(miette!(
                    help = "give logs with the same directions, best with both",
                    "{} and {} do not have the same directions: c of one direction has the mean load in it",
                    first.name,
                    other.name
                ));
            }
            if let Some(by) = shift(&other.found.curves, &first.found.curves) {
                return Err(miette!(
                    help = "identify each log alone, with its own --zero, or home the drive before each log",
                    "{} and {} have different zeros: their curves agree when those of the second are shifted by {} deg",
                    first.name,
                    other.name,
                    short(by.to_degrees())
                ));
            }
        }
        Ok(())
    }

    /// The mean of an estimate over the logs.
    fn mean(&self, of: impl Fn(&Identified) -> Estimate) -> Estimate {
        let count = self.logs.len().max(1) as f64;
        let all = || self.logs.iter().map(|log| of(&log.found));
        Estimate {
            value: all().map(|one| one.value).sum::<f64>() / count,
            band: all().map(|one| one.band * one.band).sum::<f64>().sqrt() / count,
        }
    }

    /// The mean curves.
    pub(crate) fn curves(&self) -> Vec<CurvePoint> {
        let at = |k: usize, of: fn(&CurvePoint) -> Estimate| {
            self.mean(|found| found.curves.get(k).map(of).unwrap_or_default())
        };
        let count = self.designed.len();
        let curve = |k: usize| CurvePoint {
            phi: k as f64 * TAU / count as f64,
            inertia: at(k, |point| point.inertia),
            inertia_slope: at(k, |point| Estimate {
                value: point.inertia_slope,
                band: 0.0,
            })
            .value,
            potential_slope: at(k, |point| point.potential_slope),
            coulomb: at(k, |point| point.coulomb),
        };
        (0..count).map(curve).collect()
    }

    /// V′ of the design as these logs show it.
    pub(crate) fn slopes(&self) -> Vec<f64> {
        let first = self.logs.first();
        slopes(&self.designed, first.and_then(|log| log.found.direction()))
    }

    fn inertias(&self) -> Vec<f64> {
        self.designed.iter().map(|design| design.inertia).collect()
    }

    /// The largest J of the design (kg·m²).
    fn largest_inertia(&self) -> f64 {
        let each = self.designed.iter().map(|design| design.inertia);
        each.fold(0.0, f64::max)
    }

    /// The largest difference of J between two logs, as a share of the maximum.
    fn repeatability(&self) -> Option<f64> {
        if self.logs.len() < 2 {
            return None;
        }
        let most = self.largest_inertia();
        let spread = (0..self.designed.len()).map(|k| {
            let all = self.logs.iter().filter_map(|log| log.found.curves.get(k));
            let [least, most] = all.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], point| {
                [a.min(point.inertia.value), b.max(point.inertia.value)]
            });
            most - least
        });
        Some(spread.fold(0.0, f64::max) / most)
    }

    /// The answer.
    pub fn answer(&self) -> Answer<'static> {
        let curves = self.curves();
        let misread = self.logs.iter().any(LogResult::is_misread);
        let inertia = deviation(&curves, |p| p.inertia.value, &self.inertias());
        let slopes = self.slopes();
        let potential = deviation(&curves, |p| p.potential_slope.value, &slopes);
        let data = IdentifyData {
            deviation: inertia.share,
            deviation_at: curves.get(inertia.at).map_or(0.0, |point| point.phi),
            repeatability: self.repeatability(),
            designed: &self.designed,
            logs: self.logs.iter().map(|log| &log.found).collect(),
            curves: curves.clone(),
        };
        let mut answer = Answer::new(
            format!("{}: identified from its log", self.file.title),
            &data,
        );
        answer.fact("J against the design", self.of_inertia(&curves, &inertia));
        if misread {
            // The fault of the log says why.
        } else if let Some(more) = self.added(&curves) {
            answer.warning(format!(
                "J has a constant of {} kg m^2 {} than the design: {}",
                short(more.abs()),
                if more > 0.0 { "more" } else { "less" },
                if more > 0.0 {
                    "is a rotor in the log that was not taken out (--rotor-inertia)?"
                } else {
                    "is --rotor-inertia too large, or the log of the drive link (--shaft link)?"
                }
            ));
        } else if inertia.share.abs() > OTHER {
            answer.warning(
                "this is not the machine of the design, or the log is of another shaft, in another unit or with another torque constant",
            );
        }
        if slopes.iter().any(|slope| *slope != 0.0) {
            let share = percent(potential.share.abs());
            let side = side(potential.share);
            let text = format!(
                "up to {share} of its largest value {side} at {} deg",
                potential.at * 360 / curves.len().max(1)
            );
            answer.fact("V' against the design", text);
        }
        if let Some(spread) = data.repeatability {
            let text = format!(
                "J differs by up to {} of its maximum between {} logs",
                percent(spread),
                self.logs.len()
            );
            answer.fact("repeatability", text);
        }
        self.friction(&mut answer);
        self.friction_over_the_turn(&curves, &mut answer);
        if !misread {
            self.negative_friction(&curves, &mut answer);
        }
        self.cogging_left_out(&mut answer);
        for log in &self.logs {
            if self.logs.len() > 1 {
                answer.heading(log.name.clone());
            }
            of_log(&mut answer, log);
        }
        answer.table(self.table(&curves));
        answer.csv(self.reduced_curves(&curves));
        answer
    }

    /// A constant by which J is above the design (kg·m²), if that is the deviation.
    fn added(&self, curves: &[CurvePoint]) -> Option<f64> {
        let both = || curves.iter().zip(&self.designed);
        let mean = both()
            .map(|(p, d)| p.inertia.value - d.inertia)
            .sum::<f64>()
            / curves.len().max(1) as f64;
        let rest = both().map(|(p, d)| (p.inertia.value - d.inertia - mean).abs() - p.inertia.band);
        let rest = rest.fold(0.0, f64::max);
        let size = mean.abs();
        let certain = both().all(|(p, _)| p.inertia.band < REST * size);
        (certain && rest < REST * size && size > ADDED * self.largest_inertia()).then_some(mean)
    }

    fn of_inertia(&self, curves: &[CurvePoint], deviation: &Deviation) -> String {
        let band = curves
            .iter()
            .map(|point| point.inertia.band)
            .fold(0.0, f64::max);
        let most = self.largest_inertia();
        let [found, designed] = [
            curves
                .get(deviation.at)
                .map_or(0.0, |point| point.inertia.value),
            self.designed
                .get(deviation.at)
                .map_or(0.0, |design| design.inertia),
        ];
        format!(
            "up to {} of its maximum {} at {} deg ({} instead of {} kg m^2); the 95 % band is up to ±{} wide",
            percent(deviation.share.abs()),
            side(deviation.share),
            deviation.at * 360 / curves.len().max(1),
            short(found),
            short(designed),
            percent(band / most.max(1e-300))
        )
    }

    fn table(&self, curves: &[CurvePoint]) -> Reading {
        let slopes = self.slopes();
        let rows = curves
            .iter()
            .zip(&self.designed)
            .zip(&slopes)
            .step_by(EVERY);
        let rows = rows.map(|((point, design), slope)| {
            [
                point.phi.to_degrees().round(),
                point.inertia.value,
                point.inertia.band,
                design.inertia,
                point.potential_slope.value,
                point.potential_slope.band,
                *slope,
            ]
            .map(Cell::Number)
            .into()
        });
        Reading {
            columns: [
                "phi [deg]",
                "J [kg m^2]",
                "band ±",
                "designed",
                "V' [N m]",
                "band ±",
                "designed",
            ]
            .map(str::to_owned)
            .into(),
            rows: rows.collect(),
            ..Reading::default()
        }
    }
}

fn deviation(curves: &[CurvePoint], found: fn(&CurvePoint) -> f64, designed: &[f64]) -> Deviation {
    let most = designed.iter().fold(0.0f64, |most, d| most.max(d.abs()));
    let each = curves.iter().zip(designed).enumerate();
    let each = each.map(|(at, (point, design))| Deviation {
        at,
        share: (found(point) - design) / most.max(1e-300),
    });
    each.max_by(|a, b| a.share.abs().total_cmp(&b.share.abs()))
        .unwrap_or(Deviation { at: 0, share: 0.0 })
}

const fn side(share: f64) -> &'static str {
    if share < 0.0 { "below" } else { "above" }
}
