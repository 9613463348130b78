//! Structured Text of IEC 61131-3: literals, declarations, blocks.

use std::fmt::Write as _;

/// Numbers of an array on one line: compilers and parsers take short lines only.
const PER_LINE: usize = 8;

/// A block: its interface and its statements. [`text`](Self::text) is its Structured Text, `plcopen` its XML.
pub(crate) struct Block {
    /// Its name.
    pub(crate) name: String,
    /// Its purpose, in lines.
    pub(crate) about: String,
    /// Its variables, by their use.
    pub(crate) lists: Vec<(Use, Vec<Variable>)>,
    /// Its statements.
    pub(crate) body: String,
}

/// The use of variables: the words of Structured Text, and the element of PLCopen XML.
#[derive(Clone, Copy)]
pub(crate) enum Use {
    /// Set by the caller.
    Input,
    /// Read by the caller.
    Output,
    /// Own variables.
    Local,
    /// Own constants.
    Constant,
}

/// A variable with its initial value.
pub(crate) struct Variable {
    pub(crate) name: String,
    pub(crate) kind: Kind,
    pub(crate) initial: Initial,
    /// Its meaning, with the unit.
    pub(crate) comment: String,
}

/// A type, of the variable or of the elements of its array.
pub(crate) enum Kind {
    /// An elementary type, such as `LREAL`.
    Elementary(&'static str),
    /// A block.
    Block(String),
}

/// The value at the start.
pub(crate) enum Initial {
    /// That of the type.
    Default,
    /// A literal.
    One(String),
    /// Literals of an array, whose index begins at 0.
    Array(Vec<String>),
}

/// A number as a literal of the same bits. It has a decimal point, without which it would be an integer.
pub(crate) fn real(value: f64) -> String {
    // Without -0, which is an expression.
    let text = format!("{:?}", value + 0.0);
    match text.split_once('e') {
        Some((digits, power)) if digits.contains('.') => format!("{digits}E{power}"),
        Some((digits, power)) => format!("{digits}.0E{power}"),
        None => text,
    }
}

/// A text within a comment, which it cannot end.
pub(crate) fn commented(text: &str) -> String {
    let text = text.replace(['\n', '\r'], " ");
    format!("(* {} *)", text.replace("(*", "( *").replace("*)", "* )"))
}

/// Items between brackets, `per_line` of them on a line.
pub(crate) fn array(items: &[String], per_line: usize, indent: &str) -> String {
    let lines = items.chunks(per_line.max(1));
    let lines: Vec<String> = lines
        .map(|line| format!("{indent}    {}", line.join(", ")))
        .collect();
    format!("[\n{}\n{indent}]", lines.join(",\n"))
}

impl Use {
    /// The words that begin its list.
    const fn words(self) -> &'static str {
        match self {
            Self::Input => "VAR_INPUT",
            Self::Output => "VAR_OUTPUT",
            Self::Local => "VAR",
            Self::Constant => "VAR CONSTANT",
        }
    }
}

/// A variable of type LREAL.
pub(crate) fn variable(name: &str, comment: impl Into<String>) -> Variable {
    Variable {
        name: name.to_owned(),
        kind: Kind::Elementary("LREAL"),
        initial: Initial::Default,
        comment: comment.into(),
    }
}

/// A number.
pub(crate) fn number(name: &str, value: f64, comment: impl Into<String>) -> Variable {
    Variable {
        initial: Initial::One(real(value)),
        ..variable(name, comment)
    }
}

/// An array of numbers.
pub(crate) fn numbers(name: &str, values: &[f64], comment: impl Into<String>) -> Variable {
    Variable {
        initial: Initial::Array(values.iter().copied().map(real).collect()),
        ..variable(name, comment)
    }
}

impl Variable {
    /// The same of another type.
    pub(crate) fn of(self, kind: Kind) -> Self {
        Self { kind, ..self }
    }

    /// Its declaration.
    fn text(&self) -> String {
        let kind = match &self.kind {
            Kind::Elementary(name) => name,
            Kind::Block(name) => name.as_str(),
        };
        let (name, comment) = (&self.name, commented(&self.comment));
        match &self.initial {
            Initial::Default => format!("    {name} : {kind}; {comment}\n"),
            Initial::One(value) => format!("    {name} : {kind} := {value}; {comment}\n"),
            Initial::Array(values) => {
                let last = values.len().saturating_sub(1);
                let values = array(values, PER_LINE, "    ");
                format!("    {comment}\n    {name} : ARRAY[0..{last}] OF {kind} := {values};\n")
            }
        }
    }
}

impl Block {
    /// Its Structured Text.
    pub(crate) fn text(&self) -> String {
        let mut text = String::new();
        for line in self.about.lines() {
            let _ = writeln!(text, "{}", commented(line));
        }
        let _ = writeln!(text, "FUNCTION_BLOCK {}", self.name);
        for (of, variables) in &self.lists {
            let _ = writeln!(text, "{}", of.words());
            text.extend(variables.iter().map(Variable::text));
            text += "END_VAR\n";
        }
        text + "\n" + &self.body + "END_FUNCTION_BLOCK\n"
    }
}

#[cfg(test)]
mod tests {
    use super::{commented, real};

    #[test]
    #[allow(clippy::float_cmp, reason = "the same bits")]
    fn literals_have_a_point_and_the_same_bits() {
        let values = [0.0, -0.0, 1.0, -2.5, 1e-7, 1e300, 5e-324, 0.1f32.into()];
        for value in values {
            let text = real(value);
            assert!(text.contains('.'), "{text}");
            assert_eq!(text.replace('E', "e").parse::<f64>().unwrap(), value);
        }
        assert_eq!(real(1e-7), "1.0E-7");
        assert_eq!(real(-0.0), "0.0");
    }

    #[test]
    fn a_text_cannot_end_its_comment() {
        assert_eq!(commented("a *) b\n(* c"), "(* a * ) b ( * c *)");
    }
}
