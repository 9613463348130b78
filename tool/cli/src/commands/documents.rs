//! Documents of an answer: page, PDF and workbook.

use miette::Result;

use crate::browser;
use crate::busy;
use crate::commands::{Completion, print_answer};
use crate::options::documents::Documents;
use crate::output::Files;
use jred_file::plain;
use jred_report::answer::Answer;
use jred_report::table::output::Format;

/// Writes the requested documents with the other files of a result. Returns sentences about them, and the error if no browser prints the page: the
/// other files are written nevertheless, and the answer is printed before the error.
///
/// # Errors
/// Those of page and answer; a file that cannot be written.
pub(super) fn write<'a>(
    options: &Documents,
    mut files: Files,
    page: impl FnOnce() -> Result<String>,
    answer: impl FnOnce() -> Result<Answer<'a>>,
) -> Result<(Vec<String>, Result<()>)> {
    let is_page = options.report.is_some() || options.pdf.is_some();
    let page = if is_page { page()? } else { String::new() };
    let page = options.paper.unwrap_or_default().page(page);
    if let Some(path) = &options.report {
        files.add(path, page.as_bytes())?;
    }
    if let Some(path) = &options.xlsx {
        files.add(path, &answer()?.workbook()?)?;
    }
    let printed = options.pdf.as_ref().map_or(Ok(()), |path| {
        busy::begin("printing the page");
        let pdf = browser::pdf(&page, path)?;
        files.add(path, &pdf)
    });
    files.finish()?;
    let pdf = options.pdf.as_ref().filter(|_| printed.is_ok()).cloned();
    let written = [
        ("report", &options.report),
        ("PDF", &pdf),
        ("workbook", &options.xlsx),
    ];
    let written = written.into_iter().filter_map(|(what, path)| {
        let path = plain::path(path.as_ref()?);
        Some(format!("{what} written to {path}"))
    });
    Ok((written.collect(), printed))
}

/// Writes the requested documents of an answer, and prints it with sentences about them; then the error if no browser prints the page.
///
/// # Errors
/// As [`write()`]; no browser prints the page.
pub(super) fn finish(
    options: &Documents,
    mut answer: Answer,
    page: impl FnOnce() -> Result<String>,
    format: Format,
) -> Result<Completion> {
    let workbook = || Ok(answer.clone());
    let (lines, printed) = write(options, Files::default(), page, workbook)?;
    for line in lines {
        answer.sentence(line);
    }
    let done = print_answer(&answer, format)?;
    printed.map(|()| done)
}
