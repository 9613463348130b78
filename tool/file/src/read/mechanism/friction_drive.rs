//! `type = "friction-drive"`: friction stages with constant ratios, in a chain or in a fan.

use jred::friction::{Arrangement, Flow, FrictionDrive, Stage};

use crate::model::mechanism::AnyMechanism;
use crate::read::variator::{flow, share};
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::units::kind::INERTIA;

/// Ratios outside this range are refused as mistakes.
const RATIOS: [f64; 2] = [-1e3, 1e3];

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let arrangements = ["chain", "fan"];
    let arrangement = match section
        .require("arrangement", "arrangement = \"chain\" or \"fan\"")?
        .choice(&arrangements)?
    {
        0 => Arrangement::Chain,
        _ => Arrangement::Fan,
    };
    let mut inertias = vec![section.quantity("inertia", &INERTIA)?.not_negative()?];
    let item = section.require(
        "stage",
        "[[mechanism.stage]] with ratio = 0.5 and inertia = \"20 kg cm^2\"",
    )?;
    let stages = item.sections("[[mechanism.stage]]")?;
    if stages.is_empty() {
        return Err(item
            .problem("is empty", "here")
            .help("a friction drive has at least one stage"));
    }
    if let Some(surplus) = stages.get(jred::machine::MAX_STAGES) {
        let most = jred::machine::MAX_STAGES;
        return Err(
            Problem::new(format!("more than {most} friction stages")).at(
                surplus.header(),
                format!("stage {} of {}", most + 1, stages.len()),
            ),
        );
    }
    let mut slips = false;
    let mut read = Vec::with_capacity(stages.len());
    for stage in &stages {
        stage.expects(&["ratio", "slip", "inertia"]);
        let item = stage.require(
            "ratio",
            "ratio = 0.5, the speed of the second shaft over that of the first",
        )?;
        let ratio = item.number(RATIOS, "0.5")?;
        if ratio.abs() < 1e-3 {
            return Err(item
                .problem(&format!("is {ratio}, too close to zero"), "nothing turns")
                .help("write the speed of the second shaft over that of the first; negative if the direction reverses"));
        }
        let slip = stage.get("slip").map_or(Ok(0.0), |item| share(&item))?;
        slips |= slip > 0.0;
        inertias.push(stage.quantity("inertia", &INERTIA)?.not_negative()?);
        stage.finish()?;
        read.push((stage, ratio, slip));
    }
    let flow = if slips || section.peek("power_flow").is_some() {
        flow(
            section,
            "slip always slows down the driven shaft: say which shaft drives",
        )?
    } else {
        Flow::default()
    };
    let built = |(stage, ratio, slip): (&Section, f64, f64)| {
        Stage::new(ratio)
            .and_then(|built| built.with_slip(slip, flow))
            .map_err(|error| super::core(stage, error))
    };
    let built: Vec<Stage> = read.into_iter().map(built).collect::<Result<_>>()?;
    let mechanism = FrictionDrive::new(arrangement, &built, &inertias)
        .map_err(|error| super::core(section, error))?;
    let shafts = inertias.len();
    let links = (1..=shafts).map(|k| format!("shaft-{k}"));
    let bearings = (1..=shafts).map(|k| format!("bearings of shaft-{k}"));
    let contacts = (1..shafts).map(|k| format!("contact {k}"));
    Ok(AnyMechanism::new(
        super::FRICTION_DRIVE,
        mechanism,
        links,
        bearings.chain(contacts),
    ))
}
