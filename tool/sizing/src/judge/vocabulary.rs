//! How the figures of a motor are shown: a linear motor has force for torque, m/s for speed and a mass for the inertia.

use crate::catalogue::MotorKind;
use jred_machine::model::rule::Rule;
use jred_machine::units::RPM;

/// Units and words of a motor's figures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Units {
    /// Unit of torque, or of force.
    pub torque: &'static str,
    /// Unit of speed.
    pub speed: &'static str,
    /// SI value of that unit; speeds are divided by it to be shown.
    pub speed_scale: f64,
    /// Unit of inertia, or of mass.
    pub inertia: &'static str,
    /// SI value of that unit.
    pub inertia_scale: f64,
    /// What is accelerated: `inertia` or `mass`.
    pub inertia_word: &'static str,
    /// What the motor makes: `torque` or `force`.
    pub torque_word: &'static str,
    /// What moves: `rotor` or `moving part`.
    pub rotor_word: &'static str,
    kind: MotorKind,
}

impl Units {
    /// The units of one kind of motor.
    pub const fn of(kind: MotorKind) -> Self {
        match kind {
            MotorKind::Rotary => Self {
                torque: "N m",
                speed: "rpm",
                speed_scale: RPM,
                inertia: "kg cm^2",
                inertia_scale: 1e-4,
                inertia_word: "inertia",
                torque_word: "torque",
                rotor_word: "rotor",
                kind,
            },
            MotorKind::Linear => Self {
                torque: "N",
                speed: "m/s",
                speed_scale: 1.0,
                inertia: "kg",
                inertia_scale: 1.0,
                inertia_word: "mass",
                torque_word: "force",
                rotor_word: "moving part",
                kind,
            },
        }
    }

    /// Unit that inertias of motors are shown in, and its SI value.
    pub const fn shown_inertia(&self) -> (&'static str, f64) {
        match self.kind {
            MotorKind::Rotary => ("kg cm^2", 1e-4),
            MotorKind::Linear => ("kg", 1.0),
        }
    }

    /// Label of a column of torques, such as `torque [N m]`.
    pub fn torque_label(&self) -> String {
        format!("{} [{}]", self.torque_word, self.torque)
    }

    /// Label of a column of speeds.
    pub fn speed_label(&self) -> String {
        format!("speed [{}]", self.speed)
    }

    /// Label of a column of inertias.
    pub fn inertia_label(&self) -> String {
        format!("{} [{}]", self.inertia_word, self.inertia)
    }

    /// The name of a rule as it reads for this kind of motor.
    pub const fn rule(&self, rule: Rule) -> &'static str {
        match (self.kind, rule) {
            (MotorKind::Linear, Rule::RmsTorque) => "RMS force",
            (MotorKind::Linear, Rule::PeakTorque) => "peak force",
            (MotorKind::Linear, Rule::HoldingTorque) => "holding force",
            (MotorKind::Linear, Rule::ConstantTorque) => "constant force",
            (MotorKind::Linear, Rule::BrakeTorque) => "brake force",
            (MotorKind::Linear, Rule::InertiaRatio) => "mass ratio",
            (_, rule) => rule.name(),
        }
    }

    /// A sentence about a turning motor as it reads for this kind: "torque" becomes "force".
    pub fn words(&self, text: &str) -> String {
        match self.kind {
            MotorKind::Rotary => text.to_owned(),
            MotorKind::Linear => {
                let words = [
                    ("torque", "force"),
                    ("Torque", "Force"),
                    ("rotor", "moving part"),
                    ("Rotor", "Moving part"),
                    ("inertia", "mass"),
                    ("Inertia", "Mass"),
                ];
                let replace = |text: String, (from, to): (&str, &str)| text.replace(from, to);
                words.into_iter().fold(text.to_owned(), replace)
            }
        }
    }

    /// The magnitude of a speed (rad/s or m/s) with its unit: whole revolutions per minute, three decimals of metres per second.
    pub fn speed(&self, speed: f64) -> String {
        let speed = speed.abs();
        match self.kind {
            MotorKind::Rotary => format!("{:.0} {}", speed / self.speed_scale, self.speed),
            MotorKind::Linear => format!("{speed:.3} {}", self.speed),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_linear_motor_has_force_and_metres_per_second() {
        let linear = Units::of(MotorKind::Linear);
        assert_eq!(linear.rule(Rule::PeakTorque), "peak force");
        assert_eq!(linear.rule(Rule::Speed), Rule::Speed.name());
        assert_eq!(linear.words("peak torque"), "peak force");
        assert_eq!(
            linear.words("Inertia of the rotor"),
            "Mass of the moving part"
        );
        assert_eq!(linear.speed(1.25), "1.250 m/s");
        let rotary = Units::of(MotorKind::Rotary);
        assert_eq!(rotary.rule(Rule::PeakTorque), Rule::PeakTorque.name());
        assert_eq!(rotary.speed(100.0 * RPM), "100 rpm");
    }
}
