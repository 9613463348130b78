//! The answer of `jred bus` as text and CSV.

use std::fmt::Write as _;

use miette::{Result, miette};

use crate::table::output;
use crate::table::output::Format;
use jred_machine::number::columns::{Column, Columns};
use jred_machine::number::rounding::short;
use jred_sizing::bus::answer::Answer;
use jred_sizing::bus::axes::Bounds;
use jred_sizing::bus::curve::PowerCurve;
use jred_sizing::bus::store::BusFigures;
use jred_sizing::bus::verdict::Judged;

/// The answer for reading.
pub fn text(answer: &Answer) -> String {
    let mut text = axes_text(answer);
    text.push('\n');
    if let (Some(figures), Some(power)) = (&answer.in_step, &answer.power) {
        let [least, most] = power.extremes();
        let _ = writeln!(
            text,
            "All axes in step, period {} s: peak drawn {} W, peak fed back {} W",
            short(power.period()),
            short(most.max(0.0)),
            short((-least).max(0.0)),
        );
        text += &line(answer, figures, power);
    } else {
        let _ = writeln!(
            text,
            "Checked against bounds that are valid for any phases: {}.",
            answer.no_search()
        );
    }
    text += &worst_text(answer);
    let Bounds {
        drawn,
        back,
        highest,
        resistor,
    } = answer.bounds;
    let voltage = if highest.is_infinite() && answer.data.capacitance.is_none() {
        "bus voltage not known".to_owned()
    } else {
        format!("bus at most {} V", volts(highest))
    };
    let _ = writeln!(
        text,
        "For any phases: peak drawn at most {} W, peak fed back at most {} W, {voltage}, brake resistor at most {} W mean",
        short(drawn),
        short(back),
        short(resistor),
    );
    if let Some(saved) = answer.saved() {
        let _ = writeln!(
            text,
            "Compared with a bus for each axis, with 1/{} of the capacitance and the same brake resistor, the common bus saves {} W mean in step",
            answer.axes.len(),
            short(saved)
        );
    }
    text += &resistor_text(answer);
    if answer.data.capacitance.is_none() && answer.data.resistor.is_some() {
        text += "DC bus capacitance not given (capacitance in [supply]): all regenerated energy goes into the brake resistor\n";
    }
    text.push('\n');
    text + &verdicts(answer) + &cures_text(answer)
}

