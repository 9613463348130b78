//! Faults of written values, with their cures.

use std::cmp::Reverse;

/// A fault of a value whose key is not known yet.
#[derive(Debug)]
pub struct Fault {
    /// Continues "`length` in [mechanism.crank] …".
    pub message: String,
    /// Cure.
    pub help: String,
    /// Label at the place of the fault.
    pub label: String,
}

impl Fault {
    /// A fault and its cure; its place is labelled "here".
    pub fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            help: help.into(),
            label: "here".to_owned(),
        }
    }

    /// The same fault with a label for its place.
    #[must_use]
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }
}

/// The word that `wrong` is most likely a misspelling of; of equally near words the one with the longest common beginning.
pub fn closest<S: AsRef<str>>(wrong: &str, words: &[S]) -> Option<String> {
    let lower = wrong.to_lowercase();
    let length = lower.chars().count();
    let allowed = (length / 3).clamp(1, 3);
    let distance = |word: &str| {
        let near = word.chars().count().abs_diff(length) <= allowed;
        near.then(|| strsim::damerau_levenshtein(&lower, &word.to_lowercase()))
    };
    (words.iter())
        .filter_map(|word| Some((distance(word.as_ref())?, word.as_ref())))
        .filter(|(distance, _)| *distance <= allowed)
        .min_by_key(|(distance, word)| (*distance, Reverse(common(&lower, &word.to_lowercase()))))
        .map(|(_, word)| word.to_owned())
}

/// The three words most like `wrong`, the nearest first.
pub fn nearest<'w>(wrong: &str, words: &[&'w str]) -> Vec<&'w str> {
    let lower = wrong.to_lowercase();
    let mut near = words.to_vec();
    near.sort_by(|a, b| {
        strsim::jaro_winkler(&lower, b).total_cmp(&strsim::jaro_winkler(&lower, a))
    });
    near.truncate(3);
    near
}

/// Number of letters with which both begin.
fn common(one: &str, other: &str) -> usize {
    let pairs = one.chars().zip(other.chars());
    pairs.take_while(|(a, b)| a == b).count()
}

/// The word of `words` that is most likely meant: [`closest`], else a word that contains the other, for example "rack" and "rack-and-pinion".
pub(crate) fn meant<S: AsRef<str>>(wrong: &str, words: &[S]) -> Option<String> {
    let plain = |word: &str| -> String {
        let letters = word.chars().filter(|c| c.is_alphanumeric());
        letters.flat_map(char::to_lowercase).collect()
    };
    let own = plain(wrong);
    let part = || {
        let long = |word: &str| word.chars().count() >= SHORTEST_PART;
        let words = words.iter().map(AsRef::as_ref).filter(|word: &&str| {
            let other = plain(word);
            long(&own) && long(&other) && (other.contains(&own) || own.contains(&other))
        });
        let near = words.min_by_key(|word| word.chars().count().abs_diff(wrong.chars().count()));
        near.map(ToOwned::to_owned)
    };
    closest(wrong, words).or_else(part)
}

/// Letters of the shortest word that is searched within another.
const SHORTEST_PART: usize = 4;

/// The most words that a message lists.
const MANY: usize = 12;

/// The known words for a message about `wrong`: all of them, or the nearest three and the place where the others are listed.
pub(crate) fn known<S: AsRef<str>>(wrong: &str, words: &[S], place: &str) -> String {
    let mut words: Vec<&str> = words.iter().map(AsRef::as_ref).collect();
    if words.len() <= MANY {
        return words.join(", ");
    }
    let lower = wrong.to_lowercase();
    words.sort_by_key(|word| strsim::damerau_levenshtein(&lower, &word.to_lowercase()));
    let nearest = words.get(..3).unwrap_or_default().join(", ");
    format!("{nearest} and {} others: see {place}", words.len() - 3)
}

/// The beginning of a cure that names the word: `did you mean "…"? `; empty if no word is near.
pub fn did_you_mean<S: AsRef<str>>(wrong: &str, words: &[S]) -> String {
    meant(wrong, words).map_or_else(String::new, |near| format!("did you mean \"{near}\"? "))
}
