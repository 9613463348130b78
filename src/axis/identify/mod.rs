//! The machine's J(φ), load and friction, found on the machine from its encoder and its torque.

mod column;
mod filter;
mod settings;
mod solve;
mod tick;
mod weight;

pub use settings::IdentificationSettings;
pub use solve::{Equations, Found, FoundStatus};

use super::AxisError;
use crate::Phase;
use crate::curve::{Circular, CurveSet};
use column::Column;
use filter::Filter;
use settings::{Plan, columns};
use weight::{MOST_TICKS, WINDOWS, Weights};

/// Share of the squared residual that a row keeps: a mean over 4 s.
const RESIDUAL_KEPT: f64 = 0.999;

/// Slowest speed that gives a row (rad/s), or a 40th of the greatest one if that is less: below it, friction may stick.
const SLOWEST: f32 = 0.3;

/// The coefficients of a machine from its encoder's phase and its drive's torque, as the words of a [`Harmonic`](crate::Harmonic) table.
///
/// ```text
/// J(φ)·α + ½·J′(φ)·ω² = T + load(φ) − b·ω − c·sgn ω − cogging(φ)
/// ```
///
/// J has any harmonics; the load those of a conservative one, without a mean; b and c are constant; cogging has stated orders. All are linear in this
/// equation, but an acceleration from counts is mostly noise. So the equation is multiplied by smooth test functions w, quintic B-splines of 24 ms every
/// h = 4 ms, and integrated by parts until no measured signal is differentiated (the weak form):
///
/// ```text
/// ∫w·T = Σ aₖ·∫[ẅ·Gₖ(φ) − ½·w·gₖ′(φ)·ω²] − ∫w·load − b·∫ẇ·φ + c·∫w·sgn ω + …        Gₖ′ = gₖ, J = Σ aₖ·gₖ
/// ```
///
/// Each test function gives a row. The noise of angle and torque makes neighbouring rows depend on each other: a banded Cholesky factor of their
/// covariance whitens them. Instruments, the same rows from an angle smoothed on both sides, keep the noise of the angle from biasing the
/// coefficients, in a closed loop too. Givens rotations gather everything in two square matrices.
///
/// - **Every tick**: [`add`](Self::add). Bounded, without a division by what was measured.
/// - **In the background**, about every 0.4 s: [`equations`](Self::equations) copies, [`Equations::solve`] solves, [`adopt`](Self::adopt) takes the
///   estimate over. Only copying and taking over must not meet a tick.
///
/// `N` is the number of words of the table, and two for each order of cogging; `RING` that of kept samples, more than 0.32/(turns per second · period)
/// and than 24 ms: 256 for a turn or two in a second, at 1 ms. The set has J, load, one kind of Coulomb friction and a viscous coefficient, as
/// far as the machine has them, with [`terms`](crate::harmonic::terms) of J and load.
///
/// Accuracy, half a minute at 1 kHz, 1 % noise of the torque, 12 bits or 10,000 counts with a jitter of 0.7, open and closed loop, 200 records of each:
/// J within 0.6 % of its maximum, feed-forward within 1 %, and the 95 % band of [`Found::inertia`] holds for 93.6 to 95.5 % (test
/// `the_band_holds_for_two_hundred_records`); `f32` differs from `f64` by a tenth of the standard error at most (test `single_precision_finds_the_same`).
///
/// Cost in `f32` with N = 30 on a Cortex-M4F: a tick takes at most 14,700 instructions, a solution 421,000 (`scripts/test counts`); 15 kB, and 9 kB
/// while a solution is made. With N = 16: 8 kB.
///
/// ```
/// use jred::axis::{Identification, IdentificationSettings, FoundStatus};
/// use jred::harmonic::terms;
/// use jred::{CurveSet, Phase, curves};
///
/// // Six harmonics of J and load, b and c.
/// const SET: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS | terms::GENERAL;
/// const WORDS: usize = 4 + 4 * 6;
///
/// # fn main() -> Result<(), jred::axis::AxisError> {
/// let settings = IdentificationSettings {
///     period: 0.001,
///     max_speed: 14.0,
///     inertia: 0.1,
///     torque_delay: 0.000_5,
///     torque_noise: 0.1,
///     angle_noise: 4.4e-4, // 2π/4096/√12
///     memory: f32::INFINITY,
/// };
/// let mut identification = Identification::<f32, WORDS, 256, SET>::new(&settings, &[])?;
/// // Every tick: the encoder's phase, and the torque on the drive link.
/// identification.add(Phase::default(), 12.0);
/// // In the background.
/// let found = identification.equations().solve();
/// identification.adopt(&found);
/// assert_eq!(found.status, FoundStatus::TooShort);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Identification<T, const N: usize, const RING: usize, const SET: CurveSet> {
    columns: [Column<T>; N],
    filter: Filter<T>,
    plan: Plan<T>,
    weights: [Weights<T>; MOST_TICKS],
    // The samples.
    phases: [u32; RING],
    torques: [T; RING],
    newest: usize,
    kept: usize,
    // The open windows, from the youngest to the oldest.
    tick: usize,
    windows: usize,
    begins: [Phase; WINDOWS],
    left_out: [bool; WINDOWS],
    measured: [[T; WINDOWS]; N],
    smoothed: [[T; WINDOWS]; N],
    right: [T; WINDOWS],
    products: [[T; WINDOWS]; WINDOWS],
    // The closed ones.
    rows: [Row<T, N>; WINDOWS],
    row: usize,
    // The equations.
    pivot: usize,
    turned: Row<T, N>,
    triangle: [[T; N]; N],
    equations: Equations<T, N>,
    // The last estimate, and the one that weights the noise.
    estimate: [T; N],
    estimated: bool,
    nominal: [T; N],
}

