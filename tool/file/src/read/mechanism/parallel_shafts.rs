//! `type = "parallel-shafts"`.

use jred::mechanism::{DrivenShaft, ParallelShafts};

use super::{core, parts};
use crate::model::mechanism::AnyMechanism;
use crate::text::problem::Result;
use crate::text::section::Section;

/// Largest ratio in either direction.
const LARGEST: f64 = 1e4;

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let drive = parts::wheel(&section.section("drive")?)?;
    let title = "[[mechanism.driven]]";
    let item = section.require(
        "driven",
        &format!("{title} with ratio = 2.5 and inertia = \"12 kg cm^2\""),
    )?;
    let sections = item.sections(title)?;
    if sections.is_empty() {
        return Err(item
            .problem("is empty", "here")
            .help("a drive shaft has at least one driven shaft"));
    }
    if let Some(surplus) = sections.get(ParallelShafts::MAX_DRIVEN) {
        let most = ParallelShafts::MAX_DRIVEN;
        return Err(surplus
            .problem(format!("more than {most} driven shafts"), "one too many")
            .help("combine shafts with the same ratio: add their inertias"));
    }
    let mut names = vec!["drive".to_owned()];
    let mut driven = Vec::new();
    for section in &sections {
        let (name, shaft) = shaft(section, &names)?;
        names.push(name);
        driven.push(shaft);
    }
    let mechanism = ParallelShafts::new(drive, &driven).map_err(|error| core(section, error))?;
    let bearings = names.iter().map(|name| format!("bearings of {name}"));
    let transmissions = names.iter().skip(1).map(|name| format!("drive of {name}"));
    let joints: Vec<String> = bearings.chain(transmissions).collect();
    Ok(AnyMechanism::new(
        super::PARALLEL_SHAFTS,
        mechanism,
        names,
        joints,
    ))
}

/// A driven shaft with its name, which must differ from those before it.
fn shaft(section: &Section, names: &[String]) -> Result<(String, DrivenShaft)> {
    let name = match section.get("name") {
        Some(item) => {
            let name = item.text("fan")?;
            if names.iter().any(|other| other == name) {
                let what = format!("is \"{name}\", the name of another shaft");
                return Err(item
                    .problem(&what, "twice")
                    .help("give every shaft a unique name"));
            }
            name.to_owned()
        }
        None => format!("driven-{}", names.len()),
    };
    let item = section.require("ratio", "ratio = 2.5")?;
    let ratio = item.number([-LARGEST, LARGEST], "2.5")?;
    if ratio.abs() < 1.0 / LARGEST {
        let what = format!("is {ratio}, so the shaft could not turn");
        return Err(item.problem(&what, "too small").help(
            "write the speed of the drive shaft over the speed of this shaft; negative if it turns the other way",
        ));
    }
    let link = parts::wheel(section)?;
    Ok((name, DrivenShaft { ratio, link }))
}
