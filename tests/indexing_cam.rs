//! The indexing cam: the makers' figures, dwell and index, edges, joints and forces.

use std::f64::consts::{PI, TAU};

use crate::support::machines::loaded;
use crate::support::{assert_near, budget, config, largest, link_of, spoken};
use jred::machine::motion::Law;
use jred::machine::{Action, Jointed, Link, Load, Machine, Mechanism, PoseError, Reducible};
use jred::mechanism::{BuildError, DimensionError, IndexingCam, IndexingCamDimensions};
use jred::number::RangeError;
use proptest::prelude::*;

const TABLE: usize = IndexingCam::TABLE;

const EIGHT: IndexingCamDimensions = IndexingCamDimensions {
    stops: 8,
    index: 2.0 * PI / 3.0,
    indexes: 1,
    reverses: false,
    law: Law::Cycloidal,
};

fn massless() -> [Link; 2] {
    [0.0; 2].map(|inertia| Link::rotor(inertia).unwrap())
}

/// ψ of the cycloidal law, from its formula: h·(z − sin 2πz/2π).
#[test]
fn table_textbook() {
    let cam = IndexingCam::new(EIGHT, massless()).unwrap();
    let (h, beta) = (TAU / 8.0, EIGHT.index);
    assert_near("h", cam.step(), h, 0.0);
    assert_near("β", cam.index(), beta, 0.0);
    assert_near("period", cam.period(), TAU, 0.0);
    let most = [
        2.0 * h / beta,
        TAU * h / beta.powi(2),
        TAU * TAU * h / beta.powi(3),
    ];
    let most = most.map(|largest| largest.max(1.0));
    for turn in [-7, -1, 0, 1, 5, 30] {
        for k in 0..=40 {
            let z = f64::from(k) / 40.0 * 0.999_999 + 5e-7;
            let psi = cam.frames(TAU * f64::from(turn) + beta * z).unwrap()[TABLE].psi;
            let (sin, cos) = (TAU * z).sin_cos();
            let expected = h * (f64::from(turn) + z - sin / TAU);
            assert_near("ψ", psi.value, expected, budget::GOLDEN * most[0]);
            assert_near(
                "ψ'",
                psi.d1,
                h / beta * (1.0 - cos),
                budget::GOLDEN * most[1],
            );
            let second = h / beta.powi(2) * TAU * sin;
            assert_near("ψ''", psi.d2, second, budget::GOLDEN * most[2]);
        }
        for share in [0.001, 0.3, 0.999] {
            let phi = TAU * f64::from(turn) + beta + share * (TAU - beta);
            let psi = cam.frames(phi).unwrap()[TABLE].psi;
            let rest = h * f64::from(turn + 1);
            assert_near("dwell", psi.value, rest, budget::GOLDEN * most[0]);
            assert!([psi.d1, psi.d2, psi.d3].iter().all(|d| *d == 0.0));
        }
    }
}

/// Figures used by makers: speed C_v·h/β, acceleration C_a·h/β², torque on the cam shaft C_Mdyn·J·h²/β³·ω² at constant speed.
#[test]
fn peaks_are_those_of_the_law() {
    for law in [Law::ModifiedSine, Law::ModifiedTrapezoid, Law::Cycloidal] {
        let (inertia, omega) = (12.5, 4.0);
        let links = [0.3, inertia].map(|inertia| Link::rotor(inertia).unwrap());
        let dimensions = IndexingCamDimensions {
            law,
            reverses: true,
            indexes: 2,
            ..EIGHT
        };
        let machine = Machine::new(IndexingCam::new(dimensions, links).unwrap());
        let (h, beta) = (TAU / 8.0, EIGHT.index);
        let places = || (0..=20_000).map(|k| 0.999_999 * beta * f64::from(k) / 20_000.0);
        let psi = |phi: f64| machine.mechanism().frames(phi).unwrap()[TABLE].psi;
        let found = law.characteristic();
        // On a grid of 20,000 steps, half a step from the peak: its curvature, at most (4π)², times 1.25e-9/2.
        let near = |what: &str, most: f64, expected: f64| {
            assert_near(what, most / expected, 1.0, 1e-6);
        };
        near(
            "speed",
            largest(places().map(|phi| psi(phi).d1)),
            found.velocity * h / beta,
        );
        near(
            "acceleration",
            largest(places().map(|phi| psi(phi).d2)),
            found.acceleration * h / beta.powi(2),
        );
        let torque = |phi: f64| machine.forces(phi, omega, 0.0).unwrap().drive;
        near(
            "torque",
            largest(places().map(torque)),
            found.dynamic_torque * inertia * h * h / beta.powi(3) * omega * omega,
        );
        // Two indexes per turn, against the direction of the cam shaft.
        let step = psi(TAU - 1e-9).value - psi(-1e-9).value;
        assert_near("two steps back", step, -2.0 * h, 1e-8);
    }
}

/// Edges: start and end of an index, and the breaks of its law; in each index of the turn.
#[test]
fn edges_are_where_derivatives_jump() {
    let edges = |dimensions| {
        let cam = IndexingCam::new(dimensions, massless()).unwrap();
        (0..).map_while(|k| cam.edge(k)).collect::<Vec<f64>>()
    };
    let beta = EIGHT.index;
    assert_eq!(edges(EIGHT), [0.0, beta]);
    let law = Law::ModifiedSine;
    let found = edges(IndexingCamDimensions {
        law,
        indexes: 2,
        ..EIGHT
    });
    let one = [0.0, 0.125 * beta, 0.875 * beta, beta];
    let two = one.map(|edge| edge + PI);
    for (found, expected) in found.iter().zip(one.iter().chain(&two)) {
        assert_near("edge", *found, *expected, 1e-15);
    }
    assert_eq!(found.len(), 8);
    // A cam without dwell.
    let found = edges(IndexingCamDimensions {
        index: TAU,
        ..EIGHT
    });
    assert_eq!(found, [0.0]);
}

