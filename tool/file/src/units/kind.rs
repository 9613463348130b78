//! Kinds of quantities: name, units and range.

use super::quantity;
use super::word::{Dimension, dimension};

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
    /// Dimension of its units.
    pub dimension: Dimension,
    /// Larger values (SI) are refused as mistakes.
    pub largest: f64,
    /// Smaller values (SI) are refused if zero is not allowed.
    pub smallest: f64,
}

impl Kind {
    /// The value (SI) of a quantity in the source code, or of a zero without a unit; NaN for any other text.
    pub(crate) fn value_of(&self, text: &str) -> f64 {
        match text {
            "0" => 0.0,
            text => quantity::read(text, self).map_or(f64::NAN, |quantity| quantity.si),
        }
    }

    /// Whether a unit of the dimension `found` measures this kind. The angle below the "/" is optional: "N m s" for "N m s/rad".
    pub fn is_measured_by(&self, found: Dimension) -> bool {
        found == self.dimension
            || self.dimension.angle < 0
                && found
                    == Dimension {
                        angle: 0,
                        ..self.dimension
                    }
    }
}

macro_rules! kinds {
    ($named:tt: $($kind:ident $name:literal $example:literal $unit:literal $units:literal $smallest:literal $largest:literal;)*) => {
        $(
            #[doc = concat!($name, ", such as \"", $example, "\"")]
            pub const $kind: Kind = Kind {
                name: $name,
                example: $example,
                unit: $unit,
                units: $units,
                dimension: dimension($unit),
                largest: $largest,
                smallest: $smallest,
            };
        )*

        const $named: &[&Kind] = &[$(&$kind,)*];
    };
}

// Name, example, unit to suggest, units to choose from, smallest and largest value (SI).
kinds! {
    NAMED:
    LENGTH "a length" "120 mm" "mm" "m, cm, mm, µm" 1e-6 1e3;
    ALTITUDE "an altitude" "1400 m" "m" "m, km" 1e-6 1e5;
    MASS "a mass" "3.5 kg" "kg" "kg, g, t" 1e-9 1e6;
    INERTIA "a moment of inertia" "2.4 kg cm^2" "kg m^2" "kg m^2, kg cm^2, g mm^2, lbf in s^2" 1e-12 1e8;
    ANGLE "an angle" "90 deg" "deg" "deg, rad, arcmin" 1e-9 1e7;
    ANGULAR_SPEED "an angular speed" "1450 rpm" "rpm" "rpm, rad/s, deg/s" 1e-6 1e6;
    ANGULAR_ACCELERATION "an angular acceleration" "120 rad/s^2" "rad/s^2" "rad/s^2, deg/s^2" 1e-9 1e9;
    VELOCITY "a speed" "0.2 m/s" "m/s" "m/s, mm/s" 1e-9 1e6;
    TIME "a time" "0.25 s" "s" "s, ms" 1e-6 1e7;
    FORCE "a force" "150 N" "N" "N, kN" 1e-9 1e10;
    TORQUE "a torque" "12 N m" "N m" "N m, kN m, mN m" 1e-9 1e10;
    ACCELERATION "an acceleration" "9.81 m/s^2" "m/s^2" "m/s^2, mm/s^2" 1e-9 1e6;
    JERK "a jerk" "50 m/s^3" "m/s^3" "m/s^3, mm/s^3" 1e-9 1e12;
    ANGULAR_JERK "an angular jerk" "2000 rad/s^3" "rad/s^3" "rad/s^3, deg/s^3" 1e-9 1e12;
    VISCOUS_FORCE "a viscous coefficient (force per speed)" "30 N s/m" "N s/m" "N s/m, N s/mm" 1e-9 1e10;
    VISCOUS_MOMENT "a viscous coefficient (moment per angular speed)" "0.4 N m s/rad" "N m s/rad" "N m s/rad, N m/rpm" 1e-9 1e10;
    STIFFNESS "a stiffness (force per length)" "12 N/mm" "N/mm" "N/m, N/mm, kN/m" 1e-9 1e12;
    TORSION_STIFFNESS "a torsional stiffness (moment per angle)" "15 N m/rad" "N m/rad" "N m/rad, N m/deg, N m/arcmin" 1e-9 1e12;
    SHARE "a share" "97 %" "%" "%, or a plain number such as 0.97" 1e-6 1e3;
    VOLTAGE "a voltage" "560 V" "V" "V, kV, mV" 1e-6 1e5;
    RESISTANCE "a resistance" "47 Ohm" "Ohm" "Ohm, mOhm, kOhm" 1e-6 1e6;
    CAPACITANCE "a capacitance" "470 uF" "uF" "F, mF, uF" 1e-9 1e3;
    POWER "a power" "200 W" "W" "W, kW" 1e-6 1e9;
    ENERGY "an energy" "2 kW s" "W s" "W s, kW s" 1e-9 1e12;
    TEMPERATURE "a temperature" "40 degC" "degC" "degC, degF" 1e-9 1e3;
    INERTIA_SLOPE "a moment of inertia per angle" "0.01 kg m^2/rad" "kg m^2/rad" "kg m^2/rad, kg cm^2/deg" 1e-12 1e10;
    DENSITY "a density" "7850 kg/m^3" "kg/m^3" "kg/m^3, kg/dm^3, g/cm^3" 1e-3 1e6;
    MASS_SLOPE "a mass per length" "2 kg/m" "kg/m" "kg/m, kg/mm" 1e-12 1e10;
    CURRENT "a current" "5.2 A" "A" "A, A rms, A peak, mA" 1e-9 1e6;
    INDUCTANCE "an inductance" "6.5 mH" "mH" "H, mH, uH" 1e-9 1e3;
    TORQUE_CONSTANT "a torque per current" "1.2 N m/A" "N m/A" "N m/A, N m/A peak, mN m/A" 1e-9 1e6;
    FORCE_CONSTANT "a force per current" "60 N/A" "N/A" "N/A, N/A peak" 1e-9 1e6;
    VOLTAGE_CONSTANT "a voltage per angular speed" "0.9 V s/rad" "V s/rad" "V s/rad, V/krpm, mV/rpm" 1e-9 1e6;
    LINEAR_VOLTAGE_CONSTANT "a voltage per speed" "35 V s/m" "V s/m" "V s/m" 1e-9 1e6;
    THERMAL_RESISTANCE "a thermal resistance" "0.4 K/W" "K/W" "K/W" 1e-9 1e6;
    LOSS "a power per current" "8 W/A" "W/A" "W/A" 1e-9 1e6;
    CUTOFF "a frequency" "40 Hz" "Hz" "Hz, kHz" 1e-6 1e6;
    GAIN "a gain (speed per distance)" "20 1/s" "1/s" "1/s" 1e-6 1e6;
}

