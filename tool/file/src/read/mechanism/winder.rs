//! `type = "winder"`: a roll whose radius grows with the web wound onto it.

use std::f64::consts::TAU;

use jred::error::Error;
use jred::machine::{Action, Load};

use super::core;
use crate::model::mechanism::{AnyMechanism, NamedLoad};
use crate::model::winder::{Roll, Winder};
use crate::number::rounding::figure;
use crate::text::problem::Result;
use crate::text::section::Section;

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let (core_section, web) = (section.table("core")?, section.table("web")?);
    let diameter = core_section.value("diameter")?;
    let full = section.value("full_diameter")?;
    if full.si - diameter.si < full.kind.smallest {
        let what = format!(
            "is {}, which is not more than the core's diameter, {}",
            full.shown(),
            diameter.shown()
        );
        return Err(full
            .problem(&what, "nothing is wound")
            .help("give the diameter of the full roll, such as \"800 mm\""));
    }
    // J of the empty roll must be greater than zero.
    let inertia = core_section.si("inertia")?;
    core_section.finish()?;
    let thickness = web.si("thickness")?;
    let width = web.si("width")?;
    let density = web.si("density")?;
    let roll = Roll {
        core: 0.5 * diameter.si,
        full: 0.5 * full.si,
        inertia,
        thickness,
        web: density * width * thickness,
    };
    let loads = pull(&web, &roll)?;
    web.finish()?;
    let winder = Winder::new(roll).map_err(|error| core(section, error))?;
    let names = ["roll", "web", "wound web"];
    let joints = [
        "roll bearing",
        "web guide",
        "web",
        "bearing of wound web",
        "gearing of wound web",
    ];
    Ok(AnyMechanism::new(section.chosen(), winder, names, joints)
        .with_loads(loads)
        .with_fact("turns on the full roll", figure(roll.turned() / TAU))
        .with_fact(
            "web on the full roll",
            format!(
                "{} m, {} kg",
                figure(roll.length()),
                figure(roll.length() * roll.web)
            ),
        ))
}

/// The web's pull F₀·(1 − t·(1 − r₀/r)) as loads: its torque F·r is linear in r, thus a force on the web and a moment on the roll. The kinetic energy
/// that the web brings in at its speed v is a force ½·μ·v² in the opposite direction.
fn pull(web: &Section, roll: &Roll) -> Result<Vec<NamedLoad>> {
    let (tension, taper, speed) = (web.si("tension")?, web.si("taper")?, web.si("speed")?);
    let brought = 0.5 * roll.web * speed * speed;
    let acting = [
        (
            "web tension",
            Winder::WEB,
            Action::Force([brought - tension * (1.0 - taper), 0.0]),
        ),
        (
            "taper of the web tension",
            Winder::ROLL,
            Action::Moment(-tension * taper * roll.core),
        ),
    ];
    let mut loads = Vec::new();
    for (name, link, action) in acting {
        if !matches!(action, Action::Force([0.0, _]) | Action::Moment(0.0)) {
            let load = Load::new(link, action).map_err(|error| core(web, Error::from(error)))?;
            let name = name.to_owned();
            loads.push(NamedLoad { name, load });
        }
    }
    Ok(loads)
}
