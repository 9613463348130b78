//! The meter: a few sums and extremes in each tick, figures on request.

use super::sum::Sum;
use super::{LimitError, Limits, Verdicts};
use crate::math::Real;

/// Greatest valid torque (N·m): a reading beyond it counts as invalid, so that the sums cannot overflow in `f32`.
pub const MOST_TORQUE: f64 = 1e6;

/// Greatest valid speed (rad/s).
pub const MOST_SPEED: f64 = 1e5;

/// Time over which means are computed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Window<R> {
    /// Since the start or the last [`Meter::restart`]: one cycle, or any number.
    SinceStart,
    /// Weights fall by the factor e over this time (s), like a winding's heat: a reading of age t counts e^(−t/τ). Right from the first tick on,
    /// because the sum of the weights is counted, too.
    Exponential(R),
}

/// Number of means, as weighted sums.
const MEANS: usize = 5;

/// Sums and extremes of a drive's duty. See the [module](crate::duty).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Meter<R> {
    config: Config<R>,
    state: State<R>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct Config<R> {
    limits: Limits<R>,
    /// Period of a tick (s).
    step: R,
    /// Weight of a new term: 1, or step/τ.
    gain: R,
    /// Whether the window is exponential: a new term then replaces its share of the sum.
    forgets: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct State<R> {
    weight: Sum<R>,
    /// T², |n|, |n|·|T_out|³, motoring power, regenerative power.
    means: [Sum<R>; MEANS],
    peak_torque: R,
    peak_speed: R,
    output_peak: R,
    /// Torque and peak torque where their quotient was largest; compared by cross products, so that no tick divides.
    closest: [R; 2],
    ticks: u32,
    cycles: u32,
    invalid: u32,
}

impl<R: Real> State<R> {
    fn new() -> Self {
        let zero = R::from_f64(0.0);
        Self {
            weight: Sum::zero(),
            means: [Sum::zero(); MEANS],
            peak_torque: zero,
            peak_speed: zero,
            output_peak: zero,
            closest: [zero, R::from_f64(1.0)],
            ticks: 0,
            cycles: 0,
            invalid: 0,
        }
    }
}

/// The figures of a duty, in SI units. Speeds and torques are the motor's unless named output.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Figures<R> {
    /// RMS torque (N·m).
    pub rms_torque: R,
    /// Mean of the speed's magnitude (rad/s).
    pub mean_speed: R,
    /// Root-mean-cube torque at the gearbox output, weighted with the speed (N·m); zero without any motion.
    pub output_mean: R,
    /// Mean motoring power (W).
    pub motoring_power: R,
    /// Mean regenerative power (W).
    pub regenerative_power: R,
    /// Motoring energy over the window (J).
    pub motoring_energy: R,
    /// Regenerative energy over the window (J).
    pub regenerative_energy: R,
    /// Length of the window (s): time since the start; for an exponential one the sum of its weights.
    pub duration: R,
    /// Largest |T| (N·m).
    pub peak_torque: R,
    /// Largest |n| (rad/s).
    pub peak_speed: R,
    /// Largest |T_out| (N·m).
    pub output_peak: R,
    /// Largest |T| as a share of the peak torque at its speed; infinite if there was a torque where the curve is zero, `None` without a curve.
    pub peak_share: Option<R>,
    /// Cycles per hour since the start, or until the tick count stopped; zero without a counted cycle.
    pub cycles_per_hour: R,
    /// Counted cycles. All counts stop at their largest value; this one also when `ticks` stops.
    pub cycles: u32,
    /// Ticks with valid readings; at 20 kHz the count stops after 59 hours.
    pub ticks: u32,
    /// Ticks with invalid readings: NaN, infinite, or beyond [`MOST_TORQUE`] or [`MOST_SPEED`]. They count in no other figure, nor in the time.
    pub invalid: u32,
}

fn magnitude<R: Real>(x: R) -> R {
    if x < R::from_f64(0.0) { -x } else { x }
}

fn larger<R: Real>(a: R, b: R) -> R {
    if b > a { b } else { a }
}

impl<R: Real> Meter<R> {
    /// Creates a meter for ticks of `step` (s).
    ///
    /// # Errors
    /// A step that is not positive; an exponential window shorter than ten steps; a limit negative or not finite.
    pub fn new(limits: Limits<R>, step: R, window: Window<R>) -> Result<Self, LimitError> {
        let zero = R::from_f64(0.0);
        if !step.is_finite() {
            return Err(LimitError::NotFinite("time of a tick"));
        }
        if step <= zero {
            return Err(LimitError::NotPositive("time of a tick"));
        }
        limits.check()?;
        let (gain, forgets) = match window {
            Window::SinceStart => (R::from_f64(1.0), false),
            Window::Exponential(constant) => {
                if !constant.is_finite() {
                    return Err(LimitError::NotFinite("time constant of the window"));
                }
                if constant < R::from_f64(10.0) * step {
                    return Err(LimitError::WindowTooShort);
                }
                (step / constant, true)
            }
        };
        Ok(Self {
            config: Config {
                limits,
                step,
                gain,
                forgets,
            },
            state: State::new(),
        })
    }

