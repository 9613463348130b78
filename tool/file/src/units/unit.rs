//! Units as written: words with powers and at most one "/"; and cures for those that cannot be read.

use super::fault::{Fault, closest};
use super::kind::SHARE;
use super::word::{Dimension, EVERY, FALL, GRAVITY, LISTED, Product, WEIGHED, WORDS, Word, raised};
use crate::plain;

/// A unit as read.
#[derive(Clone, Debug)]
pub struct Unit {
    /// The unit as written, in its tidy form.
    pub text: String,
    /// Its value in SI.
    pub scale: f64,
    /// Its dimension.
    pub dimension: Dimension,
    /// The number that is zero in SI: 32 for °F.
    pub zero: f64,
    /// Power of its pounds and ounces, which can be masses or forces.
    pub(super) pounds: i8,
}

impl Unit {
    /// A unit of this size and dimension.
    pub(super) fn new(text: impl Into<String>, scale: f64, dimension: Dimension) -> Self {
        Self {
            text: text.into(),
            scale,
            dimension,
            zero: 0.0,
            pounds: 0,
        }
    }

    /// The unit of a plain number.
    pub fn plain() -> Self {
        Self::new("", 1.0, SHARE.dimension)
    }

    /// The value (SI) of a number of this unit.
    pub fn si(&self, number: f64) -> f64 {
        (number - self.zero) * self.scale
    }

    /// The number of this unit with the value `si`.
    pub fn number(&self, si: f64) -> f64 {
        si / self.scale + self.zero
    }

    /// The unit with its pounds and ounces as forces: "lb in" is a torque. `None` if it has none.
    pub(super) fn as_force(&self) -> Option<Self> {
        (self.pounds != 0).then(|| Self {
            scale: self.scale * raised(GRAVITY, self.pounds.into()),
            dimension: self.dimension.times(FALL, self.pounds),
            pounds: 0,
            ..self.clone()
        })
    }
}

/// Units that are not accepted, and what to write instead.
const FOREIGN: [(&[&str], &str); 11] = [
    (&["h", "hr", "hour"], "1 h = 3600 s"),
    (&["second", "seconds"], "seconds are \"s\""),
    (
        &[
            "turns",
            "r",
            "revs",
            "revolution",
            "revolutions",
            "U",
            "stroke",
            "strokes",
        ],
        "1 turn = 360 deg; turns per minute, or strokes of a crank, are \"rpm\"",
    ),
    (&["grad", "gon"], "1 gon = 0.9 deg"),
    (&["degrees", "Deg", "DEG", "Grad"], "degrees are \"deg\""),
    (&["inches", "\""], "inches are \"in\""),
    (&["foot", "feet"], "feet are \"ft\""),
    (&["nm", "NM"], "newton metres are \"N m\""),
    (
        &["J", "kJ"],
        "1 J = 1 N m = 1 W s; a torque is in \"N m\", an energy in \"W s\"",
    ),
    (&["percent", "pct"], "per cent is \"%\""),
    (
        &["Fahrenheit", "fahrenheit"],
        "a temperature in °F is in \"degF\"",
    ),
];

/// Reads a unit, for example "mm", "kg cm^2", "N m s/rad" or "N/(m s)"; the text must be [`tidy`]. Words need no blanks between them: "kgcm2".
///
/// # Errors
/// An unknown word, or powers and divisions that are ambiguous.
pub fn read(text: &str) -> Result<Unit, Fault> {
    short_enough(text)?;
    of_words(&spaced(text, WORDS), text, WORDS)
}

/// Reads a unit of a data sheet; it can have more words, for example "A peak".
///
/// # Errors
/// Errors of [`read`].
pub fn read_listed(text: &str) -> Result<Unit, Fault> {
    short_enough(text)?;
    // An ampere of an alternating current is one word.
    let tidy = tidy(text).replace(" rms", "rms").replace(" peak", "peak");
    of_words(&spaced(&tidy, LISTED), text, LISTED)
}

