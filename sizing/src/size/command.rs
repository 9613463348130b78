//! `jred size`.

use std::path::Path;

use miette::{IntoDiagnostic as _, Result};

use super::Selection;
use crate::cli::Size;
use crate::commands::{Done, fit_input, motion, print, write};
use crate::cycle::Cycle;
use crate::duty::Duty;
use crate::judge::Context;
use crate::machine::MachineFile;
use crate::meter::MeterLimits;
use crate::output::Format;
use crate::pareto::Front;
use crate::vary::command::catalogue;
use crate::{input, listing, report, variator};

/// Runs `jred size`.
///
/// # Errors
/// Bad input, or a file that cannot be written.
pub fn size(options: &Size) -> Result<Done> {
    let mut file = input::read(&options.file)?;
    if let Some(word) = &options.supply.rules {
        file.rules = crate::rules::command::chosen(&file.rules, word)?;
    }
    variator::refuse(&file, "size")?;
    let motion = motion(&file, &options.file)?;
    let filter = options.search.filter();
    let mut catalogue = catalogue(&options.supply, &filter)?;
    let objectives = options.pareto.as_ref().map_or(&[][..], |o| &o.0);
    options.search.check(&catalogue, objectives)?;
    fit_input(&mut catalogue, &file)?;
    let duty = Duty::new(&file, motion, options.supply.steps as usize).into_diagnostic()?;
    let cycle = Cycle::new(&duty);
    let motors = catalogue.prepare(&file.site);
    let mut selection = Selection::parallel(&catalogue, &motors, &cycle, &file.site, &file.rules);
    for gap in options.search.apply(&filter, &mut selection) {
        eprintln!("mind: {gap}");
    }
    let selection = selection;
    if let Some(objectives) = &options.pareto {
        let front = Front::new(&selection, &objectives.0);
        let title = format!(
            "{}: the Pareto front of the drives that break no rule",
            file.title
        );
        print(&front.write(options.format, &title))?;
        return Ok(if front.points.is_empty() {
            Done::Violated
        } else {
            Done::Holds
        });
    }
    if let Some(path) = &options.report {
        let name = options.file.display().to_string();
        let page = report::page(&name, &file, &duty, &selection).into_diagnostic()?;
        write(path, page.unwrap_or_default().as_bytes(), &options.file)?;
    }
    let list = listing::List {
        top: options.top,
        nearest: options.nearest,
        refused: options.refused,
        all: options.all,
    };
    let asked = match &options.why {
        Some(name) => listing::Asked::named(&selection, name)?,
        None => None,
    };
    let asked = asked.as_ref();
    let meter = match &options.meter {
        Some(path) => write_meter(path, options, asked, &file, &selection)?,
        None => false,
    };
    let explanation = explanation(options, asked, &file, &duty, &selection)?;
    let explanation = explanation.as_ref();
    match options.format {
        Format::Table => {
            print(&listing::text(
                list,
                &file,
                &duty,
                &selection,
                asked,
                explanation,
            ))?;
            if let Some(path) = &options.report {
                print(&format!("report written to {}\n", path.display()))?;
            }
            if let Some(path) = options.meter.as_ref().filter(|_| meter) {
                print(&format!(
                    "limits for the duty meter written to {}\n",
                    path.display()
                ))?;
            }
        }
        Format::Csv => {
            print(&listing::csv(list, &selection))?;
        }
        Format::Json => {
            let answer = listing::json(list, &file, &duty, &selection, asked, explanation);
            print(&format!("{answer:#}\n"))?;
        }
    }
    Ok(if selection.fit.is_empty() {
        Done::Violated
    } else {
        Done::Holds
    })
}

/// Writes the limits of the drive that was asked for, else of the best that holds; whether there was one.
fn write_meter(
    path: &Path,
    options: &Size,
    asked: Option<&listing::Asked>,
    file: &MachineFile,
    selection: &Selection,
) -> Result<bool> {
    let best = || selection.first_fit(1).first().copied();
    let Some(candidate) = asked.map(|asked| asked.candidate).or_else(best) else {
        eprintln!(
            "no drive holds: {} is not written (--why DRIVE writes the limits of one that does not)",
            path.display()
        );
        return Ok(false);
    };
    let context = Context::new(
        selection.cycle,
        selection.site,
        candidate.drive,
        candidate.motor,
    );
    let limits = MeterLimits::new(&context, selection.rules);
    let name = options.file.file_name().unwrap_or_default();
    let machine = format!("{}, {}", name.display(), file.title);
    write(path, limits.source(&machine).as_bytes(), &options.file)?;
    Ok(true)
}

/// What was asked to be explained; in words, the nearest refused drives also where none holds.
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
        return explanation.map(Some).into_diagnostic();
    }
    if options.format == Format::Table && selection.fit.is_empty() {
        let nearest = Explanation::of_refused(file, duty, selection, options.nearest);
        return nearest.map(Some).into_diagnostic();
    }
    Ok(None)
}
