//! Whether motor and amplifier are made for the voltage of the supply: see [`Voltages`](crate::motor::supply::Voltages).

use super::{Context, Record, Words};
use crate::catalogue::Basis;
use crate::motor::envelope::MotorLimits;
use jred_file::model::rule::Rule;
use jred_file::model::rules::{Finding, RuleSet, RuleVerdict};
use jred_file::number::rounding::short;

/// Both rules; they do not need cycle and gearbox.
pub(super) fn measure(limits: &MotorLimits, findings: &mut impl Record) {
    findings.set(Rule::MotorVoltage, limits.voltages.motor);
    if let Some(amplifier) = limits.voltages.amplifier {
        findings.set(Rule::AmplifierVoltage, amplifier);
    }
}

pub(super) fn words(context: &Context, rules: &RuleSet, rule: Rule, finding: Finding) -> Words {
    let drive = &context.drive;
    let (part, key, made) = match (rule, drive.amplifier) {
        (Rule::AmplifierVoltage, Some(amplifier)) => {
            ("amplifier", &amplifier.key, amplifier.made_for())
        }
        _ => ("motor", &drive.motor.key, drive.motor.made_for()),
    };
    let rating = match made {
        None if rule == Rule::AmplifierVoltage => {
            "the catalogue has neither mains_voltage nor bus_voltage of the amplifier".to_owned()
        }
        None => {
            "the catalogue has neither mains_voltage nor max_bus_voltage of the motor".to_owned()
        }
        Some(_) if finding.value.is_nan() => {
            "voltage of the supply; give mains_voltage or bus_voltage in [supply]".to_owned()
        }
        Some(made) => largest(part, made.basis),
    };
    let mut place = String::new();
    if finding.is_known() {
        let supply = supply(context, finding.value);
        place = if rules.verdict(rule, finding) == RuleVerdict::Fail {
            format!(
                "{supply}; \"{key}\" is not made for that: take one that is, or lower the supply, for example with a transformer"
            )
        } else {
            supply
        };
    }
    Words {
        unit: "V",
        scale: 1.0,
        rating,
        place,
    }
}

/// Description of the largest voltage.
fn largest(part: &str, basis: Basis) -> String {
    match basis {
        Basis::Stated => format!("largest bus voltage of the {part}"),
        Basis::Mains([stated, highest]) => format!(
            "largest bus voltage of the {part}, made for {} V mains (class up to {} V, + 10 %)",
            short(stated),
            short(highest)
        ),
        Basis::Figures(bus, Some(highest)) => format!(
            "largest bus voltage of the {part}, whose data are for {} V (mains up to {} V, + 10 %)",
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
fn supply(context: &Context, highest: f64) -> String {
    let site = context.site;
    let mains = |volts: f64| format!("{} V mains + 10 %, rectified", short(volts));
    match (
        site.mains_voltage,
        site.bus_voltage,
        context.drive.amplifier,
    ) {
        (Some(volts), _, _) => mains(volts),
        (None, None, Some(amplifier)) => match amplifier.mains_voltage {
            Some(volts) => format!("{}, of the amplifier", mains(volts)),
            None => format!("bus voltage of the amplifier, {} V", short(highest)),
        },
        _ => "bus voltage of [supply]".to_owned(),
    }
}
