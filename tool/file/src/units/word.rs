//! The words of units, and their SI values.
//!
//! Here an angle has a dimension of its own, so that "rad" differs from a plain number and "rpm" from "Hz".

use std::f64::consts::{SQRT_2, TAU};

use super::{ARCMIN, DEGREE, RPM};

/// Powers of m, kg, s, of the angle, of A and K.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dimension {
    /// Power of m.
    pub length: i8,
    /// Power of kg.
    pub mass: i8,
    /// Power of s.
    pub time: i8,
    /// Power of an angle.
    pub angle: i8,
    /// Power of A.
    pub current: i8,
    /// Power of K.
    pub temperature: i8,
}

impl Dimension {
    /// This dimension times a power of another one.
    pub(super) const fn times(self, other: Self, power: i8) -> Self {
        const fn sum(one: i8, other: i8, power: i8) -> i8 {
            one.saturating_add(other.saturating_mul(power))
        }
        Self {
            length: sum(self.length, other.length, power),
            mass: sum(self.mass, other.mass, power),
            time: sum(self.time, other.time, power),
            angle: sum(self.angle, other.angle, power),
            current: sum(self.current, other.current, power),
            temperature: sum(self.temperature, other.temperature, power),
        }
    }
}

/// A unit word: its SI value is 10^`tens` · `size`.
pub(super) struct Word {
    pub(super) text: &'static str,
    tens: i32,
    size: f64,
    pub(super) dimension: Dimension,
}

/// A word whose size is a power of ten.
const fn ten(text: &'static str, tens: i32, dimension: Dimension) -> Word {
    Word {
        text,
        tens,
        size: 1.0,
        dimension,
    }
}

/// A word of another size.
const fn sized(text: &'static str, size: f64, dimension: Dimension) -> Word {
    Word {
        text,
        tens: 0,
        size,
        dimension,
    }
}

/// Powers of m, kg, s, of the angle, of A and K.
const fn powers([length, mass, time, angle, current, temperature]: [i8; 6]) -> Dimension {
    Dimension {
        length,
        mass,
        time,
        angle,
        current,
        temperature,
    }
}

const LENGTH: Dimension = powers([1, 0, 0, 0, 0, 0]);
const MASS: Dimension = powers([0, 1, 0, 0, 0, 0]);
const TIME: Dimension = powers([0, 0, 1, 0, 0, 0]);
const FORCE: Dimension = powers([1, 1, -2, 0, 0, 0]);
const TORQUE: Dimension = powers([2, 1, -2, 0, 0, 0]);
const PRESSURE: Dimension = powers([-1, 1, -2, 0, 0, 0]);
const ANGLE: Dimension = powers([0, 0, 0, 1, 0, 0]);
const ANGULAR_SPEED: Dimension = powers([0, 0, -1, 1, 0, 0]);
const FREQUENCY: Dimension = powers([0, 0, -1, 0, 0, 0]);
const POWER: Dimension = powers([2, 1, -3, 0, 0, 0]);
const NUMBER: Dimension = powers([0; 6]);
const VOLTAGE: Dimension = powers([2, 1, -3, 0, -1, 0]);
const CURRENT: Dimension = powers([0, 0, 0, 0, 1, 0]);
const RESISTANCE: Dimension = powers([2, 1, -3, 0, -2, 0]);
const CAPACITANCE: Dimension = powers([-2, -1, 4, 0, 2, 0]);
const INDUCTANCE: Dimension = powers([2, 1, -2, 0, -2, 0]);
const TEMPERATURE: Dimension = powers([0, 0, 0, 0, 0, 1]);

