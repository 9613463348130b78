//! The DC bus: closed forms, balance of energy, phases by brute force.
// Zeros and copied figures are exact.
#![allow(clippy::float_cmp)]

mod answers;
mod conflict;
pub(crate) mod drive;
mod periods;
mod phases;

use crate::support::{budget, near, within};
use jred_file::model::supply::BrakeResistor;
use jred_sizing::bus::Need;
use jred_sizing::bus::axes::{Axes, WorstPhases};
use jred_sizing::bus::curve::{PowerCurve, StopPower};
use jred_sizing::bus::store::{Bus, BusFigures};
use jred_sizing::bus::supply::BusData;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

const BUS: Bus = Bus {
    voltage: 560.0,
    capacitance: 470e-6,
    regenerative: false,
    resistor: Some([780.0, 47.0]),
};

/// A linear axis of mass m that brakes from v to rest in t_b, once every t_z: the power falls linearly from m·v²/t_b. The maker's rule for a brake
/// resistor: P_max = η·m·v²/(2·t_b) while braking, P_cont = P_max·t_b/t_z.
#[test]
fn a_braking_axis_by_the_makers_rule() {
    let (mass, speed, braking, cycle, eta) = (120.0, 2.0, 0.25, 3.0, 0.9);
    let peak = eta * mass * speed * speed / braking;
    let curve = PowerCurve::new(
        [[0.0, -peak], [braking, 0.0], [braking, 0.0], [cycle, 0.0]],
        cycle,
    );
    let bus = Bus {
        capacitance: 0.0,
        ..BUS
    };
    let figures = bus.run(&curve);
    let rule = eta * mass * speed * speed / (2.0 * braking);
    near("while braking", figures.burnt / braking, rule, budget::BUS);
    near(
        "mean",
        figures.burnt / cycle,
        rule * braking / cycle,
        budget::BUS,
    );
    near("peak", figures.burnt_peak, peak, budget::BUS);
    near("pulse", figures.pulse, figures.burnt, budget::BUS);
    // 1728 W are less than 780²/47: the voltage stays.
    assert_eq!(figures.highest, 780.0);
}

/// A stop from the highest voltage of the cycle: the capacitor takes ½·C·(U² − U₀²), the resistor the rest. Two axes stop together.
#[test]
fn a_stop_starts_at_the_highest_voltage() {
    let energy = 0.5 * BUS.capacitance * (700.0f64.powi(2) - 560.0f64.powi(2));
    let charge = [
        [0.0, 100.0],
        [1.0, 100.0],
        [1.0, -energy / 0.2],
        [1.2, -energy / 0.2],
        [1.2, 0.0],
    ];
    let stop = StopPower {
        peak: 1500.0,
        energy: 300.0,
    };
    let curve = PowerCurve::new(charge, 2.0).with_stop(stop);
    let figures = BUS.run(&curve);
    let room = 0.5 * BUS.capacitance * (780.0f64.powi(2) - 700.0f64.powi(2));
    near("pulse", figures.pulse, 300.0 - room, budget::BUS);
    // The power falls linearly, so the remaining energy falls with its square.
    let peak = 1500.0 * (1.0 - room / 300.0).sqrt();
    near("power", figures.burnt_peak, peak, budget::BUS);
    assert_eq!((figures.highest, figures.burnt), (780.0, 0.0));
    // From the switch-on voltage the resistor takes the power of the stop, not all that it can.
    let full = PowerCurve::new(
        [[0.0, 500.0], [1.0, 500.0], [1.0, -2000.0], [1.2, 0.0]],
        2.0,
    );
    let figures = BUS.run(&full.with_stop(StopPower {
        peak: 3000.0,
        energy: 300.0,
    }));
    near("peak", figures.burnt_peak, 3000.0, budget::BUS);
    let bare = Bus {
        resistor: None,
        ..BUS
    };
    let highest = (700.0f64.powi(2) + 600.0 / BUS.capacitance).sqrt();
    near("voltage", bare.run(&curve).highest, highest, budget::BUS);
    assert!(Axes::new(bare, vec![curve.clone()]).bounds().highest >= highest);
    let both = curve
        .plus(&PowerCurve::new([], 2.0).with_stop(stop))
        .shifted(0.3);
    near("two", BUS.run(&both).pulse, 600.0 - room, budget::BUS);
    let data = BusData {
        voltage: Some(560.0),
        capacitance: Some(470e-6),
        chopper_voltage: Some(780.0),
        max_voltage: Some(820.0),
        min_resistance: None,
        regenerative: false,
        resistor: None,
    };
    let need = Need::of(&data, &curve).unwrap();
    near("needed", need.pulse, 300.0 - room, budget::BUS);
    near(
        "resistance",
        need.largest_resistance,
        780.0 * 780.0 / peak,
        budget::BUS,
    );
    assert_eq!(need.mean, 0.0);
}

