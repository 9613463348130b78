//! Every error of the core: some input produces it, and its text names quantity, value and cure.

use jred::machine::{MachineError, PoseError};
use jred::mechanism::{Blocked, BuildError, SliderCrankDimensions};
use jred::number::{RangeError, Transfer};
use std::f64::consts::PI;

use crate::support::machines::Wave;
use crate::support::rows::Rows;
use crate::support::{assert_near, budget, scale_of};
use jred::machine::motion::{Law, Move};
use jred::machine::{Action, Element, Frame, Frames, Load, Marker, Mechanism, Window};
use jred::mechanism::{
    BeltDimensions, Branch, GearDimensions, Geneva, Mesh, RackAndPinion, SliderCrank, Stage, Train,
};
use jred::number::Bases;
use jred::table::{CubicSpline, Format, MAX_CELLS, fit_bounded, fit_periodic};
use jred::tabulate::{Request, fill, tabulate};
use jred::{Domain, Error, Link, Machine, Q31, Reducible, Scale, Set, Spline, TableError, curves};

/// The error, after checking that its text holds every part.
#[track_caller]
fn says<T: std::fmt::Debug, E: Into<Error> + std::fmt::Debug>(
    result: Result<T, E>,
    parts: &[&str],
) -> Error {
    let error = result.unwrap_err().into();
    let text = format!("{error}; {}", error.cure());
    for part in parts {
        assert!(text.contains(part), "\"{text}\" does not say \"{part}\"");
    }
    error
}

fn links() -> [Link; 3] {
    [0.1, 0.2, 0.3].map(|mass| Link::new(mass, 0.001, [0.0, 0.0]).unwrap())
}

fn slider_crank(r: f64, l: f64, e: f64) -> Result<SliderCrank, BuildError> {
    SliderCrank::new(
        SliderCrankDimensions {
            crank: r,
            rod: l,
            offset: e,
        },
        Branch::Right,
        links(),
    )
}

/// The table of a machine, or why there is none.
fn rows<S: jred::number::Scalar>(
    machine: &impl Reducible,
    set: Set,
    cells: u32,
    scale: &Scale,
) -> Result<Vec<<Spline<S> as Format>::Word>, Error> {
    Rows::<Spline<S>>::of(machine, set, cells, scale).map(|rows| rows.words)
}

fn machine() -> Machine<SliderCrank> {
    Machine::new(slider_crank(0.1, 0.3, 0.0).unwrap())
}

#[test]
fn values_out_of_bounds_are_named() {
    let error = says(
        slider_crank(-0.1, 0.3, 0.0),
        &["crank length", "-0.1", "greater than zero"],
    );
    assert_eq!(
        error,
        Error::Range(RangeError::NotPositive("crank length", -0.1))
    );
    says(
        slider_crank(0.1, 0.0, 0.0),
        &["rod length", "0", "greater than zero"],
    );
    let error = says(
        Link::new(-2.5, 0.0, [0.0; 2]),
        &["mass", "-2.5", "not be negative"],
    );
    assert_eq!(error, Error::Range(RangeError::Negative("mass", -2.5)));
    says(Link::rotor(-0.5), &["inertia", "-0.5"]);
    says(Link::rotor(f64::NAN), &["inertia", "not a finite number"]);
    says(
        Stage::gears(GearDimensions {
            teeth: [0, 20],
            inertias: [0.0; 2],
            mesh: Mesh::External,
        }),
        &["teeth of the driver", "0"],
    );
    says(
        Stage::gears(GearDimensions {
            teeth: [20, 0],
            inertias: [0.0; 2],
            mesh: Mesh::Internal,
        }),
        &["teeth of the driven", "0"],
    );
    says(Stage::new(0.0, [0.0; 2]), &["ratio", "0"]);
    says(
        Stage::new(2.0, [-0.5, 0.0]),
        &["inertia of the driver", "-0.5"],
    );
    says(
        Stage::new(2.0, [0.0, -0.5]),
        &["inertia of the driven", "-0.5"],
    );
    says(
        Stage::belt(BeltDimensions {
            radii: [0.1, 0.0],
            inertias: [0.0; 2],
            mass: 1.0,
        }),
        &["radius of the driven", "0"],
    );
    says(
        Stage::belt(BeltDimensions {
            radii: [0.1, 0.2],
            inertias: [0.0; 2],
            mass: -1.0,
        }),
        &["mass of the belt", "-1"],
    );
    let stage = Stage::new(2.0, [0.0; 2]).unwrap();
    says(
        stage.with_efficiency(1.25),
        &["efficiency", "1.25", "outside 0 to 1"],
    );
    says(stage.with_efficiency(0.0), &["efficiency", "0"]);
    says(machine().with_flywheel(-0.25), &["flywheel", "-0.25"]);
    says(
        Load::new(0, Action::OpposingForce(-3.0)),
        &["opposing force", "-3"],
    );
    says(
        Load::new(0, Action::OpposingMoment(-3.0)),
        &["opposing moment", "-3"],
    );
    says(Load::new(0, Action::ViscousForce(-3.0)), &["viscous", "-3"]);
    says(
        Load::new(0, Action::ViscousMoment(-3.0)),
        &["viscous", "-3"],
    );
    says(
        Scale::new(Bases {
            torque: 0.0,
            speed: 1.0,
            inertia: 1.0,
        }),
        &["torque base", "0"],
    );
    says(
        Scale::new(Bases {
            torque: 1.0,
            speed: -2.0,
            inertia: 1.0,
        }),
        &["speed base", "-2"],
    );
    says(
        Scale::new(Bases {
            torque: 1.0,
            speed: 1.0,
            inertia: -2.0,
        }),
        &["inertia base", "-2"],
    );
    says(
        Scale::covering(&machine(), -2.0, 1.0, 8),
        &["largest speed", "-2"],
    );
    says(
        Scale::covering(&machine(), 2.0, -1.0, 8),
        &["largest acceleration", "-1"],
    );
    says(Domain::stroke(2.0, 1.5), &["length of the stroke", "-0.5"]);
    let trapezoid = |accelerate, decelerate| {
        Law::Trapezoid {
            accelerate,
            decelerate,
        }
        .check()
    };
    says(trapezoid(0.75, 0.5), &["accelerate", "1.25", "1"]);
    says(trapezoid(0.0, 0.5), &["accelerate", "0"]);
    says(trapezoid(0.5, -0.5), &["decelerate", "-0.5"]);
    says(
        Move::new(trapezoid_law(), 0.0, 1.0, 0.0),
        &["duration", "0"],
    );
}

