//! One-sided contacts in computed motions.

use std::path::Path;

use jred_analysis::checked;
use jred_file::model::machine::MachineFile;
use jred_motion::contact::broken;
use jred_motion::fastest::MoveLimits;
use jred_motion::fastest::cycle::{Cycle, cycle};
use jred_motion::moves;
use jred_motion::path_dynamics::Actuator;
use jred_sizing::catalogue::Motor;
use jred_sizing::cycle::form::Coefficients;
use jred_sizing::motor::envelope::Envelope;

fn hoist() -> MachineFile {
    checked::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines/hoist.toml")).unwrap()
}

fn fastest(file: &MachineFile, limits: &MoveLimits) -> Cycle {
    let motor = Motor {
        peak_curve: vec![[0.0, 200.0], [80.0, 200.0]],
        ..Motor::default()
    };
    let actuator = Actuator {
        coefficients: Coefficients([0.0, 1.0, 1.0, 0.0, 0.0]),
        ratio: 1.0,
        envelope: Envelope::of(&motor),
    };
    let chain = moves::chain(file.required_motion().unwrap(), &file.process()).unwrap();
    cycle(file, &actuator, *limits, None, &chain.parts).unwrap()
}

/// The cabin of a hoist hangs on two falls: above g/75 mm the drum lets its rope go slack while it brakes on the way up and while it accelerates
/// down. With the named limits the rope stays taut, and little time is lost: they are close to the limit.
#[test]
fn a_rope_that_goes_slack_is_named_with_limits() {
    let file = hoist();
    let made = fastest(&file, &MoveLimits::default());
    let found = broken(&file, &made.trace).unwrap().unwrap();
    assert!(found.lost.joint.rope);
    let limits = found.limits.unwrap();
    for limit in limits.into_iter().flatten() {
        let free = 9.81 / 0.075;
        assert!((0.9 * free..free).contains(&limit), "{limits:?} {free}");
    }
    let [acceleration, deceleration] = limits;
    let eased = fastest(
        &file,
        &MoveLimits {
            acceleration,
            deceleration,
            ..MoveLimits::default()
        },
    );
    assert!(broken(&file, &eased.trace).unwrap().is_none());
}
