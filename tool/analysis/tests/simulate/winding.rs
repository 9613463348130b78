//! A DC motor with its winding, and an induction motor by its name plate.

use jred_analysis::simulate::{SimulationResult, simulate};
use jred_file::model::characteristic::Characteristic;

use crate::reading::{parse, rendered};
use crate::steady::rotor;
use crate::support::{budget, near, within};

/// 24 V, 0.5 Ω, 0.06 N·m/A, and this inductance in mH, on a rotor of 0.4 kg·m² geared by nothing.
fn motor(inductance: &str) -> String {
    format!(
        "rotor_inertia = \"0 kg m^2\"\ndc_motor = {{ voltage = \"24 V\", resistance = \"0.5 Ohm\", \
         torque_constant = \"0.06 N m/A\"{inductance} }}"
    )
}

/// A light rotor, so that the winding matters: 2e-5 kg·m².
fn light(loads: &str, motor: &str) -> String {
    rotor(loads, motor)
        .replace("0.4 kg m^2", "2e-5 kg m^2")
        .replace("duration = \"1 s\"", "duration = \"0.05 s\"")
        .replace("output_step = \"0.1 s\"", "output_step = \"0.5 ms\"")
}

fn run(text: &str) -> SimulationResult {
    let file = parse(text).unwrap_or_else(|report| panic!("{}", rendered(&report)));
    simulate(&file, file.simulation.as_ref().unwrap()).unwrap()
}

fn column(found: &SimulationResult, name: &str) -> Vec<f64> {
    let names = found.columns.names();
    let k = names.iter().position(|other| other == name).unwrap();
    found
        .columns
        .rows()
        .iter()
        .map(|row| row[k].unwrap())
        .collect()
}

/// J·ω′ = k·i, L·i′ = U − R·i − k·ω: a damped oscillation, ω = ω₀·(1 − e^(−δt)·(cos νt + δ/ν·sin νt)), i = J·ω′/k.
#[test]
fn a_winding_swings() {
    let found = run(&light("", &motor(", inductance = \"1 mH\"")));
    let (u, r, k, l, j) = (24.0, 0.5, 0.06, 1e-3, 2e-5);
    let damping: f64 = r / (2.0 * l);
    let own = k * k / (l * j) - damping * damping;
    assert!(own > 0.0);
    let nu = own.sqrt();
    let [t, omega, current] = ["t [s]", "omega [rad/s]", "current [A]"].map(|n| column(&found, n));
    for ((t, omega), current) in t.iter().zip(omega).zip(current) {
        let fall = (-damping * t).exp();
        let (sin, cos) = (nu * t).sin_cos();
        let expected = u / k * (1.0 - fall * (cos + damping / nu * sin));
        let slope = u / k * fall * (damping * damping / nu + nu) * sin;
        within("ω", omega, expected, budget::SIMULATED_WINDING * u / k);
        within(
            "i",
            current,
            j * slope / k,
            budget::SIMULATED_WINDING * u / r,
        );
    }
    let balance = column(&found, "energy balance [J]");
    assert!(
        balance.iter().all(|error| error.abs() < 1e-9),
        "{balance:?}"
    );
}

/// Without an inductance the motor is its line: k·U/R at rest, U/k without a load.
#[test]
fn a_winding_without_inductance_is_a_line() {
    let file = parse(&light("", &motor(""))).unwrap();
    let simulation = file.simulation.as_ref().unwrap();
    assert!(simulation.winding.is_none());
    let Some(Characteristic::Dc {
        no_load_speed,
        stall_torque,
    }) = simulation.torque
    else {
        panic!("{:?}", simulation.torque);
    };
    near("ω₀", no_load_speed, 24.0 / 0.06, 1e-14);
    near("T", stall_torque, 0.06 * 24.0 / 0.5, 1e-14);
}