/// Reads a unit that no file can have, for example "lb in^2", to convert it in a message.
pub(super) fn read_every(text: &str) -> Option<Unit> {
    of_words(&spaced(text, EVERY), text, EVERY).ok()
}

/// A power of ten before or behind a unit in a header, and the unit: "x10-4 kgm2" is −4 and "kgm2".
pub fn power_of_ten(tidy: &str) -> (i32, &str) {
    // Others are refused as units: 10E-4 is 1e-3, but mostly 1e-4 is meant.
    let exponent = |text: &str| {
        let power = text
            .strip_prefix('^')
            .or_else(|| text.starts_with('-').then_some(text))?;
        power.parse().ok().filter(|power: &i32| power.abs() <= 12)
    };
    let text = tidy.trim_start_matches(['x', '*']);
    if let Some(rest) = text.strip_prefix("10").or_else(|| text.strip_prefix("1e")) {
        let end = rest.find(|c: char| !(c.is_ascii_digit() || "^-".contains(c)));
        let (power, unit) = rest.split_at(end.unwrap_or(rest.len()));
        if let Some(power) = exponent(power) {
            return (power, unit.trim_start_matches([' ', '*']));
        }
    }
    let behind = tidy.rsplit_once(['x', '*', ' ']);
    let behind = behind.and_then(|(unit, power)| {
        let power = exponent(power.strip_prefix("10")?)?;
        Some((power, unit.trim_end_matches([' ', '*', 'x'])))
    });
    behind.unwrap_or((0, tidy))
}

/// The words of units in machine files, with their dimensions.
pub fn all_words() -> impl Iterator<Item = (&'static str, Dimension)> {
    WORDS.iter().map(|word| (word.text, word.dimension))
}

/// Revolutions per minute, as on name plates. "1/min" is one only if an angular speed is expected, which [`quantity`](super::quantity) decides.
const RPM: [&str; 5] = ["RPM", "Rpm", "U/min", "r/min", "turns/min"];

/// A unit with blanks and "^" inserted if they are missing: "kgcm2" is "kg cm^2".
fn spaced(text: &str, known: &'static [Word]) -> String {
    if RPM.contains(&text) {
        return "rpm".to_owned();
    }
    let (mut spaced, mut rest) = (String::new(), text);
    while !rest.is_empty() {
        let end = rest.find([' ', '*', '/', '(', ')']).unwrap_or(rest.len());
        let (token, after) = rest.split_at(end);
        let (word, exponent) = token.split_at(token.find('^').unwrap_or(end));
        // A foreign unit is not split: "degF" is not an angle times F.
        let is_foreign = FOREIGN.iter().any(|(words, _)| words.contains(&word));
        let together = !is_foreign && slip(word, known).is_none();
        let apart = apart(word, exponent, known).filter(|_| together);
        spaced += &apart.unwrap_or_else(|| token.to_owned());
        let mut separators = after.chars();
        spaced.extend(separators.next());
        rest = separators.as_str();
    }
    spaced
}

