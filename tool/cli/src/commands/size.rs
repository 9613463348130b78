//! `jred size`.

use std::path::Path;

use miette::{Report, Result, miette};

use crate::commands::core_error::{core_report, duty_report};
use crate::commands::vary::catalogue;
use crate::commands::{Completion, documents, print, print_answer};
use crate::options::{MotionChoice, Size, SizeFormat};
use crate::output::{self, Files};
use crate::terminal;
use jred_analysis::checked;
use jred_analysis::duty::Duty;
use jred_analysis::warnings::warnings;
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::Motion;
use jred_file::model::{drive_train, variator};
use jred_file::number::words::counted;
use jred_file::plain;
use jred_file::read;
use jred_motion::co_design::CoDesignInput;
use jred_report::list;
use jred_report::list::aas::{SizedAxis, environment};
use jred_report::list::listing;
use jred_report::list::rule_words::assumptions;
use jred_report::list::source::Source;
use jred_report::page;
use jred_sizing::catalogue::Catalogue;
use jred_sizing::cycle::Cycle;
use jred_sizing::meter::MeterLimits;
use jred_sizing::select::fit::fit_input;
use jred_sizing::select::pareto::Front;
use jred_sizing::select::rank::Objective;
use jred_sizing::select::size::Selection;

/// Number of ranked motors.
const TOP: usize = 10;

/// Runs `jred size`.
///
/// # Errors
/// Bad input, or a file that cannot be written.
pub fn size(options: &Size) -> Result<Completion> {
    let mut file = checked::read(&options.file)?;
    if let Some(set) = options.supply.rule_set()? {
        file.rules = read::rules_based_on(&file.rules, set)?;
    }
    variator::refuse(&file, "size")?;
    let motion = file.required_motion()?;
    let mut filter = options.search.filter();
    filter.drive.clone_from(&options.drive);
    let mut catalogue = catalogue(&options.supply, &filter)?;
    let files = options.documents.files();
    output::check(files.into_iter().chain([("--meter", &options.meter)]))?;
    let objectives = options.pareto.as_ref().map_or(&[][..], |o| &o.0);
    options.search.check(&catalogue, objectives)?;
    fit_input(&mut catalogue, &file)?;
    let motors = catalogue.prepare(&file.site);
    let mut made = None;
    if options.motion == MotionChoice::Best {
        drive_train::refuse(&file, "size --motion best")?;
        file.refuse_scheduled("size --motion best")?;
        file.refuse_joint_friction("size --motion best")?;
        let narrow = |selection: &mut Selection| {
            options.search.apply(&filter, selection);
        };
        let judging = CoDesignInput {
            file: &file,
            own: motion,
            catalogue: &catalogue,
            motors: &motors,
            sampling: options.supply.course.with(&options.accuracy),
            narrow: &narrow,
        };
        let (best, says) = suited(&judging, options)?;
        file.motion = best.or(file.motion);
        made = Some(says);
    }
    let motion = file.required_motion()?;
    let duty = Duty::new(&file, motion, options.supply.course.with(&options.accuracy))
        .map_err(duty_report)?;
    let cycle = Cycle::new(&duty);
    let warnings = warnings(&file).map_err(core_report)?;
    let mut selection = Selection::parallel(&catalogue, &motors, &cycle, &file.site, &file.rules);
    let gaps = options.search.apply(&filter, &mut selection);
    let selection = selection;
    if selection.fit.is_empty() && selection.refused.is_empty() {
        return Err(none_left(options, catalogue.count(), &gaps));
    }
    for gap in gaps {
        terminal::say(&format!("warning: {gap}"));
    }
    if !objectives.is_empty() {
        return pareto(options, objectives, &file, &selection);
    }
    let asked = options.why.as_deref();
    let asked = asked.map(|name| asked_for(name, options, &selection));
    let asked = asked.transpose()?.flatten();
    let asked = asked.as_ref();
    let meter = match &options.meter {
        Some(path) => write_meter(path, asked, &file, &selection)?,
        None => false,
    };
    let explanation = explanation(options, asked, &file, &duty, &selection)?;
    let shown = listing::Listing {
        file: &file,
        duty: &duty,
        selection: &selection,
        warnings: &warnings,
        motion: made.as_ref(),
        asked,
        explanation: explanation.as_ref(),
        list: extent(options, explanation.is_some()),
    };
    let page = || {
        let page = document(options, shown, &catalogue)?;
        page.ok_or_else(|| none_left(options, catalogue.count(), &[]))
    };
    let workbook = || Ok(shown.answer_with_values());
    let (written, printed) =
        documents::write(&options.documents, Files::default(), page, workbook)?;
    let Some(format) = options.format.of_answer() else {
        let done = aas(options, shown, &catalogue)?;
        return printed.map(|()| done);
    };
    let mut answer = shown.answer(format);
    for line in written {
        answer.sentence(line);
    }
    if let Some(path) = options.meter.as_ref().filter(|_| meter) {
        let path = plain::path(path);
        answer.sentence(format!("limits for the duty meter written to {path}"));
    }
    print_answer(&answer, format)?;
    printed?;
    Ok(Completion::of(!selection.fit.is_empty()))
}

