//! The numbers of kernels: from SI to words and back.

use std::f64::consts::TAU;

use jred::Scale;

use crate::kernels::Quantity;

/// Kind of the arguments and the result of a kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Number {
    /// Single precision, SI; the angle in rad.
    Radians,
    /// Single precision, SI; the angle as a binary fraction of a turn.
    PhaseF32,
    /// Fixed point with 31 fraction bits, per-unit; the angle as a binary fraction of a turn.
    PhaseQ31,
    /// Fixed point with 15 fraction bits, per-unit; the angle as a binary fraction of a turn.
    PhaseQ15,
}

/// One turn as a binary angle.
const TURN: f64 = 4_294_967_296.0;

impl Number {
    /// Angle (turns), speed and acceleration or torque (SI) as words.
    pub(crate) fn encode(
        self,
        scale: &Scale,
        of: Quantity,
        [turn, omega, third]: [f64; 3],
    ) -> [u32; 3] {
        let angle = match self {
            Self::Radians => ((turn * TAU) as f32).to_bits(),
            _ => (turn * TURN) as u32,
        };
        let argument = match of {
            Quantity::Torque => acceleration_base(scale),
            Quantity::Acceleration => f64::from(scale.torque()),
        };
        [
            angle,
            self.word(omega, f64::from(scale.speed())),
            self.word(third, argument),
        ]
    }

    /// The arguments in the words, in SI, the angle in rad: the input of the reference.
    pub(crate) fn decode(
        self,
        scale: &Scale,
        of: Quantity,
        [angle, omega, third]: [u32; 3],
    ) -> [f64; 3] {
        let phi = match self {
            Self::Radians => f64::from(f32::from_bits(angle)),
            _ => f64::from(angle) / TURN * TAU,
        };
        let argument = match of {
            Quantity::Torque => acceleration_base(scale),
            Quantity::Acceleration => f64::from(scale.torque()),
        };
        [
            phi,
            self.value(omega, f64::from(scale.speed())),
            self.value(third, argument),
        ]
    }

    /// The result in a word (SI).
    pub(crate) fn result(self, scale: &Scale, of: Quantity, word: u32) -> f64 {
        let base = match of {
            Quantity::Torque => f64::from(scale.torque()),
            Quantity::Acceleration => acceleration_base(scale),
        };
        self.value(word, base)
    }

    /// A number as a word; fixed point rounds to the nearest and limits.
    pub(crate) fn word(self, value: f64, base: f64) -> u32 {
        match self {
            Self::Radians | Self::PhaseF32 => (value as f32).to_bits(),
            Self::PhaseQ31 => ((value / base * 2.0f64.powi(31)).round() as i32).cast_unsigned(),
            Self::PhaseQ15 => {
                i32::from((value / base * 2.0f64.powi(15)).round() as i16).cast_unsigned()
            }
        }
    }

    fn value(self, word: u32, base: f64) -> f64 {
        let signed = f64::from(word.cast_signed());
        match self {
            Self::Radians | Self::PhaseF32 => f64::from(f32::from_bits(word)),
            Self::PhaseQ31 => signed / 2.0f64.powi(31) * base,
            Self::PhaseQ15 => signed / 2.0f64.powi(15) * base,
        }
    }
}

/// T_b/J_b (rad/s²).
pub(crate) fn acceleration_base(scale: &Scale) -> f64 {
    f64::from(scale.torque()) / f64::from(scale.inertia())
}

#[cfg(test)]
mod tests {
    use super::*;
    use jred::number::Bases;

    #[test]
    fn what_is_encoded_is_decoded() {
        let scale = Scale::new(Bases {
            torque: 40.0,
            speed: 70.0,
            inertia: 0.006,
        })
        .unwrap();
        for (number, step) in [
            (Number::Radians, 1e-6),
            (Number::PhaseF32, 1e-6),
            (Number::PhaseQ31, 1e-8),
            (Number::PhaseQ15, 1e-4),
        ] {
            for of in [Quantity::Torque, Quantity::Acceleration] {
                let words = number.encode(&scale, of, [0.75, -35.0, 10.0]);
                let [phi, omega, third] = number.decode(&scale, of, words);
                assert!((phi - 0.75 * TAU).abs() < 1e-6);
                assert!((omega + 35.0).abs() < 70.0 * step, "{omega}");
                assert!(
                    (third - 10.0).abs() < acceleration_base(&scale) * step,
                    "{third}"
                );
                let other = if of == Quantity::Torque {
                    Quantity::Acceleration
                } else {
                    Quantity::Torque
                };
                assert_eq!(
                    number.result(&scale, other, words[2]).to_bits(),
                    third.to_bits()
                );
            }
        }
    }
}
