//! `type = "friction-drive"`: friction stages with constant ratios, in a chain or in a fan.

use jred::friction::{Arrangement, Flow, FrictionDrive, Stage};

use crate::model::mechanism::AnyMechanism;
use crate::read::variator::{flow, share};
use crate::text::problem::Result;
use crate::text::section::Section;

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let arrangement = section.pick("arrangement", [Arrangement::Chain, Arrangement::Fan])?;
    let mut inertias = vec![section.si("inertia")?];
    let stages = section.tables("stage")?;
    let mut slips = false;
    let mut read = Vec::with_capacity(stages.len());
    for stage in &stages {
        let item = stage.need("ratio")?;
        let ratio = item.figure()?;
        if ratio.abs() < 1e-3 {
            return Err(item
                .problem(&format!("is {ratio}, too close to zero"), "nothing turns")
                .help("write the speed of the second shaft over that of the first; negative if the direction reverses"));
        }
        let slip = stage.get("slip").map_or(Ok(0.0), |item| share(&item))?;
        slips |= slip > 0.0;
        inertias.push(stage.si("inertia")?);
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
        section.chosen(),
        mechanism,
        links,
        bearings.chain(contacts),
    ))
}
