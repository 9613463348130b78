//! Drives against the duty: brute force, limits of the motor, ranking.

use jred_sizing::catalogue::Motor;
use jred_sizing::check::Verdict;
use jred_sizing::drive::{Drive, Judged};
use jred_sizing::envelope::Envelope;
use jred_sizing::rules::Rules;
use jred_sizing::size::Selection;

use super::support::{budget, near, press_text, within};
use super::{RPM, catalogue, duty_of, read};

/// Every figure of every drive, computed once more from the instants in the plainest way.
#[test]
fn every_drive_by_brute_force() {
    let catalogue = catalogue();
    let file = read(&press_text());
    let duty = duty_of(&file, 400);
    let cycle = 0.5;
    let selection = Selection::new(&catalogue, &duty, &Rules::default());
    for judged in selection.fit.iter().chain(&selection.refused) {
        let motor = judged.drive.motor;
        let (mut squares, mut mean, mut back, mut forth, mut turns) = (0.0, 0.0, 0.0, 0.0, 0.0);
        let (mut least, mut most, mut fastest) = (f64::MAX, f64::MIN, 0.0f64);
        let (mut lambda_least, mut lambda_most, mut lambda_mean) = (f64::MAX, 0.0f64, 0.0);
        for instant in &duty.instants {
            let (load, speed) = (instant.input_torque, instant.input_speed);
            // Power first, torque from it: what the motor gives is what the load takes, the loss, and what the rotor
            // and the gearbox store.
            let (torque, motor_speed, lambda) = match judged.drive.gearbox {
                None => (
                    load + motor.rotor_inertia * instant.input_alpha,
                    speed,
                    instant.input_inertia / motor.rotor_inertia,
                ),
                Some(g) => {
                    let through = if load * speed >= 0.0 {
                        load / g.ratio / g.efficiency
                    } else {
                        load / g.ratio * g.efficiency
                    };
                    let turning = motor.rotor_inertia + g.inertia;
                    (
                        through + turning * g.ratio * instant.input_alpha,
                        speed * g.ratio,
                        (instant.input_inertia / g.ratio / g.ratio + g.inertia)
                            / motor.rotor_inertia,
                    )
                }
            };
            let weight = instant.weight;
            squares += weight * torque * torque;
            mean += weight * torque;
            let power = torque * motor_speed;
            if power < 0.0 {
                back -= weight * power;
            } else {
                forth += weight * power;
            }
            turns += weight * motor_speed.abs();
            (least, most) = (least.min(torque), most.max(torque));
            fastest = fastest.max(motor_speed.abs());
            (lambda_least, lambda_most) = (lambda_least.min(lambda), lambda_most.max(lambda));
            lambda_mean += weight * lambda / cycle;
        }
        let found = &judged.duty;
        let name = judged.drive.name();
        let rms = (squares / cycle).sqrt();
        let same = |what: &str, found: f64, expected: f64, scale: f64| {
            within(
                &format!("{name}: {what}"),
                found,
                expected,
                budget::SAME_SUMS * scale,
            );
        };
        same("RMS", found.torque.rms, rms, rms);
        same("mean", found.torque.mean, mean / cycle, rms);
        same("least", found.torque.min, least, rms);
        same("most", found.torque.max, most, rms);
        same("fastest", found.speed.peak(), fastest, fastest);
        same("mean speed", found.mean_speed, turns / cycle, fastest);
        same("regenerative", found.regenerative_energy, back, forth);
        same("motoring", found.motoring_energy, forth, forth);
        same(
            "mean power",
            found.power.mean,
            (forth - back) / cycle,
            forth,
        );
        let lambda = found.inertia_ratio;
        same("λ", lambda.min, lambda_least, lambda_most);
        same("λ", lambda.mean, lambda_mean, lambda_most);
        same("λ", lambda.max, lambda_most, lambda_most);
        // A loss is never a gain: what the motor gives net is at least what the machine takes at its input.
        let taken = duty.integral(|i| i.input_torque * i.input_speed);
        assert!(forth - back >= taken * (1.0 - 1e-6), "{name}");
        let rules = judged.checks.len();
        // With two cycles a second, the warning about T2B is among those of a gearbox.
        assert_eq!(
            rules,
            if judged.drive.gearbox.is_some() {
                10
            } else {
                5
            }
        );
    }
}

