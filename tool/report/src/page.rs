//! The sizing report: one self-contained HTML page.
//!
//! Every chart is on the page twice: as an SVG picture, for paper and browsers without scripts, and as data that the page's script draws with uPlot
//! (`templates/vendor/uplot`, MIT licence), with zoom and readout.

use jred::error::Error;

use crate::answer::{Answer, Block};
use crate::list;
use crate::list::listing::{self, Explanation, List, Listing};
use crate::list::source::Source;
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;
use jred_file::model::rules::RuleSet;
use jred_file::number::rounding::short;
use jred_file::units::Vocabulary;
use jred_sizing::catalogue::MotorKind;
use jred_sizing::explain::{Breakdown, Contributions, Lever, Remedies};
use jred_sizing::judge::Assessment;
use jred_sizing::select::size::Candidate;
use serde_json::{Value, json};

mod chart;
mod document;
mod drive;
mod extract;
mod figures;
mod identify;
mod mechanism;
mod motion;
mod notes;
mod paper;
mod project;
mod require;
mod section;
mod thinned;
mod tool;

use drive::{Subject, TOP};
use section::{Figure, Page, Section};

pub(crate) use paper::in_quotes;

pub use identify::identify_page;
pub use mechanism::mechanism_page;
pub use motion::{fastest_page, gentlest_page, steady_page};
pub use paper::Paper;
pub use project::project_page;
pub use require::require_page;

/// Number of motors on the page, each with its first gearbox and amplifier.
const LISTED: usize = 25;

/// Number of refused drives on the page.
const REFUSED: usize = 20;

/// Number of refused drives with their required changes.
const CHANGED: usize = 3;

/// The page for a selection. It describes the best drive, or, if none is suitable, the closest one.
///
/// # Errors
/// Those of the machine; `None` if the catalogue was empty.
pub fn page(source: &Source, shown: Listing) -> Result<Option<String>, Error> {
    let file = shown.file;
    let Some(drive) = drive_pages(source, shown, true)? else {
        return Ok(None);
    };
    let mut answer = Answer::words("");
    document::title(&mut answer, source, file);
    answer.blocks.extend(drive.first);
    let page = Page {
        class: class(drive.holds),
        file: source.name,
        ..Page::new(file, "drive sizing", &answer, drive.sections)
    };
    let about = format!(
        "Drive sizing with the reduced {} over the whole cycle",
        drive.words.inertia
    );
    Ok(Some(page.html(about)))
}

/// Class of the first blocks.
const fn class(holds: bool) -> &'static str {
    if holds { "answer" } else { "answer none" }
}

/// Everything about the drive of a machine.
struct DrivePages {
    /// The drive, its limits, the next choices.
    first: Vec<Block>,
    /// The rest.
    sections: Vec<Section>,
    /// Whether a drive satisfies every rule.
    holds: bool,
    words: &'static Vocabulary,
}

/// The best or requested drive of a machine; `whole`: with its choice among all drives, the parts of its torque, and the sources of the rules.
fn drive_pages(source: &Source, shown: Listing, whole: bool) -> Result<Option<DrivePages>, Error> {
    let list = List {
        top: LISTED,
        nearest: REFUSED,
        ..List::default()
    };
    let shown = Listing { list, ..shown };
    let Some(candidate) = shown.shown() else {
        return Ok(None);
    };
    let Listing {
        file,
        duty,
        selection,
        ..
    } = shown;
    let judged = &selection.judged(&candidate);
    let words = judged.drive.motor.kind.vocabulary();
    let subject = subject(shown, &candidate, judged);
    let mut answer = Answer::words("");
    shown.first(&mut answer, judged);
    shown.others(&mut answer, usize::MAX);
    let mut sections = Vec::new();
    if whole {
        shown.certainties(&mut answer);
        sections.push(Section::read("Bill of materials", |answer| {
            listing::bill(answer, judged);
        }));
    }
    sections.push(drawn(file)?);
    sections.extend(tool::tool(file, duty)?);
    sections.extend([
        Section::read(format!("Rules, for {}", judged.drive.name()), |answer| {
            listing::rules(answer, judged);
        }),
        Section::new(
            "Operating points and limits of the motor",
            vec![plane(&subject)],
        ),
        Section::new("Over the cycle", over_time(&subject, words)),
    ]);
    let changed = if whole { CHANGED } else { 0 };
    let explanation = Explanation::new(file, duty, selection, &candidate, changed)?;
    if whole {
        let contributions = Contributions::new(file, duty, &judged.drive)?;
        sections.push(shares(&subject, &contributions));
    }
    sections.extend(changes(&subject, &explanation));
    if whole {
        sections.push(machine(&subject, file)?);
    }
    sections.push(Section::read("Duty", |answer| shown.duty(answer, judged)));
    if whole {
        sections.extend(alternatives(shown, judged));
    }
    sections.push(document::inputs(source));
    if whole {
        sections.push(rule_sources(selection.rules, words));
    }
    sections.push(Section::read(
        "Assumptions, sources, self-check",
        |answer| {
            for note in notes::notes(judged, duty) {
                answer.sentence(note);
            }
        },
    ));
    Ok(Some(DrivePages {
        first: answer.blocks,
        sections,
        holds: judged.holds(),
        words,
    }))
}

