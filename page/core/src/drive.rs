//! Requests about drives: sizing, charts, report, motions for a drive.

use std::cell::RefCell;

use jred_analysis::duty::{Duty, Sampling};
use jred_analysis::warnings::warnings;
use jred_file::model::machine::MachineFile;
use jred_file::model::{drive_train, variator};
use jred_file::problem;
use jred_file::text::problem::{Problem, Result};
use jred_motion::contact::broken;
use jred_motion::fastest::motion_input::of_motion;
use jred_motion::fastest::ruled::Judge;
use jred_motion::fastest::{MoveLimits, Reserve};
use jred_motion::gentlest::cycle::{self, Goal, gentlest_cycle};
use jred_motion::gentlest::without_drive;
use jred_motion::path_dynamics::Actuator;
use jred_report::list::fastest::FastestView;
use jred_report::list::gentlest::{self, GentlestView};
use jred_report::list::listing::{self, Explanation, List, Listing};
use jred_report::list::source::Source;
use jred_report::page;
use jred_report::table::output::Format;
use jred_sizing::catalogue::Catalogue;
use jred_sizing::cycle::Cycle;
use jred_sizing::motor::envelope::{Envelope, MotorLimits};
use jred_sizing::select::filter::Filter;
use jred_sizing::select::fit::fit_input;
use jred_sizing::select::named::named;
use jred_sizing::select::size::Selection;
use jred_sizing::study::chosen::ChosenDrive;
use jred_sizing::study::common::Study;

use crate::machine::written;
use crate::request::Request;

/// Instants of the course of `jred fastest`.
const INSTANTS: usize = 201;

/// The built-in catalogue, read once.
fn catalogue() -> Result<Catalogue> {
    thread_local! {
        static READ: RefCell<Option<Catalogue>> = const { RefCell::new(None) };
    }
    READ.with_borrow_mut(|read| {
        if read.is_none() {
            *read = Some(Catalogue::built_in().map_err(|why| problem!("{why}"))?);
        }
        Ok(read.clone().unwrap_or_default())
    })
}

/// The drives of a request for a machine, judged.
fn sized<T>(request: &Request, answer: impl FnOnce(Listing, &Catalogue) -> Result<T>) -> Result<T> {
    let file = request.machine()?;
    variator::refuse(&file, "size")?;
    let motion = file.required_motion()?;
    let filter = Filter {
        drive: request.text("drive").map(str::to_owned),
        ..Filter::default()
    };
    let mut catalogue = catalogue()?;
    filter.thin(&mut catalogue)?;
    fit_input(&mut catalogue, &file)?;
    let motors = catalogue.prepare(&file.site);
    let duty = Duty::new(&file, motion, Sampling::default()).map_err(Problem::from)?;
    let cycle = Cycle::new(&duty);
    let warnings = warnings(&file).map_err(Problem::of)?;
    let (site, rules) = (&file.site, &file.rules);
    let best = (request.field("best") == true)
        .then(|| Selection::best(&catalogue, &motors, &cycle, site, rules))
        .flatten();
    let mut selection = match best {
        Some(best) => {
            let alone = std::iter::once((best.id(), best.drive));
            Selection::among(alone, &catalogue, &motors, &cycle, site, rules)
        }
        None => Selection::new(&catalogue, &motors, &cycle, site, rules),
    };
    filter.sift(&mut selection);
    let selection = selection;
    let nearest = 3;
    let explanation = match listing::explained(&selection, None)? {
        Some(drive) if request.field("explain") == true => {
            let made = Explanation::new(&file, &duty, &selection, &drive, nearest);
            Some(made.map_err(Problem::of)?)
        }
        _ => None,
    };
    let shown = Listing {
        file: &file,
        duty: &duty,
        selection: &selection,
        warnings: &warnings,
        motion: None,
        asked: None,
        explanation: explanation.as_ref(),
        list: List {
            top: request.count("top", 10),
            nearest,
            explained: explanation.is_some(),
            ..List::default()
        },
    };
    answer(shown, &catalogue)
}

/// `jred size --format json`
pub(crate) fn size(request: &Request) -> Result<String> {
    sized(request, |shown, _| Ok(written(&shown.answer(Format::Json))))
}

/// The charts of the report as numbers.
pub(crate) fn charts(request: &Request) -> Result<String> {
    sized(request, |shown, _| {
        let charts = page::drive_charts(shown).unwrap_or_default();
        Ok(charts.to_string())
    })
}

