//! `jred bus`: axes on one DC bus.

use std::fmt::Write as _;
use std::path::Path;

use miette::{IntoDiagnostic as _, Result, miette};
use serde_json::json;

use super::axes::{Axes, Bounds, Goal, Worst};
use super::curve::PowerCurve;
use super::store::BusFigures;
use super::supply::BusData;
use super::{Need, power};
use crate::catalogue::Catalogue;
use crate::cli::bus::Bus as Options;
use crate::commands::{Done, fit_input, print};
use crate::cycle::Cycle;
use crate::duty::Duty;
use crate::listing;
use crate::machine::MachineFile;
use crate::output::{Columns, Format, short};
use crate::size::Selection;
use crate::{input, variator};

/// One axis: its drive, and what it draws.
struct Axis {
    title: String,
    drive: String,
    curve: PowerCurve,
    data: BusData,
    holds: bool,
}

/// What the axes do on their bus.
struct Answer {
    axes: Vec<Axis>,
    data: BusData,
    shared: Axes,
    in_step: Option<BusFigures>,
    power: Option<PowerCurve>,
    /// Worst phases for the voltage and for the brake resistor.
    worst: Option<[Worst; 2]>,
    bounds: Bounds,
    need: Option<Need>,
    proposal: Option<String>,
}