    /// The limits.
    pub const fn limits(&self) -> &Limits<R> {
        &self.config.limits
    }

    /// Adds the readings of one tick: `torque` (N·m) and `speed` (rad/s) of the motor, and the torque at the gearbox output `output_torque` (N·m;
    /// zero if unknown, `torque` for a directly coupled motor).
    ///
    /// Cannot fail or panic. A reading that is NaN counts as invalid and changes nothing else.
    #[inline]
    pub fn tick(&mut self, torque: R, speed: R, output_torque: R) {
        let Self { config, state } = self;
        let zero = R::from_f64(0.0);
        let most = R::from_f64(MOST_TORQUE);
        let power = torque * speed;
        let [torque, speed, output] = [torque, speed, output_torque].map(magnitude);
        // Every comparison with NaN is false.
        if !(torque <= most && speed <= R::from_f64(MOST_SPEED) && output <= most) {
            state.invalid = state.invalid.saturating_add(1);
            return;
        }
        state.ticks = state.ticks.saturating_add(1);
        state.peak_torque = larger(state.peak_torque, torque);
        state.peak_speed = larger(state.peak_speed, speed);
        state.output_peak = larger(state.output_peak, output);
        if let Some(curve) = &config.limits.peak {
            let limit = curve.at(speed);
            let [most, at] = state.closest;
            if torque * at > most * limit {
                state.closest = [torque, limit];
            }
        }
        let terms = [
            torque * torque,
            speed,
            speed * (output * output * output),
            larger(zero, power),
            larger(zero, -power),
        ];
        let one = R::from_f64(1.0);
        if config.forgets {
            let towards = |sum: &mut Sum<R>, term| sum.add(config.gain * (term - sum.value()));
            towards(&mut state.weight, one);
            for (sum, term) in state.means.iter_mut().zip(terms) {
                towards(sum, term);
            }
        } else {
            state.weight.add(one);
            for (sum, term) in state.means.iter_mut().zip(terms) {
                sum.add(term);
            }
        }
    }

    /// Counts the end of a cycle of the machine, as long as ticks count: both counts stop together.
    pub fn count_cycle(&mut self) {
        if self.state.ticks < u32::MAX {
            self.state.cycles = self.state.cycles.saturating_add(1);
        }
    }

    /// Clears everything except limits, tick and window: for figures of a single cycle.
    pub fn restart(&mut self) {
        self.state = State::new();
    }

    /// The figures so far.
    #[must_use]
    pub fn figures(&self) -> Figures<R> {
        let Self { config, state } = self;
        let zero = R::from_f64(0.0);
        let weight = state.weight.value();
        let mean = |sum: Sum<R>| {
            if weight > zero {
                sum.value() / weight
            } else {
                zero
            }
        };
        let [square, mean_speed, cube, motoring_power, regenerative_power] = state.means.map(mean);
        // The weights of an exponential window grow to 1, which corresponds to its time constant.
        let duration = weight * (config.step / config.gain);
        let [torque, limit] = state.closest;
        let share = if limit > zero {
            torque / limit
        } else {
            R::from_f64(f64::INFINITY)
        };
        let hours = R::from_count(state.ticks) * config.step / R::from_f64(3600.0);
        let cycles = R::from_count(state.cycles);
        Figures {
            rms_torque: square.sqrt(),
            mean_speed,
            output_mean: if mean_speed > zero {
                (cube / mean_speed).cbrt()
            } else {
                zero
            },
            motoring_power,
            regenerative_power,
            motoring_energy: motoring_power * duration,
            regenerative_energy: regenerative_power * duration,
            duration,
            peak_torque: state.peak_torque,
            peak_speed: state.peak_speed,
            output_peak: state.output_peak,
            peak_share: config.limits.peak.map(|_| share),
            cycles_per_hour: if hours > zero { cycles / hours } else { zero },
            cycles: state.cycles,
            ticks: state.ticks,
            invalid: state.invalid,
        }
    }

    /// Whether the figures so far satisfy the limits.
    #[must_use]
    pub fn verdicts(&self) -> Verdicts {
        Verdicts::of(&self.config.limits, &self.figures())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cycles_an_hour_stay_when_the_count_of_ticks_stops() {
        let mut meter = Meter::new(Limits::default(), 5e-5, Window::SinceStart).unwrap();
        meter.state.ticks = u32::MAX - 2;
        meter.state.cycles = 53_687;
        for _ in 0..1000 {
            meter.tick(1.0, 10.0, 0.0);
            meter.count_cycle();
        }
        let figures = meter.figures();
        // 53 688 cycles in 2³² ticks of 50 µs, which are 59.65 hours.
        assert_eq!((figures.ticks, figures.cycles), (u32::MAX, 53_688));
        let expected: f64 = 53_688.0 / (4_294_967_295.0 * 5e-5 / 3600.0);
        assert!((figures.cycles_per_hour - expected).abs() < 1e-9 * expected);
    }
}
