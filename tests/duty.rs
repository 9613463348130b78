//! The duty meter: against closed forms, against double precision, against bad readings.

mod refused;

use crate::support::budget;
use jred::duty::{Curve, Figures, Limits, MOST_TORQUE, Meter, Verdict, Window};
use jred::number::Real;

const STEP: f64 = 1e-3;

/// T = 10·sin t, n = 100·cos t + 30, T_out = 40 + 8·sin 3t over whole periods of ten thousand ticks.
fn readings(k: u32) -> [f64; 3] {
    let t = std::f64::consts::TAU * (f64::from(k) + 0.5) / 1e4;
    [
        10.0 * t.sin(),
        100.0 * t.cos() + 30.0,
        40.0 + 8.0 * (3.0 * t).sin(),
    ]
}

fn limits() -> Limits<f64> {
    Limits::new()
        .with_continuous(Curve::new(&[[0.0, 8.0], [100.0, 6.0], [200.0, 3.0]]).unwrap())
        .with_peak(Curve::new(&[[50.0, 20.0], [120.0, 12.0], [140.0, 4.0]]).unwrap())
        .with_speed(129.0)
        .with_mean_speed(70.0)
        .with_output_peak(48.1)
        .with_output_mean(40.0)
        .with_regenerative_power(150.0)
        .with_cycles_per_hour(400.0)
}

fn single(limits: &Limits<f64>) -> Limits<f32> {
    let curve = |points: &[[f32; 2]]| Some(Curve::new(points).unwrap());
    let number = |limit: Option<f64>| limit.map(|x| x as f32);
    let mut single = Limits::new();
    single.continuous = curve(&[[0.0, 8.0], [100.0, 6.0], [200.0, 3.0]]);
    single.peak = curve(&[[50.0, 20.0], [120.0, 12.0], [140.0, 4.0]]);
    single.speed = number(limits.speed);
    single.mean_speed = number(limits.mean_speed);
    single.output_peak = number(limits.output_peak);
    single.output_mean = number(limits.output_mean);
    single.regenerative_power = number(limits.regenerative_power);
    single.cycles_per_hour = number(limits.cycles_per_hour);
    single
}

#[track_caller]
fn near(found: f64, expected: f64, relative: f64, what: &str) {
    let error = (found - expected).abs();
    assert!(
        error <= relative * expected.abs(),
        "{what}: {found}, expected {expected}, off by {:e}",
        error / expected.abs()
    );
}

/// Names of the figures of [`list`].
const NAMES: [&str; 12] = [
    "rms torque",
    "mean speed",
    "output mean",
    "motoring power",
    "regenerative power",
    "motoring energy",
    "regenerative energy",
    "duration",
    "peak torque",
    "peak speed",
    "output peak",
    "share of peak",
];

fn list<R: Real>(figures: &Figures<R>) -> [f64; 12] {
    [
        figures.rms_torque,
        figures.mean_speed,
        figures.output_mean,
        figures.motoring_power,
        figures.regenerative_power,
        figures.motoring_energy,
        figures.regenerative_energy,
        figures.duration,
        figures.peak_torque,
        figures.peak_speed,
        figures.output_peak,
        figures.peak_share.unwrap(),
    ]
    .map(Real::to_f64)
}

