//! The DC bus: a capacitor between the supply, the axes and the brake resistor.
//!
//! ```text
//! E = ½·C·U²,   E′ = P_supply − P − P_R
//! ```
//!
//! P is the power that the axes draw. A diode supply keeps U ≥ U₀ and takes nothing back; a regenerative supply keeps U = U₀. Above the chopper
//! voltage, the brake resistor takes the regenerated power, at most U²/R; any excess raises the voltage further. The chopper's switching and the
//! mains ripple are not modelled. Power is piecewise linear; between its events (empty, chopper on, resistor at its limit) the course is exact.

use super::curve::{PowerCurve, PowerPiece, split};
use jred_file::math;

/// The bus and everything that determines its voltage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bus {
    /// Supply voltage (V).
    pub voltage: f64,
    /// Capacitance (F); zero: no data, and nothing is stored.
    pub capacitance: f64,
    /// Whether the supply takes energy back.
    pub regenerative: bool,
    /// Brake resistor: switch-on voltage (V), resistance (Ω).
    pub resistor: Option<[f64; 2]>,
}

/// Result for one period in the steady state.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct BusFigures {
    /// Energy from the supply (J); NaN if the voltage is unbounded.
    #[serde(rename = "supplied [J]")]
    #[schemars(with = "Option<f64>")]
    pub supplied: f64,
    /// Energy that the supply takes back (J).
    #[serde(rename = "returned [J]")]
    pub returned: f64,
    /// Energy that the brake resistor turns into heat (J).
    #[serde(rename = "burnt [J]")]
    pub burnt: f64,
    /// Its largest power (W).
    #[serde(rename = "resistor peak [W]")]
    pub burnt_peak: f64,
    /// Its largest energy without a pause (J); if it never pauses, its energy per period.
    #[serde(rename = "resistor pulse [J]")]
    pub pulse: f64,
    /// Highest voltage (V); infinite if unbounded.
    #[serde(rename = "highest voltage [V]")]
    #[schemars(with = "Option<f64>")]
    pub highest: f64,
    /// Energy stored at the start of a period above that at U₀ (J).
    #[serde(rename = "stored at the start [J]")]
    #[schemars(with = "Option<f64>")]
    pub stored: f64,
}

impl BusFigures {
    /// The figures that have limits: the highest voltage (V), and the resistor's mean power over a period of this length (s), its largest power (W) and
    /// its largest pulse (J).
    pub const fn judged(&self, period: f64) -> [f64; 4] {
        let mean = self.burnt / period;
        [self.highest, mean, self.burnt_peak, self.pulse]
    }

    /// Figures of a bus without a voltage bound, where no period repeats the previous one.
    pub const UNBOUNDED: Self = Self {
        supplied: f64::NAN,
        returned: 0.0,
        burnt: 0.0,
        burnt_peak: 0.0,
        pulse: 0.0,
        highest: f64::INFINITY,
        stored: f64::NAN,
    };
}

/// Tolerance of the periodic state, as a share of the energy at U₀ and the energy fed back.
const PERIODIC: f64 = 1e-13;

/// Rounding of the energy that follows from a voltage, as a share of the energy.
const ROUNDING: f64 = 1e-12;

/// Most periods until it is reached.
const MOST_PERIODS: u32 = 10_000;

impl Bus {
    /// Steady state of the bus under a repeated power curve, and a stop from its highest voltage if the curve has one.
    pub fn run(&self, curve: &PowerCurve) -> BusFigures {
        let cycle = self.periodic(curve);
        let Some(stop) = curve.stop().curve().filter(|_| cycle.highest.is_finite()) else {
            return cycle;
        };
        let stored = self.resistor.is_some() || self.capacitance > 0.0;
        if !(stored || self.regenerative) || !stop.period().is_finite() {
            return BusFigures::UNBOUNDED;
        }
        let above = cycle.highest.powi(2) - self.voltage.powi(2);
        let mut walk = Walk::new(self, 0.5 * self.capacitance * above.max(0.0), 0.0);
        if walk.excess - walk.full <= ROUNDING * (walk.base + walk.full) {
            // The switch-on voltage itself, but for rounding: above it the resistor would take all that it can.
            walk.excess = walk.excess.min(walk.full);
        }
        for piece in stop.pieces() {
            parts(piece, walk.most, |part| walk.events(part));
        }
        let stopped = walk.finish(0.0);
        BusFigures {
            burnt_peak: cycle.burnt_peak.max(stopped.burnt_peak),
            pulse: cycle.pulse.max(stopped.pulse),
            highest: cycle.highest.max(stopped.highest),
            ..cycle
        }
    }

