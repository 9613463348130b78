//! The winding temperature as a limit, against closed forms and a numerical integration of the heat.

use jred_file::model::machine::MachineFile;
use jred_motion::fastest::cycle::{Cycle, cycle};
use jred_motion::fastest::winding::{
    Temperatures, ThermalResult, UnknownTemperature, Winding, cooled,
};
use jred_motion::fastest::{MoveLimits, NoMotion, Rms};
use jred_motion::moves::{Move, Part};
use jred_motion::path_dynamics::{Actuator, BothDirections};
use jred_sizing::catalogue::{self, Commutation, Drive, Motor, Thermal};
use jred_sizing::motor::envelope::Envelope;

use super::{close, machine, table};

/// Ambient temperature (°C), the default of machine files.
const AMBIENT: f64 = 40.0;

/// Torque constant (N·m/A), resistance (Ω) at 20 °C of a DC winding, and the temperature coefficient of copper (1/K).
const KT: f64 = 0.5;
const R20: f64 = 2.0;
const COPPER: f64 = 0.003_93;

/// Integration steps of a cycle: at a torque jump inside a step the heat of half a step is wrong, 0.005 K.
const STEPS: u32 = 20_000;

/// Thermal resistances (K/W).
const WINDING: f64 = 0.4;
const HOUSING: f64 = 0.9;

fn motor(peak: f64, times: [Option<f64>; 2]) -> Motor {
    Motor {
        peak_curve: vec![[0.0, peak], [1e3, peak]],
        max_speed: Some(1e3),
        winding: catalogue::Winding {
            resistance: Some(R20),
            torque_constant: Some(KT),
            commutation: Commutation::Block,
            ..catalogue::Winding::default()
        },
        thermal: Thermal {
            winding_resistance: Some(WINDING),
            housing_resistance: Some(HOUSING),
            winding_time: times[0],
            housing_time: times[1],
            max_temperature: None,
        },
        ..Motor::default()
    }
}

/// A move there and back over 3 rad, with a pause after each.
fn parts(pause: f64) -> Vec<Part> {
    let there = |from: f64, to: f64| {
        Part::Move(Move {
            from,
            to,
            duration: 1.0,
        })
    };
    let rest = |at: f64| Part::Dwell {
        at,
        duration: pause,
    };
    vec![there(0.0, 3.0), rest(3.0), there(3.0, 0.0), rest(0.0)]
}

fn drive(motor: &Motor) -> Drive<'_> {
    Drive {
        motor,
        gearbox: None,
        amplifier: None,
    }
}

fn actuator(motor: &Motor) -> Actuator {
    Actuator::new(&drive(motor), Envelope::of(motor))
}

fn limited(
    file: &MachineFile,
    motor: &Motor,
    parts: &[Part],
    limit: f64,
) -> Result<ThermalResult, (Option<usize>, NoMotion)> {
    let winding = Winding::new(&drive(motor), file);
    let actuator = actuator(motor);
    let at = |rms: Option<Rms>| -> Result<Cycle, (Option<usize>, NoMotion)> {
        let found = cycle(file, &actuator, MoveLimits::default(), rms, parts);
        found.map_err(|(index, why)| (Some(index + 1), why))
    };
    cooled(&winding, limit, file, &actuator, None, at)
}

/// The rise under a constant torque: P·(1 + g·θ)·(R_w + R_h) = θ.
fn rise(torque: f64) -> f64 {
    let reference = 1.0 + COPPER * (AMBIENT - 20.0);
    let cold = R20 * reference * (torque / KT).powi(2) * (WINDING + HOUSING);
    cold / (1.0 - COPPER / reference * cold)
}

/// Alternating full torque is a constant loss: no ripple, for any time constants.
#[test]
fn a_constant_torque_has_a_closed_form() {
    let file = table(2.0, "");
    let moves: Vec<Part> = parts(0.0).into_iter().step_by(2).collect();
    for times in [[Some(0.3), Some(900.0)], [None, Some(5.0)], [None, None]] {
        let peak = 1.8;
        let found = limited(&file, &motor(peak, times), &moves, 300.0).unwrap();
        close(found.temperatures.greatest, AMBIENT + rise(peak), 1e-8);
        assert_eq!(found.bound, None);
        let Some([mean, ripple]) = found.temperatures.mean else {
            assert_eq!(times, [None, None]);
            assert!(!found.temperatures.heating.ripple);
            continue;
        };
        close(mean, AMBIENT + rise(peak), 1e-8);
        assert!(ripple.abs() < 1e-6, "{ripple}");
    }
}

