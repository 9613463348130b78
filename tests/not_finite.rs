//! The core refuses every value that is not finite.

use crate::support::machines::Wave;
use jred::error::Error;
use jred::machine::motion::{Law, Move};
use jred::machine::{Action, Link, Load, Machine, MassProperties, Mechanism, Reducible, Window};
use jred::mechanism::{
    BeltDimensions, Branch, BuildError, GearDimensions, Mesh, SliderCrank, SliderCrankDimensions,
    Stage, Train,
};
use jred::number::Bases;
use jred::number::RangeError;
use jred::table::CubicSpline;
use jred::tabulate::{Request, tabulate};
use jred::{Domain, Scale, Spline, curves};

/// A case needs the error alone.
fn made<T, E: Into<Error>>(made: Result<T, E>) -> Result<(), Error> {
    made.map(drop).map_err(Into::into)
}

fn link(mass: f64, inertia: f64, com: [f64; 2]) -> Result<Link, RangeError> {
    Link::new(MassProperties { mass, inertia, com })
}

fn gears(inertias: [f64; 2]) -> Result<Stage, RangeError> {
    Stage::gears(GearDimensions {
        teeth: [9, 9],
        inertias,
        mesh: Mesh::Internal,
    })
}

fn belt(radii: [f64; 2], inertias: [f64; 2], mass: f64) -> Result<Stage, RangeError> {
    Stage::belt(BeltDimensions {
        radii,
        inertias,
        mass,
    })
}

fn slider_crank(r: f64, l: f64, e: f64) -> Result<SliderCrank, BuildError> {
    let link = link(0.1, 0.001, [0.0; 2])?;
    SliderCrank::new(
        SliderCrankDimensions {
            crank: r,
            rod: l,
            offset: e,
        },
        Branch::Right,
        [link; 3],
    )
}

fn machine() -> Machine<SliderCrank> {
    Machine::new(slider_crank(0.1, 0.3, 0.0).unwrap())
}

