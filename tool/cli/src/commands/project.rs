//! `jred project`: several axes, their parts and their supply.

use std::path::{Path, PathBuf};

use indicatif::ProgressBar;
use miette::{Result, miette};

use crate::busy;
use crate::commands::bus::{Bar, bounded, common};
use crate::commands::core_error::{core_report, duty_report};
use crate::commands::{Completion, documents, print, print_answer, read_warned};
use crate::options::project::Project as Options;
use crate::output::{self, Files};
use jred_analysis::duty::Duty;
use jred_analysis::warnings::warnings;
use jred_file::model::machine::MachineFile;
use jred_file::model::project::{Project, ProjectAxis};
use jred_file::model::site::Site;
use jred_file::model::variator;
use jred_file::plain;
use jred_file::read;
use jred_file::text::disk;
use jred_report::list::aas::{SizedAxis, environment};
use jred_report::list::listing::{Asked, List, Listing};
use jred_report::list::project::{AxisView, ProjectView};
use jred_report::list::source::Source;
use jred_report::page;
use jred_sizing::bus::analysis::{BusAnalysis, BusAxis};
use jred_sizing::catalogue::Catalogue;
use jred_sizing::cycle::Cycle;
use jred_sizing::motor::envelope::MotorLimits;
use jred_sizing::select::fit::fit_input;
use jred_sizing::select::size::Selection;

/// An axis with all that its selection refers to.
struct Prepared {
    name: String,
    text: String,
    file: MachineFile,
    duty: Duty,
    cycle: Cycle,
    catalogue: Catalogue,
    motors: Vec<MotorLimits>,
    warnings: Vec<String>,
}

/// Runs the command.
///
/// # Errors
/// Bad input, or a file that cannot be written.
pub(super) fn run(options: &Options) -> Result<Completion> {
    let name = read::name(&options.file);
    let project = read::project(&name, &read::text(&options.file)?)?;
    output::check(options.documents.files())?;
    let count: usize = project.axes.iter().map(|axis| axis.quantity as usize).sum();
    bounded(count, &options.sampling)?;
    let catalogue = options.catalogue.open()?;
    let mut files = Vec::new();
    for axis in &project.axes {
        let path = read::folder(&options.file).join(&axis.machine);
        files.push((read_axis(&path, axis, &project)?, path));
    }
    let supply = supplies(&project, &mut files)?;
    let each = files
        .into_iter()
        .map(|(file, path)| prepared(&path, file, &catalogue, options));
    let each = each.collect::<Result<Vec<Prepared>>>()?;
    let selections: Vec<Selection> = (each.iter())
        .map(|axis| {
            let (file, motors) = (&axis.file, &axis.motors);
            Selection::parallel(
                &axis.catalogue,
                motors,
                &axis.cycle,
                &file.site,
                &file.rules,
            )
        })
        .collect();
    let asked = project.axes.iter().zip(&selections);
    let asked = asked.map(|(axis, selection)| match &axis.drive {
        Some(name) => Asked::named(selection, name),
        None => Ok(None),
    });
    let asked = asked.collect::<std::result::Result<Vec<_>, _>>()?;
    let date = output::today();
    let mut axes = Vec::new();
    for (((axis, own), selection), asked) in
        project.axes.iter().zip(&each).zip(&selections).zip(&asked)
    {
        let source = Source {
            name: &own.name,
            text: &own.text,
            date: &date,
            parts: &own.catalogue,
        };
        axes.push(view(axis, own, selection, asked.as_ref(), source, &supply)?);
    }
    let bus = if project.common_bus {
        Some(on_bus(&project, &axes, &supply, &catalogue)?)
    } else {
        None
    };
    let chosen = bus.as_ref().and_then(|bus| bus.chosen.as_ref());
    let resistor = chosen.and_then(|key| catalogue.resistors.iter().find(|r| r.key == *key));
    let shown = ProjectView {
        project: &project,
        axes,
        bus: bus.as_ref(),
        resistor,
        date: &date,
    };
    let mut answer = shown.answer();
    let page = || page::project_page(&shown).map_err(core_report);
    let workbook = || Ok(shown.answer());
    let (lines, printed) = documents::write(&options.documents, Files::default(), page, workbook)?;
    for line in lines {
        answer.sentence(line);
    }
    match options.format.of_answer() {
        Some(format) => print_answer(&answer, format)?,
        None => print(&environment(shown.axes.iter().map(sized)))?,
    };
    printed?;
    Ok(Completion::of(shown.holds()))
}

fn sized<'a>(view: &'a AxisView<'a>) -> SizedAxis<'a> {
    SizedAxis {
        source: &view.source,
        file: view.listing.file,
        axis: Some(&view.axis.name),
        duration: view.listing.duty.duration,
        judged: &view.judged,
    }
}

