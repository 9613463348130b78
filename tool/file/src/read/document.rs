//! `[document]`: the title block of reports.

use crate::model::document::Document;
use crate::text::problem::Result;
use crate::text::section::Section;

/// The section, if the file has it.
pub(super) fn read(root: &Section) -> Result<Document> {
    let Some(section) = root.maybe_table("document")? else {
        return Ok(Document::default());
    };
    let text = |key| Ok(section.text(key)?.unwrap_or_default().to_owned());
    let document = Document {
        project: text("project")?,
        customer: text("customer")?,
        author: text("author")?,
        revision: text("revision")?,
        date: text("date")?,
    };
    section.finish()?;
    Ok(document)
}
