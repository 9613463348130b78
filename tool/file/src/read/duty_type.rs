//! `[duty]`: the durations of operation and rest.

use crate::model::operation::{Duty, Operation};
use crate::model::site::Site;

use crate::text::item::Value;
use crate::text::problem::Result;
use crate::text::section::Section;
use crate::units::kind::TIME;

/// The named duty types.
const TYPES: [&str; 9] = ["S1", "S2", "S3", "S4", "S5", "S6", "S7", "S8", "S9"];

/// Reads the operation into the site.
pub(super) fn read(root: &Section, site: &mut Site) -> Result<()> {
    let Some(item) = root.get("duty") else {
        return Ok(());
    };
    let section = item.section("[duty]".into())?;
    section.expects(&["type", "operating_time", "rest", "at_rest"]);
    let example = "type = \"S3\"; S1 to S9 of IEC 60034-1";
    let named = section.require("type", example)?;
    let number = named.choice(&TYPES)? as u8 + 1;
    let operating = section.optional("operating_time", &TIME)?;
    let rest = section.optional("rest", &TIME)?;
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
                operating: operating.positive()?,
            }
        }
        3..=5 if operating.is_some() || rest.is_some() => {
            let both = "operating_time and rest of a period, such as \"360 s\" and \"240 s\"; neither of them if the motion contains the rests";
            let operating = operating.ok_or_else(|| section.missing("operating_time", both))?;
            let rest = rest.ok_or_else(|| section.missing("rest", both))?;
            let holding = match &at_rest {
                Some(item) => item.choice(&["off", "holding"])? == 1,
                None => false,
            };
            Operation::Intermittent {
                operating: operating.positive()?,
                rest: rest.positive()?,
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
        kind: Some(number),
    };
    Ok(())
}
