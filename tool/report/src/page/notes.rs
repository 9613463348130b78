//! Texts of the report: result, self-check, assumptions, sources.

use jred_analysis::duty::Duty;
use jred_file::model::rules::RuleVerdict;
use jred_file::number::rounding::{cleared, rounded, shown};
use jred_sizing::judge::Assessment;
use jred_sizing::select::size::Selection;

use crate::list::listing::violations;

/// The answer in HTML, the one part of the page built by hand.
pub(super) fn answer(best: &Assessment, selection: &Selection) -> String {
    let all = selection.fit.len() + selection.refused.len();
    let motor = best.drive.motor;
    let gearbox = best
        .drive
        .gearbox
        .map_or("directly coupled".to_owned(), |g| {
            format!("with {} {} (i = {})", g.maker, g.model, rounded(g.ratio))
        });
    let amplifier = best.drive.amplifier;
    let amplifier = amplifier.map_or(String::new(), |a| format!(" on {} {}", a.maker, a.model));
    let drive = format!("{} {} {gearbox}{amplifier}", motor.maker, motor.model);
    let drive = escape(&drive);
    let resistor = best.resistor.map_or_else(String::new, |r| {
        format!(
            "<br>Brake resistor: {}, the smallest of the catalogue that fits.",
            escape(&format!("{} {} ({})", r.maker, r.model, r.key))
        )
    });
    let found = !selection.fit.is_empty();
    if found {
        let named = |verdict: RuleVerdict| {
            let checks = best.checks.iter().filter(|c| c.verdict == verdict);
            let names: Vec<&str> = checks.map(|c| c.rule).collect();
            names.join(", ")
        };
        let mut answer = match all {
            1 => format!("<b>{drive}</b><br>violates no rule.{resistor}"),
            _ => format!(
                "<b>{drive}</b><br>violates no rule and is the first of the {all} drives that were compared.{resistor}"
            ),
        };
        for (what, names) in [
            ("Warning", named(RuleVerdict::Warn)),
            ("Not checked, data missing", named(RuleVerdict::NotChecked)),
        ] {
            if !names.is_empty() {
                answer = format!("{answer}<br>{what}: {names}.");
            }
        }
        answer
    } else {
        let reasons = escape(&best.reasons());
        if all == 1 {
            return format!("<b>{drive}</b><br>violates a rule: {reasons}.");
        }
        let lines = violations(selection);
        let lines = lines
            .iter()
            .map(|line| format!("<br>{}", escape(line.trim())));
        format!(
            "<b>None of the {all} drives satisfies every rule.</b><br>{drive} comes closest: {reasons}.<br>Violated:{}",
            lines.collect::<String>()
        )
    }
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

/// Self-check, method, sources.
pub(super) fn notes(best: &Assessment, duty: &Duty) -> Vec<String> {
    let work = duty.integral(|i| i.terms.total() * i.omega);
    let kinetic = duty.integral(|i| (i.terms.acceleration + i.terms.velocity) * i.omega);
    let potential = duty.integral(|i| i.terms.potential * i.omega);
    let moved = duty.integral(|i| {
        let terms = &i.terms;
        let parts = [
            terms.acceleration,
            terms.velocity,
            terms.potential,
            terms.process,
        ];
        parts.iter().map(|part| part.abs()).sum::<f64>() * i.omega.abs()
    });
    let mut notes = vec![
        format!(
            "Self-check over the cycle: work at the drive link {} J, of which {} J into kinetic energy and {} J into \
             potential energy (zero for a closed cycle, unless a payload varies with the position).",
            rounded(cleared(work, moved)),
            shown(kinetic, moved),
            shown(potential, moved)
        ),
        "Losses: an efficiency divides the torque where power flows to the machine and multiplies it where power flows \
         back."
            .to_owned(),
        format!(
            "The cycle is evaluated exactly at {} instants. Integrals are by Gauss-Kronrod quadrature, with panels halved \
             until the error is known to be small; peaks between the instants are included.",
            duty.instants.len()
        ),
        "Share of mean square: mean of (part × whole) over mean of (whole × whole); the shares add up to 100 %. A \
         negative share reduces the RMS."
            .to_owned(),
    ];
    let drive = &best.drive;
    let mut source = |model: &str, source: &str| {
        notes.push(format!("Source of {model}: {source}"));
    };
    source(&drive.motor.model, &drive.motor.source);
    if let Some(gearbox) = drive.gearbox {
        source(&gearbox.model, &gearbox.source);
    }
    if let Some(amplifier) = drive.amplifier {
        source(&amplifier.model, &amplifier.source);
    }
    notes.extend(best.warnings().map(|said| format!("Warning: {said}.")));
    notes
}
