//! Options that take one of a few words.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

use jred_file::number::words::Word;

/// Parses a word; the help lists all of them with their meanings.
pub(super) fn word<T: Word>() -> impl TypedValueParser<Value = T> {
    let values = T::WORDS.iter().map(|(_, word, meaning)| {
        let meaning = meaning.trim();
        PossibleValue::new(*word).help(meaning.strip_suffix('.').unwrap_or(meaning))
    });
    PossibleValuesParser::new(values)
        .try_map(|word| T::of_word(&word).ok_or("it is not one of the words"))
}
