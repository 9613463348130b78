//! The link gate of `no_panic` for the layer `axis`, between an encoder and a torque command. A separate program, because both together do not fit
//! into the flash of the smallest board.
#![cfg_attr(target_os = "none", no_std, no_main)]

use core::hint::black_box;

use jred::axis::monitor::{Monitor, Watch};
use jred::axis::plan::{Errors, Knot, encode, image_len, with_ramp};
use jred::axis::{
    Braking, Counter, Direction, Encoder, Envelope, Equations, FeedForward, Found, FrictionRamp,
    Gearbox, Governor, Identification, IdentificationSettings, ImageSlot, Limits, LookAhead,
    MotionRange, MotionState, Mounting, Observer, Override, Payload, Period, Plan, PlanFollower,
    Status, StrokeEncoder, StrokeMounting, TorqueLimits, Tracker, Transmission,
};
use jred::harmonic::terms;
use jred::image::ImageCheck;
use jred::number::FrictionSign;
use jred::table::{AccelerationOf, Format, SpeedOf, TorqueOf};
use jred::{
    CurveSet, Domain, Image, ImageError, Model, Phase, Q31, Rows16, Spline, curves, include_image,
};

#[cfg(target_os = "none")]
#[path = "support/gate.rs"]
mod gate;

/// The curves of the press, as `jred export` prints them.
const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;

/// All calls of firmware, with arguments unknown to the optimiser; or only a panic.
fn calls() -> Result<(), ImageError> {
    if cfg!(gate_panic) {
        black_box([1, 2, 3][black_box(1usize)]);
        return Ok(());
    }
    let (float, fixed) = (
        include_image!("data/press_f32.jred"),
        include_image!("data/press_q31.jred"),
    );
    every_axis::<Spline<f32>, PRESS>(float)?;
    every_axis::<Spline<Q31>, PRESS>(fixed)?;
    let _ = black_box(every_axis::<Rows16, PRESS>(fixed));
    every_slot(float);
    every_identification();
    every_encoder();
    if cfg!(gate_double) {
        every_double();
    }
    Ok(())
}

/// The parts between an encoder and a torque command.
fn every_axis<F: Format, const SET: CurveSet>(bytes: &'static [u8]) -> Result<(), ImageError> {
    let image = Image::from_bytes(black_box(bytes))?;
    let model = Image::model::<F, SET>(&image)?;
    let feed_forward = FeedForward::new(model, Image::validity(&image));
    let model = FeedForward::model(&feed_forward);
    let (phase, omega, alpha) = black_box(<(Phase, SpeedOf<F>, AccelerationOf<F>)>::default());
    let mut friction = FrictionSign::OfSpeed(black_box(omega));
    if let Ok(ramp) = FrictionRamp::new(black_box(0.1), model) {
        friction = FrictionRamp::at(&ramp, omega);
    }
    let mut motion = MotionState {
        phase,
        omega,
        alpha,
    };
    if let Ok(time) = Period::new(black_box(1e-4), model) {
        let mut tracker = Tracker::new(black_box(0.9)).map(|tracker| Tracker::at(tracker, phase));
        if let Ok(tracker) = &mut tracker {
            *tracker = Tracker::with_largest_step(*tracker, black_box(phase));
            black_box(Tracker::update_stroke(tracker, phase));
            let tracked = Tracker::update(tracker, phase);
            motion.omega = Period::omega(&time, tracked).value;
            motion.alpha = Period::alpha(&time, tracked).value;
        }
        black_box(Tracker::with_bandwidth(black_box(50.0), black_box(1e-4)).is_ok());
        motion.phase = motion.phase + Period::moved(&time, omega);
        black_box((Period::gained(&time, alpha), Period::needed(&time, omega)));
        black_box(Period::between(&time, phase, omega, motion.omega));
        motion = Period::later(&time, motion).value;
    }
    let checked = FeedForward::at_reference(&feed_forward, motion, friction);
    let range = FeedForward::range(&feed_forward);
    black_box(MotionRange::nearest(range, motion, friction));
    black_box(MotionRange::status(range, omega, alpha));
    black_box((
        MotionRange::max_speed(range),
        MotionRange::max_acceleration(range),
    ));
    let scale = model.table().scale();
    let made: MotionRange<F::Number> = MotionRange::new(Image::validity(&image), scale);
    black_box(made);
    black_box(FeedForward::at_measured(
        &feed_forward,
        phase,
        omega,
        motion,
        friction,
    ));
    black_box(Status::is_valid(FeedForward::status(
        &feed_forward,
        omega,
        alpha,
    )));
    black_box(Model::torque_with(model, phase, omega, alpha, friction));
    black_box(Model::torque_terms(model, phase, omega, alpha, friction));
    let gearbox = black_box(Gearbox {
        ratio: 10.0,
        efficiency: 0.9,
        rotor: 0.001,
    });
    if let Ok(gearbox) = Transmission::new(gearbox, model) {
        black_box(Transmission::base(&gearbox));
        let torque = Transmission::motor(&gearbox, checked.torque, omega, alpha).value;
        black_box(Transmission::torque_si(&gearbox, torque));
        let most = Transmission::to_torque(&gearbox, black_box(10.0)).value;
        if let Ok(limits) = TorqueLimits::new(black_box(torque), black_box(most)) {
            black_box(TorqueLimits::limited(&limits, torque));
        }
    }
    every_limit(model, motion);
    every_observer(model, friction);
    every_plan(model);
    Ok(())
}

