//! An image ticked like firmware does, against the exact machine.

use jred::error::Error;
use jred::number::{Number as _, Quantity};
use jred::table::{AccelerationOf, Format, SpeedOf, TorqueOf};
use jred::{Image, ImageError};

use crate::reference::{Reference, ReferencePoint};

/// The largest total errors of the tick, at the corners of the range of speed and acceleration: quantised curves, rounding of the sum and of the
/// quotient.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ticks {
    /// Error of the torque (N·m, or N).
    pub torque: f64,
    /// Position of this error (rad, or m).
    pub worst: f64,
    /// Error of the acceleration (rad/s², or m/s²), where it is within the number range.
    pub acceleration: f64,
    /// The largest torque (N·m, or N).
    pub peak_torque: f64,
}

impl Ticks {
    /// The larger of the errors of two tables, each with its position.
    pub(crate) fn or_worse(self, other: Self) -> Self {
        let worse = if other.torque > self.torque {
            other
        } else {
            self
        };
        Self {
            acceleration: self.acceleration.max(other.acceleration),
            peak_torque: self.peak_torque.max(other.peak_torque),
            ..worse
        }
    }
}

/// Ticks an image at every place of the reference.
pub(crate) fn measure<F: Format>(
    image: &Image<'_>,
    reference: &Reference,
    [omega, alpha]: [f64; 2],
) -> Result<Ticks, Error> {
    let model = image.any_model::<F>().map_err(refusal)?;
    let scale = image.scale();
    let [torque_base, speed_base, acceleration_base] =
        [scale.torque(), scale.speed(), scale.acceleration()].map(f64::from);
    // The arguments as numbers of the type: their own rounding is not an error of the table.
    let corners = [
        (omega, alpha),
        (omega, -alpha),
        (-omega, alpha),
        (-omega, -alpha),
    ];
    let corners = corners.map(|(omega, alpha)| {
        (
            number::<SpeedOf<F>>(omega / speed_base),
            number::<AccelerationOf<F>>(alpha / acceleration_base),
        )
    });
    let mut worst = Ticks::default();
    for ReferencePoint { phase, phi, exact } in &reference.places {
        for (omega, alpha) in corners {
            let speed = value(omega) * speed_base;
            let expected = exact
                .torque(speed, value(alpha) * acceleration_base)
                .total();
            let found = value(model.torque(*phase, omega, alpha)) * torque_base;
            let error = (found - expected).abs();
            if error > worst.torque {
                worst.torque = error;
                worst.worst = *phi;
            }
            worst.peak_torque = worst.peak_torque.max(expected.abs());
            let drive = number::<TorqueOf<F>>(expected / torque_base);
            let back = model.acceleration(*phase, omega, drive);
            if !back.saturated {
                let expected = exact.acceleration(speed, value(drive) * torque_base);
                let error = (value(back.value) * acceleration_base - expected).abs();
                worst.acceleration = worst.acceleration.max(error);
            }
        }
    }
    Ok(worst)
}

/// The nearest number in machine units; 0 if it is out of range.
fn number<Q: Quantity>(value: f64) -> Q {
    Q::Number::from_f64(value).map(Q::of).unwrap_or_default()
}

fn value<Q: Quantity>(quantity: Q) -> f64 {
    quantity.number().to_f64()
}

pub(crate) fn refusal(error: ImageError) -> Error {
    match error {
        ImageError::Table(error) => Error::Table(error),
        // Cannot happen: the image was just made with this type and layout.
        _ => Error::Image(ImageError::NotStored("this type and layout")),
    }
}
