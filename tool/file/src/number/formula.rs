//! Formulas of a few variables, with their derivatives.
//!
//! ```text
//! sum      = product { ("+" | "-") product }
//! product  = sign { ("*" | "/") sign }
//! sign     = { "+" | "-" } power
//! power    = atom [ "^" sign ]                 -2^2 = -4, 2^3^2 = 2^9
//! atom     = number | name | function "(" sum ")" | "(" sum ")"
//! ```
//!
//! Evaluated in dual numbers, so that the slopes are exact. It is written here because libraries with derivatives bring a regular-expression engine
//! ten times the size of this file's code, and report the position of a mistake less precisely.

use crate::math::{atan, cos, exp, ln, pow, sin, tan, tanh};
use std::ops::Range;

use jred::friction::Dual;
use jred_enclosure::Interval;

mod bound;

/// Deepest nesting.
const DEPTH: usize = 64;

/// Longest text (bytes).
const LONGEST: usize = 1000;

/// A function of one argument: value and derivative, and the enclosure over an interval.
type Function = (fn(f64) -> [f64; 2], fn(Interval) -> Interval);

/// The functions by name. Angles are in radians.
const FUNCTIONS: [(&str, Function); 8] = [
    ("sin", (|x| [sin(x), cos(x)], |x| x.sin_cos().0)),
    ("cos", (|x| [cos(x), -sin(x)], |x| x.sin_cos().1)),
    ("tan", (|x| [tan(x), 1.0 + tan(x) * tan(x)], bound::tan)),
    ("atan", (|x| [atan(x), 1.0 / (1.0 + x * x)], bound::atan)),
    (
        "tanh",
        (|x| [tanh(x), 1.0 - tanh(x) * tanh(x)], bound::tanh),
    ),
    ("exp", (|x| [exp(x), exp(x)], bound::exp)),
    ("ln", (|x| [ln(x), 1.0 / x], bound::ln)),
    ("sqrt", (|x| [x.sqrt(), 0.5 / x.sqrt()], Interval::sqrt)),
];

/// Why a formula cannot be parsed, with the position.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FormulaError {
    /// Bytes of the text.
    pub place: Range<usize>,
    /// The fault.
    pub what: String,
}

/// A formula.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    root: Expression,
}

#[derive(Clone, Debug, PartialEq)]
enum Expression {
    Number(f64),
    Variable(usize),
    Call(usize, Box<Expression>),
    Negative(Box<Expression>),
    Pair(Operation, Box<[Expression; 2]>),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Operation {
    Plus,
    Minus,
    Times,
    Over,
    Power,
}

impl Formula {
    /// The formula of a `text` in these variables.
    ///
    /// # Errors
    /// The position of the fault.
    pub fn parse(text: &str, variables: &[&str]) -> Result<Self, FormulaError> {
        if text.len() > LONGEST {
            return Err(FormulaError {
                place: 0..0,
                what: format!("it is longer than {LONGEST} characters"),
            });
        }
        let mut reader = Reader {
            text,
            at: 0,
            depth: 0,
            variables,
        };
        let root = reader.sum()?;
        match reader.next() {
            None => Ok(Self { root }),
            Some((place, found)) => Err(FormulaError {
                place,
                what: format!(
                    "\"{found}\" is not expected here: write an operator such as * before it"
                ),
            }),
        }
    }

    /// Its value, with derivatives by the quantities of which the `variables` are functions.
    pub fn at<const N: usize>(&self, variables: &[Dual<N>]) -> Dual<N> {
        value(&self.root, variables)
    }

    /// Whether it contains the variable of this number.
    pub fn contains(&self, variable: usize) -> bool {
        contains(&self.root, variable)
    }
}

fn contains(node: &Expression, variable: usize) -> bool {
    match node {
        Expression::Number(_) => false,
        Expression::Variable(k) => *k == variable,
        Expression::Call(_, inner) | Expression::Negative(inner) => contains(inner, variable),
        Expression::Pair(_, pair) => pair.iter().any(|node| contains(node, variable)),
    }
}

fn value<const N: usize>(node: &Expression, variables: &[Dual<N>]) -> Dual<N> {
    match node {
        Expression::Number(number) => Dual::constant(*number),
        Expression::Variable(k) => variables
            .get(*k)
            .copied()
            .unwrap_or(Dual::constant(f64::NAN)),
        Expression::Negative(inner) => -value(inner, variables),
        Expression::Call(function, inner) => {
            let inner = value(inner, variables);
            let [at, slope] = FUNCTIONS[*function].1.0(inner.value);
            inner.through(at, slope)
        }
        Expression::Pair(operation, pair) => {
            let [a, b] = [&pair[0], &pair[1]].map(|node| value(node, variables));
            match operation {
                Operation::Plus => a + b,
                Operation::Minus => a - b,
                Operation::Times => a * b,
                Operation::Over => a / b,
                Operation::Power => power(a, b),
            }
        }
    }
}

/// aᵇ; a constant exponent needs no logarithm, so a may be negative or zero.
fn power<const N: usize>(a: Dual<N>, b: Dual<N>) -> Dual<N> {
    let at = pow(a.value, b.value);
    let mut slope = if b.value == 0.0 {
        Dual::constant(1.0)
    } else {
        a.through(at, b.value * pow(a.value, b.value - 1.0))
    };
    if b.slope.iter().any(|by| *by != 0.0) {
        let by_exponent = b.through(0.0, at * ln(a.value));
        for (sum, more) in slope.slope.iter_mut().zip(by_exponent.slope) {
            *sum += more;
        }
    }
    slope
}

struct Reader<'t> {
    text: &'t str,
    at: usize,
    depth: usize,
    variables: &'t [&'t str],
}

