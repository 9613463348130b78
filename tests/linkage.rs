//! The general linkage: golden data, library mechanisms by their joints, and refusals.

use crate::support::golden::Case;
use crate::support::machines::spec;
use crate::support::{assert_near, budget, config, forces, jointed, link_of};
use jred::Domain;
use jred::machine::{
    Action, Body, Joint, Link, Load, Machine, Marker, Mechanism, PoseError, Reducible,
};
use jred::mechanism::linkage::{Assembly, Linkage, LinkageError, Pair, Pose};
use proptest::prelude::*;

const O: [f64; 2] = [0.0, 0.0];

fn pin(a: Marker, b: Marker) -> Pair {
    Pair::Joint(Joint::Revolute([a, b]))
}

/// The golden four-bar by its links and pins, from a drawing rounded to centimetres and five degrees.
fn golden_four_bar(case: &Case) -> Machine<Assembly<3, 4, 256>> {
    let input = |path: &str| case.input(path);
    let com = |name: &str| [0, 1].map(|k| input(&format!("/{name}_com/{k}")));
    let link = |m, i, name| link_of(input(m), input(i), com(name));
    let links = [
        link("/m1", "/I1", "crank"),
        link("/m2", "/I2", "coupler"),
        link("/m3", "/I3", "rocker"),
    ];
    let pairs = [
        pin(Marker::ground(O), Marker::on(0, O)),
        pin(Marker::on(0, [input("/a"), 0.0]), Marker::on(1, O)),
        pin(
            Marker::on(1, [input("/b"), 0.0]),
            Marker::on(2, [input("/c"), 0.0]),
        ),
        pin(
            Marker::ground([input("/C/0"), input("/C/1")]),
            Marker::on(2, O),
        ),
    ];
    let drawing =
        [[0.0, 0.0, 0.0], [0.08, 0.0, 0.8], [0.3, 0.0, 1.75]].map(|[x, y, psi]| Pose { x, y, psi });
    let linkage = Linkage::new(&links, &pairs, 0).unwrap();
    let assembly = linkage.assemble(Domain::Turn, 0.0, &drawing).unwrap();
    let load = Load::new(2, Action::Moment(input("/M_rocker"))).unwrap();
    Machine::new(assembly)
        .with_gravity([input("/gravity/0"), input("/gravity/1")])
        .and_then(|m| m.with_load(load))
        .unwrap()
}

#[test]
fn four_bar_golden_as_a_linkage() {
    let case = Case::new(include_str!("data/02_four_bar_A.json"));
    let machine = golden_four_bar(&case);
    let table = case.table("position");
    let at = |f: &dyn Fn(f64) -> f64| table.column("phi").into_iter().map(f).collect::<Vec<_>>();
    let psi = |phi, link: usize| machine.mechanism().frames(phi).unwrap()[link].psi;
    let reduced = |phi| machine.reduction(phi).unwrap();
    for (link, name) in [(1, "t2"), (2, "t3")] {
        table.compare(name, &at(&|phi| psi(phi, link).value), budget::GOLDEN);
        table.compare(
            &format!("d{name}"),
            &at(&|phi| psi(phi, link).d1),
            budget::LINKAGE,
        );
        table.compare(
            &format!("d2{name}"),
            &at(&|phi| psi(phi, link).d2),
            budget::LINKAGE,
        );
    }
    for (order, name) in ["J", "dJ", "d2J"].iter().enumerate() {
        table.compare(
            name,
            &at(&|phi| reduced(phi).inertias()[order]),
            budget::LINKAGE,
        );
    }
    table.compare("Q", &at(&|phi| reduced(phi).load_torque()), budget::LINKAGE);

    let table = case.table("motion");
    forces::golden(&machine, &table, &["F_0_1", "F_1_2", "F_2_3", "F_0_3"]);
}

