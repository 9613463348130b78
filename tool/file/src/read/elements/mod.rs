//! `[[spring]]` and `[[damper]]` between two bodies.

mod end;
mod survey;

use jred::machine::{Element, MAX_ELEMENTS, Marker};

use crate::model::coordinate::Coordinate;
use crate::model::mechanism::{AnyMechanism, NamedElement};
use crate::read::names::Names;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::units::kind::{
    ANGLE, LENGTH, STIFFNESS, TORSION_STIFFNESS, VISCOUS_FORCE, VISCOUS_MOMENT,
};

use end::end;
use survey::Survey;

/// All springs, then all dampers of the file.
pub(super) fn read(
    root: &Section,
    mechanism: &AnyMechanism,
    coordinate: Coordinate,
) -> Result<Vec<NamedElement>> {
    let mut elements = mechanism.own_elements().to_vec();
    let mut names = Names::of("springs or dampers");
    for (key, title) in [("spring", "[[spring]]"), ("damper", "[[damper]]")] {
        let Some(item) = root.get(key) else {
            continue;
        };
        for section in item.sections(title)? {
            if elements.len() == MAX_ELEMENTS {
                return Err(section
                    .problem(
                        format!("more than {MAX_ELEMENTS} springs and dampers in total"),
                        "one too many",
                    )
                    .help("combine parallel ones: add their stiffnesses"));
            }
            names.add(&section)?;
            elements.push(element(&section, key, mechanism, coordinate)?);
        }
    }
    Ok(elements)
}

fn element(
    section: &Section,
    key: &'static str,
    mechanism: &AnyMechanism,
    coordinate: Coordinate,
) -> Result<NamedElement> {
    let name = section
        .get("name")
        .map(|item| item.text("counterbalance"))
        .transpose()?;
    let between = section.require(
        "between",
        "between = [\"slider\", { on = \"ground\", at = [\"0 mm\", \"400 mm\"] }]",
    )?;
    let list = between.list("end", "[\"slider\", \"ground\"]")?;
    let [first, second] = list.as_slice() else {
        let count = list.len();
        return Err(between
            .problem(&format!("has {count} ends, but must have two"), "here")
            .help(format!("a {key} acts between two points or two bodies")));
    };
    let ends = [end(first, mechanism)?, end(second, mechanism)?];
    if ends[0].marker.body == ends[1].marker.body {
        return Err(between
            .problem(
                &format!("names one body twice: the {key} does nothing"),
                "the same body",
            )
            .help(format!(
                "a {key} acts between two different bodies, or a body and the ground"
            )));
    }
    let (law, torsion) = if key == "spring" {
        spring(section)?
    } else {
        damper(section)?
    };
    section.finish()?;
    if torsion && let Some((end, item)) = ends.iter().zip(&list).find(|(end, _)| end.point) {
        return Err(item
            .problem(
                &format!(
                    "is the point {}, but a {key} in torsion acts between bodies",
                    end.text
                ),
                "a point",
            )
            .help("name the two bodies alone, such as between = [\"ground\", \"rocker\"]"));
    }
    let markers = [ends[0].marker, ends[1].marker];
    let element = law
        .element(markers)
        .map_err(|error| section.error(error, &format!("in this {key}")))?;
    Survey {
        section,
        between: &between,
        key,
        coordinate,
        torsion,
    }
    .check(&element, mechanism)?;
    let name = name.map_or_else(
        || format!("{key} from {} to {}", ends[0].text, ends[1].text),
        ToOwned::to_owned,
    );
    Ok(NamedElement { name, element })
}

/// Law of an element, before its ends are known.
enum Law {
    Spring(f64, f64),
    TorsionSpring(f64, f64),
    Damper(f64),
    TorsionDamper(f64),
}

impl Law {
    fn element(
        &self,
        between: [Marker; 2],
    ) -> std::result::Result<Element, jred::number::RangeError> {
        match *self {
            Self::Spring(stiffness, free) => Element::spring(between, stiffness, free),
            Self::TorsionSpring(stiffness, free) => {
                Element::torsion_spring(between, stiffness, free)
            }
            Self::Damper(coefficient) => Element::damper(between, coefficient),
            Self::TorsionDamper(coefficient) => Element::torsion_damper(between, coefficient),
        }
    }
}

/// The spring, and whether it is one in torsion.
fn spring(section: &Section) -> Result<(Law, bool)> {
    section.expects(&["stiffness"]);
    match (section.get("free_length"), section.get("free_angle")) {
        (Some(length), None) => {
            let stiffness = section.quantity("stiffness", &STIFFNESS)?.positive()?;
            let length = length.quantity(&LENGTH)?.not_negative()?;
            Ok((Law::Spring(stiffness, length), false))
        }
        (None, Some(angle)) => {
            let stiffness = section.quantity("stiffness", &TORSION_STIFFNESS)?.positive()?;
            Ok((Law::TorsionSpring(stiffness, angle.quantity(&ANGLE)?.si), true))
        }
        (Some(length), Some(angle)) => Err(Problem::new(format!(
            "{} has both `free_length` and `free_angle`",
            section.title()
        ))
        .at(length.key_span(), "of a spring along a line")
        .at(angle.key_span(), "of a spring in torsion")
        .help("keep one of them")),
        (None, None) => Err(section.missing(
            "free_length",
            "free_length = \"250 mm\", the length without force, or free_angle = \"0 deg\" for a spring in torsion",
        )),
    }
}

/// The damper, and whether it is one in torsion.
fn damper(section: &Section) -> Result<(Law, bool)> {
    match (section.get("viscous_force"), section.get("viscous_moment")) {
        (Some(force), None) => {
            let coefficient = force.quantity(&VISCOUS_FORCE)?.positive()?;
            Ok((Law::Damper(coefficient), false))
        }
        (None, Some(moment)) => {
            let coefficient = moment.quantity(&VISCOUS_MOMENT)?.positive()?;
            Ok((Law::TorsionDamper(coefficient), true))
        }
        (Some(force), Some(moment)) => Err(Problem::new(format!(
            "{} has both `viscous_force` and `viscous_moment`",
            section.title()
        ))
        .at(force.key_span(), "along a line")
        .at(moment.key_span(), "in torsion")
        .help("write a separate [[damper]] for each")),
        (None, None) => Err(section.missing(
            "viscous_force",
            "viscous_force = \"300 N s/m\", or viscous_moment = \"0.4 N m s/rad\" for a damper in torsion",
        )),
    }
}
