//! `[duty]`: the durations of operation and rest, and emergency stops.

use crate::model::operation::{Duty, Operation};
use crate::model::site::Site;

use crate::text::problem::Result;
use crate::text::section::Section;
use crate::text::value::Value;

/// Reads the operation into the site.
pub(super) fn read(root: &Section, site: &mut Site) -> Result<()> {
    let Some(section) = root.maybe_table("duty")? else {
        return Ok(());
    };
    let is_named = section.get("type").is_some();
    let number = section.word("type")? as u8 + 1;
    let stops = section.get("emergency_stops");
    site.emergency_stops = stops.map(|item| item.figure()).transpose()?;
    site.drive_stop = section.maybe("drive_stop")?;
    let (operating, rest) = (section.given("operating_time")?, section.given("rest")?);
    let at_rest = section.get("at_rest");
    let unused = |value: &Value, why: &str| {
        value
            .problem(&format!("is not used with S{number}: {why}"), "not used")
            .help("remove it, or choose the type that uses it: S2 runs once from cold, S3 to S5 alternate operation and rest")
    };
    let operation = match number {
        2 => {
            if let Some(rest) = &rest {
                return Err(unused(
                    rest,
                    "after each run, the motor cools down completely",
                ));
            }
            let operating = operating.ok_or_else(|| {
                section.missing(
                    "operating_time",
                    "operating_time = \"600 s\", how long the machine runs from cold",
                )
            })?;
            Operation::Short {
                operating: operating.si,
            }
        }
        3..=5 if operating.is_some() || rest.is_some() => {
            let both = "operating_time and rest of a period, such as \"360 s\" and \"240 s\"; neither of them if the motion contains the rests";
            let operating = operating.ok_or_else(|| section.missing("operating_time", both))?;
            let rest = rest.ok_or_else(|| section.missing("rest", both))?;
            let holding = section.word("at_rest")? == 1;
            Operation::Intermittent {
                operating: operating.si,
                rest: rest.si,
                holding,
            }
        }
        _ => {
            if let Some(value) = operating.as_ref().or(rest.as_ref()) {
                return Err(unused(value, "the motion repeats without end"));
            }
            Operation::Continuous
        }
    };
    if let Some(item) = at_rest
        && !matches!(operation, Operation::Intermittent { .. })
    {
        return Err(item
            .problem(
                "is only used together with `rest`, which is missing",
                "not used",
            )
            .help("remove it, or give operating_time and rest"));
    }
    section.finish()?;
    site.duty = Duty {
        operation,
        kind: is_named.then_some(number),
    };
    Ok(())
}