proptest! {
    #![proptest_config(config(60, 0x114b))]

    #[test]
    fn a_slider_crank_as_a_linkage(spec in spec(), phi in -20.0..20.0, start in 0.0..6.2) {
        let machine = spec.machine();
        let linkage = jointed::as_linkage(machine.mechanism(), start).unwrap();
        jointed::same_frames(machine.mechanism(), &linkage, phi, budget::LINKAGE);
        jointed::joints_close(&linkage, phi);
    }
}

#[test]
fn few_stations_do_for_every_position() {
    let case = Case::new(include_str!("data/02_four_bar_A.json"));
    let exact = golden_four_bar(&case);
    let coarse: Assembly<3, 4, 3> = exact
        .mechanism()
        .linkage()
        .clone()
        .assemble(
            Domain::Turn,
            0.0,
            &[[0.0, 0.0, 0.0], [0.08, 0.0, 0.8], [0.3, 0.0, 1.75]].map(|[x, y, psi]| Pose {
                x,
                y,
                psi,
            }),
        )
        .unwrap();
    for k in 0..100 {
        jointed::same_frames(
            exact.mechanism(),
            &coarse,
            0.2 * f64::from(k) - 7.0,
            budget::LINKAGE,
        );
    }
    let sizes: Vec<usize> = coarse.linkage().group_sizes().collect();
    assert_eq!(sizes.iter().sum::<usize>(), 9);
    assert_eq!(sizes.iter().max(), Some(&2), "the two-link group of Assur");
}

/// A gear train, a rack and a belt in one linkage: pinion 0 drives gear 1; gear 1 rolls on rack 2; a belt from gear 1 turns
/// pulley 3.
#[test]
fn gears_a_rack_and_a_belt_roll_without_slip() {
    let wheel = link_of(1.0, 0.01, O);
    let (r0, r1, r3) = (0.03, 0.09, 0.06);
    let centre = [0.12 * 0.6, 0.12 * 0.8];
    let rack_line = [0.3, centre[1] - r1];
    let pairs = [
        pin(Marker::ground(O), Marker::on(0, O)),
        pin(Marker::ground(centre), Marker::on(1, O)),
        Pair::Joint(Joint::Prismatic([
            Marker::ground(rack_line),
            Marker::on(2, O),
        ])),
        pin(Marker::ground([0.5, 0.5]), Marker::on(3, O)),
        Pair::Gears {
            centres: [Marker::on(0, O), Marker::on(1, O)],
            carrier: Body::Ground,
            radii: [r0, r1],
            phase: 0.0,
        },
        Pair::Rack {
            pinion: Marker::on(1, O),
            rack: Marker::on(2, O),
            radius: r1,
            phase: centre[0] - rack_line[0],
        },
        Pair::Belt {
            centres: [Marker::on(1, O), Marker::on(3, O)],
            radii: [r1, r3],
            phase: 0.0,
        },
    ];
    let drawing = [[0.0, 0.0], centre, rack_line, [0.5, 0.5]].map(|[x, y]| Pose { x, y, psi: 0.0 });
    let links = [wheel, wheel, Link::point_mass(2.0).unwrap(), wheel];
    let linkage = Linkage::<4, 7>::new(&links, &pairs, 0).unwrap();
    let stroke = Domain::stroke(-1.0, 2.0).unwrap();
    let assembly: Assembly<4, 7, 9> = linkage.clone().assemble(stroke, 0.0, &drawing).unwrap();
    let i = -r0 / r1;
    for phi in [-1.0, 0.4, 2.0] {
        let frames = assembly.frames(phi).unwrap();
        let close = |what: &str, found: f64, expected: f64| {
            assert_near(what, found, expected, budget::JOINT_CLOSURE);
        };
        close("gear", frames[1].psi.value, i * phi);
        // The pinion turns clockwise, its lowest point moves to the left, and the rack with it.
        close("rack", frames[2].x.value - rack_line[0], r1 * i * phi);
        close("pulley", frames[3].psi.value, i * phi * r1 / r3);
        close("second transfer function", frames[2].x.d2, 0.0);
        jointed::joints_close(&assembly, phi);
        let machine = Machine::new(assembly.clone())
            .with_gravity([0.0, -9.81])
            .unwrap();
        forces::dalembert(&machine, phi, 3.0, -20.0);
        let expected = 0.01 + (0.01 + 2.0 * r1 * r1 + 0.01 * (r1 / r3).powi(2)) * i * i;
        close("J", machine.reduction(phi).unwrap().inertia, expected);
        // The teeth drive gear 1 with the torque for its rack, its pulley and itself.
        let forces = machine.forces(phi, 0.0, 100.0).unwrap();
        let tooth = forces.reactions[4].force;
        let size = (tooth[0].powi(2) + tooth[1].powi(2)).sqrt();
        assert_near("tooth force", size, (expected - 0.01) * 100.0 / r0, 1e-9);
        close(
            "along the tangent",
            tooth[0] * centre[0] + tooth[1] * centre[1],
            0.0,
        );
    }
    // A rack does not return, nor does the gear that moves it.
    let refused = linkage
        .assemble::<9>(Domain::Turn, 0.0, &drawing)
        .unwrap_err();
    assert!(
        matches!(refused, LinkageError::NotClosed { link: 1, .. }),
        "{refused}"
    );
}