/// The regenerated energy charges the capacitor first: ½·C·(U² − U₀²).
#[test]
fn a_capacitor_takes_what_it_can() {
    let curve = |energy: f64| {
        PowerCurve::new(
            [
                [0.0, 400.0],
                [1.0, 400.0],
                [1.0, -energy / 0.2],
                [1.2, -energy / 0.2],
                [1.2, 0.0],
                [2.0, 0.0],
            ],
            2.0,
        )
    };
    let room = 0.5 * BUS.capacitance * (780.0f64.powi(2) - 560.0f64.powi(2));
    let figures = BUS.run(&curve(0.8 * room));
    let expected = (560.0f64.powi(2) + 2.0 * 0.8 * room / BUS.capacitance).sqrt();
    near("voltage", figures.highest, expected, budget::BUS);
    assert_eq!(figures.burnt, 0.0);
    near(
        "from the mains",
        figures.supplied,
        400.0 - 0.8 * room,
        budget::BUS,
    );
    let figures = BUS.run(&curve(1.7 * room));
    near("burnt", figures.burnt, 0.7 * room, budget::BUS);
    near("held", figures.highest, 780.0, budget::BUS);
    // Without a resistor the voltage keeps rising, without bound if more is regenerated than drawn.
    let bare = Bus {
        resistor: None,
        ..BUS
    };
    let figures = bare.run(&curve(1.7 * room));
    let expected = (560.0f64.powi(2) + 2.0 * 1.7 * room / BUS.capacitance).sqrt();
    near("without a resistor", figures.highest, expected, budget::BUS);
    let hoist = PowerCurve::new(
        [[0.0, 100.0], [1.0, 100.0], [1.0, -300.0], [2.0, -300.0]],
        2.0,
    );
    assert_eq!(bare.run(&hoist).highest, f64::INFINITY);
    // A supply that takes energy back absorbs all of it.
    let figures = Bus {
        regenerative: true,
        ..bare
    }
    .run(&hoist);
    assert_eq!(
        [figures.highest, figures.supplied, figures.returned],
        [560.0, 100.0, 300.0]
    );
}

/// More power than the resistor dissipates: E = P/k + (E₀ − P/k)·e^(−k·t) with k = 2/(R·C).
#[test]
fn a_resistor_at_its_most() {
    let (power, time) = (16e3, 0.05);
    let on = 780.0f64 * 780.0;
    // Starting with a full bus: the time to fill it is before.
    let room = 0.5 * BUS.capacitance * (on - 560.0f64.powi(2));
    let fill = room / power;
    let curve = PowerCurve::new(
        [
            [0.0, -power],
            [fill + time, -power],
            [fill + time, 2e3],
            [2.0, 2e3],
        ],
        2.0,
    );
    let k = 2.0 / (47.0 * BUS.capacitance);
    let end = power / k + (0.5 * BUS.capacitance * on - power / k) * (-k * time).exp();
    let figures = BUS.run(&curve);
    let highest = (2.0 * end / BUS.capacitance).sqrt();
    near("voltage", figures.highest, highest, budget::BUS);
    near(
        "peak",
        figures.burnt_peak,
        highest * highest / 47.0,
        budget::BUS,
    );
}

/// A power ramp beyond what the resistor dissipates: E′ = P(t) − 2·E/(R·C), by Runge-Kutta; the voltage is highest within the ramp or at one of its
/// ends.
#[test]
fn a_resistor_at_its_most_under_a_ramp() {
    let on = 780.0f64 * 780.0;
    let [full, k] = [0.5 * BUS.capacitance * on, 2.0 / (47.0 * BUS.capacitance)];
    let room = full - 0.5 * BUS.capacitance * 560.0f64.powi(2);
    let (mut inside, mut at_end) = (0, 0);
    for (from, to) in [
        (14e3, 30e3),
        (30e3, 14e3),
        (40e3, 13e3),
        (16e3, 15.9e3),
        (14e3, 14.5e3),
    ] {
        for time in [0.001, 0.005, 0.05, 0.3] {
            let fill = room / from;
            let points = [
                [0.0, -from],
                [fill, -from],
                [fill + time, -to],
                [fill + time, 20e3],
                [3.0, 20e3],
            ];
            let figures = BUS.run(&PowerCurve::new(points, 3.0));
            let power = |t: f64| from + (to - from) * t / time;
            let rate = |t: f64, energy: f64| power(t) - k * energy;
            let (mut energy, mut highest, mut burnt) = (full, full, 0.0);
            let steps = 4000;
            let h = time / f64::from(steps);
            for n in 0..steps {
                let t = f64::from(n) * h;
                let k1 = rate(t, energy);
                let k2 = rate(t + 0.5 * h, energy + 0.5 * h * k1);
                let k3 = rate(t + 0.5 * h, energy + 0.5 * h * k2);
                let k4 = rate(t + h, energy + h * k3);
                let before = energy;
                energy += h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
                burnt += h * power(t + 0.5 * h) - (energy - before);
                highest = highest.max(energy);
            }
            inside += u32::from(highest > energy * (1.0 + 1e-6));
            at_end += u32::from(highest <= energy);
            let voltage = (2.0 * highest / BUS.capacitance).sqrt();
            near("voltage", figures.highest, voltage, 1e-7);
            near("peak", figures.burnt_peak, k * highest, 1e-7);
            // Energy above the chopper's voltage is dissipated afterwards, while the axis draws: at most all of it.
            let rest = energy - full;
            assert!(
                figures.burnt >= burnt - 1e-6 * burnt
                    && figures.burnt <= burnt + rest + 1e-6 * burnt
            );
        }
    }
    assert!(inside >= 4 && at_end >= 8, "{inside} {at_end}");
}