/// `jred size --report`
pub(crate) fn report(request: &Request) -> Result<String> {
    let html = sized(request, |shown, parts| {
        let source = Source {
            name: &request.name(),
            text: request.source(),
            date: request.text("day").unwrap_or_default(),
            parts,
        };
        page::page(&source, shown).map_err(Problem::of)
    })?;
    Ok(serde_json::json!({ "html": html.unwrap_or_default() }).to_string())
}

/// The limits of a drive at the machine's supply; warns as the command does.
fn envelope(drive: &ChosenDrive, file: &MachineFile, request: &Request) -> Envelope {
    let drive = drive.drive();
    let limits = MotorLimits::new(drive.motor, drive.amplifier, &file.site);
    if let Some(unfit) = limits.unfit(&file.rules) {
        request.warn(unfit);
    }
    Envelope::at(drive.motor, drive.amplifier, &file.site)
}

/// The named drive of the catalogue.
fn asked(name: &str, file: &MachineFile) -> Result<ChosenDrive> {
    let mut catalogue = catalogue()?;
    fit_input(&mut catalogue, file)?;
    Ok(ChosenDrive::of(&named(&catalogue, name)?.1, &catalogue))
}

/// `jred fastest --format json`
pub(crate) fn fastest(request: &Request) -> Result<String> {
    let file = request.machine_warned()?;
    variator::refuse(&file, "fastest")?;
    drive_train::refuse(&file, "fastest")?;
    file.refuse_timed("fastest")?;
    file.refuse_joint_friction("fastest")?;
    let drive = if let Some(name) = request.text("drive") {
        asked(name, &file)?
    } else {
        let (name, text) = (request.name(), request.source().to_owned());
        let files = Box::new(request.files());
        let study = Study::new(name, text, files, catalogue()?, None, Sampling::default())?;
        ChosenDrive::choose(&study, None, &Filter::default(), None)?
    };
    let envelope = envelope(&drive, &file, request);
    for assumption in envelope.assumptions() {
        request.warn(assumption);
    }
    let actuator = Actuator::new(&drive.drive(), envelope);
    let limits = MoveLimits::of(&drive.drive());
    let parts = of_motion(&file, &limits, None)?;
    let cycle = parts
        .fastest(&file, &actuator, &limits, None)
        .map_err(|(number, why)| why.problem(number))?
        .with_costs(&file, &actuator);
    let broken = broken(&file, &cycle.trace).map_err(Problem::of)?;
    let view = FastestView {
        file: &file,
        drive: &drive.name(),
        asked: Vec::new(),
        actuator: &actuator,
        cycle: &cycle,
        chain: parts.chain(),
        warmth: None,
        forces: &[],
        broken: broken.as_ref(),
        reserve: Reserve::default(),
        judged: None,
        of_catalogue: true,
        instants: INSTANTS,
    };
    Ok(written(&view.answer(Format::Json).map_err(Problem::of)?))
}

/// `jred gentlest --format json`
pub(crate) fn gentlest(request: &Request) -> Result<String> {
    let file = request.machine_warned()?;
    variator::refuse(&file, "gentlest")?;
    drive_train::refuse(&file, "gentlest")?;
    file.refuse_timed("gentlest")?;
    file.refuse_joint_friction("gentlest")?;
    let motion = file.required_motion()?;
    let name = request.text("drive");
    let chosen = name.map(|name| asked(name, &file)).transpose()?;
    let actuator = chosen.as_ref().map_or_else(without_drive, |chosen| {
        Actuator::new(&chosen.drive(), envelope(chosen, &file, request))
    });
    let drive = chosen.as_ref().map(ChosenDrive::drive);
    let wanted = cycle::Request {
        actuator,
        copper: drive.as_ref().and_then(cycle::copper),
        goal: Goal::default(),
        ramp: 0.0,
        sampling: Sampling::default(),
    };
    let found = gentlest_cycle(&file, motion, &wanted)
        .map_err(|why| gentlest::problem(&why, &file, name))?;
    let checks = match &chosen {
        None => Vec::new(),
        Some(chosen) => Judge::new(&file, chosen.drive(), wanted.sampling)
            .with_resistors(chosen.resistors())
            .checks(&found.trace)
            .map_err(Problem::from)?,
    };
    let broken = broken(&file, &found.trace).map_err(Problem::of)?;
    let view = GentlestView {
        file: &file,
        drive: drive.map(|drive| drive.name()),
        request: &wanted,
        gentlest: &found,
        broken: broken.as_ref(),
        checks: &checks,
    };
    Ok(written(&gentlest::answer(&view)))
}
