//! The DC bus as JSON.

use schemars::JsonSchema;
use serde::Serialize;

use super::{not_checked, words};
use crate::answer::schema::Data;
use jred_file::model::rule::Sense;
use jred_sizing::bus::analysis::BusAnalysis;
use jred_sizing::bus::axes::{Bounds, WorstPhases};
use jred_sizing::bus::cure::{Bound, Change, Cure};
use jred_sizing::bus::curve::PowerCurve;
use jred_sizing::bus::need::Need;
use jred_sizing::bus::period::{Common, LOOKED_AT, MOST_CYCLES};
use jred_sizing::bus::store::BusFigures;
use jred_sizing::bus::verdict::BusQuantity;

impl Data for BusData<'_> {
    const FORM: &'static str = "jred-bus/1";
}

/// The JSON of `jred bus`; units are in the names.
#[derive(Serialize, JsonSchema)]
pub(crate) struct BusData<'a> {
    /// The axes.
    axes: Vec<AxisData<'a>>,
    /// The common period; none: none is searched.
    #[serde(rename = "period [s]")]
    period: Option<f64>,
    /// The search for a common period.
    #[serde(rename = "common period")]
    common: CommonData,
    /// All axes in step.
    #[serde(rename = "in step")]
    in_step: Option<BusFigures>,
    /// The worst phases.
    worst: Option<WorstData<'a>>,
    /// The phases that leave most room.
    #[serde(rename = "most room")]
    calmest: Option<&'a WorstPhases>,
    /// Bounds for any phases.
    bounds: Bounds,
    /// Mean power that one bus saves over a bus for each axis.
    #[serde(rename = "saved by sharing [W]")]
    saved: Option<f64>,
    /// The shortage of the brake resistor.
    #[serde(rename = "brake resistor lacks")]
    lacks: MissingFigures,
    /// The brake resistor that is needed.
    #[serde(rename = "brake resistor needed")]
    need: Option<Need>,
    /// A brake resistor of the catalogue that is suitable.
    proposal: Option<&'a str>,
    /// The brake resistor chosen from the catalogue.
    #[serde(rename = "brake resistor chosen")]
    chosen: Option<&'a str>,
    /// Why no brake resistor can work.
    conflict: Option<Conflict>,
    /// The checks.
    checks: Vec<CheckRow>,
    /// Checks without data.
    #[serde(rename = "not checked")]
    not_checked: Vec<String>,
    /// Data that are missing.
    #[serde(rename = "not known")]
    not_known: Vec<UnknownFigure>,
    /// Changes, any one of which is sufficient.
    cures: Vec<CureData<'a>>,
    /// Whether every check is satisfied.
    holds: bool,
}

#[derive(Serialize, JsonSchema)]
struct AxisData<'a> {
    /// Title of the machine.
    title: &'a str,
    /// Name of the drive.
    drive: &'a str,
    /// Whether the drive violates no rule.
    holds: bool,
    /// Duration of its cycle.
    #[serde(rename = "period [s]")]
    period: f64,
    /// Energy that it draws in a cycle.
    #[serde(rename = "drawn [J]")]
    drawn: f64,
    /// Energy that it feeds back in a cycle.
    #[serde(rename = "fed back [J]")]
    back: f64,
    /// Largest power drawn.
    #[serde(rename = "peak drawn [W]")]
    peak_drawn: f64,
    /// Largest power fed back.
    #[serde(rename = "peak fed back [W]")]
    peak_back: f64,
}

#[derive(Serialize, JsonSchema)]
struct CommonData {
    /// searched, too long, or none.
    kind: &'static str,
    /// The common period.
    #[serde(rename = "period [s]")]
    period: Option<f64>,
    /// Cycles of each axis in it.
    cycles: Option<Vec<u32>>,
    /// The most cycles that are searched.
    #[serde(rename = "most cycles")]
    most: u32,
}

#[derive(Serialize, JsonSchema)]
struct WorstData<'a> {
    /// Phases with the highest voltage.
    voltage: &'a WorstPhases,
    /// Phases with the highest mean power of the brake resistor.
    resistor: &'a WorstPhases,
    /// Phases with its highest peak power.
    peak: &'a WorstPhases,
    /// Phases with its largest pulse.
    pulse: &'a WorstPhases,
    /// Whether no worse phases exist.
    exhaustive: bool,
}

#[derive(Default, Serialize, JsonSchema)]
#[serde(default)]
struct MissingFigures {
    #[serde(rename = "mean [W]", skip_serializing_if = "Option::is_none")]
    mean: Option<f64>,
    #[serde(rename = "peak [W]", skip_serializing_if = "Option::is_none")]
    peak: Option<f64>,
    #[serde(rename = "pulse [J]", skip_serializing_if = "Option::is_none")]
    pulse: Option<f64>,
    #[serde(rename = "resistance [Ohm]", skip_serializing_if = "Option::is_none")]
    resistance: Option<f64>,
}

#[derive(Serialize, JsonSchema)]
struct Conflict {
    /// Keys of `[supply]`, any one of which resolves it.
    #[serde(rename = "any of")]
    keys: Vec<&'static str>,
    /// The reason.
    words: String,
}

