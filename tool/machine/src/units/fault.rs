//! What is wrong with a value as it was written, and what to do about it.

/// The fault of a value, before its key is known.
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

/// The word that `wrong` is most likely a misspelling of.
pub fn closest<S: AsRef<str>>(wrong: &str, words: &[S]) -> Option<String> {
    let lower = wrong.to_lowercase();
    let allowed = (lower.chars().count() / 3).clamp(1, 3);
    let distance = |word: &str| strsim::damerau_levenshtein(&lower, &word.to_lowercase());
    words
        .iter()
        .map(|w| (distance(w.as_ref()), w.as_ref()))
        .filter(|(distance, _)| *distance <= allowed)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, word)| word.to_owned())
}
