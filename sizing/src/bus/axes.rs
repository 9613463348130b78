//! Several axes on one DC bus, their cycles shifted against each other.
//!
//! Peaks need no search: with free phases every axis may have its largest power at the same instant, and the sum of the
//! largest powers is reached. What the capacitor and the brake resistor see depends on the phases: two axes are searched
//! over all phases, then finer around the worst; three over a coarser grid; more, one phase at a time from several starts,
//! which finds a large value but need not find the largest. [`Bounds`] hold for any phases and periods.

use serde::Serialize;

use super::curve::PowerCurve;
use super::store::{Bus, BusFigures};

/// Axes on a bus.
#[derive(Clone, Debug)]
pub struct Axes {
    bus: Bus,
    curves: Vec<PowerCurve>,
    /// Common period (s) and how often each axis's own fits into it; `None`: there is none.
    common: Option<(f64, Vec<u32>)>,
}

/// What a search over the phases looks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Goal {
    /// Highest voltage of the bus.
    Voltage,
    /// Energy of the brake resistor.
    Resistor,
}

/// The worst phases found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Worst {
    /// How much later each axis starts than the first (s).
    #[serde(rename = "phases [s]")]
    pub phases: Vec<f64>,
    /// What the bus does then, over the common period.
    pub figures: BusFigures,
}

/// What no phases and no periods exceed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bounds {
    /// Largest power drawn (W): the sum of the axes' own. It is reached.
    #[serde(rename = "peak drawn [W]")]
    pub drawn: f64,
    /// Largest power fed back (W): the sum of the axes' own. It is reached where all of them feed back.
    #[serde(rename = "peak fed back [W]")]
    pub back: f64,
    /// Highest voltage (V).
    #[serde(rename = "highest voltage [V]")]
    pub highest: f64,
    /// Mean power of the brake resistor (W): all that comes back.
    #[serde(rename = "resistor mean [W]")]
    pub resistor: f64,
}

/// The largest number of cycles of an axis in a common period.
const MOST_CYCLES: u32 = 64;

/// How well the periods must fit into each other, as a share.
const FIT: f64 = 1e-9;

/// Phases of a grid for two axes, for three, and for one phase of many.
const GRID: [u32; 3] = [720, 48, 48];

/// Rounds of closing in on a worst phase, and parts of each.
const ROUNDS: u32 = 4;
const PARTS: u32 = 16;

impl Axes {
    /// Axes with these powers on a bus.
    pub fn new(bus: Bus, curves: Vec<PowerCurve>) -> Self {
        let common = common(&curves);
        Self {
            bus,
            curves,
            common,
        }
    }

    /// The bus.
    pub const fn bus(&self) -> &Bus {
        &self.bus
    }

    /// Whether the cycles repeat together.
    pub const fn repeats(&self) -> bool {
        self.common.is_some()
    }

    /// The power of all axes over the common period, each started later by its phase (s). `None`: no common period.
    pub fn power(&self, phases: &[f64]) -> Option<PowerCurve> {
        let (_, counts) = self.common.as_ref()?;
        let moved = self.curves.iter().zip(counts).enumerate();
        let mut moved = moved.map(|(k, (curve, count))| {
            let phase = phases.get(k).copied().unwrap_or(0.0);
            curve.shifted(phase).repeated(*count)
        });
        let first = moved.next()?;
        Some(moved.fold(first, |sum, next| sum.plus(&next)))
    }

    /// What the bus does at these phases.
    pub fn at(&self, phases: &[f64]) -> Option<BusFigures> {
        Some(self.bus.run(&self.power(phases)?))
    }

