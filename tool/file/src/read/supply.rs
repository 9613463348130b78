//! `[supply]`: the supply of the DC bus, and the consumers of regenerated energy.

use crate::model::site::Site;
use crate::model::supply::{BrakeResistor, MAINS, Supply, rectified};

use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::text::value::Value;

/// Reads the supply into the site.
pub(super) fn read(root: &Section, site: &mut Site) -> Result<()> {
    let Some(section) = root.maybe_table("supply")? else {
        return Ok(());
    };
    let (bus, mains) = (
        section.given("bus_voltage")?,
        section.given("mains_voltage")?,
    );
    let voltage = match (bus, &mains) {
        (Some(bus), _) => Some((bus.shown(), bus.si)),
        (None, Some(mains)) => {
            let shown = format!("√2 times {}", mains.shown());
            check_mains(mains)?;
            Some((shown, rectified(mains.si)))
        }
        (None, None) => None,
    };
    let (chopper, max) = (
        section.given("chopper_voltage")?,
        section.given("max_voltage")?,
    );
    above(
        chopper.as_ref(),
        "chopper_voltage",
        voltage.as_ref(),
        "the brake resistor would always be on",
    )?;
    above(
        max.as_ref(),
        "max_voltage",
        voltage.as_ref(),
        "the bus has that voltage already",
    )?;
    if let (Some(chopper), Some(max)) = (&chopper, &max)
        && chopper.si >= max.si
    {
        let message = format!(
            "`chopper_voltage` in [supply] is {}, not below `max_voltage`, which is {}",
            chopper.shown(),
            max.shown()
        );
        return Err(Problem::new(message)
            .at(chopper.span(), "here")
            .at(max.span(), "here")
            .help("the brake resistor must switch on below the maximum bus voltage: raise max_voltage or lower chopper_voltage to the values in the amplifier's manual"));
    }
    let capacitance = section.maybe("capacitance")?;
    let least = section.given("min_resistance")?;
    let regenerative = section.is("regenerative")?;
    let brake_resistor = resistor(&section, least.as_ref(), regenerative)?;
    section.finish()?;
    site.mains_voltage = mains.map(|mains| mains.si);
    site.bus_voltage = voltage.map(|(_, volts)| volts);
    site.supply = Supply {
        given: true,
        capacitance,
        chopper_voltage: chopper.map(|value| value.si),
        max_voltage: max.map(|value| value.si),
        min_resistance: least.map(|value| value.si),
        regenerative,
        brake_resistor,
    };
    Ok(())
}

/// Checks that the mains voltage is in the range of drives.
fn check_mains(mains: &Value) -> Result<()> {
    let [least, most] = MAINS;
    if (least..=most).contains(&mains.si) {
        return Ok(());
    }
    let what = format!(
        "is {}, but mains of drives have {least} V to {most} V",
        mains.shown()
    );
    Err(mains.problem(&what, "no such mains").help(
        "write the voltage between two conductors of the mains, such as 230 V, 400 V or 480 V; give the voltage of a DC supply as bus_voltage",
    ))
}

/// Checks that a voltage exceeds that of the supply.
fn above(
    value: Option<&Value>,
    key: &str,
    supply: Option<&(String, f64)>,
    otherwise: &str,
) -> Result<()> {
    let (Some(value), Some((shown, volts))) = (value, supply) else {
        return Ok(());
    };
    if value.si > *volts {
        return Ok(());
    }
    let what = format!(
        "is {}, but must be above the voltage of the DC bus, {shown}: {otherwise}",
        value.shown()
    );
    Err(value.problem(&what, "too low").help(format!(
        "write {key} as in the amplifier's manual, or correct the voltage of the supply"
    )))
}

fn resistor(
    section: &Section,
    least: Option<&Value>,
    regenerative: bool,
) -> Result<Option<BrakeResistor>> {
    let Some(item) = section.get("brake_resistor") else {
        return Ok(None);
    };
    if regenerative {
        return Err(item
            .problem("is given, but the supply feeds energy back", "never on")
            .help("remove one of the two: brake_resistor or regenerative = true"));
    }
    let table = section.table("brake_resistor")?;
    let resistance = table.value("resistance")?;
    if let Some(least) = least
        && resistance.si < least.si
    {
        let what = format!(
            "is {}, below `min_resistance` in [supply], which is {}",
            resistance.shown(),
            least.shown()
        );
        return Err(resistance
            .problem(&what, "too small")
            .help("the chopper cannot switch the current: use a larger resistance"));
    }
    let (power, peak) = (table.value("power")?, table.given("peak_power")?);
    if let Some(peak) = &peak
        && peak.si < power.si
    {
        let what = format!(
            "is {}, below `power`, which is {}",
            peak.shown(),
            power.shown()
        );
        return Err(peak
            .problem(&what, "too small")
            .help("`power` is the continuous power of the resistor, `peak_power` its short-time power: check whether they are interchanged"));
    }
    let pulse_energy = table.maybe("pulse_energy")?;
    table.finish()?;
    Ok(Some(BrakeResistor {
        resistance: resistance.si,
        power: power.si,
        peak_power: peak.map(|value| value.si),
        pulse_energy,
    }))
}