fn subject<'a>(
    shown: Listing<'a>,
    candidate: &Candidate<'a>,
    judged: &'a Assessment<'a>,
) -> Subject<'a> {
    Subject {
        context: shown.selection.context(candidate),
        judged,
        duty: shown.duty,
        rules: shown.selection.rules,
    }
}

/// The charts of the best or requested drive as data, for a page that draws them itself; `None` if the catalogue was empty.
pub fn drive_charts(shown: Listing) -> Option<Value> {
    let candidate = shown.shown()?;
    let judged = &shown.selection.judged(&candidate);
    let subject = subject(shown, &candidate, judged);
    let charts = [
        ("plane", Some(subject.plane())),
        ("torque", Some(subject.torque())),
        ("speed", Some(subject.speed())),
        ("power", Some(subject.power())),
        ("temperature", subject.rises()),
        ("bus", subject.bus_voltage()),
    ];
    let charts = charts.into_iter();
    let charts: Value = charts
        .filter_map(|(name, chart)| Some(chart?.named(name)))
        .collect();
    Some(json!({ "drive": judged.drive.name(), "charts": charts }))
}

/// The ranked drives, and the refused ones with their reasons.
fn alternatives(shown: Listing, judged: &Assessment) -> [Section; 2] {
    let [fit, refused] = [shown.selection.fit.len(), shown.selection.refused.len()];
    let ranked = format!("Drives that violate no rule ({fit} of {})", shown.count());
    let ranked = Section::read(ranked, |answer| {
        if fit > 0 {
            shown.ranking(answer, judged, true);
            shown.gaps(answer, judged);
        } else {
            answer.sentence("None.");
        }
        shown.smaller(answer);
    });
    let listed = match refused {
        0..=REFUSED => String::new(),
        _ => format!("; {REFUSED} are listed, `jred size --refused` lists all"),
    };
    let reasons = Section {
        folded: format!("{refused} drives, closest first{listed}"),
        ..Section::read("Refused drives and reasons", |answer| shown.refused(answer))
    };
    [ranked, reasons]
}

/// The limits of a rule set and their sources.
fn rule_sources(rules: &RuleSet, words: &Vocabulary) -> Section {
    Section::read("Rules and their sources", |answer| {
        answer.sentence(format!(
            "Set {}: {}. A limit is a share of the rating.",
            rules.name, rules.title
        ));
        list::rule_list::limits(answer, rules, words);
    })
}

/// The torque-speed plane.
fn plane(subject: &Subject) -> Figure {
    let caption = format!(
        "{} and speed of the motor over the cycle in all four quadrants; where their signs differ, it brakes. Dashed: limits by the rules.",
        subject.words().torque.capital()
    );
    Figure::live(&subject.plane(), caption)
}

/// Torque and inertia, part by part.
fn shares(subject: &Subject, contributions: &Contributions) -> Section {
    let breakdown = Breakdown::of(subject.duty, &subject.judged.drive, contributions);
    let torque = subject.words().torque;
    let caption = format!(
        "Contributions to the motor {torque} over the cycle; at every instant they add up to the motor {torque}."
    );
    let section = Section::read(format!("Contributions to the {torque}"), |answer| {
        answer.sentence(format!(
            "At the motor, in {}; the {torque} is largest at {} s. The shares of the mean square {torque} add up to 100 %.",
            torque.unit,
            short(breakdown.peak_time)
        ));
        listing::contributions(answer, &breakdown);
    });
    Section {
        figures: vec![Figure::live(&subject.effects(contributions), caption)],
        ..section
    }
}

