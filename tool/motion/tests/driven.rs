//! The free motion under a drive against closed forms, against `Way`, and against its own energy.

use std::collections::BTreeMap;

use jred::machine::motion::State;
use jred_analysis::checked;
use jred_analysis::simulate::CoupledMachines;
use jred_file::model::machine::MachineFile;
use jred_file::units::RPM;
use jred_motion::drive_simulation::{DriveSimulation, EASE, UnfitDrive, driven};
use jred_motion::path_dynamics::{Actuator, BothDirections};
use jred_sizing::catalogue::{Catalogue, Commutation, Drive, Gearbox, Motor, Thermal, Winding};
use jred_sizing::motor::envelope::Envelope;

use crate::support::{Columns, budget, largest, near, press_text, within};

fn machine(text: &str) -> MachineFile {
    checked::parse("test.toml", text, BTreeMap::<String, String>::new()).unwrap()
}

/// A table of 2 kg·m² with dry friction, without a motor of its own, simulated for this time (s).
fn table(friction: f64, duration: f64, more: &str) -> MachineFile {
    machine(&format!(
        "title = \"table\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\n[mechanism.table]\nmass = \"1 kg\"\ninertia = \"2 kg m^2\"\n[[load]]\non = \"table\"\nopposing_moment = \"{friction} N m\"\n[simulation]\nduration = \"{duration} s\"\noutput_step = \"{} s\"\n{more}",
        duration / 50.0
    ))
}

/// 8 N·m at every speed up to 300 rad/s.
fn motor() -> Motor {
    Motor {
        peak_torque: Some(8.0),
        peak_curve: vec![[0.0, 8.0], [300.0, 8.0]],
        max_speed: Some(300.0),
        rotor_inertia: 0.003,
        friction: [0.2, 0.0],
        ..Motor::default()
    }
}

fn gearbox() -> Gearbox {
    Gearbox {
        key: "box".to_owned(),
        ratio: 10.0,
        inertia: 0.001,
        efficiency: 0.9,
        back_efficiency: 0.8,
        no_load_torque: 0.3,
        peak_torque: Some(50.0),
        max_speed: Some(250.0),
        ..Gearbox::default()
    }
}

fn run(file: &MachineFile, drive: Drive<'_>) -> DriveSimulation {
    let simulation = file.simulation.as_ref().unwrap();
    driven(&CoupledMachines::alone(file), simulation, drive).unwrap()
}

fn columns(driven: &DriveSimulation) -> Columns {
    Columns {
        names: driven.simulated.columns.names(),
        rows: driven.simulated.columns.rows().to_vec(),
    }
}

fn imbalance(columns: &Columns) -> f64 {
    let turned_over = ["motor work [J]", "losses [J]", "kinetic energy [J]"]
        .map(|name| largest(&columns.get(name)));
    largest(&columns.get("energy balance [J]")) / turned_over.into_iter().fold(0.0, f64::max)
}

/// T = (J_M + J_G)·i·α + (J·α + τ)/(i·η) + c, solved for α by hand; then constant at the largest speed.
#[test]
fn full_torque_accelerates_a_table_evenly_up_to_the_largest_speed() {
    let (motor, gearbox) = (motor(), gearbox());
    let drive = Drive {
        motor: &motor,
        gearbox: Some(&gearbox),
        amplifier: None,
    };
    let file = table(3.0, 2.0, "start_angle = \"0 deg\"\n");
    let found = run(&file, drive);
    let rows = columns(&found);
    let friction = 0.2 + 0.3;
    let per_alpha = 0.004 * 10.0 + 2.0 / (10.0 * 0.9);
    let alpha = (8.0 - friction - 3.0 / (10.0 * 0.9)) / per_alpha;
    let top = 300.0 / 10.0;
    let mut even = 0;
    for (t, omega) in rows.get("t [s]").into_iter().zip(rows.get("omega [rad/s]")) {
        if alpha * t < top * (1.0 - EASE) {
            within("even", omega, alpha * t, budget::CLOSED_MOTION * top);
            even += 1;
        } else if alpha * t > 1.1 * top {
            assert!(omega > top * (1.0 - EASE) && omega < top, "{omega}");
        }
    }
    assert!(even > 10 && even < 50, "{even}");
    assert!(imbalance(&rows) < budget::BALANCE);
    // In the steady state the motor delivers the friction losses.
    let torques = rows.get("motor torque [N m]");
    let steady = friction + 3.0 / (10.0 * 0.9);
    near("steady", torques[50], steady, budget::CLOSED_MOTION);
    let speeds = rows.get("motor speed [rpm]");
    let last = rows.get("omega [rad/s]")[50];
    near("motor", speeds[50], last * 10.0 / RPM, budget::CLOSED_FORM);
    // The gearbox carries J·α + τ during acceleration.
    let peak = found.loads.gearbox_torque.unwrap();
    near(
        "gearbox",
        peak.value,
        2.0 * alpha + 3.0,
        budget::CLOSED_MOTION,
    );
    assert!(peak.exceeds() && found.loads.motor_speed.exceeds());
    near(
        "its column",
        rows.get("gearbox torque [N m]")[1],
        2.0 * alpha + 3.0,
        budget::CLOSED_MOTION,
    );
}

