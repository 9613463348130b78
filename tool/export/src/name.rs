//! The name of a table in a program.

use std::fmt::Write as _;
use std::path::Path;

/// The name of a table in a program: a word of C and of Rust, as prefix of the names in a source file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name(pub(crate) String);

/// The names that a PLC takes.
#[derive(Clone, Copy, Debug)]
pub struct PlcNames {
    /// Most characters.
    pub longest: usize,
    /// Names in use beside it, in lower case, between spaces.
    pub taken: &'static str,
}

/// Prefix of the library's names, in C followed by an underscore.
const LIBRARY: &str = "jred";

/// Reserved words of Rust, of those that a name could be.
const RUST: &str = "abstract as async await become box break const continue crate do dyn else enum extern false final fn for gen if impl in let loop
    macro match mod move mut override priv pub ref return self static struct super trait true try type typeof unsafe unsized use virtual where while";

/// Reserved words of IEC 61131-3, and names of its types, functions and blocks, as CODESYS and TwinCAT have them.
const IEC: &str = "abs abstract acos action add adr and any any_num any_real array asin at atan bit bool by byte case concat configuration constant
    continue cos ctd ctu ctud date date_and_time delete dint div do dt dword else elsif end_action end_case end_for end_function end_function_block
    end_if end_program end_repeat end_struct end_type end_var end_while eq exit exp expt extends f_edge f_trig false final find for from function
    function_block ge global gt if implements insert int interface internal jmp le left len limit lint ln log lreal lt ltime lword max method mid
    min mod move mul mux ne not null of on or override pointer private program property protected public r_edge r_trig real ref reference repeat
    replace resource ret retain return right rol ror rs sel shl shr sin single sint sizeof sqrt sr string struct sub super tan task then this time
    time_of_day tod tof to ton tp transition true trunc type udint uint ulint union until usint var var_access var_config var_external var_global
    var_in_out var_input var_output var_stat var_temp while with word wstring xor";

impl Name {
    /// A given name in a program of a PLC (IEC 61131-3), where letter case does not count.
    ///
    /// # Errors
    /// It is no identifier there, or reserved, or too long: the reason, and a valid name.
    pub fn for_plc(text: &str, names: &PlcNames) -> Result<Self, (String, Self)> {
        let valid = Self(plc_word(text, names));
        if valid.0 == text {
            return Ok(valid);
        }
        let (length, longest) = (text.chars().count(), names.longest);
        let why = if is_among(names.taken, text) {
            "the block has a variable of this name".to_owned()
        } else if is_among(IEC, text) {
            "it is a word of the languages of PLCs (IEC 61131-3)".to_owned()
        } else if length > longest {
            format!("it has {length} characters, and a PLC takes {longest}")
        } else {
            "a name in a PLC begins with a letter from a to z, has such letters, digits and single underscores, and ends with no underscore"
                .to_owned()
        };
        Err((why, valid))
    }

    /// The name of a file as a name in a PLC.
    pub fn for_plc_of_file(file: &str, names: &PlcNames) -> Self {
        Self(plc_word(&Self::of_file(file).0, names))
    }

    /// The name of a file without its extension. Characters other than letters and digits become underscores; an accent is left out, and letters outside
    /// the Latin alphabet become their Unicode numbers, so that two names differ.
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
        let (why, valid) = if !is_word {
            let why = "a name in a program begins with a letter from a to z, and has such letters, digits and underscores";
            (why, word(text))
        } else if text == LIBRARY || text.starts_with(&[LIBRARY, "_"].concat()) {
            ("names of the library begin so", format!("my_{text}"))
        } else if is_among(RUST, text) {
            let why = "it is a word of the programming language Rust";
            (why, format!("{text}_table"))
        } else {
            return Ok(Self(text.to_owned()));
        };
        Err((why.to_owned(), Self(valid)))
    }

    /// The end of a sentence about a file that has the name, if that is not the file's own.
    pub fn changed(&self, file: &str) -> Option<String> {
        let own = Path::new(file).file_stem().unwrap_or_default();
        let own = own.to_string_lossy();
        (own != self.0.as_str()).then(|| format!("; the name in it is {}", self.0))
    }

    /// The name as text.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

