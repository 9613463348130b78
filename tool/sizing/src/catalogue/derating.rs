//! Derating of motors and amplifiers by heat and thin air at the site.
//!
//! The maker's points are used if the catalogue has them, otherwise the general rules of docs/sizing-rules.md. Neither extends beyond its source:
//! [`SiteRating::hottest`] and [`SiteRating::highest`] are the limits.

use super::{Amplifier, Motor, broken_line};
use jred_file::model::surroundings::{LOW, REFERENCE, Surroundings};

/// Highest ambient temperature (°C) for which IEC 60034-1 has a rule; above it maker and user agree on the ratings.
pub const HOTTEST_MOTOR: f64 = 60.0;

/// Highest ambient temperature (°C) of amplifiers for which makers give a reduction of the current.
const HOTTEST_AMPLIFIER: f64 = 55.0;

/// Highest altitude (m) for which IEC 60034-1 and makers of amplifiers have a rule.
const HIGHEST: f64 = 4000.0;

/// Loss of S1 torque per kelvin above 40 °C, if the winding's maximum temperature is not given.
const TORQUE_PER_KELVIN: f64 = 0.01;

/// Loss of an amplifier's current per kelvin above 40 °C.
const CURRENT_PER_KELVIN: f64 = 0.025;

/// The maker's derating factors: (temperature in °C or altitude in m, factor), rising; empty: not given.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Derating {
    /// By ambient temperature.
    pub temperature: Vec<[f64; 2]>,
    /// By altitude.
    pub altitude: Vec<[f64; 2]>,
}

/// Source of a factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Basis {
    /// No derating.
    None,
    /// The maker's points.
    Maker,
    /// The remaining temperature rise up to the winding's maximum temperature.
    Rise,
    /// Makers' practice, not confirmed by the catalogue.
    Practice,
}

/// The ratings of a motor or an amplifier at a site.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SiteRating {
    /// Factor of the S1 torque at every speed, or of the current.
    pub factor: f64,
    /// Part of it that raises the relative torque in a thermal model with shares of the rated rise, because the maker gives it for the torque; the
    /// other part lowers the rise.
    pub torque: f64,
    /// Share of the winding's rated rise that is available at the site; above one at a cool site.
    pub rise: f64,
    /// Highest ambient temperature (°C) for which the factor is valid.
    pub hottest: f64,
    /// Highest altitude (m) for which the factor is valid.
    pub highest: f64,
    /// Source of the factor for the temperature.
    pub temperature: Basis,
    /// Source of the factor for the altitude.
    pub altitude: Basis,
}

impl Motor {
    /// Derating of the S1 torque at a site: T/T_N = √(available rise/rated rise) if the winding's maximum temperature is given.
    pub fn derated(&self, site: &Surroundings) -> SiteRating {
        let limit = (self.thermal.max_temperature).filter(|limit| *limit > REFERENCE);
        let hot = (site.ambient - REFERENCE).max(0.0);
        let (by_maker, air) = (&self.derating, site.altitude_factor());
        let (mut torque, mut rise) = (1.0, 1.0);
        let temperature = match (by_maker.temperature.last(), limit) {
            (Some(_), _) => {
                torque *= broken_line(&by_maker.temperature, site.ambient);
                Basis::Maker
            }
            (None, Some(limit)) => {
                rise *= ((limit - site.ambient) / (limit - REFERENCE)).max(0.0);
                if hot > 0.0 { Basis::Rise } else { Basis::None }
            }
            (None, None) if hot > 0.0 => {
                torque *= (1.0 - TORQUE_PER_KELVIN * hot).max(0.0);
                Basis::Practice
            }
            (None, None) => Basis::None,
        };
        let altitude = if by_maker.altitude.is_empty() {
            rise *= air;
            if air < 1.0 { Basis::Rise } else { Basis::None }
        } else {
            torque *= broken_line(&by_maker.altitude, site.altitude);
            Basis::Maker
        };
        let general = limit.map_or(HOTTEST_MOTOR, |limit| limit.min(HOTTEST_MOTOR));
        SiteRating {
            // Cool air allows a larger rise, but no data sheet allows a larger S1 torque.
            factor: torque * rise.min(1.0).sqrt(),
            torque,
            rise,
            hottest: end(&by_maker.temperature, general),
            highest: end(&by_maker.altitude, HIGHEST),
            temperature,
            altitude,
        }
    }
}

impl Amplifier {
    /// Derating of the currents at a site.
    pub fn derated(&self, site: &Surroundings) -> SiteRating {
        let hot = (site.around_amplifier() - REFERENCE).max(0.0);
        let thin = (site.altitude - LOW).max(0.0);
        let basis = |points: &[[f64; 2]], more: f64| match points {
            [_, ..] => Basis::Maker,
            [] if more > 0.0 => Basis::Practice,
            [] => Basis::None,
        };
        let by_maker = &self.derating;
        let temperature = basis(&by_maker.temperature, hot);
        let altitude = basis(&by_maker.altitude, thin);
        let in_heat = match temperature {
            Basis::Maker => broken_line(&by_maker.temperature, site.around_amplifier()),
            _ => (1.0 - CURRENT_PER_KELVIN * hot).max(0.0),
        };
        let in_air = match altitude {
            Basis::Maker => broken_line(&by_maker.altitude, site.altitude),
            _ => site.altitude_factor(),
        };
        SiteRating {
            factor: in_heat * in_air,
            torque: 1.0,
            rise: 1.0,
            hottest: end(&by_maker.temperature, HOTTEST_AMPLIFIER),
            highest: end(&by_maker.altitude, HIGHEST),
            temperature,
            altitude,
        }
    }

    /// Rated and peak current at a site (A).
    pub fn currents(&self, site: &Surroundings) -> [f64; 2] {
        let factor = self.derated(site).factor;
        [self.rated_current, self.peak_current].map(|current| factor * current)
    }
}

/// End of the maker's points, or of the general rule.
fn end(points: &[[f64; 2]], general: f64) -> f64 {
    points.last().map_or(general, |[end, _]| *end)
}
