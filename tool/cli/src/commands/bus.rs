//! `jred bus`: axes on one DC bus.

use std::path::Path;

use miette::{Result, miette};

use indicatif::ProgressBar;

use crate::busy;
use crate::commands::core_error::duty_report;
use crate::commands::{Completion, print_answer, read_warned};
use crate::options::bus::Bus as Options;
use crate::options::sampling::SamplingOptions;
use jred_analysis::duty::{Duty, Sampling};
use jred_file::model::machine::MachineFile;
use jred_file::model::site::Site;
use jred_file::model::supply::Supply;
use jred_file::model::variator;
use jred_file::plain;
use jred_file::read;
use jred_report::list::{self, listing};
use jred_sizing::bus::Watch;
use jred_sizing::bus::analysis::{BusAnalysis, BusAxis};
use jred_sizing::catalogue::Catalogue;
use jred_sizing::cycle::Cycle;
use jred_sizing::select::fit::fit_input;
use jred_sizing::select::size::Selection;

/// Shows the progress of a search.
pub(super) struct Bar<'a>(pub(super) &'a ProgressBar);

impl Watch for Bar<'_> {
    fn planned(&self, count: u64) {
        self.0.inc_length(count);
    }

    fn done(&self, count: u64) {
        self.0.inc(count);
    }
}

/// Runs the command.
///
/// # Errors
/// Bad input.
pub fn run(options: &Options) -> Result<Completion> {
    bounded(options.files.len(), &options.sampling)?;
    let catalogue = options.catalogue.open()?;
    let files = options.files.iter().map(|path| read_warned(path));
    let mut files = files.collect::<Result<Vec<MachineFile>>>()?;
    let sites = (files.iter()).map(|file| (&file.site, file.name.clone()));
    let [own, shared] = common(sites)?;
    let named = named(options)?;
    let mut axes = Vec::new();
    for (k, (path, file)) in options.files.iter().zip(&mut files).enumerate() {
        let name = named
            .iter()
            .find(|(axis, _)| *axis == k)
            .map(|(_, n)| n.as_str());
        file.site.bus_voltage = own.bus_voltage;
        file.site.mains_voltage = own.mains_voltage;
        file.site.supply = shared.supply;
        axes.push(axis(
            path,
            file,
            &own,
            &catalogue,
            name,
            options.sampling.sampling(),
        )?);
    }
    // Drawn on standard error, only if it is a terminal.
    busy::rows(0, 0);
    let bar = ProgressBar::new(0);
    let answer = BusAnalysis::new(axes, options.in_step, &own.supply, &catalogue, &Bar(&bar))?;
    bar.finish_and_clear();
    print_answer(&list::bus::answer(&answer, options.format)?, options.format)?;
    Ok(Completion::of(answer.holds()))
}

/// Largest number of time steps of all axes together, about 150 bytes each.
const MOST_STEPS: usize = 2_000_000;

/// Refuses axes and steps that need too much memory.
pub(super) fn bounded(axes: usize, sampling: &SamplingOptions) -> Result<()> {
    let steps = sampling.sampling().steps;
    if axes * steps <= MOST_STEPS {
        return Ok(());
    }
    Err(miette!(
        help = format!("use --steps {} or fewer", MOST_STEPS / axes),
        "{axes} axes of {steps} steps are too many: {} in all, at most {MOST_STEPS}",
        axes * steps
    ))
}

/// The supply of the bus, and the site for each axis, from the sites of files and their names. One describes the common bus; the others have no supply
/// or the same one. Regenerated energy is checked on the common bus, not for each axis alone.
pub(super) fn common<'f>(sites: impl Iterator<Item = (&'f Site, String)>) -> Result<[Site; 2]> {
    let stated = |site: &Site| (site.supply, site.bus_voltage, site.mains_voltage);
    let mut given = sites.filter(|(site, _)| site.supply.given);
    let first = given.next();
    if let Some((site, name)) = &first
        && let Some((_, other)) = given.find(|(other, _)| stated(other) != stated(site))
    {
        return Err(miette!(
            help =
                "all axes share one supply: remove [supply] from one file or make both identical",
            "[supply] in {other} differs from that in {name}"
        ));
    }
    let (supply, bus_voltage, mains_voltage) =
        first.map(|(site, _)| stated(site)).unwrap_or_default();
    let site = |supply| Site {
        bus_voltage,
        mains_voltage,
        supply,
        ..Site::default()
    };
    let elsewhere = Supply {
        regenerative: true,
        ..Supply::default()
    };
    Ok([site(supply), site(elsewhere)])
}

/// The drives named with --drive: index of the axis, name.
fn named(options: &Options) -> Result<Vec<(usize, String)>> {
    let count = options.files.len();
    let mut named: Vec<(usize, String)> = Vec::new();
    for text in &options.drive {
        let read = text.split_once('=').and_then(|(axis, name)| {
            let axis = axis.trim().parse::<usize>().ok()?;
            (1..=count)
                .contains(&axis)
                .then(|| (axis - 1, name.trim().to_owned()))
        });
        let Some((axis, name)) = read else {
            return Err(miette!(
                help = format!(
                    "write N=MOTOR+GEARBOX, or N=MOTOR+GEARBOX on AMPLIFIER, with N from 1 to {count}, the place of the machine file on the command line"
                ),
                "--drive {} cannot be used",
                plain::quoted(text)
            ));
        };
        if named.iter().any(|(known, _)| *known == axis) {
            return Err(miette!(
                help = "remove one of the two options",
                "--drive names axis {} twice",
                axis + 1
            ));
        }
        named.push((axis, name));
    }
    Ok(named)
}

fn axis(
    path: &Path,
    file: &MachineFile,
    bus: &Site,
    catalogue: &Catalogue,
    name: Option<&str>,
    sampling: Sampling,
) -> Result<BusAxis> {
    variator::refuse(file, "bus")?;
    let motion = file.required_motion()?;
    let mut own = catalogue.clone();
    fit_input(&mut own, file)?;
    let duty = Duty::new(file, motion, sampling).map_err(duty_report)?;
    let cycle = Cycle::new(&duty);
    let motors = own.prepare(&file.site);
    let selection = Selection::parallel(&own, &motors, &cycle, &file.site, &file.rules);
    let candidate = listing::explained(&selection, name)?.ok_or_else(|| {
        miette!(
            help = "give a catalogue with at least one motor",
            "no drive can be built for {}",
            read::name(path)
        )
    })?;
    let holds = selection.judged(&candidate).holds();
    let (drive, limits) = (&candidate.drive, candidate.motor);
    let stop = file.site.drive_stop;
    Ok(BusAxis::new(
        &file.title,
        drive,
        limits,
        &cycle,
        bus,
        stop,
        holds,
    ))
}
