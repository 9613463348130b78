//! The holding brake: its factor, and the stop that it makes alone.

use jred_file::model::rule::Rule;
use jred_file::model::rules::{RuleSet, RuleVerdict};
use jred_report::list::rule_words::note;
use jred_sizing::catalogue::Brake;

use super::{Stand, near};

/// A lift of 60 kg on a belt of radius 50 mm that goes down and up with 1.2 m/s.
const LIFT: &str = r#"
gravity = { inclination = "90 deg" }
[mechanism]
type = "belt-axis"
stroke = ["0 mm", "1300 mm"]
pulley = { diameter = "100 mm", inertia = "0 kg m^2" }
carriage = { mass = "60 kg" }
[motion]
type = "cycle"
of = { point = "carriage", along = "x" }
start = "1200 mm"
[[motion.segment]]
law = "jerk-limited"
move = "-1000 mm"
max_speed = "1.2 m/s"
max_acceleration = "4 m/s^2"
max_jerk = "40 m/s^3"
[[motion.segment]]
law = "jerk-limited"
move = "1000 mm"
max_speed = "1.2 m/s"
max_acceleration = "4 m/s^2"
max_jerk = "40 m/s^3"
"#;

const RADIUS: f64 = 0.05;
const RATIO: f64 = 5.0;

fn lift(brake: Brake) -> Stand {
    let mut stand = Stand::new(LIFT);
    stand.motor.brake = Some(brake);
    stand
}

const BRAKE: Brake = Brake {
    torque: 12.0,
    inertia: 1e-4,
    dynamic_torque: Some(9.0),
    closing_time: Some(0.04),
    work: Some(400.0),
    stops_per_hour: Some(20.0),
    opening_time: None,
    power: None,
    mass: None,
};

/// The lift in explicit steps: mass m with the rotor's share, falling under its weight until the brake closes, then braked; work of the brake (J),
/// distance until it closes and until standstill (m).
fn fall(brake: &Brake, rotor: f64, speed: f64) -> [f64; 3] {
    let mass = 60.0 + rotor * (RATIO / RADIUS).powi(2);
    let force = brake.dynamic_torque.unwrap_or(brake.torque) * RATIO / RADIUS;
    let step = 1e-6;
    let (mut t, mut v, mut way, mut closed, mut work) = (0.0, speed, 0.0, 0.0, 0.0);
    while v > 0.0 {
        let braked = t >= brake.closing_time.unwrap();
        let rate = (60.0 * 9.81 - if braked { force } else { 0.0 }) / mass;
        let next = f64::max(v + rate * step, 0.0);
        let moved = 0.5 * (v + next) * step;
        way += moved;
        if braked {
            work += force * moved;
        } else {
            closed += moved;
        }
        v = next;
        t += step;
    }
    [work, closed, way]
}

#[test]
fn the_stop_of_a_lift_is_that_of_its_steps() {
    let stand = lift(BRAKE);
    let rotor = stand.motor.rotor_inertia + BRAKE.inertia + stand.gearbox.inertia;
    let [work, closed, way] = fall(&BRAKE, rotor, 1.2);
    let found = stand.found(true, Rule::BrakeWork);
    near("work", found.value, work, 1e-4);
    near("rating", found.rating, 400.0, 0.0);
    let check = stand.check(true, &RuleSet::default(), Rule::BrakeWork);
    // The drive link of a belt axis is its pulley.
    let number = |after: &str| -> f64 {
        let note = note(&check);
        let (_, rest) = note.split_once(after).expect(&note);
        rest.split(' ').next().unwrap().parse().unwrap()
    };
    near(
        "until it closes",
        number("runs on by at most "),
        (closed / RADIUS).to_degrees(),
        1e-3,
    );
    near(
        "until it stops",
        number("until the brake closes and "),
        (way / RADIUS).to_degrees(),
        1e-3,
    );
    assert!(
        note(&check).contains("the brake bears 20 such stops per hour"),
        "{}",
        note(&check)
    );
}

/// More stops per hour than the brake bears share the work of those that it bears.
#[test]
fn stops_per_hour_share_the_work() {
    for (stops, per_hour, rating) in [
        (None, Some(20.0), Some(400.0)),
        (Some(5.0), Some(20.0), Some(400.0)),
        (Some(20.0), Some(20.0), Some(400.0)),
        (Some(50.0), Some(20.0), Some(160.0)),
        (Some(5.0), None, None),
        (None, None, Some(400.0)),
    ] {
        let mut stand = lift(Brake {
            stops_per_hour: per_hour,
            ..BRAKE
        });
        stand.file.site.emergency_stops = stops;
        let found = stand.found(true, Rule::BrakeWork);
        assert_eq!(Some(found.rating).filter(|r| !r.is_nan()), rating);
        let check = stand.check(true, &RuleSet::default(), Rule::BrakeWork);
        match rating {
            Some(_) => assert_ne!(check.verdict, RuleVerdict::NotChecked),
            None => assert!(
                note(&check).contains("brake_stops in the catalogue"),
                "{}",
                note(&check)
            ),
        }
    }
    let text = format!("{LIFT}\n[duty]\nemergency_stops = 50\n");
    let file = Stand::new(&text).file;
    assert_eq!(file.site.emergency_stops, Some(50.0));
    // Without a type the machine runs as before.
    assert_eq!(file.site.duty, Stand::new(LIFT).file.site.duty);
}

/// A brake with a slip torque below the weight never stops it.
#[test]
fn a_brake_below_the_weight_takes_work_without_end() {
    let weight = 60.0 * 9.81 * RADIUS / RATIO;
    let weak = Brake {
        dynamic_torque: Some(0.99 * weight),
        ..BRAKE
    };
    let check = lift(weak).check(true, &RuleSet::default(), Rule::BrakeWork);
    assert_eq!(check.verdict, RuleVerdict::Fail);
    assert!(note(&check).contains("without end"), "{}", note(&check));
}

