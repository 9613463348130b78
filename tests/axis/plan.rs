//! A plan and its follower, against the motion they were made of.

use core::f64::consts::TAU;

use jred::axis::plan::{Errors, HEADER_WORDS, Knot, Place, PlanError, VERSION, encode, image_len};
use jred::axis::{Follower, Plan, Rate, Stage};
use jred::number::{Number, Quantity as _};
use jred::{Domain, ImageError, MachineUnits, Q31, Rows16, Scale, Spline};
use proptest::prelude::*;

use super::machine::in_units;
use crate::support::images::sealed;
use crate::support::{samples, scale_of};

/// Seconds to units of 2⁻⁴⁰ s.
fn units(t: f64) -> u64 {
    (t * 2f64.powi(40)) as u64
}

fn image(knots: &[Knot], domain: Domain) -> Vec<u32> {
    let mut words = vec![0; image_len(knots.len())];
    let written = encode(knots, domain, 7, Errors::default(), &mut words).map(<[u32]>::len);
    assert_eq!(written, Ok(words.len()));
    words
}

fn refused(words: &[u32]) -> PlanError {
    let model = in_units::<Spline<f32>>(Domain::Turn, Scale::SI);
    Plan::new(words, &model).expect_err("refused")
}

/// Hermite's basis of the fifth degree: values at s of the functions that belong to position, speed and acceleration at both ends, or of a derivative.
fn basis(s: f64, derivative: u32) -> [f64; 6] {
    let polynomials: [[f64; 6]; 6] = [
        [1.0, 0.0, 0.0, -10.0, 15.0, -6.0],
        [0.0, 1.0, 0.0, -6.0, 8.0, -3.0],
        [0.0, 0.0, 0.5, -1.5, 1.5, -0.5],
        [0.0, 0.0, 0.0, 0.5, -1.0, 0.5],
        [0.0, 0.0, 0.0, -4.0, 7.0, -3.0],
        [0.0, 0.0, 0.0, 10.0, -15.0, 6.0],
    ];
    polynomials.map(|polynomial| {
        let mut sum = 0.0;
        for (power, c) in (0..).zip(polynomial) {
            if power >= derivative {
                let falling: f64 = (0..derivative).map(|j| f64::from(power - j)).product();
                sum += c * falling * s.powi((power - derivative).cast_signed());
            }
        }
        sum
    })
}

/// What Hermite's basis is weighed with over the time h between two knots.
fn ends(a: &Knot, b: &Knot, h: f64) -> [f64; 6] {
    [
        a.position,
        a.omega * h,
        a.alpha[1] * h * h,
        b.alpha[0] * h * h,
        b.omega * h,
        b.position,
    ]
}

/// Position, speed and acceleration between two knots.
fn between(a: &Knot, b: &Knot, t: f64) -> [f64; 3] {
    let h = b.t - a.t;
    let s = (t - a.t) / h;
    let of = ends(a, b, h);
    [0, 1, 2].map(|derivative| {
        let sum: f64 = basis(s, derivative)
            .iter()
            .zip(of)
            .map(|(w, x)| w * x)
            .sum();
        sum / h.powi(derivative.cast_signed())
    })
}

fn found<N: Number>(place: &Place<N>, model: &impl MachineUnits<Number = N>) -> [f64; 3] {
    let scale = model.scale();
    let turns = f64::from(place.turns) + f64::from(place.motion.phase.to_bits()) / 2f64.powi(32);
    let (from, span) = match model.domain().to::<f64>() {
        Domain::Turn => (0.0, TAU),
        Domain::Stroke { from, to } => (from, to - from),
    };
    [
        from + turns * span,
        place.motion.omega.number().to_f64() * f64::from(scale.speed()),
        place.motion.alpha.number().to_f64() * f64::from(scale.acceleration()),
    ]
}

/// Times of knots are multiples of 2⁻²⁴ s, and so of the units of a plan of up to 64 s.
const GRID: f64 = 16_777_216.0;

