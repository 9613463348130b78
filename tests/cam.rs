//! Cam programs: segments that make one turn, their transfer functions, and refused programs.

use crate::support::spoken;
use jred::number::RangeError;
use std::f64::consts::{PI, TAU};

use crate::support::{assert_near, budget, config, derivative};
use jred::machine::motion::Law;
use jred::mechanism::cam::{CamError, Program, Segment};
use jred::number::Transfer;
use proptest::prelude::*;

const LAWS: [Law; 7] = [
    Law::Polynomial345,
    Law::Polynomial4567,
    Law::Cycloidal,
    Law::ModifiedSine,
    Law::ModifiedTrapezoid,
    Law::SimpleSine,
    Law::Gutman,
];
const PARABOLA: Law = Law::Trapezoid {
    accelerate: 0.5,
    decelerate: 0.5,
};

fn deg(degrees: f64) -> f64 {
    degrees.to_radians()
}

/// Dwell, rise, dwell, return.
fn four(law: Law, back: Law, lift: f64) -> Program {
    Program::new(&[
        Segment::dwell(deg(40.0)),
        Segment::law(law, deg(120.0), lift),
        Segment::dwell(deg(50.0)),
        Segment::law(back, deg(150.0), -lift),
    ])
    .unwrap()
}

/// Every derivative matches the one before, away from jumps.
#[track_caller]
fn derivatives_agree(program: &Program, size: f64) {
    let step = 1e-3;
    let pieces: Vec<_> = program.pieces().collect();
    for k in 0..720 {
        let phi = TAU * (f64::from(k) + 0.37) / 720.0;
        if pieces
            .iter()
            .any(|p| (phi - p.from).abs() < 2.0 * step || (p.to - phi).abs() < 2.0 * step)
        {
            continue;
        }
        let s = program.displacement(phi);
        for (what, found, f) in [
            ("s'", s.d1, (|s| s.value) as fn(Transfer) -> f64),
            ("s''", s.d2, |s| s.d1),
            ("s'''", s.d3, |s| s.d2),
        ] {
            let expected = derivative(|phi| f(program.displacement(phi)), phi, step);
            assert_near(
                what,
                found,
                expected,
                100.0 * budget::LAW_DIFFERENCES * size,
            );
        }
    }
}

#[test]
fn rises_and_returns_follow_their_law() {
    let lift = 0.02;
    for law in LAWS {
        for back in [Law::Polynomial345, PARABOLA] {
            let program = four(law, back, lift);
            derivatives_agree(&program, lift);
            for k in 0..=100 {
                let z = f64::from(k) / 100.0;
                let up = program.displacement(deg(40.0) + z * deg(120.0) * (1.0 - 1e-14));
                let [s, v, _] = law.at(z);
                assert_near("s", up.value, lift * s, budget::CAM_PROGRAM * lift);
                assert_near(
                    "s'",
                    up.d1,
                    lift * v / deg(120.0),
                    10.0 * budget::CAM_PROGRAM * lift,
                );
                let down = program.displacement(deg(210.0) + z * deg(150.0) - 7.0 * TAU);
                let fallen = lift * (1.0 - back.at(z)[0]);
                assert_near("s", down.value, fallen, 100.0 * budget::CAM_PROGRAM * lift);
            }
            for phi in [0.0, 20.0, 39.9].map(deg) {
                assert_eq!(program.displacement(phi), Transfer::constant(0.0));
            }
            assert_near("dwell", program.displacement(deg(180.0)).value, lift, 1e-17);
            assert_near("dwell", program.displacement(deg(180.0)).d1, 0.0, 0.0);
        }
    }
}