/// The range of each quantity, and the changes that the closest refused drives need.
fn changes(subject: &Subject, explanation: &Explanation) -> Vec<Section> {
    let duration = subject.duty.duration;
    let found = subject.judged.holds();
    let [own, others] = if found {
        [
            "How far each quantity may change",
            "Closest refused drives, and what would have to change",
        ]
    } else {
        ["What would have to change", "Next closest drives"]
    };
    let change = explanation.change.as_ref();
    let first = Section::read(own, |answer| {
        answer.sentence(
            "One quantity at a time, all others unchanged; in brackets: the rule that reaches its limit.",
        );
        if let Some(change) = change {
            listing::changes(answer, change, duration);
        }
    });
    let mut sections = vec![Section {
        figures: ratio(subject, change),
        ..first
    }];
    if !explanation.nearest.is_empty() {
        sections.push(Section::read(others, |answer| {
            for refused in &explanation.nearest {
                listing::changes(answer, refused, duration);
            }
        }));
    }
    sections
}

fn over_time(subject: &Subject, words: &Vocabulary) -> Vec<Figure> {
    let mut figures = vec![
        Figure::live(
            &subject.torque(),
            format!(
                "Motor {}, and the part of it that accelerates the {}.",
                words.torque, words.rotor
            ),
        ),
        Figure::live(&subject.speed(), "Motor speed."),
        Figure::live(
            &subject.power(),
            "Mechanical power at the motor shaft; negative: it flows back.",
        ),
    ];
    figures.extend(subject.rises().map(|chart| {
        Figure::live(
            &chart,
            "Temperature rise in the steady state of the repeated cycle.",
        )
    }));
    figures.extend(subject.bus_voltage().map(|chart| {
        Figure::live(
            &chart,
            "Voltage of the DC bus in the steady state of the repeated cycle.",
        )
    }));
    figures
}

/// The machine as it stands.
fn drawn(file: &MachineFile) -> Result<Section, Error> {
    let figure = Figure::new(
        crate::drawing::still(file)?,
        format!(
            "The machine as it stands, at the start of its motion, with the paths of its named points and, in grey, its links at other positions. Numbers: where the parts of the motion begin. `jred reduce {} --report` animates it.",
            file.name
        ),
    );
    Ok(Section::new("The machine", vec![figure]))
}

/// Its reduced inertia and torque.
fn machine(subject: &Subject, file: &MachineFile) -> Result<Section, Error> {
    let duty = subject.duty;
    let mean_speed = duty.integral(|i| i.omega.abs()) / duty.duration;
    let words = subject.words();
    let coordinate = file.machine.mechanism().coordinate();
    let (what, term) = match coordinate {
        Coordinate::Angle => (
            "Reduced inertia",
            "J_red varies, a drive that uses its mean value makes an error of (J − J̄)·α + ½·J′·ω²",
        ),
        Coordinate::Length => (
            "Reduced mass",
            "m_red varies, a drive that uses its mean value makes an error of (m − m̄)·a + ½·m′·v²",
        ),
    };
    let reduced =
        format!("{what} with flywheel and drive train, and its derivative. Where {term}.");
    let figures = vec![
        Figure::live(&figures::reduced_inertia(file)?, reduced),
        Figure::live(
            &figures::reduced_torque(file, mean_speed)?,
            format!(
                "Parts of the reduced {} that do not depend on the motion: weight and springs, process loads, and the magnitudes of the viscous and motion-opposing loads at the mean speed.{}",
                coordinate.vocabulary().torque,
                figures::not_contained(file)
            ),
        ),
        Figure::live(
            &subject.inertia_ratio(file)?,
            format!(
                "{} ratio λ of this drive over the range of the drive link, with the value that is checked.",
                words.inertia.capital()
            ),
        ),
    ];
    Ok(Section::new("The machine, reduced", figures))
}

/// Every rule over the gear ratio; the axis contains the range that satisfies all.
fn ratio(subject: &Subject, change: Option<&Remedies>) -> Vec<Figure> {
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
    vec![Figure::live(
        &subject.ratios(from, to),
        format!(
            "Share of its limit that each rule uses over the gear ratio, with all other data of motor and gearbox unchanged. Where all are below 100 %, every rule is satisfied. A curve ends where it passes {TOP} %, or where the motor has no torque left (the limit is zero above its maximum speed). Rules that depend on time are not drawn."
        ),
    )]
}

/// The page of a drive's parameters.
pub fn drive_page(file: &MachineFile, shown: &list::drive::DriveView) -> String {
    Page::page(
        file,
        "drive",
        "parameters to type into the drive",
        &shown.answer(),
        Vec::new(),
    )
}

/// The page with the plots of a simulation.
pub fn simulation_page(shown: &list::simulation::SimulationView) -> String {
    let file = shown.machines.first;
    let sections = figures::simulation(&shown.found.columns);
    Page::page(file, "simulation", shown.about(), &shown.answer(), sections)
}
