use core::f64::consts::TAU;

use jred::axis::monitor::{Cycle, Monitor, Seen, Watch};
use jred::axis::{Observed, Observer};
use jred::machine::Reducible as _;
use jred::number::FrictionSign;
use jred::table::Format;
use jred::{CurveSet, Model, Phase, Q31, Scale, Spline, curves};

use super::machine::with_model_of;
use super::watched::{CRANK, OMEGA, PAYLOAD, Plant, TICK, bases, machine, peak};
use crate::support::assert_near;

const SET: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;
const BINS: usize = 64;

const WATCH: Watch = Watch {
    largest: 50.0,
    reference: 32,
    cycles: 10_000,
    false_alarm: 0.001,
};

/// A machine with 10 % more load and friction than in its model, its observer and its monitor.
#[derive(Clone, Debug)]
struct Watched<'a, F: Format> {
    plant: Plant,
    model: Model<'a, F, SET>,
    observer: Observer<F::Number>,
    monitor: Monitor<F::Number, BINS>,
}

/// The change of the load by one unit of payload, in the motion of the reference.
fn unit(phase: Phase) -> f32 {
    let here = PAYLOAD.reduction(phase.radians()).unwrap();
    -here.torque(OMEGA, 0.0).total() as f32
}

impl<F: Format> Watched<'_, F> {
    fn tick(&mut self, load: f64) -> Seen {
        let seen = self.observe(load);
        assert!(!seen.limited);
        self.monitor.tick(seen.motion.phase, seen.load)
    }

    fn observe(&mut self, load: f64) -> Observed<F::Number> {
        let command = self.plant.command();
        let measured = self.plant.tick(command, load);
        let scale = self.model.table().scale();
        let friction = FrictionSign::OfSpeed(scale.omega(OMEGA as f32).value);
        let acted = scale.to_torque(command as f32).value;
        self.observer.update(&self.model, measured, acted, friction)
    }

    /// A turn; the ticks with an alarm, and the cycle.
    fn turn(&mut self) -> (u32, Cycle) {
        let jams = (0..1000).filter(|_| self.tick(0.0) == Seen::Jam).count();
        (jams as u32, self.monitor.end_cycle())
    }
}