/// While the machine coasts against the motor's own friction, power flows back through the gearbox with its other efficiency; a motor that drives
/// backwards mirrors the motion.
#[test]
fn a_stop_coasts_through_the_gearbox_and_backwards_is_the_mirror() {
    let (motor, gearbox) = (motor(), gearbox());
    let drive = Drive {
        motor: &motor,
        gearbox: Some(&gearbox),
        amplifier: None,
    };
    let coast = "start_angle = \"0 deg\"\nstart_speed = \"20 rad/s\"\nstop = { time = \"0 s\" }\n";
    let file = table(0.0, 0.5, coast);
    let rows = columns(&run(&file, drive));
    // 0 = 0.004·10·α + 0.8·2·α/10 + 0.5.
    let alpha = -0.5 / (0.04 + 0.16);
    for (t, omega) in rows.get("t [s]").into_iter().zip(rows.get("omega [rad/s]")) {
        within(
            "coasts",
            omega,
            20.0 + alpha * t,
            budget::CLOSED_MOTION * 20.0,
        );
    }
    assert!(imbalance(&rows) < budget::BALANCE);
    let forwards = columns(&run(&table(3.0, 0.3, "start_angle = \"0 deg\"\n"), drive));
    let own = "start_angle = \"0 deg\"\ntorque = \"-1 N m\"\n";
    let backwards = columns(&run(&table(3.0, 0.3, own), drive));
    let pairs = forwards.get("omega [rad/s]").into_iter();
    for (forwards, backwards) in pairs.zip(backwards.get("omega [rad/s]")) {
        assert_eq!(forwards.to_bits(), (-backwards + 0.0).to_bits());
    }
}

/// The press under the controller's torque: the motor torque of each row is that of `Way` in its state, an independent equation.
#[test]
fn the_torque_of_each_row_is_that_of_the_way() {
    let text = press_text();
    let (text, _) = text.split_once("[simulation]").unwrap();
    let file = machine(&format!(
        "{text}\n[simulation]\nduration = \"0.5 s\"\noutput_step = \"5 ms\"\ncontrol = {{ speed_gain = \"0.5 N m s/rad\", position_gain = \"20 1/s\", feed_forward = \"mean-inertia\" }}\n"
    ));
    let catalogue = Catalogue::built_in().unwrap();
    let find = |motor: &str, gearbox: &str| {
        let mut drives = catalogue.drives();
        let found = drives.find(|(_, drive)| {
            drive.motor.key == motor && drive.gearbox.is_some_and(|g| g.key == gearbox)
        });
        found.unwrap().1
    };
    let drive = find("sgm7a-25a", "npt025mf-4");
    let found = run(&file, drive);
    let rows = columns(&found);
    let envelope = Envelope::at(drive.motor, drive.amplifier, &file.site);
    let ways = BothDirections::new(&file, &Actuator::new(&drive, envelope));
    let torques = rows.get("motor torque [N m]");
    let most = largest(&torques);
    let mut checked = 0;
    for ([phi, omega, alpha], torque) in found.simulated.states.iter().zip(&torques) {
        if omega.abs() < 1e-3 {
            continue;
        }
        let state = State {
            phi: *phi,
            omega: *omega,
            alpha: *alpha,
        };
        let expected = ways.torque(&state, 1.0).unwrap();
        within("torque", *torque, expected, budget::SAME_SUMS * most);
        checked += 1;
    }
    assert!(checked > 60, "{checked}");
    assert!(imbalance(&rows) < budget::BALANCE);
    assert!(found.simulated.torque_limit.is_none(), "it follows");
    let following = found.simulated.following.unwrap();
    let errors = rows.get("phi error [deg]");
    assert!(following.error.abs().to_degrees() >= largest(&errors));
    // A smaller motor reaches its limit in the stroke.
    let small = catalogue
        .drives()
        .find(|(_, drive)| drive.motor.key == "sgmsh-10a" && drive.gearbox.is_some())
        .unwrap()
        .1;
    let found = run(&file, small);
    let limit = found.simulated.torque_limit.unwrap();
    assert!(limit.duration > 0.01 && limit.count > 0, "{limit:?}");
    let error = found.simulated.following.unwrap().error;
    assert!(error.abs() > following.error.abs(), "{error}");
}

