//! Several machines on one shaft.

use jred_analysis::simulate::{
    CoupledMachines, NotBeside, SimulationError, SimulationResult, simulate_together,
};
use jred_file::model::machine::MachineFile;

use super::imbalance;
use crate::reading::{parse, table_behind_gears};
use crate::support::{Columns, budget, near, near_column, press_text, within};

/// A table behind a pair of gears, each with its friction.
fn table(inertia: f64, driven: u32, friction: f64) -> MachineFile {
    let rest = r#"efficiency = "90 %"
[simulation]
start_angle = "10 deg"
duration = "1 s"
output_step = "20 ms"
torque = "-5 N m"
rotor_inertia = "0.02 kg m^2"
"#;
    table_behind_gears([inertia, friction], driven, rest)
}

fn run(first: &MachineFile, others: &[(&MachineFile, f64)]) -> (SimulationResult, Columns) {
    let simulation = first.simulation.as_ref().unwrap();
    let machines = CoupledMachines::alone(first)
        .with(others.iter().copied(), simulation)
        .unwrap();
    let found = simulate_together(&machines, simulation).unwrap();
    let columns = Columns {
        names: found.columns.names(),
        rows: found.columns.rows().to_vec(),
    };
    (found, columns)
}

/// A machine beside another is spoken of in its own words: the carriage of a belt axis in mm, 192 mm a turn of its pulley.
#[test]
fn each_machine_has_its_own_words() {
    let first = table(0.8, 40, 1.0);
    let axis = parse(include_str!("../../../../machines/belt-axis.toml")).unwrap();
    let (_, rows) = run(&first, &[(&axis, 0.0)]);
    let (table, carriage) = (rows.get("phi [deg]"), rows.get("machine 2 x [mm]"));
    for (phi, x) in table.iter().zip(&carriage) {
        // Gears of 2 and 3: the pulley makes two turns where the table makes three.
        let turns = (phi - 10.0) / 360.0 * 2.0 / 3.0;
        within("x", *x - carriage[0], 192.0 * turns, 1e-9 * 192.0);
    }
    assert!((carriage[carriage.len() - 1] - carriage[0]).abs() > 10.0);
}

/// T = J_M·α_s + Σ (J_k·α_s/i_k² + τ_k/|i_k|)/η, gears turning the tables against the shaft: −2 and −3.
#[test]
fn two_tables_accelerate_as_by_hand() {
    let (first, second) = (table(0.8, 40, 1.0), table(1.5, 60, 0.6));
    let (found, rows) = run(&first, &[(&second, 0.5)]);
    let inertia = 0.02 + (0.8 / 4.0 + 1.5 / 9.0) / 0.9;
    let friction = (1.0 / 2.0 + 0.6 / 3.0) / 0.9;
    // The shaft turns backwards, the tables forwards.
    let shaft = (5.0 - friction) / inertia;
    for (k, t) in rows.get("t [s]").into_iter().enumerate() {
        let of = |name: &str| rows.get(name)[k];
        let way = 0.5 * shaft * t * t;
        within(
            "ω",
            of("omega [rad/s]"),
            shaft / 2.0 * t,
            budget::CLOSED_MOTION * 10.0,
        );
        let first = 10.0 + (way / 2.0).to_degrees();
        within("φ", of("phi [deg]"), first, budget::CLOSED_MOTION * 1e3);
        let second = (0.5 + way / 3.0).to_degrees();
        within(
            "φ_2",
            of("machine 2 phi [deg]"),
            second,
            budget::CLOSED_MOTION * 1e3,
        );
    }
    // At the first table: J_1 + J_2·(2/3)² + J_M·2².
    let lumped = 0.8 + 1.5 * 4.0 / 9.0 + 0.02 * 4.0;
    near(
        "J",
        rows.get("J_red [kg m^2]")[7],
        lumped,
        budget::CLOSED_FORM,
    );
    assert!(imbalance(&rows) < budget::BALANCE);
    assert!(found.ended.is_none());
}

/// The friction of both tables holds them; by hand as above.
#[test]
fn friction_of_both_holds_the_shaft() {
    let (first, second) = (table(0.8, 40, 6.0), table(1.5, 60, 6.0));
    let (found, rows) = run(&first, &[(&second, 0.0)]);
    assert!(rows.get("omega [rad/s]").iter().all(|omega| *omega == 0.0));
    let missing = found.missing.unwrap().missing;
    near("given", missing.given, -5.0, budget::CLOSED_FORM);
    let needed = (6.0 / 2.0 + 6.0 / 3.0) / 0.9;
    near("needed", missing.needed, -needed, budget::CLOSED_FORM);
}

/// Two presses in phase under twice the torque and rotor move as one; a quarter of a turn apart, where one ram is fast and the other slow, the inertia is more even, and the energy balance closes.
#[test]
fn twins_in_phase_are_one_and_out_of_phase_even_out() {
    let text = press_text();
    let (machine, _) = text.split_once("[simulation]").unwrap();
    let press = |torque: f64, rotor: f64| {
        parse(&format!(
            "{machine}\n[simulation]\nstart_angle = \"180 deg\"\nstart_speed = \"90 rpm\"\nduration = \"1 s\"\noutput_step = \"2 ms\"\ntorque_speed = [[\"0 rpm\", \"{} N m\"], [\"500 rpm\", \"{} N m\"], [\"800 rpm\", \"0 N m\"]]\nrotor_inertia = \"{rotor} kg m^2\"\n",
            60.0 * torque,
            45.0 * torque
        ))
        .unwrap()
    };
    let (one, two) = (press(1.0, 0.02), press(2.0, 0.04));
    let (_, alone) = run(&one, &[]);
    let start = std::f64::consts::PI;
    let (_, twins) = run(&two, &[(&one, start)]);
    for name in ["phi [deg]", "omega [rad/s]"] {
        near_column(
            name,
            &twins.get(name),
            &alone.get(name),
            budget::SAME_MOTION,
        );
    }
    let (_, apart) = run(&two, &[(&one, 1.5 * start)]);
    assert!(imbalance(&apart) < budget::BALANCE);
    let spread = |rows: &Columns| {
        let inertias = rows.get("J_red [kg m^2]");
        let most = inertias.iter().copied().fold(0.0, f64::max);
        most - inertias.iter().copied().fold(f64::INFINITY, f64::min)
    };
    assert!(spread(&apart) < 0.3 * spread(&twins), "{}", spread(&apart));
    // A quarter of a turn apart at every instant.
    for (a, b) in apart
        .get("phi [deg]")
        .into_iter()
        .zip(apart.get("machine 2 phi [deg]"))
    {
        near("apart", b - a, 90.0, budget::CLOSED_FORM);
    }
}

#[test]
fn a_machine_with_a_stroke_is_the_first_or_none() {
    let stroke = parse(
        "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\nstroke = [\"0 deg\", \"90 deg\"]\n[mechanism.table]\nmass = \"1 kg\"\ninertia = \"1 kg m^2\"\n",
    )
    .unwrap();
    let first = table(1.0, 40, 0.0);
    let simulation = first.simulation.as_ref().unwrap();
    let with = CoupledMachines::alone(&first).with([(&stroke, 0.0)], simulation);
    let Err(SimulationError::NotBeside { why, .. }) = with else {
        panic!("{with:?}");
    };
    assert_eq!(why, NotBeside::Stroke);
}
