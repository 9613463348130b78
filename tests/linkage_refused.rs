//! Invalid linkages are refused with their position, and never taken for closed ones.

use crate::support::budget;
use crate::support::link_of;
use jred::Domain;
use jred::machine::{Body, Joint, Link, Marker, Mechanism, PoseError};
use jred::mechanism::linkage::{Assembly, Linkage, LinkageError, Pair, Pose};

const O: [f64; 2] = [0.0, 0.0];

fn pin(a: Marker, b: Marker) -> Pair {
    Pair::Joint(Joint::Revolute([a, b]))
}

fn four_bar(lengths: [f64; 4], domain: Domain) -> Result<Assembly<3, 4, 64>, LinkageError> {
    let [a, b, c, d] = lengths;
    let link = link_of(1.0, 0.01, O);
    let pairs = [
        pin(Marker::ground(O), Marker::on(0, O)),
        pin(Marker::on(0, [a, 0.0]), Marker::on(1, O)),
        pin(Marker::on(1, [b, 0.0]), Marker::on(2, [c, 0.0])),
        pin(Marker::ground([d, 0.0]), Marker::on(2, O)),
    ];
    let drawing =
        [[0.0, 0.0, 1.5], [0.0, a, 0.5], [d, 0.0, 1.5]].map(|[x, y, psi]| Pose { x, y, psi });
    Linkage::new(&[link; 3], &pairs, 0)?.assemble(domain, 1.5, &drawing)
}

#[test]
fn what_cannot_be_a_mechanism_is_refused_with_its_place() {
    // Not Grashof: the crank stops where coupler and rocker are stretched, |AC| = b + c.
    let [a, b, c, d] = [0.25, 0.2, 0.18, 0.3_f64];
    let refused = four_bar([a, b, c, d], Domain::Turn).unwrap_err();
    let LinkageError::Pose(
        PoseError::DeadPoint { phi, joint } | PoseError::BranchChange { phi, joint },
    ) = refused
    else {
        panic!("{refused}")
    };
    let limit = ((a * a + d * d - (b + c) * (b + c)) / (2.0 * a * d)).acos();
    let off = (phi.cos() - limit.cos()).abs();
    assert!(off < 1e-6, "stops at {phi}, stretched at {limit}");
    assert!((1..=3).contains(&joint), "joint {joint}");
    assert!(four_bar([a, b, c, d], Domain::stroke(0.6, limit - 1e-3).unwrap()).is_ok());

    // Too short to meet at all.
    let refused = four_bar([0.05, 0.05, 0.05, 0.3], Domain::Turn).unwrap_err();
    let LinkageError::Pose(PoseError::CannotAssemble { phi, gap, .. }) = refused else {
        panic!("{refused}")
    };
    crate::support::assert_near("φ", phi, 1.5, 0.0);
    assert!(gap > 0.1 && gap < 0.3, "{gap}");
    let text = refused.to_string();
    assert!(text.contains("cannot be assembled at φ = 85.94°"), "{text}");

    // Degrees of freedom.
    let link = link_of(1.0, 0.01, O);
    let ground = |x| Marker::ground([x, 0.0]);
    let free = [
        pin(ground(0.0), Marker::on(0, O)),
        pin(Marker::on(0, [0.1, 0.0]), Marker::on(1, O)),
    ];
    let refused = Linkage::<2, 4>::new(&[link; 2], &free, 0).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "the mechanism has 2 degrees of freedom, not one: 3·2 links − 4 constraints"
    );
    // Link 0 is held rigidly by its pin and its slot, while link 1 has two freedoms.
    let held = [
        pin(ground(0.0), Marker::on(0, O)),
        Pair::Joint(Joint::PinInSlot([Marker::on(0, [0.1, 0.0]), ground(0.3)])),
        pin(Marker::on(0, [0.05, 0.0]), Marker::on(1, O)),
    ];
    let refused = Linkage::<2, 4>::new(&[link; 2], &held, 0).unwrap_err();
    let LinkageError::OverConstrained { free: 1, .. } = refused else {
        panic!("{refused}")
    };
    let refuse = |pairs: &[Pair], drive, words: &str| {
        let refused = Linkage::<2, 4>::new(&[link; 2], pairs, drive).unwrap_err();
        assert!(refused.to_string().contains(words), "{refused}");
    };
    refuse(
        &[pin(ground(0.0), Marker::on(2, O))],
        0,
        "there is no link 2",
    );
    refuse(
        &free,
        7,
        "joint 7 cannot be used: the mechanism has 2 joints",
    );
    refuse(&held, 1, "joint 1 cannot be driven");
    refuse(&[free[0]; 5], 0, "too many joints: at most 4 fit");
    refuse(
        &[pin(ground(f64::NAN), Marker::on(0, O))],
        0,
        "marker u is not a finite number",
    );
    let transmission = Joint::contact([Body::Ground, Body::Link(0)], O, [1.0, 0.0]);
    refuse(
        &[Pair::Joint(transmission)],
        0,
        "a transmission is not a pair",
    );
    let flat = Pair::Belt {
        centres: [Marker::on(0, O); 2],
        radii: [0.0, 1.0],
        phase: 0.0,
    };
    refuse(
        &[flat],
        0,
        "radius of a wheel is 0, but must be greater than zero",
    );
}

