//! The title block of a document.

/// Entries of the title block, as the user wrote them; empty: not given.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Document {
    /// Project or order.
    pub project: String,
    /// Customer.
    pub customer: String,
    /// Author.
    pub author: String,
    /// Revision of the document.
    pub revision: String,
    /// Date of the document.
    pub date: String,
}

impl Document {
    /// The entries that are given, each with its name.
    pub fn entries(&self) -> impl Iterator<Item = (&'static str, &str)> {
        let all = [
            ("project", &self.project),
            ("customer", &self.customer),
            ("author", &self.author),
            ("revision", &self.revision),
            ("date", &self.date),
        ];
        let all = all.into_iter().map(|(name, text)| (name, text.as_str()));
        all.filter(|(_, text)| !text.is_empty())
    }
}