/// Any knots: some 0.1 ms to a second apart, over many turns, with jumps of the acceleration at each.
fn any_knots() -> impl Strategy<Value = Vec<Knot>> {
    let step = (
        -4.0..0.0,
        -20.0..20.0,
        -30.0..30.0,
        -900.0..900.0,
        -900.0..900.0,
        -1.0..1.0,
    );
    proptest::collection::vec(step, 2..20).prop_map(|steps| {
        let (mut t, mut position, mut last) = (0.0, 0.0, 0.0);
        let knots = steps.into_iter().enumerate().map(|(k, step)| {
            let (length, start, omega, before, after, missed) = step;
            let length = if k == 0 {
                0.0
            } else {
                (10f64.powf(length) * GRID).ceil() / GRID
            };
            t += length;
            // Consistent with the speeds to some degree, as a motion is.
            position += if k == 0 {
                start
            } else {
                length * (0.5 * (omega + last) + missed)
            };
            last = omega;
            Knot {
                t,
                position,
                omega,
                alpha: [before, after],
            }
        });
        knots.collect()
    })
}

/// The sum of the terms of the acceleration of a row at the end of its window, the power of two of seconds that is longer than it; and as a speed and a way over
/// the window.
fn terms(a: &Knot, b: &Knot) -> [f64; 3] {
    let h = b.t - a.t;
    let window = 2f64.powf(h.log2().floor() + 1.0);
    let of = ends(a, b, h);
    // The derivatives at the start are the coefficients.
    let coefficient = |power: u32| -> f64 {
        let sum: f64 = basis(0.0, power).iter().zip(of).map(|(w, x)| w * x).sum();
        sum.abs() / (2..=power).map(f64::from).product::<f64>()
            * (window / h).powi(power.cast_signed())
    };
    let sum = |factors: [f64; 4]| -> f64 {
        (2..=5)
            .zip(factors)
            .map(|(power, factor)| factor * coefficient(power))
            .sum()
    };
    let way = sum([2.0, 6.0, 12.0, 20.0]);
    [way / (window * window), way / window, way]
}

/// The polynomials of the rows are those through the knots, to 2⁻²⁶ of the sums of their terms, and what rounding of positions to 2⁻³² of the range is in them.
#[test]
fn a_plan_follows_its_polynomials() {
    let model = in_units::<Spline<f64>>(Domain::Turn, Scale::SI);
    let mut worst = [0.0_f64; 3];
    for knots in samples(300, 0xff61, &any_knots()) {
        let words = image(&knots, Domain::Turn);
        let plan = Plan::new(&words, &model).unwrap();
        // The units of speeds and accelerations are the same for all rows.
        let most = |j: usize| {
            knots
                .windows(2)
                .map(|pair| terms(&pair[0], &pair[1])[j])
                .fold(0.0, f64::max)
        };
        let (raised, fastest) = (most(0), most(1).max(plan.most()[0].into()));
        for pair in knots.windows(2) {
            let h = pair[1].t - pair[0].t;
            let [.., way] = terms(&pair[0], &pair[1]);
            let unit = TAU / 2f64.powi(32);
            let part = 2f64.powi(-26);
            let allowed = [
                part * (way + fastest * h) + 2.0 * unit,
                part * fastest + 2.0 * unit / h,
                part * (raised + 2.0 * fastest / h) + 6.0 * unit / (h * h),
            ];
            for share in [0.0, 1e-6, 0.1, 0.3, 0.5, 0.7, 0.9, 0.999] {
                let t = units(pair[0].t + h * share);
                let exact = between(&pair[0], &pair[1], t as f64 / 2f64.powi(40));
                let here = found(&plan.at(t).value, &model);
                for j in 0..3 {
                    let error = (here[j] - exact[j]).abs();
                    worst[j] = worst[j].max(error / allowed[j]);
                    assert!(error <= allowed[j], "{j}: {error:e} {:e} {t}", allowed[j]);
                }
            }
        }
    }
    // No slack: a fifth would be too little.
    for (j, worst) in worst.into_iter().enumerate() {
        assert!(worst > 0.2, "{j}: {worst}");
    }
}

