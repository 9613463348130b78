//! How a drive brakes a machine, computed from the end backwards.

use super::error::{positive, within};
use super::{AxisError, Direction};
use crate::curve::{AccelerationOf, CurveSet, Format, SpeedOf};
use crate::number::{FrictionSign, Number, Quantity as _, Real as _};
use crate::{Domain, Model, Phase};

/// The drive's braking ability.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Braking {
    /// Torque of the drive against the motion, on the drive link (N·m, or N): the least that it has at any speed up to the greatest.
    pub torque: f32,
    /// The greatest deceleration a (rad/s², or m/s²): the same as in [`Limits`](super::Limits), or infinite if only the torque limits it.
    /// [`LookAhead::stop`](super::LookAhead::stop) does not use it. A [`LookAhead`](super::LookAhead) plans with less of it, by the share 2·a·τ/ω_max
    /// for a tick τ: the reserve for a tick that begins to brake late.
    pub deceleration: f32,
    /// Whether load and friction count where they help to brake. `false` for a load that may be missing, such as a workpiece: then only loads that
    /// drive the machine count.
    pub helped: bool,
}

/// A range in the direction of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Way {
    pub(super) direction: Direction,
    pub(super) stroke: bool,
    /// Number of intervals of equal width between the nodes; on a stroke the last node is its end.
    pub(super) intervals: u32,
    /// Width of an interval, in units of 2⁻³² of the range.
    pub(super) width: u32,
}

impl Way {
    /// The phase as seen by a forward motion.
    #[inline]
    pub(super) fn mirrored(self, phase: Phase) -> u32 {
        match self.direction {
            Direction::Forward => phase.to_bits(),
            Direction::Backward => !phase.to_bits(),
        }
    }

    /// Inverse of [`mirrored`](Self::mirrored).
    #[inline]
    pub(super) fn actual(self, bits: u32) -> Phase {
        Phase::from_bits(match self.direction {
            Direction::Forward => bits,
            Direction::Backward => !bits,
        })
    }

    /// The interval of a phase, and the position in it.
    #[inline]
    pub(super) fn cell(self, phase: Phase) -> (u32, u32) {
        Phase::from_bits(self.mirrored(phase)).cell(self.intervals)
    }

    /// The phase `half` half intervals from the start.
    pub(super) fn node(self, half: u32) -> Phase {
        let bits = (u64::from(half) << 31) / u64::from(self.intervals.max(1));
        let last = if self.stroke { u32::MAX } else { bits as u32 };
        self.actual(u32::try_from(bits).unwrap_or(last))
    }
}

/// Terms of the model for braking at a place, in units of the torque base.
#[derive(Clone, Copy, Default)]
struct NodeTerms {
    /// J·α_b
    inertial: f32,
    /// T_brake + c − load
    braking: f32,
}

/// An interval: values at its start, the work of the brake over it (in torque bases times rad or m), and by how much J in its middle exceeds the
/// straight line.
#[derive(Clone, Copy, Default)]
struct Interval {
    inertial: f32,
    work: f32,
    bulge: f32,
}

/// A motion through the range of a model, and its braking.
pub(super) struct Course<const NODES: usize> {
    pub(super) way: Way,
    /// Length of an interval (rad, or m).
    pub(super) step: f32,
    /// One for each node; on a stroke, the last has no length.
    intervals: [Interval; NODES],
    /// Change of ω² over an interval: by an acceleration of α_b, and by the greatest deceleration.
    gained: f32,
    most: f32,
}

/// 2³⁰: the square of the greatest speed.
pub(super) const ONE: f32 = 1_073_741_824.0;

/// Terms of the model at a phase.
fn place<F: Format, const SET: CurveSet>(
    model: &Model<'_, F, SET>,
    way: Way,
    braking: &Braking,
    half: u32,
) -> Result<NodeTerms, AxisError> {
    let phase = way.node(half);
    // 1.0, the greatest number that a model takes in fixed point.
    let one = F::Number::per_unit(1.0, 1.0).value;
    let (omega, alpha) = (SpeedOf::<F>::of(one), AccelerationOf::<F>::of(one));
    let terms = model.torque_terms(phase, omega, alpha, FrictionSign::OfSpeed(omega));
    let load = terms.load.to_si(1.0);
    let resistance = match way.direction {
        Direction::Forward => load,
        Direction::Backward => -load,
    };
    let helping = if braking.helped {
        resistance + terms.coulomb.to_si(1.0)
    } else {
        resistance.min(0.0)
    };
    let place = NodeTerms {
        inertial: terms.acceleration.to_si(1.0) / one.si(1.0),
        braking: braking.torque / model.table().scale().torque() + helping,
    };
    if place.braking > 0.0 {
        Ok(place)
    } else {
        let base = model.table().scale().torque();
        Err(AxisError::Overpowered {
            phase,
            load: -helping * base,
            braking: braking.torque,
        })
    }
}

