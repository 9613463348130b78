//! Several axes on one DC bus, their cycles shifted against each other.
//!
//! Peaks need no search: with free phases every axis may have its largest power at the same instant, so the sum of the largest powers is reached. The
//! load of capacitor and brake resistor depends on the phases. Two axes are searched over all phases, then finer around the worst; three over a
//! coarser grid. With more axes one phase is varied at a time from several starts, which finds a large value, not necessarily the largest. [`Bounds`]
//! are valid for any phases and periods.

use serde::Serialize;

use super::curve::PowerCurve;
use super::period::Common;
use super::phases::{PhaseSolution, Phases, Watch};
use super::store::{Bus, BusFigures};

/// Largest number of points of all axes over the common period that the search uses unreduced: for two axes, and for more. Their coarser grid misses
/// more than the reduction does.
const EXACT: [usize; 2] = [100_000, 5_000];

/// Error of the curves, as a share of their span, that a larger search accepts. Its results are computed again with all points.
const CURVE_ERROR: f64 = 1e-4;

/// Axes on a bus.
#[derive(Clone, Debug)]
pub struct Axes {
    bus: Bus,
    curves: Vec<PowerCurve>,
    common: Common,
    /// Power curves over the common period; empty if it is not searched.
    whole: Vec<PowerCurve>,
}

/// Phases found by a search.
#[derive(Clone, Debug, PartialEq, Serialize, schemars::JsonSchema)]
pub struct WorstPhases {
    /// Delay of each axis relative to the first (s).
    #[serde(rename = "phases [s]")]
    pub phases: Vec<f64>,
    /// Result for the bus over the common period.
    pub figures: BusFigures,
}

/// Bounds that are valid for any phases and periods.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Bounds {
    /// Largest power drawn (W): the sum of the axes' largest powers. It is reached.
    #[serde(rename = "peak drawn [W]")]
    pub drawn: f64,
    /// Largest power fed back (W): the sum of the axes' largest values, of the cycles or of the stops. It is reached if all axes feed back.
    #[serde(rename = "peak fed back [W]")]
    pub back: f64,
    /// Highest voltage (V).
    #[serde(rename = "highest voltage [V]")]
    #[schemars(with = "Option<f64>")]
    pub highest: f64,
    /// Mean power of a brake resistor (W): all regenerated energy.
    #[serde(rename = "resistor mean [W]")]
    pub resistor: f64,
}

impl Axes {
    /// Axes with these powers on a bus.
    pub fn new(bus: Bus, curves: Vec<PowerCurve>) -> Self {
        let common = Common::of(&curves);
        let whole = common.repeated(&curves);
        Self {
            bus,
            curves,
            common,
            whole,
        }
    }

    /// The bus.
    pub const fn bus(&self) -> &Bus {
        &self.bus
    }

    /// These axes on another bus.
    #[must_use]
    pub fn on(&self, bus: Bus) -> Self {
        Self {
            bus,
            ..self.clone()
        }
    }

    /// Whether the cycles repeat together.
    pub const fn common(&self) -> &Common {
        &self.common
    }

    /// The power of all axes over the common period, each delayed by its phase (s); `None` if that is not searched.
    pub fn power(&self, phases: &[f64]) -> Option<PowerCurve> {
        let all = phases.iter().copied().chain(std::iter::repeat(0.0));
        let phases: Vec<f64> = all.take(self.whole.len()).collect();
        let reach = [];
        (!self.whole.is_empty()).then(|| self.phases(&self.whole, &reach).all(&phases))
    }

    /// Result for the bus at these phases.
    pub fn at(&self, phases: &[f64]) -> Option<BusFigures> {
        Some(self.bus.run(&self.power(phases)?))
    }

    fn phases<'a>(&self, whole: &'a [PowerCurve], reach: &'a [f64]) -> Phases<'a> {
        Phases {
            whole,
            reach,
            periods: self.curves.iter().map(PowerCurve::period).collect(),
        }
    }

    /// The phases at which each of these figures is largest; `None` if the common period is not searched.
    pub fn largest<const N: usize>(
        &self,
        of: impl Fn(&BusFigures) -> [f64; N] + Sync,
        watch: &dyn Watch,
    ) -> Option<[WorstPhases; N]> {
        if self.whole.is_empty() {
            return None;
        }
        let reach = self.common.reach();
        let points = self.whole.iter().map(|curve| curve.points().len());
        let exact = EXACT[usize::from(self.whole.len() > 2)];
        let fewer = (points.sum::<usize>() > exact).then(|| {
            let curves = self.curves.iter().map(|curve| {
                let [least, most] = curve.extremes();
                curve.simplified(CURVE_ERROR * (most - least))
            });
            self.common.repeated(&curves.collect::<Vec<_>>())
        });
        let phases = self.phases(fewer.as_deref().unwrap_or(&self.whole), &reach);
        let found = phases.search(
            self.depends_on_phases(),
            |power| of(&self.bus.run(power)),
            watch,
        );
        Some(found.map(|PhaseSolution { phases, .. }| WorstPhases {
            figures: self.at(&phases).unwrap_or(BusFigures::UNBOUNDED),
            phases,
        }))
    }

    /// Whether the result depends on the phases.
    fn depends_on_phases(&self) -> bool {
        let [drawn, back] = self.mean();
        let bare = self.bus.resistor.is_none();
        let unbounded = bare && (self.bus.capacitance <= 0.0 || back > drawn);
        !(self.bus.regenerative || back == 0.0 || unbounded)
    }

    /// Mean power drawn and fed back (W), summed over the axes.
    pub fn mean(&self) -> [f64; 2] {
        self.curves.iter().fold([0.0; 2], |[drawn, back], curve| {
            let [d, b] = curve.energies();
            [drawn + d / curve.period(), back + b / curve.period()]
        })
    }

    /// Bounds for any phases and periods. An axis alone stores the largest energy fed back in any span of time. For a sum of axes this is at most the
    /// sum of the individual values.
    pub fn bounds(&self) -> Bounds {
        let mut bounds = Bounds {
            drawn: 0.0,
            back: 0.0,
            highest: self.bus.voltage,
            resistor: 0.0,
        };
        let [mut stored, mut stopped] = [0.0; 2];
        let alone = Bus {
            resistor: None,
            ..self.bus
        };
        for curve in &self.curves {
            let [least, most] = curve.extremes();
            bounds.drawn += most.max(0.0);
            bounds.back += (-least).max(0.0);
            stopped += curve.stop().peak;
            let highest = alone.run(curve).highest;
            stored += highest * highest - self.bus.voltage * self.bus.voltage;
        }
        bounds.back = bounds.back.max(stopped);
        if self.bus.regenerative || bounds.back == 0.0 {
            return bounds;
        }
        [_, bounds.resistor] = self.mean();
        let voltage = (self.bus.voltage * self.bus.voltage + stored).sqrt();
        bounds.highest = match self.bus.resistor {
            // The resistor lets the voltage rise to its switch-on voltage, or to the voltage at which it takes the largest power.
            Some([on, resistance]) => voltage.min(on.max((bounds.back * resistance).sqrt())),
            None => voltage,
        };
        bounds
    }

    /// Mean power of the brake resistors (W) if each axis had its own bus, with such a resistor and its share of the capacitance.
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
