//! The name of a table in a program.

use std::fmt::Write as _;
use std::path::Path;

/// The name of a table in a program: a word of C and of Rust, as prefix of the names in a source file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name(pub(crate) String);

/// Prefix of the library's names, in C followed by an underscore.
const LIBRARY: &str = "jred";

/// Reserved words of Rust, of those that a name could be.
const RUST: [&str; 50] = [
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate",
    "do", "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl",
    "in", "let", "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref",
    "return", "self", "static", "struct", "super", "trait", "true", "try", "type", "typeof",
    "unsafe", "unsized", "use", "virtual", "where", "while",
];

impl Name {
    /// The name of a file without its extension. Characters other than letters and digits become underscores; letters outside ASCII become their
    /// Unicode numbers, so that two names differ.
    pub fn of_file(file: &str) -> Self {
        let stem = Path::new(file).file_stem().unwrap_or_default();
        Self(word(&stem.to_string_lossy()))
    }

    /// A given name.
    ///
    /// # Errors
    /// The text is not a word of C and of Rust: the reason, and a valid name.
    pub fn new(text: &str) -> Result<Self, (String, Self)> {
        let is_word = text.starts_with(|c: char| c.is_ascii_alphabetic())
            && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        if !is_word {
            let why = "a name in a program begins with a letter from a to z, and has such letters, digits and underscores";
            return Err((why.to_owned(), Self(word(text))));
        }
        if text == LIBRARY || text.starts_with(&[LIBRARY, "_"].concat()) {
            return Err((
                "names of the library begin so".to_owned(),
                Self(["my_", text].concat()),
            ));
        }
        if RUST.contains(&text.to_lowercase().as_str()) {
            return Err((
                "it is a word of the programming language Rust".to_owned(),
                Self(format!("{text}_table")),
            ));
        }
        Ok(Self(text.to_owned()))
    }

    /// The name as text.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

/// The nearest valid name.
fn word(text: &str) -> String {
    let mut name = String::new();
    for c in text.chars() {
        if c.is_ascii_alphanumeric() {
            name.push(c);
        } else if c.is_alphanumeric() {
            let _ = write!(name, "u{:x}", u32::from(c));
        } else {
            name.push('_');
        }
    }
    if name.starts_with(|c: char| c.is_ascii_alphabetic()) {
        name
    } else {
        format!("machine_{name}")
    }
}

#[cfg(test)]
mod tests {
    use super::Name;

    #[test]
    fn a_file_name_becomes_a_word() {
        for (name, expected) in [
            ("press.toml", "press"),
            ("a/b/toggle-press.toml", "toggle_press"),
            ("3 axis.toml", "machine_3_axis"),
            ("<stdin>", "machine__stdin_"),
            ("", "machine_"),
            // Of equal length, but different: 冲 is U+51B2, 床 U+5E8A, 压 U+538B, 机 U+673A.
            ("\u{51b2}\u{5e8a}.h", "u51b2u5e8a"),
            ("\u{538b}\u{673a}.h", "u538bu673a"),
        ] {
            assert_eq!(Name::of_file(name).as_str(), expected, "{name}");
        }
    }

    #[test]
    fn a_name_that_is_none_is_refused_with_one_that_is() {
        for name in ["press", "Press_1", "p"] {
            assert_eq!(Name::new(name).unwrap().as_str(), name);
        }
        for (name, proposed) in [
            ("press-1", "press_1"),
            ("press 1", "press_1"),
            ("", "machine_"),
            ("1st", "machine_1st"),
            ("_press", "machine__press"),
            ("pr\u{e9}s", "prue9s"),
            ("\u{51b2}", "u51b2"),
            ("type", "type_table"),
            ("Self", "Self_table"),
            ("jred", "my_jred"),
            ("jred_f32", "my_jred_f32"),
        ] {
            let (why, found) = Name::new(name).unwrap_err();
            assert_eq!(found.as_str(), proposed, "{name}: {why}");
            assert_eq!(Name::new(proposed).as_ref(), Ok(&found));
        }
    }
}