/// From rest to rest by a trapezoid of the speed: 1 s of 2 rad/s², 3 s of 2 rad/s, 0.5 s of −4 rad/s², then a second of rest.
fn trapezoid() -> [Knot; 5] {
    let knot = |t, position, omega, before, after| Knot {
        t,
        position,
        omega,
        alpha: [before, after],
    };
    [
        knot(0.0, 0.5, 0.0, 0.0, 2.0),
        knot(1.0, 1.5, 2.0, 2.0, 0.0),
        knot(4.0, 7.5, 2.0, 0.0, -4.0),
        knot(4.5, 8.0, 0.0, -4.0, 0.0),
        knot(5.5, 8.0, 0.0, 0.0, 0.0),
    ]
}

/// The same in closed form.
fn exact(t: f64) -> [f64; 3] {
    match t {
        ..1.0 => [0.5 + t * t, 2.0 * t, 2.0],
        ..4.0 => [1.5 + 2.0 * (t - 1.0), 2.0, 0.0],
        ..4.5 => {
            let left = 4.5 - t;
            [8.0 - 2.0 * left * left, 4.0 * left, -4.0]
        }
        _ => [8.0, 0.0, 0.0],
    }
}

/// Every number type, up to its own rounding; corners of the acceleration where they are, behind the end rest.
#[test]
fn corners_of_the_acceleration_are_kept() {
    fn check<N: Number>(model: &impl MachineUnits<Number = N>, unit: f64) {
        let words = image(&trapezoid(), Domain::Turn);
        let plan = Plan::new(&words, model).unwrap();
        assert_eq!((plan.rows(), plan.machine()), (5, 7));
        assert_eq!(plan.duration().to_bits(), 5.5_f32.to_bits());
        assert_eq!(plan.end(), units(5.5));
        assert_eq!(
            plan.most().map(f32::to_bits),
            [2.0_f32, 4.0].map(f32::to_bits)
        );
        let [speed, acceleration] =
            [model.scale().speed(), model.scale().acceleration()].map(f64::from);
        let before = [1.0, 4.0, 4.5].map(|t| units(t) - 1);
        let times = (0..=700).map(|k| units(0.01 * f64::from(k)));
        for t in times.chain(before) {
            let place = plan.at(t);
            assert!(!place.saturated);
            let [position, omega, alpha] = found(&place.value, model);
            let [at, v, a] = exact(t as f64 / 2f64.powi(40));
            // Factors to machine units have single precision.
            assert!((position - at).abs() < 2e-8 * TAU, "{t}: {position} {at}");
            assert!(
                (omega - v).abs() <= unit * speed + 1.8e-7,
                "{t}: {omega} {v}"
            );
            assert!(
                (alpha - a).abs() <= unit * acceleration + 3e-7,
                "{t}: {alpha} {a}"
            );
        }
        // Behind its end it is where it ends.
        assert_eq!(plan.at(u64::MAX), plan.at(plan.end()));
    }
    let scale = scale_of(100.0, 10.0, 10.0);
    check(&in_units::<Spline<f64>>(Domain::Turn, Scale::SI), 0.0);
    check(&in_units::<Spline<f32>>(Domain::Turn, Scale::SI), 2.4e-7);
    check(&in_units::<Spline<Q31>>(Domain::Turn, scale), 2e-8);
    check(&in_units::<Rows16>(Domain::Turn, scale), 3.1e-5);
}

