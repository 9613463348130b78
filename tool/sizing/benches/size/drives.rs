//! The catalogue that is chosen from.

use std::path::PathBuf;

use jred_sizing::catalogue::{Catalogue, Drive, DriveId, Sources};

use crate::bench::best;
use crate::synthetic;

/// The variable that names the folder of a database.
const DATABASE: &str = "JRED_MGDB";

/// Whether the catalogue is the synthetic one, which the ceilings are for.
pub(crate) fn are_synthetic() -> bool {
    std::env::var_os(DATABASE).is_none()
}

/// The database of the variable `JRED_MGDB`, or a synthetic one of its size; and what it is.
pub(crate) fn catalogue() -> (Catalogue, String) {
    let Some(folder) = std::env::var_os(DATABASE).map(PathBuf::from) else {
        return (
            synthetic::catalogue(),
            "synthetic catalogue (JRED_MGDB not set)".to_owned(),
        );
    };
    let sources = Sources {
        catalogues: vec![folder.clone()],
        ..Sources::default()
    };
    let load = || match Catalogue::open(&sources) {
        Ok(catalogue) => catalogue,
        Err(why) => panic!("JRED_MGDB: {why}"),
    };
    let time = best(load);
    println!("loading                    {:9.3} ms", 1e3 * time);
    (
        load(),
        format!("Motor-Gearbox Database in {}", folder.display()),
    )
}

/// So many drives, spread over the whole catalogue; where there are fewer, the catalogue begins anew.
pub(crate) fn spread_over(catalogue: &Catalogue, wanted: usize) -> Vec<(DriveId, Drive<'_>)> {
    let all: Vec<(DriveId, Drive)> = catalogue.drives().collect();
    let step = (all.len() / wanted).max(1);
    all.iter()
        .copied()
        .step_by(step)
        .cycle()
        .take(wanted)
        .collect()
}
