//! Allowed combinations: gear motors, and the compatibility lists of the catalogues.

use std::collections::{HashMap, HashSet};
use std::ops::Range;
use std::path::Path;

use jred_file::plain;
use jred_file::text::problem::Problem;
use jred_file::units::did_you_mean;

use super::Pairing;
use super::column::Column;
use super::fault::Text;
use super::files::is_toml;
use super::load::{FileGroup, Loader};
use super::motor::WITH_BRAKE;
use super::pairing::Keys;
use super::row::{CatalogueRow, RowResult, Syntax};

/// One line of a compatibility table.
#[derive(Debug)]
pub(super) struct Listing {
    pub(super) at: Range<usize>,
    /// Key of a motor, or the start of several keys followed by "*".
    pub(super) motor: String,
    /// Keys of gearboxes; `None`: any.
    pub(super) gearboxes: Option<Vec<String>>,
    /// Keys of amplifiers; `None`: any suitable one.
    pub(super) direct: bool,
    /// Keys of amplifiers; `None`: any that suits.
    pub(super) amplifiers: Option<Vec<String>>,
}

impl Loader {
    /// Combines each gear motor with its own gearbox only, and this gearbox with no other motor.
    pub(super) fn pair_gear_motors(&mut self, pairing: &mut Pairing) {
        let keys = Keys::new(self.catalogue.gearboxes.iter().map(|g| g.key.as_str()));
        for (motor, key, index, at) in &self.gear_motors {
            let mut found = Vec::new();
            if !key.ends_with('*') {
                keys.find(key, |gearbox| found.push(gearbox));
            }
            if let Some(own) = found.first()
                && let Some(built_in) = pairing.built_in.get_mut(*own as usize)
            {
                *built_in = true;
            } else if let Some(text) = self.texts.get(*index) {
                let near = did_you_mean(key, &keys.names());
                let fault = Problem::new(format!("no gearbox has the key \"{}\"", plain::cut(key)))
                    .at(at.clone(), "not a gearbox of the catalogue")
                    .help(format!(
                        "{near}add the gearbox to a gearbox table, or {}",
                        form_of(text).leave_out()
                    ));
                self.faults.add(text, fault);
            }
            if let Some(partners) = pairing.motors.get_mut(*motor as usize) {
                partners.gearboxes = Some(found.into());
                partners.never_direct = true;
            }
        }
    }

    /// Pairs the motors of one catalogue by its list.
    pub(super) fn pair(&mut self, group: &FileGroup, pairing: &mut Pairing) {
        let lists_gearboxes = group.listings.iter().any(|(_, l)| l.gearboxes.is_some());
        let gear_motors: HashSet<u32> = self.gear_motors.iter().map(|g| g.0).collect();
        if lists_gearboxes {
            // A motor missing in its own catalogue's list may only be directly coupled.
            for motor in group.motors.iter().filter(|m| !gear_motors.contains(m)) {
                if let Some(partners) = pairing.motors.get_mut(*motor as usize) {
                    partners.gearboxes = Some(Box::default());
                }
            }
        }
        let motors = Keys::new(self.catalogue.motors.iter().map(|m| m.key.as_str()));
        let gearboxes = Keys::new(self.catalogue.gearboxes.iter().map(|g| g.key.as_str()));
        let amplifiers = Keys::new(self.catalogue.amplifiers.iter().map(|a| a.key.as_str()));
        let mut gathered: HashMap<u32, [Vec<u32>; 2]> = HashMap::new();
        for (index, listing) in &group.listings {
            let Some(text) = self.texts.get(*index) else {
                continue;
            };
            let mut found = |keys: &Keys, pattern: &str, what: &str| {
                let mut indices = Vec::new();
                keys.find(pattern, |i| indices.push(i));
                let own = pattern.strip_suffix(WITH_BRAKE).unwrap_or(pattern);
                if indices.is_empty()
                    && !self.broken.contains(pattern)
                    && !self.broken.contains(own)
                {
                    let near = did_you_mean(pattern, &keys.names());
                    let names = match what {
                        "motor" => String::new(),
                        _ => format!(", which the list of \"{}\" names", listing.motor),
                    };
                    let shown = plain::cut(pattern);
                    let fault = Problem::new(format!("no {what} has the key \"{shown}\"{names}"))
                        .at(listing.at.clone(), "in this list")
                        .help(format!(
                            "{near}correct the key; a \"*\" at its end matches all keys that start like this"
                        ));
                    self.faults.add(text, fault);
                }
                indices
            };
            let mut named = found(&motors, &listing.motor, "motor");
            // The key of a motor names it with its optional brake as well.
            let with_brake = format!("{}{WITH_BRAKE}", listing.motor);
            motors.find(&with_brake, |motor| named.push(motor));
            let mut partners = [Vec::new(), Vec::new()];
            for key in listing.gearboxes.iter().flatten() {
                partners[0].extend(found(&gearboxes, key, "gearbox"));
            }
            for key in listing.amplifiers.iter().flatten() {
                partners[1].extend(found(&amplifiers, key, "amplifier"));
            }
            for amplifier in &partners[1] {
                if let Some(listed) = pairing.listed.get_mut(*amplifier as usize) {
                    *listed = true;
                }
            }
            for motor in named {
                let all = gathered.entry(motor).or_default();
                for (all, these) in all.iter_mut().zip(&partners) {
                    all.extend(these);
                }
                if let Some(known) = pairing.motors.get_mut(motor as usize) {
                    known.never_direct |= !listing.direct;
                    if listing.gearboxes.is_none() && !gear_motors.contains(&motor) {
                        known.gearboxes = None;
                    }
                }
            }
        }
        for (motor, mut all) in gathered {
            let Some(known) = pairing.motors.get_mut(motor as usize) else {
                continue;
            };
            // Rows of other catalogues' lists add up, too.
            let earlier = [&known.gearboxes, &known.amplifiers];
            for (list, earlier) in all.iter_mut().zip(earlier) {
                list.extend(earlier.iter().flat_map(|known| known.iter().copied()));
                list.sort_unstable();
                list.dedup();
            }
            let [gearboxes, amplifiers] = all;
            if known.gearboxes.is_some() && !gear_motors.contains(&motor) {
                known.gearboxes = Some(gearboxes.into());
            }
            if !amplifiers.is_empty() {
                known.amplifiers = Some(amplifiers.into());
                pairing.lists_amplifiers = true;
                if let Some(motor) = self.catalogue.motors.get_mut(motor as usize) {
                    motor.amplifiers_listed = true;
                }
            }
        }
    }
}

/// The format of a file.
fn form_of(text: &Text) -> Syntax {
    if is_toml(Path::new(&text.name)) {
        Syntax::Toml
    } else {
        Syntax::Csv
    }
}

/// Keys separated by semicolons or blanks.
pub(super) fn keys(words: &str) -> impl Iterator<Item = &str> {
    words.split([';', ' ']).filter(|key| !key.is_empty())
}

/// A line of jred's own compatibility table.
pub(super) fn listing(row: &CatalogueRow) -> RowResult<Listing> {
    let keys = |column| {
        let words = row.words(column).unwrap_or_default();
        let all = || keys(words).map(ToOwned::to_owned).collect();
        row.given(column).then(all)
    };
    let listing = Listing {
        at: row.place(Column::ListedMotor),
        motor: row.text(Column::ListedMotor),
        gearboxes: keys(Column::ListedGearboxes),
        direct: row.yes_or_no(Column::Direct).unwrap_or(true),
        amplifiers: keys(Column::ListedAmplifiers),
    };
    row.checked()?;
    Ok(listing)
}