/// After the reference cycles.
fn with_reference<F: Format>(scale: Scale, seed: u64, then: impl FnOnce(Watched<'_, F>)) {
    with_model_of::<F, SET>(&CRANK, scale, |model| {
        let plant = Plant::new(machine(0.0, 0.1), 0.01 * peak(), seed);
        let observer = Observer::with_bandwidth(60.0, TICK as f32, &model).unwrap();
        let monitor = Monitor::new(WATCH, unit, &model).unwrap();
        let mut watched = Watched {
            plant,
            model,
            observer,
            monitor,
        };
        for _ in 0..3000 {
            // The observer settles first.
            watched.observe(0.0);
        }
        for _ in 0..2 * WATCH.reference {
            assert!(!watched.monitor.is_watching());
            assert_eq!(watched.turn().0, 0);
        }
        assert!(watched.monitor.is_watching());
        then(watched);
    });
}

/// 10 % of the peak torque against the motion, from anywhere in the turn.
fn a_jam_is_seen<F: Format>(scale: Scale) {
    with_reference::<F>(scale, 1, |watched| {
        let jam = -0.1 * peak();
        let (mut most, mut least) = (0.0_f64, f64::INFINITY);
        for place in 0..72 {
            let mut watched = watched.clone();
            let from = TAU * f64::from(place) / 72.0;
            while (watched.plant.angle() - from).rem_euclid(TAU) > 0.01 {
                assert_eq!(watched.tick(0.0), Seen::Usual);
            }
            let start = watched.plant.angle();
            while watched.tick(jam) != Seen::Jam {}
            let way = (watched.plant.angle() - start).rem_euclid(TAU).to_degrees();
            most = most.max(way);
            least = least.min(way);
        }
        // The claim is 5°; a result that is suddenly much better fails too.
        assert!(most < 3.0 && least > 1.0, "{least} to {most}");
    });
}

#[test]
fn a_jam_is_seen_within_five_degrees() {
    a_jam_is_seen::<Spline<f32>>(Scale::SI);
    a_jam_is_seen::<Spline<Q31>>(bases());
}

fn without_alarm(cycles: u32) {
    with_reference::<Spline<f32>>(Scale::SI, 2, |mut watched| {
        let mut most = 0.0_f32;
        for k in 0..cycles {
            let (jams, cycle) = watched.turn();
            assert_eq!(jams, 0, "cycle {k}");
            assert!(
                cycle.judged && !cycle.wear && !cycle.wrong_payload,
                "{k}: {cycle:?}"
            );
            most = most.max(cycle.payload.abs());
        }
        assert!(most < 0.05, "{most}");
    });
}

#[test]
fn ten_thousand_cycles_have_no_false_alarm() {
    without_alarm(10_000);
}

/// Each fault is reported as what it is, after this number of cycles at most.
fn faults_are_told<F: Format>(scale: Scale) {
    with_reference::<F>(scale, 3, |watched| {
        let first = |change: &dyn Fn(&mut Plant),
                     is: &dyn Fn(&Cycle) -> bool,
                     other: &dyn Fn(&Cycle) -> bool| {
            let mut watched = watched.clone();
            change(&mut watched.plant);
            for cycles in 1..=200 {
                let (jams, cycle) = watched.turn();
                assert_eq!(jams, 0, "{cycle:?}");
                assert!(!other(&cycle), "{cycles}: {cycle:?}");
                if is(&cycle) {
                    return (cycles, cycle);
                }
            }
            panic!("not seen");
        };
        let wear = |cycle: &Cycle| cycle.wear;
        let payload = |cycle: &Cycle| cycle.wrong_payload;
        let (cycles, cycle) = first(&|plant| plant.machine.coulomb += 0.3, &wear, &payload);
        assert!(cycles <= 10, "{cycles}");
        assert_near("friction", cycle.friction.into(), -0.3, 0.06);
        let (cycles, _) = first(&|plant| plant.noise *= 1.3, &wear, &payload);
        assert!(cycles <= 30, "{cycles}");
        let (cycles, cycle) = first(&|plant| plant.load(0.2), &payload, &wear);
        assert!(cycles <= 10, "{cycles}");
        assert_near("payload", cycle.payload.into(), 0.2, 0.02);
    });
}

#[test]
fn faults_are_told_apart() {
    faults_are_told::<Spline<f32>>(Scale::SI);
    faults_are_told::<Spline<Q31>>(bases());
}

/// A monitor from the words of another is the same at the end of its reference, and watches at once.
fn the_reference_comes_back<F: Format>(scale: Scale) {
    with_reference::<F>(scale, 5, |mut watched| {
        let words: Vec<u32> = watched.monitor.reference().unwrap().collect();
        assert_eq!(words.len(), Monitor::<F::Number, BINS>::REFERENCE_WORDS);
        let make = |words: &[u32]| {
            Monitor::<F::Number, BINS>::with_reference(words, WATCH, unit, &watched.model)
        };
        let restored = make(&words).unwrap();
        assert!(restored == watched.monitor);
        let mut other = Watched {
            monitor: restored,
            ..watched.clone()
        };
        watched.plant.machine.coulomb += 0.1;
        other.plant.machine.coulomb += 0.1;
        for _ in 0..20 {
            let (seen, again) = (watched.turn(), other.turn());
            assert!(seen == again && seen.1.judged, "{seen:?} {again:?}");
        }
        assert!(watched.monitor == other.monitor);
    });
}

#[test]
fn a_reference_is_kept_bit_for_bit() {
    the_reference_comes_back::<Spline<f32>>(Scale::SI);
    the_reference_comes_back::<Spline<Q31>>(bases());
}

#[test]
fn references_that_no_monitor_writes_are_refused() {
    with_model_of::<Spline<f32>, SET>(&CRANK, Scale::SI, |model| {
        let mut monitor = Monitor::<f32, 2>::new(WATCH, |_| 0.0, &model).unwrap();
        assert!(monitor.reference().is_none());
        for _ in 0..2 * WATCH.reference {
            // The second bin has too few ticks.
            for torque in [1.0, 1.1] {
                monitor.tick(Phase::default(), torque);
            }
            monitor.end_cycle();
        }
        let words: Vec<u32> = monitor.reference().unwrap().collect();
        let make =
            |words: &[u32], watch| Monitor::<f32, 2>::with_reference(words, watch, |_| 0.0, &model);
        assert_eq!(make(&words, WATCH).unwrap(), monitor);
        let refused = |at: usize, word: u32| {
            let mut words = words.clone();
            words[at] = word;
            make(&words, WATCH).unwrap_err().to_string()
        };
        for (at, word, fault) in [
            (0, u32::MAX, "the version of the reference is more than"),
            (
                1,
                51.0_f32.to_bits(),
                "the largest torque of the reference is 51, but must be that of",
            ),
            (
                3,
                f32::NAN.to_bits(),
                "a figure of the reference's cycles is not a",
            ),
            (
                4,
                (-1.0_f32).to_bits(),
                "a figure of the reference's cycles is -1, but must be finite, and",
            ),
            (
                7,
                f32::INFINITY.to_bits(),
                "a figure of the reference's cycles is infinite",
            ),
            (
                10,
                1 << 22,
                "a mean of the reference, in counts, is 4194304, but must be at most",
            ),
            (
                11,
                0,
                "a deviation of the reference, in counts, is 0, but must be from 1 to",
            ),
            (
                11,
                f32::NAN.to_bits(),
                "a deviation of the reference, in counts, is not a finite number",
            ),
            (
                14,
                (-1.0_f32).to_bits(),
                "a deviation of the reference, in counts, is -1, but",
            ),
        ] {
            let error = refused(at, word);
            assert!(error.starts_with(fault), "{at}: {error}");
        }
        let short = make(&words[3..], WATCH).unwrap_err().to_string();
        assert_eq!(
            short,
            "the number of words of the reference is 12, but must be 9, and 3 for each bin"
        );
        assert!(make(&[], WATCH).is_err() && make(&[u32::MAX; 15], WATCH).is_err());
        let larger = Watch {
            largest: 60.0,
            ..WATCH
        };
        assert!(make(&words, larger).is_err());
    });
}

/// A monitor of 16 ticks a bin, after a reference of torques that are `noise` or its opposite.
fn after_reference(
    payload: impl Fn(u32) -> f32,
    noise: impl Fn(u32) -> f32,
) -> impl FnMut(f32, f32) -> Cycle {
    let mut made = None;
    with_model_of::<Spline<f32>, SET>(&CRANK, Scale::SI, |model| {
        let torque = |phase: Phase| payload(phase.to_bits() >> 26);
        made = Some(Monitor::<f32, BINS>::new(WATCH, torque, &model).unwrap());
    });
    let mut monitor = made.unwrap();
    let mut turn = move |carried: f32, friction: f32| {
        for k in 0..16 * BINS as u32 {
            let (bin, sign) = (k / 16, if k % 2 == 0 { 1.0 } else { -1.0 });
            let torque = carried * payload(bin) + friction + sign * noise(bin);
            monitor.tick(Phase::from_bits((k << 22) + (1 << 21)), torque);
        }
        monitor.end_cycle()
    };
    for _ in 0..2 * WATCH.reference {
        turn(0.0, 0.0);
    }
    turn
}

/// The payload's torque has 70 counts and a mean: truncated, the payload would be 1 % too large.
#[test]
fn the_payloads_torque_is_rounded() {
    let unit = 70.0 * WATCH.largest / 1_048_576.0;
    let wave = |bin: u32| unit * (0.3 + ((f64::from(bin) + 0.5) * TAU / 64.0).sin() as f32);
    let cycle = after_reference(wave, |_| 0.0)(100.0, 0.0);
    assert_near("payload", cycle.payload.into(), 100.0, 0.1);
}

/// Where σ varies over the range, friction and payload together leave the spread as it is: with the σ of a bin at least that of the mean variance,
/// (8·1 + 56·0.0001/0.0013375)/64 of σ².
#[test]
fn friction_and_payload_are_no_spread() {
    let is_rough = |bin: u32| bin < 8;
    let payload = |bin| if is_rough(bin) { 1.0 } else { 0.0 };
    let noise = |bin| if is_rough(bin) { 0.1 } else { 0.01 };
    let mut turn = after_reference(payload, noise);
    for carried in [0.05, -0.05] {
        let cycle = turn(carried, 0.05);
        // Each share of σ is rounded down, to 1/256.
        assert_near("spread", cycle.spread.into(), 0.436_4, 0.007);
        assert_near("payload", cycle.payload.into(), carried.into(), 1e-4);
        assert_near("friction", cycle.friction.into(), 0.05, 1e-4);
    }
}

#[test]
fn what_is_unknown_is_reported() {
    with_reference::<Spline<f32>>(Scale::SI, 4, |mut watched| {
        assert_eq!(
            watched.monitor.tick(Phase::default(), f32::NAN),
            Seen::Invalid
        );
        let far = watched.monitor.tick(Phase::default(), f32::INFINITY);
        assert_eq!(far, Seen::Jam);
        let [mean, limit] = watched.monitor.usual(Phase::default()).unwrap();
        assert!(
            mean.abs() < 5.0 && limit > 0.1 && limit < 0.1 * peak() as f32,
            "{mean} {limit}"
        );
        let cycle = watched.monitor.end_cycle();
        assert!(!cycle.judged && cycle.jams == 1, "{cycle:?}");
        let fresh = Monitor::<f32, BINS>::new(WATCH, |_| 0.0, &watched.model).unwrap();
        assert!(fresh.usual(Phase::default()).is_none());
        let mut half = fresh;
        // Only half of the turn is learned.
        for _ in 0..2 * WATCH.reference {
            for k in 0..100u32 {
                let seen = half.tick(Phase::from_bits(k * (1 << 24)), 1.0 + (k % 3) as f32);
                assert!(matches!(seen, Seen::Learning | Seen::Unknown));
            }
            half.end_cycle();
        }
        assert_eq!(half.tick(Phase::from_bits(1 << 29), 2.0), Seen::Usual);
        assert_eq!(half.tick(Phase::from_bits(15 << 28), 2.0), Seen::Unknown);
    });
}

/// A cycle of 520 ticks in the first half of the turn and 80 in the second, where a bin has 10 ticks in all reference cycles: the first half is watched,
/// and friction and payload are those of its ticks.
#[test]
fn what_is_known_is_watched_beside_what_is_unknown() {
    with_model_of::<Spline<f32>, SET>(&CRANK, Scale::SI, |model| {
        let payload = |phase: Phase| if phase.to_bits() < 1 << 30 { 1.0 } else { -1.0 };
        let mut monitor = Monitor::<f32, 512>::new(WATCH, payload, &model).unwrap();
        let mut turn = |carried: f32, friction: f32, cycle: u32| {
            // The places of a cycle are between those of the one before.
            let place = |k: u32, of: u32| (((32 * k + cycle % 32) << 16) / (32 * of)) << 15;
            let first = (0..520).map(|k| place(k, 520));
            let ticks = first.chain((0..80).map(|k| (1 << 31) + place(k, 80)));
            let seen = ticks.enumerate().map(|(k, bits)| {
                let phase = Phase::from_bits(bits);
                let noise = if k % 2 == 0 { 0.01 } else { -0.01 };
                monitor.tick(phase, carried * payload(phase) + friction + noise)
            });
            let unknown = seen.filter(|seen| *seen == Seen::Unknown).count();
            (unknown, monitor.end_cycle(), monitor.is_watching())
        };
        for cycle in 0..2 * WATCH.reference {
            turn(0.0, 0.0, cycle);
        }
        let (unknown, cycle, watching) = turn(0.02, 0.01, 0);
        assert!(watching && cycle.judged && unknown == 80, "{cycle:?}");
        assert_near("payload", cycle.payload.into(), 0.02, 2e-4);
        assert_near("friction", cycle.friction.into(), 0.01, 2e-4);
    });
}

#[test]
fn monitors_that_cannot_be_are_refused() {
    with_model_of::<Spline<f32>, SET>(&CRANK, Scale::SI, |model| {
        for watch in [
            Watch {
                largest: 0.0,
                ..WATCH
            },
            Watch {
                largest: f32::NAN,
                ..WATCH
            },
            Watch {
                reference: 31,
                ..WATCH
            },
            Watch { cycles: 0, ..WATCH },
            Watch {
                false_alarm: 0.6,
                ..WATCH
            },
            Watch {
                false_alarm: f32::NAN,
                ..WATCH
            },
        ] {
            assert!(
                Monitor::<f32, BINS>::new(watch, |_| 0.0, &model).is_err(),
                "{watch:?}"
            );
        }
        assert!(Monitor::<f32, 0>::new(WATCH, |_| 0.0, &model).is_err());
        let with = |payload: fn(f32) -> f32| {
            let torque = |phase: Phase| payload((phase.radians() / TAU) as f32);
            Monitor::<f32, BINS>::new(WATCH, torque, &model).map_err(|error| error.to_string())
        };
        // Places from 1/128 to 127/128, and a largest torque of 50 N·m: the least slope is 64/63·50/8192 = 0.006200.
        assert!(with(|place| 1.0 + place * 0.006_21).is_ok() && with(|_| 0.0).is_ok());
        for small in [|place| 1.0 + place * 0.006_19, |_| 1.0, |_| 1e-30] {
            let error = with(small).unwrap_err();
            assert!(error.starts_with("the variation of the payload's torque over the range is "));
            assert!(error.contains("must be at least 1/8192 of the largest torque, unless"));
        }
        assert!(with(|place| place * 99.0).is_ok());
        assert_eq!(
            with(|place| place * -128.0).unwrap_err(),
            "the payload's torque is -101, but must be at most twice the largest torque, in either direction"
        );
        assert_eq!(
            with(|_| f32::NAN).unwrap_err(),
            "the payload's torque is not a finite number"
        );
        assert!(with(|_| f32::INFINITY).is_err());
    });
}