/// The document; `None` without a drive.
fn document(options: &Size, shown: listing::Listing, parts: &Catalogue) -> Result<Option<String>> {
    let source = Source {
        name: &read::name(&options.file),
        text: &read::text(&options.file)?,
        date: &output::today(),
        parts,
    };
    let unasked = listing::Listing {
        asked: None,
        ..shown
    };
    page::page(&source, unasked).map_err(core_report)
}

/// Prints the chosen drive as submodel of the asset administration shell.
fn aas(options: &Size, shown: listing::Listing, parts: &Catalogue) -> Result<Completion> {
    let Some(candidate) = shown.shown() else {
        return Ok(Completion::Violated);
    };
    let source = Source {
        name: &read::name(&options.file),
        text: &read::text(&options.file)?,
        date: &output::today(),
        parts,
    };
    let judged = shown.selection.judged(&candidate);
    let axis = SizedAxis {
        source: &source,
        file: shown.file,
        axis: None,
        duration: shown.duty.duration,
        judged: &judged,
    };
    print(&environment([axis]))?;
    Ok(Completion::of(judged.holds()))
}

/// Extent of the listing.
fn extent(options: &Size, explained: bool) -> listing::List {
    listing::List {
        top: options.top.unwrap_or(TOP),
        nearest: options.nearest,
        refused: options.refused,
        all: options.all,
        all_gearboxes: options.all_gearboxes,
        full: options.full || options.why.is_some(),
        is_ranked: options.top.is_some()
            || options.all
            || options.all_gearboxes
            || options.search.rank.is_some(),
        explained,
    }
}

/// The motion made for the best drive, and its part of the answer; `None`: the file's motion is kept.
fn suited(
    judging: &CoDesignInput,
    options: &Size,
) -> Result<(Option<Motion>, list::suited::MotionChoice)> {
    let suited = judging
        .best()
        .map_err(|obstacle| list::gentlest::problem(&obstacle, judging.file, None))?;
    let choice = list::suited::MotionChoice::new(judging.file, &suited);
    if options.format != SizeFormat::Table {
        terminal::say(&choice.words());
    }
    Ok((suited.motion().cloned(), choice))
}

/// The Pareto front of the drives that violate no rule.
fn pareto(
    options: &Size,
    objectives: &[Objective],
    file: &MachineFile,
    selection: &Selection,
) -> Result<Completion> {
    let front = Front::new(selection, objectives);
    if let Some(obstacle) = front.obstacle() {
        return Err(obstacle.into());
    }
    let title = format!(
        "{}: Pareto front of the drives that violate no rule",
        file.title
    );
    let format = options.format.of_answer().ok_or_else(|| {
        miette!(
            help = "leave out --pareto, or use another --format",
            "--format aas describes one drive, not a Pareto front"
        )
    })?;
    print_answer(&list::front::answer(&front, &title), format)?;
    Ok(Completion::of(!front.points.is_empty()))
}