/// With constant inertia and no friction ∫T² dt = 12·J²·D²/t³ for each move. A cycle that is short compared with the time constants is as warm as
/// under its RMS torque.
#[test]
fn a_short_cycle_is_limited_by_its_rms_torque() {
    let file = table(2.0, "");
    let (inertia, way, pause, limit) = (2.0_f64, 3.0, 0.5, 110.0);
    let motor = motor(60.0, [Some(40.0), Some(1200.0)]);
    let found = limited(&file, &motor, &parts(pause), limit).unwrap();
    // The RMS torque at the limit, then the time of a move, both by bisection.
    let halved = |mut low: f64, mut high: f64, over: &dyn Fn(f64) -> bool| {
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if over(middle) {
                high = middle;
            } else {
                low = middle;
            }
        }
        low
    };
    let rms = halved(0.1, 4.0, &|torque| rise(torque) > limit - AMBIENT);
    let heat = |t: f64| 12.0 * (inertia * way).powi(2) / t.powi(3);
    let time = halved(0.1, 60.0, &|t| heat(t) < rms * rms * (t + pause));
    let ripple = found.temperatures.mean.unwrap()[1];
    assert!(ripple > 0.1 && ripple < 15.0, "{ripple}");
    let [before, own] = found.bound.unwrap();
    // About half of the ripple is subtracted from the rise, and so from the loss.
    let taken = 0.5 * ripple / (limit - AMBIENT);
    assert!(own < rms && own > rms * (1.0 - taken), "{own} {rms}");
    let duration = found.cycle.trace.duration();
    let least = 2.0 * (time + pause);
    assert!(
        duration > least && duration < least * (1.0 + taken),
        "{duration} {least}"
    );
    assert!(before < duration);
    let greatest = found.temperatures.greatest;
    assert!(greatest <= limit && greatest > limit - 0.02, "{greatest}");
}

/// The heat of a motion over many cycles from cold, by the classical Runge-Kutta method on the equations of both bodies: largest and mean temperature
/// of the last cycle.
fn integrated(file: &MachineFile, motor: &Motor, cycle: &Cycle, cycles: u32) -> [f64; 2] {
    let actuator = actuator(motor);
    let ways = BothDirections::new(file, &actuator);
    let [tw, th] = [motor.thermal.winding_time, motor.thermal.housing_time].map(Option::unwrap);
    let reference = 1.0 + COPPER * (AMBIENT - 20.0);
    let growth = COPPER / reference;
    let trace = &cycle.trace;
    let duration = trace.duration();
    let step = duration / f64::from(STEPS);
    let losses: Vec<f64> = (0..=2 * STEPS)
        .map(|k| {
            let t = duration * f64::from(k) / f64::from(2 * STEPS);
            let torque = ways.torque(&trace.at(t), trace.heading(t)).unwrap();
            R20 * reference * (torque / KT).powi(2)
        })
        .collect();
    let slope = |[w, h]: [f64; 2], loss: f64| {
        let flow = (w - h) / WINDING;
        [
            (loss * (1.0 + growth * w) - flow) * WINDING / tw,
            (flow - h / HOUSING) * HOUSING / th,
        ]
    };
    let mut rise = [0.0; 2];
    let mut last = [0.0; 2];
    for number in 1..=cycles {
        let (mut greatest, mut sum) = (rise[0], 0.0);
        for k in 0..STEPS as usize {
            let [a, b, c] = [0, 1, 2].map(|i| losses[2 * k + i]);
            let ahead =
                |slope: [f64; 2], by: f64| [rise[0] + by * slope[0], rise[1] + by * slope[1]];
            let one = slope(rise, a);
            let two = slope(ahead(one, 0.5 * step), b);
            let three = slope(ahead(two, 0.5 * step), b);
            let four = slope(ahead(three, step), c);
            let before = rise[0];
            for i in 0..2 {
                rise[i] += step / 6.0 * (one[i] + 2.0 * two[i] + 2.0 * three[i] + four[i]);
            }
            greatest = greatest.max(rise[0]);
            sum += 0.5 * (before + rise[0]) * step;
        }
        if number == cycles {
            last = [AMBIENT + greatest, AMBIENT + sum / duration];
        }
    }
    last
}

