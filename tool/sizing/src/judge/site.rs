//! Whether motor and amplifier are made for the ambient temperature and altitude of the site.
//!
//! Within the range of the maker's data, or of the general rule, the ratings are reduced ([`SiteRating`]) and the other rules judge them. The rules here
//! judge whether the site is within that range.

use super::{Context, Record, Words};
use crate::catalogue::{DeratingBasis, HOTTEST_MOTOR, SiteRating};
use jred_file::model::rule::Rule;
use jred_file::model::rules::Finding;
use jred_file::model::surroundings::{LOW, REFERENCE};
use jred_file::number::rounding::short;

/// Measures the site, without cycle and gearbox. A site that reduces no rating needs no check.
pub(super) fn measure(context: &Context, findings: &mut impl Record) {
    let site = &context.site.surroundings;
    let motor = context.drive.motor.derated(site);
    if site.ambient > REFERENCE {
        findings.set(
            Rule::AmbientTemperature,
            Finding::new(site.ambient, motor.hottest),
        );
    }
    let amplifier = context.drive.amplifier.map(|a| a.derated(site));
    if let Some(amplifier) = amplifier
        && site.around_amplifier() > REFERENCE
    {
        findings.set(
            Rule::CabinetTemperature,
            Finding::new(site.around_amplifier(), amplifier.hottest),
        );
    }
    if site.altitude > LOW {
        let highest = amplifier.map_or(motor.highest, |a| a.highest.min(motor.highest));
        findings.set(Rule::Altitude, Finding::new(site.altitude, highest));
    }
}

pub(super) fn words(context: &Context, rule: Rule) -> Words {
    let site = &context.site.surroundings;
    let motor = context.drive.motor.derated(site);
    let amplifier = context.drive.amplifier.map(|a| a.derated(site));
    let torque = context.vocabulary().torque;
    let share = |derated: &SiteRating| short(100.0 * derated.factor);
    let (unit, rating, place) = match rule {
        Rule::AmbientTemperature => (
            "degC",
            match motor.temperature {
                DeratingBasis::Maker => {
                    "highest ambient temperature of the motor's temperature_derating"
                }
                _ if motor.hottest < HOTTEST_MOTOR => "maximum temperature of the winding",
                _ => {
                    "highest ambient temperature for which IEC 60034-1 has a rule; above it, ask the maker for temperature_derating"
                }
            },
            format!(
                "the S1 {torque} is reduced to {} % ({})",
                share(&motor),
                heat(
                    motor.temperature,
                    "1 % per K above 40 °C; max_winding_temperature or temperature_derating in the catalogue is more exact"
                )
            ),
        ),
        Rule::CabinetTemperature => {
            let amplifier = amplifier.unwrap_or(motor);
            let assumed = match site.cabinet {
                None => "; temperature in the cabinet not given, using that of the motor",
                Some(_) => "",
            };
            (
                "degC",
                match amplifier.temperature {
                    DeratingBasis::Maker => {
                        "highest temperature of the amplifier's temperature_derating"
                    }
                    _ => {
                        "temperature to which makers' practice reaches; above it, ask the maker for temperature_derating"
                    }
                },
                format!(
                    "the currents of the amplifier are reduced to {} % ({}){assumed}",
                    share(&amplifier),
                    heat(
                        amplifier.temperature,
                        "2.5 % per K above 40 °C; temperature_derating in the catalogue is more exact"
                    )
                ),
            )
        }
        _ => {
            let of_motor = amplifier.is_none_or(|a| motor.highest <= a.highest);
            let basis = match (of_motor, amplifier) {
                (false, Some(amplifier)) => amplifier.altitude,
                _ => motor.altitude,
            };
            let whose = if of_motor { "motor" } else { "amplifier" };
            let rating = match basis {
                DeratingBasis::Maker => match whose {
                    "motor" => "highest altitude of the motor's altitude_derating",
                    _ => "highest altitude of the amplifier's altitude_derating",
                },
                _ => "highest altitude for which IEC 60034-1 has a rule",
            };
            let currents = amplifier.map_or(String::new(), |a| {
                format!(", the currents of the amplifier to {} %", share(&a))
            });
            (
                "m",
                rating,
                format!(
                    "the S1 {torque} is reduced to {} %{currents}",
                    share(&motor)
                ),
            )
        }
    };
    Words {
        unit,
        scale: 1.0,
        rating: rating.to_owned(),
        place,
    }
}

/// Source of a factor for the temperature.
const fn heat(basis: DeratingBasis, practice: &'static str) -> &'static str {
    match basis {
        DeratingBasis::Maker => "temperature_derating of the catalogue",
        DeratingBasis::Rise => "by the rise that the maximum temperature of the winding leaves",
        DeratingBasis::Practice => practice,
        DeratingBasis::None => "not by heat",
    }
}