/// Twice the ratio: half the torque, twice the speed, a quarter of the inertia (lossless and without inertia).
#[test]
fn scaling_with_the_ratio() {
    let catalogue = catalogue();
    let file = read(&press_text());
    let duty = duty_of(&file, 400);
    let mut motor = catalogue.motors[0].clone();
    motor.rotor_inertia = 1e-12;
    let gearbox = |ratio: f64| {
        let mut gearbox = catalogue.gearboxes[0].clone();
        gearbox.ratio = ratio;
        gearbox.inertia = 0.0;
        gearbox.efficiency = 1.0;
        gearbox
    };
    let direct = Drive {
        motor: &motor,
        gearbox: None,
    }
    .duty(&duty);
    for ratio in [1.0, 2.0, 4.0, 8.5] {
        let gearbox = gearbox(ratio);
        let drive = Drive {
            motor: &motor,
            gearbox: Some(&gearbox),
        };
        let geared = drive.duty(&duty);
        near("torque", geared.torque.rms, direct.torque.rms / ratio, 1e-8);
        near(
            "peak",
            geared.torque.peak(),
            direct.torque.peak() / ratio,
            1e-8,
        );
        near(
            "speed",
            geared.speed.peak(),
            direct.speed.peak() * ratio,
            1e-14,
        );
        near("power", geared.power.rms, direct.power.rms, 1e-8);
        let lambda = direct.inertia_ratio.max / (ratio * ratio);
        near("λ", geared.inertia_ratio.max, lambda, 1e-14);
    }
    // An efficiency makes what is driven harder by 1/η and what drives easier by η.
    let mut lossy = gearbox(4.0);
    lossy.efficiency = 0.5;
    let drive = Drive {
        motor: &motor,
        gearbox: Some(&lossy),
    };
    for instant in &duty.instants {
        let ideal = instant.input_torque / 4.0;
        let found = drive.motor_point(instant).torque;
        let factor = if instant.input_torque * instant.input_speed < 0.0 {
            0.5
        } else {
            2.0
        };
        within(
            "torque",
            found,
            ideal * factor,
            1e-6 * duty.figures(|i| i.input_torque).peak(),
        );
    }
}

pub(super) fn motor() -> Motor {
    Motor {
        key: "m".into(),
        maker: "Maker".into(),
        model: "Model".into(),
        rated_torque: 8.0,
        rated_speed: 3000.0 * RPM,
        standstill_torque: Some(9.0),
        peak_torque: 30.0,
        max_speed: Some(5000.0 * RPM),
        rotor_inertia: 8e-4,
        corner_speed: Some(2500.0 * RPM),
        torque_at_max_speed: Some(10.0),
        from_maker: true,
        mass: None,
        source: "Sheet".into(),
    }
}

fn check_envelope(motor: &Motor) {
    let envelope = Envelope::of(motor);
    let top = envelope.max_speed();
    let n = 20_000;
    let at = |k: i32| top * f64::from(k) / f64::from(n);
    let mut before = (envelope.peak_torque(0.0), envelope.continuous_torque(0.0));
    assert_eq!(before.0, motor.peak_torque);
    assert_eq!(
        before.1,
        motor.standstill_torque.unwrap_or(motor.rated_torque)
    );
    for k in 1..=n {
        let now = (
            envelope.peak_torque(at(k)),
            envelope.continuous_torque(at(k)),
        );
        for (a, b) in [(before.0, now.0), (before.1, now.1)] {
            assert!(b <= a * (1.0 + 1e-14), "{}: rises at {}", motor.key, at(k));
            // The steepest part: all of the peak torque over a tenth of the speed range would be 1e-3 a step.
            assert!(
                a - b <= 1e-3 * motor.peak_torque,
                "{}: jumps at {}",
                motor.key,
                at(k)
            );
        }
        assert!(now.1 <= now.0, "{}: S1 above peak at {}", motor.key, at(k));
        // The same in all quadrants.
        assert_eq!(envelope.peak_torque(-at(k)), now.0);
        assert_eq!(envelope.continuous_torque(-at(k)), now.1);
        before = now;
    }
    near(
        "rated point",
        envelope.continuous_torque(motor.rated_speed),
        motor.rated_torque,
        1e-12,
    );
    for beyond in [1.000_001, 1.3, 10.0] {
        assert_eq!(envelope.peak_torque(beyond * top), 0.0, "{}", motor.key);
        assert_eq!(
            envelope.continuous_torque(beyond * top),
            0.0,
            "{}",
            motor.key
        );
    }
}

#[test]
fn envelopes_fall_without_jumps() {
    for motor in &catalogue().motors {
        check_envelope(motor);
    }
    for missing in 0..16u8 {
        check_envelope(&without(missing));
    }
}

/// The motor without some of its four figures.
fn without(missing: u8) -> Motor {
    let mut motor = motor();
    if missing & 1 != 0 {
        motor.max_speed = None;
    }
    if missing & 2 != 0 {
        motor.corner_speed = None;
    }
    if missing & 4 != 0 {
        motor.torque_at_max_speed = None;
    }
    if missing & 8 != 0 {
        motor.standstill_torque = None;
    }
    motor
}

