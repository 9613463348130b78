//! A cam as a pair of a linkage: against the disc cam in closed form, and as the first of a chain of links.

mod chain;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use jred::Domain;
use jred::machine::{Frame, Frames, Joint, Link, Machine, Marker, Mechanism, PoseError, Reducible};
use jred::mechanism::cam::contact_force;
use jred::mechanism::linkage::{Assembly, Linkage, LinkageError, Pair, PlacedCam, Pose};
use jred::mechanism::{CamProfile, DiscCam, Follower};
use jred::number::Transfer;
use proptest::prelude::*;

use crate::support::{assert_near, budget, cams, config, forces, jointed, link_of, spoken};

const O: [f64; 2] = [0.0, 0.0];

fn pin(a: Marker, b: Marker) -> Pair {
    Pair::Joint(Joint::Revolute([a, b]))
}

fn profile(cam: &DiscCam) -> CamProfile {
    CamProfile::new(cam.program().clone(), cam.base_radius(), *cam.follower()).unwrap()
}

/// Position of a disc cam: its axis at `at`, all of it turned by `turn`, and the cam's own zero turned by `zero`.
#[derive(Clone, Copy, Debug)]
struct Place {
    at: [f64; 2],
    turn: f64,
    zero: f64,
}

impl Place {
    fn vector(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = self.turn.sin_cos();
        [cos * x - sin * y, sin * x + cos * y]
    }

    fn ground(&self, point: [f64; 2]) -> Marker {
        let [x, y] = self.vector(point);
        Marker::ground([self.at[0] + x, self.at[1] + y]).with_angle(self.turn)
    }

    /// Cam 0 and follower 1, the cam driven.
    fn pairs(&self, follower: &Follower) -> [Pair; 3] {
        let cam = Marker::on(0, O).with_angle(self.zero);
        let on_follower = Marker::on(1, O);
        let guide =
            match *follower {
                Follower::TranslatingRoller { offset, .. }
                | Follower::TranslatingFace { offset } => Pair::Joint(Joint::Prismatic([
                    self.ground([offset, 0.0]).with_angle(self.turn + FRAC_PI_2),
                    on_follower.with_angle(FRAC_PI_2),
                ])),
                Follower::OscillatingRoller { pivot, .. }
                | Follower::OscillatingFace { pivot, .. } => pin(self.ground(pivot), on_follower),
            };
        let contact = Pair::Cam {
            cam,
            follower: on_follower,
            place: 0,
        };
        [pin(self.ground(O), cam), guide, contact]
    }
}

/// Cam and follower of the closed form, without the roller, in this position.
struct Standing<'a>(&'a DiscCam, Place);

impl Mechanism for Standing<'_> {
    fn links(&self) -> &[Link] {
        &self.0.links()[..2]
    }

    fn domain(&self) -> Domain {
        Domain::Turn
    }

    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        let place = self.1;
        let (sin, cos) = place.turn.sin_cos();
        let stands = |(link, frame): (usize, &Frame)| {
            let zero = if link == 0 { place.zero } else { 0.0 };
            let at = [
                frame.x * cos - frame.y * sin + Transfer::constant(place.at[0]),
                frame.x * sin + frame.y * cos + Transfer::constant(place.at[1]),
            ];
            Frame::turned(at, frame.psi + Transfer::constant(place.turn - zero))
        };
        let frames = self.0.frames(phi)?;
        Ok(frames.iter().take(2).enumerate().map(stands).collect())
    }
}

/// A rough drawing: the links are a millimetre and three degrees off.
fn by_eye(frames: &Frames) -> Vec<Pose> {
    let off = |frame: &Frame| Pose {
        x: frame.x.value + 1e-3,
        y: frame.y.value - 1e-3,
        psi: frame.psi.value + 0.05,
    };
    frames.iter().map(off).collect()
}

fn assembled(cam: &DiscCam, place: Place, start: f64) -> Assembly<2, 3, 256, 1> {
    let closed = Standing(cam, place);
    let placed = PlacedCam::new(profile(cam), place.ground(O));
    Linkage::with_cams(closed.links(), &place.pairs(cam.follower()), &[placed], 0)
        .unwrap()
        .assemble(Domain::Turn, start, &by_eye(&closed.frames(start).unwrap()))
        .unwrap()
}

prop_compose! {
    fn place()(x in -0.3..0.3, y in -0.3..0.3, turn in -PI..PI, zero in -PI..PI) -> Place {
        Place { at: [x, y], turn, zero }
    }
}

