//! A cam as the first element of a chain of links, and its follower as the drive.

use std::f64::consts::TAU;

use jred::Domain;
use jred::machine::{Body, Joint, Machine, Marker, Mechanism, PoseError};
use jred::mechanism::linkage::{Assembly, Linkage, LinkageError, Pair, PlacedCam, Pose};
use jred::mechanism::{DiscCam, Follower, Roller, RollerDimensions, Swing};
use jred::number::Transfer;

use super::{O, Place, pin, profile};
use crate::support::{assert_near, budget, cams, forces, jointed, link_of};

/// Lengths of the chain cam → bell crank → rod → slider (m), and the angle between the arms (rad).
const ARM: f64 = 0.08;
const SECOND: f64 = 0.12;
const BETWEEN: f64 = 0.9;
const ROD: f64 = 0.25;

fn lever() -> DiscCam {
    let follower = Follower::OscillatingRoller {
        pivot: [0.09, 0.02],
        arm: ARM,
        swing: Swing::Clockwise,
        roller: Roller::new(RollerDimensions {
            radius: 0.012,
            mass: 0.0,
            inertia: 0.0,
        })
        .unwrap(),
    };
    cams::build(0.3, 0.035, follower).unwrap()
}

/// The chain with a pair of gears: pinion 0 drives the cam 1, which moves the bell crank 2, rod 3 and slider 4. The slider runs along +x through the
/// crank's pivot.
fn chain(domain: Domain) -> Assembly<5, 8, 256, 1> {
    let cam = lever();
    let (pivot, _) = cam.follower().pivot().unwrap();
    let link = |mass, com| link_of(mass, 0.003, com);
    let links = [
        link(0.4, O),
        link(2.0, [0.003, 0.001]),
        link(0.9, [0.04, 0.05]),
        link(0.5, [0.12, 0.0]),
        link(3.0, O),
    ];
    let second = [SECOND * BETWEEN.cos(), SECOND * BETWEEN.sin()];
    let pairs = [
        pin(Marker::ground([-0.15, 0.0]), Marker::on(0, O)),
        pin(Marker::ground(O), Marker::on(1, O)),
        pin(Marker::ground(pivot), Marker::on(2, O)),
        pin(Marker::on(2, second), Marker::on(3, O)),
        pin(Marker::on(3, [ROD, 0.0]), Marker::on(4, O)),
        Pair::Joint(Joint::Prismatic([Marker::ground(pivot), Marker::on(4, O)])),
        Pair::Cam {
            cam: Marker::on(1, O),
            follower: Marker::on(2, O),
            place: 0,
        },
        Pair::Gears {
            centres: [Marker::on(0, O), Marker::on(1, O)],
            carrier: Body::Ground,
            radii: [0.05, 0.1],
            phase: 0.0,
        },
    ];
    let psi = cam.frames(0.0).unwrap()[1].psi.value + 0.05;
    let [x, y] = [
        SECOND * (psi + BETWEEN).cos(),
        SECOND * (psi + BETWEEN).sin(),
    ];
    let pose = |x, y, psi| Pose { x, y, psi };
    let drawing = [
        pose(-0.15, 0.0, 0.0),
        pose(0.0, 0.0, 0.0),
        pose(pivot[0], pivot[1], psi),
        pose(pivot[0] + x, pivot[1] + y, (-y / ROD).asin()),
        pose(pivot[0] + x + ROD, pivot[1], 0.0),
    ];
    let placed = PlacedCam::new(profile(&cam), Marker::ground(O));
    Linkage::with_cams(&links, &pairs, &[placed], 0)
        .unwrap()
        .assemble(domain, 0.0, &drawing)
        .unwrap()
}

