//! Golden data: 50-digit references and exact rationals, see `tests/data`.

use crate::support::golden::Case;
use crate::support::machines::golden_slider_crank;
use crate::support::{assert_near, budget};
use jred::machine::{Action, Load, Machine, Mechanism, Reducible};
use jred::mechanism::{
    BeltDimensions, GearDimensions, Mesh, SliderCrank, Stage, Train, TrainOutput,
};

#[test]
fn slider_crank_golden() {
    let case = Case::new(include_str!("data/01_slider_crank_A.json"));
    let machine = golden_slider_crank(&case);
    let table = case.table("position");
    let at = |f: &dyn Fn(f64) -> f64| table.column("phi").into_iter().map(f).collect::<Vec<_>>();
    let slider = |phi| machine.mechanism().frames(phi).unwrap()[SliderCrank::SLIDER].x;
    let rod = |phi| machine.mechanism().frames(phi).unwrap()[SliderCrank::ROD].psi;
    let reduced = |phi| machine.reduction(phi).unwrap();
    table.compare("xB", &at(&|phi| slider(phi).value), budget::GOLDEN);
    table.compare("dxB", &at(&|phi| slider(phi).d1), budget::GOLDEN);
    table.compare("d2xB", &at(&|phi| slider(phi).d2), budget::GOLDEN);
    table.compare("th", &at(&|phi| rod(phi).value), budget::GOLDEN);
    table.compare("dth", &at(&|phi| rod(phi).d1), budget::GOLDEN);
    table.compare("d2th", &at(&|phi| rod(phi).d2), budget::GOLDEN);
    table.compare("J", &at(&|phi| reduced(phi).inertia), budget::GOLDEN);
    table.compare("dJ", &at(&|phi| reduced(phi).inertia_slope), budget::GOLDEN);
    table.compare(
        "d2J",
        &at(&|phi| reduced(phi).inertia_curvature),
        budget::GOLDEN,
    );
    table.compare("Q", &at(&|phi| reduced(phi).load_torque()), budget::GOLDEN);
}

#[test]
fn slider_crank_golden_motion() {
    let case = Case::new(include_str!("data/01_slider_crank_A.json"));
    let machine = golden_slider_crank(&case);
    let table = case.table("motion");
    let [phi0, w, a, nu] = ["phi0", "w", "A", "nu"].map(|name| case.motion(name));
    // The law itself, to verify the meaning of the columns.
    let times = table.column("t");
    let law = |f: &dyn Fn(f64) -> f64| times.iter().copied().map(f).collect::<Vec<_>>();
    table.compare(
        "phi",
        &law(&|t| phi0 + w * t + a * (nu * t).sin()),
        budget::GOLDEN,
    );
    table.compare(
        "omega",
        &law(&|t| w + a * nu * (nu * t).cos()),
        budget::GOLDEN,
    );
    table.compare(
        "alpha",
        &law(&|t| -a * nu * nu * (nu * t).sin()),
        budget::GOLDEN,
    );
    let states: Vec<[f64; 3]> = times
        .iter()
        .map(|t| {
            let (sin, cos) = (nu * t).sin_cos();
            [phi0 + w * t + a * sin, w + a * nu * cos, -a * nu * nu * sin]
        })
        .collect();
    let at = |f: &dyn Fn([f64; 3]) -> f64| states.iter().copied().map(f).collect::<Vec<_>>();
    let slider = |phi| machine.mechanism().frames(phi).unwrap()[SliderCrank::SLIDER].x;
    let rod = |phi| machine.mechanism().frames(phi).unwrap()[SliderCrank::ROD].psi;
    table.compare("xB", &at(&|[phi, ..]| slider(phi).value), budget::GOLDEN);
    table.compare(
        "xB_t",
        &at(&|[phi, w, _]| slider(phi).velocity(w)),
        budget::GOLDEN,
    );
    table.compare(
        "xB_tt",
        &at(&|[phi, w, a]| slider(phi).acceleration(w, a)),
        budget::GOLDEN,
    );
    table.compare("th", &at(&|[phi, ..]| rod(phi).value), budget::GOLDEN);
    table.compare(
        "th_t",
        &at(&|[phi, w, _]| rod(phi).velocity(w)),
        budget::GOLDEN,
    );
    table.compare(
        "th_tt",
        &at(&|[phi, w, a]| rod(phi).acceleration(w, a)),
        budget::GOLDEN,
    );
    let torque = |[phi, w, a]: [f64; 3]| machine.reduction(phi).unwrap().torque(w, a).total();
    table.compare("T_drive", &at(&torque), budget::GOLDEN);
}