#[test]
fn windows_out_of_bounds_are_named() {
    let window = |range, ramp| Window::new(Domain::Turn, range, ramp);
    says(window([1.0, 1.5], 0.0), &["ramp", "0"]);
    says(window([1.0, 0.5], 0.1), &["width", "-0.5"]);
    says(window([1.0, 1.5], 0.3), &["width", "0.5", "0.6"]);
    says(window([0.0, 7.0], 0.3), &["width", "7", "6.28"]);
}

fn trapezoid_law() -> Law {
    Law::Trapezoid {
        accelerate: 0.5,
        decelerate: 0.5,
    }
}

/// The text names the value given.
#[test]
fn negative_duration_is_named() {
    says(
        Move::new(Law::Cycloidal, 0.0, 1.0, -2.5),
        &["duration of the move", "-2.5"],
    );
}

/// A negative inertia is refused, whatever the belt adds to it.
#[test]
fn negative_pulley_is_refused_beside_a_heavy_belt() {
    says(
        Stage::belt(BeltDimensions {
            radii: [0.5, 0.2],
            inertias: [-0.01, 0.0],
            mass: 1.0,
        }),
        &["inertia of the driver", "-0.01"],
    );
}

/// The number and its limit agree: four samples over a stroke are too few, five are enough.
#[test]
fn too_few_samples_are_counted() {
    says(
        fit_periodic(&[1.0; 3], &mut [0.0; 6]),
        &["number of samples", "3", "4"],
    );
    assert!(fit_bounded(&[1.0; 5], &mut [0.0; 7]).is_ok());
    says(
        fit_bounded(&[1.0; 4], &mut [0.0; 6]),
        &["number of samples", "4", "outside 5"],
    );
}

/// l < r + |e|: where the rod no longer reaches the guide, by geometry, for each sign of e and l − |e|.
#[test]
fn short_rod_names_its_angle() {
    for (r, l, e) in [
        (0.1, 0.08, 0.01),
        (0.1, 0.08, -0.01),
        (0.1, 0.12, 0.05),
        (0.1, 0.12, -0.05),
        (0.2, 0.2, 0.0),
    ] {
        let error = says(
            slider_crank(r, l, e),
            &["make the rod longer than", "shorten the crank"],
        );
        let Error::Build(BuildError::Blocked(Blocked::TooShort { phi, shortest, .. })) = error
        else {
            panic!("{error:?}")
        };
        assert_near("shortest rod", shortest, r + e.abs(), f64::EPSILON);
        let degrees = format!("φ = {:.2}°", phi.to_degrees());
        assert!(
            error.to_string().contains(&degrees),
            "{error} does not say {degrees}"
        );
        // Walk: the rod reaches until φ, and no longer just after (at its very end when l = r + |e|).
        let reaches = |phi: f64| (e - r * phi.sin()).abs() <= l * (1.0 + budget::IDENTITY);
        let steps = 10_000;
        assert!(
            (0..=steps).all(|k| reaches(phi * f64::from(k) / f64::from(steps))),
            "fails before {phi}"
        );
        assert_near(
            "at the end of its reach",
            (e - r * phi.sin()).abs(),
            l,
            budget::CLOSED_FORM,
        );
        assert!(
            l >= r + e.abs() || !reaches(phi + 1e-3),
            "goes on after {phi}"
        );
    }
    // A guide further away than the rod is long is not reached at φ = 0.
    let error = says(slider_crank(0.1, 0.3, -0.4), &["φ = 0.00°", "0.500000 m"]);
    let blocked = Blocked::TooShort {
        link: "rod",
        phi: 0.0,
        shortest: 0.5,
    };
    assert_eq!(error, Error::Build(BuildError::Blocked(blocked)));
}

