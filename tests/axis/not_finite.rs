//! NaN and infinity in every function of the axis that takes a number.

use std::collections::BTreeSet;
use std::path::Path;

use jred::axis::monitor::{Monitor, Seen, Watch};
use jred::axis::plan::{Errors, Knot, encode, image_len, with_ramp};
use jred::axis::{
    AxisError, Braking, Direction, Envelope, FeedForward, FrictionRamp, Gearbox, Governor,
    Identification, IdentificationSettings, Limits, LookAhead, MotionRange, MotionState, Observer,
    Payload, Period, Plan, PlanFollower, Sampled, StrokeEncoder, StrokeMounting, TorqueLimits,
    Tracker, Transmission,
};
use jred::image::Validity;
use jred::number::FrictionSign;
use jred::{CurveSet, Domain, Model, Phase, Scale, Spline, curves, include_image};

use super::machine::with_model;
use crate::no_panic_list::public_of;
use crate::support::images::VALIDITY;

const SET: CurveSet = curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
type Press<'a> = Model<'a, Spline<f32>, SET>;

/// Result of a function for NaN or infinity.
#[derive(Debug, PartialEq)]
enum Becomes {
    /// An error.
    Refused,
    /// A flag, and finite numbers.
    Flagged,
    /// A finite number or a limit, as documented; the next step flags the input.
    Finite,
    /// NaN or infinity unchanged: the status of the next step detects it.
    Carried,
}
use Becomes::{Carried, Finite, Flagged, Refused};

#[expect(clippy::needless_pass_by_value, reason = "each call makes it")]
fn refused<T, E>(made: Result<T, E>) -> Becomes {
    if made.is_err() { Refused } else { Finite }
}

fn carried(values: &[f32]) -> Becomes {
    if values.iter().all(|x| x.is_finite()) {
        Finite
    } else {
        Carried
    }
}

fn flagged(flag: bool, values: &[f32]) -> Becomes {
    match (flag, carried(values)) {
        (true, Finite) => Flagged,
        (_, other) => other,
    }
}

fn motion(omega: f32, alpha: f32) -> MotionState<f32> {
    MotionState {
        phase: Phase::from_bits(1 << 29),
        omega,
        alpha,
    }
}

type Case = (&'static str, Becomes, fn(&Press<'_>, f32) -> Becomes);

fn period(model: &Press<'_>) -> Period<f32> {
    Period::new(0.001, model).unwrap()
}

fn limits(model: &Press<'_>) -> Limits<f32, 1> {
    let envelope = Envelope::new([[12.0, 8.0]], 8.0, model).unwrap();
    let period = period(model);
    Limits::new(envelope, 10.0, 40.0, period, model).unwrap()
}

fn ahead(model: &Press<'_>) -> LookAhead<f32, 32> {
    made(model, 8.0, 40.0, 9.0).unwrap()
}

fn made(
    model: &Press<'_>,
    torque: f32,
    deceleration: f32,
    limit: f32,
) -> Result<LookAhead<f32, 32>, AxisError> {
    let period = period(model);
    let braking = Braking {
        torque,
        deceleration,
        helped: true,
    };
    LookAhead::new(model, Direction::Forward, braking, |_| limit, &period)
}

fn governed(model: &Press<'_>, motion: MotionState<f32>, commanded: f32) -> Becomes {
    let ahead = ahead(model);
    let governed = Governor::one_way(&ahead).govern(&limits(model), model, &motion, commanded);
    let range = limits(model).feasible(model, motion.phase, motion.omega);
    let [least, greatest] = [range.least.alpha, range.greatest.alpha];
    assert!(
        (least..=greatest).contains(&governed.alpha),
        "{governed:?} {range:?}"
    );
    // A value that is not finite either makes a limit active or is flagged.
    flagged(
        governed.unkept.is_some() || governed.by.is_some(),
        &[governed.alpha],
    )
}

fn gearbox(model: &Press<'_>, gearbox: [f32; 3]) -> Result<Transmission<f32>, AxisError> {
    Transmission::new(geared(gearbox), model)
}

/// Ratio, efficiency, rotor inertia (kg·m²).
const GEARBOX: [f32; 3] = [8.0, 0.9, 0.002];

fn geared([ratio, efficiency, rotor]: [f32; 3]) -> Gearbox {
    Gearbox {
        ratio,
        efficiency,
        rotor,
    }
}