/// Friction of 2 N·m holds until the current has grown to it: t = −τ·ln(1 − F/T_stall), and permanently where it is larger than that.
#[test]
fn friction_holds_until_the_current_has_grown() {
    let friction = |torque: &str| {
        let load = format!("[[load]]\non = \"shaft-1\"\nopposing_moment = \"{torque}\"");
        run(&light(&load, &motor(", inductance = \"5 mH\"")))
    };
    let found = friction("2 N m");
    let tau = 5e-3 / 0.5;
    let start = -tau * f64::ln(1.0 - 2.0 / 2.88);
    let [t, omega, current] = ["t [s]", "omega [rad/s]", "current [A]"].map(|n| column(&found, n));
    for ((t, omega), current) in t.iter().zip(omega).zip(current) {
        assert_eq!(*t > start, omega > 0.0, "{t} {omega}");
        if *t < start {
            near(
                "i",
                current + 1.0,
                1.0 + 48.0 * (1.0 - (-t / tau).exp()),
                1e-9,
            );
        }
    }
    assert!(found.missing.is_none());
    let held = friction("2.9 N m");
    let missing = held.missing.unwrap().missing;
    near("given", missing.given, 2.88, 1e-12);
    near("needed", missing.needed, 2.9, 1e-9);
    near("effort", held.effort.unwrap().torque[0], 2.88, 1e-2);
}

/// Once it is switched off there is no current, and the rotor keeps its speed.
#[test]
fn a_motor_that_is_switched_off_has_no_current() {
    let text = light("", &motor(", inductance = \"1 mH\""));
    let found = run(&format!("{text}\nstop = {{ time = \"20 ms\" }}"));
    let [omega, current] = ["omega [rad/s]", "current [A]"].map(|n| column(&found, n));
    assert!(current[30] != 0.0 && current[50..].iter().all(|i| *i == 0.0));
    assert!(
        omega[50..]
            .iter()
            .all(|speed| (speed / omega[50] - 1.0).abs() < 1e-12)
    );
}

/// Kloss through the point of the name plate: 950 rpm, 2.2 kW, 57 N·m at most.
#[test]
fn an_induction_motor_by_its_name_plate() {
    let of = |plate: &str| {
        let motor = format!(
            "induction_motor = {{ synchronous_speed = \"1000 rpm\", breakdown_torque = \"57 N m\", {plate} }}"
        );
        let file = parse(&rotor("", &motor));
        file.map(|file| file.simulation.unwrap().torque.unwrap())
    };
    let rpm = std::f64::consts::PI / 30.0;
    let by_power = of("rated_speed = \"950 rpm\", rated_power = \"2.2 kW\"").unwrap();
    let rated = 2200.0 / (950.0 * rpm);
    near("rated", by_power.torque(950.0 * rpm), rated, 1e-12);
    let Characteristic::Induction { breakdown_slip, .. } = by_power else {
        panic!("{by_power:?}");
    };
    near(
        "breakdown",
        by_power.torque(1000.0 * rpm * (1.0 - breakdown_slip)),
        57.0,
        1e-12,
    );
    // The larger of the two slips: the rated point lies on the stable branch.
    assert!(breakdown_slip > 0.05, "{breakdown_slip}");
    let torque = format!("rated_speed = \"950 rpm\", rated_torque = \"{rated:?} N m\"");
    near(
        "rated",
        of(&torque).unwrap().torque(700.0 * rpm),
        by_power.torque(700.0 * rpm),
        1e-9,
    );
    for (plate, says) in [
        ("rated_power = \"2.2 kW\"", "rated_speed"),
        ("rated_speed = \"950 rpm\"", "rated_power"),
        (
            "rated_speed = \"1050 rpm\", rated_power = \"2.2 kW\"",
            "between zero and that",
        ),
        (
            "rated_speed = \"950 rpm\", rated_torque = \"60 N m\"",
            "gives a rated torque of 60 N m, but it must be smaller than the breakdown torque, 57 N m",
        ),
        (
            "rated_speed = \"500 rpm\", rated_torque = \"10 N m\"",
            "breakdown slip of",
        ),
        (
            "rated_speed = \"950 rpm\", rated_torque = \"-20 N m\"",
            "must have the same sign and not be zero",
        ),
        (
            "rated_speed = \"950 rpm\", rated_power = \"0 kW\"",
            "must have the same sign and not be zero",
        ),
        (
            "breakdown_slip = \"20 %\", rated_speed = \"950 rpm\", rated_power = \"2.2 kW\"",
            "both `breakdown_slip` and `rated_speed`",
        ),
        (
            "rated_speed = \"950 rpm\", rated_torque = \"20 N m\", rated_power = \"2.2 kW\"",
            "both `rated_torque` and `rated_power`",
        ),
    ] {
        let report = rendered(&of(plate).unwrap_err());
        assert!(report.contains(says), "{plate}: {report}");
    }
    // The motor itself comes before its name plate.
    let backwards = rotor(
        "",
        "induction_motor = { synchronous_speed = \"-500 rpm\", breakdown_torque = \"700 N m\", rated_speed = \"-470 rpm\", rated_power = \"12 kW\" }",
    );
    let report = rendered(&parse(&backwards).unwrap_err());
    let says = "is 700 N m with a speed of -500 rpm: they must have the same sign";
    assert!(
        report.contains(says) && !report.contains("none"),
        "{report}"
    );
}