/// A row of the equations, whitened: what the smoothed angle says, what the measured one says, and the torque.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Row<T, const N: usize> {
    /// Its row of the Cholesky factor, from the diagonal backwards; 0 on the diagonal: not used.
    factor: [T; WINDOWS],
    smoothed: [T; N],
    measured: [T; N],
    right: T,
}

/// The fate of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Sampled {
    /// It was added.
    Added,
    /// Its torque is NaN or infinite; the samples around it are left out.
    NotFinite,
    /// The angle jumped: a tick was missed, or the encoder slipped. No window goes across it.
    Jumped,
}

impl<T: Circular, const N: usize, const RING: usize, const SET: CurveSet>
    Identification<T, N, RING, SET>
{
    /// An identification without samples, with cogging of these orders per turn of the drive link.
    ///
    /// # Errors
    /// [`AxisError::OutOfRange`]: `N` is not the number of words of a [`Harmonic`](crate::Harmonic) of this set and two for each order; the set has
    /// friction that varies with φ, or both kinds of Coulomb friction; an order of cogging is 0, one of the load, or given twice; `RING` is too
    /// short; or a setting is out of its range.
    pub fn new(settings: &IdentificationSettings, cogging: &[u32]) -> Result<Self, AxisError> {
        let columns = columns(SET, cogging)?;
        let (plan, weights, filter) = settings.plan(RING, N)?;
        let [zero, ..] = T::CONSTANTS;
        let none = [zero; N];
        let mut nominal = none;
        if let Some(mean) = nominal.first_mut() {
            *mean = plan.inertia;
        }
        let row = Row {
            factor: [zero; WINDOWS],
            smoothed: none,
            measured: none,
            right: zero,
        };
        Ok(Self {
            columns,
            filter,
            plan,
            weights,
            phases: [0; RING],
            torques: [zero; RING],
            newest: 0,
            kept: 0,
            tick: 0,
            windows: 0,
            begins: [Phase::default(); WINDOWS],
            left_out: [false; WINDOWS],
            measured: [[zero; WINDOWS]; N],
            smoothed: [[zero; WINDOWS]; N],
            right: [zero; WINDOWS],
            products: [[zero; WINDOWS]; WINDOWS],
            rows: [row; WINDOWS],
            row: 0,
            pivot: N,
            turned: row,
            triangle: [none; N],
            equations: Equations::new(columns, N - 2 * cogging.len()),
            estimate: none,
            estimated: false,
            nominal,
        })
    }

    /// Adds the encoder's phase and the torque on the drive link (N·m) of a tick. Bounded work, every tick.
    #[inline]
    pub fn add(&mut self, phase: Phase, torque: T) -> Sampled {
        self.turn_part();
        if !torque.is_finite() {
            self.equations.refused = self.equations.refused.saturating_add(1);
            self.gap();
            return Sampled::NotFinite;
        }
        let jumped = self.jumps(phase);
        if jumped {
            self.equations.jumps = self.equations.jumps.saturating_add(1);
            self.gap();
        }
        self.newest = (self.newest + 1) % RING;
        if let (Some(kept), Some(load)) = (
            self.phases.get_mut(self.newest),
            self.torques.get_mut(self.newest),
        ) {
            (*kept, *load) = (phase.to_bits(), torque);
        }
        if self.kept < 2 * self.filter.wide {
            self.kept += 1;
        } else {
            self.sample();
        }
        if jumped {
            Sampled::Jumped
        } else {
            Sampled::Added
        }
    }

    /// Ends all windows: ticks were missed, the torque was limited below what its signal says, or the machine was stopped from outside.
    pub fn gap(&mut self) {
        self.kept = 0;
        self.tick = 0;
        self.windows = 0;
        let [zero, ..] = T::CONSTANTS;
        for row in &mut self.rows {
            row.factor = [zero; WINDOWS];
        }
    }

    /// The equations so far, to be solved in the background: copy them while no tick adds.
    #[must_use]
    pub fn equations(&self) -> Equations<T, N> {
        self.equations.clone()
    }

    /// Takes an estimate that is good or disturbed as the one that weights the noise, and that further rows are compared with. Call it while no tick
    /// adds.
    pub fn adopt(&mut self, found: &Found<T, N>) {
        if matches!(found.status, FoundStatus::Good | FoundStatus::Disturbed) {
            self.estimate = found.coefficients;
            self.estimated = true;
            self.nominal = found.coefficients;
        }
    }
}