impl<'t> Reader<'t> {
    /// The next word, number or sign with its position, if there is one.
    fn next(&mut self) -> Option<(Range<usize>, &'t str)> {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start().len();
        let rest = &self.text[self.at..];
        let first = rest.chars().next()?;
        let length = if first.is_ascii_digit() || first == '.' {
            number_length(rest)
        } else if first.is_alphabetic() {
            let end = |c: char| !(c.is_alphanumeric() || c == '_');
            rest.find(end).unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        Some((self.at..self.at + length, &rest[..length]))
    }

    /// Consumes the next sign, if it is one of these.
    fn take(&mut self, signs: &[&str]) -> Option<usize> {
        let (place, found) = self.next()?;
        let which = signs.iter().position(|sign| *sign == found)?;
        self.at = place.end;
        Some(which)
    }

    fn sum(&mut self) -> Result<Expression, FormulaError> {
        let mut node = self.product()?;
        while let Some(which) = self.take(&["+", "-", "−"]) {
            let operation = [Operation::Plus, Operation::Minus, Operation::Minus][which];
            node = Expression::Pair(operation, Box::new([node, self.product()?]));
        }
        Ok(node)
    }

    fn product(&mut self) -> Result<Expression, FormulaError> {
        let mut node = self.sign()?;
        while let Some(which) = self.take(&["*", "·", "/"]) {
            let operation = [Operation::Times, Operation::Times, Operation::Over][which];
            node = Expression::Pair(operation, Box::new([node, self.sign()?]));
        }
        Ok(node)
    }

    fn sign(&mut self) -> Result<Expression, FormulaError> {
        self.depth += 1;
        if self.depth > DEPTH {
            return fault(
                self.at..self.at,
                format!("it is nested deeper than {DEPTH} times"),
            );
        }
        let node = match self.take(&["-", "−", "+"]) {
            Some(2) => self.sign()?,
            Some(_) => Expression::Negative(Box::new(self.sign()?)),
            None => self.power()?,
        };
        self.depth -= 1;
        Ok(node)
    }

    fn power(&mut self) -> Result<Expression, FormulaError> {
        let base = self.atom()?;
        if self.take(&["^"]).is_none() {
            return Ok(base);
        }
        let exponent = self.sign()?;
        Ok(Expression::Pair(
            Operation::Power,
            Box::new([base, exponent]),
        ))
    }

    fn atom(&mut self) -> Result<Expression, FormulaError> {
        let Some((place, found)) = self.next() else {
            let end = self.text.len();
            return fault(end..end, "it ends where a number, a name or ( is expected");
        };
        self.at = place.end;
        let first = found.chars().next().unwrap_or(' ');
        if found == "(" {
            let inner = self.sum()?;
            return self.closed(inner, place);
        }
        if first.is_ascii_digit() || first == '.' {
            return match found.parse::<f64>() {
                Ok(number) if number.is_finite() => Ok(Expression::Number(number)),
                _ => fault(place, format!("\"{found}\" is not a number")),
            };
        }
        if !first.is_alphabetic() {
            return fault(
                place,
                format!("\"{found}\" stands where a number, a name or ( is expected"),
            );
        }
        if found == "pi" || found == "π" {
            return Ok(Expression::Number(std::f64::consts::PI));
        }
        if let Some(variable) = self.variables.iter().position(|name| *name == found) {
            return Ok(Expression::Variable(variable));
        }
        if let Some(function) = FUNCTIONS.iter().position(|(name, _)| *name == found) {
            let Some((bracket, "(")) = self.next() else {
                return fault(
                    place,
                    format!("the function {found} needs its argument in brackets: {found}(…)"),
                );
            };
            self.at = bracket.end;
            let inner = self.sum()?;
            let inner = self.closed(inner, bracket)?;
            return Ok(Expression::Call(function, Box::new(inner)));
        }
        let functions: Vec<&str> = FUNCTIONS.iter().map(|(name, _)| *name).collect();
        fault(
            place,
            format!(
                "\"{found}\" is not known here: there are {}, pi and the functions {}",
                self.variables.join(", "),
                functions.join(", ")
            ),
        )
    }

    /// The content of brackets that were opened at `open`.
    fn closed(
        &mut self,
        inner: Expression,
        open: Range<usize>,
    ) -> Result<Expression, FormulaError> {
        match self.take(&[")"]) {
            Some(_) => Ok(inner),
            None => fault(open, "this bracket is not closed"),
        }
    }
}

fn fault<T>(place: Range<usize>, what: impl Into<String>) -> Result<T, FormulaError> {
    let what = what.into();
    Err(FormulaError { place, what })
}

/// Length in bytes of the number at the start of the text.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |from: usize| {
        let part = &bytes[from.min(bytes.len())..];
        from + part
            .iter()
            .take_while(|b| b.is_ascii_digit() || **b == b'.')
            .count()
    };
    let end = digits(0);
    if !matches!(bytes.get(end), Some(b'e' | b'E')) {
        return end;
    }
    let signed = end + 1 + usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
    match digits(signed) {
        last if last > signed => last,
        _ => end,
    }
}
