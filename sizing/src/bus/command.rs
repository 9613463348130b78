//! `jred bus`: axes on one DC bus.

use std::path::Path;

use miette::{IntoDiagnostic as _, Result, miette};

use indicatif::ProgressBar;

use super::axes::{Axes, Bounds, Worst};
use super::cure::{Cure, share};
use super::curve::PowerCurve;
use super::store::BusFigures;
use super::supply::BusData;
use super::{Need, Watch, power};
use crate::catalogue::Catalogue;
use crate::cli::bus::Bus as Options;
use crate::commands::{Done, fit_input, print};
use crate::cycle::Cycle;
use crate::duty::Duty;
use crate::listing;
use crate::machine::MachineFile;
use crate::output::Format;
use crate::site::Site;
use crate::size::Selection;
use crate::supply::Supply;
use crate::{input, variator};

/// One axis: its drive, and what it draws.
pub(super) struct Axis {
    pub(super) title: String,
    pub(super) drive: String,
    pub(super) curve: PowerCurve,
    data: BusData,
    pub(super) holds: bool,
}

/// What the axes do on their bus.
pub(super) struct Answer {
    pub(super) axes: Vec<Axis>,
    pub(super) data: BusData,
    pub(super) shared: Axes,
    pub(super) in_step: Option<BusFigures>,
    pub(super) power: Option<PowerCurve>,
    /// Worst phases, in the order of [`Goal::ALL`](super::axes::Goal::ALL).
    pub(super) worst: Option<[Worst; 4]>,
    /// The phases that take the smallest share of the limits.
    pub(super) calmest: Option<Worst>,
    pub(super) bounds: Bounds,
    /// The brake resistor that is needed where there is none, or none that does.
    pub(super) need: Option<Need>,
    pub(super) proposal: Option<String>,
    pub(super) cures: Vec<Cure>,
}

impl Watch for ProgressBar {
    fn planned(&self, count: u64) {
        self.inc_length(count);
    }

    fn done(&self, count: u64) {
        self.inc(count);
    }
}

/// Runs the command.
///
/// # Errors
/// Bad input.
pub fn run(options: &Options) -> Result<Done> {
    let catalogue = options.catalogue.open()?;
    let files = options.files.iter().map(|path| input::read(path));
    let mut files = files.collect::<Result<Vec<MachineFile>>>()?;
    let [own, common] = supply(options, &files)?;
    let named = named(options)?;
    let mut axes = Vec::new();
    for (k, (path, file)) in options.files.iter().zip(&mut files).enumerate() {
        let name = named
            .iter()
            .find(|(axis, _)| *axis == k)
            .map(|(_, n)| n.as_str());
        file.site.bus_voltage = own.bus_voltage;
        file.site.supply = common.supply;
        axes.push(axis(path, file, &own, &catalogue, name, options.steps)?);
    }
    // Drawn on standard error, and only where that is a terminal.
    let bar = ProgressBar::new(0);
    let answer = Answer::new(options, axes, &own.supply, &catalogue, &bar)?;
    bar.finish_and_clear();
    match options.format {
        Format::Table => print(&answer.text(options))?,
        Format::Csv => print(&answer.csv()?)?,
        Format::Json => print(&format!("{:#}\n", answer.json(options)))?,
    };
    Ok(if answer.holds(options) {
        Done::Holds
    } else {
        Done::Violated
    })
}

