//! `[surroundings]`: ambient conditions of motor and amplifier.

use crate::model::site::Site;
use crate::model::surroundings::Surroundings;

use crate::text::problem::Result;
use crate::text::section::Section;

/// Highest altitude for which the derating rule is valid (m).
const HIGHEST: f64 = 4000.0;

/// Reads the surroundings into the site.
pub(super) fn read(root: &Section, site: &mut Site) -> Result<()> {
    let Some(section) = root.maybe_table("surroundings")? else {
        return Ok(());
    };
    let mut found = Surroundings {
        ambient: section.si("ambient")?,
        cabinet: section.maybe("cabinet")?,
        resistance_at: section.maybe("resistance_at")?,
        housing: section.maybe("max_housing")?,
        ..Surroundings::default()
    };
    if let (Some(limit), Some(item)) = (found.housing, section.peek("max_housing"))
        && limit <= found.ambient
    {
        let what = format!(
            "is {limit} degC, but must be above `ambient`, which is {} degC",
            found.ambient
        );
        return Err(item
            .problem(&what, "too low")
            .help("a motor is never colder than its surroundings: correct one of the two"));
    }
    if let Some(altitude) = section.given("altitude")? {
        found.altitude = altitude.si;
        if !(-500.0..=HIGHEST).contains(&altitude.si) {
            let what = format!(
                "is {}, but must be between -500 m and {}",
                altitude.shown(),
                altitude.show(HIGHEST)
            );
            return Err(altitude.problem(&what, "out of range").help(
                "above 4000 m, ask the maker for motor data and put them into the catalogue",
            ));
        }
    }
    section.finish()?;
    site.surroundings = found;
    Ok(())
}
