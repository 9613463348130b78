//! `jred bus`: axes on one DC bus.

use std::path::Path;

use miette::{IntoDiagnostic as _, Result, miette};

use super::axes::{Axes, Bounds, Goal, Worst};
use super::curve::PowerCurve;
use super::store::BusFigures;
use super::supply::{BusData, Supply};
use super::{Need, power};
use crate::catalogue::Catalogue;
use crate::cli::bus::Bus as Options;
use crate::commands::{Done, fit_input, print};
use crate::cycle::Cycle;
use crate::duty::Duty;
use crate::listing;
use crate::machine::MachineFile;
use crate::output::Format;
use crate::size::Selection;
use crate::{input, variator};

/// One axis: its drive, and what it draws.
pub(super) struct Axis {
    pub(super) title: String,
    pub(super) drive: String,
    pub(super) curve: PowerCurve,
    pub(super) data: BusData,
    pub(super) holds: bool,
}

/// What the axes do on their bus.
pub(super) struct Answer {
    pub(super) axes: Vec<Axis>,
    pub(super) data: BusData,
    pub(super) shared: Axes,
    pub(super) in_step: Option<BusFigures>,
    pub(super) power: Option<PowerCurve>,
    /// Worst phases for the voltage and for the brake resistor.
    pub(super) worst: Option<[Worst; 2]>,
    pub(super) bounds: Bounds,
    pub(super) need: Option<Need>,
    pub(super) proposal: Option<String>,
}

/// Runs the command.
///
/// # Errors
/// Bad input.
pub fn run(options: &Options) -> Result<Done> {
    let catalogue = options.catalogue.open()?;
    let files = options.files.iter().map(|path| input::read(path));
    let files = files.collect::<Result<Vec<MachineFile>>>()?;
    same_supply(options, &files)?;
    let named = named(options)?;
    let mut axes = Vec::new();
    for (k, (path, file)) in options.files.iter().zip(&files).enumerate() {
        let name = named
            .iter()
            .find(|(axis, _)| *axis == k)
            .map(|(_, n)| n.as_str());
        axes.push(axis(path, file, &catalogue, name, options.steps)?);
    }
    let answer = Answer::new(options, axes, &files[0].site.supply, &catalogue)?;
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

/// All axes hang on the bus of the first file: another file may leave its supply out, or say the same.
fn same_supply(options: &Options, files: &[MachineFile]) -> Result<()> {
    let supply = |file: &MachineFile| (file.site.supply, file.site.bus_voltage);
    let Some(first) = files.first().map(supply) else {
        return Ok(());
    };
    for (path, file) in options.files.iter().zip(files).skip(1) {
        if file.site.supply.given && supply(file) != first {
            return Err(miette!(
                help = "axes on one bus have one supply: leave [supply] out of all files but the first, or make them equal",
                "{} has another [supply] than {}",
                path.display(),
                options.files[0].display()
            ));
        }
    }
    Ok(())
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
                    "write N=MOTOR+GEARBOX with N from 1 to {count}, the place of the machine file on the command line"
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
    let selection = Selection::new(&own, &motors, &cycle, &file.site, &file.rules);
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
        data: BusData::new(
            &file.site.supply,
            file.site.bus_voltage,
            drive.amplifier,
            drive.motor,
        ),
        holds: selection.judged(candidate).holds(),
    })
}

impl Answer {
    fn new(
        options: &Options,
        axes: Vec<Axis>,
        supply: &Supply,
        catalogue: &Catalogue,
    ) -> Result<Self> {
        let mut data = axes[0].data;
        // Without a capacitance in [supply] those of the amplifiers on the bus add up.
        if supply.capacitance.is_none() {
            data.capacitance = axes.iter().map(|axis| axis.data.capacitance).sum();
        }
        let bus = data.bus().map_err(|missing| {
            miette!(
                help = "add a [supply] to the first machine file, for example mains_voltage = \"400 V\", capacitance = \"470 uF\", \
                        chopper_voltage = \"780 V\", max_voltage = \"820 V\"; docs/thermal-and-bus.md has all keys",
                "the DC bus is not known: {missing} is missing"
            )
        })?;
        let curves: Vec<PowerCurve> = axes.iter().map(|axis| axis.curve.clone()).collect();
        let shared = Axes::new(bus, curves);
        let together = vec![0.0; axes.len()];
        let worst = if options.in_step {
            None
        } else {
            let of = |goal| shared.worst(goal);
            of(Goal::Voltage)
                .zip(of(Goal::Resistor))
                .map(|(v, r)| [v, r])
        };
        // What a resistor must bear is asked at the phases that burn most.
        let phases = worst
            .as_ref()
            .map_or(&together, |[_, resistor]| &resistor.phases);
        let need = shared
            .power(phases)
            .and_then(|power| Need::of(&data, &power));
        let proposal = need
            .as_ref()
            .and_then(|need| need.proposal(&catalogue.resistors));
        Ok(Self {
            in_step: shared.at(&together),
            power: shared.power(&together),
            worst,
            bounds: shared.bounds(),
            need,
            proposal: proposal.map(|resistor| resistor.key.clone()),
            axes,
            data,
            shared,
        })
    }

    /// Mean power of separate resistors less that of a common one (W), all axes in step; the common one only where it is known.
    pub(super) fn saved(&self) -> Option<f64> {
        self.data.resistor?;
        let period = self.power.as_ref()?.period();
        Some(self.shared.apart() - self.in_step?.burnt / period)
    }
}