const STROKE: Domain = Domain::Stroke { from: 0.0, to: 0.5 };
const SCALED: StrokeMounting = StrokeMounting {
    resolution: 1e-6,
    homing_offset: 0,
    home_position: 0.0,
};

fn followed(model: &Press<'_>, period: f32, ramp: f32) -> Becomes {
    let plan = Plan::from_bytes(include_image!("../../examples/data/press_plan.jred"), model);
    refused(PlanFollower::new(plan.unwrap(), period, ramp, model))
}

fn knot([t, position, omega, before, after]: [f64; 5]) -> Knot {
    Knot {
        t,
        position,
        omega,
        alpha: [before, after],
    }
}

fn encoded(knot: Knot, errors: Errors) -> Becomes {
    let mut words = [0; image_len(3)];
    let rest = |t| Knot {
        t,
        ..Knot::default()
    };
    refused(encode(
        &[rest(0.0), knot, rest(2.0)],
        STROKE,
        7,
        errors,
        &mut words,
    ))
}

fn checked(model: &Press<'_>, omega: f32, alpha: f32, friction: FrictionSign<f32>) -> Becomes {
    let feed_forward = FeedForward::new(*model, VALIDITY);
    let found = feed_forward.at_reference(motion(omega, alpha), friction);
    flagged(!found.status.is_valid(), &[found.torque])
}

fn measured(
    model: &Press<'_>,
    omega: f32,
    reference: MotionState<f32>,
    friction: FrictionSign<f32>,
) -> Becomes {
    let feed_forward = FeedForward::new(*model, VALIDITY);
    let found = feed_forward.at_measured(Phase::default(), omega, reference, friction);
    flagged(!found.status.is_valid(), &[found.torque])
}

fn nearest(omega: f32, alpha: f32, friction: FrictionSign<f32>) -> Becomes {
    let range = MotionRange::<f32>::new(VALIDITY, &Scale::SI);
    let (motion, friction) = range.nearest(motion(omega, alpha), friction);
    let (FrictionSign::OfSpeed(x) | FrictionSign::Scaled(x)) = friction;
    carried(&[motion.omega, motion.alpha, x])
}

fn status(omega: f32, alpha: f32) -> Becomes {
    let range = MotionRange::<f32>::new(VALIDITY, &Scale::SI);
    flagged(!range.status(omega, alpha).is_valid(), &[])
}

/// A range no wider than the known one.
fn ranged(omega: f32, alpha: f32) -> Becomes {
    let validity = Validity {
        max_speed: omega,
        max_acceleration: alpha,
        torque_error: 0.0,
    };
    let range = MotionRange::<f32>::new(validity, &Scale::SI);
    assert!(!range.status(f32::INFINITY, f32::NAN).is_valid());
    carried(&[range.max_speed(), range.max_acceleration()])
}

fn seen(model: &Press<'_>, torque: f32, friction: FrictionSign<f32>) -> Becomes {
    let mut observer = Observer::with_bandwidth(50.0, 0.001, model).unwrap();
    let found = observer.update(model, Phase::default(), torque, friction);
    flagged(
        found.limited,
        &[found.load, found.motion.omega, found.motion.alpha],
    )
}

fn monitor(
    model: &Press<'_>,
    largest: f32,
    false_alarm: f32,
    payload: f32,
) -> Result<Monitor<f32, 8>, AxisError> {
    let watch = Watch {
        largest,
        reference: 32,
        cycles: 1000,
        false_alarm,
    };
    let first = |phase: Phase| phase.to_bits() < 1 << 31;
    Monitor::new(watch, |at| if first(at) { payload } else { 0.0 }, model)
}

type Identified = Identification<f32, 4, 256, SET>;

const IDENTIFIED: IdentificationSettings = IdentificationSettings {
    period: 0.001,
    max_speed: 14.0,
    inertia: 1.0,
    torque_delay: 0.0,
    torque_noise: 0.1,
    angle_noise: 0.001,
    memory: 10.0,
};

