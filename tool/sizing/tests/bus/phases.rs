//! The search over phases: closed forms, brute force, and cycles that meet late or never.

use jred_file::model::supply::Supply;
use jred_sizing::bus::axes::Axes;
use jred_sizing::bus::curve::PowerCurve;
use jred_sizing::bus::store::Bus;
use jred_sizing::bus::supply::BusData;
use jred_sizing::bus::{Need, Watch};
use rand::SeedableRng as _;
use rand::rngs::ChaCha8Rng;
use std::sync::atomic::{AtomicU64, Ordering};

use super::{BUS, budget, near, random_curve, worst};
use crate::support::within;

/// Two equal axes that brake while the other drives: half a period apart, one takes the regenerated energy of the other. In step they dissipate it.
#[test]
fn two_axes_in_closed_form() {
    let push = PowerCurve::new(
        [[0.0, 900.0], [1.0, 900.0], [1.0, -700.0], [2.0, -700.0]],
        2.0,
    );
    let bus = Bus {
        capacitance: 0.0,
        ..BUS
    };
    let axes = Axes::new(bus, vec![push.clone(), push]);
    let apart = axes.at(&[0.0, 1.0]).unwrap();
    assert_eq!([apart.burnt, apart.highest], [0.0, 560.0]);
    near("supplied", apart.supplied, 400.0, budget::BUS);
    for worst in worst(&axes).unwrap() {
        assert_eq!(worst.phases, [0.0, 0.0]);
        near("burnt", worst.figures.burnt, 1400.0, budget::BUS);
    }
    near("separate", axes.apart(), 700.0, budget::BUS);
    let bounds = axes.bounds();
    assert_eq!(
        [bounds.drawn, bounds.back, bounds.resistor],
        [1800.0, 1400.0, 700.0]
    );
    // The phases with least dissipation are half a period apart.
    let [least] = axes.largest(|figures| [-figures.burnt], &()).unwrap();
    near("phase", least.phases[1], 1.0, budget::BUS);
    assert_eq!(least.figures.burnt, 0.0);
}

/// The axes over all phases of a grid: the largest of every goal.
fn brute(axes: &Axes, periods: &[f64], grid: i32) -> [f64; 4] {
    let second = if periods.len() == 3 { grid } else { 1 };
    let mut most = [0.0f64; 4];
    for i in 0..grid {
        for k in 0..second {
            let part = |n: i32, axis: usize| f64::from(n) / f64::from(grid) * periods[axis];
            let mut phases = vec![0.0, part(i, 1)];
            if periods.len() == 3 {
                phases.push(part(k, 2));
            }
            let figures = axes.at(&phases).unwrap();
            for (most, figure) in most.iter_mut().zip(figures.judged(1.0)) {
                *most = most.max(figure);
            }
        }
    }
    most
}

/// The search against brute force over all phases on a different grid, and the bounds above both. For cycles that meet only after 9 and 10 the search
/// evaluates a tenth of the phases.
#[test]
fn phases_by_brute_force() {
    let mut random = ChaCha8Rng::seed_from_u64(14);
    for (periods, grid) in [
        (vec![1.0, 1.0], 1009),
        (vec![1.0, 0.5], 1009),
        (vec![1.0, 0.9], 1009),
        (vec![0.3, 0.7], 1009),
        (vec![0.9, 0.6, 0.9], 61),
        (vec![0.4, 0.6, 0.5], 61),
    ] {
        let curves: Vec<PowerCurve> = periods
            .iter()
            .map(|period| random_curve(&mut random, *period, 2000.0))
            .collect();
        let axes = Axes::new(BUS, curves);
        let most = brute(&axes, &periods, grid);
        let bounds = axes.bounds();
        let period = axes.power(&[0.0]).unwrap().period();
        let worst = worst(&axes).unwrap();
        for ((goal, worst), most) in worst.into_iter().enumerate().zip(most) {
            let found = worst.figures.judged(1.0)[goal];
            assert_eq!(worst.figures, axes.at(&worst.phases).unwrap());
            let case = format!("{periods:?} {goal}: {found}, by brute force {most}");
            let misses = if periods.len() == 3 {
                budget::THREE_PHASES
            } else {
                budget::PHASES
            };
            assert!(found >= most * (1.0 - misses), "{case}");
            assert!(
                found <= most * (1.0 + budget::COARSE_PHASES) + 1e-9,
                "{case}"
            );
            assert!(worst.figures.highest <= bounds.highest * (1.0 + 1e-12));
            assert!(worst.figures.burnt / period <= bounds.resistor * (1.0 + 1e-12));
            assert!(worst.figures.burnt_peak <= bounds.back * (1.0 + 1e-12));
        }
    }
}