    /// The worst phases. `None`: no common period.
    pub fn worst(&self, goal: Goal) -> Option<Worst> {
        self.common.as_ref()?;
        let value = |phases: &[f64]| {
            let figures = self.at(phases).unwrap_or_default();
            match goal {
                Goal::Voltage => figures.highest,
                Goal::Resistor => figures.burnt,
            }
        };
        let free = self.curves.len() - 1;
        let periods: Vec<f64> = self.curves.iter().map(PowerCurve::period).collect();
        let mut best = (vec![0.0; self.curves.len()], f64::NEG_INFINITY);
        let tried = |phases: &[f64], best: &mut (Vec<f64>, f64)| {
            let found = value(phases);
            if found > best.1 {
                *best = (phases.to_vec(), found);
            }
        };
        tried(&best.0.clone(), &mut best);
        let step = |axis: usize, grid: u32| periods[axis] / f64::from(grid);
        let grid = match free {
            0 | 1 => GRID[0],
            2 => GRID[1],
            _ => GRID[2],
        };
        match free {
            0 => {}
            1 | 2 => {
                let second = if free == 2 { grid } else { 1 };
                for i in 0..grid {
                    for k in 0..second {
                        let mut phases = vec![0.0, f64::from(i) * step(1, grid)];
                        if free == 2 {
                            phases.push(f64::from(k) * step(2, grid));
                        }
                        tried(&phases, &mut best);
                    }
                }
            }
            _ => {
                // Starts that spread evenly: multiples of the golden section, one for each axis.
                const SECTION: f64 = 0.618_033_988_749_894_9;
                for start in 0..4 {
                    let spread = |axis: usize| {
                        let part = (start * axis) as f64 * SECTION;
                        part.fract() * periods[axis]
                    };
                    let mut local: (Vec<f64>, f64) =
                        ((0..=free).map(spread).collect(), f64::NEG_INFINITY);
                    tried(&local.0.clone(), &mut local);
                    loop {
                        let before = local.1;
                        for axis in 1..=free {
                            let mut phases = local.0.clone();
                            for i in 0..grid {
                                phases[axis] = f64::from(i) * step(axis, grid);
                                tried(&phases, &mut local);
                            }
                        }
                        if local.1 <= before {
                            break;
                        }
                    }
                    if local.1 > best.1 {
                        best = local;
                    }
                }
            }
        }
        let mut width = 1.0;
        for _ in 0..ROUNDS {
            for axis in 1..=free {
                let centre = best.0.clone();
                for i in 0..=2 * PARTS {
                    let mut phases = centre.clone();
                    let off = (f64::from(i) / f64::from(PARTS) - 1.0) * width * step(axis, grid);
                    phases[axis] = (centre[axis] + off).rem_euclid(periods[axis]);
                    tried(&phases, &mut best);
                }
            }
            width /= f64::from(PARTS);
        }
        let figures = self.at(&best.0)?;
        Some(Worst {
            phases: best.0,
            figures,
        })
    }

    /// What no phases exceed, nor any periods. The energy stored is at most the sum of what each axis alone would store:
    /// it is the largest energy that came back in any span of time, and that of a sum is at most the sum of the largest.
    pub fn bounds(&self) -> Bounds {
        let mut bounds = Bounds {
            drawn: 0.0,
            back: 0.0,
            highest: self.bus.voltage,
            resistor: 0.0,
        };
        let mut stored = 0.0;
        let alone = Bus {
            resistor: None,
            ..self.bus
        };
        for curve in &self.curves {
            let [least, most] = curve.extremes();
            bounds.drawn += most.max(0.0);
            bounds.back += (-least).max(0.0);
            let [_, back] = curve.energies();
            bounds.resistor += back / curve.period();
            let highest = alone.run(curve).highest;
            stored += highest * highest - self.bus.voltage * self.bus.voltage;
        }
        if self.bus.regenerative || bounds.back == 0.0 {
            bounds.resistor = 0.0;
            return bounds;
        }
        let voltage = (self.bus.voltage * self.bus.voltage + stored).sqrt();
        bounds.highest = match self.bus.resistor {
            // The resistor lets the voltage rise to where it comes on, or to where it takes the largest power.
            Some([on, resistance]) => voltage.min(on.max((bounds.back * resistance).sqrt())),
            None => voltage,
        };
        if self.bus.resistor.is_none() {
            bounds.resistor = 0.0;
        }
        bounds
    }

    /// Mean power of the brake resistors (W) if each axis had a bus, a resistor like this and its share of the capacitance
    /// of its own.
    pub fn apart(&self) -> f64 {
        let share = 1.0 / self.curves.len().max(1) as f64;
        let alone = Bus {
            capacitance: self.bus.capacitance * share,
            ..self.bus
        };
        let mean = |curve: &PowerCurve| alone.run(curve).burnt / curve.period();
        self.curves.iter().map(mean).sum()
    }
}

/// The shortest common period, and how often each period fits into it.
fn common(curves: &[PowerCurve]) -> Option<(f64, Vec<u32>)> {
    let first = curves.first()?.period();
    (1..=MOST_CYCLES).find_map(|count| {
        let whole = first * f64::from(count);
        let counts = curves.iter().map(|curve| {
            let times = whole / curve.period();
            let near = times.round();
            let fits = (1.0..=f64::from(MOST_CYCLES)).contains(&near)
                && (times - near).abs() <= FIT * near;
            fits.then_some(near as u32)
        });
        Some((whole, counts.collect::<Option<Vec<u32>>>()?))
    })
}
