//! The greatest speed at each place with which the drive can satisfy all limits ahead, and the place where it would stop.

use core::marker::PhantomData;

use super::braking::{Braking, Course, ONE, Way};
use super::envelope::in_range;
use super::error::{positive, within};
use super::{AxisError, MotionState, Period};
use crate::curve::{CurveSet, Format};
use crate::number::{Factor, Number, Quantity as _};
use crate::{Model, Phase};

/// Direction of motion of a drive link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Direction {
    /// φ grows.
    Forward,
    /// φ falls.
    Backward,
}

/// The greatest speed at every phase from which the drive can satisfy all limits of speed ahead, and the work of its brake, for motion in one
/// direction.
///
/// Created once, when the firmware starts, from the model's own table. Between two nodes ω² is linear, which is a constant acceleration. The squares
/// are computed from the end backwards: the work of the brake between two nodes takes the machine from one to the next,
///
/// ```text
/// ½·J·ω² ≤ ½·J·ω² there + ∫ (T_brake + c − load) dφ
/// ```
///
/// Within an interval the straight line needs more than the braking torque, by the change of that torque and of J in the interval: give the
/// look-ahead a few per cent less torque than the drive has. It reserves a share of the greatest deceleration for the tick
/// ([`Braking::deceleration`]), so that a [`Governor`](super::Governor) with the same deceleration in its [`Limits`](super::Limits) keeps below the
/// greatest speed (test `the_deceleration_of_the_limits_gives_no_false_alarm`). The same work gives the place where the machine would stop,
/// neglecting viscous friction:
///
/// ```text
/// ½·J·ω² = ∫ (T_brake + c − load) dφ
/// ```
///
/// The table is evaluated at the nodes and halfway between them: a peak of the load must be wider than an interval.
///
/// A tick needs no model for it, and computes with integers only, for every number type of the model. Memory: 16 bytes per node; while it is created,
/// as much again and 12 bytes per node more on the stack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LookAhead<N, const NODES: usize> {
    way: Way,
    /// ω² at each node, in units of 2⁻³⁰ of the square of the greatest speed.
    squares: [u32; NODES],
    /// The work of the brake from the start to each node, in units of 2⁻³² of the work over the range.
    works: [u32; NODES],
    /// The inverse of the work from each node to the next, shifted to 31 bits, so that a tick does not divide.
    inverses: [u32; NODES],
    /// ½·J at each node, scaled so that its product with the square is a work, shifted.
    inertias: [u32; NODES],
    shift: u32,
    /// Factor from speeds to units of 2⁻³⁰ of the greatest.
    speed: Factor,
    /// Factor from differences of squares between nodes to accelerations.
    alpha: Factor,
    /// Ticks for an interval at the greatest speed, in units of 2⁻⁸.
    ticks: u32,
    number: PhantomData<N>,
}

/// The place where a machine stops.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Stop {
    /// Whole turns before it; 0 on a stroke.
    pub turns: u32,
    /// Phase of the stop; the end of a stroke that is too short.
    pub phase: Phase,
    /// The place is not known: the stroke ends before it, the drive link moves the other way or faster than twice the greatest speed, or its speed is
    /// NaN.
    pub beyond: bool,
}

const SPEED: &str = "the greatest speed";
const NODE_COUNT: &str = "the number of nodes";