/// The machine file of an axis, in the surroundings of the project unless it has its own.
fn read_axis(path: &Path, axis: &ProjectAxis, project: &Project) -> Result<MachineFile> {
    if !disk::exists(path) {
        return Err(miette!(
            help = "the path counts from the folder of the project file: correct `machine` of this [[axis]]",
            "axis \"{}\" of {} names the machine file {}, which does not exist",
            axis.name,
            project.name,
            plain::path(path)
        ));
    }
    let mut file = read_warned(path)?;
    variator::refuse(&file, "project")?;
    if file.site.surroundings == Site::default().surroundings {
        file.site.surroundings = project.site.surroundings;
    }
    Ok(file)
}

/// Gives every axis its supply; returns that of the common bus. The supply of the project replaces those of the axes on a common bus; without it, the
/// axes' files must agree. All axes are on the same mains.
fn supplies(project: &Project, files: &mut [(MachineFile, PathBuf)]) -> Result<Site> {
    let given = project.site.supply.given;
    let voltage = |site: &Site| (site.mains_voltage, site.bus_voltage);
    let own = files
        .iter()
        .map(|(file, _)| (&file.site, file.name.clone()));
    let [own, shared] = if given {
        common(std::iter::once((&project.site, project.name.clone())))?
    } else {
        common(own)?
    };
    for (file, _) in files {
        if file.site.supply.given && voltage(&file.site) != voltage(&own) {
            return Err(miette!(
                help = "all axes of a project are on one supply: correct [supply] in one of the two, or make two projects",
                "{} is for {}, and {} for {}",
                file.name,
                words(&file.site),
                project.name,
                words(&own)
            ));
        }
        let keeps = !project.common_bus && file.site.supply.given;
        file.site.bus_voltage = own.bus_voltage;
        file.site.mains_voltage = own.mains_voltage;
        if !keeps {
            file.site.supply = if project.common_bus {
                shared.supply
            } else {
                own.supply
            };
        }
    }
    Ok(own)
}

/// The voltage of a supply.
fn words(site: &Site) -> String {
    match (site.mains_voltage, site.bus_voltage) {
        (Some(mains), _) => format!("mains of {mains} V"),
        (None, Some(bus)) => format!("a DC bus of {bus} V"),
        (None, None) => "a supply of unknown voltage".to_owned(),
    }
}

fn prepared(
    path: &Path,
    file: MachineFile,
    catalogue: &Catalogue,
    options: &Options,
) -> Result<Prepared> {
    let mut catalogue = catalogue.clone();
    fit_input(&mut catalogue, &file)?;
    let duty = Duty::new(&file, file.required_motion()?, options.sampling.sampling())
        .map_err(duty_report)?;
    Ok(Prepared {
        name: plain::path(path),
        text: read::text(path)?,
        cycle: Cycle::new(&duty),
        duty,
        motors: catalogue.prepare(&file.site),
        catalogue,
        warnings: warnings(&file).map_err(core_report)?,
        file,
    })
}

fn view<'a>(
    axis: &'a ProjectAxis,
    own: &'a Prepared,
    selection: &'a Selection<'a>,
    asked: Option<&'a Asked<'a>>,
    source: Source<'a>,
    supply: &Site,
) -> Result<AxisView<'a>> {
    let listing = Listing {
        file: &own.file,
        duty: &own.duty,
        selection,
        warnings: &own.warnings,
        motion: None,
        asked,
        explanation: None,
        list: List::default(),
    };
    let candidate = listing.shown().ok_or_else(|| {
        miette!(
            help = "give a catalogue with at least one motor",
            "no drive can be built for axis \"{}\"",
            axis.name
        )
    })?;
    let judged = selection.judged(&candidate);
    let (drive, limits) = (&candidate.drive, candidate.motor);
    Ok(AxisView {
        bus: BusAxis::new(
            &axis.name,
            drive,
            limits,
            &own.cycle,
            supply,
            own.file.site.drive_stop,
            judged.holds(),
        ),
        axis,
        listing,
        source,
        judged,
    })
}

/// All drives on one bus: at their phases, or at any.
fn on_bus(
    project: &Project,
    axes: &[AxisView],
    supply: &Site,
    catalogue: &Catalogue,
) -> Result<BusAnalysis> {
    let fixed = project.axes.iter().all(|axis| axis.phase.is_some());
    let drives = axes.iter().flat_map(|view| {
        let axis = view.axis;
        (0..axis.quantity).map(move |k| {
            let title = match axis.quantity {
                1 => axis.name.clone(),
                _ => format!("{} {}", axis.name, k + 1),
            };
            BusAxis {
                title,
                curve: view.bus.curve.shifted(axis.phase.unwrap_or(0.0)),
                ..view.bus.clone()
            }
        })
    });
    busy::rows(0, 0);
    let bar = ProgressBar::new(0);
    let found = BusAnalysis::new(
        drives.collect(),
        fixed,
        &supply.supply,
        catalogue,
        &Bar(&bar),
    )?;
    bar.finish_and_clear();
    Ok(found)
}
