//! `[[carriage]]`: a mass that a second axis moves along a guide on a link, while the drive link moves.

use crate::math;
use jred::Domain;
use jred::machine::{Action, Load, MAX_LOADS, Machine};

use super::drive_link::DriveLink;
use super::mass::attached;
use super::mechanism::parts::ends;
use super::motion;
use super::names::Names;
use crate::model::carriage::Carriage;
use crate::model::coordinate::Coordinate;
use crate::model::mechanism::{AnyMechanism, NamedLoad};
use crate::model::motion::Motion;
use crate::number::rounding::figure;
use crate::text::file::Files;
use crate::text::problem::Result;
use crate::text::section::Section;

/// Share of its stroke, and of its largest speed, by which the motion of a carriage may miss its start: rounding.
const CLOSURE_TOLERANCE: f64 = 1e-9;

/// Share of the time of the motion by which two times may differ: rounding.
const SAME_TIME: f64 = 1e-9;

/// Instants at which the largest speed of a carriage is searched.
const INSTANTS: u32 = 1000;

/// The carriages of the file. Each gets its own load, initially without force, after those of the machine.
pub(super) fn read(
    root: &Section,
    files: &dyn Files,
    mut machine: Machine<AnyMechanism>,
    loads: &mut Vec<NamedLoad>,
    of_machine: Option<&Motion>,
) -> Result<(Machine<AnyMechanism>, Vec<Carriage>)> {
    let Some(item) = root.get("carriage") else {
        return Ok((machine, Vec::new()));
    };
    let sections = root.tables("carriage")?;
    let Some(of_machine) = of_machine else {
        return Err(item
            .problem(
                "is given, but the file has no [motion]",
                "at which time is it where?",
            )
            .help("add a [motion] of the drive link: a carriage moves over its time"));
    };
    let mut carriages: Vec<Carriage> = Vec::new();
    // A carriage is also a load, and reports list it with the loads.
    let mut names = Names::of("carriages or loads");
    for section in &root.tables("load")? {
        names.take(section);
    }
    for section in &sections {
        let carriage = carriage(section, files, &machine, loads, of_machine)?;
        let place = (section.peek("name")).map_or_else(|| section.header(), |item| item.span());
        names.add_text(&carriage.name, place)?;
        if loads.len() == MAX_LOADS {
            return Err(section
                .problem(
                    format!("{MAX_LOADS} loads and this carriage are more than {MAX_LOADS} in all"),
                    "one too many",
                )
                .help("combine loads that act on the same link"));
        }
        let load = Load::new(carriage.mass.link, Action::Force([0.0; 2]));
        let load = load.map_err(jred::error::Error::from);
        machine = load
            .and_then(|load| {
                let name = carriage.name.clone();
                loads.push(NamedLoad { name, load });
                Ok(machine.with_load(load)?)
            })
            .map_err(|error| section.error(error, "in this machine"))?;
        carriages.push(carriage);
    }
    Ok((machine, carriages))
}

fn carriage(
    section: &Section,
    files: &dyn Files,
    machine: &Machine<AnyMechanism>,
    loads: &[NamedLoad],
    of_machine: &Motion,
) -> Result<Carriage> {
    let mechanism = machine.mechanism();
    let (name, mass) = attached(section, mechanism, "carriage")?;
    let along = section.si("direction")?;
    let [from, to] = ends(&section.need("stroke")?)?;
    let axis = DriveLink {
        coordinate: Coordinate::Length,
        domain: Domain::Stroke { from, to },
    };
    let own = section.need("motion")?;
    let own = own.section("[carriage.motion]".to_owned())?;
    let motion = motion::along(&own, files, axis, (machine, loads))?;
    section.finish()?;
    fits(&own, &motion, of_machine, to - from)?;
    let link = mechanism.link_names().get(mass.link);
    Ok(Carriage {
        words: format!(
            "moves along {} by its own motion",
            link.map_or("its link", String::as_str)
        ),
        name,
        mass,
        direction: [math::cos(along), math::sin(along)],
        motion,
        load: machine.loads().len(),
    })
}

/// Checks that the motion of a carriage ends with that of the machine, or is at rest before; if the latter repeats, the carriage ends at its start.
fn fits(own: &Section, motion: &Motion, of_machine: &Motion, stroke: f64) -> Result<()> {
    let [lasts, whole] = [motion, of_machine].map(Motion::duration);
    let times = format!(
        "lasts {} s, but [motion] {} s",
        figure(lasts),
        figure(whole)
    );
    if lasts > whole * (1.0 + SAME_TIME) {
        return Err(own
            .problem(format!("[carriage.motion] {times}"), "too long")
            .help("a carriage moves over the time of [motion]: shorten its motion, or add a dwell to [motion]"));
    }
    let [first, last] = [0.0, lasts].map(|t| motion.at(t));
    let place = |k: u32| lasts * f64::from(k) / f64::from(INSTANTS);
    let speeds = (0..=INSTANTS).map(|k| motion.at(place(k)).omega.abs());
    let still = CLOSURE_TOLERANCE * speeds.fold(0.0, f64::max);
    let shorter = lasts < whole * (1.0 - SAME_TIME);
    if shorter && last.omega.abs() > still {
        return Err(own
            .problem(
                format!("[carriage.motion] {times}, and ends at {} m/s", figure(last.omega)),
                "not at rest",
            )
            .help("let it end at rest: it then stands for the rest of [motion]; or give both the same time"));
    }
    if !of_machine.cyclic {
        return Ok(());
    }
    if (last.phi - first.phi).abs() > CLOSURE_TOLERANCE * stroke {
        return Err(own
            .problem(
                format!(
                    "[motion] repeats, but the carriage ends at {} mm and began at {} mm",
                    figure(last.phi * 1e3),
                    figure(first.phi * 1e3)
                ),
                "does not come back",
            )
            .help("add a move back, or write type = \"point-to-point\" in [motion]"));
    }
    let next = if shorter { 0.0 } else { last.omega };
    if (next - first.omega).abs() > still {
        return Err(own
            .problem(
                format!(
                    "[motion] repeats, but the carriage ends at {} m/s and begins at {} m/s",
                    figure(next),
                    figure(first.omega)
                ),
                "its speed jumps",
            )
            .help("let it begin and end at the same speed, or at rest"));
    }
    Ok(())
}
