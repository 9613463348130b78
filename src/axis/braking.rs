//! How a drive brakes a machine, looked at from the end backwards.

use super::error::{positive, within};
use super::{AxisError, Direction};
use crate::curve::{AccelerationOf, Format, Set, SpeedOf};
use crate::number::{Number, Quantity as _, Real as _, Sliding};
use crate::{Domain, Model, Phase};

/// What stops a machine.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Braking {
    /// The torque of the drive against the motion, on the drive link (N·m, or N): the least that it has at any speed up to the greatest.
    pub torque: f32,
    /// The greatest deceleration a (rad/s², or m/s²): that of [`Limits`](super::Limits), or infinite if only the torque limits it. Where a machine stops is told
    /// without it. A [`LookAhead`](super::LookAhead) counts on less of it, by the share 2·a·τ/ω_max for a tick τ: what a tick that begins to brake late must catch up with.
    pub deceleration: f32,
    /// Whether load and friction count where they help to brake. `false` for a load that may be missing, such as a workpiece: then only what drives the
    /// machine on counts.
    pub helped: bool,
}

/// A range, looked along in the direction of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Way {
    pub(super) direction: Direction,
    pub(super) stroke: bool,
    /// How many of the same width the nodes make; those of a stroke have one at its end.
    pub(super) intervals: u32,
    /// Of an interval, in units of 2⁻³² of the range.
    pub(super) width: u32,
}

impl Way {
    /// The phase as it is for a motion forward.
    #[inline]
    pub(super) fn mirrored(self, phase: Phase) -> u32 {
        match self.direction {
            Direction::Forward => phase.to_bits(),
            Direction::Backward => !phase.to_bits(),
        }
    }

    /// And back.
    #[inline]
    pub(super) fn actual(self, bits: u32) -> Phase {
        Phase::from_bits(match self.direction {
            Direction::Forward => bits,
            Direction::Backward => !bits,
        })
    }

    /// The interval of a phase, and where in it.
    #[inline]
    pub(super) fn cell(self, phase: Phase) -> (u32, u32) {
        Phase::from_bits(self.mirrored(phase)).cell(self.intervals)
    }

    /// The phase so many half intervals from the start.
    pub(super) fn node(self, half: u32) -> Phase {
        let bits = (u64::from(half) << 31) / u64::from(self.intervals.max(1));
        let last = if self.stroke { u32::MAX } else { bits as u32 };
        self.actual(u32::try_from(bits).unwrap_or(last))
    }
}

/// What a model says about braking at a place, in units of the torque base.
#[derive(Clone, Copy, Default)]
struct Place {
    /// J·α_b
    inertial: f32,
    /// T_brake + c − load
    braking: f32,
}

/// An interval: what is at its start, the work of the brake over it (in torque bases times rad or m), and by how much J exceeds the straight line in its middle.
#[derive(Clone, Copy, Default)]
struct Interval {
    inertial: f32,
    work: f32,
    bulge: f32,
}

/// A motion through the range of a model, and what brakes it.
pub(super) struct Course<const NODES: usize> {
    pub(super) way: Way,
    /// Length of an interval (rad, or m).
    pub(super) step: f32,
    /// One for each node; of a stroke, the last has no length.
    intervals: [Interval; NODES],
    /// What an acceleration of α_b changes of the square of the speed along an interval; what the greatest deceleration does.
    gained: f32,
    most: f32,
}

/// 2³⁰: the square of the greatest speed.
pub(super) const ONE: f32 = 1_073_741_824.0;

/// What a model says at a phase.
fn place<F: Format, const SET: Set>(
    model: &Model<'_, F, SET>,
    way: Way,
    braking: &Braking,
    half: u32,
) -> Result<Place, AxisError> {
    let phase = way.node(half);
    // The greatest number that a model takes.
    let one = F::Number::per_unit(1.0, 1.0).value;
    let (omega, alpha) = (SpeedOf::<F>::of(one), AccelerationOf::<F>::of(one));
    let terms = model.contributions(phase, omega, alpha, Sliding::Against(omega));
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
    let place = Place {
        inertial: terms.inertial.to_si(1.0) / one.si(1.0),
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
    pub(super) fn new<F: Format, const SET: Set>(
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

    /// Of the interval after this one.
    fn next(&self, k: usize) -> Interval {
        let [first, ..] = self.intervals.as_slice() else {
            return Interval::default();
        };
        *self.intervals.get(k + 1).unwrap_or(first)
    }

    /// Lowers the squares of the speed, in units of 2⁻³⁰ of that of `top`, so far that the machine can be braked to each from the one before:
    ///
    /// ```text
    /// ½·J·ω² ≤ ½·J·ω² there + work between,   ω² ≤ ω² there + 2·a·(1 − 2·a·τ/ω_top)·Δφ
    /// ```
    ///
    /// A tick that begins just before a limit falls moves `tick` = ω_top·τ along it at full speed: then ω² is 2·a·ω_top·τ above it, and nothing could bring it down if the limit itself took all of a. The share
    /// that is left out makes up for it until the machine rests: 2·a·(2·a·τ/ω_top)·s along the way s = ω_top²/(2·a).
    pub(super) fn slow_down(&self, squares: &mut [u32; NODES], [top, tick]: [f32; 2]) {
        let gained = self.gained / top / top;
        let most = self.most / top / top;
        // 2·a·τ/ω_top, of a braking way that is longer than some ticks.
        let most = most * (1.0 - (most / self.step * tick).min(0.5));
        if let (true, Some(end)) = (self.way.stroke, squares.last_mut()) {
            *end = 0;
        }
        // On a turn the second round has the right start: what binds the start in the first is a limit that the second does not lower.
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
                // Rounded down, whatever the last roundings were.
                *square = (*square).min((least * (ONE * 0.999_999)) as u32);
                after = *square as f32 / ONE;
            }
        }
    }

    /// The work of the brake up to each node, in units of 2⁻³² of that over the range; ½·J, so that the square of a speed times it, shifted down by what is
    /// returned, is that work. Straight lines between the nodes lie above J where it bulges.
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