/// A planetary gear with one planet, ring fixed: Willis.
#[test]
fn a_planetary_gear_obeys_willis() {
    let (sun, planet) = (0.03, 0.02);
    let ring = sun + 2.0 * planet;
    let carrier = sun + planet;
    let link = |m| link_of(m, 0.001, O);
    let pairs = [
        pin(Marker::ground(O), Marker::on(0, O)),
        pin(Marker::ground(O), Marker::on(1, O)),
        pin(Marker::on(1, [carrier, 0.0]), Marker::on(2, O)),
        Pair::Gears {
            centres: [Marker::on(0, O), Marker::on(2, O)],
            carrier: Body::Link(1),
            radii: [sun, planet],
            phase: 0.0,
        },
        Pair::Gears {
            centres: [Marker::ground(O), Marker::on(2, O)],
            carrier: Body::Link(1),
            radii: [-ring, planet],
            phase: 0.0,
        },
    ];
    let drawing = [[0.0, 0.0], [0.0, 0.0], [carrier, 0.0]].map(|[x, y]| Pose { x, y, psi: 0.0 });
    let stroke = Domain::stroke(0.0, 3.0).unwrap();
    let assembly: Assembly<3, 5, 9> = Linkage::new(&[link(0.1), link(0.2), link(0.3)], &pairs, 0)
        .unwrap()
        .assemble(stroke, 0.0, &drawing)
        .unwrap();
    let speed = sun / (sun + ring);
    let spin = -speed * (ring - planet) / planet;
    for phi in [0.0, 1.3, 3.0] {
        let frames = assembly.frames(phi).unwrap();
        assert_near(
            "carrier",
            frames[1].psi.value,
            speed * phi,
            budget::JOINT_CLOSURE,
        );
        assert_near(
            "planet",
            frames[2].psi.value,
            spin * phi,
            budget::JOINT_CLOSURE,
        );
        jointed::joints_close(&assembly, phi);
        forces::dalembert(&Machine::new(assembly.clone()), phi, 3.0, 50.0);
    }
}