type Case = (&'static str, fn(f64) -> Result<(), Error>);

/// NaN and infinity in every argument of every constructor.
#[test]
fn nothing_that_is_not_finite_gets_into_a_machine() {
    let cases: &[Case] = &[
        ("mass", |x| made(link(x, 0.0, [0.0; 2]))),
        ("inertia", |x| made(link(0.0, x, [0.0; 2]))),
        ("com u", |x| made(link(0.0, 0.0, [x, 0.0]))),
        ("com v", |x| made(link(0.0, 0.0, [0.0, x]))),
        ("rotor", |x| made(Link::rotor(x))),
        ("crank", |x| made(slider_crank(x, 0.3, 0.0))),
        ("rod", |x| made(slider_crank(0.1, x, 0.0))),
        ("offset", |x| made(slider_crank(0.1, 0.3, x))),
        ("crank angle", |x| made(machine().reduction(x))),
        ("input angle", |x| made(Train::new(&[])?.frames(x))),
        ("ratio", |x| made(Stage::new(x, [0.0; 2]))),
        ("driver", |x| made(Stage::new(1.0, [x, 0.0]))),
        ("driven", |x| made(Stage::new(1.0, [0.0, x]))),
        ("gears", |x| made(gears([x, 0.0]))),
        ("gears", |x| made(gears([0.0, x]))),
        ("pulley", |x| made(belt([x, 0.1], [0.0; 2], 0.0))),
        ("pulley", |x| made(belt([0.1, x], [0.0; 2], 0.0))),
        ("pulley", |x| made(belt([0.1, 0.1], [x, 0.0], 0.0))),
        ("pulley", |x| made(belt([0.1, 0.1], [0.0, x], 0.0))),
        ("belt", |x| made(belt([0.1, 0.1], [0.0; 2], x))),
        ("efficiency", |x| {
            made(Stage::new(1.0, [0.0; 2])?.with_efficiency(x))
        }),
        ("gravity", |x| made(machine().with_gravity([x, 0.0]))),
        ("gravity", |x| made(machine().with_gravity([0.0, x]))),
        ("flywheel", |x| made(machine().with_flywheel(x))),
        ("force", |x| made(Load::new(0, Action::Force([x, 0.0])))),
        ("force", |x| made(Load::new(0, Action::Force([0.0, x])))),
        ("moment", |x| made(Load::new(0, Action::Moment(x)))),
        ("friction", |x| made(Load::new(0, Action::OpposingForce(x)))),
        ("friction", |x| {
            made(Load::new(0, Action::OpposingMoment(x)))
        }),
        ("viscous", |x| made(Load::new(0, Action::ViscousForce(x)))),
        ("viscous", |x| made(Load::new(0, Action::ViscousMoment(x)))),
        ("point", |x| {
            made(Load::new(0, Action::Moment(1.0))?.at([x, 0.0]))
        }),
        ("point", |x| {
            made(Load::new(0, Action::Moment(1.0))?.at([0.0, x]))
        }),
    ];
    refused(cases);
}

#[test]
fn nothing_that_is_not_finite_gets_into_motions_scales_and_requests() {
    let cases: &[Case] = &[
        ("window", |x| made(Window::new(Domain::Turn, [x, 1.0], 0.1))),
        ("window", |x| made(Window::new(Domain::Turn, [0.0, x], 0.1))),
        ("window", |x| made(Window::new(Domain::Turn, [0.0, 1.0], x))),
        ("scale", |x| scale(x, 1.0, 1.0)),
        ("scale", |x| scale(1.0, x, 1.0)),
        ("scale", |x| scale(1.0, 1.0, x)),
        ("covering", |x| made(Scale::covering(&machine(), x, 1.0, 4))),
        ("covering", |x| made(Scale::covering(&machine(), 1.0, x, 4))),
        ("stroke", |x| made(Domain::stroke(x, 1.0))),
        ("stroke", |x| made(Domain::stroke(0.0, x))),
        ("move", |x| made(Move::new(Law::Cycloidal, x, 1.0, 1.0))),
        ("move", |x| made(Move::new(Law::Cycloidal, 0.0, x, 1.0))),
        ("move", |x| made(Move::new(Law::Cycloidal, 0.0, 1.0, x))),
        ("move f32", |x| {
            made(Move::new(Law::Cycloidal, 0.0, 1.0, x as f32))
        }),
        ("law", |x| {
            Law::Trapezoid {
                accelerate: x,
                decelerate: 0.1,
            }
            .check()
            .map_err(Into::into)
        }),
        ("law", |x| {
            Law::Trapezoid {
                accelerate: 0.1,
                decelerate: x,
            }
            .check()
            .map_err(Into::into)
        }),
        ("spline", |x| {
            made(CubicSpline::new([0.0, 0.0, 0.0, x, 0.0, 0.0, 0.0]))
        }),
        ("request", |x| request(x, 1.0, 1.0)),
        ("request", |x| request(1.0, x, 1.0)),
        ("request", |x| request(1.0, 1.0, x)),
    ];
    refused(cases);
}

fn refused(cases: &[Case]) {
    for (name, build) in cases {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let found = build(value);
            assert!(
                matches!(found, Err(Error::Range(RangeError::NotFinite(_)))),
                "{name} {value}: {found:?}"
            );
        }
    }
}

fn scale(torque: f64, speed: f64, inertia: f64) -> Result<(), Error> {
    made(Scale::new(Bases {
        torque: torque as f32,
        speed: speed as f32,
        inertia: inertia as f32,
    }))
}

fn request(torque_error: f64, omega: f64, alpha: f64) -> Result<(), Error> {
    let request = Request::new(torque_error)
        .with_max_speed(omega)
        .with_max_acceleration(alpha)
        .with_max_cells(8);
    tabulate::<Spline<f32>>(
        &Wave::bare(1.0, 0.1),
        curves::INERTIA,
        &request,
        &Scale::SI,
        &mut [0.0; 22],
        &mut [0.0; 11],
    )
    .map(drop)
}