/// The worst phases for each of the figures that have limits.
fn worst(axes: &Axes) -> Option<[WorstPhases; 4]> {
    axes.largest(|figures| figures.judged(1.0), &())
}

fn random_curve(random: &mut ChaCha8Rng, period: f64, level: f64) -> PowerCurve {
    let count = random.random_range(3..12);
    let mut times: Vec<f64> = (0..count)
        .map(|_| random.random_range(0.0..period))
        .collect();
    times.sort_by(f64::total_cmp);
    let mut points = Vec::new();
    for t in times {
        points.push([t, level * random.random_range(-1.0..1.3)]);
        if random.random_bool(0.3) {
            points.push([t, level * random.random_range(-1.0..1.3)]);
        }
    }
    PowerCurve::new(points, period)
}

/// Over a period no energy is stored: the mains deliver the energy of the axes, minus the regenerated one, plus the heat of the resistor.
#[test]
fn energy_balances() {
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let mut started_full = 0;
    for case in 0..400 {
        let level = 10f64.powf(random.random_range(1.0..4.8));
        let period = 10f64.powf(random.random_range(-2.0..1.0));
        let curve = random_curve(&mut random, period, level);
        let bus = Bus {
            capacitance: if case % 7 == 0 {
                0.0
            } else {
                10f64.powf(random.random_range(-4.5..-2.0))
            },
            regenerative: case % 11 == 0,
            ..BUS
        };
        let figures = bus.run(&curve);
        let [drawn, back] = curve.energies();
        let sum = figures.supplied - figures.returned - figures.burnt;
        within(
            "balance",
            sum,
            drawn - back,
            budget::BUS_BALANCE * (drawn + back),
        );
        near("net", curve.energy(), drawn - back, 1e-9);
        assert!(figures.burnt <= back * (1.0 + 1e-9), "{figures:?}");
        assert!(figures.highest >= bus.voltage);
        // A period ends at its initial voltage, wherever the evaluation starts.
        let trace = bus.trace(&curve);
        let [first, last] = [trace.first().unwrap()[1], trace.last().unwrap()[1]];
        near("voltage", last, first, budget::BUS_BALANCE);
        let stored = 0.5 * bus.capacitance * (first * first - bus.voltage * bus.voltage);
        within(
            "stored",
            figures.stored,
            stored,
            budget::BUS_BALANCE * (back + bus.capacitance * first * first),
        );
        started_full += u32::from(first > bus.voltage * (1.0 + 1e-6));
    }
    assert!(started_full > 30, "{started_full}");
}

/// The same bus in explicit steps: E += (P_supply − P − P_R)·dt.
fn stepped(bus: &Bus, curve: &PowerCurve, count: u32) -> BusFigures {
    let [on, r] = bus.resistor.unwrap();
    let c = bus.capacitance;
    let (base, full) = (0.5 * c * bus.voltage.powi(2), 0.5 * c * on * on);
    let dt = curve.period() / f64::from(count);
    let mut pieces: Vec<(f64, f64, [f64; 2])> = Vec::new();
    let mut start = 0.0;
    for (h, ends) in curve.pieces() {
        pieces.push((start, h, ends));
        start += h;
    }
    let mut energy = base;
    let mut figures = BusFigures::default();
    for _ in 0..60 {
        figures = BusFigures {
            highest: bus.voltage,
            ..BusFigures::default()
        };
        let mut at = 0;
        for k in 0..count {
            let t = (f64::from(k) + 0.5) * dt;
            while at + 1 < pieces.len() && pieces[at + 1].0 <= t {
                at += 1;
            }
            let (from, h, [a, b]) = pieces[at];
            let power = a + (b - a) * (t - from) / h;
            let mut next = energy - power * dt;
            if next > full {
                let burnt = (next - full).min(2.0 * next / (r * c) * dt);
                next -= burnt;
                figures.burnt += burnt;
            }
            if next < base {
                figures.supplied += base - next;
                next = base;
            }
            energy = next;
            figures.highest = figures.highest.max((2.0 * energy / c).sqrt());
        }
    }
    figures
}