#[test]
fn start_from_rest_golden_states() {
    let case = Case::new(include_str!("data/07_slider_crank_start_A.json"));
    let machine = golden_slider_crank(&case)
        .with_flywheel(case.input("/flywheel_I"))
        .unwrap();
    let drive = case.input("/T_drive");
    let table = case.table("run");
    let (phis, omegas) = (table.column("phi"), table.column("omega"));
    let at = |f: &dyn Fn(f64, f64) -> f64| {
        phis.iter()
            .zip(&omegas)
            .map(|(phi, omega)| f(*phi, *omega))
            .collect::<Vec<_>>()
    };
    let reduced = |phi| machine.reduction(phi).unwrap();
    let slider = |phi| machine.mechanism().frames(phi).unwrap()[SliderCrank::SLIDER].x;
    table.compare("xB", &at(&|phi, _| slider(phi).value), budget::GOLDEN);
    table.compare(
        "xB_t",
        &at(&|phi, w| slider(phi).velocity(w)),
        budget::GOLDEN,
    );
    table.compare("J", &at(&|phi, _| reduced(phi).inertia), budget::GOLDEN);
    table.compare(
        "alpha",
        &at(&|phi, w| reduced(phi).acceleration(w, drive)),
        budget::GOLDEN,
    );
    let kinetic = |phi, w: f64| 0.5 * reduced(phi).inertia * w * w;
    table.compare("kinetic_energy", &at(&kinetic), budget::GOLDEN);
    // Work and energy: drive and load torque by the angle, the slider's force by its way, weight by U.
    let (start, torque) = (case.input("/phi0"), drive + case.input("/M_crank"));
    let force = case.input("/F_slider/F/0");
    let work = |phi: f64, _| {
        torque * (phi - start) + force * (slider(phi).value - slider(start).value)
            - (reduced(phi).potential_energy - reduced(start).potential_energy)
    };
    table.compare("kinetic_energy", &at(&work), budget::GOLDEN);
}

/// Relative to the golden value itself.
#[track_caller]
fn compare(case: &Case, name: &str, found: f64) {
    let expected = case.value(name);
    assert_near(name, found, expected, budget::GOLDEN * expected.abs());
}

#[track_caller]
fn compare_exact(case: &Case, name: &str, found: f64) {
    let [top, bottom] = case.rational(name);
    assert_near(name, found * bottom, top, budget::GOLDEN * top.abs());
}

