//! The general linkage: golden data, library mechanisms by their joints alone, and what it refuses.

mod support;

use jred::mechanism::{Assembly, Linkage, Pair, Pose};
use jred::{Action, Domain, Joint, Link, Load, Machine, Marker, Mechanism, Reducible};
use proptest::prelude::*;
use support::golden::Case;
use support::machines::spec;
use support::{budget, config, jointed};

const O: [f64; 2] = [0.0, 0.0];

fn pin(a: Marker, b: Marker) -> Pair {
    Pair::Joint(Joint::Revolute([a, b]))
}

/// The golden four-bar, described by its links and pins alone, from a drawing rounded to centimetres and five degrees.
fn golden_four_bar(case: &Case) -> Machine<Assembly<3, 4, 256>> {
    let input = |path: &str| case.input(path);
    let com = |name: &str| [0, 1].map(|k| input(&format!("/{name}_com/{k}")));
    let link = |m, i, name| Link::new(input(m), input(i), com(name)).unwrap();
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
            &at(&|phi| reduced(phi).inertia[order]),
            budget::LINKAGE,
        );
    }
    table.compare("Q", &at(&|phi| reduced(phi).load_torque()), budget::LINKAGE);

    let table = case.table("motion");
    let [phi, omega, alpha] = ["phi", "omega", "alpha"].map(|name| table.column(name));
    let forces: Vec<_> = (0..phi.len())
        .map(|k| machine.forces(phi[k], omega[k], alpha[k]).unwrap())
        .collect();
    let compare = |column: &str, f: &dyn Fn(&jred::Forces) -> f64| {
        let found: Vec<f64> = forces.iter().map(f).collect();
        table.compare(column, &found, budget::REACTIONS);
    };
    compare("T_drive", &|f| f.drive);
    // In the linkage the coupler is the first body of pin B: it acts on the rocker.
    for (joint, name) in ["F_0_1", "F_1_2", "F_2_3", "F_0_3"].iter().enumerate() {
        compare(&format!("{name}x"), &|f| f.reactions[joint].force[0]);
        compare(&format!("{name}y"), &|f| f.reactions[joint].force[1]);
    }
}

proptest! {
    #![proptest_config(config(60, 0x11_4b))]

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
