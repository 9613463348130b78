//! Impossible input is refused, with the quantity, its value and its limit.

use crate::support::spoken;
use jred::error::Error;
use jred::friction::{
    Arrangement, Contact, Creep, CreepContact, CreepLimit, Drive, Flow, FrictionDrive,
    OperatingPoint, Ramp, RampShape, Shaft, Sine, SineShape, Stage, State, Variable,
};
use jred::machine::motion::Law;

fn text<T: std::fmt::Debug, E: Into<Error> + std::fmt::Debug>(result: Result<T, E>) -> String {
    spoken(result.unwrap_err())
}

#[test]
fn stages_and_courses() {
    let zero = "size of the friction stage's ratio is 0, but must be greater than zero";
    assert_eq!(text(Stage::new(0.0)), zero);
    assert_eq!(
        text(Stage::new(f64::NAN)),
        "size of the friction stage's ratio is not a finite number"
    );
    let stage = Stage::new(2.0).unwrap();
    for slip in [1.0, -0.1, 3.0] {
        let expected = format!("slip is {slip}, outside 0 to 1");
        assert_eq!(text(stage.with_slip(slip, Flow::default())), expected);
        assert_eq!(text(Creep::new(CreepLimit { slip, torque: 5.0 })), expected);
    }
    let limit = |slip, torque| CreepLimit { slip, torque };
    assert!(CreepContact::new(limit(0.0, 5.0)).is_err());
    assert!(CreepContact::new(limit(0.1, 0.0)).is_err());
    assert!(Creep::new(limit(0.1, -1.0)).is_err());
    let shape = |length, last| RampShape {
        start: 0.0,
        length,
        values: [1.0, last],
    };
    assert!(Ramp::linear(Variable::Time, shape(0.0, 2.0)).is_err());
    let broken = shape(1.0, f64::NAN);
    assert!(Ramp::new(Variable::Time, broken, Law::default()).is_err());
    let endless = SineShape {
        mean: 1.0,
        amplitude: 1.0,
        frequency: f64::INFINITY,
        phase: 0.0,
    };
    assert!(Sine::new(Variable::Time, endless).is_err());
    // A ratio that passes through zero is refused at that point, not before.
    let through = Ramp::linear(Variable::Time, shape(1.0, -1.0)).unwrap();
    let stage = Stage::new(&through).unwrap();
    assert!(stage.at(OperatingPoint::at_time(0.4)).is_ok());
    assert_eq!(text(stage.at(OperatingPoint::at_time(0.5))), zero);
    let much = Ramp::linear(
        Variable::Load,
        RampShape {
            start: 0.0,
            length: 10.0,
            values: [0.0, 2.0],
        },
    )
    .unwrap();
    let stage = Stage::new(1.0)
        .unwrap()
        .with_slip(&much, Flow::FirstDrives)
        .unwrap();
    assert_eq!(
        text(stage.at(OperatingPoint::at_time(0.0).with_load(7.0))),
        "slip of the friction stage is 1.4, outside -1 to 1"
    );
    let broken = |p: OperatingPoint| p.t / 0.0;
    assert!(
        Stage::new(&broken)
            .unwrap()
            .at(OperatingPoint::at_time(1.0))
            .is_err()
    );
}

#[test]
fn drives() {
    let stage = Stage::new(2.0).unwrap();
    let new = |count: usize| Drive::new(Arrangement::Chain, Contact::Ideal, &vec![stage; count]);
    assert_eq!(
        text(new(0)),
        "number of friction stages is 0, but must be greater than zero"
    );
    assert_eq!(text(new(9)), "too many friction stages: at most 8 fit");
    assert!(new(8).is_ok());
    let drive = new(1).unwrap();
    let shafts = [Shaft::new(0.1, 0.0), Shaft::new(0.0, 0.0)];
    let at = |omega: f64, angles: &[f64]| {
        drive.forward(
            State {
                t: 0.0,
                angles,
                omega,
            },
            &shafts,
        )
    };
    assert!(at(1.0, &[0.0, 0.0]).is_ok());
    assert_eq!(
        text(at(1.0, &[0.0])),
        "number of angles is 1, outside 2 to 2"
    );
    assert_eq!(
        text(at(f64::NAN, &[0.0, 0.0])),
        "speed is not a finite number"
    );
    assert_eq!(
        text(at(1.0, &[0.0, f64::NAN])),
        "angle of a shaft is not a finite number"
    );
    let state = State {
        t: 0.0,
        angles: &[0.0, 0.0],
        omega: 1.0,
    };
    assert_eq!(
        text(drive.forward(state, &shafts[..1])),
        "number of shafts is 1, outside 2 to 2"
    );
    assert_eq!(
        text(drive.forward(state, &[Shaft::default(); 2])),
        "inertia of the friction drive is 0, but must be greater than zero"
    );
    assert_eq!(
        text(drive.inverse(state, f64::INFINITY, &shafts)),
        "acceleration is not a finite number"
    );
}

/// Slip that grows so fast with the load that load and slip do not converge.
#[test]
fn load_and_slip_that_do_not_settle() {
    let steep = |p: OperatingPoint| (p.load * 40.0).sin_cos().0 * 0.9;
    let stage = Stage::new(1.0)
        .unwrap()
        .with_slip(&steep, Flow::FirstDrives)
        .unwrap();
    let drive = Drive::new(Arrangement::Chain, Contact::Slipping, &[stage]).unwrap();
    let shafts = [Shaft::new(0.1, 50.0), Shaft::new(0.4, -3.0)];
    let state = State {
        t: 0.0,
        angles: &[0.0, 0.0],
        omega: 5.0,
    };
    assert_eq!(
        text(drive.forward(state, &shafts)),
        "load and slip of the friction drive do not settle; let the one depend less on the other"
    );
}

#[test]
fn mechanisms() {
    let constant = Stage::new(2.0).unwrap();
    let course = Sine::new(
        Variable::Time,
        SineShape {
            mean: 1.0,
            amplitude: 0.1,
            frequency: 1.0,
            phase: 0.0,
        },
    )
    .unwrap();
    let varying = Stage::new(&course).unwrap();
    let new =
        |stages: &[Stage], inertias: &[f64]| FrictionDrive::new(Arrangement::Fan, stages, inertias);
    assert_eq!(
        text(new(&[constant, varying], &[1.0, 1.0, 1.0])),
        "the ratio or slip of friction stage 1 varies: the angle of its second shaft need not be a function of the \
         drive angle; give numbers, or use the friction drive's own equation of motion"
    );
    assert_eq!(
        text(new(&[constant], &[1.0])),
        "number of inertias is 1, outside 2 to 2"
    );
    assert_eq!(
        text(new(&[constant], &[1.0, -1.0])),
        "inertia is -1, but must not be negative"
    );
    assert_eq!(
        text(new(&[], &[1.0])),
        "number of friction stages is 0, but must be greater than zero"
    );
    assert_eq!(
        text(new(&[constant; 9], &[1.0; 10])),
        "too many friction stages: at most 8 fit"
    );
}
