//! Duty, drives, envelopes and ranking, at the level of the library.
// Zeros and copied figures are exact.
#![allow(clippy::float_cmp)]

mod support;

use std::fmt::Write as _;
use std::path::Path;

use jred::motion::Law;
use jred_sizing::catalogue::{Catalogue, Motor};
use jred_sizing::check::Verdict;
use jred_sizing::drive::{Drive, Judged};
use jred_sizing::duty::Duty;
use jred_sizing::envelope::Envelope;
use jred_sizing::input;
use jred_sizing::machine::MachineFile;
use jred_sizing::motion::{Motion, Segment};
use jred_sizing::rules::Rules;
use jred_sizing::size::Selection;
use support::{Folder, budget, near, press_text, within};

const RPM: f64 = std::f64::consts::PI / 30.0;

fn read(text: &str) -> MachineFile {
    input::parse("machine.toml", text, Path::new("")).unwrap()
}

fn duty_of(file: &MachineFile, steps: usize) -> Duty {
    Duty::new(file, file.motion.as_ref().unwrap(), steps).unwrap()
}

fn catalogue() -> Catalogue {
    Catalogue::load(None, None).unwrap()
}

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
        assert_eq!(rules, if judged.drive.gearbox.is_some() { 9 } else { 5 });
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

fn motor() -> Motor {
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
        assert!(pair[0].worst_use() <= pair[1].worst_use());
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

/// A rotor in balance at constant speed needs nothing but what its friction takes.
#[test]
fn constant_speed_needs_only_friction() {
    let text = r#"
gravity = ["0 m/s^2", "-9.81 m/s^2"]
[mechanism]
type = "gear-train"
flywheel = "3 kg m^2"
stage = [{ driver = { teeth = 20, inertia = "0.1 kg m^2" }, driven = { teeth = 60, inertia = "4 kg m^2" } }]
[[load]]
on = "shaft-2"
opposing_moment = "6 N m"
[[load]]
on = "shaft-1"
viscous_moment = "0.05 N m s/rad"
[motion]
type = "constant-speed"
speed = "-300 rpm"
"#;
    let duty = duty_of(&read(text), 50);
    near("cycle", duty.duration, 0.2, 1e-14);
    let speed = -300.0 * RPM;
    let expected = -6.0 / 3.0 + 0.05 * speed;
    for instant in &duty.instants {
        near("torque", instant.input_torque, expected, 1e-14);
        near("speed", instant.input_speed, speed, 1e-15);
        assert_eq!(instant.input_alpha, 0.0);
    }
    let motor = motor();
    let geared = Drive {
        motor: &motor,
        gearbox: None,
    }
    .duty(&duty);
    near("RMS", geared.torque.rms, expected.abs(), 1e-13);
    assert_eq!(geared.regenerative_energy, 0.0);
    near(
        "energy",
        geared.motoring_energy,
        expected * speed * 0.2,
        1e-13,
    );
    assert_eq!(duty.hold_torque, 0.0);
}

/// Over every law, the integral of ω is the way and that of α nothing; those of ω² and α² are the law's constants.
#[test]
fn laws_integrate_to_their_way() {
    use std::f64::consts::PI;
    let file = read(TABLE);
    // ∫S′² dz and ∫S″² dz in closed form.
    let quarters = Law::Trapezoid {
        accelerate: 0.25,
        decelerate: 0.5,
    };
    let top = 1.0 / (1.0 - 0.375); // largest speed of the trapezoid
    let cases = [
        (
            quarters,
            top * top * (0.25 / 3.0 + 0.25 + 0.5 / 3.0),
            top * top * (1.0 / 0.25 + 1.0 / 0.5),
        ),
        (Law::Polynomial345, 10.0 / 7.0, 120.0 / 7.0),
        (Law::Cycloidal, 1.5, 2.0 * PI * PI),
        (Law::ModifiedSine, f64::NAN, f64::NAN),
    ];
    for (law, speed_squared, alpha_squared) in cases {
        for (way, duration) in [(3.7, 0.8), (-12.0, 0.3)] {
            let segments = [
                Segment {
                    distance: way,
                    duration,
                    law,
                },
                Segment {
                    distance: 0.0,
                    duration: 0.25,
                    law: Law::default(),
                },
            ];
            let motion = Motion::segments(0.4, &segments, false).unwrap();
            let duty = Duty::new(&file, &motion, 2000).unwrap();
            near("cycle", duty.duration, duration + 0.25, 1e-15);
            near("weights", duty.integral(|_| 1.0), duration + 0.25, 1e-13);
            near("way", duty.integral(|i| i.omega), way, budget::SIMPSON);
            let alpha = way.abs() / duration;
            within(
                "∫α",
                duty.integral(|i| i.alpha),
                0.0,
                budget::SIMPSON * alpha,
            );
            if speed_squared.is_finite() {
                let squares = duty.integral(|i| i.omega * i.omega);
                near(
                    "∫ω²",
                    squares,
                    speed_squared * way * way / duration,
                    budget::SIMPSON,
                );
                let squares = duty.integral(|i| i.alpha * i.alpha);
                let expected = alpha_squared * way * way / duration.powi(3);
                near("∫α²", squares, expected, budget::SIMPSON);
            }
            // ω and α are the derivatives of φ: a step of the motion is what Taylor says.
            for k in 1..200 {
                let t = duration * (f64::from(k) + 0.35) / 200.0;
                let h = duration * 1e-5;
                let (a, b) = (motion.at(t - h), motion.at(t + h));
                let now = motion.at(t);
                let size = way.abs() / duration;
                within("ω", (b.phi - a.phi) / (2.0 * h), now.omega, 1e-8 * size);
                within(
                    "α",
                    (b.omega - a.omega) / (2.0 * h),
                    now.alpha,
                    1e-7 * size / duration,
                );
            }
            let end = motion.at(duration + 0.1);
            near("end", end.phi, 0.4 + way, 1e-14);
            assert_eq!((end.omega, end.alpha), (0.0, 0.0));
        }
    }
}

/// J = 0.05 kg m² and nothing else.
const TABLE: &str = r#"
gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "gear-train"
flywheel = "0.01 kg m^2"
stage = [{ driver = { teeth = 20, inertia = "0.02 kg m^2" }, driven = { teeth = 40, inertia = "0.08 kg m^2" } }]
"#;

/// A move recorded at equal times: the RMS torque is that of the law, with the fourth power of the recording step.
#[test]
fn a_recorded_move_gives_the_torque_of_its_law() {
    use std::f64::consts::{PI, TAU};
    let folder = Folder::new();
    let duration = 0.8;
    let rms_of = |samples: i32, cyclic: bool| {
        let mut csv = "t [s],phi [deg]\n".to_owned();
        for k in 0..=samples {
            let z = f64::from(k) / f64::from(samples);
            let phi = 360.0 * (z - (TAU * z).sin() / TAU);
            let _ = writeln!(csv, "{:.12},{phi:.12}", duration * z);
        }
        folder.file("move.csv", csv);
        let text = format!(
            "{TABLE}\n[motion]\ntype = \"profile\"\nfile = \"move.csv\"\ncyclic = {cyclic}\n"
        );
        let file = input::parse("m.toml", &text, &folder.path("")).unwrap();
        let duty = duty_of(&file, 4000);
        near("cycle", duty.duration, duration, 1e-12);
        duty.figures(|i| i.input_torque).rms
    };
    // α = (2π/T²)·2π·sin: RMS 1/√2 of it.
    let exact = 0.05 * 2.0 * PI * TAU / (duration * duration) / 2f64.sqrt();
    // The curvature of the cubic spline through the samples has an error of order 2 that swings about zero within each
    // cell; in the RMS it cancels to order 4.
    let errors = [25, 50, 100].map(|samples| rms_of(samples, true) / exact - 1.0);
    println!("relative errors of the RMS: {errors:?}");
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).abs().log2();
        within("order", order, 4.0, budget::PROFILE_ORDER);
    }
    // With free ends, the end cells add an error of their own.
    for cyclic in [true, false] {
        near("RMS", rms_of(25, cyclic), exact, budget::PROFILE_RMS);
    }
}