/// Four axes, each with a pulse of power: all pulses in step give the highest voltage and the longest pulse, which the search finds.
#[test]
fn four_axes_at_once() {
    let curve = |back: f64| {
        PowerCurve::new(
            [
                [0.0, 4000.0],
                [0.7, 4000.0],
                [0.7, -back],
                [0.8, -back],
                [0.8, 0.0],
                [1.0, 0.0],
            ],
            1.0,
        )
    };
    let backs = [900.0, 700.0, 500.0, 300.0];
    let bus = Bus {
        resistor: None,
        ..BUS
    };
    let starts = [0.0, 0.13, 0.57, 0.31];
    let curves = backs.iter().zip(starts);
    let curves = curves.map(|(back, start)| curve(*back).shifted(start));
    let axes = Axes::new(bus, curves.collect());
    let [voltage, ..] = worst(&axes).unwrap();
    // 0.1 s of 2400 W.
    let expected = (560.0f64.powi(2) + 2.0 * 240.0 / BUS.capacitance).sqrt();
    near("voltage", voltage.figures.highest, expected, budget::PHASES);
    near("bound", axes.bounds().highest, expected, budget::PHASES);
}

/// Four axes, the second of which repeats with the first only after twelve of its cycles: the worst phase is between two grid points of its own
/// period, 7/16 of a step from the better one, and the search refines it.
#[test]
fn four_axes_between_the_places_of_the_grid() {
    let (short, block, back, begin) = (1.0 / 12.0, 0.02, 600.0, 0.3);
    let phase = (3.0 - 7.0 / 16.0) / 48.0;
    let at = begin + phase - 4.0 * short;
    let first = PowerCurve::new(
        [
            [0.0, 3000.0],
            [at, 3000.0],
            [at, -back],
            [at + block, -back],
            [at + block, 3000.0],
            [short, 3000.0],
        ],
        short,
    );
    // The spike, which aligned phases combine with the block, stores less than both blocks in step.
    let second = PowerCurve::new(
        [
            [0.0, 3000.0],
            [begin, 3000.0],
            [begin, -back],
            [begin + block, -back],
            [begin + block, 3000.0],
            [0.7, 3000.0],
            [0.7, -5000.0],
            [0.7005, -5000.0],
            [0.7005, 3000.0],
            [1.0, 3000.0],
        ],
        1.0,
    );
    let drawn = 10.0;
    let steady = PowerCurve::new([[0.0, drawn], [1.0, drawn]], 1.0);
    let bus = Bus {
        resistor: None,
        ..BUS
    };
    let axes = Axes::new(bus, vec![first, second, steady.clone(), steady]);
    let [voltage, ..] = worst(&axes).unwrap();
    let stored = 2.0 * (back - drawn) * block;
    let expected = (560.0f64.powi(2) + 2.0 * stored / BUS.capacitance).sqrt();
    near("voltage", voltage.figures.highest, expected, budget::PHASES);
    let found = voltage.phases[1].rem_euclid(short);
    near("phase", found, phase, budget::COARSE_PHASES);
}

/// Two of three axes have half the period of the third, which is at rest: the second takes the energy of the first if it starts 0.35 s later. All
/// phases up to its whole period must be searched.
#[test]
fn phases_of_a_pair_beside_a_longer_cycle() {
    let brakes = PowerCurve::new([[0.0, -800.0], [0.1, -800.0], [0.1, 0.0], [0.5, 0.0]], 0.5);
    let drives = PowerCurve::new(
        [
            [0.0, 0.0],
            [0.15, 0.0],
            [0.15, 800.0],
            [0.25, 800.0],
            [0.25, 0.0],
            [0.5, 0.0],
        ],
        0.5,
    );
    let rests = PowerCurve::new([[0.0, 0.0], [1.0, 0.0]], 1.0);
    let bus = Bus {
        capacitance: 0.0,
        ..BUS
    };
    let axes = Axes::new(bus, vec![brakes, drives, rests]);
    let [least] = axes.largest(|figures| [-figures.burnt], &()).unwrap();
    within("burnt", least.figures.burnt, 0.0, 1e-3);
    within("phase", least.phases[1], 0.35, 1e-5);
}