#[derive(Serialize, JsonSchema)]
struct CheckRow {
    /// Name.
    check: &'static str,
    /// Value, in `unit`; none: unbounded or unknown.
    value: Option<f64>,
    /// Limit, in `unit`.
    limit: Option<f64>,
    /// Whether the value must be at least the limit; otherwise at most.
    #[serde(rename = "at least")]
    at_least: bool,
    /// Unit.
    unit: &'static str,
    /// Whether it is satisfied; none: not checked.
    holds: Option<bool>,
}

#[derive(Serialize, JsonSchema)]
struct UnknownFigure {
    /// The figure.
    figure: &'static str,
    /// Lists of keys of `[supply]`: all keys of any one list give it.
    #[serde(rename = "any of")]
    keys: &'static [&'static [&'static str]],
}

#[derive(Serialize, JsonSchema)]
struct CureData<'a> {
    /// Keys to change, all of them.
    changes: Vec<ChangeData>,
    /// Phases of the axes with this cure.
    #[serde(rename = "phases [s]")]
    phases: Option<&'a [f64]>,
    /// The cure in words.
    words: String,
}

#[derive(Serialize, JsonSchema)]
struct ChangeData {
    /// Key of `[supply]`.
    key: &'static str,
    /// Least value.
    #[serde(rename = "at least")]
    least: Option<f64>,
    /// Largest value.
    #[serde(rename = "at most")]
    most: Option<f64>,
    /// Unit.
    unit: &'static str,
}

pub(crate) fn data(bus: &BusAnalysis) -> BusData<'_> {
    let open = bus.open();
    let mut lacks = MissingFigures::default();
    for (judged, by) in bus.lacks() {
        let place = match judged {
            BusQuantity::Mean => &mut lacks.mean,
            BusQuantity::Peak => &mut lacks.peak,
            BusQuantity::Pulse => &mut lacks.pulse,
            _ => &mut lacks.resistance,
        };
        *place = Some(by);
    }
    BusData {
        axes: axes(bus),
        period: bus.power.as_ref().map(PowerCurve::period),
        common: common(bus),
        in_step: bus.in_step,
        worst: (bus.worst.as_ref()).map(|[voltage, resistor, peak, pulse]| WorstData {
            voltage,
            resistor,
            peak,
            pulse,
            exhaustive: bus.axes.len() <= 3,
        }),
        calmest: bus.calmest.as_ref(),
        bounds: bus.bounds,
        saved: bus.saved(),
        lacks,
        need: bus.need,
        proposal: bus.proposal.as_deref(),
        chosen: bus.chosen.as_deref(),
        conflict: bus.conflict().map(|conflict| Conflict {
            keys: conflict.keys().to_vec(),
            words: words::conflict(&conflict),
        }),
        checks: checks(bus),
        not_checked: (open.iter()).map(|open| not_checked(bus, open)).collect(),
        not_known: (open.iter().filter(|o| !o.keys.is_empty()))
            .map(|o| UnknownFigure {
                figure: o.figure,
                keys: o.keys,
            })
            .collect(),
        cures: bus.cures.iter().map(cure).collect(),
        holds: bus.holds(),
    }
}

fn checks(bus: &BusAnalysis) -> Vec<CheckRow> {
    let all = bus.checks().into_iter();
    all.map(|check| CheckRow {
        check: check.name(),
        value: check.figure.is_finite().then_some(check.figure),
        limit: check.limit,
        at_least: check.sense() == Sense::AtLeast,
        unit: check.unit(),
        holds: check.holds(),
    })
    .collect()
}

fn axes(bus: &BusAnalysis) -> Vec<AxisData<'_>> {
    let axes = bus.axes.iter().map(|axis| {
        let [drawn, back] = axis.curve.energies();
        let [least, most] = axis.curve.extremes();
        AxisData {
            title: &axis.title,
            drive: &axis.drive,
            holds: axis.holds,
            period: axis.curve.period(),
            drawn,
            back,
            peak_drawn: most.max(0.0),
            peak_back: (-least).max(0.0),
        }
    });
    axes.collect()
}

fn common(bus: &BusAnalysis) -> CommonData {
    let (kind, period, cycles, most) = match bus.shared.common() {
        Common::Searched { period, cycles } => {
            ("searched", Some(period), Some(cycles), MOST_CYCLES)
        }
        Common::TooLong { period, cycles } => ("too long", Some(period), Some(cycles), MOST_CYCLES),
        Common::None => ("none", None, None, LOOKED_AT),
    };
    CommonData {
        kind,
        period: period.copied(),
        cycles: cycles.cloned(),
        most,
    }
}

fn cure(cure: &Cure) -> CureData<'_> {
    let change = |change: &Change| {
        let (least, most) = match change.bound {
            Bound::AtLeast(value) => (Some(value), None),
            Bound::AtMost(value) => (None, Some(value)),
        };
        ChangeData {
            key: change.key,
            least,
            most,
            unit: change.unit,
        }
    };
    CureData {
        changes: cure.changes.iter().map(change).collect(),
        phases: cure.phases.as_deref(),
        words: words::cure(cure),
    }
}
