//! The sizing report: one self-contained HTML page.
//!
//! Every chart is on the page twice: as an SVG picture, for paper and browsers without scripts, and as data that the page's script draws with uPlot
//! (`templates/vendor/uplot`, MIT licence), with zoom and readout.

use askama::Template;
use jred::error::Error;

use crate::list;
use crate::list::listing::{self, Explanation};
use jred_analysis::duty::Duty;
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;
use jred_file::number::rounding::{cleared, rounded, short, shown};
use jred_file::units::Vocabulary;
use jred_sizing::catalogue::MotorKind;
use jred_sizing::explain::{Breakdown, Contributions, Lever, Remedies};
use jred_sizing::select::size::{Candidate, Selection};

mod chart;
mod drive;
mod extract;
mod figures;
mod mechanism;
mod motion;
mod notes;
mod rows;
mod section;
mod thinned;

use chart::Chart;
use drive::{Subject, TOP};
use rows::{ChangeRow, CheckRow, FitRow, InertiaRow, NO_PART, ShareRow};
use section::MotionPage;

pub use mechanism::mechanism_page;
pub use motion::{fastest_page, retime_page, steady_page};

/// Number of motors on the page, each with its first gearbox and amplifier.
const LISTED: usize = 25;

/// Number of refused drives on the page.
const REFUSED: usize = 50;

/// Number of refused drives with their required changes.
const CHANGED: usize = 3;

struct CaptionedChart {
    chart: Chart,
    caption: String,
}

impl CaptionedChart {
    fn new(chart: Chart, caption: impl Into<String>) -> Self {
        let caption = caption.into();
        Self { chart, caption }
    }
}

