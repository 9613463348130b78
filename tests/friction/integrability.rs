//! Holonomic or not: the stages of a friction drive.

use jred::friction::{
    Arrangement, Contact, Creep, CreepLimit, Drive, Flow, OperatingPoint, Ramp, RampShape, Sine,
    SineShape, Stage, StageConstraint, Variable,
};
use jred::machine::motion::Law;

use crate::support::{assert_near, budget};

#[test]
fn stages_say_what_they_are() {
    let shift = Ramp::new(
        Variable::Time,
        RampShape {
            start: 5.0,
            length: 0.01,
            values: [1.0, 2.0],
        },
        Law::Polynomial345,
    )
    .unwrap();
    let slow = Sine::new(
        Variable::Time,
        SineShape {
            mean: 1.0,
            amplitude: 0.2,
            frequency: 0.7,
            phase: 0.0,
        },
    )
    .unwrap();
    let angle = Sine::new(
        Variable::Angle,
        SineShape {
            mean: 1.0,
            amplitude: 0.2,
            frequency: 2.0,
            phase: 0.0,
        },
    )
    .unwrap();
    let creep = Creep::new(CreepLimit {
        slip: 0.02,
        torque: 10.0,
    })
    .unwrap();
    let slipping = slow_slip();
    let both = |p: OperatingPoint| (p.phi * 2.0 + p.t * 0.1).sin_cos().0 * 0.2 + 1.0;
    let stages = [
        Stage::new(1.25)
            .unwrap()
            .with_slip(0.2, Flow::FirstDrives)
            .unwrap(),
        Stage::new(&shift).unwrap(),
        Stage::new(1.0)
            .unwrap()
            .with_slip(&slipping, Flow::SecondDrives)
            .unwrap(),
        Stage::new(&angle).unwrap(),
        Stage::new(1.0)
            .unwrap()
            .with_slip(&creep, Flow::SecondDrives)
            .unwrap(),
        Stage::new(&both).unwrap(),
        Stage::new(&slow).unwrap(),
    ];
    let drive = Drive::new(Arrangement::Fan, Contact::Ideal, &stages).unwrap();
    let tau = std::f64::consts::TAU;
    let found = drive.integrability([0.0, 10.0], [0.0, tau]).unwrap();
    assert_eq!(found[0], StageConstraint::Proportional { speed: 1.0 });
    // A shift of 10 ms within 10 s is between the grid points; its change reveals it.
    assert!(
        matches!(found[1], StageConstraint::NonHolonomic { rate, t, .. } if rate > 1.0 && (t - 5.0).abs() < 0.1)
    );
    assert!(matches!(found[2], StageConstraint::NonHolonomic { .. }));
    assert_eq!(found[3], StageConstraint::Integral);
    assert_eq!(found[4], StageConstraint::Constitutive);
    assert!(matches!(found[5], StageConstraint::NonHolonomic { .. }));
    let StageConstraint::NonHolonomic { rate, .. } = found[6] else {
        panic!("{:?}", found[6]);
    };
    assert_near("∂j/∂t", rate.abs(), 0.2 * 0.7, budget::GRID_MAXIMUM);
    let holonomic: Vec<bool> = found.iter().map(StageConstraint::is_holonomic).collect();
    assert_eq!(holonomic, [true, false, false, true, false, false, false]);
    assert!(
        found[1]
            .to_string()
            .starts_with("non-holonomic: θ∧dθ = -(∂j/∂t) dα_b∧dt∧dα_a")
    );
    // α₂ = ∫ j dα₁
    let angle = drive.stages()[3].angle(0.0, 0.5, 2.5).unwrap();
    let expected = 2.0 - 0.1 * (5f64.cos() - 1f64.cos());
    assert_near("α₂", angle, expected, budget::RELATION);
}

fn slow_slip() -> Ramp {
    Ramp::linear(
        Variable::Time,
        RampShape {
            start: 0.0,
            length: 100.0,
            values: [0.01, 0.02],
        },
    )
    .unwrap()
}
