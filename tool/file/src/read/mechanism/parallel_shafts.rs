//! `type = "parallel-shafts"`.

use jred::mechanism::{DrivenShaft, ParallelShafts};

use super::{core, parts};
use crate::model::mechanism::AnyMechanism;
use crate::text::problem::Result;
use crate::text::section::Section;

/// Smallest ratio in either direction.
const SMALLEST: f64 = 1e-4;

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let drive = parts::wheel(&section.table("drive")?)?;
    let mut names = vec!["drive".to_owned()];
    let mut driven = Vec::new();
    for section in &section.tables("driven")? {
        let (name, shaft) = shaft(section, &names)?;
        names.push(name);
        driven.push(shaft);
    }
    let mechanism = ParallelShafts::new(drive, &driven).map_err(|error| core(section, error))?;
    let bearings = names.iter().map(|name| format!("bearings of {name}"));
    let transmissions = names.iter().skip(1).map(|name| format!("drive of {name}"));
    let joints: Vec<String> = bearings.chain(transmissions).collect();
    Ok(AnyMechanism::new(
        section.chosen(),
        mechanism,
        names,
        joints,
    ))
}

/// A driven shaft with its name, which must differ from those before it.
fn shaft(section: &Section, names: &[String]) -> Result<(String, DrivenShaft)> {
    let name = match section.get("name") {
        Some(item) => {
            let name = item.words_of_text()?;
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
    let item = section.need("ratio")?;
    let ratio = item.figure()?;
    if ratio.abs() < SMALLEST {
        let what = format!("is {ratio}, so the shaft could not turn");
        return Err(item.problem(&what, "too small").help(
            "write the speed of the drive shaft over the speed of this shaft; negative if it turns the other way",
        ));
    }
    let link = parts::wheel(section)?;
    Ok((name, DrivenShaft { ratio, link }))
}