/// On a stroke positions are those of the stroke, also where a rounding would leave it.
#[test]
fn a_stroke_is_not_left() {
    let domain = Domain::stroke(0.1, 0.6).unwrap();
    let model = in_units::<Spline<f32>>(domain, Scale::SI);
    // The whole stroke in 2 s, with 0.5 m/s² and −0.5 m/s².
    let knots = [
        (0.0, 0.1, 0.0, [0.0, 0.5]),
        (1.0, 0.35, 0.5, [0.5, -0.5]),
        (2.0, 0.6, 0.0, [-0.5, 0.0]),
    ];
    let knots = knots.map(|(t, position, omega, alpha)| Knot {
        t,
        position,
        omega,
        alpha,
    });
    let words = image(&knots, domain);
    let plan = Plan::new(&words, &model).unwrap();
    let mut before = 0;
    for k in 0..=1000 {
        let place = plan.at(units(0.002 * f64::from(k))).value;
        assert_eq!(place.turns, 0);
        let phase = place.motion.phase.to_bits();
        assert!(phase >= before, "{k}: {phase:x} {before:x}");
        before = phase;
    }
    assert_eq!(before, u32::MAX);
    // Another stroke is another machine; so is a turn.
    for other in [Domain::stroke(0.1, 0.5).unwrap(), Domain::Turn] {
        let model = in_units::<Spline<f32>>(other, Scale::SI);
        assert_eq!(Plan::new(&words, &model), Err(PlanError::Range));
    }
    let outside = [
        knots[0],
        Knot {
            position: 0.6001,
            ..knots[2]
        },
    ];
    let mut words = [0; image_len(2)];
    assert_eq!(
        encode(&outside, domain, 0, Errors::default(), &mut words),
        Err(PlanError::Number(1))
    );
}

#[test]
fn every_flipped_bit_of_a_plan_is_refused() {
    let words = image(&trapezoid(), Domain::Turn);
    for bit in 0..32 * words.len() {
        let mut damaged = words.clone();
        damaged[bit / 32] ^= 1 << (bit % 32);
        let error = refused(&damaged);
        let expected = match bit / 32 {
            0 => matches!(error, PlanError::NotAPlan(_)),
            1 if bit % 32 < 16 => matches!(error, PlanError::Image(ImageError::Version { .. })),
            2 => matches!(error, PlanError::Image(ImageError::Length { .. })),
            _ => matches!(error, PlanError::Image(ImageError::Crc { .. })),
        };
        assert!(expected, "bit {bit}: {error:?}");
    }
    for given in 0..words.len() {
        let error = refused(&words[..given]);
        assert!(
            matches!(error, PlanError::Image(ImageError::Length { .. })),
            "{given}: {error:?}"
        );
    }
}

/// With a CRC that fits: what is wrong is said, and nothing panics.
#[test]
fn a_plan_that_is_not_sound_is_refused() {
    let words = image(&trapezoid(), Domain::Turn);
    let row = |k: usize, word: usize| HEADER_WORDS + 8 * k + word;
    let with = |place: usize, word: u32| {
        let mut words = words.clone();
        words[place] = word;
        refused(&sealed(words))
    };
    let header = |word: u8| PlanError::Image(ImageError::Header(word));
    for (place, word, expected) in [
        (1, u32::from(VERSION) | 15 << 16, header(1)),
        (3, words[3] & !0xff | 2, header(3)),
        (3, words[3] & !0xff00 | 41 << 8, header(3)),
        (3, words[3] & !0xff | 1, header(5)),
        (4, 4, header(4)),
        (8, f32::NAN.to_bits(), header(8)),
        (12, (-1.0_f32).to_bits(), header(8)),
        (13, 1, header(13)),
        (row(0, 0), 1, PlanError::Order(0)),
        (row(2, 0), words[row(1, 0)], PlanError::Order(1)),
        (row(1, 2), words[row(1, 2)] | 32, PlanError::Number(1)),
        (row(0, 3), i32::MIN.cast_unsigned(), PlanError::Number(0)),
        (row(0, 7), i32::MAX.cast_unsigned(), PlanError::Number(0)),
        (
            row(2, 3),
            words[row(2, 3)] + (words[row(2, 3)] >> 10),
            PlanError::Gap(1),
        ),
        (row(2, 1), words[row(2, 1)] ^ 1 << 20, PlanError::Gap(1)),
        (row(0, 5), 1 << 20, PlanError::Gap(0)),
    ] {
        assert_eq!(with(place, word), expected, "word {place}");
    }
    for words in samples(500, 0xff62, &proptest::collection::vec(any::<u32>(), 8 * 4)) {
        let mut plan = image(&trapezoid(), Domain::Turn);
        let places = HEADER_WORDS..HEADER_WORDS + 8 * 4;
        plan[places].copy_from_slice(&words);
        plan[HEADER_WORDS] = 0;
        refused(&sealed(plan));
    }
    // Beyond the bases of fixed point.
    let slow = in_units::<Spline<Q31>>(Domain::Turn, scale_of(100.0, 1.9, 10.0));
    let error = Plan::new(&words, &slow).expect_err("too fast");
    assert_eq!(
        format!("{error}; {}", error.cure()),
        "the greatest speed of the plan is 2, but must be less than its base, 1.9; \
         give a smaller value, or export the table for a greater speed and acceleration"
    );
    let model = in_units::<Spline<f32>>(Domain::Turn, Scale::SI);
    let plan = Plan::new(&words, &model).unwrap();
    assert!(plan.of_machine(7).is_ok());
    assert!(matches!(
        plan.of_machine(8),
        Err(PlanError::Image(ImageError::Machine {
            found: 7,
            expected: 8
        }))
    ));
}

