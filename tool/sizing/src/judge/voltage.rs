//! Whether motor and amplifier are made for the voltage of the supply: see [`Voltages`](crate::motor::supply::Voltages).

use super::{Context, Grounds, Record, SupplySource};
use crate::motor::envelope::MotorLimits;
use jred_file::model::rule::Rule;

/// Both rules; they do not need cycle and gearbox.
pub(super) fn measure(limits: &MotorLimits, findings: &mut impl Record) {
    findings.set(Rule::MotorVoltage, limits.voltages.motor);
    if let Some(amplifier) = limits.voltages.amplifier {
        findings.set(Rule::AmplifierVoltage, amplifier);
    }
}

/// Grounds of the voltage of the motor.
pub(super) fn of_motor(context: &Context) -> Grounds {
    let motor = context.drive.motor;
    Grounds::Voltage {
        part: motor.key.clone(),
        made_for: motor.made_for(),
        supply: supply(context),
    }
}

/// Grounds of the voltage of the amplifier.
pub(super) fn of_amplifier(context: &Context) -> Grounds {
    let Some(amplifier) = context.drive.amplifier else {
        return Grounds::NoAmplifier;
    };
    Grounds::Voltage {
        part: amplifier.key.clone(),
        made_for: amplifier.made_for(),
        supply: supply(context),
    }
}

fn supply(context: &Context) -> SupplySource {
    let site = context.site;
    match (
        site.mains_voltage,
        site.bus_voltage,
        context.drive.amplifier,
    ) {
        (Some(volts), _, _) => SupplySource::Mains(volts),
        (None, None, Some(amplifier)) => amplifier
            .mains_voltage
            .map_or(SupplySource::AmplifierBus, SupplySource::AmplifierMains),
        _ => SupplySource::Bus,
    }
}