/// The moment on the table is J₂·ψ̈ − M, and ψ′ times it acts on the cam shaft; in the dwell the cam locks the table.
#[test]
fn the_cam_carries_the_table() {
    let (inertia, load) = (0.8, 3.0);
    let links = [0.001, inertia].map(|inertia| Link::rotor(inertia).unwrap());
    let moment = Load::new(TABLE, Action::Moment(load)).unwrap();
    let machine = Machine::new(IndexingCam::new(EIGHT, links).unwrap());
    let machine = machine.with_load(moment).unwrap();
    let omega = 8.0;
    for phi in [0.1, 0.9, 1.4, 2.0, 2.2, 4.0, 6.2, 7.0] {
        let forces = machine.forces(phi, omega, 0.0).unwrap();
        let psi = machine.mechanism().frames(phi).unwrap()[TABLE].psi;
        let on_table = inertia * psi.d2 * omega * omega - load;
        let size = budget::REACTIONS * (on_table.abs() + load);
        assert_near("on the table", forces.reactions[2].moment, on_table, size);
        assert_near("drive", forces.drive, on_table * psi.d1, size);
    }
}

prop_compose! {
    pub(crate) fn machines()(
        stops in 1..=48_u32,
        index in 0.3..1.0_f64,
        indexes in 1..=3_u32,
        reverses: bool,
        law in prop_oneof![
            Just(Law::ModifiedSine), Just(Law::Polynomial4567), Just(Law::Cycloidal),
            Just(Law::SineConstantCosine { sine: 0.2, constant: 0.3, cosine: 0.4 }),
        ],
        inertia in [1e-3..0.1, 1e-2..1.0],
        mass in [0.1..3.0, 0.1..9.0],
        com in [-0.05..0.1, -0.03..0.03],
        down in 0.0..6.2_f64,
        load in [-30.0..30.0, 0.0..10.0, 0.0..2.0],
    ) -> Machine<IndexingCam> {
        let links = [
            link_of(mass[0], inertia[0], com),
            link_of(mass[1], inertia[1], [0.0, 0.0]),
        ];
        let index = index * TAU / f64::from(indexes);
        let dimensions = IndexingCamDimensions { stops, index, indexes, reverses, law };
        let loads = [Action::Moment(load[0]), Action::OpposingMoment(load[1]), Action::ViscousMoment(load[2])];
        loaded(IndexingCam::new(dimensions, links).unwrap(), down, TABLE, loads)
    }
}

proptest! {
    #![proptest_config(config(200, 49))]

    #[test]
    fn reduction_repeats_with_every_turn(machine in machines(), phi in -3.2..3.2_f64, turns in 1..40_i32) {
        let edges: Vec<f64> = (0..).map_while(|k| machine.edge(k)).collect();
        let near = |edge: f64| (phi - edge).rem_euclid(TAU);
        prop_assume!(edges.iter().all(|edge| near(*edge) > 1e-9 && near(*edge) < TAU - 1e-9));
        let now = machine.reduction(phi).unwrap();
        let later = machine.reduction(phi + TAU * f64::from(turns)).unwrap();
        let scale = largest(now.inertias()).max(1.0);
        for (a, b) in now.inertias().into_iter().zip(later.inertias()) {
            prop_assert!((a - b).abs() <= 100.0 * budget::A_TURN_LATER * scale, "{a} {b}");
        }
    }
}

#[test]
fn wrong_dimensions_are_refused() {
    let new = |dimensions| IndexingCam::new(dimensions, massless()).unwrap_err();
    for stops in [0, 361] {
        let error = new(IndexingCamDimensions { stops, ..EIGHT });
        assert!(
            error.to_string().starts_with("number of stops is"),
            "{error}"
        );
    }
    let error = new(IndexingCamDimensions {
        indexes: 9,
        ..EIGHT
    });
    assert_eq!(error.to_string(), "indexes a turn is 9, outside 1 to 8");
    for (index, indexes) in [(0.0, 1), (-1.0, 1), (6.3, 1), (3.2, 2)] {
        let error = new(IndexingCamDimensions {
            index,
            indexes,
            ..EIGHT
        });
        assert!(error.to_string().starts_with("index angle is"), "{error}");
    }
    let law = Law::Trapezoid {
        accelerate: 0.8,
        decelerate: 0.8,
    };
    assert!(matches!(
        new(IndexingCamDimensions { law, ..EIGHT }),
        BuildError::Range(RangeError::OutOfRange { .. })
    ));
    let off = link_of(2.0, 0.1, [0.03, 0.04]);
    let error = IndexingCam::new(EIGHT, [off, off]).unwrap_err();
    assert_eq!(
        error,
        BuildError::Dimensions(DimensionError::OffAxis {
            link: "table",
            distance: 0.05
        })
    );
    assert!(spoken(error).contains("balance it"));
    let [_, table] = massless();
    let cam = IndexingCam::new(EIGHT, [off, table]).unwrap();
    assert_eq!(
        cam.frames(f64::NAN).unwrap_err(),
        PoseError::Range(RangeError::NotFinite("cam shaft angle"))
    );
    assert!(cam.joints(f64::NAN, &cam.frames(0.0).unwrap()).is_err());
}
