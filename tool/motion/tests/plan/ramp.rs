//! The shortest ramp of the rate, against a search over all positions and rates with an independent torque.

use std::collections::BTreeMap;

use jred_analysis::checked;
use jred_file::model::machine::MachineFile;
use jred_motion::fastest::field::Reserve;
use jred_motion::fastest::{MoveLimits, Task, solve};
use jred_motion::path_dynamics::Actuator;
use jred_motion::plan::ramp::least_ramp;
use jred_motion::trace::Trace;

use crate::fastest::motor;
use crate::support::press_text;

fn planned(file: &MachineFile, motor: &Actuator, dynamics: [f64; 2], reserve: f64) -> Trace {
    let reserve = Reserve::of_motor(reserve);
    let task = Task {
        from: dynamics[0],
        to: dynamics[1],
        speeds: [0.0; 2],
        limits: MoveLimits::default().with_reserve(reserve),
        endless: false,
    };
    solve(file, motor, &task)
        .unwrap_or_else(|why| panic!("{why}"))
        .trace
}

/// The largest torque, as a share of the motor's at its speed, over all positions and rates, for a rate that changes within `ramp`. The torque is J·a
/// + ½·J′·v² + F + b·v + C on the drive link, without a drive train.
fn used(file: &MachineFile, [rest, top, end]: [f64; 3], trace: &Trace, ramp: f64) -> f64 {
    let mut most = 0.0_f64;
    for pair in trace.nodes().windows(2) {
        for share in [0.0, 0.1, 0.35, 0.5, 0.65, 0.9, 1.0] {
            let state = pair[1].after(&pair[0], share);
            if state.omega == 0.0 {
                continue;
            }
            let point = file.bare_reduction(state.phi).unwrap();
            let side = state.omega.signum();
            for n in 1..=200 {
                let rate = f64::from(n) / 200.0;
                let speed = rate * state.omega;
                for change in [-1.0 / ramp, 1.0 / ramp] {
                    let acceleration = rate * rate * state.alpha + change * state.omega;
                    let torque = point.inertia * acceleration
                        + 0.5 * point.inertia_slope * speed * speed
                        - point.load_torque()
                        + point.viscous * speed
                        + point.coulomb * side;
                    let has = rest + (top - rest) * speed.abs() / end;
                    most = most.max(torque.abs() / has);
                }
            }
        }
    }
    most
}

/// The shortest ramp satisfies the torque limit everywhere; one shorter by a hundredth does not.
#[test]
fn the_least_ramp_is_the_least() {
    let table = "title = \"table\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\n[mechanism.table]\nmass = \"1 kg\"\ninertia = \"0.5 kg m^2\"\n[[load]]\nname = \"seal\"\non = \"table\"\nopposing_moment = \"2 N m\"\n[[load]]\nname = \"oil\"\non = \"table\"\nviscous_moment = \"0.2 N m s/rad\"\n";
    let table = checked::parse("test.toml", table, BTreeMap::<String, String>::new()).unwrap();
    let mut inside = false;
    let press: Vec<String> = press_text()
        .lines()
        .filter(|line| {
            if line.starts_with('[') {
                inside = line.starts_with("[[drive_train]]");
            }
            !inside
        })
        .map(str::to_owned)
        .collect();
    let none = BTreeMap::<String, String>::new();
    let press = checked::parse("press.toml", &press.join("\n"), none).unwrap();
    for (file, torques, speed, dynamics) in [
        (&table, [20.0, 8.0], 40.0, [0.0, 9.0]),
        (&press, [900.0, 400.0], 12.0, [3.3, 9.0]),
    ] {
        let motor = motor(torques, speed);
        for reserve in [0.1, 0.3] {
            let trace = planned(file, &motor, dynamics, reserve);
            let ramp = least_ramp(file, &motor, None, &trace).unwrap().unwrap();
            assert!(ramp.is_finite() && ramp > 0.0, "{ramp}");
            let line = [torques[0], torques[1], speed];
            let most = used(file, line, &trace, ramp);
            assert!(most <= 1.0 + 1e-9, "{reserve}: {most}");
            let shorter = used(file, line, &trace, 0.99 * ramp);
            assert!(shorter > 1.0, "{reserve}: {shorter}");
        }
        // A motion that uses the full torque leaves nothing for a change of the rate.
        let whole = planned(file, &motor, dynamics, 0.0);
        assert_eq!(
            least_ramp(file, &motor, None, &whole).unwrap(),
            Some(f64::INFINITY)
        );
    }
}

/// With constant inertia, no friction and the share 1 − s of the torque T: at full rate ω/R ≤ s·T/J, and ω is largest in the middle, at the end of
/// the acceleration: R = ω·J/(s·T).
#[test]
fn the_ramp_of_a_constant_inertia() {
    let table = "title = \"table\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\n[mechanism.table]\nmass = \"1 kg\"\ninertia = \"0.5 kg m^2\"\n";
    let file = checked::parse("test.toml", table, BTreeMap::<String, String>::new()).unwrap();
    let (torque, inertia, dynamics) = (20.0, 0.5, 8.0);
    let motor = motor([torque; 2], 100.0);
    for share in [0.1, 0.25] {
        let trace = planned(&file, &motor, [0.0, dynamics], share);
        let found = least_ramp(&file, &motor, None, &trace).unwrap().unwrap();
        let speed = ((1.0 - share) * torque / inertia * dynamics).sqrt();
        let expected = speed * inertia / (share * torque);
        assert!((found / expected - 1.0).abs() < 1e-4, "{found} {expected}");
    }
}