/// Root mean square 10/√2; mean |100·cos + 30| in closed form; the energies differ by the mean power, which is zero here.
#[test]
fn figures_are_those_of_closed_forms() {
    use Verdict::{Exceeded, Satisfied};
    let mut meter = Meter::new(limits(), STEP, Window::SinceStart).unwrap();
    for k in 0..10_000 {
        let [torque, speed, output] = readings(k);
        meter.tick(torque, speed, output);
    }
    meter.count_cycle();
    let figures = meter.figures();
    near(figures.rms_torque, 50.0f64.sqrt(), 1e-12, "rms");
    // ∫|a·cos t + c|/2π: zero at cos t₀ = −c/a.
    let turn = (-0.3f64).acos();
    let mean = 2.0 * (100.0 * turn.sin() + 30.0 * turn - 15.0 * std::f64::consts::PI)
        / std::f64::consts::PI;
    near(
        figures.mean_speed,
        mean,
        budget::METER_RECTANGLE,
        "mean speed",
    );
    // ∫max(T·n, 0) = ∫|T·n|/2, as the mean is zero; ∫|sin t·(100·cos t + 30)|·10.
    let area = |c: f64| 50.0 * c * c + 30.0 * c; // of (100·c + 30) over c = cos t
    let zero = area(-0.3);
    let power = 10.0 * (area(1.0) - 2.0 * zero + area(-1.0)) / std::f64::consts::TAU;
    near(
        figures.motoring_power,
        power,
        budget::METER_RECTANGLE,
        "power",
    );
    near(
        figures.regenerative_power,
        power,
        budget::METER_RECTANGLE,
        "power back",
    );
    near(
        figures.motoring_energy,
        10.0 * power,
        budget::METER_RECTANGLE,
        "energy",
    );
    near(
        figures.regenerative_energy,
        10.0 * power,
        budget::METER_RECTANGLE,
        "energy back",
    );
    near(figures.duration, 10.0, 1e-12, "duration");
    near(figures.peak_torque, 10.0, 1e-6, "peak torque");
    near(figures.peak_speed, 130.0, 1e-6, "peak speed");
    near(figures.output_peak, 48.0, 1e-6, "output peak");
    near(figures.cycles_per_hour, 360.0, 1e-12, "cycles per hour");
    assert_eq!(
        (figures.cycles, figures.ticks, figures.invalid),
        (1, 10_000, 0)
    );

    // The largest share by search, with the curve as a formula.
    let limit = |n: f64| match n.abs() {
        n if n <= 50.0 => 20.0,
        n if n <= 120.0 => 20.0 - 8.0 * (n - 50.0) / 70.0,
        n => 12.0 - 8.0 * (n - 120.0) / 20.0,
    };
    let share = (0..10_000)
        .map(readings)
        .map(|[t, n, _]| t.abs() / limit(n));
    near(
        figures.peak_share.unwrap(),
        share.fold(0.0, f64::max),
        1e-12,
        "share",
    );

    let verdicts = meter.verdicts();
    assert_eq!(
        verdicts.all(),
        [
            Exceeded, // 7.07 N·m of 6.6 N·m at 67 rad/s
            Satisfied, Exceeded, Satisfied, Satisfied, Exceeded, Exceeded, Satisfied, Satisfied
        ],
        "{figures:?}"
    );
    assert!(!verdicts.satisfied());
}

#[test]
fn a_constant_duty_gives_its_own_numbers() {
    for window in [Window::SinceStart, Window::Exponential(0.5)] {
        let mut meter = Meter::new(Limits::default(), STEP, window).unwrap();
        for _ in 0..3000 {
            meter.tick(-3.0, 20.0, 50.0);
        }
        let figures = meter.figures();
        for (found, expected) in [
            (figures.rms_torque, 3.0),
            (figures.mean_speed, 20.0),
            (figures.output_mean, 50.0),
            (figures.regenerative_power, 60.0),
        ] {
            near(found, expected, 1e-13, "constant");
        }
        assert!(figures.motoring_power.abs() < 1e-300);
        let duration = match window {
            Window::SinceStart => 3.0,
            Window::Exponential(tau) => tau * (1.0 - (1.0 - STEP / tau).powi(3000)),
        };
        near(figures.duration, duration, 1e-12, "duration");
        assert_eq!(figures.peak_share, None);
        assert_eq!(meter.verdicts().all()[..8], [Verdict::NotChecked; 8]);
    }
}

/// After a step of the torque the mean square of an exponential window changes by 1 − e^(−t/τ).
#[test]
fn an_exponential_window_forgets() {
    let tau = 2.0;
    let mut meter = Meter::new(Limits::default(), STEP, Window::Exponential(tau)).unwrap();
    for _ in 0..100_000 {
        meter.tick(1.0, 0.0, 0.0);
    }
    for k in 1..=4000 {
        meter.tick(5.0, 0.0, 0.0);
        let kept = (1.0 - STEP / tau).powi(k);
        let expected = (25.0 - 24.0 * kept).sqrt();
        near(meter.figures().rms_torque, expected, 1e-10, "rms");
    }
    near(
        meter.figures().rms_torque,
        (25.0 - 24.0 * (-2.0f64).exp()).sqrt(),
        1e-3,
        "rms against e^-2",
    );
}

#[test]
fn single_precision_keeps_its_digits_over_a_million_ticks() {
    let mut worst = 0.0f64;
    for window in [None, Some(600.0)] {
        let (wide, narrow) = match window {
            None => (Window::SinceStart, Window::SinceStart),
            Some(tau) => (Window::Exponential(tau), Window::Exponential(tau as f32)),
        };
        let mut double = Meter::new(limits(), STEP, wide).unwrap();
        let mut meter = Meter::new(single(&limits()), STEP as f32, narrow).unwrap();
        let mut plain = 0.0f32;
        for k in 0..1_000_000 {
            // The same readings for both.
            let [torque, speed, output] = readings(k).map(|x| x as f32);
            meter.tick(torque, speed, output);
            double.tick(torque.into(), speed.into(), output.into());
            plain += speed.abs() * output.powi(3);
        }
        let (found, expected) = (list(&meter.figures()), list(&double.figures()));
        for (what, (found, expected)) in NAMES.iter().zip(found.into_iter().zip(expected)) {
            near(found, expected, budget::METER_F32, what);
            worst = worst.max((found / expected - 1.0).abs());
        }
        assert_eq!(meter.verdicts(), double.verdicts());
        if window.is_none() {
            let wide = double.figures();
            let exact = wide.output_mean.powi(3) * wide.mean_speed * 1e6;
            let lost = (f64::from(plain) / exact - 1.0).abs();
            println!("a plain sum is wrong by {lost:.1e}");
            assert!(lost > 100.0 * budget::METER_F32, "{lost:e}");
        }
    }
    println!("worst of the meter {worst:.1e}");
    assert!(
        worst > budget::METER_F32 / 10.0,
        "the budget is slack: {worst:e}"
    );
}

