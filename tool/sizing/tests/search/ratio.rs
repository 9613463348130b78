//! Gear ratios in closed form, against golden section, by hand, and against the catalogue search.

use super::{RACK, case, catalogue};
use crate::support::{budget, near, press_text};
use jred_analysis::duty::Instant;
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleVerdict;
use jred_sizing::catalogue::Drive;
use jred_sizing::catalogue::{Catalogue, Gearbox, Motor};
use jred_sizing::cycle::form::{Coefficients, loads};
use jred_sizing::judge::Context;
use jred_sizing::select::ratio::ranges::Trial;
use jred_sizing::select::ratio::{Gear, Moments, accelerating_factor};

const CONVEYOR: &str = include_str!("../../../../machines/conveyor.toml");
const HOIST: &str = include_str!("../../../../machines/hoist.toml");
const SCREW: &str = include_str!("../../../../machines/ball-screw.toml");

/// The drive of a motor and a gear of some ratio, built as in the tool.
fn coefficients(motor: &Motor, gear: Gear, ratio: f64) -> Coefficients {
    let gearbox = Gearbox {
        ratio,
        inertia: gear.inertia,
        efficiency: gear.efficiency,
        back_efficiency: gear.efficiency,
        ..Gearbox::default()
    };
    Drive {
        motor,
        gearbox: Some(&gearbox),
        amplifier: None,
    }
    .coefficients()
}

/// The least value of a function with one minimum, by golden section over ln x.
fn golden(f: impl Fn(f64) -> f64, low: f64, high: f64) -> f64 {
    let g = 0.5 * (5.0f64.sqrt() - 1.0);
    let (mut a, mut b) = (low.ln(), high.ln());
    for _ in 0..200 {
        let (c, d) = (b - g * (b - a), a + g * (b - a));
        if f(c.exp()) < f(d.exp()) {
            b = d;
        } else {
            a = c;
        }
    }
    a.midpoint(b).exp()
}

pub(super) const GEARS: [Gear; 2] = [
    Gear::IDEAL,
    Gear {
        inertia: 4e-5,
        efficiency: 0.92,
    },
];

/// Motors of the catalogue, and one with friction of both kinds.
fn motors() -> Vec<Motor> {
    let mut motors = catalogue().motors;
    let mut rough = motors[10].clone();
    rough.friction = [0.4, 2e-3];
    motors.push(rough);
    motors
}

/// T_rms from the moments equals that from the instants, and i* is the ratio of its minimum.
#[test]
fn best_ratio_by_golden_section() {
    for text in [press_text().as_str(), RACK, SCREW] {
        let case = case(text, 400);
        for motor in motors() {
            for gear in GEARS {
                let moments = Moments::new(&case.duty, &motor, gear);
                let direct = |ratio: f64| {
                    let coefficients = coefficients(&motor, gear, ratio);
                    let torque = |i: &Instant| coefficients.torque(&loads(i));
                    case.duty.figures(torque).rms
                };
                let best = moments.best_ratio().unwrap();
                for ratio in [0.1 * best, 0.7 * best, best, 3.0 * best, 20.0 * best] {
                    near(
                        &motor.key,
                        moments.rms_torque(ratio),
                        direct(ratio),
                        budget::MOMENTS,
                    );
                }
                let found = golden(|i| moments.rms_torque(i), best / 50.0, best * 50.0);
                near(&motor.key, found, best, budget::BEST_RATIO);
                assert!(
                    direct(best) <= direct(best * 1.001) && direct(best) <= direct(best * 0.999),
                    "{}",
                    motor.key
                );
                // The load factor is the motor's requirement at i*.
                let least = moments.rms_torque(best);
                near(
                    "beta",
                    moments.load_factor().unwrap(),
                    least * least / moments.inertia,
                    budget::MOMENTS,
                );
            }
        }
    }
}