proptest! {
    #![proptest_config(config(60, 0x0ca3))]

    #[test]
    fn a_disc_cam_as_a_linkage(
        cam in cams::cam(),
        place in place(),
        start in 0.0..TAU,
        phi in -10.0..10.0,
        alpha in -200.0..200.0,
    ) {
        let linkage = assembled(&cam, place, start);
        jointed::same_frames(&Standing(&cam, place), &linkage, phi, budget::LINKAGE);
        // Along the normal of the contact, otherwise its force would do work.
        jointed::joints_close(&linkage, phi);
        let gravity = place.vector([0.0, -9.81]);
        let machine = Machine::new(linkage).with_gravity(gravity).unwrap();
        forces::dalembert(&machine, phi, 30.0, alpha);
        jointed::energy(&machine, phi, 30.0);
        if cam.follower().roller().is_none() {
            // The same bodies, so the same force.
            let level = Machine::new(cam.clone()).with_gravity([0.0, -9.81]).unwrap();
            let expected = contact_force(&level, DiscCam::CONTACT, phi, 30.0, alpha).unwrap();
            let found = contact_force(&machine, 2, phi, 30.0, alpha).unwrap();
            let size = 1.0 + expected.abs();
            assert_near("contact force", found, expected, budget::DALEMBERT * size * 10.0);
        }
    }
}

/// The cam's shaft is held in a slide that moves on the ground: the cam's base is not the ground.
#[test]
fn the_base_may_move() {
    let (follower, lift) = cams::follower(0, 0.01, O, 0.004);
    let cam = cams::build(lift, 0.04, follower).unwrap();
    let link = link_of(1.0, 0.001, O);
    let along = FRAC_PI_2;
    // Cam 0 and follower 1 in slide 2, which a gear moves along x while the cam turns: x = r·θ.
    let base = Marker::on(2, O);
    let r = 0.02;
    let pairs = [
        pin(base, Marker::on(0, O)),
        Pair::Joint(Joint::Prismatic([
            Marker::on(2, [0.004, 0.0]).with_angle(along),
            Marker::on(1, O).with_angle(along),
        ])),
        Pair::Cam {
            cam: Marker::on(0, O),
            follower: Marker::on(1, O),
            place: 0,
        },
        Pair::Joint(Joint::Prismatic([Marker::ground(O), base])),
        Pair::Rack {
            pinion: Marker::on(0, O),
            rack: Marker::ground([0.0, -r]),
            radius: r,
            phase: 0.0,
        },
    ];
    let drawing = [0.0, 0.05, 0.0].map(|y| Pose {
        x: 0.0,
        y,
        psi: 0.0,
    });
    let placed = PlacedCam::new(profile(&cam), base);
    let assembly: Assembly<3, 5, 65, 1> = Linkage::with_cams(&[link; 3], &pairs, &[placed], 0)
        .unwrap()
        .assemble(Domain::stroke(0.0, 6.0).unwrap(), 0.0, &drawing)
        .unwrap();
    for phi in [0.3, 1.5, 2.6, 4.4] {
        let rolled = assembly.frames(phi).unwrap()[2].x;
        assert_near("rolled", rolled.value, -r * phi, budget::JOINT_CLOSURE);
        let expected = cam.frames(phi).unwrap()[1].y;
        let found = assembly.frames(phi).unwrap()[1].y;
        assert_near("height", found.value, expected.value, budget::LINKAGE);
        assert_near("height‴", found.d3, expected.d3, budget::LINKAGE);
        jointed::joints_close(&assembly, phi);
        let machine = Machine::new(assembly.clone())
            .with_gravity([0.0, -9.81])
            .unwrap();
        forces::dalembert(&machine, phi, 30.0, -40.0);
    }
}

#[test]
fn refused() {
    let (follower, lift) = cams::follower(1, 0.01, O, 0.0);
    let cam = cams::build(lift, 0.04, follower).unwrap();
    let place = Place {
        at: O,
        turn: 0.0,
        zero: 0.0,
    };
    let pairs = place.pairs(&follower);
    let links = cams::links();
    let at = |base| PlacedCam::new(profile(&cam), base);
    let message = |cams: &[PlacedCam]| {
        spoken(Linkage::<2, 3, 1>::with_cams(&links, &pairs, cams, 0).unwrap_err())
    };
    assert_eq!(
        message(&[]),
        "there is no cam 0: the linkage has 0 cams, counted from 0; take the index of a cam that the linkage was given"
    );
    for body in [0, 1] {
        assert_eq!(
            message(&[at(Marker::on(body, O))]),
            "the base of cam 0 is on the cam or its follower; put it on the body that carries both"
        );
    }
    let fixed = at(Marker::ground(O));
    assert_eq!(
        message(&[fixed.clone(), fixed.clone()]),
        "too many cams: at most 1 fit"
    );
    assert_eq!(
        message(&[at(Marker::on(2, O))]),
        "there is no link 2: the mechanism has links 0 to 1; take an index from the mechanism's list of links"
    );
    assert!(message(&[at(Marker::ground([f64::NAN, 0.0]))]).contains("marker u"));
    let refused = Linkage::<2, 3>::new(&links, &pairs, 0).unwrap_err();
    assert_eq!(refused, LinkageError::NoSuchCam { cam: 0, cams: 0 });
    // The shape of the cam is checked like that of the disc cam.
    let small = CamProfile::new(cams::four(0.03), 0.004, follower).unwrap_err();
    assert!(spoken(small).contains("base radius"), "{small}");
    // The whole is a machine like any other.
    let machine = Machine::new(assembled(&cam, place, 0.0));
    assert!(machine.reduction(1.0).unwrap().inertia > 0.0);
}