/// A motor whose winding and housing are one thermal body.
fn warm_motor() -> Motor {
    Motor {
        winding: Winding {
            commutation: Commutation::Block,
            torque_constant: Some(0.5),
            resistance: Some(0.4),
            ..Winding::default()
        },
        thermal: Thermal {
            housing_resistance: Some(0.6),
            housing_time: Some(90.0),
            max_temperature: Some(155.0),
            ..Thermal::default()
        },
        rated_torque: Some(4.0),
        ..motor()
    }
}

/// A brake stops the machine, and the motor, which is off, cools: θ falls as e^(−t/(R·C)).
#[test]
fn a_brake_does_not_heat_the_motor() {
    let motor = warm_motor();
    let drive = Drive {
        motor: &motor,
        gearbox: None,
        amplifier: None,
    };
    let text = "start_angle = \"30 deg\"\nstop = { time = \"20 s\", brake_torque = \"50 N m\" }\n[surroundings]\nambient = \"20 degC\"\n";
    let rows = columns(&run(&table(1.0, 60.0, text), drive));
    let warm = rows.get("t [s]").into_iter().zip(rows.get("motor [degC]"));
    let rises: Vec<(f64, f64)> = warm.map(|(t, motor)| (t, motor - 20.0)).collect();
    // It is at rest after three seconds; until then its own friction heats it.
    let (off, hot) = *rises.iter().find(|(t, _)| *t >= 25.0).unwrap();
    assert!(hot > 1.0, "{hot}");
    let mut cooled = 0;
    for (t, rise) in rises.into_iter().filter(|(t, _)| *t > off) {
        let expected = hot * (-(t - off) / 90.0).exp();
        within("cools", rise, expected, budget::CLOSED_MOTION * 155.0);
        cooled += 1;
    }
    assert!(cooled > 10);
}

/// A stalled motor heats up with a constant loss: C·θ′ = P·(1 + g·θ) − θ/R.
#[test]
fn a_stalled_motor_heats_up_as_the_closed_form_says() {
    let motor = warm_motor();
    let drive = Drive {
        motor: &motor,
        gearbox: None,
        amplifier: None,
    };
    let text = "start_angle = \"30 deg\"\n[surroundings]\nambient = \"30 degC\"\n";
    let found = run(&table(20.0, 60.0, text), drive);
    let rows = columns(&found);
    let copper = 0.00393;
    let hot = 1.0 + copper * (30.0 - 20.0);
    let loss = 0.4 * hot * (8.0f64 / 0.5).powi(2);
    let capacity = 90.0 / 0.6;
    let rate = (1.0 / 0.6 - loss * copper / hot) / capacity;
    for (t, motor) in rows.get("t [s]").into_iter().zip(rows.get("motor [degC]")) {
        let rise = loss / capacity / rate * (1.0 - (-rate * t).exp());
        within(
            "temperature",
            motor,
            30.0 + rise,
            budget::CLOSED_MOTION * 155.0,
        );
    }
    let heat = found.loads.heat.unwrap();
    assert!(!heat.relative);
    assert_eq!(heat.hottest.allowed, Some(125.0));
    near(
        "hottest",
        30.0 + heat.hottest.value,
        rows.get("motor [degC]")[50],
        budget::CLOSED_FORM,
    );
    // It does not start: 12 N·m plus its own friction are missing.
    let stuck = found.simulated.missing.unwrap();
    assert_eq!(stuck.time.to_bits(), 0.0f64.to_bits());
    near(
        "place",
        stuck.missing.phi.to_degrees(),
        30.0,
        budget::CLOSED_FORM,
    );
    near("given", stuck.missing.given, 8.0, budget::CLOSED_FORM);
    near("needed", stuck.missing.needed, 20.2, budget::CLOSED_FORM);
}

#[test]
fn what_cannot_be_simulated_is_refused() {
    let file = table(0.0, 1.0, "start_angle = \"0 deg\"\n");
    let simulation = file.simulation.as_ref().unwrap();
    let unknown = Motor {
        rotor_inertia: 0.001,
        rated_torque: Some(2.0),
        rated_speed: Some(300.0),
        ..Motor::default()
    };
    let of = |motor, gearbox| Drive {
        motor,
        gearbox,
        amplifier: None,
    };
    let refused = driven(
        &CoupledMachines::alone(&file),
        simulation,
        of(&unknown, None),
    )
    .unwrap_err();
    assert!(matches!(refused, UnfitDrive::NoPeak), "{refused:?}");
    let worm = Gearbox {
        back_efficiency: -0.2,
        ..gearbox()
    };
    let motor = motor();
    let refused = driven(
        &CoupledMachines::alone(&file),
        simulation,
        of(&motor, Some(&worm)),
    )
    .unwrap_err();
    let UnfitDrive::SelfLocking { gearbox } = refused else {
        panic!("{refused:?}");
    };
    assert_eq!(gearbox, "box");
}
