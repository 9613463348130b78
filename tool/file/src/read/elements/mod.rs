//! `[[spring]]` and `[[damper]]` between two bodies.

mod end;
mod survey;

use jred::machine::{Element, MAX_ELEMENTS, Marker};

use crate::model::coordinate::Coordinate;
use crate::model::mechanism::{AnyMechanism, NamedElement};
use crate::read::names::Names;
use crate::text::problem::Result;
use crate::text::section::Section;
use crate::units::kind::{STIFFNESS, TORSION_STIFFNESS};

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
    for key in ["spring", "damper"] {
        for section in root.tables(key)? {
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
    let name = section.text("name")?;
    let between = section.need("between")?;
    let list = between.both("end", "[\"slider\", \"ground\"]")?;
    let ends = [end(&list[0], mechanism)?, end(&list[1], mechanism)?];
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
    let given = section.one_of(&["free_length", "free_angle"]);
    let Some((key, free)) = given else {
        return Err(section.missing(
            "free_length",
            "free_length = \"250 mm\", the length without force, or free_angle = \"0 deg\" for a spring in torsion",
        ));
    };
    let torsion = key == "free_angle";
    let kind = if torsion {
        &TORSION_STIFFNESS
    } else {
        &STIFFNESS
    };
    let Some(stiffness) = section.get("stiffness") else {
        return Err(section.missing("stiffness", &format!("stiffness = \"{}\"", kind.example)));
    };
    let stiffness = stiffness.quantity(kind)?.positive()?;
    let free = free.value()?.si;
    let law = if torsion {
        Law::TorsionSpring(stiffness, free)
    } else {
        Law::Spring(stiffness, free)
    };
    Ok((law, torsion))
}

/// The damper, and whether it is one in torsion.
fn damper(section: &Section) -> Result<(Law, bool)> {
    match section.one_of(&["viscous_force", "viscous_moment"]) {
        Some(("viscous_force", force)) => Ok((Law::Damper(force.value()?.si), false)),
        Some((_, moment)) => Ok((Law::TorsionDamper(moment.value()?.si), true)),
        None => Err(section.missing(
            "viscous_force",
            "viscous_force = \"300 N s/m\", or viscous_moment = \"0.4 N m s/rad\" for a damper in torsion",
        )),
    }
}