/// By hand: a pure inertia J_L gives i* = √(J_L/J_M), T_rms = 2·√(J_L·J_M)·a_rms, β = 4·J_L·a_rms².
#[test]
fn a_pure_inertia() {
    let text = RACK.replacen("opposing_force = \"110 N\"", "opposing_force = \"0 N\"", 1);
    let case = case(&text, 400);
    let motor = &catalogue().motors[5];
    let moments = Moments::new(&case.duty, motor, Gear::IDEAL);
    let load = case.cycle.inertia().max;
    let acceleration = case.duty.figures(|i| i.input_alpha).rms;
    let best = moments.best_ratio().unwrap();
    near(
        "i*",
        best,
        (load / motor.rotor_inertia).sqrt(),
        budget::RATIO_END,
    );
    near(
        "T_rms",
        moments.rms_torque(best),
        2.0 * (load * motor.rotor_inertia).sqrt() * acceleration,
        budget::RATIO_END,
    );
    near(
        "beta",
        moments.load_factor().unwrap(),
        4.0 * load * acceleration * acceleration,
        budget::RATIO_END,
    );
}

/// Without acceleration every larger ratio is suitable; without load at the output every smaller one. The torque at the other end is the limit, and
/// exceeds it beyond.
#[test]
fn without_a_best_ratio_the_range_is_open() {
    let mut motor = catalogue().motors[5].clone();
    let limit = 0.8 * motor.rated_torque.unwrap();
    for coulomb in [0.0, 0.4 * limit] {
        motor.friction = [coulomb, 0.0];
        let steady = case(CONVEYOR, 200);
        let moments = Moments::new(&steady.duty, &motor, Gear::IDEAL);
        let [from, to] = moments.range(limit).unwrap();
        assert_eq!((moments.best_ratio(), to), (None, f64::INFINITY));
        near("from", moments.rms_torque(from), limit, budget::RATIO_END);
        assert!(moments.rms_torque(1.01 * from) < limit);
        assert_eq!(moments.range(0.9 * coulomb), None);

        let mut unloaded = case(RACK, 200);
        for instant in &mut unloaded.duty.instants {
            instant.input_torque = 0.0;
        }
        let moments = Moments::new(&unloaded.duty, &motor, Gear::IDEAL);
        let [from, to] = moments.range(limit).unwrap();
        assert_eq!((moments.best_ratio(), from), (None, 0.0));
        near("to", moments.rms_torque(to), limit, budget::RATIO_END);
        assert!(moments.rms_torque(0.99 * to) < limit);
    }
}

/// A motor with a constant S1 torque.
fn flat(motor: &Motor) -> Motor {
    Motor {
        standstill_torque: motor.rated_torque,
        rated_speed: Some(1e5),
        max_speed: Some(1e5),
        max_power: None,
        continuous_curve: Vec::new(),
        peak_curve: Vec::new(),
        ..motor.clone()
    }
}

/// Every ratio of a catalogue that satisfies the RMS rule is inside the closed-form range, every other outside; there is a range exactly for
/// accelerating factors above the load factor.
#[test]
fn the_range_in_closed_form_is_that_of_the_catalogue_search() {
    let (mut inside, mut outside, mut hopeless) = (0, 0, 0);
    for text in [press_text().as_str(), RACK, SCREW] {
        let case = case(text, 200);
        for motor in motors() {
            let motor = flat(&motor);
            for gear in GEARS {
                let ratios = (0..80).map(|k| 0.3 * 1.08f64.powi(k));
                let gearbox = |ratio| Gearbox {
                    key: format!("i{ratio}"),
                    ratio,
                    inertia: gear.inertia,
                    efficiency: gear.efficiency,
                    back_efficiency: gear.efficiency,
                    ..Gearbox::default()
                };
                let gearboxes: Vec<Gearbox> = ratios.map(gearbox).collect();
                let catalogue = Catalogue {
                    motors: vec![motor.clone()],
                    gearboxes,
                    ..Catalogue::default()
                };
                let prepared = catalogue.prepare(&case.file.site);
                let moments = Moments::new(&case.duty, &motor, gear);
                let limit = 0.8 * motor.rated_torque.unwrap();
                let range = moments.range(limit);
                let factor = accelerating_factor(limit, moments.inertia);
                assert_eq!(
                    range.is_some(),
                    factor >= moments.load_factor().unwrap(),
                    "{}",
                    motor.key
                );
                hopeless += usize::from(range.is_none());
                for (id, drive) in catalogue.drives() {
                    if drive.gearbox.is_none() {
                        continue;
                    }
                    let context =
                        Context::new(&case.cycle, &case.file.site, drive, &prepared[id.motor()]);
                    let rules = &case.file.rules;
                    let finding = context.findings(rules).get(Rule::RmsTorque).unwrap();
                    let holds = rules.verdict(Rule::RmsTorque, finding) != RuleVerdict::Fail;
                    let within =
                        range.is_some_and(|[from, to]| (from..=to).contains(&drive.ratio()));
                    assert_eq!(
                        holds,
                        within,
                        "{} at {}: {range:?}",
                        motor.key,
                        drive.ratio()
                    );
                    inside += usize::from(holds);
                    outside += usize::from(!holds);
                }
            }
        }
    }
    assert!(
        inside > 500 && outside > 500 && hopeless > 5,
        "{inside} inside, {outside} outside, {hopeless} too small"
    );
}

