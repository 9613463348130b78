//! Machines without a table, and words that are not a table.

use jred::error::Error;
use jred::machine::{
    Action, Element, Frame, Frames, Link, Load, Machine, Marker, MassProperties, Mechanism,
    PoseError, Reducible, Window,
};
use jred::mechanism::{Branch, Geneva, RackAndPinion, SliderCrank, SliderCrankDimensions};
use jred::number::{RangeError, Transfer};
use jred::table::{CubicSpline, Format, MAX_CELLS, TableError};
use jred::tabulate::{Request, fill, tabulate};
use jred::{CurveSet, Domain, Q31, Scale, Spline, curves};

use super::says;
use crate::support::machines::Wave;
use crate::support::rows::Rows;
use crate::support::scale_of;

/// The table of a machine, or the reason for its absence.
fn rows<S: jred::number::Scalar>(
    machine: &impl Reducible,
    set: CurveSet,
    cells: u32,
    scale: &Scale,
) -> Result<Vec<<Spline<S> as Format>::Word>, Error> {
    Rows::<Spline<S>>::of(machine, set, cells, scale).map(|rows| rows.words)
}

#[test]
fn tables_that_cannot_be_made_say_why() {
    let nothing = Link::rotor(0.0).unwrap();
    let massless = SliderCrank::new(
        SliderCrankDimensions {
            crank: 0.1,
            rod: 0.3,
            offset: 0.0,
        },
        Branch::Right,
        [nothing; 3],
    )
    .unwrap();
    says(
        Machine::new(massless).reduction(1.0),
        &["reduced inertia", "57.30°", "give the drive link"],
    );
    let wave = Wave::bare(1.0, 0.5);
    let small = scale_of(1.0, 1.0, 1.0);
    // The middle of J is stored separately; J is up to 3.7 with a middle that fits.
    for heavy in [Wave::bare(3.0, 0.5), Wave::bare(1.9, 1.8)] {
        let error = says(
            rows::<Q31>(&heavy, 0, 16, &small),
            &["inertia base", "cell", "larger"],
        );
        let base = "inertia";
        assert!(
            matches!(error, Error::Table(TableError::Overflow { base: b, .. }) if b == base),
            "{error:?}"
        );
    }
    let loaded = Wave { load: 9.0, ..wave };
    let enough = scale_of(1.0, 1.0, 4.0);
    let error = says(
        rows::<Q31>(&loaded, 1, 16, &enough),
        &["torque base", "larger"],
    );
    assert!(matches!(
        error,
        Error::Table(TableError::Overflow { base: "torque", .. })
    ));
    // The spline of samples that touch zero goes below it.
    let dips = Wave::bare(1.0, 0.999);
    says(
        rows::<f32>(&dips, 0, 5, &Scale::SI),
        &["reduced inertia", "not positive"],
    );
    let error = says(
        rows::<f32>(&wave, 0, MAX_CELLS + 1, &Scale::SI),
        &["65536 cells", "4 to 65535"],
    );
    assert!(matches!(error, Error::Table(_)));
    let mut rows = [0.0f32; 19];
    let error = says(
        fill::<Spline<f32>>(&wave, 0, 16, &Scale::SI, &mut [0.0; 37], &mut rows),
        &["holds 37", "38"],
    );
    assert_eq!(
        error,
        Error::Range(RangeError::BufferTooShort {
            needed: 38,
            given: 37
        })
    );
    says(
        fill::<Spline<f32>>(&wave, 0, 16, &Scale::SI, &mut [0.0; 38], &mut rows[..18]),
        &["holds 18", "19"],
    );
    let request = Request::new(1e-9)
        .with_max_speed(10.0)
        .with_max_acceleration(10.0)
        .with_max_cells(16);
    let parts = ["1e-9", "16 cells reach", "allow a larger error"];
    let error = says(
        tabulate::<Spline<f32>>(&wave, 0, &request, &Scale::SI, &mut [0.0; 38], &mut rows),
        &parts,
    );
    let Error::TorqueErrorNotReached { reached, .. } = error else {
        panic!("{error:?}")
    };
    assert!(reached > 1e-9 && reached < 1.0);
    for [torque_error, omega, alpha] in [[0.0, 1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, 0.0]] {
        let bad = Request::new(torque_error)
            .with_max_speed(omega)
            .with_max_acceleration(alpha)
            .with_max_cells(16);
        let refused =
            tabulate::<Spline<f32>>(&wave, 0, &bad, &Scale::SI, &mut [0.0; 38], &mut rows);
        says(refused, &["greater than zero"]);
    }
    says(CubicSpline::new([0.0; 6]), &["holds 6", "7"]);
}

/// A possible cure names the part to change; damaged words have no cure.
#[test]
fn tables_and_models_that_can_be_cured_say_how() {
    let (cell, phase) = (3, jred::Phase::default());
    for (error, cure) in [
        (
            TableError::Overflow {
                base: "speed",
                cell,
            },
            "larger speed base",
        ),
        (TableError::NoInertia { cell }, "more cells"),
        (TableError::VelocityTorque { cell }, "smaller speed base"),
        (TableError::SpeedBase, "Scale::for_cells"),
        (TableError::TorqueRange { cell }, "larger torque base"),
        (TableError::PieceUnits, "same machine units"),
        (TableError::NoInertiaAt { phase }, "more harmonics"),
        (
            TableError::InertiaNotShown { phase },
            "give the drive link an inertia",
        ),
        (TableError::Stroke, "a table"),
        (TableError::Harmonics, "harmonic::fit"),
        (TableError::SliderCrank, "slider_crank::form"),
        (TableError::ShortRod, "a table"),
        (
            TableError::Slope { cell },
            "the scale that the table was made with",
        ),
    ] {
        let found = Error::from(error).cure().to_string();
        assert!(found.contains(cure), "{error:?}: \"{found}\"");
    }
    for damaged in [
        TableError::Length {
            needed: 2,
            given: 1,
        },
        TableError::NotClosed { curve: 0 },
        TableError::Constant,
    ] {
        assert_eq!(Error::from(damaged).cure().to_string(), "");
    }
}

