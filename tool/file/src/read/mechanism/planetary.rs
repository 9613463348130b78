//! `type = "planetary"`.

use jred::machine::Link;
use jred::mechanism::{
    BuildError, DimensionError, Member, Planetary, PlanetaryDimensions, PlanetaryGears,
};

use super::{core, parts};
use crate::model::mechanism::AnyMechanism;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::units::kind::LENGTH;

const MEMBERS: [(&str, Member); 3] = [
    ("sun", Member::Sun),
    ("carrier", Member::Carrier),
    ("ring", Member::Ring),
];

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let input = member(section, "input", "sun")?;
    let fixed = member(section, "fixed", "ring")?;
    if input == fixed {
        return Err(section
            .problem(
                "the input of the planetary gear is fixed",
                "`input` and `fixed` are the same",
            )
            .help("choose two different members: the third is the output"));
    }
    let centres = section.quantity("centre_distance", &LENGTH)?.positive()?;
    let sections = [
        section.section("sun")?,
        section.section("carrier")?,
        section.section("ring")?,
        section.section("planets")?,
    ];
    let [sun, carrier, ring, planets] = &sections;
    let (sun_teeth, ring_teeth) = (teeth(sun)?, teeth(ring)?);
    let count = planets.require("count", "count = 3")?.count(1000, "3")?;
    let planet_teeth = match planets.get("teeth") {
        Some(item) => item.count(PlanetaryGears::MAX_TEETH, "20")?,
        None => ring_teeth.saturating_sub(sun_teeth) / 2,
    };
    let at = |member: Member, section: &Section| {
        if member == fixed && section.get("inertia").is_none() {
            let mass = parts::mass(section)?;
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
        AnyMechanism::new(super::PLANETARY, mechanism, names, joints).with_point(
            "P",
            Planetary::PLANETS,
            [0.0, 0.0],
        ),
    )
}

fn member(section: &Section, key: &'static str, example: &str) -> Result<Member> {
    let words = MEMBERS.map(|(name, _)| name);
    let index = section
        .require(key, &format!("{key} = \"{example}\""))?
        .choice(&words)?;
    Ok(MEMBERS
        .get(index)
        .map_or(Member::Sun, |(_, member)| *member))
}

fn teeth(section: &Section) -> Result<u32> {
    let item = section.require("teeth", "teeth = 24")?;
    let teeth = item.count(PlanetaryGears::MAX_TEETH, "24")?;
    let least = PlanetaryGears::MIN_TEETH;
    if teeth < least {
        let what = format!("is {teeth}, but must be at least {least}");
        return Err(item
            .problem(&what, "too few")
            .help("write the number of teeth of the gear"));
    }
    Ok(teeth)
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