/// The range of all rules: catalogue drives inside satisfy every rule of the motor, those outside violate one, and just beyond each end the named
/// rule is violated.
#[test]
fn ranges_of_all_rules() {
    let case = case(&press_text(), 200);
    let catalogue = catalogue();
    let prepared = catalogue.prepare(&case.file.site);
    let rules = &case.file.rules;
    let mut ends = 0;
    for (motor, limits) in catalogue.motors.iter().zip(&prepared) {
        let trial = Trial {
            cycle: &case.cycle,
            site: &case.file.site,
            rules,
            motor,
            prepared: limits,
            gear: GEARS[1],
        };
        let best = Moments::new(&case.duty, motor, GEARS[1]).best_ratio();
        let ranges = trial.ranges(best);
        for found in &ranges {
            let [from, to] = found.range;
            if let Some(rule) = found.below {
                assert_eq!(
                    trial.broken(from * (1.0 - 1e-6)),
                    Some(rule),
                    "{}",
                    motor.key
                );
                assert_eq!(trial.broken(from * (1.0 + 1e-6)), None, "{}", motor.key);
                ends += 1;
            }
            if let Some(rule) = found.above {
                assert_eq!(trial.broken(to * (1.0 + 1e-6)), Some(rule), "{}", motor.key);
                ends += 1;
                if rule == Rule::Speed {
                    // By hand: 90 % of the largest speed.
                    let expected = 0.9 * limits.envelope.max_speed() / case.cycle.peak_speed();
                    near(&motor.key, to, expected, budget::RATIO_END);
                }
            }
        }
        for k in 0..60 {
            let ratio = 0.3 * 1.09f64.powi(k);
            let inside = ranges
                .iter()
                .any(|found| (found.range[0]..=found.range[1]).contains(&ratio));
            assert_eq!(
                trial.broken(ratio).is_none(),
                inside,
                "{} at {ratio}: {ranges:?}",
                motor.key
            );
        }
    }
    assert!(ends > 20, "only {ends} ends");
}

/// A motor with a gear has the torque and the speed of a drive with a gearbox of these figures, in both directions of power: a load that drives also
/// keeps the share 1 : η.
#[test]
fn a_trial_is_the_drive_of_a_gearbox_with_these_figures() {
    // When lowered, the load drives the motor.
    let case = case(HOIST, 200);
    let catalogue = catalogue();
    let prepared = catalogue.prepare(&case.file.site);
    for gear in GEARS {
        for (motor, limits) in catalogue.motors.iter().zip(&prepared).step_by(7) {
            let trial = Trial {
                cycle: &case.cycle,
                site: &case.file.site,
                rules: &case.file.rules,
                motor,
                prepared: limits,
                gear,
            };
            for ratio in [3.0, 40.0] {
                let form = coefficients(motor, gear, ratio);
                let found = |rule| trial.findings(ratio).get(rule).unwrap().value;
                let torque = |i: &Instant| form.torque(&loads(i));
                let exact = case.duty.figures(torque).rms;
                near(&motor.key, found(Rule::RmsTorque), exact, budget::MOMENTS);
                let fastest = case.cycle.peak_speed() * ratio;
                near(&motor.key, found(Rule::Speed), fastest, 1e-12);
            }
        }
    }
}
