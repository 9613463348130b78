//! Words and units for the figures of a motor: a linear motor has force for torque, m/s for speed, and a mass for the inertia.
//!
//! Messages insert the words: `format!("peak {}", words.torque)`.

use std::borrow::Cow;
use std::fmt;

use super::RPM;

/// A quantity of one kind of motor; it is displayed as its word.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Term {
    /// Its name, for example `torque`.
    pub word: &'static str,
    /// The unit in which it is shown.
    pub unit: &'static str,
    /// SI value of that unit; shown figures are divided by it.
    pub scale: f64,
}

impl Term {
    /// Heading of a column, for example `torque [N m]`.
    pub fn label(&self) -> String {
        format!("{} [{}]", self.word, self.unit)
    }

    /// The word at the beginning of a sentence.
    pub fn capital(&self) -> String {
        let (first, rest) = self.word.split_at_checked(1).unwrap_or((self.word, ""));
        first.to_uppercase() + rest
    }
}

impl fmt::Display for Term {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.word)
    }
}

/// Words and units of one kind of motor.
#[derive(Debug, PartialEq)]
pub struct Vocabulary {
    /// Its effort: torque or force.
    pub torque: Term,
    /// Its speed.
    pub speed: Term,
    /// Its inertia: inertia or mass.
    pub inertia: Term,
    /// The moving part: `rotor` or `moving part`.
    pub rotor: &'static str,
    /// SI unit of its speed.
    pub speed_si: &'static str,
    /// Decimals of a speed in messages.
    decimals: usize,
    slides: bool,
}

/// A sentence for a kind of motor.
pub type Sentence = fn(&Vocabulary) -> String;

const fn term(word: &'static str, unit: &'static str, scale: f64) -> Term {
    Term { word, unit, scale }
}

impl Vocabulary {
    /// A text about a torque in the words of this kind of motor.
    pub fn effort_in(&self, text: &'static str) -> Cow<'static, str> {
        if self.slides {
            Cow::Owned(text.replace(Self::ROTARY.torque.word, self.torque.word))
        } else {
            Cow::Borrowed(text)
        }
    }

    /// For motors that turn.
    pub const ROTARY: Self = Self {
        torque: term("torque", "N m", 1.0),
        speed: term("speed", "rpm", RPM),
        inertia: term("inertia", "kg cm^2", 1e-4),
        rotor: "rotor",
        speed_si: "rad/s",
        decimals: 0,
        slides: false,
    };

    /// For motors that slide.
    pub const LINEAR: Self = Self {
        torque: term("force", "N", 1.0),
        speed: term("speed", "m/s", 1.0),
        inertia: term("mass", "kg", 1.0),
        rotor: "moving part",
        speed_si: "m/s",
        decimals: 3,
        slides: true,
    };

    /// Whether these words are for motors that slide.
    pub const fn slides(&self) -> bool {
        self.slides
    }

    /// The magnitude of a speed (rad/s or m/s) with its unit: whole revolutions per minute, or three decimals of metres per second.
    pub fn speed(&self, speed: f64) -> String {
        let (places, shown) = (self.decimals, speed.abs() / self.speed.scale);
        format!("{shown:.places$} {}", self.speed.unit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_linear_motor_has_force_and_metres_per_second() {
        let linear = &Vocabulary::LINEAR;
        assert_eq!(format!("peak {}", linear.torque), "peak force");
        assert_eq!(linear.torque.label(), "force [N]");
        assert_eq!(linear.inertia.capital(), "Mass");
        assert_eq!(linear.speed(-1.25), "1.250 m/s");
        let rotary = &Vocabulary::ROTARY;
        assert_eq!(format!("peak {}", rotary.torque), "peak torque");
        assert_eq!(rotary.speed(100.0 * RPM), "100 rpm");
    }
}