/// Each function with NaN in one of its arguments, or in all; infinity has the same result as NaN, or acts as a limit.
const CASES: &[Case] = &[
    ("MotionRange::new", Finite, |_, x| ranged(x, 1.0)),
    ("MotionRange::new", Finite, |_, x| ranged(1.0, x)),
    ("MotionRange::status", Flagged, |_, x| status(x, 1.0)),
    ("MotionRange::status", Flagged, |_, x| status(1.0, x)),
    ("MotionRange::nearest", Finite, |_, x| {
        nearest(x, x, FrictionSign::OfSpeed(x))
    }),
    ("MotionRange::nearest", Finite, |_, x| {
        nearest(x, x, FrictionSign::Scaled(x))
    }),
    ("FeedForward::new", Flagged, |m, x| {
        let validity = Validity {
            max_speed: x,
            max_acceleration: x,
            torque_error: 0.0,
        };
        let feed_forward = FeedForward::new(*m, validity);
        let found = feed_forward.at_reference(motion(f32::NAN, 1.0), FrictionSign::Scaled(0.0));
        flagged(!found.status.is_valid(), &[])
    }),
    ("FeedForward::status", Flagged, |m, x| {
        flagged(
            !FeedForward::new(*m, VALIDITY).status(x, 0.0).is_valid(),
            &[],
        )
    }),
    ("FeedForward::at_reference", Flagged, |m, x| {
        checked(m, x, 1.0, FrictionSign::OfSpeed(1.0))
    }),
    ("FeedForward::at_reference", Flagged, |m, x| {
        checked(m, 1.0, x, FrictionSign::OfSpeed(1.0))
    }),
    ("FeedForward::at_reference", Flagged, |m, x| {
        checked(m, 1.0, 1.0, FrictionSign::OfSpeed(x))
    }),
    ("FeedForward::at_reference", Flagged, |m, x| {
        checked(m, 1.0, 1.0, FrictionSign::Scaled(x))
    }),
    ("FeedForward::at_reference", Flagged, |m, x| {
        let ramp = FrictionRamp::new(0.5, m).unwrap();
        checked(m, x, x, ramp.at(x))
    }),
    ("FeedForward::at_measured", Flagged, |m, x| {
        measured(m, x, motion(1.0, 1.0), FrictionSign::Scaled(0.5))
    }),
    ("FeedForward::at_measured", Flagged, |m, x| {
        measured(m, 1.0, motion(x, 1.0), FrictionSign::Scaled(0.5))
    }),
    ("FeedForward::at_measured", Flagged, |m, x| {
        measured(m, 1.0, motion(x, 1.0), FrictionSign::OfSpeed(1.0))
    }),
    ("FeedForward::at_measured", Flagged, |m, x| {
        measured(m, 1.0, motion(1.0, x), FrictionSign::Scaled(0.5))
    }),
    ("FeedForward::at_measured", Flagged, |m, x| {
        measured(m, 1.0, motion(1.0, 1.0), FrictionSign::Scaled(x))
    }),
    ("FeedForward::at_measured", Flagged, |m, x| {
        measured(m, 1.0, motion(1.0, 1.0), FrictionSign::OfSpeed(x))
    }),
    ("FeedForward::at_measured", Flagged, |m, x| {
        // The ramp drops the value that the status detects in the set-point.
        let ramp = FrictionRamp::new(0.5, m).unwrap();
        measured(m, 1.0, motion(x, 1.0), ramp.at(x))
    }),
    ("FrictionRamp::new", Refused, |m, x| {
        refused(FrictionRamp::new(x, m))
    }),
    (
        "FrictionRamp::at",
        Finite,
        |m, x| match FrictionRamp::new(0.5, m).unwrap().at(x) {
            FrictionSign::Scaled(share) => carried(&[share]),
            FrictionSign::OfSpeed(omega) => carried(&[omega]),
        },
    ),
    ("TorqueLimits::new", Refused, |_, x| {
        // An infinite limit means no limit.
        if x.is_nan() {
            refused(TorqueLimits::new(x, 1.0)).max(refused(TorqueLimits::new(-1.0, x)))
        } else {
            assert!(TorqueLimits::new(-1.0, x.abs()).is_ok());
            Refused
        }
    }),
    ("TorqueLimits::limited", Flagged, |_, x| {
        let found = TorqueLimits::new(-2.0, 5.0).unwrap().limited(x);
        flagged(found.clipped != 0.0, &[found.torque])
    }),
    ("Transmission::new", Refused, |m, x| {
        refused(gearbox(m, [x, 0.9, 0.002]))
    }),
    ("Transmission::new", Refused, |m, x| {
        refused(gearbox(m, [8.0, x, 0.002]))
    }),
    ("Transmission::new", Refused, |m, x| {
        refused(gearbox(m, [8.0, 0.9, x]))
    }),
    ("Transmission::to_torque", Carried, |m, x| {
        carried(&[gearbox(m, GEARBOX).unwrap().to_torque(x).value])
    }),
    ("Transmission::torque_si", Carried, |m, x| {
        carried(&[gearbox(m, GEARBOX).unwrap().torque_si(x)])
    }),
    ("Transmission::motor", Carried, |m, x| {
        carried(&[gearbox(m, GEARBOX).unwrap().motor(x, 1.0, 1.0).value])
    }),
    ("Transmission::motor", Carried, |m, x| {
        carried(&[gearbox(m, GEARBOX).unwrap().motor(1.0, 1.0, x).value])
    }),
    ("Transmission::motor", Finite, |m, x| {
        carried(&[gearbox(m, GEARBOX).unwrap().motor(1.0, x, 1.0).value])
    }),
    ("Period::new", Refused, |m, x| refused(Period::new(x, m))),
    ("Period::moved", Finite, |m, x| {
        let moved = period(m).moved(x);
        assert!(!x.is_nan() || moved == Phase::default());
        Finite
    }),
    ("Period::gained", Carried, |m, x| {
        carried(&[period(m).gained(x).value])
    }),
    ("Period::needed", Carried, |m, x| {
        carried(&[period(m).needed(x).value])
    }),
    ("Period::later", Carried, |m, x| {
        carried(&[period(m).later(motion(x, 1.0)).value.omega])
    }),
    ("Period::later", Carried, |m, x| {
        carried(&[period(m).later(motion(1.0, x)).value.omega])
    }),
    ("Period::between", Carried, |m, x| {
        let found = period(m).between(Phase::default(), x, 1.0).value;
        assert!(!found.omega.is_finite() && !found.alpha.is_finite());
        Carried
    }),
    ("Period::between", Carried, |m, x| {
        carried(&[period(m).between(Phase::default(), 1.0, x).value.omega])
    }),
    ("Tracker::new", Refused, |_, x| refused(Tracker::new(x))),
    ("Tracker::with_bandwidth", Refused, |_, x| {
        refused(Tracker::with_bandwidth(x, 0.001))
    }),
    ("Tracker::with_bandwidth", Refused, |_, x| {
        refused(Tracker::with_bandwidth(50.0, x))
    }),
    ("Observer::with_bandwidth", Refused, |m, x| {
        refused(Observer::<f32>::with_bandwidth(x, 0.001, m))
            .max(refused(Observer::<f32>::with_bandwidth(50.0, x, m)))
    }),
    ("Observer::update", Flagged, |m, x| {
        seen(m, x, FrictionSign::OfSpeed(1.0))
    }),
    ("Observer::update", Flagged, |m, x| {
        seen(m, 1.0, FrictionSign::Scaled(x))
    }),
    ("Observer::update", Flagged, |m, x| {
        // Infinity is a speed in that direction.
        let sign = if x.is_nan() { x } else { f32::NAN };
        seen(m, 1.0, FrictionSign::OfSpeed(sign))
    }),
    ("Identification::new", Refused, |_, x| {
        let good = IDENTIFIED;
        // Infinity: never forget.
        let memory = if x > 0.0 { f32::NAN } else { x };
        [
            IdentificationSettings { period: x, ..good },
            IdentificationSettings {
                max_speed: x,
                ..good
            },
            IdentificationSettings { inertia: x, ..good },
            IdentificationSettings {
                torque_delay: x,
                ..good
            },
            IdentificationSettings {
                torque_noise: x,
                ..good
            },
            IdentificationSettings {
                angle_noise: x,
                ..good
            },
            IdentificationSettings { memory, ..good },
        ]
        .map(|settings| refused(Identified::new(&settings, &[])))
        .into_iter()
        .fold(Refused, Becomes::max)
    }),
    ("Identification::add", Flagged, |_, x| {
        let mut identified = Identified::new(&IDENTIFIED, &[]).unwrap();
        let added = identified.add(Phase::default(), x);
        let found = identified.equations().solve();
        flagged(added == Sampled::NotFinite, &found.coefficients)
    }),
    ("Payload::new", Refused, |m, x| {
        let observer = Observer::with_bandwidth(50.0, 0.001, m).unwrap();
        refused(Payload::new(x, 1000, &observer, m))
    }),
    ("Payload::update", Finite, |m, x| {
        let observer = Observer::with_bandwidth(50.0, 0.001, m).unwrap();
        let mut payload = Payload::new(10.0, 1000, &observer, m).unwrap();
        for k in 0..100u8 {
            payload.update(f32::from(k), f32::from(k));
        }
        payload.update(x, 1.0);
        payload.update(1.0, x);
        carried(&[payload.estimate().payload, payload.estimate().offset])
    }),
    ("Monitor::new", Refused, |m, x| {
        refused(monitor(m, x, 0.01, 1.0))
            .max(refused(monitor(m, 10.0, x, 1.0)))
            .max(refused(monitor(m, 10.0, 0.01, x)))
    }),
    ("Monitor::with_reference", Refused, |m, x| {
        let watch = Watch {
            largest: x,
            reference: 32,
            cycles: 1000,
            false_alarm: 0.01,
        };
        // Numbers of cycles that are not finite, and a largest torque.
        let mut words = [0; Monitor::<f32, 8>::REFERENCE_WORDS];
        [words[0], words[1], words[3]] = [1, 10.0f32.to_bits(), x.to_bits()];
        let of = |watch| Monitor::<f32, 8>::with_reference(&words, watch, |_| 1.0, m);
        refused(of(watch)).max(refused(of(Watch {
            largest: 10.0,
            ..watch
        })))
    }),
    ("Monitor::tick", Flagged, |m, x| {
        // Infinity is a torque beyond the largest one.
        let mut monitor = monitor(m, 10.0, 0.01, 1.0).unwrap();
        let seen = monitor.tick(Phase::default(), if x.is_nan() { x } else { f32::NAN });
        flagged(seen == Seen::Invalid, &[])
    }),
    ("StrokeEncoder::new", Refused, |_, x| {
        refused(StrokeEncoder::new(
            STROKE,
            StrokeMounting {
                resolution: x.into(),
                ..SCALED
            },
        ))
    }),
    ("StrokeEncoder::new", Refused, |_, x| {
        refused(StrokeEncoder::new(
            STROKE,
            StrokeMounting {
                home_position: x.into(),
                ..SCALED
            },
        ))
    }),
    ("StrokeEncoder::new", Refused, |_, x| {
        refused(StrokeEncoder::new(
            Domain::Stroke { from: x, to: 0.5 },
            SCALED,
        ))
    }),
    ("StrokeEncoder::new", Refused, |_, x| {
        refused(StrokeEncoder::new(
            Domain::Stroke { from: 0.0, to: x },
            SCALED,
        ))
    }),
    ("Envelope::new", Refused, |m, x| {
        refused(Envelope::new([[x, 8.0]], 8.0, m))
    }),
    ("Envelope::new", Refused, |m, x| {
        refused(Envelope::new([[12.0, x]], 8.0, m))
    }),
    ("Envelope::new", Refused, |m, x| {
        refused(Envelope::new([[12.0, 8.0]], x, m))
    }),
    ("Envelope::of_motor", Refused, |m, x| {
        let gearbox = geared([8.0, 0.9, 0.0]);
        refused(Envelope::of_motor([[x, 8.0]], 8.0, gearbox, m))
            .max(refused(Envelope::of_motor([[12.0, x]], 8.0, gearbox, m)))
            .max(refused(Envelope::of_motor([[12.0, 8.0]], x, gearbox, m)))
            .max(refused(Envelope::of_motor(
                [[12.0, 8.0]],
                8.0,
                geared([x, 0.9, 0.0]),
                m,
            )))
    }),
    ("Envelope::torques", Finite, |m, x| {
        let torques = limits(m).envelope().torques(x);
        assert!(!x.is_nan() || torques.map(f32::to_bits) == [0; 2]);
        carried(&torques)
    }),
    ("Limits::new", Refused, |m, x| {
        let (envelope, period) = (*limits(m).envelope(), *limits(m).period());
        refused(Limits::new(envelope, x, 40.0, period, m))
            .max(refused(Limits::new(envelope, 10.0, x, period, m)))
    }),
    ("Limits::feasible", Flagged, |m, x| {
        let found = limits(m).feasible(m, Phase::default(), x);
        flagged(
            found.unkept.is_some(),
            &[found.least.alpha, found.greatest.alpha],
        )
    }),
    ("LookAhead::new", Refused, |m, x| {
        refused(made(m, x, 40.0, 9.0)).max(refused(made(m, 8.0, 40.0, x)))
    }),
    ("LookAhead::new", Refused, |m, x| {
        // An infinite deceleration means that only the torque limits it.
        if x == f32::INFINITY {
            Refused
        } else {
            refused(made(m, 8.0, x, 9.0))
        }
    }),
    ("LookAhead::speed_at", Carried, |m, x| {
        carried(&[ahead(m).speed_at(Phase::default(), x)])
    }),
    ("LookAhead::stop", Flagged, |m, x| {
        flagged(ahead(m).stop(Phase::default(), x).beyond, &[])
    }),
    ("Governor::govern", Flagged, |m, x| {
        governed(m, motion(x, 0.0), 1.0)
    }),
    ("Governor::govern", Flagged, |m, x| {
        governed(m, motion(1.0, 0.0), x)
    }),
    ("Governor::govern", Flagged, |m, x| {
        governed(m, motion(x, x), x)
    }),
    ("PlanFollower::new", Refused, |m, x| followed(m, x, 0.1)),
    ("PlanFollower::new", Refused, |m, x| followed(m, 0.001, x)),
    // An infinite ramp has a meaning: no ramp satisfies the torque limit.
    ("with_ramp", Refused, |_, x| {
        let end = Knot {
            t: 1.0,
            ..Knot::default()
        };
        let mut words = [0; image_len(2)];
        let knots = [Knot::default(), end];
        encode(&knots, STROKE, 7, Errors::default(), &mut words).unwrap();
        refused(with_ramp(&mut words, -x.abs()))
    }),
    ("encode", Refused, |_, x| {
        let x = f64::from(x);
        let time = encoded(knot([x, 0.0, 0.0, 0.0, 0.0]), Errors::default());
        let others = [
            [1.0, x, 0.0, 0.0, 0.0],
            [1.0, 0.0, x, 0.0, 0.0],
            [1.0, 0.0, 0.0, x, 0.0],
            [1.0, 0.0, 0.0, 0.0, x],
        ];
        let others = others.map(|values| encoded(knot(values), Errors::default()));
        others.into_iter().fold(time, Becomes::max)
    }),
];

