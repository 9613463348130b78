//! Whether motor and amplifier are made for the ambient temperature and altitude of the site.
//!
//! Within the range of the maker's data, or of the general rule, the ratings are reduced ([`SiteRating`](crate::catalogue::SiteRating)) and the other
//! rules judge them. The rules here judge whether the site is within that range.

use super::{Context, Grounds, Record};
use jred_file::model::rule::Rule;
use jred_file::model::rules::Finding;
use jred_file::model::surroundings::{LOW, REFERENCE};

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

/// Grounds of these rules.
pub(super) fn grounds(context: &Context) -> Grounds {
    let site = &context.site.surroundings;
    Grounds::Site {
        motor: context.drive.motor.derated(site),
        amplifier: context.drive.amplifier.map(|a| a.derated(site)),
        cabinet: site.cabinet.is_some(),
    }
}
