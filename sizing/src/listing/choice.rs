//! Which drives of a selection are listed.

use miette::{Result, miette};

use crate::size::{Candidate, NEAREST, Selection};

/// How much of a selection is listed.
#[derive(Clone, Copy, Debug)]
pub struct List {
    /// Number of ranked drives.
    pub top: usize,
    /// Number of refused drives, those that miss by least first.
    pub nearest: usize,
    /// Every refused drive instead.
    pub refused: bool,
    /// Every drive instead.
    pub all: bool,
}

impl List {
    /// The ranked drives to list.
    pub fn fit<'s, 'c>(&self, selection: &'s Selection<'c>) -> &'s [Candidate<'c>] {
        let count = if self.all { usize::MAX } else { self.top };
        &selection.fit[..count.min(selection.fit.len())]
    }

    /// The refused drives to list, those that miss by least first.
    pub fn refused<'c>(&self, selection: &Selection<'c>) -> Vec<Candidate<'c>> {
        if self.all || self.refused {
            return selection.refused_in_order();
        }
        nearest(selection, self.nearest)
    }
}

/// The refused drives that miss by least, `count` of them.
pub(crate) fn nearest<'c>(selection: &Selection<'c>, count: usize) -> Vec<Candidate<'c>> {
    let mut refused = if count > NEAREST {
        selection.refused_in_order()
    } else {
        let count = count.min(selection.refused.len());
        selection.refused[..count].to_vec()
    };
    refused.truncate(count);
    refused
}

/// The drive that is to be explained: the one that `name` says, as MOTOR or MOTOR+GEARBOX with the keys of the catalogue; without
/// a name the best, or, if none holds, the one that misses by least. `None` if there is no drive at all.
///
/// # Errors
/// No drive of that name.
pub fn explained<'s, 'c>(
    selection: &'s Selection<'c>,
    name: Option<&str>,
) -> Result<Option<&'s Candidate<'c>>> {
    let mut all = selection.fit.iter().chain(&selection.refused);
    let Some(name) = name else {
        return Ok(all.next());
    };
    let key = |candidate: &Candidate| {
        let drive = &candidate.drive;
        let gearbox = drive
            .gearbox
            .map_or(String::new(), |g| format!("+{}", g.key));
        format!("{}{gearbox}", drive.motor.key)
    };
    let asked: String = name.split('+').map(str::trim).collect::<Vec<_>>().join("+");
    if let Some(found) = all.find(|candidate| key(candidate) == asked) {
        return Ok(Some(found));
    }
    let keys = selection.fit.iter().chain(&selection.refused).map(key);
    let closest = keys
        .max_by(|a, b| strsim::jaro_winkler(a, &asked).total_cmp(&strsim::jaro_winkler(b, &asked)));
    let closest = closest.map_or(String::new(), |key| format!("; did you mean {key}?"));
    Err(miette!(
        help = format!(
            "write MOTOR+GEARBOX, or MOTOR alone for a direct drive, with the keys that `jred size --refused` lists{closest}"
        ),
        "the catalogue has no drive \"{name}\""
    ))
}