/// The observer and all that uses its load.
fn every_observer<F: Format, const SET: CurveSet>(
    model: &Model<'_, F, SET>,
    friction: FrictionSign<F::Number>,
) {
    let (phase, torque) = black_box(<(Phase, TorqueOf<F>)>::default());
    let Ok(observer) = Observer::with_bandwidth(black_box(60.0), black_box(1e-3), model) else {
        return;
    };
    let observer = Observer::with_largest_step(observer, black_box(phase));
    let mut observer = Observer::at(observer, phase);
    black_box(Observer::memory(&observer));
    let seen = Observer::update(&mut observer, model, phase, torque, friction);
    if let Ok(payload) = &mut Payload::new(black_box(50.0), black_box(1000), &observer, model) {
        Payload::update(payload, seen.load, torque);
        black_box(Payload::estimate(payload));
        Payload::restart(payload);
    }
    let watch = black_box(Watch {
        largest: 50.0,
        reference: 32,
        cycles: 10_000,
        false_alarm: 0.001,
    });
    let mut monitor: Result<Monitor<F::Number, 16>, _> =
        Monitor::new(watch, |at| black_box(at.to_bits() as f32), model);
    if let Ok(monitor) = &mut monitor {
        black_box(Monitor::tick(monitor, seen.motion.phase, seen.load));
        black_box(Monitor::end_cycle(monitor));
        black_box((
            Monitor::is_watching(monitor),
            Monitor::usual(monitor, phase),
        ));
        let mut words = [0; 57];
        if let Some(reference) = Monitor::reference(monitor) {
            for (word, learned) in words.iter_mut().zip(reference) {
                *word = learned;
            }
        }
        let restored: Result<Monitor<F::Number, 16>, _> =
            Monitor::with_reference(black_box(&words), watch, |_| 0.0, model);
        let _ = black_box(restored);
    }
}

/// The identification: its tick, and its background.
fn every_identification() {
    const SET: CurveSet = PRESS | terms::SYMMETRIC;
    let settings = black_box(IdentificationSettings {
        period: 1e-3,
        max_speed: 14.0,
        inertia: 0.5,
        torque_delay: 1e-3,
        torque_noise: 0.1,
        angle_noise: 1e-4,
        memory: 100.0,
    });
    let made: Result<Identification<f32, 8, 64, SET>, _> =
        Identification::new(&settings, black_box(&[36]));
    let Ok(mut identification) = made else {
        return;
    };
    let (phase, torque) = black_box((Phase::default(), 1.0));
    black_box(Identification::add(&mut identification, phase, torque));
    Identification::gap(&mut identification);
    let found = Equations::solve(&Identification::equations(&identification));
    Identification::adopt(&mut identification, &found);
    black_box((Found::inertia(&found, phase), Found::words(&found)));
}

/// A plan and its follower.
fn every_plan<F: Format, const SET: CurveSet>(model: &Model<'_, F, SET>) {
    if let Ok(plan) = Plan::new(black_box(&[0; 41]), model) {
        black_box(Plan::rows(&plan));
    }
    let Ok(plan) = Plan::from_bytes(black_box(include_image!("data/press_plan.jred")), model)
    else {
        return;
    };
    black_box((Plan::machine(&plan), Plan::errors(&plan)));
    black_box((Plan::max_speed(&plan), Plan::max_acceleration(&plan)));
    black_box((Plan::duration(&plan), Plan::end(&plan)));
    black_box(Plan::least_ramp(&plan));
    black_box(Plan::at(&plan, black_box(1 << 38)));
    let Ok(plan) = Plan::of_machine(plan, black_box(1)) else {
        return;
    };
    let Ok(mut follower) = PlanFollower::new(plan, black_box(1e-3), black_box(0.1), model) else {
        return;
    };
    if let Ok(repeating) = PlanFollower::repeating(follower) {
        follower = repeating;
    }
    PlanFollower::start(&mut follower);
    black_box(PlanFollower::next(
        &mut follower,
        Override::percent(black_box(50)),
    ));
    PlanFollower::reset(&mut follower);
    black_box(PlanFollower::plan(&follower));
}

