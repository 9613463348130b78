//! The torque that a drive has at each speed.

use super::error::{positive, within};
use super::{AxisError, Gearbox};
use crate::Outcome;
use crate::number::{Factor, Number, Quantity};
use crate::tick::MachineUnits;

/// Torque-speed envelope of a drive, in both directions: a curve that falls with the speed where it drives, a constant where it brakes.
///
/// ```text
/// T ∈ [−T_brake, T(ω)]      ω > 0
/// T ∈ [−T(0), T(0)]         ω = 0
/// T ∈ [−T(−ω), T_brake]     ω < 0
/// ```
///
/// T(ω) is T₁ up to the first speed, linear between the points, and 0 beyond the last: a motor has a constant peak torque up to a corner speed, above
/// which the voltage limits it.
///
/// ```
/// use jred::axis::Envelope;
/// use jred::{Image, Model, Spline, curves, include_image};
///
/// # fn main() -> Result<(), jred::FirmwareError> {
/// let image = Image::from_bytes(include_image!("../../examples/data/press_f32.jred"))?;
/// let press: Model<Spline<f32>, { curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS }> = image.model()?;
/// // 80 N·m up to 6 rad/s, 20 N·m at 12 rad/s; 60 N·m when it brakes.
/// let envelope = Envelope::new([[6.0, 80.0], [12.0, 20.0]], 60.0, &press)?;
/// assert_eq!(envelope.torques(9.0), [-60.0, 50.0]);
/// assert_eq!(envelope.torques(-3.0), [-80.0, 60.0]);
/// assert_eq!(envelope.torques(13.0), [-60.0, 0.0]);
/// # Ok(())
/// # }
/// ```
///
/// Accuracy in fixed point: six units of 2⁻³¹ of the torque base, plus 2⁻²³ of the fall from point to point (`Q15`: three units of 2⁻¹⁵; test
/// `an_envelope_is_that_of_its_points`).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Envelope<N: Number, const POINTS: usize> {
    /// From 0 to T₁.
    driving: [N::Torque; 2],
    /// −T_brake.
    brake: N::Torque,
    falls: [Fall<N>; POINTS],
    top: N::Speed,
}

/// The line to a point: its start, and the torque lost per unit of speed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct Fall<N: Number> {
    from: N::Speed,
    torque: N::Torque,
    slope: Factor,
}

const SPEEDS: &str = "a speed of the torque curve";
const TORQUES: &str = "a torque of the torque curve";
const POINT_COUNT: &str = "the number of points of the torque curve";
const BRAKE: &str = "the braking torque";

impl<N: Number, const POINTS: usize> Envelope<N, POINTS> {
    /// Creates an envelope for a model in its machine units. `driving`: points `[speed, torque]` on the drive link (rad/s, N·m; or m/s, N); `brake`:
    /// the braking torque.
    ///
    /// # Errors
    /// No point; a first torque or a braking torque that is not positive and finite; a torque that rises with the speed; speeds that are negative or
    /// do not rise; in fixed point a torque beyond its base.
    pub fn new(
        driving: [[f32; 2]; POINTS],
        brake: f32,
        model: &impl MachineUnits<Number = N>,
    ) -> Result<Self, AxisError> {
        let scale = model.scale();
        let base = scale.torque();
        within(POINT_COUNT, POINTS as f32, POINTS > 0, "at least 1")?;
        let first = driving.first().map_or(0.0, |[_, torque]| *torque);
        let peak = in_range(
            TORQUES,
            positive(TORQUES, first)?,
            base,
            scale.to_torque(first),
        )?;
        let brake: N::Torque =
            in_range(BRAKE, positive(BRAKE, brake)?, base, scale.to_torque(brake))?;
        let rest = N::Speed::default();
        let mut falls = [Fall::default(); POINTS];
        let mut last = [0.0, first];
        let mut top = rest;
        for (k, (fall, point)) in falls.iter_mut().zip(driving).enumerate() {
            let [run, lost] = [point[0] - last[0], last[1] - point[1]];
            let rises = run > 0.0 || k == 0 && run >= 0.0;
            within(
                SPEEDS,
                point[0],
                rises && run.is_finite(),
                "finite, from 0 on, and greater than the one before",
            )?;
            let falling = lost >= 0.0 && point[1] >= 0.0;
            within(
                TORQUES,
                point[1],
                falling,
                "from 0 on, and not greater than the one before",
            )?;
            *fall = Fall {
                from: top,
                torque: scale.to_torque(last[1]).value,
                slope: if lost > 0.0 {
                    let slope = lost / run * scale.speed() / scale.torque();
                    Factor::new(slope).ok_or(AxisError::OutOfRange {
                        what: "the slope of the torque curve, in bases of torque and speed,",
                        value: slope,
                        range: "a normal number, and in fixed point less than 2³⁰ torque bases a speed base",
                    })?
                } else {
                    Factor::default()
                },
            };
            // In fixed point the line ends at the greatest representable speed.
            top = scale.omega(point[0]).value;
            last = point;
        }
        Ok(Self {
            driving: [N::Torque::default(), peak],
            brake: brake.negated(),
            falls,
            top,
        })
    }

