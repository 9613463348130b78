//! A lost contact in words, for a file that is refused and for answers.

use std::f64::consts::TAU;

use super::Separation;
use jred_file::model::coordinate::Coordinate;
use jred_file::number::rounding::figure;

const FORM: &str = "write closure = \"form\" for a grooved or conjugate cam, which guides the follower on both sides";

impl Separation {
    /// The contact that separates.
    pub fn what(&self) -> String {
        let joint = self.joint.as_deref();
        if self.rope {
            return format!("the {} goes slack", joint.unwrap_or("rope"));
        }
        let joint = joint.map_or_else(String::new, |name| format!("joint \"{name}\": "));
        format!("{joint}the follower leaves the cam")
    }

    /// Position and speed.
    pub fn state(&self) -> String {
        let Self { phi, omega, .. } = *self;
        match self.coordinate {
            Coordinate::Length => format!("{}, {} m/s", self.coordinate.place(phi), figure(omega)),
            Coordinate::Angle => {
                let degrees = if self.rope { phi } else { phi.rem_euclid(TAU) }.to_degrees();
                format!("φ = {degrees:.2}°, {} rpm", figure(omega * 60.0 / TAU))
            }
        }
    }

    /// The required force.
    pub fn required_force(&self) -> String {
        if self.rope {
            let push = figure(-self.force);
            return format!("it would have to push with {push} N, but a rope can only pull");
        }
        format!("the contact force would be {} N", figure(self.force))
    }

    /// How to keep the contact.
    pub fn cure(&self) -> String {
        match (self.coordinate, self.lift_off) {
            _ if self.rope => {
                "accelerate or brake more gently, or hang more weight on this rope".to_owned()
            }
            (Coordinate::Length, _) => {
                format!("use a stiffer spring, more preload or a slower motion; {FORM}")
            }
            (Coordinate::Angle, Some(limit)) => format!("at constant speed: {limit}; {FORM}"),
            (Coordinate::Angle, None) => format!(
                "at constant speed: the follower would not lift off: accelerate more gently, or add preload; {FORM}"
            ),
        }
    }
}
