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
use crate::output::{Format, short};
use crate::rule::Sense;
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

/// A figure of the bus beside its limit.
pub(super) struct BusCheck {
    pub(super) name: &'static str,
    pub(super) unit: &'static str,
    /// NaN: not known.
    pub(super) figure: f64,
    /// `None`: none is stated, but the figure is beyond any.
    pub(super) limit: Option<f64>,
    pub(super) sense: Sense,
}

impl BusCheck {
    /// Whether the figure keeps its limit; `None`: it is not known.
    pub(super) fn holds(&self) -> Option<bool> {
        (!self.figure.is_nan()).then(|| {
            self.limit.is_some_and(|limit| match self.sense {
                Sense::AtMost => self.figure <= limit,
                Sense::AtLeast => self.figure >= limit,
            })
        })
    }
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

    /// The figures that are judged: highest voltage, mean power, largest power and pulse of the resistor; NaN where one is not
    /// known.
    fn judged(&self, options: &Options) -> [f64; 4] {
        let mut judged = self.found(options);
        // Nothing takes up what comes back, or nobody said what does.
        if judged[0].is_infinite() && self.data.capacitance.is_none() {
            judged[0] = f64::NAN;
        }
        judged
    }

    fn found(&self, options: &Options) -> [f64; 4] {
        let of = |figures: &BusFigures, period: f64| {
            [
                figures.highest,
                figures.burnt / period,
                figures.burnt_peak,
                figures.pulse,
            ]
        };
        let period = self.power.as_ref().map_or(1.0, PowerCurve::period);
        match (&self.in_step, &self.worst) {
            (Some(figures), _) if options.in_step => of(figures, period),
            (Some(_), Some([voltage, resistor])) => {
                let (a, b) = (of(&voltage.figures, period), of(&resistor.figures, period));
                std::array::from_fn(|k| a[k].max(b[k]))
            }
            _ => [
                self.bounds.highest,
                self.bounds.resistor,
                if self.data.resistor.is_some() {
                    self.bounds.back
                } else {
                    0.0
                },
                f64::NAN,
            ],
        }
    }

    /// What is judged; only where there is a limit.
    pub(super) fn checks(&self, options: &Options) -> Vec<BusCheck> {
        let [voltage, mean, peak, pulse] = self.judged(options);
        let resistor = self.data.resistor.as_ref();
        let least = self.data.min_resistance;
        let at_most = |name, unit, figure, limit| (name, unit, figure, limit, Sense::AtMost);
        [
            at_most("bus voltage", "V", voltage, self.data.max_voltage),
            (
                "brake resistance",
                "Ohm",
                resistor.map_or(f64::NAN, |r| r.resistance),
                least.filter(|_| resistor.is_some()),
                Sense::AtLeast,
            ),
            at_most(
                "brake resistor mean power",
                "W",
                mean,
                resistor.map(|r| r.power),
            ),
            at_most(
                "brake resistor peak power",
                "W",
                peak,
                resistor.and_then(|r| r.peak_power),
            ),
            at_most(
                "brake resistor pulse energy",
                "W s",
                pulse,
                resistor.and_then(|r| r.pulse_energy),
            ),
        ]
        .into_iter()
        .map(|(name, unit, figure, limit, sense)| BusCheck {
            name,
            unit,
            figure,
            limit,
            sense,
        })
        // A voltage without bound is beyond any limit.
        .filter(|check| check.limit.is_some() || check.figure.is_infinite())
        .collect()
    }

    /// What could not be checked, and what is missing for it.
    pub(super) fn not_checked(&self, options: &Options) -> Vec<String> {
        let [voltage, _, peak, pulse] = self.judged(options);
        let data = &self.data;
        let mut missing = Vec::new();
        if voltage.is_nan() {
            missing.push(
                "bus voltage: the capacitance of the DC bus is not known, and there is no brake resistor for what comes back"
                    .to_owned(),
            );
        } else if data.max_voltage.is_none() && voltage.is_finite() {
            let rise = data.voltage.filter(|volts| voltage > *volts);
            let rise = rise.map_or(String::new(), |volts| {
                let bare = if data.resistor.is_none() && !data.regenerative {
                    " without a brake resistor"
                } else {
                    ""
                };
                format!(
                    ", and it rises from {} V to {} V{bare}: give max_voltage in [supply]",
                    short(volts),
                    short(voltage)
                )
            });
            missing.push(format!(
                "bus voltage: the highest voltage of the DC bus is not known{rise}"
            ));
        }
        let Some(resistor) = data.resistor.as_ref().filter(|_| peak > 0.0) else {
            return missing;
        };
        let mut without = |known: bool, words: &str| {
            if !known {
                missing.push(words.to_owned());
            }
        };
        without(
            data.min_resistance.is_some(),
            "brake resistance: the smallest resistance that the chopper may switch is not known",
        );
        without(
            resistor.peak_power.is_some(),
            "brake resistor peak power: that of the resistor is not known",
        );
        without(
            resistor.pulse_energy.is_some(),
            "brake resistor pulse energy: that of the resistor is not known",
        );
        without(
            !pulse.is_nan() || resistor.pulse_energy.is_none(),
            "brake resistor pulse energy: the cycles have no common period",
        );
        missing
    }

    /// Whether nothing that was checked is violated; what was not is [named](Self::not_checked).
    pub(super) fn holds(&self, options: &Options) -> bool {
        let checks = self.checks(options);
        self.axes.iter().all(|axis| axis.holds) && checks.iter().all(|c| c.holds() != Some(false))
    }

    /// Mean power of separate resistors less that of a common one (W), all axes in step; the common one only where it is known.
    pub(super) fn saved(&self) -> Option<f64> {
        self.data.resistor?;
        let period = self.power.as_ref()?.period();
        Some(self.shared.apart() - self.in_step?.burnt / period)
    }
}
