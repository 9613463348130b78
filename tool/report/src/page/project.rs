//! The document of a project: all axes, their parts and their bus, then each axis. Alternatives of an axis are in its own report.

use jred::error::Error;
use jred_file::model::rules::RuleSet;

use super::section::{Page, Section};
use super::{class, drive_pages, rule_sources};
use crate::answer::Block;
use crate::list::project::ProjectView;

/// The document of a project.
///
/// # Errors
/// Those of the machines.
pub fn project_page(shown: &ProjectView) -> Result<String, Error> {
    let mut sections = Vec::new();
    let mut sets: Vec<&RuleSet> = Vec::new();
    let mut sources = Vec::new();
    for axis in &shown.axes {
        let Some(drive) = drive_pages(&axis.source, axis.listing, false)? else {
            continue;
        };
        let name = &axis.axis.name;
        sections.push(Section {
            heading: format!("Axis {name}: {}", axis.listing.file.title),
            blocks: drive.first.iter().map(Block::shown).collect(),
            ..Section::default()
        });
        sections.extend(drive.sections.into_iter().map(|section| Section {
            heading: format!("{name}: {}", section.heading),
            ..section
        }));
        let rules = axis.listing.selection.rules;
        if !sets.contains(&rules) {
            sets.push(rules);
            sources.push(rule_sources(rules, drive.words));
        }
    }
    sections.append(&mut sources);
    let answer = shown.answer();
    let page = Page {
        title: &shown.project.title,
        subject: "project",
        about: String::new(),
        version: env!("CARGO_PKG_VERSION"),
        file: &shown.project.name,
        class: class(shown.holds()),
        blocks: answer.shown(),
        sections,
    };
    Ok(page.html("Drives of all axes, their parts and their supply"))
}
