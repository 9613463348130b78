//! Regular expressions for quantities as texts, in the syntax that editors and validators have in common.
//!
//! A pattern accepts the units that messages propose, with any prefixes, and the ways in which people write them; the reader of machine files
//! accepts a few more, such as "kg m^2/s^2" for a torque.

use jred_file::units::Dimension;
use jred_file::units::kind::{ANGULAR_SPEED, FORCE, Kind, SHARE, TEMPERATURE};
use jred_file::units::unit::{all_words, read};

const SIGN: &str = "[+−-]?";
const NO_MINUS: &str = "\\+?";
const NUMBER: &str = "(?:[0-9]+\\.?[0-9]*|\\.[0-9]+)(?:[eE][+−-]?[0-9]+| *[*·⋅×∙•] *10 *(?:\\^ *[+−-]?[0-9]+|⁻?[⁰¹²³⁴⁵⁶⁷⁸⁹]+))?";
/// Between number and unit, and between the words of a unit.
const GAP: &str = "[ *·⋅×∙•]*";
const BETWEEN: &str = "[ *·⋅×∙•.-]*";

/// A text that is a quantity of one of the kinds, without a minus if `unsigned`.
pub(super) fn quantity(kinds: &[&Kind], unsigned: bool) -> String {
    let mut units: Vec<String> = Vec::new();
    for unit in kinds.iter().flat_map(|kind| units_of(kind)) {
        if !units.contains(&unit) {
            units.push(unit);
        }
    }
    let sign = if unsigned { NO_MINUS } else { SIGN };
    let unit = format!("(?:{})", units.join("|"));
    let unit = if kinds.iter().any(|kind| is_share(kind)) {
        format!("{unit}?")
    } else {
        unit
    };
    format!("^ *{sign}{NUMBER}{GAP}{unit} *$")
}

/// Whether a plain number is a quantity of the kind.
pub(super) fn is_share(kind: &Kind) -> bool {
    kind.dimension == SHARE.dimension
}

/// A word of a unit, with its power.
type Factor = (Dimension, i8);

/// The ways to write units of a kind.
fn units_of(kind: &Kind) -> Vec<String> {
    let mut forms = vec![(vec![(kind.dimension, 1)], Vec::new())];
    for unit in kind.units.split(", ").chain([kind.unit]) {
        let form = split(unit);
        if read(unit).is_ok() && !forms.contains(&form) {
            forms.push(form);
        }
    }
    let free = kind.dimension.angle < 0;
    let units = forms.iter().map(|form| written(form, free));
    let mut units: Vec<_> = units.filter(|unit| !unit.is_empty()).collect();
    if kind.dimension == ANGULAR_SPEED.dimension {
        units.push("RPM|Rpm|(?:U|r|turns|1) */ *min|min(?: *\\^ *-1|-1| *⁻¹)".to_owned());
    }
    units
}

/// "N m s/rad" as force, length, time and angle.
fn split(unit: &str) -> (Vec<Factor>, Vec<Factor>) {
    let factor = |word: &str| {
        let (word, power) = word.split_once('^').unwrap_or((word, "1"));
        let (_, dimension) = all_words().find(|(known, _)| *known == word)?;
        Some((dimension, power.parse().unwrap()))
    };
    let (above, below) = unit.split_once('/').unwrap_or((unit, ""));
    let factors = |text: &str| {
        let mut factors: Vec<Factor> = text.split(' ').filter_map(factor).collect();
        factors.sort_by_key(|(dimension, power)| (format!("{dimension:?}"), *power));
        factors
    };
    (factors(above), factors(below))
}

/// All words of a dimension.
fn word(of: Dimension) -> String {
    let words = all_words().filter(|(text, dimension)| {
        *dimension == of && (of != TEMPERATURE.dimension || *text != "K")
    });
    // A pound or an ounce is a force, too.
    let weights = ["lbs", "lb", "oz"].map(|text| (text, of));
    let weights = weights.into_iter().filter(|_| of == FORCE.dimension);
    let words = words.chain(weights);
    let words: Vec<_> = words
        .map(|(text, _)| match text {
            "deg" => "deg|°".to_owned(),
            "degC" => "degC|°C".to_owned(),
            "degF" => "degF|°F".to_owned(),
            "arcmin" => "arcmin".to_owned(),
            _ if text.ends_with("Ohm") => text.replace("Ohm", "(?:Ohm|\u{2126}|\u{3a9})"),
            _ => match text.strip_prefix('u') {
                Some(rest) => format!("[uµμ]{rest}"),
                None => text.to_owned(),
            },
        })
        .collect();
    match words.as_slice() {
        [] => String::new(),
        [word] => word.clone(),
        _ => format!("(?:{})", words.join("|")),
    }
}

/// "^2", "²" or "2"; of a divisor written behind the others "^-2" or "⁻²".
fn raised(power: i8, below: bool) -> String {
    let small = "⁰¹²³⁴".chars().nth(power.unsigned_abs().into()).unwrap();
    match (power, below) {
        (1, false) => String::new(),
        (_, false) => format!("(?: *\\^ *{power}|{small}|{power})"),
        (_, true) => format!("(?: *\\^ *[−-]{power}|⁻{small})"),
    }
}

/// All orders of the factors; a unit below the "/" may also have a negative power. `free`: an angle below it may be left out.
fn written((above, below): &(Vec<Factor>, Vec<Factor>), free: bool) -> String {
    let one = |(dimension, power): &Factor| word(*dimension) + &raised(*power, false);
    let above: Vec<_> = above.iter().map(one).collect();
    if above.iter().any(String::is_empty) {
        return String::new();
    }
    let mut orders = Vec::new();
    orders_of(&above, &mut Vec::new(), &mut orders);
    let above = match orders.as_slice() {
        [] => "1".to_owned(),
        [order] => order.clone(),
        _ => format!("(?:{})", orders.join("|")),
    };
    let mut unit = above;
    for factor @ (dimension, power) in below {
        let behind = word(*dimension) + &raised(*power, true);
        if unit == "1" {
            unit = format!("1 */ *{}|{behind}", one(factor));
            continue;
        }
        let left_out = free && dimension.angle != 0 && dimension.time == 0;
        let mark = if left_out { "?" } else { "" };
        unit = format!("{unit}(?: */ *{}|{BETWEEN}{behind}){mark}", one(factor));
    }
    unit
}

fn orders_of(rest: &[String], chosen: &mut Vec<String>, orders: &mut Vec<String>) {
    if rest.is_empty() {
        if !chosen.is_empty() {
            orders.push(chosen.join(BETWEEN));
        }
        return;
    }
    for (k, word) in rest.iter().enumerate() {
        let mut others = rest.to_vec();
        others.remove(k);
        chosen.push(word.clone());
        orders_of(&others, chosen, orders);
        chosen.pop();
    }
}