/// One turn's table of a rack that pulls a spring would be wrong from the second turn on.
#[test]
fn a_load_that_does_not_repeat_is_not_tabulated() {
    let rack = Link::point_mass(2.0).unwrap();
    let rack = RackAndPinion::new(0.03, [Link::rotor(0.01).unwrap(), rack]).unwrap();
    let machine = Machine::new(rack);
    assert!(rows::<f64>(&machine, curves::LOAD, 16, &Scale::SI).is_ok());
    let between = [Marker::ground([-1.0, -0.03]), Marker::on(1, [0.0, 0.0])];
    let spring = Element::spring(between, 500.0, 0.4).unwrap();
    let sprung = machine.with_element(spring).unwrap();
    let refused = rows::<f64>(&sprung, curves::LOAD, 16, &Scale::SI).unwrap_err();
    assert_eq!(refused, Error::Pose(PoseError::NotPeriodic { phi: 0.4 }));
    says::<(), _>(
        Err(refused),
        &[
            "inertia or load at φ = 22.92°",
            "a spring",
            "limit the drive by a stroke",
        ],
    );
}

/// A slider that a spiral pushes out: no load, but its reduced mass (0.02·φ)²·m grows from turn to turn.
struct Spiral([Link; 1]);

impl Mechanism for Spiral {
    fn links(&self) -> &[Link] {
        &self.0
    }
    fn domain(&self) -> Domain {
        Domain::Turn
    }
    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        let phi = Transfer::variable(phi);
        let origin = [phi * phi * 0.01, Transfer::constant(0.0)];
        Ok(std::iter::once(Frame::translating(origin)).collect())
    }
}

#[test]
fn an_inertia_that_does_not_repeat_is_not_tabulated() {
    let spiral = Spiral([Link::point_mass(2.0).unwrap()]);
    let machine = Machine::new(spiral).with_flywheel(0.01).unwrap();
    let refused = rows::<f64>(&machine, 0, 16, &Scale::SI).unwrap_err();
    assert_eq!(refused, Error::Pose(PoseError::NotPeriodic { phi: 0.4 }));
}

/// A wheel at half the speed of the drive link.
struct Half([Link; 1]);

impl Mechanism for Half {
    fn links(&self) -> &[Link] {
        &self.0
    }
    fn domain(&self) -> Domain {
        Domain::Turn
    }
    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        let psi = Transfer::variable(phi) * 0.5;
        Ok(std::iter::once(Frame::turning([0.0, 0.0], psi)).collect())
    }
}

/// Eccentric: a turn of the drive link later its weight acts on the other side.
#[test]
fn a_weight_that_does_not_come_back_is_not_tabulated() {
    let tabulated = |com: f64, gravity: f64| {
        let wheel = MassProperties {
            mass: 4.0,
            inertia: 0.3,
            com: [com, 0.0],
        };
        let machine = Machine::new(Half([Link::new(wheel).unwrap()]));
        let machine = machine.with_gravity([0.0, -gravity]).unwrap();
        rows::<f64>(&machine, curves::LOAD, 64, &Scale::SI).map(|_| ())
    };
    assert_eq!(tabulated(0.0, 9.81), Ok(()));
    assert_eq!(tabulated(0.01, 0.0), Ok(()));
    let refused = Err(Error::Pose(PoseError::NotPeriodic { phi: 0.4 }));
    assert_eq!(tabulated(0.01, 9.81), refused);
}

/// Geneva wheel: a force of fixed direction on it turns with the stations, even if it acts in a small part of the turn that a few samples would miss.
/// A spring whose ends coincide has no direction.
#[test]
fn loads_are_judged_where_they_do_not_act() {
    let crank = Link::rotor(0.02).unwrap();
    let geneva = Geneva::new(6, 0.1, [crank, Link::rotor(0.3).unwrap()]).unwrap();
    let load = |action| {
        let window = Window::new(Domain::Turn, [0.5, 1.0], 0.1).unwrap();
        let load = Load::new(Geneva::WHEEL, action).and_then(|l| l.at([0.08, 0.0]));
        load.unwrap().within(window)
    };
    let with = |action| {
        Machine::new(geneva.clone())
            .with_load(load(action))
            .unwrap()
    };
    let fill = |machine: Machine<Geneva>| rows::<f64>(&machine, curves::LOAD, 64, &Scale::SI);
    assert!(fill(with(Action::Moment(3.0))).is_ok());
    says(
        fill(with(Action::Force([0.0, 50.0]))),
        &["not the same a turn of the drive link later"],
    );

    let press = crate::support::samples(1, 3, &crate::support::machines::spec())
        .remove(0)
        .machine();
    let slider = press.mechanism().frames(0.3).unwrap()[2];
    let here = [slider.x.value, slider.y.value];
    let between = [Marker::ground(here), Marker::on(2, [0.0, 0.0])];
    let spring = Element::spring(between, 100.0, 0.1).unwrap();
    let machine = press.with_element(spring).unwrap();
    says(
        machine.reduction(0.3),
        &["ends of a spring or damper meet at φ = 17.19°", "aside"],
    );
    says(machine.forces(0.3, 1.0, 0.0), &["meet"]);
    assert!(machine.reduction(0.4).unwrap().potential_slope.is_finite());
}