/// The only known word that differs from this one in case only: "Kg" is a misspelt "kg", not kelvin times gram.
fn slip(word: &str, known: &'static [Word]) -> Option<&'static str> {
    let mut same = (known.iter()).filter(|known| known.text.eq_ignore_ascii_case(word));
    match (same.next(), same.next()) {
        (Some(known), None) if known.text != word => Some(known.text),
        _ => None,
    }
}

fn of_words(text: &str, written: &str, words: &'static [Word]) -> Result<Unit, Fault> {
    let (mut product, mut pounds) = (Product::ONE, 0);
    let factors = factors(text, words)?;
    for (word, power) in &factors {
        product = product.times(word, *power);
        if WEIGHED.contains(&word.text) {
            pounds += power;
        }
    }
    // In a product a degree is a difference of temperatures.
    let is_fahrenheit = matches!(factors[..], [(Word { text: "degF", .. }, 1)]);
    Ok(Unit {
        zero: if is_fahrenheit { 32.0 } else { 0.0 },
        pounds,
        ..Unit::new(written, product.scale(), product.dimension)
    })
}

/// Refuses a text that is too long for a quantity, so that messages can show later faults in full.
///
/// # Errors
/// The text is too long.
pub fn short_enough(text: &str) -> Result<(), Fault> {
    if plain::is_short(text) {
        return Ok(());
    }
    Err(Fault::new(
        format!("is {}, longer than any quantity", plain::quoted(text)),
        "write one number and its unit",
    ))
}

/// Cure for the form of a unit.
const SHAPE: &str = "separate units by blanks, write powers with ^ and at most one \"/\": \"N m\", \"kg cm^2\", \
                     \"m/s^2\", \"N m s/rad\"";

/// The words of a unit with their powers.
fn factors(text: &str, known: &'static [Word]) -> Result<Vec<(&'static Word, i8)>, Fault> {
    let (above, below) = match text.split_once('/') {
        None => (text, ""),
        Some((_, below)) if below.trim().is_empty() || below.contains('/') => {
            return Err(Fault::new(
                format!("has the unit \"{text}\", which is not clear"),
                SHAPE,
            ));
        }
        Some((above, below)) => (above, below.trim()),
    };
    let mut factors = Vec::new();
    if above.trim() != "1" || below.is_empty() {
        for token in words(above) {
            factors.push(factor(token, known)?);
        }
        if factors.is_empty() {
            return Err(Fault::new("begins its unit with \"/\"", SHAPE));
        }
    }
    let bracketed = below.strip_prefix('(').and_then(|b| b.strip_suffix(')'));
    let divisors: Vec<&str> = words(bracketed.unwrap_or(below)).collect();
    if bracketed.is_none() && divisors.len() > 1 {
        return Err(Fault::new(
            format!("has the unit \"{text}\", which can be read in two ways"),
            format!(
                "put the denominator in brackets: \"{}/({})\", or write it in front of the \"/\"",
                above.trim(),
                divisors.join(" ")
            ),
        ));
    }
    for token in divisors {
        let (word, power) = factor(token, known)?;
        if word.text == "%" {
            return Err(Fault::new(
                format!("has the unit \"{text}\", which is divided by \"%\""),
                "write the number without \"%\"",
            ));
        }
        factors.push((word, -power));
    }
    if factors.len() > 8 {
        return Err(Fault::new("has a unit with more than eight parts", SHAPE));
    }
    Ok(factors)
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split([' ', '*']).filter(|token| !token.is_empty())
}

/// One word with its power: "cm^2".
fn factor(token: &str, words: &'static [Word]) -> Result<(&'static Word, i8), Fault> {
    if token.starts_with(|c: char| c.is_ascii_digit() || ".+-".contains(c)) {
        return Err(Fault::new(
            format!("contains more than one number (\"{token}\" is the second)"),
            "write one number and its unit; evaluate sums and fractions beforehand",
        ));
    }
    if let Some(sign) = token.chars().find(|c| "()+,;=".contains(*c)) {
        return Err(Fault::new(
            format!("contains \"{sign}\" in its unit"),
            SHAPE,
        ));
    }
    let (word, power) = match token.split_once('^') {
        None => (token, 1),
        Some((word, power)) => match power.parse::<i8>() {
            Ok(power) if (1..=4).contains(&power.abs()) => (word, power),
            _ => {
                return Err(Fault::new(
                    format!("has the power \"^{power}\" in its unit"),
                    "a power is a whole number from -4 to 4, as in \"m^2\" or \"s^-1\"",
                ));
            }
        },
    };
    let known = words.iter().find(|known| known.text == word);
    if let Some(known) = known.filter(|_| word != "%" || power == 1) {
        return Ok((known, power));
    }
    let cure = cure(word);
    Err(Fault::new(format!("has the unknown unit \"{word}\""), cure).label("unknown unit"))
}

/// Cure for an unknown unit.
fn cure(word: &str) -> String {
    if let Some((_, cure)) = FOREIGN.iter().find(|(words, _)| words.contains(&word)) {
        return format!("this unit is not accepted here: {cure}");
    }
    if let Some(known) = slip(word, WORDS) {
        return format!("did you mean \"{known}\"?");
    }
    let known: Vec<&str> = WORDS.iter().map(|word| word.text).collect();
    closest(word, &known).map_or_else(
        || format!("units are made of {}", known.join(", ")),
        |near| format!("did you mean \"{near}\"?"),
    )
}

/// Inserts the missing blanks, and "^" before a bare power: "kgcm2" is "kg cm^2".
fn apart(word: &str, exponent: &str, known: &'static [Word]) -> Option<String> {
    let letters = word.trim_end_matches(|c: char| c.is_ascii_digit());
    let words = split(letters, 4, known)?.join(" ");
    Some(match word.get(letters.len()..).unwrap_or_default() {
        _ if words.is_empty() => return None,
        "" => words + exponent,
        power => format!("{words}^{power}"),
    })
}

/// Splits words written without a blank: "kgcm" into "kg" and "cm".
fn split(letters: &str, most: usize, known: &'static [Word]) -> Option<Vec<&'static str>> {
    if letters.is_empty() {
        return Some(Vec::new());
    }
    let most = most.checked_sub(1)?;
    let mut words: Vec<&'static str> = known.iter().map(|word| word.text).collect();
    words.sort_by_key(|word| std::cmp::Reverse(word.len()));
    words.into_iter().find_map(|word| {
        let rest = letters.strip_prefix(word)?;
        // In "Nmm", the millimetre is one word, in "lbft" the foot.
        let torn = word.ends_with("Nm") && rest.starts_with('m')
            || matches!(word, "lbf" | "ozf") && rest.starts_with('t');
        if torn {
            return None;
        }
        let rest = split(rest, most, known)?;
        Some([vec![word], rest].concat())
    })
}

/// Unifies equivalent signs: · and × to *, also a point or a hyphen between letters, superscripts and "-" before a power to ^, − to -, µ to u, ° to
/// deg.
pub fn tidy(text: &str) -> String {
    const SUPERSCRIPTS: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹";
    let mut tidy = String::with_capacity(text.len());
    let mut raised = false;
    let (mut before, mut chars) = (' ', text.chars().peekable());
    while let Some(c) = chars.next() {
        let between =
            |next: Option<&char>| before.is_alphabetic() && next.is_some_and(|c| c.is_alphabetic());
        let multiplies = matches!(c, '.' | '-') && between(chars.peek());
        // The "e" of "1e-3" is no unit.
        let inverts = c == '-' && before.is_alphabetic() && !matches!(before, 'e' | 'E');
        let inverts = inverts && chars.peek().is_some_and(char::is_ascii_digit);
        before = c;
        let digit = SUPERSCRIPTS.chars().position(|s| s == c);
        let was_raised = std::mem::replace(&mut raised, digit.is_some() || c == '⁻');
        if raised && !was_raised {
            tidy.push('^');
        }
        match c {
            '⁻' | '−' => tidy.push('-'),
            '·' | '⋅' | '×' | '∙' | '•' => tidy.push('*'),
            '.' | '-' if multiplies => tidy.push('*'),
            '-' if inverts => tidy.push_str("^-"),
            'µ' | 'μ' => tidy.push('u'),
            '°' => tidy.push_str("deg"),
            '\u{2126}' | '\u{3a9}' => tidy.push_str("Ohm"),
            c if c.is_whitespace() => tidy.push(' '),
            c => tidy.extend(digit.map_or(Some(c), |d| char::from_digit(d as u32, 10))),
        }
    }
    // Blanks around the operators of a unit have no meaning.
    let mut text = tidy.trim().to_owned();
    while text.contains("  ") {
        text = text.replace("  ", " ");
    }
    for sign in ["^", "/", "*"] {
        text = text
            .replace(&format!(" {sign}"), sign)
            .replace(&format!("{sign} "), sign);
    }
    text
}

#[cfg(test)]
mod tests;
