//! The ways to feed forward that are compared.

use jred::axis::{FeedForward, MotionState};
use jred::machine::{PoseError, Reducible};
use jred::number::FrictionSign;
use jred::table::{Format, words_len};
use jred::tabulate::{Request, scratch_len, tabulate};
use jred::{CurveSet, Model, Phase, Q31, Rows16, Scale, Spline, curves};

use crate::Fault;
use crate::machine::Paced;

/// A way to feed forward.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Way {
    /// None.
    None,
    /// The mean inertia times the acceleration of the set-point.
    MeanInertia,
    /// The same, the mean viscous and the mean Coulomb friction.
    MeanFriction,
    /// The torque of the motion at its own pace, by position.
    TorqueTable,
    /// A table of jred in `f32`.
    Float,
    /// The same in `Q31`.
    Q31,
    /// The same in `Q15`.
    Q15,
}

impl Way {
    pub(crate) const ALL: [Self; 7] = [
        Self::None,
        Self::MeanInertia,
        Self::MeanFriction,
        Self::TorqueTable,
        Self::Float,
        Self::Q31,
        Self::Q15,
    ];

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::MeanInertia => "constant J",
            Self::MeanFriction => "constant J, friction",
            Self::TorqueTable => "torque table",
            Self::Float => "jred, `f32`",
            Self::Q31 => "jred, `Q31`",
            Self::Q15 => "jred, `Q15`",
        }
    }
}

/// The torque for a motion.
pub(crate) type Ahead<'a> = &'a dyn Fn(MotionState<f32>) -> f32;

/// The controller's knowledge of a machine.
pub(crate) struct Known<'m, M> {
    machine: &'m M,
    /// Its motion at its own pace.
    motion: Paced<'m>,
    /// Means of J, b and c over the turn.
    means: [f32; 3],
    /// The largest speed and acceleration to tabulate for.
    extremes: [f64; 2],
}

/// Places over which the machine is averaged, and of the torque table.
const PLACES: u32 = 1024;

/// Largest error of a table as a share of the largest torque.
const ERROR: f64 = 1e-3;
const ERROR_Q15: f64 = 5e-3;

/// All curves, for every machine.
const SET: CurveSet = curves::LOAD | curves::VISCOUS | curves::COULOMB;

impl<'m, M: Reducible> Known<'m, M> {
    /// Of a machine, for motions up to these extremes.
    pub(crate) fn new(
        machine: &'m M,
        motion: Paced<'m>,
        extremes: [f64; 2],
    ) -> Result<Self, Fault> {
        Ok(Self {
            machine,
            motion,
            means: means(machine)?,
            extremes,
        })
    }

    /// Runs something with a way to feed forward.
    pub(crate) fn with<T>(&self, way: Way, run: impl FnOnce(Ahead) -> T) -> Result<T, Fault> {
        let [inertia, viscous, coulomb] = self.means;
        let [speed, acceleration] = self.extremes;
        Ok(match way {
            Way::None => run(&|_| 0.0),
            Way::MeanInertia => run(&|motion| inertia * motion.alpha),
            Way::MeanFriction => run(&|motion| {
                let sign = f32::from(i8::from(motion.omega > 0.0) - i8::from(motion.omega < 0.0));
                inertia * motion.alpha + viscous * motion.omega + coulomb * sign
            }),
            Way::TorqueTable => {
                let table = self.torque_table()?;
                run(&|motion| interpolated(&table, motion.phase))
            }
            Way::Float => self.tabulated::<Spline<f32>, T>(Scale::SI, ERROR, run)?,
            Way::Q31 => {
                let scale = Scale::covering(self.machine, speed, acceleration, PLACES)?;
                self.tabulated::<Spline<Q31>, T>(scale, ERROR, run)?
            }
            Way::Q15 => {
                let scale = Scale::limited_to(self.machine, speed, acceleration, PLACES)?;
                self.tabulated::<Rows16, T>(scale, ERROR_Q15, run)?
            }
        })
    }

