//! Selection of the drives to list.

use jred_file::problem;
use jred_file::text::problem::Result;

use jred_file::units::closest;
use jred_sizing::catalogue::Drive;
use jred_sizing::select::size::{Candidate, Selection};

/// Extent of a listing.
#[derive(Clone, Copy, Debug, Default)]
#[expect(clippy::struct_excessive_bools, reason = "each is a switch of its own")]
pub struct List {
    /// Number of ranked drives.
    pub top: usize,
    /// Number of refused drives, those closest to their limits first.
    pub nearest: usize,
    /// List every refused drive instead.
    pub refused: bool,
    /// List every drive instead.
    pub all: bool,
    /// List every drive instead of one per motor.
    pub all_gearboxes: bool,
    /// Show the duty, every rule, missing checks and the ranking below the first screen.
    pub full: bool,
    /// Show the ranking below the first screen.
    pub is_ranked: bool,
    /// An explanation follows.
    pub explained: bool,
}

impl List {
    /// The ranked drives to list with their ranks: each motor with its first gearbox and amplifier, or every drive.
    pub fn fit<'c>(&self, selection: &Selection<'c>) -> Vec<(usize, Candidate<'c>)> {
        if self.all {
            (1..).zip(selection.first_fit(usize::MAX)).collect()
        } else if self.all_gearboxes {
            (1..).zip(selection.first_fit(self.top)).collect()
        } else {
            selection.first_of_motors(self.top)
        }
    }

    /// The same, then the first drive of each certainty that is not among them.
    pub fn ranked<'c>(&self, selection: &Selection<'c>) -> Vec<(usize, Candidate<'c>)> {
        let mut listed = self.fit(selection);
        let last = listed.last().map_or(0, |(rank, _)| *rank);
        let firsts = selection.classes().into_iter();
        let lower = firsts.filter(|class| last > 0 && class.rank > last);
        listed.extend(lower.map(|class| (class.rank, class.first)));
        listed
    }

    /// The refused drives to list, those closest to their limits first.
    pub fn refused<'c>(&self, selection: &Selection<'c>) -> Vec<Candidate<'c>> {
        if self.all || self.refused {
            return selection.first_refused(usize::MAX);
        }
        selection.first_refused(self.nearest)
    }
}

/// The drive to explain: the one called `name`, otherwise the best one, or the closest one if none is suitable. `None` if there is no drive.
///
/// Names have the keys of the catalogue, case-insensitive: MOTOR+GEARBOX, MOTOR or MOTOR+direct, or as in tables, "MOTOR, direct" and "MOTOR +
/// GEARBOX on AMPLIFIER". Without an amplifier the first of the drives that differ only in it is taken.
///
/// # Errors
/// No drive of that name.
pub fn explained<'c>(
    selection: &Selection<'c>,
    name: Option<&str>,
) -> Result<Option<Candidate<'c>>> {
    let Some(name) = name else {
        let best = selection.fit.first().or(selection.refused.first());
        return Ok(best.copied());
    };
    let asked = plain(name);
    let called = |name: &str| selection.find(|drive| names(drive).iter().any(|n| n == name));
    if let Some(found) = called(&asked) {
        return Ok(Some(found));
    }
    let drives = selection.fit.drives().chain(selection.refused.drives());
    let near = closest(
        &asked,
        &drives.flat_map(|drive| names(&drive)).collect::<Vec<_>>(),
    );
    let near = near
        .and_then(|name| called(&name))
        .map_or(String::new(), |found| {
            format!("; did you mean \"{}\"?", found.drive.name())
        });
    Err(problem!(
        help = format!(
            "write MOTOR+GEARBOX, or MOTOR for a direct drive, with the keys that `jred size --all` lists{near}"
        ),
        "there is no drive {} in the catalogue",
        jred_file::plain::quoted(name)
    ))
}

/// All names of a drive: with and without its amplifier; a direct drive also by its motor alone.
fn names(drive: &Drive) -> [String; 4] {
    let alone = Drive {
        amplifier: None,
        ..*drive
    };
    let [full, alone] = [drive, &alone].map(|drive| plain(&drive.name()));
    let motor = |name: &str| name.replacen("+direct", "", 1);
    [motor(&full), motor(&alone), full, alone]
}

/// A drive's name in lower case with uniform separators: "m+g on a", "m+direct".
fn plain(name: &str) -> String {
    let name = name.to_lowercase().replacen(", direct", "+direct", 1);
    name.split('+').map(str::trim).collect::<Vec<_>>().join("+")
}
