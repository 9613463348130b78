//! Times in which links are at rest while the drive moves, as for the table of an indexing cam.

use jred::error::Error;
use jred::machine::Mechanism as _;
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::Motion;

/// Instants that are evaluated.
const INSTANTS: u32 = 2000;

/// A transfer function below this share of the link's largest one counts as zero.
const ZERO_TRANSFER: f64 = 1e-6;

/// Share of the motion by which a time must differ to be reported.
const LEAST_DIFFERENCE: f64 = 0.005;

/// Links with the times (s) for which they are at rest in both motions although the drive moves, where these differ.
///
/// # Errors
/// The mechanism cannot be placed somewhere.
pub(super) fn changed(
    file: &MachineFile,
    own: &Motion,
    other: &Motion,
) -> Result<Vec<(String, [f64; 2])>, Error> {
    let [own_times, other_times] = [times(file, own)?, times(file, other)?];
    let mechanism = file.machine.mechanism();
    // Links of loads do not belong to the machine.
    let names = mechanism.link_names().iter().take(mechanism.own_links());
    let pairs = own_times.into_iter().zip(other_times);
    let all = names
        .zip(pairs)
        .map(|(name, (own, other))| (name.clone(), [own, other]));
    let least = LEAST_DIFFERENCE * own.duration();
    Ok(all
        .filter(|(_, [own, other])| (own - other).abs() > least)
        .collect())
}

fn times(file: &MachineFile, motion: &Motion) -> Result<Vec<f64>, Error> {
    let mechanism = file.machine.mechanism();
    let step = motion.duration() / f64::from(INSTANTS);
    let mut rows: Vec<(Vec<f64>, bool)> = Vec::new();
    for k in 0..INSTANTS {
        let state = motion.at((f64::from(k) + 0.5) * step);
        let frames = mechanism.frames(state.phi)?;
        let slopes = (0..mechanism.links().len()).map(|link| {
            frames.get(link).map_or(0.0, |frame| {
                let [x, y] = frame.point([0.0; 2]);
                x.d1.abs() + y.d1.abs() + frame.psi.d1.abs()
            })
        });
        rows.push((slopes.collect(), state.omega != 0.0));
    }
    let links = rows.first().map_or(0, |(slopes, _)| slopes.len());
    let time = |link: usize| {
        let slopes = rows.iter().map(|(slopes, _)| slopes[link]);
        let largest = slopes.fold(0.0, f64::max);
        let still = |slopes: &[f64]| largest > 0.0 && slopes[link] <= ZERO_TRANSFER * largest;
        let count = rows
            .iter()
            .filter(|(slopes, moves)| *moves && still(slopes));
        count.count() as f64 * step
    };
    Ok((0..links).map(time).collect())
}