/// A linkage driven at its guide: a slider-crank pushed at the slider, away from its dead centres.
#[test]
fn a_guide_can_be_driven() {
    let spec = crate::support::samples(1, 5, &spec()).remove(0);
    let machine = spec.machine();
    let crank_driven = machine.mechanism();
    let frames = crank_driven.frames(1.0).unwrap();
    let joints = jred::machine::Jointed::joints(crank_driven, 1.0, &frames).unwrap();
    let pairs: Vec<Pair> = joints.iter().copied().map(Pair::Joint).collect();
    let at = |phi: f64| crank_driven.frames(phi).unwrap()[2].x.value;
    let (from, to) = (at(2.2).min(at(0.9)), at(2.2).max(at(0.9)));
    let drawing: Vec<Pose> = frames
        .iter()
        .map(|f| Pose {
            x: f.x.value,
            y: f.y.value,
            psi: f.psi.value,
        })
        .collect();
    let linkage = Linkage::<3, 4>::new(crank_driven.links(), &pairs, 3).unwrap();
    let domain = Domain::stroke(from, to).unwrap();
    let pushed: Assembly<3, 4, 64> = linkage.clone().assemble(domain, at(1.0), &drawing).unwrap();
    for phi in [0.95, 1.4, 2.1] {
        let forward = crank_driven.frames(phi).unwrap();
        let back = pushed.frames(at(phi)).unwrap();
        assert_near("crank angle", back[0].psi.value, phi, budget::LINKAGE);
        // dφ/dx = 1/x′, d²φ/dx² = −x″/x′³.
        let x = forward[2].x;
        assert_near("dφ/dx", back[0].psi.d1 * x.d1, 1.0, budget::LINKAGE);
        let second = -x.d2 / x.d1.powi(3);
        assert_near(
            "d²φ/dx²",
            back[0].psi.d2,
            second,
            budget::LINKAGE * (1.0 + second.abs()),
        );
        let reduced = Machine::new(pushed.clone())
            .reduction(at(phi))
            .unwrap()
            .inertia;
        let heavy = Machine::new(crank_driven.clone())
            .reduction(phi)
            .unwrap()
            .inertia;
        assert_near(
            "m_red = J/x′²",
            reduced * x.d1 * x.d1,
            heavy,
            budget::LINKAGE * heavy,
        );
        forces::dalembert(&Machine::new(pushed.clone()), at(phi), 0.7, -3.0);
    }
    // Beyond the crank's dead centre nothing can be pushed.
    let too_far = Domain::stroke(from, at(0.0) + 0.5).unwrap();
    let refused = linkage
        .assemble::<64>(too_far, at(1.0), &drawing)
        .unwrap_err();
    let LinkageError::Pose(PoseError::DeadPoint { phi, .. } | PoseError::BranchChange { phi, .. }) =
        refused
    else {
        panic!("{refused}")
    };
    let end = crate::support::largest((0..2000).map(|k| at(f64::from(k) * 1e-3 - 1.0)));
    assert_near("dead centre", phi, end, 1e-6);
}

/// A slider-crank driven at each of its joints in turn, with the joint's bodies in either order: a rotor geared to the joint acts between these two
/// bodies. It adds its inertia to the drive's effort, and to no reaction.
#[test]
fn a_rotor_loads_the_drive_and_no_joint() {
    let spec = crate::support::samples(1, 5, &spec()).remove(0);
    let machine = spec.machine();
    let crank_driven = machine.mechanism();
    let [from, middle, to] = [2.0, 2.3, 2.6].map(|phi| crank_driven.frames(phi).unwrap());
    let joints = jred::machine::Jointed::joints(crank_driven, 2.3, &middle).unwrap();
    let drawing = middle.iter().map(|f| Pose {
        x: f.x.value,
        y: f.y.value,
        psi: f.psi.value,
    });
    let drawing: Vec<Pose> = drawing.collect();
    let swapped = |joint: &Joint| match *joint {
        Joint::Revolute([a, b]) => Joint::Revolute([b, a]),
        Joint::Prismatic([a, b]) => Joint::Prismatic([b, a]),
        _ => panic!("a slider-crank has pins and a guide"),
    };
    for (drive, driven) in joints.iter().enumerate() {
        for driven in [*driven, swapped(driven)] {
            let mut joints = joints.clone();
            joints[drive] = driven;
            let pairs: Vec<Pair> = joints.iter().copied().map(Pair::Joint).collect();
            let linkage = Linkage::<3, 4>::new(crank_driven.links(), &pairs, drive).unwrap();
            let [from, at, to] = [&from, &middle, &to].map(|f| driven.coordinate(f).value);
            let domain = Domain::stroke(from.min(to), from.max(to)).unwrap();
            let assembly: Assembly<3, 4, 64> = linkage.assemble(domain, at, &drawing).unwrap();
            let light = Machine::new(assembly).with_gravity([1.0, -9.81]).unwrap();
            let (inertia, omega, alpha) = (0.7, 1.3, -20.0);
            let heavy = light.clone().with_flywheel(inertia).unwrap();
            forces::dalembert(&heavy, at, omega, alpha);
            forces::balance(&heavy, at, omega, alpha);
            let [without, with] = [&light, &heavy].map(|m| m.forces(at, omega, alpha).unwrap());
            let scale = with.drive.abs() + without.drive.abs();
            let more = with.drive - without.drive;
            assert_near("drive", more, inertia * alpha, budget::DALEMBERT * scale);
            for (a, b) in with.reactions.iter().zip(&without.reactions) {
                let [a, b] = [a, b].map(|r| [r.force[0], r.force[1], r.moment]);
                let scale = crate::support::largest(b) + scale;
                for (a, b) in a.into_iter().zip(b) {
                    assert_near("reaction", a, b, budget::REACTIONS * scale);
                }
            }
        }
    }
}