/// Why there is no drive.
fn none_left(options: &Size, all: usize, gaps: &[String]) -> Report {
    let given = options.search.given();
    if given.is_empty() {
        return miette!(
            help = "check which motors, gearboxes and amplifiers the catalogue combines: docs/catalogue.md",
            "no motor in the catalogue can be combined into a drive"
        );
    }
    let unknown = [&[String::new()], gaps].concat().join("; ");
    let cure = if gaps.is_empty() {
        String::new()
    } else {
        "fill in the column of the catalogue (docs/catalogue.md), or ".to_owned()
    };
    miette!(
        help = format!("{cure}widen or remove {given}"),
        "none of the {all} possible drives passes the filter{unknown}"
    )
}

/// The drive of this name; the error mentions the filter, if there is one.
fn asked_for<'c>(
    name: &str,
    options: &Size,
    selection: &Selection<'c>,
) -> Result<Option<listing::Asked<'c>>> {
    let given = options.search.given();
    listing::Asked::named(selection, name).map_err(|error| {
        if given.is_empty() {
            return error.into();
        }
        let help = error.cure().unwrap_or_default();
        miette!(
            help = format!("without {given}, every drive is considered; {}", help),
            "{error}; {}",
            counted(
                selection.fit.len() + selection.refused.len(),
                "drive passes the filter",
                "drives pass the filter"
            )
        )
    })
}

/// Writes the limits of the requested drive, or of the best suitable one; returns whether there was one.
fn write_meter(
    path: &Path,
    asked: Option<&listing::Asked>,
    file: &MachineFile,
    selection: &Selection,
) -> Result<bool> {
    let best = || selection.first_fit(1).first().copied();
    let Some(candidate) = asked.map(|asked| asked.candidate).or_else(best) else {
        terminal::say(&format!(
            "no drive satisfies every rule: {} is not written (--why DRIVE writes the limits of a drive that does not)",
            plain::path(path)
        ));
        return Ok(false);
    };
    let context = selection.context(&candidate);
    let limits = MeterLimits::new(&context, selection.rules);
    let name = Path::new(&file.name).file_name().unwrap_or_default();
    let machine = format!("{}, {}", plain::path(name), file.title);
    let assumed = assumptions(&candidate.drive, &context.assumptions(selection.rules));
    output::write(path, limits.source(&machine, &assumed).as_bytes())?;
    let broken = limits.broken();
    if !broken.is_empty() {
        terminal::say(&format!(
            "warning: {} violates rules ({}): staying within the limits in {} does not make it acceptable",
            candidate.drive.name(),
            broken.join("; "),
            plain::path(path)
        ));
    }
    Ok(true)
}

/// The requested explanation; as text, it also covers the closest refused drives if no drive is suitable.
fn explanation(
    options: &Size,
    asked: Option<&listing::Asked>,
    file: &MachineFile,
    duty: &Duty,
    selection: &Selection,
) -> Result<Option<listing::Explanation>> {
    use listing::Explanation;
    if options.explain || options.why.is_some() {
        let drive = match asked {
            Some(asked) => Some(asked.candidate),
            None => listing::explained(selection, None)?,
        };
        let Some(drive) = drive else {
            return Ok(None);
        };
        let nearest = options.nearest;
        let explanation = Explanation::new(file, duty, selection, &drive, nearest);
        return explanation.map(Some).map_err(core_report);
    }
    if options.full && selection.fit.is_empty() {
        let nearest = Explanation::of_refused(file, duty, selection, options.nearest);
        return nearest.map(Some).map_err(core_report);
    }
    Ok(None)
}