impl Becomes {
    /// The first result other than `Refused` counts.
    fn max(self, other: Self) -> Self {
        if self == Refused { other } else { self }
    }
}

#[test]
fn no_function_takes_what_is_no_number_in_silence() {
    with_model::<Spline<f32>, SET>(Scale::SI, |model| {
        for (name, expected, found) in CASES {
            for x in [f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
                assert_eq!(found(&model, x), *expected, "{name} {x}");
            }
        }
    });
}

/// Every function of the axis is listed above, or takes no floating-point number.
#[test]
fn every_function_of_the_axis_is_tried() {
    // Bytes, counts, phases, and values made from them.
    const WITHOUT: &[&str] = &[
        "Status::is_valid",
        "MotionRange::max_speed",
        "MotionRange::max_acceleration",
        "ImageSlot",
        "image_len",
        "Plan::new",
        "Plan::from_bytes",
        "Plan::of_machine",
        "Plan::least_ramp",
        "Plan::machine",
        "Plan::errors",
        "Plan::max_speed",
        "Plan::max_acceleration",
        "Plan::rows",
        "Plan::duration",
        "Plan::end",
        "Plan::at",
        "LookAhead::direction",
        "Period::omega",
        "Period::alpha",
        "Governor::one_way",
        "Governor::both_ways",
        "Identification::gap",
        "Identification::equations",
        "Identification::adopt",
        "Equations::solve",
        "Found::words",
        "Found::inertia",
        "Observer::at",
        "Observer::with_largest_step",
        "Observer::memory",
        "Payload::restart",
        "Payload::estimate",
        "Monitor::end_cycle",
        "Monitor::is_watching",
        "Monitor::reference",
        "Monitor::usual",
        "Counter",
        "Mounting",
        "Encoder",
        "Limits::envelope",
        "Limits::period",
        "Tracker::with_largest_step",
        "Tracker::at",
        "Tracker::update",
        "Tracker::update_stroke",
        "Transmission::base",
        "Override::percent",
        "PlanFollower::repeating",
        "PlanFollower::plan",
        "PlanFollower::start",
        "PlanFollower::reset",
        "PlanFollower::next",
        "FeedForward::model",
        "FeedForward::range",
        "StrokeEncoder::phase",
        "StrokeEncoder::phase_wide",
    ];
    let mut all = BTreeSet::new();
    public_of(
        &Path::new(env!("CARGO_MANIFEST_DIR")).join("src/axis"),
        &mut all,
    );
    let tried: BTreeSet<&str> = CASES.iter().map(|(name, ..)| *name).collect();
    for function in &all {
        let of = function.split("::").next().unwrap();
        let without = WITHOUT.contains(&function.as_str()) || WITHOUT.contains(&of);
        assert!(
            without != tried.contains(function.as_str()),
            "{function}: tried, or without a number"
        );
    }
    assert!(tried.iter().all(|name| all.contains(*name)), "{tried:?}");
}