// Kinds for cams with a translating or an oscillating follower, and rates of a drive's torque. Elsewhere a quantity of the same dimension has another
// name or none.
kinds! {
    _:
    CAM_VELOCITY "a velocity per angular speed of the cam" "12 mm/rad" "mm/rad" "mm/rad, mm/deg" 1e-9 1e3;
    CAM_ACCELERATION "an acceleration per squared angular speed of the cam" "-30 mm/rad^2" "mm/rad^2" "mm/rad^2, mm/deg^2" 1e-9 1e6;
    TORQUE_RATE "a torque per time" "500 N m/s" "N m/s" "N m/s, kN m/s" 1e-9 1e12;
    FORCE_RATE "a force per time" "5 kN/s" "N/s" "N/s, kN/s" 1e-9 1e12;
    CAM_TURNING "an angular acceleration per squared angular speed of the cam" "-0.5 1/rad" "1/rad" "1/rad, 1/deg" 1e-9 1e6;
}

/// Names of quantities that users write but no key accepts.
const OTHERS: [(&str, Dimension); 3] = [
    ("an area", dimension("m^2")),
    ("a pressure", dimension("N/m^2")),
    ("a mass times length", dimension("kg m")),
];

/// Name of a quantity of this dimension.
pub fn describe(found: Dimension) -> String {
    if found == SHARE.dimension {
        return "a plain number".to_owned();
    }
    let kinds = NAMED.iter().map(|kind| (kind.name, kind.dimension));
    let mut known = kinds.chain(OTHERS);
    if let Some((name, _)) = known.find(|(_, dimension)| *dimension == found) {
        return name.to_owned();
    }
    let powers = [
        ("m", found.length),
        ("kg", found.mass),
        ("s", found.time),
        ("rad", found.angle),
        ("A", found.current),
        ("K", found.temperature),
    ];
    let given = powers.into_iter().filter(|(_, power)| *power != 0);
    let text: Vec<String> = given
        .map(|(unit, power)| match power {
            1 => unit.to_owned(),
            _ => format!("{unit}^{power}"),
        })
        .collect();
    format!("a quantity in {}", text.join(" "))
}