/// The resistor's requirement is the largest of every figure over all phases, each by brute force with a resistor that dissipates all.
#[test]
fn the_resistor_asked_for_is_that_of_the_worst_phases() {
    let data = BusData {
        voltage: Some(560.0),
        capacitance: Some(120e-6),
        chopper_voltage: Some(780.0),
        max_voltage: Some(820.0),
        min_resistance: None,
        regenerative: false,
        resistor: None,
    };
    let mut random = ChaCha8Rng::seed_from_u64(17);
    let (mut asked, mut apart) = (0, 0);
    for _ in 0..6 {
        let periods = [0.8, 0.6];
        let curves = periods.map(|period| random_curve(&mut random, period, 3000.0));
        let axes = Axes::new(data.bus().unwrap(), curves.to_vec());
        let back = axes.bounds().back;
        let resistor = [780.0, 780.0 * 780.0 / back];
        let with = axes.on(Bus {
            resistor: Some(resistor),
            ..*axes.bus()
        });
        let [_, burnt, peak, pulse] = brute(&with, &periods, 499);
        let Some(need) = Need::over(&data, &axes, &()) else {
            assert_eq!(burnt, 0.0);
            continue;
        };
        asked += 1;
        let period = axes.power(&[]).unwrap().period();
        for (found, most) in [
            (need.mean, burnt / period),
            (need.peak, peak),
            (need.pulse, pulse),
        ] {
            assert!(found >= most * (1.0 - budget::PHASES), "{found} {most}");
            assert!(
                found <= most * (1.0 + budget::COARSE_PHASES),
                "{found} {most}"
            );
        }
        near(
            "resistance",
            need.largest_resistance,
            780.0 * 780.0 / need.peak,
            budget::BUS,
        );
        // No single phase has all of them: the one with the largest mean power has a smaller pulse or peak.
        let [_, mean, ..] = worst(&with).unwrap();
        let one = [mean.figures.burnt_peak, mean.figures.pulse];
        apart += usize::from(one[0] < 0.999 * need.peak || one[1] < 0.999 * need.pulse);
        // With its resistor, held at the chopper's voltage at every phase.
        let enough = axes.on(Bus {
            resistor: Some([780.0, need.largest_resistance * (1.0 - 1e-9)]),
            ..*axes.bus()
        });
        near(
            "held",
            brute(&enough, &periods, 499)[0],
            780.0,
            budget::PHASES,
        );
    }
    assert!(asked >= 4 && apart >= 2, "{asked} {apart}");
}

/// For several amplifiers on a bus the strictest figure applies, and their capacitances add up.
#[test]
fn amplifiers_on_one_bus() {
    let data = |capacitance, max, least| BusData {
        voltage: Some(560.0),
        capacitance,
        chopper_voltage: Some(max - 40.0),
        max_voltage: Some(max),
        min_resistance: Some(least),
        regenerative: false,
        resistor: None,
    };
    let each = [data(Some(3e-4), 820.0, 30.0), data(Some(5e-4), 800.0, 45.0)];
    let shared = BusData::shared(&Supply::default(), &each);
    near("C", shared.capacitance.unwrap(), 8e-4, budget::BUS);
    assert_eq!(
        (
            shared.max_voltage,
            shared.chopper_voltage,
            shared.min_resistance
        ),
        (Some(800.0), Some(760.0), Some(45.0))
    );
    let unknown = [each[0], data(None, 900.0, 10.0)];
    assert_eq!(
        BusData::shared(&Supply::default(), &unknown).capacitance,
        None
    );
}

/// The progress reports as many phases as were planned.
#[test]
fn a_search_says_how_far_it_is() {
    #[derive(Default)]
    struct Count([AtomicU64; 2]);
    impl Watch for Count {
        fn planned(&self, count: u64) {
            self.0[0].fetch_add(count, Ordering::Relaxed);
        }
        fn done(&self, count: u64) {
            self.0[1].fetch_add(count, Ordering::Relaxed);
        }
    }
    let mut random = ChaCha8Rng::seed_from_u64(18);
    let curve = random_curve(&mut random, 1.0, 2000.0);
    for (count, least) in [(1, 0), (2, 720), (3, 48 * 48), (4, 4 * 3 * 48)] {
        let axes = Axes::new(BUS, vec![curve.clone(); count]);
        let seen = Count::default();
        axes.largest(|figures| figures.judged(1.0), &seen).unwrap();
        let [planned, done] = seen.0.map(AtomicU64::into_inner);
        assert_eq!(planned, done);
        assert!(done >= least, "{count} axes: {done}");
        assert_eq!(count == 1, done == 0);
    }
}
