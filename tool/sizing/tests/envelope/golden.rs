//! Figures of two makers' data sheets that follow from others on the same sheet.

use std::ops::RangeInclusive;

use jred_file::model::site::Site;
use jred_sizing::catalogue::Commutation;
use jred_sizing::catalogue::{Motor, Thermal, Winding};
use jred_sizing::motor::envelope::{Envelope, MotorLimits};

use super::{RPM, bare, budget, near};

/// One winding of a maxon EC motor: maxon, *EC motor*, catalogue p. 204, the windings for 3 V and 6 V.
struct Small {
    voltage: f64,
    no_load: [f64; 2],
    nominal: [f64; 3],
    stall: [f64; 2],
    resistance: f64,
    torque_constant: f64,
}

const SMALL: [Small; 2] = [
    Small {
        voltage: 3.0,
        no_load: [34_700.0, 0.0234],
        nominal: [13_600.0, 0.215e-3, 0.292],
        stall: [0.367e-3, 0.468],
        resistance: 6.42,
        torque_constant: 0.784e-3,
    },
    Small {
        voltage: 6.0,
        no_load: [35_700.0, 0.0121],
        nominal: [15_300.0, 0.222e-3, 0.154],
        stall: [0.402e-3, 0.263],
        resistance: 22.8,
        torque_constant: 1.53e-3,
    },
];

#[test]
fn a_small_brushless_motor_runs_as_its_maker_says() {
    for sheet in SMALL {
        let motor = Motor {
            bus_voltage: Some(sheet.voltage),
            winding: Winding {
                commutation: Commutation::Block,
                torque_constant: Some(sheet.torque_constant),
                resistance: Some(sheet.resistance),
                ..Winding::default()
            },
            ..bare()
        };
        let prepared = MotorLimits::new(&motor, None, &Site::default());
        let envelope = &prepared.envelope;
        near(
            envelope.peak_torque(1.0, 0.0),
            sheet.stall[0],
            budget::DATA_SHEET,
        );
        // The no-load current corresponds to friction.
        let friction = sheet.no_load[1] * sheet.torque_constant;
        let at_no_load = envelope.peak_torque(1.0, sheet.no_load[0] * RPM);
        assert!((at_no_load - friction).abs() < budget::DATA_SHEET * sheet.stall[0]);
        let [speed, torque, current] = sheet.nominal;
        let shaft = envelope.peak_torque(1.0, speed * RPM) - friction;
        near(shaft, torque, budget::DATA_SHEET_NOMINAL);
        let found = prepared.current(torque + friction, speed * RPM).unwrap();
        near(found, current, budget::DATA_SHEET_NOMINAL);
    }
}

/// WITTENSTEIN, *premo SP*, operating manual 4022-D045530, table 16, 320 V bus: six stators with four pole pairs. k_t (N·m/A), k_e
/// (V/krpm, RMS), largest power (kW), torque (N·m) and current (A), stall torque (N·m), no-load speed (rpm), terminal
/// resistance (Ω) and inductance (mH).
const PREMO: [[f64; 9]; 6] = [
    [0.35, 21.0, 0.90, 1.40, 4.36, 0.60, 10_530.0, 15.1, 10.4],
    [0.39, 23.7, 1.88, 2.84, 7.74, 1.17, 9_330.0, 5.70, 6.12],
    [0.41, 25.0, 1.38, 2.76, 7.71, 1.09, 8_855.0, 7.48, 10.2],
    [0.52, 31.6, 2.49, 5.53, 12.0, 2.11, 7_023.0, 3.72, 7.43],
    [0.51, 31.1, 2.75, 6.09, 13.3, 2.46, 7_166.0, 3.23, 6.97],
    [0.54, 32.5, 8.98, 16.7, 34.4, 6.38, 6_908.0, 0.53, 2.25],
];

/// Computed over published no-load speed [1.008 to 1.023]: the maker's motor has friction.
const NO_LOAD: RangeInclusive<f64> = 1.005..=1.025;
/// Computed over published largest power with the winding at 20 °C [0.971 to 1.091].
const COLD_POWER: RangeInclusive<f64> = 0.965..=1.095;
/// The same at the winding's maximum of 140 °C [0.939 to 0.964].
const HOT_POWER: RangeInclusive<f64> = 0.935..=0.970;

#[test]
fn servo_motors_have_the_power_and_the_no_load_speed_of_their_data_sheet() {
    for [
        k_t,
        k_e,
        power,
        peak,
        current,
        stall,
        no_load,
        resistance,
        inductance,
    ] in PREMO
    {
        let motor = |max_temperature| Motor {
            bus_voltage: Some(320.0),
            peak_torque: Some(peak),
            standstill_torque: Some(stall),
            winding: Winding {
                torque_constant: Some(k_t),
                voltage_constant: Some(k_e / (1000.0 * RPM)),
                resistance: Some(resistance),
                inductance: Some(inductance * 1e-3),
                pole_pairs: Some(4.0),
                peak_current: Some(current),
                ..Winding::default()
            },
            thermal: Thermal {
                max_temperature,
                ..Thermal::default()
            },
            ..bare()
        };
        let [cold, hot] = [None, Some(140.0)].map(|t| Envelope::of(&motor(t)));
        let speed = cold.max_speed() / (no_load * RPM);
        assert!(
            NO_LOAD.contains(&speed),
            "{speed} of the no-load speed {no_load}"
        );
        let largest = |envelope: &Envelope| {
            let speeds = (0..4000).map(|k| envelope.max_speed() * f64::from(k) / 4000.0);
            speeds
                .map(|n| n * envelope.peak_torque(1.0, n))
                .fold(0.0, f64::max)
        };
        let [cold, hot] = [cold, hot].map(|envelope| largest(&envelope) / (power * 1e3));
        println!("no-load speed {speed:.3}, power {cold:.3} at 20 °C, {hot:.3} at 140 °C");
        assert!(COLD_POWER.contains(&cold), "{cold} of {power} kW");
        assert!(HOT_POWER.contains(&hot), "{hot} of {power} kW");
    }
}
