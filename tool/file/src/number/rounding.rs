//! Numbers as text, rounded for reading.

use crate::math;

/// A number with four significant digits.
pub fn short(x: f64) -> String {
    significant(x, 4)
}

/// A number with the given number of significant digits, at most six; plain between 1e-4 and 1e6, otherwise with an exponent.
pub fn significant(x: f64, digits: i32) -> String {
    if x == 0.0 || !x.is_finite() {
        return rounded(x);
    }
    let scale = 10f64.powi(digits - 1 - math::log10(x.abs()).floor() as i32);
    let cut = (x * scale).round() / scale;
    if (1e-4..1e6).contains(&cut.abs()) {
        return rounded(cut);
    }
    let places = (digits - 1).max(0) as usize;
    format!("{x:.places$e}")
}

/// Four digits, rounded up: a lower limit on the safe side.
pub fn up(x: f64) -> f64 {
    to_side(x, f64::ceil)
}

/// Four digits, rounded down: an upper limit on the safe side.
pub fn down(x: f64) -> f64 {
    to_side(x, f64::floor)
}

fn to_side(value: f64, side: fn(f64) -> f64) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    // A number that has four digits up to rounding errors stays.
    let towards = |x: f64| {
        let whole = x.round();
        if (x - whole).abs() <= 1e-9 * x.abs() {
            whole
        } else {
            side(x)
        }
    };
    let exponent = math::log10(value.abs()).floor() as i32 - 3;
    // Whole powers of ten are exact, their inverses are not.
    if exponent > 0 {
        let unit = 10f64.powi(exponent);
        towards(value / unit) * unit
    } else {
        let unit = 10f64.powi(-exponent);
        towards(value * unit) / unit
    }
}

/// Two numbers with four significant digits, or with as many more, up to twelve, as distinguish them.
pub fn told_apart(pair: [f64; 2]) -> [String; 2] {
    let texts = |digits: i32| pair.map(|x| plain(x, digits));
    let apart = (5..=12).map(texts).find(|[one, other]| one != other);
    let four = pair.map(short);
    match apart {
        Some(texts) if four[0] == four[1] => texts,
        _ => four,
    }
}

/// A number with the given number of significant digits, plain between 1e-4 and 1e6.
fn plain(x: f64, digits: i32) -> String {
    let magnitude = x.abs();
    if digits <= 6 || !(1e-4..1e6).contains(&magnitude) {
        return significant(x, digits);
    }
    let decimals = (digits - 1 - math::log10(magnitude).floor() as i32).max(0) as usize;
    let text = format!("{x:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// A number, or zero if it is only a rounding error compared with the largest of its terms: below 1e-9 of that.
pub const fn cleared(x: f64, largest: f64) -> f64 {
    if x.abs() <= 1e-9 * largest.abs() {
        0.0
    } else {
        x
    }
}

/// A number with four significant digits; zero if it is only a rounding error compared with `largest`.
pub fn shown(x: f64, largest: f64) -> String {
    short(cleared(x, largest))
}

/// Share of the terms of a sum below which the sum is rounding.
const ROUNDING: f64 = 1e-12;

/// A sum, 0 if it is only the rounding of terms as large as `terms`.
pub fn of_terms(sum: f64, terms: f64) -> f64 {
    if sum.abs() <= ROUNDING * terms.abs() {
        0.0
    } else {
        sum
    }
}

/// A share in per cent with one decimal, never −0.0.
pub fn percent(share: f64) -> String {
    format!("{:.1} %", (share * 1e3).round() / 10.0 + 0.0)
}

/// A number with six significant digits, plain between 1e-4 and 1e6, else with an exponent.
pub fn rounded(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let magnitude = x.abs();
    if !(1e-4..1e6).contains(&magnitude) {
        return format!("{x:.5e}");
    }
    let digits = (5 - math::log10(magnitude).floor() as i32).max(0) as usize;
    let text = format!("{x:.digits$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// Like [`rounded`], for a positive upper bound: never below it.
pub fn bound(x: f64) -> String {
    let text = rounded(x);
    if x > 0.0 && text.parse().is_ok_and(|shown: f64| shown < x) {
        let last = 10f64.powi(math::log10(x).floor() as i32 - 5);
        return rounded(x + 0.5 * last);
    }
    text
}

/// A figure for a message: at most six significant digits, no trailing zeros.
pub fn figure(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let exponent = math::log10(value.abs()).floor();
    if !(-4.0..9.0).contains(&exponent) {
        let rounded = format!("{value:.3e}").parse().unwrap_or(value);
        return format!("{rounded:e}");
    }
    let decimals = (5.0 - exponent).max(0.0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::{of_terms, told_apart};

    #[test]
    fn what_is_left_of_large_terms_is_nothing() {
        // 0.1 + 0.2 − 0.3 is 5.6e-17.
        let left = 0.1_f64 + 0.2 - 0.3;
        assert!(left != 0.0 && of_terms(left, 0.3) == 0.0);
        assert_eq!(of_terms(-1e-11, 1.0).to_bits(), (-1e-11_f64).to_bits());
        assert_eq!(of_terms(0.0, 0.0).to_bits(), 0);
    }

    #[test]
    fn as_many_digits_as_tell_apart() {
        let told = |a, b| told_apart([a, b]);
        assert_eq!(told(6.4, 6.368), ["6.4", "6.368"]);
        assert_eq!(told(6.368_000_017, 6.368), ["6.36800002", "6.368"]);
        assert_eq!(told(0.800_04, 0.8), ["0.80004", "0.8"]);
        assert_eq!(told(2.5, 2.5), ["2.5", "2.5"]);
        assert_eq!(told(1234.561, 1234.5), ["1234.6", "1234.5"]);
    }
}