/// l = r + |e| exactly, but for a rounding: the angle is 270°, not a full turn.
#[test]
fn rod_of_the_limit_length_names_its_angle() {
    let (r, e) = (0.1, 0.2);
    let error = slider_crank(r, r + e, e).unwrap_err();
    let BuildError::Blocked(Blocked::TooShort { phi, .. }) = error else {
        panic!("{error:?}")
    };
    assert_near("φ", phi, 1.5 * PI, budget::LIMIT_ANGLE);
}

/// The constructor refuses what roundings could make a dead point of: what it accepts has a position at every angle.
#[test]
fn a_rod_of_a_hair_more_than_the_limit_turns_fully_or_is_refused() {
    let r = 0.807_812_5; // one for which l·(1/l) rounds to r/l = 1
    let refused = slider_crank(r, f64::next_up(r), 0.0).unwrap_err();
    assert!(
        matches!(refused, BuildError::Blocked(Blocked::TooShort { .. })),
        "{refused:?}"
    );
    let mechanism = slider_crank(r, r * (1.0 + 2e-12), 0.0).unwrap();
    for phi in [0.5 * PI, 1.5 * PI] {
        let frames = mechanism.frames(phi).unwrap();
        assert!(frames[1].psi.d3.is_finite(), "φ = {phi}");
    }
}

#[test]
fn capacities_and_indices_are_named() {
    let load = Load::new(3, Action::Moment(1.0)).unwrap();
    let error = says(machine().with_load(load), &["no link 3", "0 to 2"]);
    assert_eq!(
        error,
        Error::Machine(MachineError::NoSuchLink { link: 3, links: 3 })
    );
    let mut full = machine();
    for _ in 0..jred::machine::MAX_LOADS {
        full = full
            .with_load(Load::new(0, Action::Moment(1.0)).unwrap())
            .unwrap();
    }
    assert_eq!(full.loads().len(), 16);
    says(
        full.with_load(Load::new(0, Action::Moment(1.0)).unwrap()),
        &["too many loads", "16"],
    );
    let stage = Stage::new(2.0, [0.0; 2]).unwrap();
    assert!(Train::new(&[stage; jred::machine::MAX_STAGES]).is_ok());
    says(
        Train::new(&[stage; jred::machine::MAX_STAGES + 1]),
        &["too many stages", "8"],
    );
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
    // The middle of J is stored by itself; J is up to 3.7 with a middle that fits.
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
        .with_omega(10.0)
        .with_alpha(10.0)
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
            .with_omega(omega)
            .with_alpha(alpha)
            .with_max_cells(16);
        let refused =
            tabulate::<Spline<f32>>(&wave, 0, &bad, &Scale::SI, &mut [0.0; 38], &mut rows);
        says(refused, &["greater than zero"]);
    }
    says(CubicSpline::new([0.0; 6]), &["holds 6", "7"]);
}

/// One turn's table of a rack that pulls a spring would be wrong from the second turn on.
#[test]
fn a_load_that_does_not_repeat_is_not_tabulated() {
    let rack = Link::new(2.0, 0.0, [0.0, 0.0]).unwrap();
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

/// A slider that a spiral pushes out: no load at all, but its reduced mass (0.02·φ)²·m grows from turn to turn.
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
    let spiral = Spiral([Link::new(2.0, 0.0, [0.0, 0.0]).unwrap()]);
    let machine = Machine::new(spiral).with_flywheel(0.01).unwrap();
    let refused = rows::<f64>(&machine, 0, 16, &Scale::SI).unwrap_err();
    assert_eq!(refused, Error::Pose(PoseError::NotPeriodic { phi: 0.4 }));
}

/// Geneva wheel: a force of fixed direction on it turns with the stations, even if it acts in a part of the turn only, where
/// none of a few samples would see it. A spring whose ends meet has no direction.
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
