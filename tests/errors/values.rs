//! Quantities outside their range, and too many parts.

use jred::error::Error;
use jred::machine::motion::{Law, Move};
use jred::machine::{Action, Link, Load, MachineError, Window};
use jred::mechanism::{BeltDimensions, GearDimensions, Mesh, Stage, Train};
use jred::number::{Bases, RangeError};
use jred::table::{fit_bounded, fit_periodic};
use jred::{Domain, Scale};

use super::{machine, says, slider_crank};

#[test]
fn lengths_and_masses_out_of_bounds_are_named() {
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
    let error = says(Link::point_mass(-2.5), &["mass", "-2.5", "not be negative"]);
    assert_eq!(error, Error::Range(RangeError::Negative("mass", -2.5)));
    says(Link::rotor(-0.5), &["inertia", "-0.5"]);
    says(Link::rotor(f64::NAN), &["inertia", "not a finite number"]);
}

#[test]
fn stages_out_of_bounds_are_named() {
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
}

#[test]
fn loads_out_of_bounds_are_named() {
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
}

#[test]
fn scales_out_of_bounds_are_named() {
    let scale = |torque, speed, inertia| {
        Scale::new(Bases {
            torque,
            speed,
            inertia,
        })
    };
    says(scale(0.0, 1.0, 1.0), &["torque base", "0"]);
    says(scale(1.0, -2.0, 1.0), &["speed base", "-2"]);
    says(scale(1.0, 1.0, -2.0), &["inertia base", "-2"]);
    says(
        Scale::covering(&machine(), -2.0, 1.0, 8),
        &["largest speed", "-2"],
    );
    says(
        Scale::covering(&machine(), 2.0, -1.0, 8),
        &["largest acceleration", "-1"],
    );
}

#[test]
fn strokes_and_motion_laws_out_of_bounds_are_named() {
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

/// The message names the given value.
#[test]
fn negative_duration_is_named() {
    says(
        Move::new(Law::Cycloidal, 0.0, 1.0, -2.5),
        &["duration of the move", "-2.5"],
    );
}

/// A negative inertia is refused, even if the belt's inertia outweighs it.
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

/// The number and its limit are consistent: four samples over a stroke are too few, five are enough.
#[test]
fn too_few_samples_are_counted() {
    says(
        fit_periodic(&[1.0; 3], &mut [0.0; 6]),
        &["number of samples", "3", "4"],
    );
    assert!(fit_bounded(&[1.0; 5], &mut [0.0; 7]).is_ok());
    says(
        fit_bounded(&[1.0; 4], &mut [0.0; 6]),
        &["number of samples", "4", "less than 5"],
    );
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

/// The cure of each error works: each kind has its own cure, with the limit in it.
#[test]
fn every_quantity_out_of_range_has_its_cure() {
    let range = |min, max| RangeError::OutOfRange {
        what: "x",
        value: 7.0,
        min,
        max,
    };
    for (error, cure) in [
        (RangeError::NotFinite("x"), "neither NaN nor infinite"),
        (RangeError::NotPositive("x", 0.0), "greater than zero"),
        (RangeError::Negative("x", -1.0), "zero or a positive value"),
        (range(8.0, f64::INFINITY), "at least 8"),
        (range(1.5, 2.5), "from 1.5 to 2.5"),
        (
            RangeError::TooMany {
                what: "loads",
                capacity: 3,
            },
            "leave some out",
        ),
        (
            RangeError::BufferTooShort {
                needed: 12,
                given: 9,
            },
            "give it 12 elements",
        ),
    ] {
        let found = error.cure().to_string();
        assert!(found.contains(cure), "{error}: \"{found}\"");
        assert_eq!(format!("{:?}", error.cure()), format!("Cure({found})"));
    }
}

/// Three coordinates per link, one degree of freedom required: with more left the links must be held, with fewer they are held twice.
#[test]
fn a_mechanism_too_free_or_too_stiff_is_cured_the_other_way_round() {
    let of = |constraints: usize| {
        MachineError::Mobility {
            links: 3,
            constraints,
        }
        .cure()
        .to_string()
    };
    for free in [2, 6, 7] {
        assert!(of(free).starts_with("hold the links"), "{free}");
    }
    for stiff in [9, 12] {
        assert!(of(stiff).starts_with("leave out a joint"), "{stiff}");
    }
}
