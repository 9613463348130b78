//! The report: one self-contained HTML page about a sizing.

use askama::Template;
use jred::{Error, TorqueTerms};

use crate::check::{Check, Verdict};
use crate::drive::{Judged, RPM};
use crate::duty::{Duty, Figures};
use crate::machine::MachineFile;
use crate::output::{Columns, rounded, short};
use crate::rules::Rules;
use crate::size::{RANKING, Selection};

mod extract;
mod figures;
mod mechanism;

pub use mechanism::mechanism_page;

/// Most ranked drives that the page lists.
const LISTED: usize = 25;

#[derive(Template)]
#[template(path = "report.html")]
struct Page {
    title: String,
    version: &'static str,
    file: String,
    found: bool,
    answer: String,
    cards: Vec<(&'static str, String)>,
    drive: String,
    checks: Vec<CheckRow>,
    assumptions: String,
    plane: String,
    torque_time: String,
    speed_time: String,
    drawing: String,
    inertia: String,
    reduced: String,
    terms: String,
    links: String,
    duty: Vec<(&'static str, Vec<String>)>,
    energy: String,
    fit_count: usize,
    all_count: usize,
    partly: usize,
    fit: Vec<FitRow>,
    fit_more: usize,
    ranking: &'static str,
    refused: Vec<(String, String)>,
    notes: Vec<String>,
}

struct CheckRow {
    rule: &'static str,
    value: String,
    limit: String,
    used: String,
    verdict: &'static str,
    class: &'static str,
    note: String,
}

struct FitRow {
    rank: usize,
    motor: String,
    gearbox: String,
    ratio: String,
    power: String,
    rms: String,
    peak: String,
    lambda: String,
    remarks: String,
}

/// The page for a selection. It is about the best drive, or, if none holds, the one that misses by least.
///
/// # Errors
/// Those of the machine; `None` if the catalogue was empty.
pub fn page(
    name: &str,
    file: &MachineFile,
    duty: &Duty,
    selection: &Selection,
) -> Result<Option<String>, Error> {
    let found = !selection.fit.is_empty();
    let Some(best) = selection.fit.first().or(selection.refused.first()) else {
        return Ok(None);
    };
    let rules = &file.rules;
    let motor = &best.duty;
    let page = Page {
        title: file.title.clone(),
        version: env!("CARGO_PKG_VERSION"),
        file: name.to_owned(),
        found,
        answer: answer(best, found),
        cards: vec![
            ("cycle", format!("{} s", rounded(duty.duration))),
            ("RMS torque", format!("{} N m", short(motor.torque.rms))),
            ("peak torque", format!("{} N m", short(motor.torque.peak()))),
            (
                "largest speed",
                format!("{} rpm", short(motor.speed.peak() / RPM)),
            ),
            (
                "inertia ratio λ",
                format!(
                    "{} to {}",
                    short(motor.inertia_ratio.min),
                    short(motor.inertia_ratio.max)
                ),
            ),
            (
                "regenerative energy",
                format!("{} J per cycle", short(motor.regenerative_energy)),
            ),
        ],
        drive: best.drive.name(),
        checks: best.checks.iter().map(check_row).collect(),
        assumptions: best.assumptions.join("; "),
        plane: figures::torque_speed_plane(best, duty, rules),
        torque_time: figures::torque_over_time(best, duty),
        speed_time: figures::speed_over_time(best, duty),
        drawing: crate::drawing::still(file.machine.mechanism())?,
        inertia: figures::reduced_inertia(file)?,
        reduced: figures::reduced_torque(file, duty.integral(|i| i.omega.abs()) / duty.duration)?,
        terms: figures::terms(duty),
        links: figures::links(file)?,
        duty: duty_rows(best, duty),
        energy: format!(
            "Over a cycle the motor puts in {} J and takes back {} J; what the brake resistor or the DC bus has to \
             take is at most the latter.",
            rounded(motor.motoring_energy),
            rounded(motor.regenerative_energy)
        ),
        fit_count: selection.fit.len(),
        all_count: selection.fit.len() + selection.refused.len(),
        partly: selection.partly_checked(),
        fit: selection
            .fit
            .iter()
            .take(LISTED)
            .enumerate()
            .map(|(k, judged)| fit_row(k + 1, judged))
            .collect(),
        fit_more: selection.fit.len().saturating_sub(LISTED),
        ranking: RANKING,
        refused: selection
            .refused
            .iter()
            .map(|judged| (judged.drive.name(), judged.reasons()))
            .collect(),
        notes: notes(best, file, duty),
    };
    // Rendering into a string fails only if a template is wrong, which the tests would show.
    Ok(Some(page.render().unwrap_or_default()))
}

#[derive(Template)]
#[template(path = "simulation.html")]
struct SimulationPage<'a> {
    title: &'a str,
    figures: Vec<(&'static str, String)>,
}

/// The page with the plots of a simulation.
pub fn simulation_page(title: &str, run: &Columns) -> String {
    let page = SimulationPage {
        title,
        figures: figures::simulation(run),
    };
    page.render().unwrap_or_default()
}

fn answer(best: &Judged, found: bool) -> String {
    let motor = best.drive.motor;
    let gearbox = best
        .drive
        .gearbox
        .map_or("coupled directly".to_owned(), |g| {
            format!("with {} {} (i = {})", g.maker, g.model, g.ratio)
        });
    let drive = escape(&format!("{} {} {gearbox}", motor.maker, motor.model));
    if found {
        format!("<b>{drive}</b><br>is the smallest drive of the catalogue that holds every rule.")
    } else {
        let reasons = escape(&best.reasons());
        format!(
            "<b>No drive of the catalogue holds every rule.</b><br>{drive} misses by least: {reasons}."
        )
    }
}

/// The answer is the one piece of HTML that is put together by hand.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

fn check_row(check: &Check) -> CheckRow {
    let class = match check.verdict {
        Verdict::Pass => "ok",
        Verdict::Warn | Verdict::NotChecked => "warn",
        Verdict::Fail => "bad",
    };
    CheckRow {
        rule: check.rule,
        value: check.with_unit(check.value),
        limit: check
            .limit
            .map_or("–".into(), |limit| check.with_unit(limit)),
        used: check.used(),
        verdict: check.verdict.word(),
        class,
        note: check.note.clone(),
    }
}

fn fit_row(rank: usize, judged: &Judged) -> FitRow {
    let drive = &judged.drive;
    let remarks: Vec<String> = judged
        .checks
        .iter()
        .filter(|c| matches!(c.verdict, Verdict::Warn | Verdict::NotChecked))
        .map(|c| format!("{}: {}", c.rule, c.verdict.word()))
        .collect();
    FitRow {
        rank,
        motor: format!("{} {}", drive.motor.maker, drive.motor.model),
        gearbox: drive
            .gearbox
            .map_or("direct".into(), |g| format!("{} {}", g.maker, g.model)),
        ratio: rounded(drive.ratio()),
        power: format!("{:.2} kW", judged.rated_power() / 1000.0),
        rms: judged.used("RMS torque"),
        peak: judged.used("peak torque"),
        lambda: short(judged.duty.inertia_ratio.max),
        remarks: remarks.join("; "),
    }
}

fn duty_rows(best: &Judged, duty: &Duty) -> Vec<(&'static str, Vec<String>)> {
    let row = |name, figures: Figures, unit: f64| {
        let cells = figures.values().map(|x| rounded(x / unit));
        (name, cells.to_vec())
    };
    vec![
        row(
            "torque at the drive link [N m], without drive train",
            duty.figures(|i| i.terms.total()),
            1.0,
        ),
        row(
            "speed of the drive link [rpm]",
            duty.figures(|i| i.omega),
            RPM,
        ),
        row(
            "torque at the drive train's input [N m]",
            duty.figures(|i| i.input_torque),
            1.0,
        ),
        row("motor torque [N m]", best.duty.torque, 1.0),
        row("motor speed [rpm]", best.duty.speed, RPM),
        row("motor power [W]", best.duty.power, 1.0),
        row("inertia ratio λ", best.duty.inertia_ratio, 1.0),
    ]
}

fn notes(best: &Judged, file: &MachineFile, duty: &Duty) -> Vec<String> {
    let rules: &Rules = &file.rules;
    let work = duty.integral(|i| i.terms.total() * i.omega);
    let kinetic = duty.integral(|i| (i.terms.acceleration + i.terms.velocity) * i.omega);
    let potential = duty.integral(|i| i.terms.potential * i.omega);
    let mut notes = vec![
        format!(
            "Self-check over the cycle: work at the drive link {} J; of it into kinetic energy {} J and potential \
             energy {} J (zero for a cycle that closes).",
            rounded(work),
            short(kinetic),
            short(potential)
        ),
        format!(
            "Rules: RMS torque up to {} of the S1 torque, peak torque {} of the envelope, speed {} of the maximum, \
             holding torque {} of the standstill torque, inertia ratio up to {} (warning above {}), judged at its \
             largest value over the cycle.",
            percent(rules.rms_torque),
            percent(rules.peak_torque),
            percent(rules.speed),
            percent(rules.gravity_hold),
            rules.inertia_ratio,
            rules.inertia_ratio_warning
        ),
        "Losses: an efficiency divides the torque where power flows to the machine and multiplies it where power flows \
         back."
            .to_owned(),
        format!(
            "The cycle is evaluated exactly at {} instants; integrals by Simpson's rule on each smooth stretch.",
            duty.instants.len()
        ),
        "Not checked, because the catalogue has no such figures: winding temperature, drive current, brake resistor, \
         mounting dimensions between motor and gearbox, stiffness (rigid-body validity, VDI 2149), backlash."
            .to_owned(),
    ];
    let drive = &best.drive;
    notes.push(format!(
        "Source of {}: {}",
        drive.motor.model, drive.motor.source
    ));
    if let Some(gearbox) = drive.gearbox {
        notes.push(format!("Source of {}: {}", gearbox.model, gearbox.source));
    }
    notes
}

fn percent(share: f64) -> String {
    format!("{:.0} %", share * 100.0)
}

/// The terms' names with their formulas.
fn term_names() -> [String; 6] {
    let formulas = ["J·α", "½·J′·ω²", "U′", "", "b·ω", "c·sgn ω"];
    let mut k = 0;
    TorqueTerms::NAMES.map(|name| {
        let formula = formulas[k];
        k += 1;
        format!("{name} {formula}").trim_end().to_owned()
    })
}
