//! Cost of the two sweeps of the fastest motion: from the tabulated machine to the time of the motion, on one core.

use std::hint::black_box;
use std::path::Path;
use std::time::{Duration, Instant};

use jred_analysis::checked;
use jred_motion::fastest::MoveLimits;
use jred_motion::fastest::field::Field;
use jred_motion::fastest::sweep;
use jred_motion::fastest::track::{Ends, Survey, Track};
use jred_motion::path_dynamics::{Actuator, PathDynamics};
use jred_sizing::catalogue::Catalogue;
use jred_sizing::motor::envelope::Envelope;

/// The press from top dead centre over the pressing stroke, with friction, losses of its belt and a servo motor.
fn main() {
    let home = Path::new(env!("CARGO_MANIFEST_DIR"));
    let file = checked::read(&home.join("../../machines/press.toml")).expect("the press is read");
    let catalogue = Catalogue::built_in().expect("the catalogue is read");
    let drive = catalogue
        .drives()
        .find(|(_, drive)| drive.name() == "sgmsh-15a + npt025mf-5");
    let (_, drive) = drive.expect("the drive is in the catalogue");
    let envelope = Envelope::at(drive.motor, drive.amplifier, &file.site);
    let dynamics = PathDynamics::new(&file, Actuator::new(&drive, envelope), 1.0);
    let field = Field {
        dynamics: &dynamics,
        limits: MoveLimits::default(),
    };
    let ends = Ends {
        from: 3.2,
        length: 6.0,
        speeds: [0.0; 2],
        corners: Vec::new(),
    };
    for count in [100, 1_000, 10_000, 100_000, 1_000_000] {
        let track = Track::new(&Survey::new(&field, ends.from), &ends, count, &[])
            .expect("the press turns");
        let mut best = Duration::MAX;
        for _ in 0..(2_000_000 / count).clamp(3, 500) {
            let begin = Instant::now();
            let pieces =
                sweep::fastest(&field, &track, [0.0; 2]).expect("the drive is strong enough");
            black_box(sweep::times(&track, &pieces).iter().sum::<f64>());
            best = best.min(begin.elapsed());
        }
        let each = best.as_secs_f64() * 1e9 / count as f64;
        println!(
            "{count:>8} cells: {:.3} ms, {each:.0} ns a cell",
            best.as_secs_f64() * 1e3
        );
    }
}