/// A motor at a constant voltage has no controller.
#[test]
fn a_winding_has_no_controller() {
    let motion = "[motion]\ntype = \"constant-speed\"\nspeed = \"60 rpm\"\n";
    let control = "control = { speed_gain = \"1 N m s/rad\" }";
    let simulation = format!("{}\n{control}", motor(", inductance = \"1 mH\""));
    let text = light(motion, &simulation);
    let report = rendered(&parse(&text).unwrap_err());
    assert!(
        report.contains("belongs to a motor at a constant voltage"),
        "{report}"
    );
}

/// 3 N·m on 0.4 kg·m²: 20 rad/s after 8/3 s and 80/3 rad; the largest power and the RMS torque by hand. It coasts to rest under 1 N·m.
#[test]
fn speeds_that_are_reached_and_what_the_motor_gives() {
    let text = rotor("", "torque = \"3 N m\"").replace("\"1 s\"", "\"4 s\"");
    let mut file = parse(&text).unwrap();
    let simulation = file.simulation.as_mut().unwrap();
    simulation.to_speed = Some(20.0);
    let simulation = simulation.clone();
    let found = simulate(&file, &simulation).unwrap();
    let reached = found.reached.unwrap();
    near("time", reached.time, 8.0 / 3.0, 1e-9);
    near("way", reached.way, 80.0 / 3.0, 1e-9);
    let effort = found.effort.unwrap();
    near("torque", effort.torque[0], 3.0, 1e-15);
    near("RMS", effort.rms, 3.0, 1e-12);
    near("speed", effort.speed[0], 30.0, 1e-9);
    near("power", effort.power[0], 90.0, 1e-9);
    assert!(found.held.is_none());
    let coast = rotor(
        "[[load]]\non = \"shaft-1\"\nopposing_moment = \"1 N m\"",
        "torque = \"0 N m\"\nstart_speed = \"2 rad/s\"",
    );
    let held = run(&coast).held.unwrap();
    near("time", held.time, 0.8, 1e-9);
    near("way", held.way, 0.8, 1e-9);
    // A falling line: the RMS torque of 9·exp(−t/τ), τ = 0.4/0.15 s.
    let line = "dc_motor = { no_load_speed = \"60 rad/s\", stall_torque = \"9 N m\" }";
    let effort = run(&rotor("", line)).effort.unwrap();
    let tau: f64 = 0.4 / 0.15;
    let mean = 81.0 * tau / 2.0 * (1.0 - (-2.0 / tau).exp());
    near("RMS", effort.rms, mean.sqrt(), 1e-9);
}