    /// Steady state under a repeated power curve.
    fn periodic(&self, curve: &PowerCurve) -> BusFigures {
        let mut pieces = Vec::with_capacity(curve.points().len());
        let most = Walk::new(self, 0.0, 0.0).most;
        for piece in curve.pieces() {
            parts(piece, most, |part| pieces.push(part));
        }
        let [mut drawn, mut back] = [0.0; 2];
        // If more is drawn than fed back, the capacitor is empty where the accumulated drawn energy is largest. A period from there needs no run-in.
        let (mut from, mut most) = (0, 0.0);
        for (k, (h, [a, b])) in pieces.iter().enumerate() {
            let area = 0.5 * h * (a + b);
            if area > 0.0 {
                drawn += area;
            } else if area < 0.0 {
                back -= area;
            }
            if drawn - back > most {
                (from, most) = (k + 1, drawn - back);
            }
        }
        if self.regenerative || back == 0.0 {
            let mut walk = Walk::new(self, 0.0, 0.0);
            walk.period(&pieces, 0);
            return walk.finish(0.0);
        }
        let nothing_bounds_it =
            self.resistor.is_none() && (back > drawn || self.capacitance <= 0.0);
        if nothing_bounds_it {
            return BusFigures::UNBOUNDED;
        }
        let scale = 0.5 * self.capacitance * self.voltage * self.voltage + back;
        // Start close to the periodic state: full if more is fed back than drawn, otherwise empty.
        let (from, mut start) = match self.resistor {
            Some(_) if back > drawn => (0, Walk::new(self, 0.0, 0.0).full),
            _ => (from, 0.0),
        };
        let mut pulse = 0.0;
        for period in 0..MOST_PERIODS {
            let mut walk = Walk::new(self, start, pulse);
            let stored = walk.period(&pieces, from);
            let carried = if walk.paused { walk.pulse } else { 0.0 };
            // The first period equals the next unless a pulse continues into the next.
            let settled = period > 0 || carried <= 0.0;
            if (walk.excess - start).abs() <= PERIODIC * scale && settled {
                return walk.finish(stored);
            }
            start = walk.excess;
            pulse = carried;
        }
        BusFigures::UNBOUNDED
    }

    /// Voltage over a period: \[time (s), voltage (V)\]; empty if it is unbounded.
    pub fn trace(&self, curve: &PowerCurve) -> Vec<[f64; 2]> {
        let figures = self.run(curve);
        if figures.highest.is_infinite() {
            return Vec::new();
        }
        let mut walk = Walk::new(self, figures.stored, 0.0);
        let mut t = 0.0;
        let mut trace = vec![[t, walk.voltage(walk.excess)]];
        for piece in curve.pieces() {
            parts(piece, walk.most, |part| walk.events(part));
            t += piece.0;
            trace.push([t, walk.voltage(walk.excess)]);
        }
        trace
    }
}

/// The parts of a piece in which neither the sign of the power changes, nor whether the resistor can take all of it (at most `most`, in W).
fn parts(piece: PowerPiece, most: f64, mut part: impl FnMut(PowerPiece)) {
    split(piece, 0.0, |one_way| split(one_way, -most, &mut part));
}

/// The state of the bus in a period.
struct Walk<'b> {
    bus: &'b Bus,
    /// ½·C·U₀² (J).
    base: f64,
    /// Energy above `base` at which the resistor switches on (J); infinite without a resistor.
    full: f64,
    /// 2/(R·C): power of the resistor over stored energy (1/s); infinite without capacitance.
    rate: f64,
    /// Largest power of the resistor at its switch-on voltage (W).
    most: f64,
    /// Energy above `base` (J).
    excess: f64,
    /// Its largest value so far (J).
    largest: f64,
    /// Energy of the resistor since its last pause (J).
    pulse: f64,
    /// Whether it has paused in this period.
    paused: bool,
    figures: BusFigures,
}

impl<'b> Walk<'b> {
    fn new(bus: &'b Bus, excess: f64, pulse: f64) -> Self {
        let c = bus.capacitance;
        let base = 0.5 * c * bus.voltage * bus.voltage;
        let (full, rate, most) = match bus.resistor {
            Some([on, r]) => (0.5 * c * on * on - base, 2.0 / (r * c), on * on / r),
            None => (f64::INFINITY, 0.0, 0.0),
        };
        Self {
            bus,
            base,
            full,
            rate,
            most,
            excess,
            largest: f64::NEG_INFINITY,
            pulse,
            paused: false,
            figures: BusFigures {
                highest: bus.voltage,
                ..BusFigures::default()
            },
        }
    }

    fn finish(mut self, start: f64) -> BusFigures {
        self.figures.stored = start;
        self.figures.highest = self.figures.highest.max(self.voltage(self.largest));
        if !self.paused {
            self.figures.pulse = self.figures.burnt;
        }
        self.figures
    }

    /// Runs one period, starting and ending at the piece `from`; returns the energy stored at the first piece (J).
    fn period(&mut self, pieces: &[PowerPiece], from: usize) -> f64 {
        self.seen(self.excess);
        let (first, last) = pieces.split_at(from);
        for piece in last {
            self.events(*piece);
        }
        let stored = self.excess;
        for piece in first {
            self.events(*piece);
        }
        stored
    }

    fn voltage(&self, excess: f64) -> f64 {
        if self.bus.capacitance > 0.0 {
            (2.0 * (self.base + excess) / self.bus.capacitance).sqrt()
        } else {
            self.bus.voltage
        }
    }

