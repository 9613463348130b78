//! How a drive brakes a machine, looked at from the end backwards.

use super::error::{positive, within};
use super::{AxisError, Direction};
use crate::curve::{Format, Set};
use crate::number::{Number, Real, Sliding};
use crate::{Domain, Model, Phase};

/// What stops a machine.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Braking {
    /// The torque of the drive against the motion, on the drive link (N·m, or N): the least that it has at any speed up to the greatest.
    pub torque: f32,
    /// The greatest deceleration (rad/s², or m/s²); infinite if only the torque limits it. Where a machine stops is told without it.
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

/// A motion through the range of a model, and what brakes it.
pub(super) struct Course<'m, 'a, F: Format, const SET: Set> {
    model: &'m Model<'a, F, SET>,
    pub(super) way: Way,
    /// Length of an interval (rad, or m).
    pub(super) step: f32,
    braking: Braking,
}

/// What a model says about braking at a place, in units of the torque base.
#[derive(Clone, Copy)]
struct Place {
    /// J·α_b
    inertial: f32,
    /// ½·J′·ω_b²
    velocity: f32,
    /// T_brake + c − load
    braking: f32,
}

/// 2³⁰
const ONE: f32 = 1_073_741_824.0;

impl<'m, 'a, F: Format, const SET: Set> Course<'m, 'a, F, SET> {
    pub(super) fn new(
        model: &'m Model<'a, F, SET>,
        direction: Direction,
        braking: Braking,
        nodes: u32,
    ) -> Result<Self, AxisError> {
        positive("the braking torque", braking.torque)?;
        let holds = braking.deceleration > 0.0;
        within("the greatest deceleration", holds, "greater than zero")?;
        let domain = model.table().domain();
        let stroke = matches!(domain, Domain::Stroke { .. });
        let intervals = if stroke { nodes - 1 } else { nodes };
        Ok(Self {
            model,
            way: Way {
                direction,
                stroke,
                intervals,
                width: ((1_u64 << 32) / u64::from(intervals)) as u32,
            },
            step: domain.span().to_f32() / intervals as f32,
            braking,
        })
    }

    /// So many half intervals from the start.
    fn place(&self, half: u32) -> Result<Place, AxisError> {
        let phase = self.way.node(half);
        // The greatest number that a model takes.
        let one = F::Number::per_unit(1.0, 1.0).value;
        let unit = one.si(1.0);
        let terms = self
            .model
            .contributions(phase, one, one, Sliding::Against(one));
        let forward = match self.way.direction {
            Direction::Forward => 1.0,
            Direction::Backward => -1.0,
        };
        let resistance = forward * terms.load.si(1.0);
        let helping = if self.braking.helped {
            resistance + terms.coulomb.si(1.0)
        } else {
            resistance.min(0.0)
        };
        let braking = self.braking.torque / self.model.table().scale().torque() + helping;
        if braking > 0.0 {
            Ok(Place {
                inertial: terms.inertial.si(1.0) / unit,
                velocity: forward * terms.velocity.si(1.0) / (unit * unit),
                braking,
            })
        } else {
            Err(AxisError::Overpowered(phase))
        }
    }

    /// Lowers the squares of the speed, in units of 2⁻³⁰ of that of `top`, so far that the machine can be braked to each from the one before.
    pub(super) fn slow_down(&self, squares: &mut [u32], top: f32) -> Result<(), AxisError> {
        let scale = self.model.table().scale();
        // What an acceleration of α_b, and the velocity torque of ω_b, change of the square along an interval.
        let of_alpha = 2.0 * self.step * (scale.acceleration() / top / top);
        let of_velocity = 2.0 * self.step * (scale.acceleration() / scale.speed() / scale.speed());
        let most = 2.0 * self.step * (self.braking.deceleration / top / top);
        // Where nothing is limited on a turn, once round: then its beginning is known.
        let rounds = if self.way.stroke { 1 } else { 2 };
        if let (true, Some(end)) = (self.way.stroke, squares.last_mut()) {
            *end = 0;
        }
        for _ in 0..rounds {
            let mut after = self.place(2 * self.way.intervals)?;
            for k in (0..self.way.intervals).rev() {
                let [before, middle] = [self.place(2 * k)?, self.place(2 * k + 1)?];
                let next = squares.get(k as usize + 1).or(squares.first());
                let next = next.copied().unwrap_or_default() as f32 / ONE;
                let [slowed, pull] = [
                    |place: &Place| place.braking / place.inertial,
                    |place: &Place| place.velocity / place.inertial,
                ]
                .map(|of| [&before, &middle, &after].map(of));
                let [d0, d1, d2] = slowed.map(|d| d * of_alpha);
                let [v0, v1, v2] = pull.map(|v| v * of_velocity);
                let close = [v0, v1, v2].iter().all(|v| v.abs() <= 0.25);
                within(
                    "the number of nodes",
                    close,
                    "greater: J changes by a quarter between two",
                )?;
                let least = ((next + d0) / (1.0 - v0))
                    .min((next * (1.0 + 0.5 * v1) + d1) / (1.0 - 0.5 * v1))
                    .min(next * (1.0 + v2) + d2)
                    .min(next + most);
                if let Some(square) = squares.get_mut(k as usize) {
                    *square = (*square).min((least * ONE) as u32);
                }
                after = before;
            }
        }
        Ok(())
    }

    /// The work of the brake up to each node, in units of 2⁻³² of that over the range; ½·J, so that the square of a speed times it, shifted down by what is
    /// returned, is that work.
    pub(super) fn works(
        &self,
        works: &mut [u32],
        inertias: &mut [u32],
        top: f32,
    ) -> Result<u32, AxisError> {
        let simpson = |k: u32| -> Result<f32, AxisError> {
            let [a, b, c] = [
                self.place(2 * k)?,
                self.place(2 * k + 1)?,
                self.place(2 * k + 2)?,
            ];
            Ok(self.step / 6.0 * (a.braking + 4.0 * b.braking + c.braking))
        };
        let mut all = 0.0;
        for k in 0..self.way.intervals {
            all += simpson(k)?;
        }
        let mut done = 0.0;
        let mut largest = 0.0_f32;
        for (k, work) in (0..).zip(works.iter_mut()) {
            *work = (done / all * (4.0 * ONE)) as u32;
            if k < self.way.intervals {
                done += simpson(k)?;
            }
            largest = largest.max(self.place(2 * k)?.inertial);
        }
        // ½·J·top² in such works: of all of J, 31 bits.
        let energy = |inertial: f32| {
            0.5 * inertial * (top / self.model.table().scale().acceleration() * top) / all
        };
        let exponent = exponent(energy(largest));
        let range = "less than the work of its brake over 2²⁸ ranges, and more than 2⁻³⁰ of one";
        within(
            "the energy at the greatest speed",
            (-30..28).contains(&exponent),
            range,
        )?;
        let shift = 30 - exponent;
        for (k, inertia) in (0..).zip(inertias.iter_mut()) {
            *inertia = (energy(self.place(2 * k)?.inertial) * power_of_two(shift)) as u32;
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