/// All unit words: those of machine files, then those of data sheets only, then those that are only converted. A degree Celsius is as large as a
/// kelvin; the zero of the scale is left to the reader of a temperature. An alternating current is given as its RMS value or its peak. A horsepower
/// "hp" is the mechanical one, 550 ft·lbf/s; "PS" is the metric one, 75 kgf·m/s. The pound "lb" and the ounce "oz" are masses; a
/// [`Unit`](super::unit::Unit) can take them as forces.
pub(super) const EVERY: &[Word] = &[
    ten("mm", -3, LENGTH),
    ten("m", 0, LENGTH),
    ten("km", 3, LENGTH),
    ten("dm", -1, LENGTH),
    ten("cm", -2, LENGTH),
    ten("um", -6, LENGTH),
    ten("kg", 0, MASS),
    ten("g", -3, MASS),
    ten("mg", -6, MASS),
    ten("t", 3, MASS),
    ten("s", 0, TIME),
    ten("ms", -3, TIME),
    ten("us", -6, TIME),
    ten("ns", -9, TIME),
    ten("N", 0, FORCE),
    ten("kN", 3, FORCE),
    ten("MN", 6, FORCE),
    ten("mN", -3, FORCE),
    ten("Nm", 0, TORQUE),
    ten("kNm", 3, TORQUE),
    ten("MNm", 6, TORQUE),
    ten("mNm", -3, TORQUE),
    ten("rad", 0, ANGLE),
    ten("mrad", -3, ANGLE),
    sized("deg", DEGREE, ANGLE),
    sized("degree", DEGREE, ANGLE),
    sized("arcmin", ARCMIN, ANGLE),
    sized("rpm", RPM, ANGULAR_SPEED),
    ten("Hz", 0, FREQUENCY),
    ten("kHz", 3, FREQUENCY),
    ten("W", 0, POWER),
    ten("kW", 3, POWER),
    ten("%", -2, NUMBER),
    ten("V", 0, VOLTAGE),
    ten("mV", -3, VOLTAGE),
    ten("kV", 3, VOLTAGE),
    ten("A", 0, CURRENT),
    ten("mA", -3, CURRENT),
    ten("Ohm", 0, RESISTANCE),
    ten("mOhm", -3, RESISTANCE),
    ten("kOhm", 3, RESISTANCE),
    ten("F", 0, CAPACITANCE),
    ten("mF", -3, CAPACITANCE),
    ten("uF", -6, CAPACITANCE),
    ten("H", 0, INDUCTANCE),
    ten("mH", -3, INDUCTANCE),
    ten("uH", -6, INDUCTANCE),
    ten("K", 0, TEMPERATURE),
    ten("degC", 0, TEMPERATURE),
    ten("C", 0, TEMPERATURE),
    sized("min", 60.0, TIME),
    sized("turn", TAU, ANGLE),
    sized("rev", TAU, ANGLE),
    sized("hp", HORSEPOWER, POWER),
    sized("HP", HORSEPOWER, POWER),
    sized("PS", 735.498_75, POWER),
    sized("in", INCH, LENGTH),
    sized("inch", INCH, LENGTH),
    sized("ft", FOOT, LENGTH),
    sized("lb", POUND, MASS),
    sized("lbs", POUND, MASS),
    sized("lbm", POUND, MASS),
    sized("oz", POUND / 16.0, MASS),
    sized("slug", SLUG, MASS),
    sized("lbf", POUND_FORCE, FORCE),
    sized("ozf", POUND_FORCE / 16.0, FORCE),
    sized("kgf", GRAVITY, FORCE),
    sized("kp", GRAVITY, FORCE),
    ten("daN", 1, FORCE),
    sized("psi", PSI, PRESSURE),
    sized("degF", 5.0 / 9.0, TEMPERATURE),
    ten("sec", 0, TIME),
    // Of data sheets only.
    ten("J", 0, TORQUE),
    ten("kJ", 3, TORQUE),
    sized("krpm", 1e3 * RPM, ANGULAR_SPEED),
    ten("ohm", 0, RESISTANCE),
    ten("Arms", 0, CURRENT),
    sized("Apeak", 1.0 / SQRT_2, CURRENT),
    // Only converted in messages.
    sized("h", 3600.0, TIME),
    sized("gon", 0.9 * DEGREE, ANGLE),
];