    /// With a model of the core.
    fn tabulated<F: Format, T>(
        &self,
        scale: Scale,
        error: f64,
        run: impl FnOnce(Ahead) -> T,
    ) -> Result<T, Fault> {
        const CELLS: u32 = 1024;
        let [speed, acceleration] = self.extremes;
        let request = Request::new(error * self.largest_torque()?)
            .with_max_speed(speed)
            .with_max_acceleration(acceleration)
            .with_max_cells(CELLS);
        let mut scratch = vec![0.0; scratch_len(CELLS, SET)];
        let mut words = vec![F::Word::default(); words_len::<F>(CELLS, SET)];
        let found = tabulate::<F>(
            self.machine,
            SET,
            &request,
            &scale,
            &mut scratch,
            &mut words,
        )?;
        let table = jred::tabulate::fill::<F>(
            self.machine,
            SET,
            found.cells,
            &found.scale,
            &mut scratch,
            &mut words,
        )?;
        let scale = found.scale;
        let model = Model::<F, SET>::new(table).map_err(jred::error::Error::Table)?;
        let feed_forward = FeedForward::new(model, found.validity(&request));
        Ok(run(&|motion| {
            let motion = MotionState {
                phase: motion.phase,
                omega: scale.omega(motion.omega).value,
                alpha: scale.alpha(motion.alpha).value,
            };
            let friction = FrictionSign::OfSpeed(motion.omega);
            scale.torque_si(feed_forward.at_reference(motion, friction).torque)
        }))
    }

    /// The largest torque of the motion at its own pace (N·m).
    fn largest_torque(&self) -> Result<f64, Fault> {
        let mut most = 0.0_f64;
        for place in 0..PLACES {
            let share = f64::from(place) / f64::from(PLACES);
            let [phi, omega, alpha] = self.motion.at(share * self.motion.duration());
            let torque = self.machine.reduction(phi)?.torque(omega, alpha).total();
            most = most.max(torque.abs());
        }
        Ok(most)
    }

    /// The torque of the motion at its own pace, at equal distances over the turn.
    fn torque_table(&self) -> Result<Vec<f32>, PoseError> {
        let [start, ..] = self.motion.at(0.0);
        let torque = |place: u32| -> Result<f32, PoseError> {
            let way = (turn(place) - start).rem_euclid(core::f64::consts::TAU);
            let (mut before, mut after) = (0.0, self.motion.duration());
            for _ in 0..60 {
                let middle = f64::midpoint(before, after);
                if self.motion.at(middle)[0] - start < way {
                    before = middle;
                } else {
                    after = middle;
                }
            }
            let [phi, omega, alpha] = self.motion.at(before);
            let here = self.machine.reduction(phi)?;
            // Friction acts at the start as well.
            let omega = omega.max(f64::MIN_POSITIVE);
            Ok(here.torque(omega, alpha).total() as f32)
        };
        (0..PLACES).map(torque).collect()
    }
}

/// The means of J, b and c over the turn.
fn means(machine: &impl Reducible) -> Result<[f32; 3], PoseError> {
    let mut sums = [0.0; 3];
    for place in 0..PLACES {
        let here = machine.reduction(turn(place))?;
        for (sum, value) in sums
            .iter_mut()
            .zip([here.inertia, here.viscous, here.coulomb])
        {
            *sum += value / f64::from(PLACES);
        }
    }
    Ok(sums.map(|mean| mean as f32))
}

/// The mean inertia (kg·m²), which gives the gains of the controller as well.
pub(crate) fn mean_inertia(machine: &impl Reducible) -> Result<f32, PoseError> {
    let [inertia, ..] = means(machine)?;
    Ok(inertia)
}

/// A place of the turn (rad).
fn turn(place: u32) -> f64 {
    f64::from(place) / f64::from(PLACES) * core::f64::consts::TAU
}

/// Linear interpolation in a table over the turn.
fn interpolated(table: &[f32], phase: Phase) -> f32 {
    let (cell, rest) = phase.cell(PLACES);
    let at = |cell: u32| {
        let place = (cell % PLACES) as usize;
        table.get(place).copied().unwrap_or_default()
    };
    let share = rest as f32 / 4_294_967_296.0;
    at(cell) + (at(cell + 1) - at(cell)) * share
}