#[test]
fn cam_lever_rod_and_slider() {
    let cam = lever();
    let (pivot, _) = cam.follower().pivot().unwrap();
    // Two turns of the pinion are one of the cam, which turns the other way.
    let assembly = chain(Domain::stroke(-1.0, 2.0 * TAU).unwrap());
    for k in 0..60 {
        let phi = 0.21 * f64::from(k);
        let theta = Transfer::variable(phi) * -0.5;
        let angle = cam.frames(theta.value).unwrap()[1].psi.after(theta);
        let (sin, cos) = (angle + Transfer::constant(BETWEEN)).sin_cos();
        let height = sin * SECOND;
        let reach = (Transfer::constant(ROD * ROD) - height * height).sqrt();
        let expected = Transfer::constant(pivot[0]) + cos * SECOND + reach;

        let frames = assembly.frames(phi).unwrap();
        assert_near("cam", frames[1].psi.value, theta.value, budget::LINKAGE);
        for (name, found, expected) in [
            ("lever", frames[2].psi, angle),
            ("slider", frames[4].x, expected),
        ] {
            let size = 1.0 + expected.d1.abs() + expected.d2.abs() + expected.d3.abs();
            let near = |order: &str, found: f64, expected: f64| {
                let what = format!("{name}{order} at {phi}");
                assert_near(&what, found, expected, budget::LINKAGE * size);
            };
            near("", found.value, expected.value);
            near("′", found.d1, expected.d1);
            near("″", found.d2, expected.d2);
            near("‴", found.d3, expected.d3);
        }
        jointed::joints_close(&assembly, phi);
        let machine = Machine::new(assembly.clone())
            .with_gravity([0.0, -9.81])
            .unwrap();
        forces::dalembert(&machine, phi, 40.0, 300.0);
    }
    // Every link follows from the one before; rod and slider form the only group, with at most two angles.
    assert!(assembly.linkage().group_sizes().all(|size| size <= 2));
}

/// The follower, pushed by a cylinder, turns the cam while the program rises.
#[test]
fn the_follower_may_be_the_drive() {
    let roller = Roller::new(RollerDimensions {
        radius: 0.01,
        mass: 0.0,
        inertia: 0.0,
    })
    .unwrap();
    let follower = Follower::TranslatingRoller {
        offset: 0.003,
        roller,
    };
    let cam = cams::build(0.012, 0.04, follower).unwrap();
    let place = Place {
        at: O,
        turn: 0.0,
        zero: 0.0,
    };
    let linkage = Linkage::<2, 3, 1>::with_cams(
        &cams::links(),
        &place.pairs(&follower),
        &[PlacedCam::new(profile(&cam), Marker::ground(O))],
        1,
    )
    .unwrap();
    let rest = cam.frames(0.0).unwrap()[1].y.value;
    // In the middle of the rise, 60° to 180°.
    let drawing = [
        Pose {
            psi: 2.0,
            ..Pose::default()
        },
        Pose {
            y: rest,
            ..Pose::default()
        },
    ];
    let domain = Domain::stroke(rest + 0.001, rest + 0.011).unwrap();
    let assembly: Assembly<2, 3, 65, 1> = linkage
        .clone()
        .assemble(domain, rest + 0.006, &drawing)
        .unwrap();
    for share in [0.0, 0.3, 0.77, 1.0] {
        let phi = domain.position(share);
        let theta = assembly.frames(phi).unwrap()[0].psi;
        let s = cam.program().displacement(theta.value).after(theta);
        let name = |order| format!("s{order} at the share {share}");
        assert_near(&name(""), rest + s.value, phi, budget::LINKAGE);
        assert_near(&name("′"), s.d1, 1.0, budget::LINKAGE);
        let size = (theta.d1 * theta.d1 * theta.d1).abs();
        assert_near(&name("″"), s.d2, 0.0, budget::LINKAGE * size);
        assert_near(&name("‴"), s.d3, 0.0, budget::LINKAGE * size);
        let machine = Machine::new(assembly.clone())
            .with_gravity([0.0, -9.81])
            .unwrap();
        forces::dalembert(&machine, phi, 0.2, 1.0);
    }
    // Where the program dwells the cam does not move.
    let beyond = Domain::stroke(rest + 0.001, rest + 0.013).unwrap();
    let refused = linkage.assemble::<65>(beyond, rest + 0.006, &drawing);
    let Err(LinkageError::Pose(
        PoseError::DeadPoint { phi, .. } | PoseError::BranchChange { phi, .. },
    )) = refused
    else {
        panic!("{refused:?}")
    };
    assert_near("end of the rise", phi, rest + 0.012, 1e-6);
}
