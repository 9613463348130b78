//! The firmware's duty meter against the figures of sizing: the same machine, the same cycle, two ways of summing.

use crate::reader;
use crate::support::{budget, press_file};
use jred::duty::{Curve, Figures, Limits, Meter, Verdict, Window};
use jred::machine::Reducible as _;
use jred::mechanism::TrainOutput;
use jred_analysis::duty::{Duty, STEPS};
use jred_file::model::machine::MachineFile;

/// Inertia of the rotor at the input (kg·m²).
const ROTOR: f64 = 0.02;

/// A limit that the cycle passes in part.
const PEAK: [[f64; 2]; 3] = [[0.0, 400.0], [20.0, 300.0], [100.0, 50.0]];

fn peak(speed: f64) -> f64 {
    let [_, [knee, high], [end, low]] = PEAK;
    let speed = speed.abs();
    if speed <= knee {
        400.0 - 100.0 * speed / knee
    } else {
        high + (low - high) * (speed - knee) / (end - knee)
    }
}

/// The meter after one cycle of `ticks`, read in the middle of each.
fn metered(file: &MachineFile, ticks: u32) -> Meter<f32> {
    let motion = file.motion.as_ref().unwrap();
    let step = motion.duration() / f64::from(ticks);
    let limits =
        Limits::new().with_peak(Curve::new(&PEAK.map(|point| point.map(|x| x as f32))).unwrap());
    let mut meter = Meter::new(limits, step as f32, Window::SinceStart).unwrap();
    let train = &file.drive_train;
    for k in 0..ticks {
        let state = motion.at((f64::from(k) + 0.5) * step);
        let r = file.machine.reduction(state.phi).unwrap();
        let total = r.torque(state.omega, state.alpha).total();
        let output = train
            .input(&TrainOutput {
                torque: total,
                torque_per_alpha: r.inertia,
                omega: state.omega,
                alpha: state.alpha,
                direction: state.omega,
            })
            .torque;
        let torque = output + ROTOR * state.alpha * train.ratio();
        let speed = state.omega * train.ratio();
        meter.tick(torque as f32, speed as f32, output as f32);
    }
    meter.count_cycle();
    meter
}

/// The same figures by sizing's instants, weights and f64.
fn sized(duty: &Duty) -> [(&'static str, f64); 11] {
    let torque = |i: &jred_analysis::duty::Instant| i.input_torque + ROTOR * i.input_alpha;
    let power = |i: &jred_analysis::duty::Instant| torque(i) * i.input_speed;
    let turned = duty.integral(|i| i.input_speed.abs());
    let cube = duty.integral(|i| i.input_speed.abs() * i.input_torque.abs().powi(3));
    let used = duty.figures(|i| torque(i).abs() / peak(i.input_speed));
    [
        ("RMS torque", duty.figures(torque).rms),
        ("mean speed", turned / duty.duration),
        ("cubic mean", (cube / turned).cbrt()),
        ("motoring energy", duty.integral(|i| power(i).max(0.0))),
        (
            "regenerative energy",
            duty.integral(|i| (-power(i)).max(0.0)),
        ),
        ("duration", duty.duration),
        ("peak torque", duty.figures(torque).peak()),
        ("peak speed", duty.figures(|i| i.input_speed).peak()),
        ("output peak", duty.figures(|i| i.input_torque).peak()),
        ("share of the envelope", used.max),
        ("cycles an hour", 3600.0 / duty.duration),
    ]
}

fn read(figures: &Figures<f32>) -> [f64; 11] {
    [
        figures.rms_torque,
        figures.mean_speed,
        figures.output_mean,
        figures.motoring_energy,
        figures.regenerative_energy,
        figures.duration,
        figures.peak_torque,
        figures.peak_speed,
        figures.output_peak,
        figures.peak_share.unwrap(),
        figures.cycles_per_hour,
    ]
    .map(f64::from)
}

#[test]
fn the_meter_has_the_figures_of_sizing() {
    let file = reader::read(&press_file()).unwrap();
    let motion = file.motion.as_ref().unwrap();
    let duty = Duty::new(&file, motion, 5 * STEPS).unwrap();
    let expected = sized(&duty);
    let worst = [2_000, 20_000].map(|ticks| {
        let meter = metered(&file, ticks);
        let figures = meter.figures();
        assert_eq!(
            (figures.ticks, figures.cycles, figures.invalid),
            (ticks, 1, 0)
        );
        let share = figures.peak_share.unwrap();
        let verdict = if share > 1.0 {
            Verdict::Exceeded
        } else {
            Verdict::Satisfied
        };
        assert_eq!(meter.verdicts().peak_torque, verdict);
        let mut worst = 0.0f64;
        for ((name, expected), found) in expected.into_iter().zip(read(&figures)) {
            let error = (found / expected - 1.0).abs();
            println!("{ticks} ticks, {name}: {found} against {expected}, {error:.1e}");
            worst = worst.max(error);
        }
        worst
    });
    assert!(worst[0] < budget::METERED[0], "2000 ticks: {:e}", worst[0]);
    assert!(worst[1] < budget::METERED[1], "20000 ticks: {:e}", worst[1]);
    // The meter does see the ticks' coarseness: otherwise this compares a thing with itself.
    assert!(worst[0] > 2.0 * worst[1], "{worst:?}");
}
