//! Project files: several machine files with one supply.

use std::path::Path;

use super::{document, supply, surroundings, title};
use crate::keys::PROJECT;
use crate::model::project::{Project, ProjectAxis};
use crate::model::site::Site;
use crate::plain;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::text::tree;

/// Reads a project file from its `text`; `name` is its name in messages.
///
/// # Errors
/// The first fault in the file, with its place and a cure.
pub fn project(name: &str, text: &str) -> Result<Project> {
    parse(name, text).map_err(|problem| problem.in_text(name, text))
}

fn parse(name: &str, text: &str) -> Result<Project> {
    let tree = tree::parse(text)?;
    if tree.get_ref().contains_key("mechanism") {
        return Err(
            Problem::new(format!("{name} is a machine file, not a project")).help(
                "size it with `jred size`, or name it in a project: [[axis]] with machine = \"…\"",
            ),
        );
    }
    let root = Section::described(String::new(), 0..0, tree.get_ref(), (&PROJECT, false));
    let title = title(&root, name)?;
    let common_bus = root.word("bus")? == 0;
    let document = document::read(&root)?;
    let mut site = Site::default();
    supply::read(&root, &mut site)?;
    surroundings::read(&root, &mut site)?;
    let mut axes: Vec<ProjectAxis> = Vec::new();
    for section in root.tables("axis")? {
        let machine = section.need("machine")?.words_of_text()?.to_owned();
        let stem = Path::new(&machine).file_stem().map(plain::path);
        let axis = ProjectAxis {
            name: section
                .text("name")?
                .map_or(stem.unwrap_or_default(), str::to_owned),
            quantity: section.whole("quantity")?,
            phase: section.maybe("phase")?,
            drive: section.text("drive")?.map(str::to_owned),
            machine,
        };
        if axes.iter().any(|other| other.name == axis.name) {
            let what = format!("two axes are called \"{}\"", axis.name);
            return Err(section.problem(what, "the second").help(
                "give each [[axis]] a `name` of its own, or `quantity` for equal axes that move alike",
            ));
        }
        if let Some(first) = axes.first()
            && first.phase.is_some() != axis.phase.is_some()
        {
            return Err(section
                .problem("`phase` is given for some axes and not for all", "differs from the first axis")
                .help("give `phase` for every axis, such as phase = \"0 s\"; or remove it from all: then the worst phases are searched"));
        }
        section.finish()?;
        axes.push(axis);
    }
    root.finish()?;
    Ok(Project {
        name: name.to_owned(),
        title,
        document,
        common_bus,
        site,
        axes,
    })
}
