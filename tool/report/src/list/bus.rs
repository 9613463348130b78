//! Axes on one DC bus.

mod data;
pub mod words;

use std::borrow::Cow;
use std::fmt::Write as _;

use jred_file::problem;
use jred_file::text::problem::Result;

use crate::answer::Answer;
use crate::table::output::Format;
use jred_file::number::columns::{Column, Columns};
use jred_file::number::rounding::short;
use jred_file::number::words::counted;
use jred_sizing::bus::analysis::BusAnalysis;
use jred_sizing::bus::axes::Bounds;
use jred_sizing::bus::curve::PowerCurve;
use jred_sizing::bus::store::BusFigures;
use jred_sizing::bus::verdict::{BusQuantity, Open};

pub(crate) use data::{BusData, data};

/// The verdict of every check, the cures, and the powers and voltages behind them.
///
/// # Errors
/// CSV of cycles without a common period that is searched.
pub fn answer(bus: &BusAnalysis, format: Format) -> Result<Answer<'static>> {
    let count = counted(bus.axes.len(), "axis", "axes");
    let mut answer = Answer::new(format!("DC bus of {count}"), &data(bus));
    blocks(bus, "all axes in step", &mut answer);
    if format == Format::Csv {
        answer.course(Cow::Owned(course(bus)?));
    }
    Ok(answer)
}

/// The blocks for reading; `together`: the phases of the axes as given.
pub(super) fn blocks(bus: &BusAnalysis, together: &str, answer: &mut Answer) {
    verdicts(bus, answer);
    resistor(bus, answer);
    if bus.data.capacitance.is_none() && bus.data.resistor.is_some() {
        answer.sentence(
            "DC bus capacitance not given (capacitance in [supply]): all regenerated energy goes into the brake resistor",
        );
    }
    if !bus.cures.is_empty() {
        answer.heading("any one of these changes is sufficient");
    }
    for cure in &bus.cures {
        answer.sentence(format!("- {}", words::cure(cure)));
    }
    in_step(bus, together, answer);
    worst(bus, answer);
    bounds(bus, answer);
    axes(bus, answer);
}

fn in_step(bus: &BusAnalysis, together: &str, answer: &mut Answer) {
    let (Some(figures), Some(power)) = (&bus.in_step, &bus.power) else {
        answer.heading("any phases");
        answer.sentence(format!(
            "checked against bounds that are valid for any phases: {}",
            words::no_search(bus)
        ));
        return;
    };
    let [least, most] = power.extremes();
    answer.heading(format!("{together}, period {} s", short(power.period())));
    answer.fact(
        "peak power",
        format!(
            "{} W drawn, {} W fed back",
            short(most.max(0.0)),
            short((-least).max(0.0))
        ),
    );
    answer.fact("bus", line(bus, figures, power));
}

fn bounds(bus: &BusAnalysis, answer: &mut Answer) {
    let Bounds {
        drawn,
        back,
        highest,
        resistor,
    } = bus.bounds;
    let voltage = if highest.is_infinite() && bus.data.capacitance.is_none() {
        "bus voltage not known".to_owned()
    } else {
        format!("bus at most {} V", volts(highest))
    };
    let [drawn, back, resistor] = [drawn, back, resistor].map(short);
    let taken = if bus.data.resistor.is_some() {
        "brake resistor"
    } else {
        "returned"
    };
    answer.fact(
        "any phases",
        format!(
            "peak drawn at most {drawn} W, peak fed back at most {back} W, {voltage}, {taken} at most {resistor} W mean"
        ),
    );
    if let Some(saved) = bus.saved() {
        answer.fact(
            "one bus",
            format!(
                "compared with a bus for each axis, with 1/{} of the capacitance and the same brake resistor, it saves {} W mean in step",
                bus.axes.len(),
                short(saved)
            ),
        );
    }
}

fn axes(bus: &BusAnalysis, answer: &mut Answer) {
    answer.heading("axes");
    for (k, axis) in bus.axes.iter().enumerate() {
        let [drawn, back] = axis.curve.energies();
        let [least, most] = axis.curve.extremes();
        let broken = if axis.holds {
            ""
        } else {
            "; violates a rule: see `jred size`"
        };
        answer.fact(
            format!("axis {}", k + 1),
            format!(
                "{}: {}; cycle {} s, draws {} J (peak {} W), feeds back {} J (peak {} W){broken}",
                axis.title,
                axis.drive,
                short(axis.curve.period()),
                short(drawn),
                short(most.max(0.0)),
                short(back),
                short((-least).max(0.0)),
            ),
        );
    }
    let cold = bus.axes.iter().filter(|axis| !axis.loses);
    let cold: Vec<&str> = cold.map(|axis| axis.drive.as_str()).collect();
    if !cold.is_empty() {
        answer.sentence(format!(
            "Without the losses of the winding, whose resistance the catalogue does not give: {}",
            cold.join("; ")
        ));
    }
}

