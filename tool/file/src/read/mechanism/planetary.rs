//! `type = "planetary"`.

use jred::machine::Link;
use jred::mechanism::{
    BuildError, DimensionError, Member, Planetary, PlanetaryDimensions, PlanetaryGears,
};

use super::{core, parts};
use crate::model::mechanism::AnyMechanism;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;

const MEMBERS: [Member; 3] = [Member::Sun, Member::Carrier, Member::Ring];

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let input = section.pick("input", MEMBERS)?;
    let fixed = section.pick("fixed", MEMBERS)?;
    if input == fixed {
        return Err(section
            .problem(
                "the input of the planetary gear is fixed",
                "`input` and `fixed` are the same",
            )
            .help("choose two different members: the third is the output"));
    }
    let centres = section.si("centre_distance")?;
    let sun = &section.table("sun")?;
    let carrier = &section.table("carrier")?;
    let ring = &section.table("ring")?;
    let planets = &section.table("planets")?;
    let (sun_teeth, ring_teeth) = (sun.whole("teeth")?, ring.whole("teeth")?);
    let count = planets.whole("count")?;
    let planet_teeth = match planets.get("teeth") {
        Some(item) => item.whole()?,
        None => ring_teeth.saturating_sub(sun_teeth) / 2,
    };
    let at = |member: Member, section: &Section| {
        if member == fixed && section.get("inertia").is_none() {
            let mass = section.si("mass")?;
            section.finish()?;
            return Link::point_mass(mass).map_err(|error| core(section, error));
        }
        parts::wheel(section)
    };
    let links = [
        at(Member::Sun, sun)?,
        at(Member::Carrier, carrier)?,
        at(Member::Ring, ring)?,
        parts::wheel(planets)?,
    ];
    let gears = PlanetaryGears::new(PlanetaryDimensions {
        sun: sun_teeth,
        planet: planet_teeth,
        ring: ring_teeth,
        planets: count,
        centres,
    })
    .map_err(|error| unfit(section, planets, error))?;
    let mechanism =
        Planetary::new(gears, input, fixed, links).map_err(|error| core(section, error))?;
    let names = ["sun", "carrier", "ring", "planets"];
    let joints = [
        "sun bearing",
        "carrier bearing",
        "ring bearing",
        "planet pins, tangential",
        "planet pins, radial",
        "sun mesh",
        "ring mesh",
    ];
    Ok(
        AnyMechanism::new(section.chosen(), mechanism, names, joints).with_point(
            "P",
            Planetary::PLANETS,
            [0.0, 0.0],
        ),
    )
}

/// Gears that do not fit together; shown at the planets.
fn unfit(section: &Section, planets: &Section, error: BuildError) -> Problem {
    let help = match error {
        BuildError::Dimensions(DimensionError::PlanetTeeth { .. }) => {
            "correct one of the three numbers of teeth, or remove `teeth` of the planets"
        }
        BuildError::Dimensions(DimensionError::PlanetSpacing { .. }) => {
            "change the number of planets or the numbers of teeth"
        }
        BuildError::Dimensions(DimensionError::PlanetsOverlap { .. }) => {
            "use fewer or smaller planets"
        }
        _ => return core(section, error),
    };
    planets
        .problem(error.to_string(), "these planets")
        .help(help)
}
