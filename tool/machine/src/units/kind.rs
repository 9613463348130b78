//! Kinds of quantities: name, units and largest value.

use super::word::Dimension;

/// Kind of a quantity, with its units and range.
#[derive(Debug)]
pub struct Kind {
    /// With its article: "a length".
    pub name: &'static str,
    /// A typical value with its unit.
    pub example: &'static str,
    /// The unit to suggest.
    pub unit: &'static str,
    /// Units to choose from, for messages.
    pub units: &'static str,
    /// What its units must measure.
    pub dimension: Dimension,
    /// Whether the angle may be left out of the unit ("N m s" for "N m s/rad").
    pub angle_optional: bool,
    /// Larger values (SI) are refused as mistakes.
    pub largest: f64,
    /// If zero is not allowed, smaller values (SI) are not either.
    pub smallest: f64,
}

const fn kind(
    [name, example, unit, units]: [&'static str; 4],
    [length, mass, time, angle]: [i8; 4],
    [smallest, largest]: [f64; 2],
) -> Kind {
    Kind {
        name,
        example,
        unit,
        units,
        dimension: Dimension {
            length,
            mass,
            time,
            angle,
            current: 0,
            temperature: 0,
        },
        angle_optional: angle < 0,
        largest,
        smallest,
    }
}

/// The same with powers of A and K.
const fn electric(
    words: [&'static str; 4],
    mechanical: [i8; 4],
    [current, temperature]: [i8; 2],
    range: [f64; 2],
) -> Kind {
    let mut kind = kind(words, mechanical, range);
    kind.dimension.current = current;
    kind.dimension.temperature = temperature;
    kind
}

/// A length.
pub const LENGTH: Kind = kind(
    ["a length", "120 mm", "mm", "m, cm, mm, µm"],
    [1, 0, 0, 0],
    [1e-6, 1e3],
);
/// An altitude.
pub const ALTITUDE: Kind = kind(
    ["an altitude", "1400 m", "m", "m, km"],
    [1, 0, 0, 0],
    [1e-6, 1e5],
);
/// A mass.
pub const MASS: Kind = kind(
    ["a mass", "3.5 kg", "kg", "kg, g, t"],
    [0, 1, 0, 0],
    [1e-9, 1e6],
);
/// A moment of inertia.
pub const INERTIA: Kind = kind(
    [
        "a moment of inertia",
        "2.4 kg cm^2",
        "kg m^2",
        "kg m^2, kg cm^2, g mm^2",
    ],
    [2, 1, 0, 0],
    [1e-12, 1e8],
);
/// An angle.
pub const ANGLE: Kind = kind(
    ["an angle", "90 deg", "deg", "deg, rad"],
    [0, 0, 0, 1],
    [1e-9, 1e7],
);
/// An angular speed.
pub const ANGULAR_SPEED: Kind = kind(
    ["an angular speed", "1450 rpm", "rpm", "rpm, rad/s, deg/s"],
    [0, 0, -1, 1],
    [1e-6, 1e6],
);
/// An angular acceleration.
pub const ANGULAR_ACCELERATION: Kind = kind(
    [
        "an angular acceleration",
        "120 rad/s^2",
        "rad/s^2",
        "rad/s^2, deg/s^2",
    ],
    [0, 0, -2, 1],
    [1e-9, 1e9],
);
/// A speed.
pub const VELOCITY: Kind = kind(
    ["a speed", "0.2 m/s", "m/s", "m/s, mm/s"],
    [1, 0, -1, 0],
    [1e-9, 1e6],
);
/// A time.
pub const TIME: Kind = kind(
    ["a time", "0.25 s", "s", "s, ms"],
    [0, 0, 1, 0],
    [1e-6, 1e7],
);
/// A force.
pub const FORCE: Kind = kind(
    ["a force", "150 N", "N", "N, kN"],
    [1, 1, -2, 0],
    [1e-9, 1e10],
);
/// A torque.
pub const TORQUE: Kind = kind(
    ["a torque", "12 N m", "N m", "N m, kN m, mN m"],
    [2, 1, -2, 0],
    [1e-9, 1e10],
);
/// An acceleration.
pub const ACCELERATION: Kind = kind(
    ["an acceleration", "9.81 m/s^2", "m/s^2", "m/s^2, mm/s^2"],
    [1, 0, -2, 0],
    [1e-9, 1e6],
);
/// A viscous coefficient (force per speed).
pub const VISCOUS_FORCE: Kind = kind(
    [
        "a viscous coefficient (force per speed)",
        "30 N s/m",
        "N s/m",
        "N s/m, N s/mm",
    ],
    [0, 1, -1, 0],
    [1e-9, 1e10],
);
/// A viscous coefficient (moment per angular speed).
pub const VISCOUS_MOMENT: Kind = kind(
    [
        "a viscous coefficient (moment per angular speed)",
        "0.4 N m s/rad",
        "N m s/rad",
        "N m s/rad, N m/rpm",
    ],
    [2, 1, -1, -1],
    [1e-9, 1e10],
);
/// A stiffness (force per length).
pub const STIFFNESS: Kind = kind(
    [
        "a stiffness (force per length)",
        "12 N/mm",
        "N/mm",
        "N/m, N/mm, kN/m",
    ],
    [0, 1, -2, 0],
    [1e-9, 1e12],
);
/// A torsional stiffness (moment per angle).
pub const TORSION_STIFFNESS: Kind = kind(
    [
        "a torsional stiffness (moment per angle)",
        "15 N m/rad",
        "N m/rad",
        "N m/rad, N m/deg",
    ],
    [2, 1, -2, -1],
    [1e-9, 1e12],
);
/// A share.
pub const SHARE: Kind = kind(
    ["a share", "97 %", "%", "%, or a plain number such as 0.97"],
    [0, 0, 0, 0],
    [1e-6, 1e3],
);

/// A voltage.
pub const VOLTAGE: Kind = electric(
    ["a voltage", "560 V", "V", "V, kV, mV"],
    [2, 1, -3, 0],
    [-1, 0],
    [1e-6, 1e5],
);
/// A resistance.
pub const RESISTANCE: Kind = electric(
    ["a resistance", "47 Ohm", "Ohm", "Ohm, mOhm, kOhm"],
    [2, 1, -3, 0],
    [-2, 0],
    [1e-6, 1e6],
);
/// A capacitance.
pub const CAPACITANCE: Kind = electric(
    ["a capacitance", "470 uF", "uF", "F, mF, uF"],
    [-2, -1, 4, 0],
    [2, 0],
    [1e-9, 1e3],
);
/// A power.
pub const POWER: Kind = kind(
    ["a power", "200 W", "W", "W, kW"],
    [2, 1, -3, 0],
    [1e-6, 1e9],
);
/// An energy.
pub const ENERGY: Kind = kind(
    ["an energy", "2 kW s", "W s", "W s, kW s"],
    [2, 1, -2, 0],
    [1e-9, 1e12],
);
/// A temperature.
pub const TEMPERATURE: Kind = electric(
    ["a temperature", "40 degC", "degC", "degC"],
    [0, 0, 0, 0],
    [0, 1],
    [1e-9, 1e3],
);

/// s′ of a follower that slides.
pub const CAM_VELOCITY: Kind = kind(
    [
        "a velocity per angular speed of the cam",
        "12 mm/rad",
        "mm/rad",
        "mm/rad, mm/deg",
    ],
    [1, 0, 0, -1],
    [1e-9, 1e3],
);
/// s″ of a follower that slides.
pub const CAM_ACCELERATION: Kind = kind(
    [
        "an acceleration per squared angular speed of the cam",
        "-30 mm/rad^2",
        "mm/rad^2",
        "mm/rad^2, mm/deg^2",
    ],
    [1, 0, 0, -2],
    [1e-9, 1e6],
);
/// s″ of a follower that swings.
pub const CAM_TURNING: Kind = kind(
    [
        "an angular acceleration per squared angular speed of the cam",
        "-0.5 1/rad",
        "1/rad",
        "1/rad, 1/deg",
    ],
    [0, 0, 0, -1],
    [1e-9, 1e6],
);

/// J′ of a drive link that turns.
pub const INERTIA_SLOPE: Kind = kind(
    [
        "a moment of inertia per angle",
        "0.01 kg m^2/rad",
        "kg m^2/rad",
        "kg m^2/rad, kg cm^2/deg",
    ],
    [2, 1, 0, -1],
    [1e-12, 1e10],
);
/// m′ of one that slides.
pub const MASS_SLOPE: Kind = kind(
    ["a mass per length", "2 kg/m", "kg/m", "kg/m, kg/mm"],
    [-1, 1, 0, 0],
    [1e-12, 1e10],
);
/// Frequency at which smoothing halves an amplitude.
pub const CUTOFF: Kind = kind(
    ["a frequency", "40 Hz", "Hz", "Hz, kHz"],
    [0, 0, -1, 0],
    [1e-6, 1e6],
);

/// Kinds that no key uses but that users write.
const OTHERS: [(&str, [i8; 4]); 5] = [
    ("a frequency", [0, 0, -1, 0]),
    ("a speed", [1, 0, -1, 0]),
    ("an angular acceleration", [0, 0, -2, 1]),
    ("an area", [2, 0, 0, 0]),
    ("a mass times length", [1, 1, 0, 0]),
];

/// 1/s, which is not an angular speed.
pub const FREQUENCY: Dimension = dimension_of([0, 0, -1, 0]);

const fn dimension_of([length, mass, time, angle]: [i8; 4]) -> Dimension {
    Dimension {
        length,
        mass,
        time,
        angle,
        current: 0,
        temperature: 0,
    }
}

/// Name of a quantity of this dimension.
pub fn describe(found: Dimension) -> String {
    let kinds = [
        &LENGTH,
        &MASS,
        &INERTIA,
        &ANGLE,
        &ANGULAR_SPEED,
        &ANGULAR_ACCELERATION,
        &TIME,
        &FORCE,
        &TORQUE,
        &ACCELERATION,
        &VISCOUS_FORCE,
        &VISCOUS_MOMENT,
        &STIFFNESS,
        &TORSION_STIFFNESS,
    ];
    if found == SHARE.dimension {
        return "a plain number".to_owned();
    }
    let electric = [&VOLTAGE, &RESISTANCE, &CAPACITANCE, &POWER, &TEMPERATURE];
    if let Some(kind) = electric.iter().find(|k| k.dimension == found) {
        return kind.name.to_owned();
    }
    if let Some(kind) = kinds.iter().find(|k| k.dimension == found) {
        return kind.name.to_owned();
    }
    if let Some((name, _)) = OTHERS.iter().find(|(_, d)| dimension_of(*d) == found) {
        return (*name).to_owned();
    }
    let powers = [
        ("m", found.length),
        ("kg", found.mass),
        ("s", found.time),
        ("rad", found.angle),
        ("A", found.current),
        ("K", found.temperature),
    ];
    let text: Vec<String> = powers
        .iter()
        .filter(|(_, power)| *power != 0)
        .map(|(unit, power)| {
            if *power == 1 {
                (*unit).to_owned()
            } else {
                format!("{unit}^{power}")
            }
        })
        .collect();
    format!("a quantity in {}", text.join(" "))
}