/// For a coupler and a rocker with pins at their frames' origins it is |sin μ|, with cos μ = (b² + c² − |AC|²)/(2·b·c).
#[test]
fn the_quality_of_a_four_bar_is_the_sine_of_its_transmission_angle() {
    let case = Case::new(include_str!("data/02_four_bar_A.json"));
    let machine = golden_four_bar(&case);
    let [a, b, c] = ["/a", "/b", "/c"].map(|name| case.input(name));
    let pivot = [case.input("/C/0"), case.input("/C/1")];
    for k in 0..90 {
        let phi = 0.2 * f64::from(k) - 3.0;
        let pin = [a * phi.cos() - pivot[0], a * phi.sin() - pivot[1]];
        let square = pin[0] * pin[0] + pin[1] * pin[1];
        let cos = (b * b + c * c - square) / (2.0 * b * c);
        let (quality, pair) = machine.mechanism().quality(phi).unwrap();
        assert_near(
            "|sin μ|",
            quality,
            (1.0 - cos * cos).sqrt(),
            budget::LINKAGE,
        );
        assert!((1..4).contains(&pair), "not the drive: {pair}");
    }
}

/// A new payload in the rocker, of mass m at the distance r from its pivot: J grows by m·r²·ψ′², and no position changes.
#[test]
fn another_mass_of_a_link_changes_the_inertia_alone() {
    let case = Case::new(include_str!("data/02_four_bar_A.json"));
    let bare = Link::point_mass(0.0).unwrap();
    let mut assembly = golden_four_bar(&case).mechanism().clone();
    assembly.set_link(2, bare).unwrap();
    let (mass, r) = (3.0, 0.25);
    let mut heavy = assembly.clone();
    heavy.set_link(2, link_of(mass, 0.0, [r, 0.0])).unwrap();
    for phi in [-2.0, 0.3, 1.7, 5.0] {
        let rocker = assembly.frames(phi).unwrap()[2].psi;
        let more = mass * r * r * rocker.d1 * rocker.d1;
        let [before, after] =
            [&assembly, &heavy].map(|m| Machine::new(m).bare_reduction(phi).unwrap().inertia);
        assert_near("m·r²·ψ′²", after - before, more, budget::LINKAGE * after);
        assert_near(
            "ψ",
            heavy.frames(phi).unwrap()[2].psi.value,
            rocker.value,
            0.0,
        );
    }
    let error = heavy.set_link(3, bare).unwrap_err().to_string();
    assert!(error.contains("links 0 to 2"), "{error}");
}