impl<N: Number, const NODES: usize> LookAhead<N, NODES> {
    /// Creates a look-ahead for a model and motions in this direction. `limit` is the greatest speed (rad/s, or m/s; positive in both directions) at
    /// a phase. It is evaluated at the nodes and halfway between them: a slower part longer than half an interval is found, and the machine is slow
    /// in all of it and up to an interval before and after it. At the end of a stroke the machine stops. `period` is the tick's.
    ///
    /// # Errors
    /// [`AxisError::Overpowered`]: somewhere the load drives the machine with more than the braking torque. Otherwise a torque, deceleration or speed
    /// that is not positive and finite (the deceleration may be infinite), or a speed beyond its base; too few nodes for this machine (fewer than 4,
    /// or J changes by half between two), or too many (more than 4096, or an interval takes less than one tick, or more than 2²², at the greatest
    /// speed).
    pub fn new<F: Format<Number = N>, const SET: CurveSet>(
        model: &Model<'_, F, SET>,
        direction: Direction,
        braking: Braking,
        limit: impl Fn(Phase) -> f32,
        period: &Period<N>,
    ) -> Result<Self, AxisError> {
        let count = NODES as f32;
        within(
            NODE_COUNT,
            count,
            (4..=4096).contains(&NODES),
            "from 4 to 4096",
        )?;
        let course = Course::<NODES>::new(model, direction, braking)?;
        let way = course.way;
        // The limit counts from the node before to the node after, so that no straight line at a node exceeds the limits in the intervals next to it.
        let all = 2 * way.intervals;
        let beside = |k: u32| {
            [0, 1, 2, 3, 4].map(|to: u32| {
                let half = (2 * k + to).saturating_sub(2);
                limit(way.node(if way.stroke {
                    half.min(all)
                } else {
                    (2 * k + to + all - 2) % all
                }))
            })
        };
        let [mut squares, mut works, mut inertias] = [[0; NODES]; 3];
        let mut top = 0.0_f32;
        for k in 0..NODES as u32 {
            for speed in beside(k) {
                top = top.max(positive(SPEED, speed)?);
            }
        }
        for (k, square) in (0..).zip(&mut squares) {
            let share = beside(k).into_iter().fold(top, f32::min) / top;
            *square = (share * share * ONE) as u32;
        }
        let scale = model.table().scale();
        let moved = period
            .moved(in_range(SPEED, top, scale.speed(), scale.omega(top))?)
            .to_bits();
        let tick = moved as f32 / way.width as f32 * course.step;
        course.slow_down(&mut squares, top, tick);
        let shift = course.works(&mut works, &mut inertias, top)?;
        let mut inverses = [0; NODES];
        for (k, inverse) in (0..).zip(&mut inverses) {
            let [work, next] = around(&works, k);
            let width = next.wrapping_sub(work).max(1);
            *inverse = ((1 << (31 + width.ilog2())) / u64::from(width)) as u32;
        }

        let ticks = (way.width as f32 / moved as f32 * 256.0) as u32;
        let holds = moved > 0 && moved < 1 << 31 && (256..1 << 30).contains(&ticks);
        within(
            NODE_COUNT,
            count,
            holds,
            "such that an interval takes from 1 to 2²² ticks at the greatest speed",
        )?;
        let of_difference = top / ONE * top / (2.0 * course.step) / scale.acceleration();
        let factors =
            Factor::to_count(ONE * (scale.speed() / top)).zip(Factor::of_count(of_difference));
        let (speed, alpha) = factors.ok_or(AxisError::OutOfRange {
            what: SPEED,
            value: top,
            range: "such that its square is a normal number in machine units",
        })?;
        Ok(Self {
            way,
            squares,
            works,
            inverses,
            inertias,
            shift,
            speed,
            alpha,
            ticks,
            number: PhantomData,
        })
    }

    /// Direction of the motions that it is for.
    #[must_use]
    pub const fn direction(&self) -> Direction {
        self.way.direction
    }

    /// The greatest speed at a phase (rad/s, or m/s), if `top` is the greatest of all; NaN if `top` is NaN. For plots and tests, not for the tick.
    #[must_use]
    pub fn speed_at(&self, phase: Phase, top: f32) -> f32 {
        let (k, part) = self.way.cell(phase);
        let [square, next] = around(&self.squares, k);
        let square = along(square, next, part) as f32 / ONE;
        top * crate::number::Real::sqrt(square)
    }

    /// The acceleration that keeps a motion in this direction below the greatest speed, within the possible ones: that of the limit itself plus the
    /// remaining margin, closed within one tick at the greatest speed and more slowly below it. For a motion in the other direction: the acceleration
    /// from rest. Also whether the speed exceeds the limit by more than about 1/64 of it and, for a limit near 0, of the greatest speed.
    #[inline]
    pub(super) fn greatest(
        &self,
        motion: &MotionState<N>,
        [least, most]: [N::Acceleration; 2],
    ) -> (N::Acceleration, bool) {
        let (k, part) = self.way.cell(motion.phase);
        let [square, next] = around(&self.squares, k);
        let reached = if self.is_along(motion.omega) {
            self.square(motion.omega)
        } else {
            0
        };
        let limit = along(square, next, part);
        let left = i64::from(limit) - i64::from(reached);
        // 33 bits times 30.
        let difference =
            i64::from(next) - i64::from(square) + ((left * i64::from(self.ticks)) >> 8);
        let alpha = match i32::try_from(difference) {
            Ok(difference) => N::Acceleration::of(N::of_count(difference, &self.alpha).value),
            Err(_) if difference > 0 => most,
            Err(_) => least,
        };
        (alpha, left < -i64::from((limit >> 5) + (1 << 18)))
    }