#[test]
fn assumptions_are_reported_exactly_where_a_figure_is_missing() {
    for missing in 0..16u8 {
        let motor = without(missing);
        let envelope = Envelope::of(&motor);
        let said = |word: &str| envelope.assumptions().iter().any(|a| a.starts_with(word));
        assert_eq!(said("maximum speed not stated"), motor.max_speed.is_none());
        assert_eq!(
            said("corner of the peak torque not stated"),
            motor.corner_speed.is_none()
        );
        assert_eq!(
            said("standstill torque not stated"),
            motor.standstill_torque.is_none()
        );
        // At a top speed that is the corner speed no such figure is needed.
        let corner = motor.corner_speed.unwrap_or(motor.rated_speed);
        let needed = motor.max_speed.unwrap_or(motor.rated_speed) > corner;
        assert_eq!(
            said("peak torque at maximum speed not stated"),
            needed && motor.torque_at_max_speed.is_none(),
            "{missing:04b}"
        );
    }
    // Printed with the result as well.
    let file = read(&press_text());
    let duty = duty_of(&file, 100);
    let motor = without(15);
    let judged = Judged::new(
        Drive {
            motor: &motor,
            gearbox: None,
        },
        &duty,
        &file.rules,
    );
    assert_eq!(judged.assumptions, Envelope::of(&motor).assumptions());
}

/// Peak torque stated up to a speed that the motor does not reach: beyond the largest speed there is still none.
#[test]
fn no_torque_beyond_the_largest_speed() {
    for max_speed in [None, Some(3500.0 * RPM)] {
        let mut motor = motor();
        motor.max_speed = max_speed;
        motor.corner_speed = Some(4500.0 * RPM);
        let envelope = Envelope::of(&motor);
        let beyond = 1.1 * envelope.max_speed();
        assert!(beyond < 4500.0 * RPM);
        assert_eq!(
            envelope.peak_torque(beyond),
            0.0,
            "largest speed {max_speed:?}"
        );
    }
}

#[test]
fn ranking() {
    let catalogue = catalogue();
    let file = read(&press_text());
    let duty = duty_of(&file, 400);
    let selection = Selection::new(&catalogue, &duty, &file.rules);
    let (fit, refused) = (&selection.fit, &selection.refused);
    assert!(fit.len() > 10 && refused.len() > 100);
    assert_eq!(
        fit.len() + refused.len(),
        catalogue.motors.len() * (catalogue.gearboxes.len() + 1)
    );
    let mut names: Vec<String> = fit.iter().chain(refused).map(|j| j.drive.name()).collect();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), fit.len() + refused.len());
    assert!(
        fit.iter()
            .all(|j| j.checks.iter().all(|c| c.verdict != Verdict::Fail))
    );
    for judged in refused {
        let broken = judged.checks.iter().filter(|c| c.verdict == Verdict::Fail);
        let broken: Vec<_> = broken
            .map(|c| (c.rule, c.value, c.limit.unwrap()))
            .collect();
        assert!(!broken.is_empty());
        for (rule, value, limit) in broken {
            assert!(value > limit, "{rule}: {value} against {limit}");
            assert!(judged.reasons().contains(rule));
        }
        assert!(judged.worst_use() > 1.0);
    }
    for judged in fit {
        assert!(judged.worst_use() <= 1.0);
        for check in &judged.checks {
            assert!(check.limit.is_none_or(|limit| check.value <= limit));
        }
    }
    for pair in fit.windows(2) {
        let key = |j: &Judged| {
            let warned = j.checks.iter().any(|c| c.verdict == Verdict::Warn);
            let unchecked = j.checks.iter().any(|c| c.verdict == Verdict::NotChecked);
            let class = if unchecked { 2 } else { i32::from(warned) };
            (
                j.drive.motor.rated_torque * j.drive.motor.rated_speed,
                class,
                j.worst_use(),
            )
        };
        assert!(
            key(&pair[0]) <= key(&pair[1]),
            "{:?} {:?}",
            key(&pair[0]),
            key(&pair[1])
        );
    }
    for pair in refused.windows(2) {
        let key = |j: &Judged| (j.beyond_all_limits(), j.worst_use());
        assert!(key(&pair[0]) <= key(&pair[1]));
    }
}

/// What a user reads about a refused drive.
#[test]
fn reasons_read_well() {
    let catalogue = catalogue();
    let file = read(&press_text());
    let duty = duty_of(&file, 100);
    for judged in &Selection::new(&catalogue, &duty, &file.rules).refused {
        let reasons = judged.reasons();
        for blemish in ["  ", " )", "inf", "NaN"] {
            assert!(!reasons.contains(blemish), "{blemish:?} in: {reasons}");
        }
    }
}