/// Whether a list of words has this one; letter case does not count.
fn is_among(words: &str, text: &str) -> bool {
    words
        .split_whitespace()
        .any(|word| word.eq_ignore_ascii_case(text))
}

/// The nearest valid name of a PLC; the same text, if it is one.
fn plc_word(text: &str, names: &PlcNames) -> String {
    let word = word(text);
    let parts: Vec<&str> = word.split('_').filter(|part| !part.is_empty()).collect();
    let mut name = parts.join("_");
    if is_among(IEC, &name) || is_among(names.taken, &name) {
        name.insert_str(0, "my_");
    }
    name.truncate(names.longest);
    name.truncate(name.trim_end_matches('_').len());
    name
}

/// Letters without their accents, or as they are written without them.
const LATIN: [(&str, &str); 21] = [
    ("äæ", "ae"),
    ("öøœ", "oe"),
    ("ü", "ue"),
    ("ß", "ss"),
    ("å", "aa"),
    ("àáâãăą", "a"),
    ("çćč", "c"),
    ("ďđ", "d"),
    ("èéêëęě", "e"),
    ("ğ", "g"),
    ("ìíîïı", "i"),
    ("ł", "l"),
    ("ñńň", "n"),
    ("òóôõő", "o"),
    ("ŕř", "r"),
    ("śšşș", "s"),
    ("ţťț", "t"),
    ("ùúûůű", "u"),
    ("ýÿ", "y"),
    ("źżž", "z"),
    ("þ", "th"),
];

/// A Latin letter with an accent in ASCII, if it is one.
fn latin(c: char) -> Option<String> {
    let small = c.to_lowercase().next()?;
    let (_, plain) = LATIN.iter().find(|(letters, _)| letters.contains(small))?;
    let (first, rest) = plain.split_at(1);
    Some(if c.is_uppercase() {
        first.to_uppercase() + rest
    } else {
        (*plain).to_owned()
    })
}

/// The nearest valid name.
fn word(text: &str) -> String {
    let mut name = String::new();
    for c in text.chars() {
        if c.is_ascii_alphanumeric() {
            name.push(c);
        } else if let Some(latin) = latin(c) {
            name.push_str(&latin);
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
    use super::{Name, PlcNames};

    #[test]
    fn a_file_name_becomes_a_word() {
        for (name, expected) in [
            ("press.toml", "press"),
            ("a/b/toggle-press.toml", "toggle_press"),
            ("3 axis.toml", "machine_3_axis"),
            ("<stdin>", "machine__stdin_"),
            ("", "machine_"),
            ("Größe.st", "Groesse"),
            ("Übersetzung-écart", "Uebersetzung_ecart"),
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
            ("pr\u{e9}s", "pres"),
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

    #[test]
    fn a_plc_has_names_of_its_own() {
        let names = PlcNames {
            longest: 12,
            taken: "speed",
        };
        for name in ["press", "Press_1", "p"] {
            assert_eq!(Name::for_plc(name, &names).unwrap().as_str(), name);
        }
        for (name, proposed, because) in [
            ("press__1", "press_1", "single underscores"),
            ("press_", "press", "single underscores"),
            ("_press", "machine_pres", "single underscores"),
            ("press-1", "press_1", "single underscores"),
            ("1st", "machine_1st", "begins with a letter"),
            ("", "machine", "begins with a letter"),
            ("Ton", "my_Ton", "a word of the languages"),
            ("LREAL", "my_LREAL", "a word of the languages"),
            ("speed", "my_speed", "a variable of this name"),
            ("a_very_long_name", "a_very_long", "16 characters"),
        ] {
            let (why, found) = Name::for_plc(name, &names).unwrap_err();
            assert_eq!(found.as_str(), proposed, "{name}: {why}");
            assert!(why.contains(because), "{name}: {why}");
            assert_eq!(Name::for_plc(proposed, &names).as_ref(), Ok(&found));
        }
        let of_file = |file| Name::for_plc_of_file(file, &names);
        assert_eq!(of_file("a/toggle--press.toml").as_str(), "toggle_press");
        assert_eq!(of_file("type.st").as_str(), "my_type");
    }
}