#[derive(Template)]
#[template(path = "report.html")]
struct Page {
    title: String,
    version: &'static str,
    file: String,
    found: bool,
    answer: String,
    cards: Vec<(String, String)>,
    drive: String,
    checks: Vec<CheckRow>,
    open: Vec<(&'static str, String)>,
    plane: Vec<CaptionedChart>,
    over_time: Vec<CaptionedChart>,
    drawing: String,
    machine: Vec<CaptionedChart>,
    torque_word: &'static str,
    torque_unit: &'static str,
    effects: Vec<ShareRow>,
    parts: Vec<ShareRow>,
    inertia_word: &'static str,
    inertia_unit: &'static str,
    inertias: Vec<InertiaRow>,
    peak_time: String,
    effects_chart: Vec<CaptionedChart>,
    ratio: Vec<CaptionedChart>,
    change: ChangeRow,
    nearest: Vec<ChangeRow>,
    duty: Vec<(String, Vec<String>)>,
    energy: String,
    fit_count: usize,
    all_count: usize,
    fit: Vec<FitRow>,
    /// Whether a brake resistor was chosen for one of them.
    resistors: bool,
    fit_more: usize,
    ranking: String,
    smaller: Vec<String>,
    classes: Vec<String>,
    warnings: Vec<String>,
    gaps: Vec<String>,
    refused_count: usize,
    refused: Vec<(String, String)>,
    rule_set: String,
    rules: Vec<[String; 4]>,
    notes: Vec<String>,
}

/// The page for a selection. It describes the best drive, or, if none is suitable, the closest one.
///
/// # Errors
/// Those of the machine; `None` if the catalogue was empty.
pub fn page(
    name: &str,
    file: &MachineFile,
    duty: &Duty,
    selection: &Selection,
    warnings: &[String],
) -> Result<Option<String>, Error> {
    let Some(candidate) = selection.fit.first().or(selection.refused.first()) else {
        return Ok(None);
    };
    let page = Page {
        warnings: warnings.to_vec(),
        ..Page::of(name, file, duty, selection, candidate)?
    };
    // Rendering into a string fails only for a wrong template, which the tests show.
    Ok(Some(page.render().unwrap_or_default()))
}

impl Page {
    fn of(
        name: &str,
        file: &MachineFile,
        duty: &Duty,
        selection: &Selection,
        candidate: &Candidate,
    ) -> Result<Self, Error> {
        let found = !selection.fit.is_empty();
        let best = &selection.judged(candidate);
        let words = best.drive.motor.kind.vocabulary();
        let link = file.machine.mechanism().coordinate().vocabulary();
        let Vocabulary {
            torque, inertia, ..
        } = words;
        let explanation = Explanation::new(file, duty, selection, candidate, CHANGED)?;
        let contributions = Contributions::new(file, duty, &best.drive)?;
        let breakdown = Breakdown::of(duty, &best.drive, &contributions);
        let subject = Subject {
            context: selection.context(candidate),
            judged: best,
            duty,
            rules: selection.rules,
        };
        let mean_speed = duty.integral(|i| i.omega.abs()) / duty.duration;
        let (checked, open) = split_checks(best);
        let fit = ranked(selection);
        let all_count = selection.fit.len() + selection.refused.len();
        Ok(Self {
            title: file.title.clone(),
            version: env!("CARGO_PKG_VERSION"),
            file: name.to_owned(),
            found,
            answer: notes::answer(best, selection),
            cards: cards(best, duty, words),
            drive: best.drive.name(),
            checks: checked,
            open,
            plane: vec![CaptionedChart::new(
                subject.plane(),
                format!(
                    "{} and speed of the motor over the cycle in all four quadrants; where their signs differ, it brakes. Dashed: limits by the rules.",
                    torque.capital()
                ),
            )],
            over_time: over_time(&subject, words),
            drawing: crate::drawing::still(file.machine.mechanism())?,
            machine: machine(&subject, file, mean_speed)?,
            torque_word: torque.word,
            torque_unit: torque.unit,
            effects: rows::share_rows(&breakdown.effects, &breakdown),
            parts: rows::share_rows(&breakdown.parts, &breakdown),
            inertia_word: inertia.word,
            inertia_unit: inertia.unit,
            inertias: rows::inertia_rows(&breakdown),
            peak_time: short(breakdown.peak_time),
            effects_chart: vec![CaptionedChart::new(
                subject.effects(&contributions),
                format!(
                    "Contributions to the motor {torque} over the cycle; at every instant they add up to the motor {torque}."
                ),
            )],
            ratio: ratio(&subject, explanation.change.as_ref()),
            change: explanation
                .change
                .as_ref()
                .map_or_else(ChangeRow::default, |c| ChangeRow::of(c, duty.duration)),
            nearest: explanation
                .nearest
                .iter()
                .map(|refused| ChangeRow::of(refused, duty.duration))
                .collect(),
            duty: rows::duty_rows(best, duty, file.input_name(), link, words),
            energy: format!(
                "Over a cycle the motor supplies {} J and feeds back {} J; the brake resistor or the DC bus takes at \
                 most the latter.",
                rounded(best.duty.motoring_energy),
                rounded(cleared(
                    best.duty.regenerative_energy,
                    best.duty.motoring_energy
                ))
            ),
            fit_count: selection.fit.len(),
            all_count,
            fit_more: selection.fit.len() - fit.len(),
            resistors: fit.iter().any(|row| row.resistor != NO_PART),
            fit,
            ranking: selection.ranking(words),
            smaller: listing::smaller(selection),
            // A single drive needs no comparison.
            classes: (selection.classes().iter().filter(|_| all_count > 1))
                .map(listing::class_text)
                .collect(),
            warnings: Vec::new(),
            gaps: (selection.gaps().iter())
                .map(|gap| listing::gap_text(gap, words))
                .collect(),
            refused_count: selection.refused.len(),
            refused: (selection.first_refused(REFUSED))
                .iter()
                .map(|c| (c.drive.name(), selection.judged(c).reasons()))
                .collect(),
            rule_set: format!("{}: {}", selection.rules.name, selection.rules.title),
            rules: rows::rule_rows(selection.rules, words),
            notes: notes::notes(best, duty),
        })
    }
}

fn ranked(selection: &Selection) -> Vec<FitRow> {
    let list = listing::List {
        top: LISTED,
        nearest: 0,
        ..listing::List::default()
    };
    let listed = list.ranked(selection).into_iter();
    listed
        .map(|(rank, candidate)| FitRow::of(rank, &selection.judged(&candidate)))
        .collect()
}

/// The rules that were checked, and the others with their missing data.
fn split_checks(
    best: &jred_sizing::judge::Assessment,
) -> (Vec<CheckRow>, Vec<(&'static str, String)>) {
    let (open, checked): (Vec<_>, Vec<_>) = best
        .checks
        .iter()
        .partition(|check| check.verdict == jred_file::model::rules::RuleVerdict::NotChecked);
    let checked = checked.into_iter().map(CheckRow::of).collect();
    let open = open
        .into_iter()
        .map(|check| (check.rule, check.note.clone()));
    (checked, open.collect())
}

fn cards(
    best: &jred_sizing::judge::Assessment,
    duty: &Duty,
    words: &Vocabulary,
) -> Vec<(String, String)> {
    let motor = &best.duty;
    let (word, unit) = (words.torque, words.torque.unit);
    let card = |name: String, value: String| (name, value);
    vec![
        card("cycle".to_owned(), format!("{} s", rounded(duty.duration))),
        card(
            format!("RMS {word}"),
            format!("{} {unit}", short(motor.torque.rms)),
        ),
        card(
            format!("peak {word}"),
            format!("{} {unit}", short(motor.torque.peak())),
        ),
        card(
            "largest speed".to_owned(),
            format!(
                "{} {}",
                short(motor.speed.peak() / words.speed.scale),
                words.speed.unit
            ),
        ),
        card(
            format!("{} ratio λ", words.inertia),
            format!(
                "{} to {}",
                short(motor.inertia_ratio.min),
                short(motor.inertia_ratio.max)
            ),
        ),
        card(
            "regenerative energy".to_owned(),
            format!(
                "{} J per cycle",
                shown(motor.regenerative_energy, motor.motoring_energy)
            ),
        ),
    ]
}

fn over_time(subject: &Subject, words: &Vocabulary) -> Vec<CaptionedChart> {
    let mut figures = vec![
        CaptionedChart::new(
            subject.torque(),
            format!(
                "Motor {}, and the part of it that accelerates the {}.",
                words.torque, words.rotor
            ),
        ),
        CaptionedChart::new(subject.speed(), "Motor speed."),
        CaptionedChart::new(
            subject.power(),
            "Mechanical power at the motor shaft; negative: it flows back.",
        ),
    ];
    figures.extend(subject.rises().map(|chart| {
        CaptionedChart::new(
            chart,
            "Temperature rise in the steady state of the repeated cycle.",
        )
    }));
    figures.extend(subject.bus_voltage().map(|chart| {
        CaptionedChart::new(
            chart,
            "Voltage of the DC bus in the steady state of the repeated cycle.",
        )
    }));
    figures
}

fn machine(
    subject: &Subject,
    file: &MachineFile,
    mean_speed: f64,
) -> Result<Vec<CaptionedChart>, Error> {
    let words = subject.words();
    let coordinate = file.machine.mechanism().coordinate();
    let (what, term) = match coordinate {
        Coordinate::Angle => (
            "Reduced inertia",
            "J_red varies, a drive that uses its mean value makes an error of ½·J′·ω²",
        ),
        Coordinate::Length => (
            "Reduced mass",
            "m_red varies, a drive that uses its mean value makes an error of ½·m′·v²",
        ),
    };
    let reduced = format!(
        "{what} with flywheel and drive train, and its derivative. Where {term} at every speed."
    );
    Ok(vec![
        CaptionedChart::new(figures::reduced_inertia(file)?, reduced),
        CaptionedChart::new(
            figures::reduced_torque(file, mean_speed)?,
            format!(
                "Parts of the reduced {} that do not depend on the motion: weight and springs, process loads, and the magnitudes of the viscous and motion-opposing loads at the mean speed.{}",
                coordinate.vocabulary().torque,
                figures::not_contained(file)
            ),
        ),
        CaptionedChart::new(
            subject.inertia_ratio(file)?,
            format!(
                "{} ratio λ of this drive over the range of the drive link, with the value that is checked.",
                words.inertia.capital()
            ),
        ),
    ])
}

/// Every rule over the gear ratio; the axis contains the range that satisfies all.
fn ratio(subject: &Subject, change: Option<&Remedies>) -> Vec<CaptionedChart> {
    if subject.judged.drive.motor.kind == MotorKind::Linear {
        return Vec::new();
    }
    let now = subject.context.ratio;
    let remedies = change.map_or(&[][..], |c| &c.remedies);
    let found = remedies
        .iter()
        .find(|r| matches!(r.lever, Lever::GearRatio | Lever::IdealGearbox));
    let (mut from, mut to) = (now / 3.0, now * 3.0);
    if let Some([low, high]) = found.and_then(|r| r.range) {
        (from, to) = (from.min(low.value / 1.3), to.max(high.value * 1.3));
    }
    vec![CaptionedChart::new(
        subject.ratios(from, to),
        format!(
            "Share of its limit that each rule uses over the gear ratio, with all other data of motor and gearbox unchanged. Where all are below 100 %, every rule is satisfied. A curve ends where it passes {TOP} %, or where the motor has no torque left (the limit is zero above its maximum speed). Rules that depend on time are not drawn."
        ),
    )]
}

/// The page with the plots of a simulation.
pub fn simulation_page(shown: &list::simulation::SimulationView) -> String {
    let file = shown.machines.first;
    let sections = figures::simulation(&shown.found.columns);
    MotionPage::page(file, "simulation", shown.about(), &shown.answer(), sections)
}