/// The simple sine without dwells is one cosine over the turn, and continues without a jump.
#[test]
fn simple_sines_make_an_eccentric() {
    let e = 0.01;
    let program = Program::new(&[
        Segment::law(Law::SimpleSine, PI, 2.0 * e),
        Segment::law(Law::SimpleSine, PI, -2.0 * e),
    ])
    .unwrap();
    for k in 0..200 {
        let phi = 0.0317 * f64::from(k);
        let s = program.displacement(phi);
        let (sin, cos) = phi.sin_cos();
        for (what, found, expected) in [
            ("s", s.value, e * (1.0 - cos)),
            ("s'", s.d1, e * sin),
            ("s''", s.d2, e * cos),
            ("s'''", s.d3, -e * sin),
        ] {
            assert_near(what, found, expected, budget::CAM_PROGRAM * e);
        }
    }
    assert_eq!(program.acceleration_jumps().count(), 0);
    let [low, high] = program.range();
    assert_near("lowest", low.value, 0.0, budget::EXTREME_VALUE * e);
    assert_near("highest", high.value, 2.0 * e, budget::EXTREME_VALUE * e);
    assert_near("highest at", high.phi, PI, budget::EXTREME_PLACE);
}

#[test]
fn jumps_of_the_acceleration_are_told() {
    let lift = 0.02;
    assert_eq!(
        four(Law::Cycloidal, Law::ModifiedTrapezoid, lift)
            .acceleration_jumps()
            .count(),
        0
    );
    let program = four(Law::Polynomial345, PARABOLA, lift);
    let jumps: Vec<_> = program.acceleration_jumps().collect();
    // The return by parabolas: from rest, in the middle, to rest.
    let a = 4.0 * lift / deg(150.0).powi(2);
    let expected = [(210.0, 0.0, -a), (285.0, -a, a), (360.0, a, 0.0)];
    assert_eq!(jumps.len(), expected.len());
    for (jump, (phi, from, to)) in jumps.iter().zip(expected) {
        assert_near("jump at", jump.phi, deg(phi), budget::POSITION);
        assert_near("before", jump.from, from, budget::EXTREME_VALUE * a);
        assert_near("after", jump.to, to, budget::EXTREME_VALUE * a);
    }
}

#[test]
fn peaks_are_the_characteristic_values() {
    let lift = 0.02;
    for law in LAWS {
        let program = four(law, law, lift);
        let [v, a, j] = program.peaks();
        let (c, beta) = (law.characteristic(), deg(120.0));
        let speed = c.velocity * lift / beta;
        assert_near("s'", v.value, speed, budget::EXTREME_VALUE * speed);
        let most = c.acceleration * lift / beta.powi(2);
        assert_near("s''", a.value, most, budget::EXTREME_VALUE * most);
        if let Some(jerk) = c.jerk {
            let jerk = jerk * lift / beta.powi(3);
            assert_near("s'''", j.value, jerk, budget::EXTREME_VALUE * jerk);
        }
    }
}

/// Rest to constant velocity, constant, to rest, a reversal with acceleration and back: s, s′ and s″ are continuous.
#[test]
fn velocity_and_reversal_transitions() {
    let v = 0.02; // m/rad
    let a = -0.05;
    let half = deg(45.0);
    // Over an angle from rest to v the mean speed is v/2.
    let ramp = v * half / 2.0;
    let program = Program::new(&[
        Segment::polynomial(half, ramp, [0.0, 0.0], [v, 0.0]),
        Segment::constant_velocity(half, v * half),
        Segment::polynomial(half, 0.6 * v * half, [v, 0.0], [0.0, a]),
        Segment::polynomial(half, -0.6 * v * half, [0.0, a], [-v, 0.0]),
        Segment::constant_velocity(half, -v * half),
        Segment::polynomial(half, -ramp, [-v, 0.0], [0.0, 0.0]),
        Segment::dwell(2.0 * half),
    ])
    .unwrap();
    derivatives_agree(&program, v);
    assert_eq!(program.acceleration_jumps().count(), 0);
    let even = program.displacement(1.3 * half);
    assert_near(
        "s",
        even.value,
        ramp + 0.3 * v * half,
        budget::CAM_PROGRAM * v,
    );
    assert_near("s'", even.d1, v, 10.0 * budget::CAM_PROGRAM * v);
    assert_near("s''", even.d2, 0.0, 100.0 * budget::CAM_PROGRAM * v);
    let top = program.displacement(3.0 * half);
    assert_near("reversal", top.d1, 0.0, 10.0 * budget::CAM_PROGRAM * v);
    assert_near("reversal", top.d2, a, 1e3 * budget::CAM_PROGRAM * v);
}