/// A wheel that turns once in two turns of the pinion moves a slotted lever: nothing repeats after one turn of the drive, for any start of the
/// drawing and any centres of mass; over two turns it is a machine.
#[test]
fn what_repeats_after_two_turns_does_not_close_after_one() {
    let (r, pivot) = (0.02, [0.12, -0.1]);
    let centre = [0.06, 0.0];
    let wheel = Link::rotor(0.001).unwrap();
    let lever = link_of(1.0, 0.01, O);
    let pairs = [
        pin(Marker::ground(O), Marker::on(0, O)),
        pin(Marker::ground(centre), Marker::on(1, O)),
        pin(Marker::ground(pivot), Marker::on(2, O)),
        Pair::Gears {
            centres: [Marker::on(0, O), Marker::on(1, O)],
            carrier: Body::Ground,
            radii: [r, 2.0 * r],
            phase: 0.0,
        },
        Pair::Joint(Joint::PinInSlot([
            Marker::on(1, [0.03, 0.0]),
            Marker::on(2, O),
        ])),
    ];
    for start in [0.0, 0.5, 1.6, 3.1] {
        let angle = start + 0.1_f64;
        let pin_at = [
            centre[0] + 0.03 * angle.cos(),
            centre[1] + 0.03 * angle.sin(),
        ];
        let lever_angle = (pin_at[1] - pivot[1]).atan2(pin_at[0] - pivot[0]);
        let drawing = [(O, 0.0), (centre, angle), (pivot, lever_angle)].map(|([x, y], psi)| Pose {
            x,
            y,
            psi,
        });
        let meshing = pairs.map(|pair| {
            let frames = drawing.map(|pose| pose.frame());
            pair.meshing_at(&frames)
        });
        let linkage = Linkage::<3, 5>::new(&[wheel, wheel, lever], &meshing, 0).unwrap();
        let refused = linkage
            .clone()
            .assemble::<256>(Domain::Turn, 0.0, &drawing)
            .unwrap_err();
        assert!(
            matches!(refused, LinkageError::NotClosed { .. }),
            "{start}: {refused}"
        );
        let two = Domain::stroke(0.0, 4.0 * std::f64::consts::PI).unwrap();
        let whole: Assembly<3, 5, 256> = linkage.assemble(two, 0.0, &drawing).unwrap();
        let [a, b] = [0.0, 4.0 * std::f64::consts::PI].map(|phi| whole.frames(phi).unwrap()[2].psi);
        crate::support::assert_near("after two turns", b.value, a.value, budget::LINKAGE);
    }
}

/// A parallelogram passes the line of its pins, where it can continue as a parallelogram or as an antiparallelogram: there are positions on both
/// sides, and the error reports a change of branch, not a blocked crank.
#[test]
fn a_parallelogram_changes_its_branch_where_it_is_flat() {
    let sides = [0.1, 0.3, 0.1, 0.3];
    let refused = four_bar(sides, Domain::Turn).unwrap_err();
    let LinkageError::Pose(PoseError::BranchChange { phi, joint }) = refused else {
        panic!("{refused}")
    };
    assert!(phi.sin().abs() < 1e-6, "flat at {phi}");
    assert!((1..=3).contains(&joint), "joint {joint}");
    let short = Domain::stroke(0.01, std::f64::consts::PI - 0.01).unwrap();
    let open = four_bar(sides, short).unwrap();
    let frames = open.frames(0.02).unwrap();
    crate::support::assert_near("coupler", frames[1].psi.value, 0.0, budget::LINKAGE);
}

/// A gear at 3:7 is at another angle after a turn of its pinion. A balanced gear is the same at any angle, and the machine repeats; with an eccentric
/// centre of mass it does not.
#[test]
fn a_wheel_that_only_rolls_may_stop_at_any_angle_if_it_is_balanced() {
    let centre = [0.1, 0.0];
    let radii = [0.03, 0.07];
    let pairs = [
        pin(Marker::ground(O), Marker::on(0, O)),
        pin(Marker::ground(centre), Marker::on(1, O)),
        Pair::Gears {
            centres: [Marker::on(0, O), Marker::on(1, O)],
            carrier: Body::Ground,
            radii,
            phase: 0.0,
        },
    ];
    let drawing = [O, centre].map(|[x, y]| Pose { x, y, psi: 0.0 });
    let with = |wheel: Link| {
        let pinion = Link::rotor(0.001).unwrap();
        let linkage = Linkage::<2, 3>::new(&[pinion, wheel], &pairs, 0).unwrap();
        linkage.assemble::<16>(Domain::Turn, 0.0, &drawing)
    };
    let whole: Assembly<2, 3, 16> = with(link_of(1.0, 0.01, O)).unwrap();
    for phi in [-4.0, 0.3, 9.0] {
        let found = whole.frames(phi).unwrap()[1].psi.value;
        let rolled = -phi * radii[0] / radii[1];
        crate::support::assert_near("wheel", found, rolled, budget::LINKAGE * phi.abs());
    }
    let refused = with(link_of(1.0, 0.01, [0.01, 0.0])).unwrap_err();
    assert!(
        matches!(refused, LinkageError::NotClosed { link: 1, .. }),
        "{refused}"
    );
}
