//! `[surroundings]`: ambient conditions of motor and amplifier.

use crate::model::site::Site;
use crate::model::surroundings::Surroundings;

use crate::text::item::Item;
use crate::text::problem::Result;
use crate::text::section::Section;
use crate::units::kind::{ALTITUDE, TEMPERATURE};

/// Range of ambient temperatures of motors (°C).
const TEMPERATURES: [f64; 2] = [-60.0, 300.0];

/// Highest altitude for which the derating rule is valid (m).
const HIGHEST: f64 = 4000.0;

/// Reads the surroundings into the site.
pub(super) fn read(root: &Section, site: &mut Site) -> Result<()> {
    let Some(item) = root.get("surroundings") else {
        return Ok(());
    };
    let section = item.section("[surroundings]".into())?;
    let mut found = Surroundings::default();
    let temperature = |key| section.get(key).map(|item| celsius(&item)).transpose();
    if let Some(ambient) = temperature("ambient")? {
        found.ambient = ambient;
    }
    found.cabinet = temperature("cabinet")?;
    found.resistance_at = temperature("resistance_at")?;
    found.housing = temperature("max_housing")?;
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
    if let Some(altitude) = section.optional("altitude", &ALTITUDE)? {
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

/// A temperature in degrees Celsius.
fn celsius(item: &Item) -> Result<f64> {
    let value = item.quantity(&TEMPERATURE)?;
    let [low, high] = TEMPERATURES;
    if !(low..=high).contains(&value.si) {
        let what = format!(
            "is {}, but must be between {low} degC and {high} degC",
            value.shown()
        );
        return Err(value
            .problem(&what, "out of range")
            .help("check the number"));
    }
    Ok(value.si)
}