/// The limits of a drive, now and ahead.
fn every_limit<F: Format, const SET: CurveSet>(
    model: &Model<'_, F, SET>,
    motion: MotionState<F::Number>,
) {
    let points = black_box([[6.0, 80.0], [12.0, 20.0]]);
    let gearbox = black_box(Gearbox {
        ratio: 1.0,
        efficiency: 0.9,
        rotor: 0.0,
    });
    let Ok(period) = Period::new(black_box(1e-3), model) else {
        return;
    };
    for envelope in [
        Envelope::new(points, black_box(60.0), model),
        Envelope::of_motor(points, black_box(60.0), gearbox, model),
    ]
    .into_iter()
    .flatten()
    {
        black_box(Envelope::torques(&envelope, motion.omega));
        let Ok(limits) = Limits::new(envelope, black_box(10.0), black_box(50.0), period, model)
        else {
            continue;
        };
        black_box((Limits::envelope(&limits), Limits::period(&limits)));
        black_box(Limits::feasible(&limits, model, motion.phase, motion.omega));
        let braking = black_box(Braking {
            torque: 60.0,
            deceleration: 50.0,
            helped: true,
        });
        let ahead = |direction| {
            let limit = |_| black_box(10.0);
            let made: Result<LookAhead<F::Number, 16>, _> =
                LookAhead::new(model, direction, braking, limit, &period);
            made
        };
        let [Ok(forward), Ok(backward)] =
            black_box([Direction::Forward, Direction::Backward]).map(ahead)
        else {
            continue;
        };
        black_box(LookAhead::direction(&forward));
        black_box(LookAhead::speed_at(&forward, motion.phase, black_box(10.0)));
        black_box(LookAhead::stop(&forward, motion.phase, motion.omega));
        let mut governor = Governor::one_way(&forward);
        if let Ok(both) = Governor::both_ways(&forward, &backward) {
            governor = both;
        }
        black_box(Governor::govern(
            &governor,
            &limits,
            model,
            &motion,
            motion.omega,
        ));
    }
    let friction = FrictionSign::OfSpeed(motion.omega);
    let [least, greatest] = black_box([TorqueOf::<F>::default(); 2]);
    black_box(Model::acceleration_with(
        model,
        motion.phase,
        motion.omega,
        friction,
        least,
    ));
    black_box(Model::acceleration_range_with(
        model,
        motion.phase,
        motion.omega,
        friction,
        least,
        greatest,
    ));
}

/// An image that is exchanged while the machine runs.
fn every_slot(bytes: &'static [u8]) {
    let mut memory = black_box([0; 600]);
    let mut slot: ImageSlot<'_, Spline<f32>, PRESS> = ImageSlot::new(&mut memory);
    slot = ImageSlot::for_machine(slot, black_box(0));
    let received = ImageSlot::receive(&mut slot, black_box(bytes)).is_ok();
    let verdict = ImageSlot::check(&mut slot, black_box(16));
    if let Some(feed_forward) = ImageSlot::feed_forward(&slot) {
        black_box(FeedForward::status(&feed_forward, 1.0, 1.0));
    }
    black_box((received, verdict.is_some(), ImageSlot::validity(&slot)));
    ImageSlot::clear(&mut slot);
    let mut check = ImageCheck::new(black_box(&[0; 30]));
    black_box(ImageCheck::advance(&mut check, black_box(16)).is_some());
}

fn every_encoder() {
    let mut counter: Counter<16> = Counter::at(black_box(5));
    let wide = Counter::extend(&mut counter, black_box(7));
    if let Ok(encoder) = Encoder::new(black_box(Mounting::direct(10_000))) {
        black_box((
            Encoder::phase(&encoder, black_box(1)),
            Encoder::phase_wide(&encoder, wide),
        ));
    }
}

/// Functions in double precision.
fn every_double() {
    let scaled = black_box(StrokeMounting {
        resolution: 1e-6,
        homing_offset: 0,
        home_position: 0.0,
    });
    let stroke = black_box(Domain::Stroke { from: 0.0, to: 0.5 });
    if let Ok(encoder) = StrokeEncoder::new(stroke, scaled) {
        black_box(StrokeEncoder::phase(&encoder, black_box(1)));
        black_box(StrokeEncoder::phase_wide(&encoder, black_box(1)));
    }
    let mut words = [0; image_len(3)];
    let written = encode(
        black_box(&[Knot::default(); 3]),
        stroke,
        black_box(7),
        black_box(Errors::default()),
        &mut words,
    );
    black_box(written.is_ok());
    black_box(with_ramp(&mut words, black_box(0.1)).is_ok());
}

#[cfg(not(target_os = "none"))]
fn main() -> Result<(), ImageError> {
    calls()
}

#[cfg(target_os = "none")]
#[cortex_m_rt::entry]
fn main() -> ! {
    gate::end(calls().is_ok())
}