    /// As [`new`](Self::new), for the motor's points and braking torque, converted to the drive link: ω/i, and T·i·η where the motor drives. Where it
    /// brakes, T·i: the gearbox losses help to brake the machine, but not the rotor. The table must contain the rotor's inertia as i²·J_M.
    ///
    /// # Errors
    /// As `new`; a ratio that is not positive, an efficiency outside 0.01 to 1, or a rotor inertia other than 0.
    pub fn of_motor(
        driving: [[f32; 2]; POINTS],
        brake: f32,
        gearbox: Gearbox,
        model: &impl MachineUnits<Number = N>,
    ) -> Result<Self, AxisError> {
        let Gearbox {
            ratio,
            efficiency,
            rotor,
        } = gearbox.checked()?;
        within(
            "the inertia of the rotor",
            rotor,
            rotor == 0.0,
            "0 here, and i²·J_M part of the table",
        )?;
        let link = driving.map(|[omega, torque]| [omega / ratio, torque * ratio * efficiency]);
        Self::new(link, brake * ratio, model)
    }

    /// The speed of the last point.
    pub(super) const fn top(&self) -> N::Speed {
        self.top
    }

    /// The least and the greatest torque at a speed. At NaN both are 0.
    #[inline]
    pub fn torques(&self, omega: N::Speed) -> [N::Torque; 2] {
        let (rest, none) = (N::Speed::default(), N::Torque::default());
        let forward = omega >= rest;
        let magnitude = if forward { omega } else { omega.negated() };
        // The last line that begins at or below this speed: the speeds rise.
        let mut line = Fall::default();
        for fall in &self.falls {
            if magnitude >= fall.from {
                line = *fall;
            }
        }
        let lost = magnitude.minus(line.from).value.times(&line.slope).value;
        let mut driving = line.torque.minus(lost).value;
        if magnitude <= self.top {
            driving = driving.within(self.driving);
        } else {
            driving = none;
        }
        if omega > rest {
            [self.brake, driving]
        } else if omega < rest {
            [driving.negated(), self.brake.negated()]
        } else {
            [driving.negated(), driving]
        }
    }
}

/// A quantity in machine units, checked against their range; `value` and `base` are in SI units.
pub(super) fn in_range<Q: Quantity>(
    what: &'static str,
    value: f32,
    base: f32,
    found: Outcome<Q>,
) -> Result<Q, AxisError> {
    let finite = found.value.minus(found.value).value == Q::default();
    if !value.is_finite() {
        Err(AxisError::NotFinite(what))
    } else if found.saturated || !finite {
        Err(AxisError::BeyondBase { what, value, base })
    } else {
        Ok(found.value)
    }
}