fn axes_text(answer: &Answer) -> String {
    let mut text = String::new();
    for (k, axis) in answer.axes.iter().enumerate() {
        let [drawn, back] = axis.curve.energies();
        let [least, most] = axis.curve.extremes();
        let broken = if axis.holds {
            ""
        } else {
            ", violates a rule: see `jred size`"
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

fn worst_text(answer: &Answer) -> String {
    let mut text = String::new();
    let (Some(worst), Some(power)) = (&answer.worst, &answer.power) else {
        return text;
    };
    if answer.axes.len() < 2 {
        return text;
    }
    let names = [
        "the highest voltage",
        "the highest mean brake power",
        "the highest peak brake power",
        "the largest brake pulse",
    ];
    let count = if answer.data.resistor.is_some() { 4 } else { 1 };
    for (k, phases) in worst.iter().enumerate().take(count) {
        // Phases that are the worst for several goals are printed once.
        let same = |other: &jred_sizing::bus::axes::Worst| other.phases == phases.phases;
        if worst[..k].iter().any(same) {
            continue;
        }
        let goals = names.into_iter().zip(worst).take(count).skip(k);
        let goals = goals.filter(|(_, other)| same(other));
        let goals: Vec<&str> = goals.map(|(name, _)| name).collect();
        text += "Phases with ";
        text += &goals.join(" and ");
        let _ = write!(text, ", {}: ", shown(&phases.phases));
        text += &line(answer, &phases.figures, power);
    }
    if answer.axes.len() > 3 {
        text += "More than three axes: the search starts from several points and may miss a worse phase; the bounds are always valid.\n";
    }
    text
}

/// What the brake resistor lacks, or which one is needed.
fn resistor_text(answer: &Answer) -> String {
    let mut text = String::new();
    let lacks = answer.lacks();
    if !lacks.is_empty() {
        let each: Vec<String> = lacks
            .iter()
            .map(|(what, by)| {
                let (unit, of) = match what {
                    Judged::Mean => ("W", "mean power"),
                    Judged::Peak => ("W", "peak power"),
                    Judged::Pulse => ("J", "pulse energy"),
                    _ => ("Ohm", "resistance"),
                };
                format!("{} {unit} {of}", short(*by))
            })
            .collect();
        let _ = writeln!(text, "The brake resistor is short of {}", each.join(", "));
    }
    if let Some(conflict) = answer.conflict() {
        let _ = writeln!(
            text,
            "No brake resistor can work here: {}",
            conflict.words()
        );
    }
    if let (Some(need), Some(chosen)) = (&answer.need, &answer.chosen) {
        let _ = writeln!(
            text,
            "Brake resistor: {chosen}, the smallest of the catalogue that fits. The bus requires {}",
            need.figures()
        );
    } else if let Some(need) = &answer.need {
        let proposal = match (&answer.proposal, &answer.misses) {
            (Some(key), _) => format!("; {key} from the catalogue is suitable"),
            (None, Some(misses)) => format!("; {misses}"),
            (None, None) => "; the catalogue contains no brake resistors".to_owned(),
        };
        let needs = if answer.data.resistor.is_some() {
            "A suitable brake resistor: "
        } else {
            "The bus requires a brake resistor of "
        };
        let _ = writeln!(text, "{needs}{}{proposal}", need.figures());
    }
    text
}

/// One line for each check, including those without data.
fn verdicts(answer: &Answer) -> String {
    let mut text = String::new();
    for check in &answer.checks() {
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
    for open in answer.open() {
        let _ = writeln!(text, "not checked: {}: {}", open.figure, open.words);
    }
    text
}

fn cures_text(answer: &Answer) -> String {
    let mut text = String::new();
    if !answer.cures.is_empty() {
        text += "\nAny one of these changes is sufficient:\n";
    }
    for cure in &answer.cures {
        let _ = writeln!(text, "- {}", cure.words);
    }
    text
}

/// Power and voltage over time with all axes in step.
///
/// # Errors
/// The cycles have no common period that is searched.
pub fn csv(answer: &Answer) -> Result<String> {
    let power = answer.power.as_ref().ok_or_else(|| {
        miette!(
            help = "use --format table or json to get bounds",
            "there is no common period to write power and voltage over: {}",
            answer.no_search()
        )
    })?;
    let heads = [("t", "s"), ("power", "W"), ("voltage", "V")];
    let mut columns = Columns::new(heads.map(|(name, unit)| Column::other(name, unit)));
    let trace = answer.shared.bus().trace(power);
    let ends = std::iter::once(power.points().first().map_or(0.0, |p| p[1]))
        .chain(power.pieces().map(|(_, [_, b])| b));
    let mut t = 0.0;
    let lengths = std::iter::once(0.0).chain(power.pieces().map(|(h, _)| h));
    for (k, (p, h)) in ends.zip(lengths).enumerate() {
        t += h;
        columns.push([Some(t), Some(p), trace.get(k).map(|[_, volts]| *volts)]);
    }
    Ok(output::write(&columns, Format::Csv, ""))
}

/// Voltage, supply and resistor in words.
fn line(answer: &Answer, figures: &BusFigures, power: &PowerCurve) -> String {
    let period = power.period();
    let bounded = figures.highest.is_finite();
    let voltage = if !bounded && answer.data.capacitance.is_none() {
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
        // All or nothing of the regenerated energy is drawn again.
        let [drawn, back] = power.energies();
        format!(
            "{} to {} W mean",
            short((drawn - back).max(0.0) / period),
            short(drawn / period)
        )
    };
    let resistor = if answer.data.resistor.is_some() {
        format!(
            ", brake resistor {} W mean, {} W peak, {} J a pulse",
            short(figures.burnt / period),
            short(figures.burnt_peak),
            short(figures.pulse),
        )
    } else if answer.data.regenerative {
        format!(", {} W mean fed back", short(figures.returned / period))
    } else {
        ", no brake resistor".to_owned()
    };
    format!("{voltage}, supply {supply}{resistor}\n")
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
