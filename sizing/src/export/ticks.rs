//! An image ticked as firmware does it, against the exact machine.

use jred::table::Layout;
use jred::{Error, Image, ImageError, Model, Scalar, TableError};

use super::reference::{Place, Reference};

/// The largest errors of the tick itself, at the corners of the range of speed and acceleration: quantised curves, the
/// roundings of the sum and of the quotient, all of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ticks {
    /// Of the torque (N·m, or N).
    pub torque: f64,
    /// Where it is (rad, or m).
    pub worst: f64,
    /// Of the acceleration that such a torque gives (rad/s², or m/s²), where it fits the number range.
    pub acceleration: f64,
    /// The largest torque (N·m, or N).
    pub peak_torque: f64,
}

/// Loads an image with its set of curves, which is a type, and ticks it at every place of the reference.
pub(super) fn measure<S: Scalar, L: Layout>(
    image: &Image<'_>,
    reference: &Reference,
    range: [f64; 2],
) -> Result<Ticks, Error> {
    macro_rules! sets {
        ($($set:literal)*) => {
            match image.curves() {
                $($set => {
                    let model = image.model::<S, $set, L>().map_err(refusal)?;
                    Ok(run(&model, image, reference, range))
                })*
                set => Err(Error::Table(TableError::Curves(set))),
            }
        };
    }
    // Load; viscous as a curve (2) or a constant (16); Coulomb as a curve (4) or a constant (32); reciprocal (8).
    sets!(
        0 1 2 3 4 5 6 7 16 17 20 21 32 33 34 35 48 49
        8 9 10 11 12 13 14 15 24 25 28 29 40 41 42 43 56 57
    )
}

pub(super) fn refusal(error: ImageError) -> Error {
    match error {
        ImageError::Table(error) => Error::Table(error),
        // Cannot happen: the image was just made, of this type and layout.
        _ => Error::NoImage("this type and layout"),
    }
}

fn run<S: Scalar, const CURVES: u8, L: Layout>(
    model: &Model<'_, S, CURVES, L>,
    image: &Image<'_>,
    reference: &Reference,
    [omega, alpha]: [f64; 2],
) -> Ticks {
    let scale = image.scale();
    let [torque, speed, acceleration] =
        [scale.torque(), scale.speed(), scale.acceleration()].map(f64::from);
    // The arguments as the number type holds them: their own rounding is not an error of the table.
    let number = |value: f64| S::from_f64(value).unwrap_or_default();
    let corners = [(omega, alpha), (omega, -alpha), (-omega, alpha), (-omega, -alpha)]
        .map(|(omega, alpha)| (number(omega / speed), number(alpha / acceleration)));
    let mut worst = Ticks::default();
    for Place { phase, phi, exact } in &reference.places {
        for (omega, alpha) in corners {
            let [at_speed, at_acceleration] =
                [omega.to_f64() * speed, alpha.to_f64() * acceleration];
            let expected = exact.torque(at_speed, at_acceleration).total();
            let found = model.torque(*phase, omega, alpha).to_f64() * torque;
            let error = (found - expected).abs();
            if error > worst.torque {
                worst.torque = error;
                worst.worst = *phi;
            }
            worst.peak_torque = worst.peak_torque.max(expected.abs());
            let drive = number(expected / torque);
            let back = model.acceleration(*phase, omega, drive);
            if !back.saturated {
                let expected = exact.acceleration(at_speed, drive.to_f64() * torque);
                let error = (back.value.to_f64() * acceleration - expected).abs();
                worst.acceleration = worst.acceleration.max(error);
            }
        }
    }
    worst
}