fn worst(bus: &BusAnalysis, answer: &mut Answer) {
    let (Some(worst), Some(power)) = (&bus.worst, &bus.power) else {
        return;
    };
    if bus.axes.len() < 2 {
        return;
    }
    let names = [
        "the highest voltage",
        "the highest mean brake power",
        "the highest peak brake power",
        "the largest brake pulse",
    ];
    let count = if bus.data.resistor.is_some() { 4 } else { 1 };
    for (k, phases) in worst.iter().enumerate().take(count) {
        // Phases that are the worst for several goals are printed once.
        let same = |other: &jred_sizing::bus::axes::WorstPhases| other.phases == phases.phases;
        if worst[..k].iter().any(same) {
            continue;
        }
        let goals = names.into_iter().zip(worst).take(count).skip(k);
        let goals = goals.filter(|(_, other)| same(other));
        let goals: Vec<&str> = goals.map(|(name, _)| name).collect();
        answer.fact(
            "worst phases",
            format!(
                "{} with {}: {}",
                shown(&phases.phases),
                goals.join(" and "),
                line(bus, &phases.figures, power)
            ),
        );
    }
    if bus.axes.len() > 3 {
        answer.sentence(
            "More than three axes: the search starts from several points and may miss a worse phase; the bounds are always valid.",
        );
    }
}

/// The shortage of the brake resistor, or the one that is needed.
fn resistor(bus: &BusAnalysis, answer: &mut Answer) {
    let lacks = bus.lacks();
    if !lacks.is_empty() {
        let each: Vec<String> = lacks
            .iter()
            .map(|(what, by)| {
                let (unit, of) = match what {
                    BusQuantity::Mean => ("W", "mean power"),
                    BusQuantity::Peak => ("W", "peak power"),
                    BusQuantity::Pulse => ("J", "pulse energy"),
                    _ => ("Ohm", "resistance"),
                };
                format!("{} {unit} {of}", short(*by))
            })
            .collect();
        answer.fact("resistor", format!("is short of {}", each.join(", ")));
    }
    if let Some(conflict) = bus.conflict() {
        let words = words::conflict(&conflict);
        answer.fact(
            "resistor",
            format!("no brake resistor can work here: {words}"),
        );
    }
    let Some(need) = &bus.need else {
        return;
    };
    let figures = words::resistor(need);
    let says = if let Some(chosen) = &bus.chosen {
        format!("{chosen}, the smallest of the catalogue that fits; required: {figures}")
    } else {
        let mut says = format!("required: {figures}");
        let _ = match (&bus.proposal, &bus.misses) {
            (Some(key), _) => write!(says, "; {key} from the catalogue is suitable"),
            (None, Some(misses)) => write!(says, "; {}", words::misses(misses)),
            (None, None) => write!(says, "; the catalogue contains no brake resistors"),
        };
        says
    };
    answer.fact("resistor", says);
}

/// Each check, then those without data.
fn verdicts(bus: &BusAnalysis, answer: &mut Answer) {
    for check in &bus.checks() {
        let verdict = match check.holds() {
            None => continue,
            Some(true) => "ok",
            Some(false) => "FAIL",
        };
        let limit = check.limit.map_or_else(
            || "any limit".to_owned(),
            |limit| format!("{} {}", short(limit), check.unit()),
        );
        let figure = volts(check.figure);
        answer.fact(check.name(), format!("{figure} against {limit}: {verdict}"));
    }
    for open in bus.open() {
        answer.fact("not checked", not_checked(bus, &open));
    }
}

/// A check without data, and why.
fn not_checked(bus: &BusAnalysis, open: &Open) -> String {
    format!("{}: {}", open.figure, words::missing(bus, open))
}

/// Power and voltage over time with all axes in step.
///
/// # Errors
/// The cycles have no common period that is searched.
fn course(bus: &BusAnalysis) -> Result<Columns> {
    let power = bus.power.as_ref().ok_or_else(|| {
        problem!(
            help = "use --format table or json to get bounds",
            "there is no common period to write power and voltage over: {}",
            words::no_search(bus)
        )
    })?;
    let heads = [("t", "s"), ("power", "W"), ("voltage", "V")];
    let mut columns = Columns::new(heads.map(|(name, unit)| Column::other(name, unit)));
    let trace = bus.shared.bus().trace(power);
    let ends = std::iter::once(power.points().first().map_or(0.0, |p| p[1]))
        .chain(power.pieces().map(|(_, [_, b])| b));
    let mut t = 0.0;
    let lengths = std::iter::once(0.0).chain(power.pieces().map(|(h, _)| h));
    for (k, (p, h)) in ends.zip(lengths).enumerate() {
        t += h;
        columns.push([Some(t), Some(p), trace.get(k).map(|[_, volts]| *volts)]);
    }
    Ok(columns)
}

/// Voltage, supply and resistor as text.
fn line(bus: &BusAnalysis, figures: &BusFigures, power: &PowerCurve) -> String {
    let period = power.period();
    let bounded = figures.highest.is_finite();
    let voltage = if !bounded && bus.data.capacitance.is_none() {
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
        // Either all or none of the regenerated energy is reused.
        let [drawn, back] = power.energies();
        format!(
            "{} to {} W mean",
            short((drawn - back).max(0.0) / period),
            short(drawn / period)
        )
    };
    let resistor = if bus.data.resistor.is_some() {
        format!(
            ", brake resistor {} W mean, {} W peak, {} J a pulse",
            short(figures.burnt / period),
            short(figures.burnt_peak),
            short(figures.pulse),
        )
    } else if bus.data.regenerative {
        format!(", {} W mean fed back", short(figures.returned / period))
    } else {
        ", no brake resistor".to_owned()
    };
    format!("{voltage}, supply {supply}{resistor}")
}

/// A value that may be unbounded.
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