/// A duty that a plain sum would miss: a small torque after a long time of large ones.
#[test]
fn small_terms_are_not_lost_beside_large_sums() {
    let mut meter = Meter::new(Limits::default(), 1.0f32, Window::SinceStart).unwrap();
    for _ in 0..1000 {
        meter.tick(1e3, 0.0, 0.0);
    }
    assert_eq!((1e9f32 + 25.0).to_bits(), 1e9f32.to_bits());
    for _ in 0..1_000_000 {
        meter.tick(5.0, 0.0, 0.0);
    }
    let expected = ((1e9 + 25e6) / 1_001_000.0f64).sqrt();
    near(
        meter.figures().rms_torque.into(),
        expected,
        budget::METER_F32,
        "rms",
    );
}

#[test]
fn readings_that_are_no_numbers_are_counted_and_change_nothing() {
    let mut meter = Meter::<f32>::new(single(&limits()), 1e-3, Window::SinceStart).unwrap();
    meter.tick(1.0, 2.0, 3.0);
    let before = meter.figures();
    let most = MOST_TORQUE as f32;
    let bad = [
        [f32::NAN, 1.0, 1.0],
        [1.0, f32::NAN, 1.0],
        [1.0, 1.0, f32::NAN],
        [f32::INFINITY, 1.0, 1.0],
        [1.0, f32::NEG_INFINITY, 1.0],
        [1.0, 1.0, -2.0 * most],
        [2.0 * most, 0.0, 0.0],
        [0.0, -2e5, 0.0],
    ];
    for [torque, speed, output] in bad {
        meter.tick(torque, speed, output);
    }
    let mut after = meter.figures();
    assert_eq!(after.invalid, 8);
    assert_eq!(meter.verdicts().readings, Verdict::Exceeded);
    after.invalid = 0;
    assert_eq!(before, after);

    // The largest accepted values do not overflow.
    let mut meter = Meter::<f32>::new(Limits::default(), 1e-3, Window::SinceStart).unwrap();
    for _ in 0..1000 {
        meter.tick(most, 1e5, -most);
    }
    near(
        meter.figures().output_mean.into(),
        MOST_TORQUE,
        budget::METER_F32,
        "cube",
    );
    assert_eq!(meter.figures().invalid, 0);
}

/// No 0/0: neither before the first tick, nor for a drive that only holds.
#[test]
fn without_ticks_or_without_speed_every_figure_is_a_number() {
    let mut meter = Meter::new(limits(), STEP, Window::SinceStart).unwrap();
    assert_eq!(list(&meter.figures()).map(f64::to_bits), [0; 12]);
    assert_eq!(meter.figures().cycles_per_hour.to_bits(), 0);
    meter.tick(0.0, 0.0, 40.0);
    let figures = meter.figures();
    assert_eq!(figures.output_mean.to_bits(), 0);
    assert_eq!(figures.output_peak.to_bits(), 40.0f64.to_bits());
}

#[test]
fn torque_beyond_the_curve_is_an_infinite_share() {
    let mut meter = Meter::new(limits(), STEP, Window::SinceStart).unwrap();
    meter.tick(0.0, 1000.0, 0.0);
    assert_eq!(meter.figures().peak_share, Some(0.0));
    meter.tick(0.1, 1000.0, 0.0);
    meter.tick(19.0, 10.0, 0.0);
    assert_eq!(meter.figures().peak_share, Some(f64::INFINITY));
    assert_eq!(meter.verdicts().peak_torque, Verdict::Exceeded);
    meter.restart();
    assert_eq!(meter.figures().peak_share, Some(0.0));
    assert_eq!(meter.verdicts().all(), [Verdict::NotChecked; 9]);
}

#[test]
fn cube_roots_are_right() {
    let mut worst = 0.0f64;
    let mut x = 1.2e-38f64;
    while x < 3e38 {
        let given = x as f32;
        let exact = f64::from(given).cbrt();
        let unit = f64::from((exact as f32).next_up()) - f64::from(exact as f32);
        worst = worst.max((f64::from(Real::cbrt(given)) - exact).abs() / unit);
        x *= 1.000_37;
    }
    println!("cube root: {worst:.2} ulp");
    assert!((0.5..=budget::CUBE_ROOT_ULP).contains(&worst), "{worst}");
    assert_eq!(Real::cbrt(0.0f32).to_bits(), 0);
    assert_eq!(Real::cbrt(27.0f64).to_bits(), 3.0f64.to_bits());
}
