//! The four-bar linkage against golden data: positions, reduction, motion, and the forces in its joints.

use crate::support::golden::Case;
use crate::support::{budget, forces, link_of};
use jred::machine::{Action, Load, Machine, Mechanism, Reducible};
use jred::mechanism::{FourBar, FourBarDimensions, Side};

fn golden() -> (Case, Machine<FourBar>) {
    let case = Case::new(include_str!("data/02_four_bar_A.json"));
    let input = |path: &str| case.input(path);
    let link = |k: usize, name: &str| {
        let com = [
            input(&format!("/{name}_com/0")),
            input(&format!("/{name}_com/1")),
        ];
        link_of(input(&format!("/m{k}")), input(&format!("/I{k}")), com)
    };
    let links = [link(1, "crank"), link(2, "coupler"), link(3, "rocker")];
    let side = if input("/mode") > 0.0 {
        Side::Left
    } else {
        Side::Right
    };
    let lengths = [input("/a"), input("/b"), input("/c")];
    let mechanism = FourBar::new(
        FourBarDimensions {
            crank: lengths[0],
            coupler: lengths[1],
            rocker: lengths[2],
            pivot: [input("/C/0"), input("/C/1")],
        },
        side,
        links,
    )
    .unwrap();
    let moment = |link, path| Load::new(link, Action::Moment(input(path))).unwrap();
    let machine = Machine::new(mechanism)
        .with_gravity([input("/gravity/0"), input("/gravity/1")])
        .and_then(|m| m.with_load(moment(FourBar::CRANK, "/M_crank")))
        .and_then(|m| m.with_load(moment(FourBar::ROCKER, "/M_rocker")))
        .unwrap();
    (case, machine)
}

#[test]
fn four_bar_golden() {
    let (case, machine) = golden();
    let table = case.table("position");
    let at = |f: &dyn Fn(f64) -> f64| table.column("phi").into_iter().map(f).collect::<Vec<_>>();
    let psi = |link: usize| {
        let machine = &machine;
        move |phi| machine.mechanism().frames(phi).unwrap()[link].psi
    };
    for (name, link) in [("t2", FourBar::COUPLER), ("t3", FourBar::ROCKER)] {
        let psi = psi(link);
        table.compare(name, &at(&|phi| psi(phi).value), budget::GOLDEN);
        table.compare(&format!("d{name}"), &at(&|phi| psi(phi).d1), budget::GOLDEN);
        table.compare(
            &format!("d2{name}"),
            &at(&|phi| psi(phi).d2),
            budget::GOLDEN,
        );
    }
    let reduced = |phi| machine.reduction(phi).unwrap();
    table.compare(
        "J",
        &at(&|phi| reduced(phi).inertia),
        budget::GOLDEN_REDUCTION,
    );
    table.compare(
        "dJ",
        &at(&|phi| reduced(phi).inertia_slope),
        budget::GOLDEN_REDUCTION,
    );
    table.compare(
        "d2J",
        &at(&|phi| reduced(phi).inertia_curvature),
        budget::GOLDEN_REDUCTION,
    );
    table.compare(
        "Q",
        &at(&|phi| reduced(phi).load_torque()),
        budget::GOLDEN_REDUCTION,
    );
}

#[test]
fn four_bar_golden_motion() {
    let (case, machine) = golden();
    let table = case.table("motion");
    let [phi0, w, a, nu] = ["phi0", "w", "A", "nu"].map(|name| case.motion(name));
    let states: Vec<[f64; 3]> = table
        .column("t")
        .into_iter()
        .map(|t| {
            let (sin, cos) = (nu * t).sin_cos();
            [phi0 + w * t + a * sin, w + a * nu * cos, -a * nu * nu * sin]
        })
        .collect();
    let at = |f: &dyn Fn([f64; 3]) -> f64| states.iter().copied().map(f).collect::<Vec<_>>();
    for (k, name) in ["phi", "omega", "alpha"].iter().enumerate() {
        table.compare(name, &at(&|state| state[k]), budget::GOLDEN);
    }
    for (name, link) in [("t2", FourBar::COUPLER), ("t3", FourBar::ROCKER)] {
        let psi = |phi| machine.mechanism().frames(phi).unwrap()[link].psi;
        table.compare(name, &at(&|[phi, ..]| psi(phi).value), budget::GOLDEN);
        let speed = |[phi, w, _]: [f64; 3]| psi(phi).velocity(w);
        table.compare(&format!("{name}_t"), &at(&speed), budget::GOLDEN);
        let acceleration = |[phi, w, a]: [f64; 3]| psi(phi).acceleration(w, a);
        table.compare(&format!("{name}_tt"), &at(&acceleration), budget::GOLDEN);
    }
    let torque = |[phi, w, a]: [f64; 3]| machine.reduction(phi).unwrap().torque(w, a).total();
    table.compare("T_drive", &at(&torque), budget::GOLDEN_REDUCTION);
}

#[test]
fn four_bar_reactions_golden() {
    let (case, machine) = golden();
    let table = case.table("motion");
    forces::golden(&machine, &table, &["F_0_1", "F_1_2", "F_2_3", "F_0_3"]);
}
