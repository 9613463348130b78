//! Cases without a motion, and motions past positions that the motor cannot hold.

use std::convert::Infallible;

use jred_file::number::numerics::least;
use jred_motion::fastest::{Binding, MoveLimits, NoMotion, Task, solve};
use jred_sizing::catalogue::Motor;
use jred_sizing::motor::envelope::Envelope;

use super::{close, fastest, machine, motor, table, task};

/// An upright slider-crank: a pendulum of its slider, with dead centres at the top and at the bottom.
fn upright() -> jred_file::model::machine::MachineFile {
    machine(
        "title = \"upright\"\ngravity = [\"-10 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"slider-crank\"\nflywheel = \"1 kg m^2\"\n\
         [mechanism.crank]\nlength = \"100 mm\"\nmass = \"1 kg\"\ninertia = \"0.01 kg m^2\"\n[mechanism.rod]\nlength = \"400 mm\"\nmass = \"1 kg\"\ninertia = \"0.01 kg m^2\"\n[mechanism.slider]\nmass = \"50 kg\"\n",
    )
}

/// Position of the weight's largest torque on the way up, from π to 2π, and that torque.
fn steepest() -> (f64, f64) {
    let file = upright();
    let torque = |phi: f64| file.bare_reduction(phi).unwrap().load_torque();
    let found = least(|phi| Ok::<_, Infallible>(torque(phi)), 3.2, 6.2);
    let Ok(phi) = found;
    (phi, -torque(phi))
}

#[test]
fn a_machine_that_cannot_start_says_what_is_missing() {
    let (phi, needed) = steepest();
    let found = solve(
        &upright(),
        &motor([0.9 * needed; 2], 100.0),
        &task(phi, phi + 1.0),
    );
    let Err(NoMotion::Stops {
        phi: at,
        at_start: true,
        limit: Binding::Driving,
        torques: [asked, given],
        ..
    }) = found
    else {
        panic!("{found:?}")
    };
    close(at, phi, 1e-8);
    close(asked, needed, 1e-8);
    close(given, 0.9 * needed, 1e-12);
}