    /// The place where the machine stops from this state with the full braking torque. It does not stop later, except for the table's error and the
    /// assumption that the work grows linearly between two nodes: at the start and at the stop that errs by up to an eighth of an interval, times the
    /// relative change of the braking torque in it (test `it_stops_where_it_was_said`).
    #[inline]
    pub fn stop(&self, phase: Phase, omega: N::Speed) -> Stop {
        let square = self.square(omega);
        let (k, part) = self.way.cell(phase);
        let [work, next] = around(&self.works, k);
        let reached = work.wrapping_add(share(next.wrapping_sub(work), part));
        let [inertia, next] = around(&self.inertias, k);
        let needed =
            (u64::from(along(inertia, next, part)) * u64::from(square)) >> (self.shift & 63);
        let target = needed.saturating_add(reached.into());
        let ends = self.way.stroke && target > u32::MAX.into();
        let stop = (target & !u64::from(u32::MAX)) | u64::from(self.place(target as u32));
        let start = self.way.mirrored(phase);
        let distance = stop.saturating_sub(start.into());
        if ends {
            return Stop {
                turns: 0,
                phase: self.way.actual(u32::MAX),
                beyond: true,
            };
        }
        Stop {
            turns: (distance >> 32) as u32,
            phase: self.way.actual(start.wrapping_add(distance as u32)),
            beyond: !self.is_along(omega) || square == u32::MAX,
        }
    }

    /// Whether the speed is zero or in this direction; false for NaN.
    #[inline]
    fn is_along(&self, omega: N::Speed) -> bool {
        match self.way.direction {
            Direction::Forward => omega >= N::Speed::default(),
            Direction::Backward => omega <= N::Speed::default(),
        }
    }

    /// The square of a speed, in units of 2⁻³⁰ of the greatest speed's square; limited to four times that.
    #[inline]
    fn square(&self, omega: N::Speed) -> u32 {
        let count = omega.number().to_count(&self.speed).unsigned_abs();
        if count < i32::MAX.unsigned_abs() {
            ((u64::from(count) * u64::from(count)) >> 30) as u32
        } else {
            u32::MAX
        }
    }

    /// The place where this work is done, in units of 2⁻³² of the range.
    #[inline]
    fn place(&self, work: u32) -> u32 {
        let mut k = 0;
        let mut step = const { NODES.next_power_of_two() / 2 };
        while step > 0 {
            let found = self.works.get(k + step).is_some_and(|node| *node <= work);
            k += if found { step } else { 0 };
            step /= 2;
        }
        let k = k.min(self.way.intervals as usize - 1) as u32;
        let [start, next] = around(&self.works, k);
        let width = next.wrapping_sub(start);
        let inverse = self.inverses.get(k as usize).copied().unwrap_or_default();
        let shift = 30_u32.saturating_sub(width.leading_zeros());
        let part = (u64::from(work.wrapping_sub(start)) * u64::from(inverse)) >> shift;
        let width = self.way.width;
        width
            .wrapping_mul(k)
            .wrapping_add(share(width, part as u32))
    }
}

/// The values at both ends of an interval.
#[inline]
fn around(nodes: &[u32], k: u32) -> [u32; 2] {
    let k = k as usize;
    let first = nodes.first().copied().unwrap_or_default();
    let next = nodes.get(k + 1).copied().unwrap_or(first);
    [nodes.get(k).copied().unwrap_or(first), next]
}

/// A product with a share in units of 2⁻³².
#[inline]
fn share(whole: u32, part: u32) -> u32 {
    ((u64::from(whole) * u64::from(part)) >> 32) as u32
}

/// Linear interpolation.
#[inline]
fn along(from: u32, to: u32, part: u32) -> u32 {
    if to >= from {
        from.wrapping_add(share(to - from, part))
    } else {
        from.wrapping_sub(share(from - to, part))
    }
}
