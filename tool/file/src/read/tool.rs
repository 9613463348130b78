//! `[tool]`: the point or link where backlash matters, and the backlash allowed there.

use jred::machine::Mechanism as _;

use crate::model::coordinate;
use crate::model::mechanism::AnyMechanism;
use crate::model::site::{Tool, ToolPlace};

use crate::text::item::Item;
use crate::text::problem::Result;
use crate::text::section::Section;

/// A tool slower than this (m or rad per rad or m of the drive link) does not move.
const STANDSTILL: f64 = 1e-9;

/// Number of positions at which the motion of the tool is checked.
const POSITIONS: usize = 64;

/// The section, if the file has it.
pub(super) fn read(root: &Section, mechanism: &AnyMechanism) -> Result<Option<Tool>> {
    let Some(section) = root.maybe_table("tool")? else {
        return Ok(None);
    };
    let (point, link) = (section.get("point"), section.get("link"));
    let tool = match (&point, &link) {
        (Some(point), _) => of_point(&section, point, mechanism)?,
        (None, Some(link)) => {
            let index = link.choice(mechanism.link_names())?;
            section.set_slides(false);
            let play = section.si("play")?;
            Tool {
                name: link.words_of_text()?.to_owned(),
                link: index,
                place: ToolPlace::Turning,
                play,
            }
        }
        (None, None) => {
            return Err(section
                .problem("[tool] names neither `point` nor `link`", "incomplete")
                .help("add point = \"slider\", a named point or link, or link = \"table\", a link that turns"));
        }
    };
    section.finish()?;
    if let Some(named) = point.or(link).filter(|_| !moves(&tool, mechanism)) {
        let what = match tool.place {
            ToolPlace::Point(_) => {
                "does not move with the drive link, so backlash has no effect there"
            }
            ToolPlace::Turning => {
                "does not turn with the drive link, so backlash has no effect there"
            }
        };
        return Err(named
            .problem(what, "stands")
            .help("name the point or link that does the machine's work; for a link, at = [\"40 mm\", \"0 mm\"] gives the point on it"));
    }
    Ok(Some(tool))
}

fn of_point(section: &Section, item: &Item, mechanism: &AnyMechanism) -> Result<Tool> {
    let (name, link, at) = place(section, item, mechanism)?;
    section.set_slides(true);
    Ok(Tool {
        name,
        link,
        place: ToolPlace::Point(at),
        play: section.si("play")?,
    })
}

/// A named point, or the point `at` of a link: its name, its link, and its position on the link.
pub(super) fn place(
    section: &Section,
    item: &Item,
    mechanism: &AnyMechanism,
) -> Result<(String, usize, [f64; 2])> {
    let points = mechanism.points();
    let mut names: Vec<&str> = points.iter().map(|point| point.name.as_str()).collect();
    names.extend(mechanism.link_names().iter().map(String::as_str));
    let index = item.choice(&names)?;
    let name = names.get(index).copied().unwrap_or_default().to_owned();
    let at = section.get("at");
    match (points.get(index), &at) {
        (Some(point), None) => Ok((name, point.link, point.at)),
        (Some(_), Some(at)) => Err(at
            .problem(
                "is given for a point whose place is already defined",
                "remove this",
            )
            .help("`at` gives a point on a link")),
        (None, _) => Ok((name, index - points.len(), section.two("at")?)),
    }
}

/// Whether the tool moves anywhere in the drive link's range.
fn moves(tool: &Tool, mechanism: &AnyMechanism) -> bool {
    coordinate::positions(mechanism.domain(), POSITIONS).any(|phi| {
        let Ok(frames) = mechanism.frames(phi) else {
            return false;
        };
        frames.get(tool.link).is_some_and(|frame| match tool.place {
            ToolPlace::Point(at) => frame.point(at).iter().any(|x| x.d1.abs() > STANDSTILL),
            ToolPlace::Turning => frame.psi.d1.abs() > STANDSTILL,
        })
    })
}