#[test]
fn small_steps_agree() {
    let mut random = ChaCha8Rng::seed_from_u64(12);
    let mut full = 0;
    for _ in 0..12 {
        let level = 10f64.powf(random.random_range(3.5..5.0));
        let curve = random_curve(&mut random, 0.6, level);
        let figures = BUS.run(&curve);
        let other = stepped(&BUS, &curve, 60_000);
        let [drawn, back] = curve.energies();
        near(
            "voltage",
            figures.highest,
            other.highest,
            budget::SMALL_STEPS,
        );
        let scale = budget::SMALL_STEPS * (drawn + back);
        within("burnt", figures.burnt, other.burnt, scale);
        within("supplied", figures.supplied, other.supplied, scale);
        full += u32::from(figures.highest > 780.1);
    }
    assert!(full >= 2, "{full} cases above the chopper's voltage");
}

/// Shifted, repeated and added curves have the expected value at every time.
#[test]
fn curves_move_and_add() {
    let mut random = ChaCha8Rng::seed_from_u64(13);
    let value = |curve: &PowerCurve, t: f64| {
        let t = t.rem_euclid(curve.period());
        let mut start = 0.0;
        for (h, [a, b]) in curve.pieces() {
            if t < start + h {
                return a + (b - a) * (t - start) / h;
            }
            start += h;
        }
        curve.points().last().unwrap()[1]
    };
    for _ in 0..100 {
        let (a, b) = (
            random_curve(&mut random, 2.0, 100.0),
            random_curve(&mut random, 1.0, 50.0),
        );
        let shift = random.random_range(-3.0..3.0);
        let sum = a.shifted(shift).plus(&b.repeated(2));
        assert_eq!(sum.period(), 2.0);
        for _ in 0..50 {
            let t = random.random_range(0.0..2.0);
            let expected = value(&a, t - shift) + value(&b, t);
            within("sum", value(&sum, t), expected, budget::CURVES * 100.0);
        }
        near("energy", sum.energy(), a.energy() + 2.0 * b.energy(), 1e-9);
    }
}

/// The requested resistor is just sufficient; a smaller one is not.
#[test]
fn the_resistor_asked_for_is_enough() {
    let data = BusData {
        voltage: Some(560.0),
        capacitance: Some(470e-6),
        chopper_voltage: Some(780.0),
        max_voltage: Some(820.0),
        min_resistance: Some(30.0),
        regenerative: false,
        resistor: None,
    };
    let mut random = ChaCha8Rng::seed_from_u64(15);
    let mut asked = 0;
    for _ in 0..50 {
        let curve = random_curve(&mut random, 0.8, 6000.0);
        let Some(need) = Need::of(&data, &curve) else {
            continue;
        };
        asked += 1;
        let with = |resistance| {
            let resistor = BrakeResistor {
                resistance,
                power: need.mean,
                peak_power: None,
                pulse_energy: None,
            };
            let data = BusData {
                resistor: Some(resistor),
                ..data
            };
            data.bus().unwrap().run(&curve)
        };
        let enough = with(need.largest_resistance * (1.0 - 1e-9));
        near("held", enough.highest, 780.0, budget::BUS);
        near("mean", enough.burnt / 0.8, need.mean, budget::BUS);
        let too_large = with(need.largest_resistance * 1.2);
        assert!(too_large.highest > 780.0 + 1e-6, "{too_large:?}");
    }
    assert!(asked > 20, "{asked}");
}

/// The end of a repeated cycle differs by rounding from that of an equally long one: where one continues the other keeps its last value.
#[test]
fn the_sum_of_level_curves_is_level_to_the_end() {
    let level = |power: f64, period: f64| PowerCurve::new([[0.0, power], [period, power]], period);
    let (long, repeated) = (level(1.0, 0.3), level(5.0, 0.1).repeated(3));
    assert!(repeated.points().last().unwrap()[0] > 0.3);
    for sum in [long.plus(&repeated), repeated.plus(&long)] {
        assert!(
            sum.points().iter().all(|[_, power]| *power == 6.0),
            "{sum:?}"
        );
        near("energy", sum.energy(), 1.8, budget::BUS);
    }
}