/// Number of words at the end of the list that are only converted, and of those for data sheets only before them.
const CONVERTED: usize = 2;
const OF_DATA_SHEETS: usize = 6;

/// The words of data sheets and machine files.
pub(super) const LISTED: &[Word] = EVERY.split_at(EVERY.len() - CONVERTED).0;

/// The words of machine files.
pub(super) const WORDS: &[Word] = LISTED.split_at(LISTED.len() - OF_DATA_SHEETS).0;

/// The inch and the foot (m), the pound (kg) and the standard gravity (m/s²); all exact.
const INCH: f64 = 0.0254;
const FOOT: f64 = 0.3048;
const POUND: f64 = 0.453_592_37;
pub(super) const GRAVITY: f64 = 9.80665;

/// The words that are a mass on scales and a force in "lb in".
pub(super) const WEIGHED: [&str; 3] = ["lb", "lbs", "oz"];

/// The dimension of gravity.
pub(super) const FALL: Dimension = powers([1, 0, -2, 0, 0, 0]);

/// The pound-force (N), lb·g_n; the slug (kg), lbf·s²/ft; the pound-force per square inch (Pa).
const POUND_FORCE: f64 = 4.448_221_615_260_5;
const SLUG: f64 = 14.593_902_937_206_364;
const PSI: f64 = 6_894.757_293_168_362;

/// 550 ft·lbf/s in W.
const HORSEPOWER: f64 = 745.699_871_582_270_2;

/// A product of words. Powers of ten add up as exponents: "g mm^2" is exactly 1e-9.
pub(super) struct Product {
    tens: i32,
    size: f64,
    pub(super) dimension: Dimension,
}

impl Product {
    pub(super) const ONE: Self = Self {
        tens: 0,
        size: 1.0,
        dimension: NUMBER,
    };

    /// This product times a power of a word.
    pub(super) const fn times(self, word: &Word, power: i8) -> Self {
        Self {
            tens: self.tens + word.tens * power as i32,
            size: self.size * raised(word.size, power as i32),
            dimension: self.dimension.times(word.dimension, power),
        }
    }

    /// Its value in SI.
    pub(super) const fn scale(&self) -> f64 {
        raised(10.0, self.tens) * self.size
    }
}

/// x^power.
pub(super) const fn raised(x: f64, power: i32) -> f64 {
    let (mut product, mut left) = (1.0, power.unsigned_abs());
    while left > 0 {
        product *= x;
        left -= 1;
    }
    if power < 0 { 1.0 / product } else { product }
}

/// The dimension of a unit in the source code. An unknown word is a compile error.
pub(super) const fn dimension(unit: &str) -> Dimension {
    product(unit).dimension
}

const fn product(unit: &str) -> Product {
    let text = unit.as_bytes();
    let (mut product, mut at, mut below) = (Product::ONE, 0, false);
    while at < text.len() {
        if matches!(text[at], b' ' | b'/' | b'1') {
            below |= text[at] == b'/';
            at += 1;
            continue;
        }
        let from = at;
        while at < text.len() && !matches!(text[at], b' ' | b'/' | b'^') {
            at += 1;
        }
        let word = find(text, from, at);
        let mut power = 1;
        if at + 1 < text.len() && text[at] == b'^' {
            power = (text[at + 1] - b'0') as i8;
            at += 2;
        }
        product = product.times(word, if below { -power } else { power });
    }
    product
}

/// The word between two indices of a text.
const fn find(text: &[u8], from: usize, to: usize) -> &'static Word {
    let mut at = 0;
    while at < WORDS.len() {
        let word = &WORDS[at];
        if stands(word.text.as_bytes(), text, from, to) {
            return word;
        }
        at += 1;
    }
    panic!("a unit word that is in no list")
}

/// Whether a text has this word between two indices.
const fn stands(word: &[u8], text: &[u8], from: usize, to: usize) -> bool {
    let mut at = 0;
    while at < word.len() && from + at < to && word[at] == text[from + at] {
        at += 1;
    }
    at == word.len() && from + at == to
}