#[test]
fn knots_that_make_no_plan_are_refused() {
    let mut words = [0; image_len(5)];
    let mut with = |change: fn(&mut [Knot; 5])| {
        let mut knots = trapezoid();
        change(&mut knots);
        encode(&knots, Domain::Turn, 0, Errors::default(), &mut words)
            .map(|_| ())
            .expect_err("refused")
    };
    assert_eq!(with(|knots| knots[2].t = 1.0), PlanError::Order(2));
    assert_eq!(with(|knots| knots[0].t = 0.1), PlanError::Order(0));
    assert_eq!(
        with(|knots| knots[3].omega = f64::NAN),
        PlanError::Number(3)
    );
    assert_eq!(
        with(|knots| knots[3].alpha[1] = f64::INFINITY),
        PlanError::Number(3)
    );
    assert_eq!(with(|knots| knots[4].position = 1e9), PlanError::Number(4));
    let mut few = [0; 20];
    let short = encode(&trapezoid(), Domain::Turn, 0, Errors::default(), &mut few);
    assert!(matches!(
        short,
        Err(PlanError::Image(ImageError::BufferTooShort {
            given: 20,
            ..
        }))
    ));
}

/// Each tick is where the plan is at that time, whatever the tick: 2⁻⁴⁰ s a tick off.
#[test]
fn a_follower_is_on_time() {
    let model = in_units::<Spline<f64>>(Domain::Turn, Scale::SI);
    let words = image(&trapezoid(), Domain::Turn);
    let plan = Plan::new(&words, &model).unwrap();
    for period in [0.000_25_f32, 0.000_062_5, 0.001, 0.003_7] {
        let mut follower = Follower::new(plan, period, 0.5, &model).unwrap();
        for _ in 0..3 {
            let planned = follower.next(Rate::FULL);
            assert_eq!(planned.stage, Stage::Waiting);
            assert_eq!((planned.motion.omega, planned.motion.alpha), (0.0, 0.0));
        }
        follower.start();
        let mut ticks = 0_u32;
        loop {
            let planned = follower.next(Rate::FULL);
            if planned.stage == Stage::Done {
                break;
            }
            assert_eq!(planned.stage, Stage::Running);
            let place = Place {
                motion: planned.motion,
                turns: planned.turns,
            };
            let [position, omega, _] = found(&place, &model);
            let [at, v, _] = exact(f64::from(ticks) * f64::from(period));
            assert!((position - at).abs() < 1.5e-7, "{ticks}: {position} {at}");
            assert!((omega - v).abs() < 3e-7, "{ticks}: {omega} {v}");
            ticks += 1;
        }
        let all = (5.5 / f64::from(period)).ceil();
        assert!(
            (f64::from(ticks) - all).abs() <= 1.0,
            "{period}: {ticks} {all}"
        );
        let end = follower.next(Rate::FULL);
        assert_eq!((end.stage, end.motion.omega), (Stage::Done, 0.0));
        follower.reset();
        assert_eq!(follower.next(Rate::FULL).stage, Stage::Waiting);
    }
}