/// Runs the command.
///
/// # Errors
/// Bad input.
pub fn run(options: &Options) -> Result<Done> {
    let mut catalogue = options.catalogue.open()?;
    let files = options.files.iter().map(|path| input::read(path));
    let files = files.collect::<Result<Vec<MachineFile>>>()?;
    same_supply(options, &files)?;
    let named = named(options)?;
    let mut axes = Vec::new();
    for (k, (path, file)) in options.files.iter().zip(&files).enumerate() {
        let name = named.iter().find(|(axis, _)| *axis == k).map(|(_, n)| n.as_str());
        axes.push(axis(path, file, &mut catalogue, name, options.steps)?);
    }
    let answer = Answer::new(options, axes, &catalogue)?;
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
            (1..=count).contains(&axis).then(|| (axis - 1, name.trim().to_owned()))
        });
        let Some((axis, name)) = read else {
            return Err(miette!(
                help = format!("write N=MOTOR+GEARBOX with N from 1 to {count}, the place of the machine file on the command line"),
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
    catalogue: &mut Catalogue,
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
    fn new(options: &Options, axes: Vec<Axis>, catalogue: &Catalogue) -> Result<Self> {
        let mut data = axes[0].data;
        // Without a capacitance in [supply] those of the amplifiers on the bus add up.
        let given = axes.windows(2).all(|pair| pair[0].data.capacitance == pair[1].data.capacitance);
        let supply = input::read(&options.files[0])?.site.supply;
        if supply.capacitance.is_none() && (axes.len() > 1 || !given) {
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
            of(Goal::Voltage).zip(of(Goal::Resistor)).map(|(v, r)| [v, r])
        };
        // What a resistor must bear is asked at the phases that burn most.
        let phases = worst.as_ref().map_or(&together, |[_, resistor]| &resistor.phases);
        let need = shared.power(phases).and_then(|power| Need::of(&data, &power));
        let proposal = need.as_ref().and_then(|need| need.proposal(&catalogue.resistors));
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

    /// The figures that are judged: highest voltage, mean power, largest power and pulse of the resistor.
    fn judged(&self, options: &Options) -> [f64; 4] {
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
                if self.data.resistor.is_some() { self.bounds.back } else { 0.0 },
                f64::NAN,
            ],
        }
    }

    /// What is judged, its figure, its limit, the unit; only where there is a limit.
    fn checks(&self, options: &Options) -> Vec<(&'static str, f64, f64, &'static str)> {
        let [voltage, mean, peak, pulse] = self.judged(options);
        let resistor = self.data.resistor.as_ref();
        [
            ("bus voltage", voltage, self.data.max_voltage, "V"),
            ("brake resistor mean power", mean, resistor.map(|r| r.power), "W"),
            ("brake resistor peak power", peak, resistor.and_then(|r| r.peak_power), "W"),
            ("brake resistor pulse energy", pulse, resistor.and_then(|r| r.pulse_energy), "W s"),
        ]
        .into_iter()
        .filter_map(|(name, figure, limit, unit)| Some((name, figure, limit?, unit)))
        .collect()
    }

    fn holds(&self, options: &Options) -> bool {
        let mut checks = self.checks(options).into_iter();
        self.axes.iter().all(|axis| axis.holds)
            && checks.all(|(_, figure, limit, _)| figure.is_nan() || figure <= limit)
    }

    /// Mean power of separate resistors less that of a common one (W), all axes in step; the common one only where it is known.
    fn saved(&self) -> Option<f64> {
        self.data.resistor?;
        let period = self.power.as_ref()?.period();
        Some(self.shared.apart() - self.in_step?.burnt / period)
    }

    fn text(&self, options: &Options) -> String {
        let mut text = String::new();
        for (k, axis) in self.axes.iter().enumerate() {
            let [drawn, back] = axis.curve.energies();
            let [least, most] = axis.curve.extremes();
            let broken = if axis.holds { "" } else { ", breaks a rule: see `jred size`" };
            let _ = writeln!(
                text,
                "{}. {}: {}{broken}\n   cycle {} s, draws {} W s (peak {} W), feeds back {} W s (peak {} W)",
                k + 1,
                axis.title,
                axis.drive,
                short(axis.curve.period()),
                short(drawn),
                short(most.max(0.0)),
                short(back),
                short((-least).max(0.0)),
            );
        }
        text.push('\n');
        if let (Some(figures), Some(power)) = (&self.in_step, &self.power) {
            let [least, most] = power.extremes();
            let _ = writeln!(
                text,
                "All axes in step, period {} s: peak drawn {} W, peak fed back {} W",
                short(power.period()),
                short(most.max(0.0)),
                short((-least).max(0.0)),
            );
            text += &line(figures, power.period());
        } else {
            text += "The cycles have no common period: only bounds can be given.\n";
        }
        if let (Some([voltage, resistor]), Some(power)) = (&self.worst, &self.power) {
            let _ = write!(text, "Phases with the highest voltage, {}: ", shown(&voltage.phases));
            text += &line(&voltage.figures, power.period());
            let _ = write!(text, "Phases that burn most, {}: ", shown(&resistor.phases));
            text += &line(&resistor.figures, power.period());
            if self.axes.len() > 3 {
                text += "More than three axes: searched from several starts, a worse phase may exist; the bounds hold.\n";
            }
        }
        let Bounds {
            drawn,
            back,
            highest,
            resistor,
        } = self.bounds;
        let _ = writeln!(
            text,
            "At any phases: peak drawn at most {} W, peak fed back at most {} W, bus at most {} V, brake resistor at most {} W mean",
            short(drawn),
            short(back),
            volts(highest),
            short(resistor),
        );
        if let Some(saved) = self.saved() {
            let _ = writeln!(text, "One bus instead of one for each axis saves {} W", short(saved));
        }
        if let Some(need) = &self.need {
            let proposal = match &self.proposal {
                Some(key) => format!("; {key} of the catalogue does"),
                None => "; the catalogue has none of which it is known".to_owned(),
            };
            let words = need.words();
            let _ = writeln!(text, "The bus {words}{proposal}");
        }
        if self.data.capacitance.is_none() {
            text += "Capacitance of the DC bus not known: all that comes back goes into the brake resistor\n";
        }
        text.push('\n');
        let checks = self.checks(options);
        for (name, figure, limit, unit) in &checks {
            let verdict = match figure {
                f if f.is_nan() => "not checked",
                f if f <= limit => "ok",
                _ => "FAIL",
            };
            let _ = writeln!(text, "{name} {} against {} {unit}: {verdict}", volts(*figure), short(*limit));
        }
        if !checks.iter().any(|check| check.0 == "bus voltage") {
            text += "bus voltage: not checked, the highest voltage of the DC bus is not known\n";
        }
        text
    }

    fn csv(&self) -> Result<String> {
        let power = self.power.as_ref().ok_or_else(|| {
            miette!(
                help = "use --format table or json, which give bounds",
                "the cycles have no common period"
            )
        })?;
        let mut columns = Columns::new(["t [s]", "power [W]", "voltage [V]"]);
        let trace = self.shared.bus().trace(power);
        let ends = std::iter::once(power.points().first().map_or(0.0, |p| p[1]))
            .chain(power.pieces().map(|(_, [_, b])| b));
        let mut t = 0.0;
        let lengths = std::iter::once(0.0).chain(power.pieces().map(|(h, _)| h));
        for (k, (p, h)) in ends.zip(lengths).enumerate() {
            t += h;
            columns.push([Some(t), Some(p), trace.get(k).map(|[_, volts]| *volts)]);
        }
        Ok(columns.write(Format::Csv, ""))
    }

    fn json(&self, options: &Options) -> serde_json::Value {
        let finite = |x: f64| x.is_finite().then_some(x);
        let axes = self.axes.iter().map(|axis| {
            let [drawn, back] = axis.curve.energies();
            let [least, most] = axis.curve.extremes();
            json!({
                "title": axis.title,
                "drive": axis.drive,
                "holds": axis.holds,
                "period [s]": axis.curve.period(),
                "drawn [J]": drawn,
                "fed back [J]": back,
                "peak drawn [W]": most.max(0.0),
                "peak fed back [W]": (-least).max(0.0),
            })
        });
        let checks = self.checks(options).into_iter().map(|(name, figure, limit, unit)| {
            json!({
                "check": name,
                "value": finite(figure),
                "limit": limit,
                "unit": unit,
                "holds": (!figure.is_nan()).then_some(figure <= limit),
            })
        });
        json!({
            "schema": "jred-bus/1",
            "axes": axes.collect::<Vec<_>>(),
            "period [s]": self.power.as_ref().map(PowerCurve::period),
            "in step": self.in_step,
            "worst": self.worst.as_ref().map(|[voltage, resistor]| json!({
                "voltage": voltage,
                "resistor": resistor,
                "exhaustive": self.axes.len() <= 3,
            })),
            "bounds": {
                "peak drawn [W]": self.bounds.drawn,
                "peak fed back [W]": self.bounds.back,
                "highest voltage [V]": finite(self.bounds.highest),
                "resistor mean [W]": self.bounds.resistor,
            },
            "saved by sharing [W]": self.saved(),
            "brake resistor needed": self.need,
            "proposal": self.proposal,
            "checks": checks.collect::<Vec<_>>(),
            "holds": self.holds(options),
        })
    }
}

/// Voltage and resistor in words.
fn line(figures: &BusFigures, period: f64) -> String {
    format!(
        "bus up to {} V, supply {} W mean, brake resistor {} W mean, {} W peak, {} W s a pulse\n",
        volts(figures.highest),
        short((figures.supplied - figures.returned) / period),
        short(figures.burnt / period),
        short(figures.burnt_peak),
        short(figures.pulse),
    )
}

/// A figure that may have no bound.
fn volts(x: f64) -> String {
    if x.is_infinite() {
        "without bound".to_owned()
    } else if x.is_nan() {
        "–".to_owned()
    } else {
        short(x)
    }
}

fn shown(phases: &[f64]) -> String {
    let phases: Vec<String> = phases.iter().map(|phase| format!("{} s", short(*phase))).collect();
    phases.join(", ")
}
