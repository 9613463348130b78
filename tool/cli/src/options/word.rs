//! Options whose value is one of a few words.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

use jred_file::number::words::Word;

/// Reads a word; the help lists all of them with what they mean.
pub(super) fn word<T: Word>() -> impl TypedValueParser<Value = T> {
    let values = T::WORDS.iter().map(|(_, word, meaning)| {
        let meaning = meaning.trim();
        PossibleValue::new(*word).help(meaning.strip_suffix('.').unwrap_or(meaning))
    });
    PossibleValuesParser::new(values)
        .try_map(|word| T::of_word(&word).ok_or("it is none of the words"))
}
