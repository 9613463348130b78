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

fn slider_crank(r: f64, l: f64, e: f64) -> Result<SliderCrank, BuildError> {
    let link = Link::new(MassProperties {
        mass: 0.1,
        inertia: 0.001,
        com: [0.0, 0.0],
    })?;
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
#[expect(clippy::too_many_lines, reason = "a table of cases")]
fn nothing_that_is_not_finite_gets_into_a_machine() {
    let cases: &[Case] = &[
        ("mass", |x| {
            Link::new(MassProperties {
                mass: x,
                inertia: 0.0,
                com: [0.0; 2],
            })
            .map(drop)
            .map_err(Into::into)
        }),
        ("inertia", |x| {
            Link::new(MassProperties {
                mass: 0.0,
                inertia: x,
                com: [0.0; 2],
            })
            .map(drop)
            .map_err(Into::into)
        }),
        ("com u", |x| {
            Link::new(MassProperties {
                mass: 0.0,
                inertia: 0.0,
                com: [x, 0.0],
            })
            .map(drop)
            .map_err(Into::into)
        }),
        ("com v", |x| {
            Link::new(MassProperties {
                mass: 0.0,
                inertia: 0.0,
                com: [0.0, x],
            })
            .map(drop)
            .map_err(Into::into)
        }),
        ("rotor", |x| Link::rotor(x).map(drop).map_err(Into::into)),
        ("crank", |x| {
            slider_crank(x, 0.3, 0.0).map(drop).map_err(Into::into)
        }),
        ("rod", |x| {
            slider_crank(0.1, x, 0.0).map(drop).map_err(Into::into)
        }),
        ("offset", |x| {
            slider_crank(0.1, 0.3, x).map(drop).map_err(Into::into)
        }),
        ("crank angle", |x| {
            machine().reduction(x).map(drop).map_err(Into::into)
        }),
        ("input angle", |x| {
            Train::new(&[])?.frames(x).map(drop).map_err(Into::into)
        }),
        ("ratio", |x| {
            Stage::new(x, [0.0; 2]).map(drop).map_err(Into::into)
        }),
        ("driver", |x| {
            Stage::new(1.0, [x, 0.0]).map(drop).map_err(Into::into)
        }),
        ("driven", |x| {
            Stage::new(1.0, [0.0, x]).map(drop).map_err(Into::into)
        }),
        ("gears", |x| {
            Stage::gears(GearDimensions {
                teeth: [9, 9],
                inertias: [x, 0.0],
                mesh: Mesh::Internal,
            })
            .map(drop)
            .map_err(Into::into)
        }),
        ("gears", |x| {
            Stage::gears(GearDimensions {
                teeth: [9, 9],
                inertias: [0.0, x],
                mesh: Mesh::Internal,
            })
            .map(drop)
            .map_err(Into::into)
        }),
        ("pulley", |x| {
            Stage::belt(BeltDimensions {
                radii: [x, 0.1],
                inertias: [0.0; 2],
                mass: 0.0,
            })
            .map(drop)
            .map_err(Into::into)
        }),
        ("pulley", |x| {
            Stage::belt(BeltDimensions {
                radii: [0.1, x],
                inertias: [0.0; 2],
                mass: 0.0,
            })
            .map(drop)
            .map_err(Into::into)
        }),
        ("pulley", |x| {
            Stage::belt(BeltDimensions {
                radii: [0.1, 0.1],
                inertias: [x, 0.0],
                mass: 0.0,
            })
            .map(drop)
            .map_err(Into::into)
        }),
        ("pulley", |x| {
            Stage::belt(BeltDimensions {
                radii: [0.1, 0.1],
                inertias: [0.0, x],
                mass: 0.0,
            })
            .map(drop)
            .map_err(Into::into)
        }),
        ("belt", |x| {
            Stage::belt(BeltDimensions {
                radii: [0.1, 0.1],
                inertias: [0.0; 2],
                mass: x,
            })
            .map(drop)
            .map_err(Into::into)
        }),
        ("efficiency", |x| {
            Stage::new(1.0, [0.0; 2])?
                .with_efficiency(x)
                .map(drop)
                .map_err(Into::into)
        }),
        ("gravity", |x| {
            machine()
                .with_gravity([x, 0.0])
                .map(drop)
                .map_err(Into::into)
        }),
        ("gravity", |x| {
            machine()
                .with_gravity([0.0, x])
                .map(drop)
                .map_err(Into::into)
        }),
        ("flywheel", |x| {
            machine().with_flywheel(x).map(drop).map_err(Into::into)
        }),
        ("force", |x| {
            Load::new(0, Action::Force([x, 0.0]))
                .map(drop)
                .map_err(Into::into)
        }),
        ("force", |x| {
            Load::new(0, Action::Force([0.0, x]))
                .map(drop)
                .map_err(Into::into)
        }),
        ("moment", |x| {
            Load::new(0, Action::Moment(x))
                .map(drop)
                .map_err(Into::into)
        }),
        ("friction", |x| {
            Load::new(0, Action::OpposingForce(x))
                .map(drop)
                .map_err(Into::into)
        }),
        ("friction", |x| {
            Load::new(0, Action::OpposingMoment(x))
                .map(drop)
                .map_err(Into::into)
        }),
        ("viscous", |x| {
            Load::new(0, Action::ViscousForce(x))
                .map(drop)
                .map_err(Into::into)
        }),
        ("viscous", |x| {
            Load::new(0, Action::ViscousMoment(x))
                .map(drop)
                .map_err(Into::into)
        }),
        ("point", |x| {
            Load::new(0, Action::Moment(1.0))?
                .at([x, 0.0])
                .map(drop)
                .map_err(Into::into)
        }),
        ("point", |x| {
            Load::new(0, Action::Moment(1.0))?
                .at([0.0, x])
                .map(drop)
                .map_err(Into::into)
        }),
    ];
    refused(cases);
}

#[test]
fn nothing_that_is_not_finite_gets_into_motions_scales_and_requests() {
    let cases: &[Case] = &[
        ("window", |x| {
            Window::new(Domain::Turn, [x, 1.0], 0.1)
                .map(drop)
                .map_err(Into::into)
        }),
        ("window", |x| {
            Window::new(Domain::Turn, [0.0, x], 0.1)
                .map(drop)
                .map_err(Into::into)
        }),
        ("window", |x| {
            Window::new(Domain::Turn, [0.0, 1.0], x)
                .map(drop)
                .map_err(Into::into)
        }),
        ("scale", |x| scale(x, 1.0, 1.0)),
        ("scale", |x| scale(1.0, x, 1.0)),
        ("scale", |x| scale(1.0, 1.0, x)),
        ("covering", |x| {
            Scale::covering(&machine(), x, 1.0, 4)
                .map(drop)
                .map_err(Into::into)
        }),
        ("covering", |x| {
            Scale::covering(&machine(), 1.0, x, 4)
                .map(drop)
                .map_err(Into::into)
        }),
        ("stroke", |x| {
            Domain::stroke(x, 1.0).map(drop).map_err(Into::into)
        }),
        ("stroke", |x| {
            Domain::stroke(0.0, x).map(drop).map_err(Into::into)
        }),
        ("move", |x| {
            Move::new(Law::Cycloidal, x, 1.0, 1.0)
                .map(drop)
                .map_err(Into::into)
        }),
        ("move", |x| {
            Move::new(Law::Cycloidal, 0.0, x, 1.0)
                .map(drop)
                .map_err(Into::into)
        }),
        ("move", |x| {
            Move::new(Law::Cycloidal, 0.0, 1.0, x)
                .map(drop)
                .map_err(Into::into)
        }),
        ("move f32", |x| {
            Move::new(Law::Cycloidal, 0.0, 1.0, x as f32)
                .map(drop)
                .map_err(Into::into)
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
            CubicSpline::new([0.0, 0.0, 0.0, x, 0.0, 0.0, 0.0])
                .map(drop)
                .map_err(Into::into)
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
    Scale::new(Bases {
        torque: torque as f32,
        speed: speed as f32,
        inertia: inertia as f32,
    })
    .map(drop)
    .map_err(Into::into)
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
