//! The voltage that motor and amplifier are made for.

use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleVerdict;
use jred_file::number::rounding::short;
use jred_sizing::catalogue::Basis;
use jred_sizing::judge::check::Check;
use jred_sizing::judge::{Grounds, SupplySource};

pub(super) fn words(check: &Check) -> (String, String) {
    let Grounds::Voltage {
        part: key,
        made_for,
        supply: source,
    } = &check.grounds
    else {
        return Default::default();
    };
    let (part, absent) = match check.id {
        Rule::AmplifierVoltage => (
            "amplifier",
            "the catalogue has neither mains_voltage nor bus_voltage of the amplifier",
        ),
        _ => (
            "motor",
            "the catalogue has neither mains_voltage nor max_bus_voltage of the motor",
        ),
    };
    let rating = match made_for {
        None => absent.to_owned(),
        Some(_) if check.finding.value.is_nan() => {
            "voltage of the supply; give mains_voltage or bus_voltage in [supply]".to_owned()
        }
        Some(made) => largest(part, made.basis),
    };
    let mut place = String::new();
    if check.finding.is_known() {
        place = supply(*source, check.finding.value);
        if check.verdict == RuleVerdict::Fail {
            place = format!(
                "{place}; \"{key}\" is not made for that: take one that is, or lower the supply, for example with a transformer"
            );
        }
    }
    (rating, place)
}

/// Description of the largest voltage.
fn largest(part: &str, basis: Basis) -> String {
    match basis {
        Basis::Stated => format!("largest bus voltage of the {part}"),
        Basis::Mains([stated, highest]) => format!(
            "largest bus voltage of the {part} without braking, made for {} V mains (class up to {} V, + 10 %)",
            short(stated),
            short(highest)
        ),
        Basis::Figures(bus, Some(highest)) => format!(
            "largest bus voltage of the {part} without braking, whose data are for {} V (mains up to {} V, + 10 %)",
            short(bus),
            short(highest)
        ),
        Basis::Figures(bus, None) => format!(
            "extra-low voltage, because the data of the {part} are for {} V",
            short(bus)
        ),
    }
}

/// Description of the supply.
fn supply(source: SupplySource, highest: f64) -> String {
    let mains = |volts: f64| format!("{} V mains + 10 %, rectified", short(volts));
    match source {
        SupplySource::Mains(volts) => mains(volts),
        SupplySource::AmplifierMains(volts) => format!("{}, of the amplifier", mains(volts)),
        SupplySource::AmplifierBus => {
            format!("bus voltage of the amplifier, {} V", short(highest))
        }
        SupplySource::Bus => "bus voltage of [supply]".to_owned(),
    }
}