fn refused(segments: &[Segment]) -> String {
    spoken(Program::new(segments).unwrap_err())
}

#[test]
fn wrong_programs_are_refused_with_their_segment() {
    let rise = Segment::law(Law::Cycloidal, deg(180.0), 0.02);
    let back = Segment::law(Law::Cycloidal, deg(180.0), -0.02);
    assert!(Program::new(&[rise, back]).is_ok());
    assert_eq!(
        refused(&[]),
        "the cam program has no segment; give rises, dwells and returns over one turn"
    );
    assert_eq!(
        refused(&[
            rise,
            Segment {
                rise: f64::NAN,
                ..back
            }
        ]),
        "segment 2: a value is not a finite number; give numbers that are neither NaN nor infinite"
    );
    assert_eq!(
        refused(&[
            rise,
            Segment {
                angle: -0.5,
                ..back
            }
        ]),
        "segment 2: its angle is -28.647890°, but must be greater than zero; give it an angle, or leave it out"
    );
    assert_eq!(
        refused(&[Segment {
            rise: 0.01,
            ..Segment::dwell(1.0)
        }]),
        "segment 1: a dwell cannot rise by 0.01; give it a motion law"
    );
    let shares = Law::Trapezoid {
        accelerate: 0.7,
        decelerate: 0.7,
    };
    assert_eq!(
        refused(&[Segment::law(shares, PI, 0.01), back]),
        "segment 1: the shares of the trapezoid must be greater than zero and together at most 1; make them smaller"
    );
    assert_eq!(
        refused(&[
            rise,
            Segment {
                angle: deg(170.0),
                ..back
            }
        ]),
        "the segments cover 350.000000°, but must cover exactly one turn; add 10.000000°"
    );
    assert_eq!(
        refused(&[rise, back, Segment::dwell(deg(3.0))]),
        "the segments cover 363.000000°, but must cover exactly one turn; remove 3.000000°"
    );
    assert_eq!(
        refused(&[
            rise,
            Segment {
                rise: -0.0195,
                ..back
            }
        ]),
        "after a turn the follower is 5.000e-4 m off its start: the rises must add up to zero; \
         change the rise of segment 2 by -5.000e-4"
    );
    assert_eq!(
        refused(&[rise, Segment::constant_velocity(PI, -0.02)]),
        "segment 1: the follower's velocity jumps at its end, φ = 180.00°, from s′ = 0 to -0.006366197723675814 m/rad; \
         make both ends equal"
    );
    let many = [Segment::dwell(TAU / 17.0); 17];
    assert_eq!(
        Program::new(&many).unwrap_err(),
        CamError::Range(RangeError::TooMany {
            what: "segments of a cam program",
            capacity: 16
        })
    );
}

/// Roundings of the angles and rises are accepted, a ten-millionth is not.
#[test]
fn roundings_are_forgiven() {
    let rise = Segment::law(Law::Cycloidal, PI, 0.02);
    let back = Segment::law(Law::Cycloidal, PI, -0.02);
    for (slip, ok) in [(1e-11, true), (1e-7, false)] {
        let rounded = Segment {
            angle: PI * (1.0 + slip),
            ..back
        };
        assert_eq!(Program::new(&[rise, rounded]).is_ok(), ok, "{slip}");
        let rounded = Segment {
            rise: -0.02 * (1.0 + slip),
            ..back
        };
        let found = Program::new(&[rise, rounded]);
        assert_eq!(found.is_ok(), ok, "{slip}");
        if let Ok(program) = found {
            assert_near("closed", program.displacement(TAU - 1e-9).value, 0.0, 1e-17);
        } else {
            assert!(matches!(found, Err(CamError::NotClosed { segment: 1, .. })));
        }
    }
}