impl<const NODES: usize> Course<NODES> {
    pub(super) fn new<F: Format, const SET: CurveSet>(
        model: &Model<'_, F, SET>,
        direction: Direction,
        braking: Braking,
    ) -> Result<Self, AxisError> {
        positive("the braking torque", braking.torque)?;
        let holds = braking.deceleration > 0.0;
        within(
            "the greatest deceleration",
            braking.deceleration,
            holds,
            "greater than zero",
        )?;
        let domain = model.table().domain();
        let acceleration = model.table().scale().acceleration();
        let stroke = matches!(domain, Domain::Stroke { .. });
        let count = NODES as u32 - u32::from(stroke);
        let way = Way {
            direction,
            stroke,
            intervals: count,
            width: ((1_u64 << 32) / u64::from(count)) as u32,
        };
        let step = domain.span().to_f32() / count as f32;
        let mut intervals = [Interval::default(); NODES];
        let mut start = place(model, way, &braking, 0)?;
        for (k, interval) in (0..).zip(&mut intervals) {
            interval.inertial = start.inertial;
            if k == count {
                break;
            }
            let middle = place(model, way, &braking, 2 * k + 1)?;
            let end = place(model, way, &braking, 2 * k + 2)?;
            // Simpson's rule: exact for a cubic.
            interval.work = step / 6.0 * (start.braking + 4.0 * middle.braking + end.braking);
            let mean = 0.5 * (start.inertial + end.inertial);
            interval.bulge = (middle.inertial - mean).max(0.0);
            let close = (end.inertial - start.inertial).abs() <= 0.5 * mean;
            within(
                "the number of nodes",
                NODES as f32,
                close,
                "greater: J changes by half from one to the next",
            )?;
            start = end;
        }
        Ok(Self {
            way,
            step,
            intervals,
            gained: 2.0 * acceleration,
            most: 2.0 * step * braking.deceleration,
        })
    }

    /// The interval after this one.
    fn next(&self, k: usize) -> Interval {
        let [first, ..] = self.intervals.as_slice() else {
            return Interval::default();
        };
        *self.intervals.get(k + 1).unwrap_or(first)
    }

    /// Lowers the squares of the speed, in units of 2⁻³⁰ of that of `top`, until the machine can be braked from each node to the next:
    ///
    /// ```text
    /// ½·J·ω² ≤ ½·J·ω² there + work between,   ω² ≤ ω² there + 2·a·(1 − 2·a·τ/ω_top)·Δφ
    /// ```
    ///
    /// A tick that begins just before a limit falls moves `tick` = ω_top·τ along it at full speed: then ω² is 2·a·ω_top·τ above the limit, and could
    /// not be reduced if the limit itself used all of a. The reserved share makes up for it by standstill: 2·a·(2·a·τ/ω_top)·s along the way s =
    /// ω_top²/(2·a).
    pub(super) fn slow_down(&self, squares: &mut [u32; NODES], top: f32, tick: f32) {
        let gained = self.gained / top / top;
        let most = self.most / top / top;
        // 2·a·τ/ω_top, for a braking distance longer than a few ticks.
        let most = most * (1.0 - (most / self.step * tick).min(0.5));
        if let (true, Some(end)) = (self.way.stroke, squares.last_mut()) {
            *end = 0;
        }
        // A turn needs two rounds, because the first one starts with an unlowered limit. The second cannot lower the limit that binds at the start.
        let rounds = if self.way.stroke { 1 } else { 2 };
        for _ in 0..rounds {
            let first = squares.first().copied().unwrap_or_default();
            let mut after = if self.way.stroke {
                0.0
            } else {
                first as f32 / ONE
            };
            for k in (0..self.way.intervals as usize).rev() {
                let (Some(interval), Some(square)) = (self.intervals.get(k), squares.get_mut(k))
                else {
                    continue;
                };
                let energy = self.next(k).inertial * after + gained * interval.work;
                let least = (energy / interval.inertial).min(after + most);
                // Rounded down, regardless of rounding errors before.
                *square = (*square).min((least * (ONE * 0.999_999)) as u32);
                after = *square as f32 / ONE;
            }
        }
    }

    /// Fills the work of the brake up to each node, in units of 2⁻³² of the work over the range, and ½·J, scaled so that ½·J times the square of a
    /// speed, shifted right by the returned count, is a work in that unit. Where J bulges the lines between the nodes are raised to lie above it.
    pub(super) fn works(
        &self,
        works: &mut [u32; NODES],
        inertias: &mut [u32; NODES],
        top: f32,
    ) -> Result<u32, AxisError> {
        let all: f32 = self.intervals.iter().map(|interval| interval.work).sum();
        let mut done = 0.0;
        for (interval, work) in self.intervals.iter().zip(works.iter_mut()) {
            *work = (done / all * (4.0 * ONE)) as u32;
            done += interval.work;
        }
        let energy = |inertial: f32| inertial * (top / self.gained * top) / all;
        let last = self.intervals.last().map_or(0.0, |interval| interval.bulge);
        let mut before = if self.way.stroke { 0.0 } else { last };
        let raised = self.intervals.map(|interval| {
            let bulge = interval.bulge.max(before);
            before = interval.bulge;
            energy(interval.inertial + bulge)
        });
        let most = raised.into_iter().fold(0.0, f32::max);
        let exponent = exponent(most);
        let range = "less than 2²⁸, and more than 2⁻³⁰";
        within(
            "the energy at the greatest speed, over the work of the brake in the range,",
            most,
            (-30..28).contains(&exponent),
            range,
        )?;
        let shift = 30 - exponent;
        for (inertia, raised) in inertias.iter_mut().zip(raised) {
            *inertia = (raised * power_of_two(shift)) as u32;
        }
        Ok(shift.cast_unsigned() - 2)
    }
}

/// ⌊log₂ x⌋ of a normal number.
fn exponent(x: f32) -> i32 {
    (x.to_bits() >> 23 & 0xff) as i32 - 127
}

/// 2ⁿ, −126 ≤ n ≤ 127
fn power_of_two(n: i32) -> f32 {
    f32::from_bits(((n + 127) as u32) << 23)
}