/// Its torque is judged with a factor of 1.5.
#[test]
fn a_brake_holds_with_a_factor() {
    let weight = 60.0 * 9.81 * RADIUS / RATIO;
    for (factor, verdict) in [(1.51, RuleVerdict::Pass), (1.49, RuleVerdict::Fail)] {
        let brake = Brake {
            torque: factor * weight,
            ..BRAKE
        };
        let check = lift(brake).check(true, &RuleSet::default(), Rule::BrakeTorque);
        assert_eq!(check.verdict, verdict, "{factor}");
    }
}

/// Missing data are named; a brake that need not hold anything is judged where it has data.
#[test]
fn missing_figures_of_a_brake_are_named() {
    let rules = RuleSet::default();
    for (closing_time, work, column) in [
        (None, Some(400.0), "brake_closing_time"),
        (Some(0.04), None, "brake_work"),
    ] {
        let brake = Brake {
            closing_time,
            work,
            ..BRAKE
        };
        let check = lift(brake).check(true, &rules, Rule::BrakeWork);
        assert_eq!(check.verdict, RuleVerdict::NotChecked);
        assert!(note(&check).contains(column), "{}", note(&check));
    }
    let flat = LIFT.replace("90 deg", "0 deg");
    let mut stand = Stand::new(&flat);
    stand.brake(12.0);
    assert!(stand.finding(true, &rules, Rule::BrakeWork).is_none());
    stand.motor.brake = Some(BRAKE);
    assert!(stand.finding(true, &rules, Rule::BrakeWork).is_some());
}

/// A crank whose inertia and weight change as it turns: from any state no stop takes more work.
#[test]
fn no_stop_of_a_crank_takes_more_work() {
    let mut stand = Stand::new(
        r#"
gravity = ["-9.81 m/s^2", "0 m/s^2"]
[mechanism]
type = "slider-crank"
crank = { length = "60 mm", mass = "4 kg", inertia = "0.02 kg m^2" }
rod = { length = "200 mm", mass = "3 kg", inertia = "0.01 kg m^2", com = ["80 mm", "0 mm"] }
slider = { mass = "25 kg" }
[motion]
type = "constant-speed"
speed = "90 rpm"
"#,
    );
    let brake = Brake {
        dynamic_torque: Some(30.0),
        closing_time: Some(0.05),
        ..BRAKE
    };
    stand.motor.brake = Some(brake);
    let found = stand.found(false, Rule::BrakeWork).value;
    let rotor = stand.motor.rotor_inertia + brake.inertia;
    let mut most = 0.0f64;
    for start in stand.duty.instants.iter().step_by(100) {
        let (mut t, mut phi, mut omega, mut work) = (0.0, start.phi, start.omega, 0.0);
        let step = 1e-4;
        while omega > 0.0 {
            let torque = if t >= 0.05 { 30.0 } else { 0.0 };
            let at = stand.file.bare_reduction(phi).unwrap();
            let load = at.potential_slope + 0.5 * at.inertia_slope * omega * omega;
            let rate = -(torque + load) / (at.inertia + rotor);
            let next = f64::max(omega + rate * step, 0.0);
            let moved = 0.5 * (omega + next) * step;
            work += torque * moved;
            (t, phi, omega) = (t + step, phi + moved, next);
        }
        most = most.max(work);
    }
    assert!(most <= found * 1.001, "{most} > {found}");
    assert!(most > 0.3 * found, "{most} of {found}");
}

/// The motor brakes the lift with half of its peak torque, 15 N m, as a brake that closes at once: the bus takes its work. With a torque that does not
/// hold the weight, the voltage has no bound.
#[test]
fn the_drive_stops_the_lift() {
    let text = format!(
        r#"{LIFT}
[supply]
bus_voltage = "560 V"
capacitance = "470 uF"
chopper_voltage = "780 V"
max_voltage = "820 V"
min_resistance = "20 Ohm"
brake_resistor = {{ resistance = "47 Ohm", power = "500 W", peak_power = "10 kW", pulse_energy = "5 kW s" }}
[duty]
drive_stop = "50 %"
"#
    );
    let stand = Stand::new(&text);
    let (drive, limits) = (stand.drive(true), stand.prepared());
    let (c, share) = (drive.coefficients(), stand.file.site.drive_stop);
    let power = |share| jred_sizing::bus::stop(&stand.cycle, &c, RATIO, &limits, share);
    let brake = Brake {
        torque: 15.0,
        dynamic_torque: None,
        closing_time: Some(0.0),
        ..BRAKE
    };
    let rotor = stand.motor.rotor_inertia + stand.gearbox.inertia;
    let [work, _, _] = fall(&brake, rotor, 1.2);
    let stop = power(share);
    near("work", stop.energy, work, 1e-4);
    let peak = 15.0 * RATIO * 1.2 / RADIUS;
    near("power", stop.peak, peak, 1e-4);
    // The cycle lowers 60 kg by 1 m: its pulse is larger, its power smaller.
    near(
        "peak",
        stand.found(true, Rule::ResistorPeak).value,
        peak,
        1e-4,
    );
    let pulse = stand.found(true, Rule::ResistorPulse).value;
    assert!(pulse > 1.5 * work, "{pulse} {work}");
    assert!(power(Some(0.1)).energy.is_infinite());
    assert!(
        note(&stand.check(true, &RuleSet::default(), Rule::BusVoltage))
            .contains("in a stop by the drive")
    );
    let mut weak = stand;
    weak.file.site.drive_stop = Some(0.1);
    assert!(weak.found(true, Rule::BusVoltage).value.is_infinite());
}