    fn seen(&mut self, excess: f64) {
        if excess > self.largest {
            self.largest = excess;
        }
    }

    /// One of the [`parts`] of a piece.
    fn events(&mut self, (mut h, [mut a, b]): PowerPiece) {
        if self.bus.regenerative {
            let area = 0.5 * h * (a + b);
            self.figures.supplied += area.max(0.0);
            self.figures.returned += (-area).max(0.0);
            self.pause();
            return;
        }
        let draws = a + b >= 0.0;
        let resistor = self.bus.resistor.is_some();
        let overloaded = resistor && -(a + b) > 2.0 * self.most;
        // Each event ends a part of the piece; there are at most three.
        for _ in 0..4 {
            if h <= 0.0 {
                return;
            }
            let area = 0.5 * h * (a + b);
            let stores = self.bus.capacitance > 0.0;
            let taken = if resistor && !draws && !stores {
                self.burns_at_once(area, a, b);
                h
            } else if resistor
                && (self.excess > self.full || overloaded && self.excess >= self.full)
            {
                self.burns_at_most(h, [a, b], overloaded)
            } else if resistor && !draws && self.excess >= self.full {
                self.burn(-area, a.min(b).abs());
                h
            } else if draws && self.excess == 0.0 {
                self.figures.supplied += area;
                self.pause();
                h
            } else if draws {
                self.pause();
                self.moves(h, [a, b], 0.0)
            } else {
                self.pause();
                self.moves(h, [a, b], self.full)
            };
            if taken >= h {
                return;
            }
            a += (b - a) * (taken / h);
            h -= taken;
        }
    }

    /// The capacitor alone, until its energy reaches `bound` or the piece ends; returns the time (s).
    fn moves(&mut self, h: f64, [a, b]: [f64; 2], bound: f64) -> f64 {
        let area = 0.5 * h * (a + b);
        let way = (bound - self.excess).abs();
        let (time, excess) = if area.abs() < way {
            (h, self.excess - area)
        } else {
            // |a|·t + ½·|b − a|/h·t² = way, in a form that is valid for a slope of either sign and for zero.
            let (start, slope) = (a.abs(), (b.abs() - a.abs()) / h);
            let root = (start * start + 2.0 * slope * way).max(0.0).sqrt();
            let time = if start + root > 0.0 {
                2.0 * way / (start + root)
            } else {
                h
            };
            (time.min(h), bound)
        };
        self.excess = excess;
        self.seen(excess);
        time
    }

    /// Without capacitance, all regenerated power goes into the resistor and raises the voltage to √(P·R).
    fn burns_at_once(&mut self, area: f64, a: f64, b: f64) {
        let peak = a.min(b).abs();
        self.burn(-area, peak);
        if let Some([on, r]) = self.bus.resistor
            && peak > 0.0
        {
            let voltage = on.max((peak * r).sqrt());
            self.figures.highest = self.figures.highest.max(voltage);
        }
    }

    /// The resistor at U²/R, until the voltage is back at the switch-on voltage or the piece ends; returns the time (s). y = E satisfies y′ = s(t) −
    /// k·y with s = −P.
    fn burns_at_most(&mut self, h: f64, [a, b]: [f64; 2], overloaded: bool) -> f64 {
        let k = self.rate;
        let slope = (a - b) / h;
        let start = self.base + self.excess;
        let steady = |t: f64| (slope * t - a) / k - slope / (k * k);
        let free = start - steady(0.0);
        let energy = |t: f64| steady(t) + free * math::exp(-k * t);
        let bound = self.base + self.full;
        let mut time = h;
        if !overloaded && energy(h) < bound {
            // If the resistor can take all regenerated power, the stored energy only falls.
            let (mut above, mut below) = (0.0, h);
            for _ in 0..200 {
                let middle = f64::midpoint(above, below);
                if middle <= above || middle >= below {
                    break;
                }
                if energy(middle) >= bound {
                    above = middle;
                } else {
                    below = middle;
                }
            }
            time = below;
        }
        let end = if time < h {
            bound
        } else {
            energy(h).max(bound)
        };
        let fed = -(a * time - 0.5 * slope * time * time);
        // Rising, then falling: y′ = slope/k − k·free·e^(−k·t) is zero where y is largest.
        let extreme = math::ln(k * k * free / slope) / k;
        let mut highest = start.max(end);
        if extreme > 0.0 && extreme < time {
            highest = highest.max(energy(extreme));
        }
        self.burn(fed - (end - start), k * highest);
        self.excess = if time < h { self.full } else { end - self.base };
        self.seen(highest - self.base);
        time
    }

    fn burn(&mut self, energy: f64, peak: f64) {
        if energy > 0.0 {
            self.figures.burnt += energy;
            self.pulse += energy;
        }
        if peak > self.figures.burnt_peak {
            self.figures.burnt_peak = peak;
        }
        if self.pulse > self.figures.pulse {
            self.figures.pulse = self.pulse;
        }
    }

    fn pause(&mut self) {
        self.pulse = 0.0;
        self.paused = true;
    }
}