/// A cycle as long as the winding's time constant: the ripple matters. The limit is satisfied after many cycles.
#[test]
fn a_long_cycle_is_limited_by_its_greatest_temperature() {
    let file = table(
        2.0,
        "[[load]]\non = \"table\"\nopposing_moment = \"0.2 N m\"\n",
    );
    let motor = motor(6.0, [Some(1.5), Some(30.0)]);
    let limit = 100.0;
    let found = limited(&file, &motor, &parts(0.8), limit).unwrap();
    let Temperatures { greatest, mean, .. } = found.temperatures;
    let [mean, ripple] = mean.unwrap();
    assert!(ripple > 10.0, "{ripple}");
    assert!(greatest <= limit && greatest > limit - 0.02, "{greatest}");
    let [hottest, level] = integrated(&file, &motor, &found.cycle, 100);
    close(hottest, greatest, 2e-4);
    close(level, mean, 2e-4);
}

/// An inactive limit changes nothing; one that friction alone exceeds is refused, and so is a motor without thermal data.
#[test]
#[ignore = "more than five seconds of a processor"]
fn limits_that_do_not_bind_or_cannot_be_kept() {
    let file = table(
        2.0,
        "[[load]]\non = \"table\"\nopposing_moment = \"1 N m\"\n",
    );
    let motor = motor(6.0, [Some(30.0), Some(600.0)]);
    let one = parts(0.0);
    let free = cycle(&file, &actuator(&motor), MoveLimits::default(), None, &one).unwrap();
    let runs_away = Winding::new(&drive(&motor), &file)
        .temperatures(&file, &actuator(&motor), &free, 100.0)
        .unwrap();
    assert!(runs_away.0.greatest.is_infinite() && runs_away.0.mean.is_none());
    let refused = limited(&file, &motor, &one, AMBIENT + 0.9 * rise(1.0));
    assert!(
        matches!(refused, Err((None, NoMotion::TooWarm { .. }))),
        "{refused:?}"
    );
    let cool = Motor {
        thermal: Thermal {
            winding_resistance: Some(1e-4),
            housing_resistance: Some(1e-4),
            ..motor.thermal
        },
        ..motor.clone()
    };
    let same = limited(&file, &cool, &one, 100.0).unwrap();
    assert_eq!(same.cycle.trace, free.trace);
    assert_eq!(same.bound, None);
    let bare = Motor {
        thermal: Thermal::default(),
        ..motor
    };
    let unknown = Winding::new(&drive(&bare), &file).known();
    assert!(
        matches!(unknown, Err(UnknownTemperature::Figures(_))),
        "{unknown:?}"
    );
    let rated = Motor {
        rated_torque: Some(2.0),
        ..bare.clone()
    };
    let unknown = Winding::new(&drive(&rated), &file).known();
    assert!(
        matches!(unknown, Err(UnknownTemperature::RatedRise)),
        "{unknown:?}"
    );
}

/// Without winding data the rise is a share of the rated one; thin air increases it.
#[test]
fn s1_torque_and_altitude() {
    let text = |site: &str| {
        machine(&format!(
            "title = \"table\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\n[mechanism.table]\nmass = \"1 kg\"\ninertia = \"2 kg m^2\"\n{site}"
        ))
    };
    let motor = Motor {
        peak_curve: vec![[0.0, 2.0], [1e3, 2.0]],
        continuous_curve: vec![[0.0, 2.5], [1e3, 2.5]],
        max_speed: Some(1e3),
        thermal: Thermal {
            max_temperature: Some(140.0),
            ..Thermal::default()
        },
        ..Motor::default()
    };
    let moves: Vec<Part> = parts(0.0).into_iter().step_by(2).collect();
    for (site, factor) in [("", 1.0), ("[surroundings]\naltitude = \"2000 m\"\n", 0.9)] {
        let found = limited(&text(site), &motor, &moves, 250.0).unwrap();
        // Full torque throughout, (2/2.5)² of the rated rise of 100 K; the S1 torque is at most the peak torque.
        let share = (2.0_f64 / 2.5_f64.min(2.0)).powi(2);
        close(
            found.temperatures.greatest,
            40.0 + 100.0 * share / factor,
            1e-8,
        );
        assert!(found.temperatures.heating.relative);
    }
}
