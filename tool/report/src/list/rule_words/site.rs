//! The ambient temperature and altitude of the site.

use jred_file::model::rule::Rule;
use jred_file::number::rounding::short;
use jred_sizing::catalogue::{DeratingBasis, HOTTEST_MOTOR, SiteRating};
use jred_sizing::judge::Grounds;
use jred_sizing::judge::check::Check;

pub(super) fn words(check: &Check) -> (String, String) {
    let Grounds::Site {
        motor,
        amplifier,
        cabinet,
    } = &check.grounds
    else {
        return Default::default();
    };
    let torque = check.words.torque;
    let share = |derated: &SiteRating| short(100.0 * derated.factor);
    let (rating, place) = match check.id {
        Rule::AmbientTemperature => (
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
                share(motor),
                heat(
                    motor.temperature,
                    "1 % per K above 40 °C; max_winding_temperature or temperature_derating in the catalogue is more exact"
                )
            ),
        ),
        Rule::CabinetTemperature => {
            let amplifier = amplifier.as_ref().unwrap_or(motor);
            let assumed = if *cabinet {
                ""
            } else {
                "; temperature in the cabinet not given, using that of the motor"
            };
            (
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
                    share(amplifier),
                    heat(
                        amplifier.temperature,
                        "2.5 % per K above 40 °C; temperature_derating in the catalogue is more exact"
                    )
                ),
            )
        }
        _ => {
            let lower = amplifier.filter(|a| a.highest < motor.highest);
            let rating = match (lower.unwrap_or(*motor).altitude, lower) {
                (DeratingBasis::Maker, None) => "highest altitude of the motor's altitude_derating",
                (DeratingBasis::Maker, Some(_)) => {
                    "highest altitude of the amplifier's altitude_derating"
                }
                _ => "highest altitude for which IEC 60034-1 has a rule",
            };
            let currents = amplifier.map_or(String::new(), |a| {
                format!(", the currents of the amplifier to {} %", share(&a))
            });
            (
                rating,
                format!("the S1 {torque} is reduced to {} %{currents}", share(motor)),
            )
        }
    };
    (rating.to_owned(), place)
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
