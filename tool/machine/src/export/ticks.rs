//! An image ticked as firmware does it, against the exact machine.

use jred::table::Layout;
use jred::{Error, Image, ImageError, Number, Outcome, Phase, Scalar, Scale, TableError};

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

/// Loads an image with its set of curves, which is a type.
macro_rules! for_set {
    ($image:expr, $run:ident) => {
        for_set!(
            $image, $run,
            // Load; viscous as a curve (2) or a constant (16); Coulomb as a curve (4) or a constant (32); reciprocal (8).
            0 1 2 3 4 5 6 7 16 17 20 21 32 33 34 35 48 49
            8 9 10 11 12 13 14 15 24 25 28 29 40 41 42 43 56 57
        )
    };
    ($image:expr, $run:ident, $($set:literal)*) => {
        match $image.curves() {
            $($set => $run!($set),)*
            set => Err(Error::Table(TableError::Curves(set))),
        }
    };
}

/// Ticks an image at every place of the reference.
pub(super) fn measure<S: Scalar, L: Layout>(
    image: &Image<'_>,
    reference: &Reference,
    range: [f64; 2],
) -> Result<Ticks, Error> {
    macro_rules! run {
        ($set:literal) => {{
            let model = image.model::<S, $set, L>().map_err(refusal)?;
            Ok(run(
                image.scale(),
                reference,
                range,
                |phase, omega, alpha| model.torque(phase, omega, alpha),
                |phase, omega, torque| model.acceleration(phase, omega, torque),
            ))
        }};
    }
    for_set!(image, run)
}

/// As [`measure`], of 16-bit rows.
pub(super) fn measure_short(
    image: &Image<'_>,
    reference: &Reference,
    range: [f64; 2],
) -> Result<Ticks, Error> {
    macro_rules! run {
        ($set:literal) => {{
            let model = image.short_model::<$set>().map_err(refusal)?;
            Ok(run(
                image.scale(),
                reference,
                range,
                |phase, omega, alpha| model.torque(phase, omega, alpha),
                |phase, omega, torque| model.acceleration(phase, omega, torque),
            ))
        }};
    }
    for_set!(image, run)
}

pub(super) fn refusal(error: ImageError) -> Error {
    match error {
        ImageError::Table(error) => Error::Table(error),
        // Cannot happen: the image was just made, of this type and layout.
        _ => Error::NoImage("this type and layout"),
    }
}

fn run<N: Number>(
    scale: &Scale,
    reference: &Reference,
    [omega, alpha]: [f64; 2],
    torque: impl Fn(Phase, N, N) -> N,
    acceleration: impl Fn(Phase, N, N) -> Outcome<N>,
) -> Ticks {
    let [torque_base, speed_base, acceleration_base] =
        [scale.torque(), scale.speed(), scale.acceleration()].map(f64::from);
    let (number, value) = (
        |value: f64| N::from_f64(value).unwrap_or_default(),
        N::to_f64,
    );
    // The arguments as the number type holds them: their own rounding is not an error of the table.
    let corners = [
        (omega, alpha),
        (omega, -alpha),
        (-omega, alpha),
        (-omega, -alpha),
    ];
    let corners = corners.map(|(omega, alpha)| {
        (
            number(omega / speed_base),
            number(alpha / acceleration_base),
        )
    });
    let mut worst = Ticks::default();
    for Place { phase, phi, exact } in &reference.places {
        for (omega, alpha) in corners {
            let speed = value(omega) * speed_base;
            let expected = exact
                .torque(speed, value(alpha) * acceleration_base)
                .total();
            let found = value(torque(*phase, omega, alpha)) * torque_base;
            let error = (found - expected).abs();
            if error > worst.torque {
                worst.torque = error;
                worst.worst = *phi;
            }
            worst.peak_torque = worst.peak_torque.max(expected.abs());
            let drive = number(expected / torque_base);
            let back = acceleration(*phase, omega, drive);
            if !back.saturated {
                let expected = exact.acceleration(speed, value(drive) * torque_base);
                let error = (value(back.value) * acceleration_base - expected).abs();
                worst.acceleration = worst.acceleration.max(error);
            }
        }
    }
    worst
}