/// Half of the weight's largest torque starts the machine at the bottom and lifts it until the work is used up: T·x = ΔU.
#[test]
fn a_machine_that_stops_on_the_way_says_where() {
    let file = upright();
    let (_, needed) = steepest();
    let torque = 0.5 * needed;
    let potential = |phi: f64| file.machine.bare_reduction(phi).unwrap().potential_energy;
    let start = std::f64::consts::PI;
    let left = |phi: f64| torque * (phi - start) - (potential(phi) - potential(start));
    let (mut low, mut high) = (start + 0.5, start + 2.5);
    assert!(left(low) > 0.0 && left(high) < 0.0);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if left(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    let found = solve(&file, &motor([torque; 2], 100.0), &task(start, start + 3.0));
    let Err(NoMotion::Stops {
        phi,
        at_start: false,
        ..
    }) = found
    else {
        panic!("{found:?}")
    };
    close(phi, low, 1e-8);
}

/// The same with an initial speed passes the position at which the motor could not hold.
#[test]
fn kinetic_energy_carries_over_a_place_that_cannot_be_held() {
    let (_, needed) = steepest();
    let start = std::f64::consts::PI;
    let end = start + 3.0;
    let asked = Task {
        speeds: [8.0, 0.0],
        ..task(start, end)
    };
    let found = fastest(&upright(), &motor([0.5 * needed; 2], 100.0), &asked);
    let limits: Vec<Binding> = found.phases.iter().map(|phase| phase.limit).collect();
    assert_eq!(limits, [Binding::Driving, Binding::Braking]);
}

/// A limit that prevents the kinetic energy for passing is named instead of the motor.
#[test]
fn what_keeps_the_machine_slow_is_named() {
    let (_, needed) = steepest();
    let start = std::f64::consts::PI;
    let asked = Task {
        speeds: [8.0, 0.0],
        ..task(start, start + 3.0)
    };
    let with = |limits: MoveLimits| {
        let asked = Task { limits, ..asked };
        solve(&upright(), &motor([0.5 * needed; 2], 100.0), &asked)
    };
    assert!(with(MoveLimits::default()).is_ok());
    // From 8 rad/s it passes; from rest no limit is the obstacle.
    let slow = MoveLimits {
        acceleration: Some(1e-3),
        ..MoveLimits::default()
    };
    let from_rest = Task {
        limits: slow,
        ..task(start, start + 3.0)
    };
    let motor_alone = solve(&upright(), &motor([0.5 * needed; 2], 100.0), &from_rest);
    assert!(
        matches!(motor_alone, Err(NoMotion::Stops { eased: None, .. })),
        "{motor_alone:?}"
    );
    // With a motor that passes from rest a limit is the obstacle.
    for (limits, named) in [
        (slow, Binding::Acceleration),
        (
            MoveLimits {
                speed: Some(0.5),
                ..MoveLimits::default()
            },
            Binding::Speed,
        ),
    ] {
        let asked = Task {
            limits,
            ..task(start, start + 3.0)
        };
        let found = solve(&upright(), &motor([0.9 * needed; 2], 100.0), &asked);
        let Err(why @ NoMotion::Stops { eased, .. }) = found else {
            panic!("{found:?}")
        };
        assert_eq!(eased, Some(named), "{why}");
        assert!(why.to_string().contains(named.name()), "{why}");
    }
}

/// On the steepest descent a weak brake cannot stop.
#[test]
fn a_load_that_runs_away_is_named() {
    let (phi, needed) = steepest();
    let found = solve(
        &upright(),
        &motor([0.9 * needed; 2], 100.0),
        &task(phi + 1.0, phi),
    );
    let Err(NoMotion::RunsAway {
        at_end: true,
        limit: Binding::Braking,
        torques: [asked, given],
        ..
    }) = found
    else {
        panic!("{found:?}")
    };
    close(asked, -needed, 1e-8);
    close(given, -0.9 * needed, 1e-12);
}

#[test]
fn speeds_that_the_way_does_not_allow_are_named_with_the_largest_one() {
    let file = table(2.0, "");
    let with = |speeds: [f64; 2]| Task {
        speeds,
        ..task(0.0, 1.0)
    };
    let motor = motor([10.0; 2], 50.0);
    let found = solve(&file, &motor, &with([4.0, 0.0]));
    let Err(NoMotion::StartTooFast { most, .. }) = found else {
        panic!("{found:?}")
    };
    close(most, 10f64.sqrt(), 1e-9);
    let found = solve(&file, &motor, &with([0.0, 4.0]));
    let Err(NoMotion::EndTooFast { most, .. }) = found else {
        panic!("{found:?}")
    };
    close(most, 10f64.sqrt(), 1e-9);
    assert!(matches!(
        solve(&file, &motor, &task(1.0, 1.0)),
        Err(NoMotion::NoWay)
    ));
    assert!(matches!(
        solve(&file, &motor, &task(0.0, f64::NAN)),
        Err(NoMotion::NoWay)
    ));
}

/// Friction brakes harder than the permitted deceleration when the motor has no more torque.
#[test]
fn limits_that_leave_no_acceleration_are_named() {
    let file = table(
        2.0,
        "[[load]]\non = \"table\"\nopposing_moment = \"2 N m\"\n",
    );
    let limits = MoveLimits {
        deceleration: Some(0.5),
        ..MoveLimits::default()
    };
    let asked = Task {
        limits,
        ..task(0.0, 1.0)
    };
    let found = solve(&file, &motor([1.5, 1.5], 50.0), &asked);
    assert!(
        matches!(found, Err(NoMotion::Stops { at_start: true, .. })),
        "{found:?}"
    );
    let limits = MoveLimits {
        gearbox_torque: Some(3.0),
        ..MoveLimits::default()
    };
    let asked = Task {
        limits,
        ..task(0.0, 1.0)
    };
    let found = fastest(&file, &motor([10.0; 2], 50.0), &asked);
    // 0.5 rad/s² up, 2.5 rad/s² down.
    let top = (2.0f64 / (1.0 / 0.5 + 1.0 / 2.5)).sqrt();
    close(found.time, top / 0.5 + top / 2.5, 1e-10);
    assert!(
        found
            .phases
            .iter()
            .all(|phase| phase.limit == Binding::GearboxTorque)
    );
}

#[test]
fn a_motor_without_a_known_peak_is_refused() {
    let unknown = jred_motion::path_dynamics::Actuator {
        envelope: Envelope::of(&Motor::default()),
        ..motor([1.0; 2], 1.0)
    };
    let found = solve(&table(2.0, ""), &unknown, &task(0.0, 1.0));
    assert!(
        matches!(found, Err(NoMotion::NoTorqueLimit(_))),
        "{found:?}"
    );
}

/// Viscous friction that is very large for the inertia: its time constant is a 10⁷th of the motion's time, and the motion is refused after some
/// steps, without a search of minutes.
#[test]
fn a_stiff_machine_is_refused() {
    let file = table(
        1.0,
        "[[load]]\non = \"table\"\nviscous_moment = \"1e7 N m s/rad\"\n",
    );
    let why = solve(&file, &motor([60.0; 2], 100.0), &task(0.0, 6.0)).unwrap_err();
    assert!(matches!(why, NoMotion::Stiff { .. }), "{why}");
    assert!(why.cure().contains("viscous loads"), "{}", why.cure());
}