proptest! {
    #![proptest_config(config(200, 0x0ca0))]

    /// A quintic polynomial is recovered from its values at the ends of a segment.
    #[test]
    fn quintics_are_found_again(c in [-1.0f64..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0], angle in 0.2f64..3.0, z in 0f64..1.0) {
        let q = |x: f64| {
            let [c1, c2, c3, c4, c5] = c;
            [
                x * (c1 + x * (c2 + x * (c3 + x * (c4 + x * c5)))),
                c1 + x * (2.0 * c2 + x * (3.0 * c3 + x * (4.0 * c4 + x * 5.0 * c5))),
                2.0 * c2 + x * (6.0 * c3 + x * (12.0 * c4 + x * 20.0 * c5)),
                6.0 * c3 + x * (24.0 * c4 + x * 60.0 * c5),
            ]
        };
        let ([_, v0, a0, _], [rise, v1, a1, _]) = (q(0.0), q(angle));
        let rest = TAU - angle;
        let program = Program::new(&[
            Segment::polynomial(angle, rise, [v0, a0], [v1, a1]),
            Segment::polynomial(rest, -rise, [v1, a1], [v0, a0]),
        ]).unwrap();
        let x = z * angle;
        let s = program.displacement(x);
        let size = 1e3 * budget::CAM_PROGRAM * (1.0 + angle.powi(5));
        for (order, (found, expected)) in [s.value, s.d1, s.d2, s.d3].into_iter().zip(q(x)).enumerate() {
            assert_near("quintic", found, expected, size / angle.powi(order as i32));
        }
        assert_eq!(program.acceleration_jumps().count(), 0);
    }
}

/// For any length of a segment a smooth law has no jump of the acceleration; a simple sine has one at each end, of h/2·(π/β)².
#[test]
fn accelerations_of_short_segments() {
    for beta in [3.0, 0.3, 1e-4] {
        let lift = 0.01;
        let program = |law| {
            Program::new(&[
                Segment::law(law, beta, lift),
                Segment::dwell(0.2),
                Segment::law(law, beta, -lift),
                Segment::dwell(TAU - 2.0 * beta - 0.2),
            ])
            .unwrap()
        };
        for law in [Law::Cycloidal, Law::ModifiedSine, Law::Polynomial345] {
            let smooth = program(law);
            assert_eq!(smooth.acceleration_jumps().count(), 0, "{law:?} {beta}");
        }
        let height = 0.5 * lift * (PI / beta).powi(2);
        let jumping = program(Law::SimpleSine);
        let jumps = jumping
            .acceleration_jumps()
            .map(|j| (j.to - j.from) / height);
        for (found, expected) in jumps.zip([1.0, -1.0, -1.0, 1.0]) {
            assert_near("jump", found, expected, 1e-9);
        }
        assert_eq!(jumping.acceleration_jumps().count(), 4);
    }
}

/// Two segments that meet with accelerations of one sign: the jump is their difference, smaller than either.
#[test]
fn a_small_jump_is_a_jump() {
    let (lift, [rise, fall]) = (0.01, [3.0, TAU - 3.0]);
    let program = Program::new(&[
        Segment::law(Law::SimpleSine, rise, lift),
        Segment::law(Law::SimpleSine, fall, -lift),
    ])
    .unwrap();
    let end = |beta: f64| 0.5 * lift * (PI / beta).powi(2);
    let jumps: Vec<_> = program.acceleration_jumps().collect();
    assert_eq!(jumps.len(), 2);
    assert_near(
        "at the top",
        jumps[0].to - jumps[0].from,
        end(rise) - end(fall),
        1e-12,
    );
    assert_near(
        "below",
        jumps[1].to - jumps[1].from,
        end(rise) - end(fall),
        1e-12,
    );
    assert!(end(rise) - end(fall) < lift / (rise * rise));
}