/// With a rate that changes all the time the speed is the derivative of the position, and the acceleration that of the speed.
#[test]
fn an_override_is_a_motion() {
    let model = in_units::<Spline<f64>>(Domain::Turn, Scale::SI);
    let words = image(&trapezoid(), Domain::Turn);
    let plan = Plan::new(&words, &model).unwrap();
    let period = 0.000_5;
    let mut follower = Follower::new(plan, period as f32, 0.4, &model).unwrap();
    follower.start();
    let rate = |k: u32| {
        Rate::percent(match k {
            1000..3000 => 40,
            3000..4000 => 0,
            4000..6000 => 70,
            _ => 100,
        })
    };
    let mut rows: Vec<([f64; 3], Stage)> = Vec::new();
    for k in 0..20_000 {
        let planned = follower.next(rate(k));
        let place = Place {
            motion: planned.motion,
            turns: planned.turns,
        };
        rows.push((found(&place, &model), planned.stage));
        if planned.stage == Stage::Done {
            break;
        }
    }
    let mut corners = 0;
    for pair in rows.windows(2) {
        let [[x0, v0, a0], [x1, v1, a1]] = [pair[0].0, pair[1].0];
        // Small corners, where a ramp ends within a tick, are between both.
        if (a1 - a0).abs() > 0.03 {
            corners += 1;
            continue;
        }
        assert!(
            (x1 - x0 - period * 0.5 * (v0 + v1)).abs() < 5e-8,
            "{pair:?}"
        );
        let mean = (v1 - v0) / period;
        assert!(
            mean > a0.min(a1) - 4e-4 && mean < a0.max(a1) + 4e-4,
            "{pair:?}"
        );
    }
    // Three of the plan, and two or three of each ramp, which ends within a tick.
    assert!((11..=15).contains(&corners), "{corners}");
    let held = rows.iter().filter(|row| row.1 == Stage::Held).count();
    // A thousand ticks less the 320 of the ramp from 40 % to 0.
    assert!((679..=681).contains(&held), "{held}");
    assert_eq!(rows.last().unwrap().1, Stage::Done);
    // At 40 % in the first part, φ = 0.5 + s²: the speed of the plan times 0.4, its acceleration times 0.16.
    let ([position, omega, alpha], _) = rows[2900];
    let time = (position - 0.5).sqrt();
    assert!((omega - 0.4 * 2.0 * time).abs() < 2e-7, "{omega} {time}");
    assert!((alpha - 0.16 * 2.0).abs() < 1e-6, "{alpha}");
}

/// A plan that ends where it begins goes on without a pause; another is refused.
#[test]
fn a_closed_plan_is_repeated() {
    let model = in_units::<Spline<f32>>(Domain::Turn, Scale::SI);
    let words = image(&trapezoid(), Domain::Turn);
    let open = Follower::new(Plan::new(&words, &model).unwrap(), 0.001, 0.0, &model).unwrap();
    assert_eq!(open.repeating().map(|_| ()), Err(PlanError::Open));
    // One turn a second, evenly.
    let knot = |t, position| Knot {
        t,
        position,
        omega: TAU,
        alpha: [0.0; 2],
    };
    let words = image(&[knot(0.0, 1.0), knot(1.0, 1.0 + TAU)], Domain::Turn);
    let plan = Plan::new(&words, &model).unwrap();
    let mut follower = Follower::new(plan, 0.001, 0.0, &model)
        .unwrap()
        .repeating()
        .unwrap();
    follower.start();
    for k in 0..5000 {
        let planned = follower.next(Rate::FULL);
        assert_eq!(planned.stage, Stage::Running);
        assert!((f64::from(planned.motion.omega) - TAU).abs() < 1e-5);
        let turns = 1.0 / TAU + f64::from(k) * f64::from(0.001_f32);
        let phase = f64::from(planned.motion.phase.to_bits()) / 2f64.powi(32);
        let apart = phase - turns;
        assert!((apart - apart.round()).abs() < 1e-8, "{k}: {phase} {turns}");
    }
    for (period, ramp) in [(2.0, 0.0), (0.0, 0.0), (0.001, -1.0), (0.001, f32::NAN)] {
        assert!(matches!(
            Follower::new(plan, period, ramp, &model),
            Err(PlanError::Axis(_))
        ));
    }
}