#[test]
fn gear_train_golden() {
    let case = Case::new(include_str!("data/05_gear_train_A.json"));
    let teeth = [0, 1, 2, 3].map(|k| case.input(&format!("/z/{k}")) as u32);
    let inertia = [0, 1, 2, 3].map(|k| case.input(&format!("/J/{k}")));
    let first = Stage::gears(GearDimensions {
        teeth: [teeth[0], teeth[1]],
        inertias: [inertia[0], inertia[1]],
        mesh: Mesh::External,
    });
    let second = Stage::gears(GearDimensions {
        teeth: [teeth[2], teeth[3]],
        inertias: [inertia[2], inertia[3]],
        mesh: Mesh::External,
    });
    let train = Train::new(&[first.unwrap(), second.unwrap()]).unwrap();
    compare(&case, "i_12", train.stages()[0].ratio());
    compare(&case, "i_34", train.stages()[1].ratio());
    compare(&case, "i_14", train.ratio());
    compare(&case, "J", train.inertia_at_input());

    let t4 = case.input("/T4");
    let machine = Machine::new(train.clone())
        .with_load(Load::new(0, Action::Moment(case.input("/T1"))).unwrap())
        .and_then(|m| m.with_load(Load::new(2, Action::Moment(t4))?))
        .unwrap();
    for phi in [0.0, 1.0, 5.0] {
        let reduced = machine.reduction(phi).unwrap();
        compare(&case, "J", reduced.inertia);
        compare_exact(&case, "J", reduced.inertia);
        assert_near("dJ", reduced.inertia_slope, 0.0, 0.0);
        compare(&case, "T_red", reduced.reduced_torque(0.0));
        let eps = reduced.acceleration(0.0, 0.0);
        compare(&case, "eps_1", eps);
        compare_exact(&case, "eps_1", eps);
        // T_red does not depend on φ or ω: uniform acceleration.
        let t = case.input("/t");
        compare(&case, "omega_1(t)", eps * t);
        compare(&case, "phi_1(t)", 0.5 * eps * t * t);
        compare(
            &case,
            "kinetic_energy(t)",
            0.5 * reduced.inertia * (eps * t) * (eps * t),
        );
        let frames = train.frames(phi).unwrap();
        compare(&case, "omega_4(t)", frames[2].psi.velocity(eps * t));
        compare(&case, "eps_2", frames[1].psi.acceleration(eps * t, eps));
        // The same torque from the output side through the lossless train.
        let out = frames[2].psi.d1 * eps;
        let input = train.input(&TrainOutput {
            torque: -t4,
            omega: 1.0,
            alpha: out,
            direction: 1.0,
            ..TrainOutput::default()
        });
        assert_near("T1", input.torque, case.input("/T1"), budget::GOLDEN);
        assert_near(
            "dT/dα",
            input.torque_per_alpha,
            reduced.inertia * train.ratio(),
            budget::GOLDEN,
        );
        assert_near("loss", input.loss, 0.0, 0.0);
    }
    let ring = Stage::gears(GearDimensions {
        teeth: [18, 54],
        inertias: [0.0, 0.0],
        mesh: Mesh::Internal,
    })
    .unwrap();
    assert_near("internal mesh", ring.ratio(), 3.0, 0.0);
}

#[test]
fn belt_drive_golden() {
    let case = Case::new(include_str!("data/05_belt_drive_A.json"));
    let [r1, r2, j1, j2, weight, g] =
        ["/r1", "/r2", "/J1", "/J2", "/P", "/g"].map(|n| case.input(n));
    let belt = Stage::belt(BeltDimensions {
        radii: [r1, r2],
        inertias: [j1, j2],
        mass: weight / g,
    })
    .unwrap();
    let train = Train::new(&[belt]).unwrap();
    let machine = Machine::new(train.clone())
        .with_load(Load::new(0, Action::Moment(case.input("/T1"))).unwrap())
        .and_then(|m| m.with_load(Load::new(1, Action::Moment(-case.input("/T2")))?))
        .unwrap();
    let reduced = machine.reduction(0.7).unwrap();
    compare(&case, "J", reduced.inertia);
    compare_exact(&case, "J", reduced.inertia);
    compare(&case, "J", train.inertia_at_input());
    compare(&case, "m_red_belt_speed", reduced.inertia / (r1 * r1));
    compare(&case, "T_red", reduced.reduced_torque(3.0));
    let eps = reduced.acceleration(0.0, 0.0);
    compare(&case, "eps_1", eps);
    compare_exact(&case, "eps_1", eps);
    let driven = train.frames(0.7).unwrap()[1].psi;
    compare(&case, "eps_2", driven.acceleration(10.0, eps));
    compare(
        &case,
        "belt_acceleration",
        driven.acceleration(10.0, eps) * r2,
    );
    let t = case.input("/t");
    compare(&case, "omega_1(t)", eps * t);
    compare(&case, "phi_1(t)", 0.5 * eps * t * t);
    // Free bodies: each pulley is driven by the difference of the belt's tensions.
    let driver = (case.input("/T1") - j1 * eps) / r1;
    compare(&case, "tension_difference_driver_side", driver);
}