/// The supply of the bus, and with what an axis is judged: all axes hang on the bus that one of the files states; the others
/// leave their supply out, or say the same. What comes back is judged on the bus of all, and not for each axis alone.
fn supply(options: &Options, files: &[MachineFile]) -> Result<[Site; 2]> {
    let stated = |file: &MachineFile| (file.site.supply, file.site.bus_voltage);
    let mut given = (options.files.iter().zip(files))
        .filter(|(_, file)| file.site.supply.given)
        .map(|(path, file)| (path, stated(file)));
    let first = given.next();
    if let Some((path, stated)) = &first
        && let Some((other, _)) = given.find(|(_, other)| other != stated)
    {
        return Err(miette!(
            help = "axes on one bus have one supply: leave [supply] out of one of the files, or make them equal",
            "{} has another [supply] than {}",
            other.display(),
            path.display()
        ));
    }
    let (supply, bus_voltage) = first.map_or((Supply::default(), None), |(_, stated)| stated);
    let site = |supply| Site {
        bus_voltage,
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
                "--drive {text:?} cannot be used"
            ));
        };
        if named.iter().any(|(known, _)| *known == axis) {
            return Err(miette!(
                help = "leave one of them out",
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
    steps: u32,
) -> Result<Axis> {
    variator::refuse(file, "bus")?;
    let motion = file.motion.as_ref().ok_or_else(|| {
        miette!(
            help = "add a [motion], for example type = \"constant-speed\", speed = \"60 rpm\"",
            "{} has no [motion]",
            path.display()
        )
    })?;
    let mut own = catalogue.clone();
    fit_input(&mut own, file)?;
    let duty = Duty::new(file, motion, steps as usize).into_diagnostic()?;
    let cycle = Cycle::new(&duty);
    let motors = own.prepare(&file.site);
    let selection = Selection::parallel(&own, &motors, &cycle, &file.site, &file.rules);
    let candidate = listing::explained(&selection, name)?.ok_or_else(|| {
        miette!(
            help = "give a catalogue with at least one motor",
            "there is no drive for {}",
            path.display()
        )
    })?;
    let drive = &candidate.drive;
    let curve = power(
        &cycle,
        &drive.coefficients(),
        drive.ratio(),
        drive.motor,
        candidate.motor.on(drive.amplifier),
        drive.amplifier,
    );
    Ok(Axis {
        title: file.title.clone(),
        drive: drive.name(),
        curve,
        data: BusData::new(&bus.supply, bus.bus_voltage, drive.amplifier, drive.motor),
        holds: selection.judged(&candidate).holds(),
    })
}

impl Answer {
    fn new(
        options: &Options,
        axes: Vec<Axis>,
        supply: &Supply,
        catalogue: &Catalogue,
        watch: &dyn Watch,
    ) -> Result<Self> {
        let each: Vec<BusData> = axes.iter().map(|axis| axis.data).collect();
        let data = BusData::shared(supply, &each);
        let bus = data.bus().map_err(|missing| {
            miette!(
                help = "add a [supply] to one of the machine files, for example mains_voltage = \"400 V\", capacitance = \"470 uF\", \
                        chopper_voltage = \"780 V\", max_voltage = \"820 V\"; docs/thermal-and-bus.md has all keys",
                "the DC bus is not known: {missing} is missing"
            )
        })?;
        let curves: Vec<PowerCurve> = axes.iter().map(|axis| axis.curve.clone()).collect();
        let shared = Axes::new(bus, curves);
        let together = vec![0.0; axes.len()];
        let mut answer = Self {
            in_step: shared.at(&together),
            power: shared.power(&together),
            worst: None,
            calmest: None,
            bounds: shared.bounds(),
            need: None,
            proposal: None,
            cures: Vec::new(),
            axes,
            data,
            shared,
        };
        if !options.in_step {
            answer.search(watch);
        }
        if answer.asks_for_a_resistor(options) {
            answer.need = match &answer.power {
                Some(power) if options.in_step => Need::of(&data, power),
                _ => Need::over(&data, &answer.shared, watch),
            };
            let proposal = answer
                .need
                .and_then(|need| need.proposal(&catalogue.resistors));
            answer.proposal = proposal.map(|resistor| resistor.key.clone());
        }
        if options.in_step && !answer.failed(options).is_empty() {
            answer.search(watch);
            answer.worst = None;
        }
        answer.cures = answer.cures(options, watch);
        Ok(answer)
    }

    /// The worst phases, and those with the most room.
    fn search(&mut self, watch: &dyn Watch) {
        let Some(period) = self.power.as_ref().map(PowerCurve::period) else {
            return;
        };
        let limits = self.limits();
        let goals = |figures: &BusFigures| {
            [
                figures.highest,
                figures.burnt,
                figures.burnt_peak,
                figures.pulse,
                -share(limits, figures, period),
            ]
        };
        if let Some([voltage, resistor, peak, pulse, calmest]) = self.shared.largest(goals, watch) {
            self.worst = Some([voltage, resistor, peak, pulse]);
            self.calmest = Some(calmest);
        }
    }

    /// Whether what comes back goes beyond what the bus, with the resistor that it has, may do.
    fn asks_for_a_resistor(&self, options: &Options) -> bool {
        if self.data.resistor.is_some() {
            return !self.failed(options).is_empty();
        }
        let voltage = self.judged(options)[0];
        // Not known: more than the capacitor of which nothing is known can be said to take.
        let top = self.data.max_voltage.or(self.data.chopper_voltage);
        top.is_some_and(|top| voltage.is_nan() || voltage > top)
    }

    /// Mean power of separate resistors less that of a common one (W), all axes in step; of several axes, where the resistor is
    /// known.
    pub(super) fn saved(&self) -> Option<f64> {
        self.data.resistor.filter(|_| self.axes.len() > 1)?;
        let period = self.power.as_ref()?.period();
        Some(self.shared.apart() - self.in_step?.burnt / period)
    }
}
