//! Rows that contradict themselves.

use super::format::{GEARBOXES, MOTORS, MOTORS_TOML, open};
use crate::support::rows;

/// Contradictions in a row: the changed key, and words of the message.
#[test]
fn rows_that_contradict_themselves() {
    let motor = |from: &str, to: &str| {
        assert!(MOTORS_TOML.contains(from), "{from}");
        open(&[("own.toml", &MOTORS_TOML.replace(from, to))])
    };
    let cases = r#"
        "8 N m" => "-8 N m" => not a number greater than zero
        "8 N m" => 8 => has no unit: 8
        "8 N m" => "8" => possible units
        "8 N m" => "8 kg" => must be a torque, but "kg"
        "8 N m" => "8,5 N m" => "8.5"
        "8 N m" => "40 N m" => below its rated_torque
        "8.5 kg·cm²" => "0 kg cm^2" => not a number greater than zero
        "500 rad/s"\n => "100 rad/s"\n => below its rated_speed
        "25 A" => "5 A" => below its rated_current
        ["0 rpm: 36 N m", "2500 rpm: 36 N m", "500 rad/s: 10 N m"] => "0 rpm: 36 N m" => at least two points
        ["0 rpm: 36 N m", "2500 rpm: 36 N m", "500 rad/s: 10 N m"] => "1 rpm: 36 N m; 2 rpm: 3 N m" => standstill
        ["0 rpm: 36 N m", "2500 rpm: 36 N m", "500 rad/s: 10 N m"] => "0 rpm: 3 N m; 2 rpm: 36 N m" => must not increase
        ["0 rpm: 36 N m", "2500 rpm: 36 N m", "500 rad/s: 10 N m"] => "0 rpm: 36 N m; 0 rpm: 3 N m" => in increasing order
        ["0 rpm: 36 N m", "2500 rpm: 36 N m", "500 rad/s: 10 N m"] => "0 rpm: 36 N m; 9 m/s: 3 N m" => sliding motor
        ["0 rpm: 36 N m", "2500 rpm: 36 N m", "500 rad/s: 10 N m"] => "0 rpm: 36; 9 rpm: 3 N m" => has no unit
        ["0 rpm: 36 N m", "2500 rpm: 36 N m", "500 rad/s: 10 N m"] => "0 rpm 36 N m" => no colon
        pole_pairs = 4 => pole_pairs = 4.5 => whole number
        mains_voltage = "0.4 kV" => mains_voltage = "4000 V" => is 4000 V, but mains have 20 V to 1000 V
        mains_voltage = "0.4 kV" => mains_voltage = "0 V" => not a number greater than zero
        mains_voltage = "0.4 kV" => mains_voltage = "-400 V" => not a number greater than zero
        mains_voltage = "0.4 kV" => mains_voltage = 400 => has no unit: 400
        mains_voltage = "0.4 kV" => mains_voltage = "400 A" => must be a voltage
        max_bus_voltage = "800 V" => max_bus_voltage = "559 V" => below its bus_voltage
        // √2·0.4 kV = 565.7 V.
        max_bus_voltage = "800 V" => max_bus_voltage = "565 V" => below its mains_voltage
        "sine" => "square" => "sine" or "block"
        brake_torque = "12 N m" => => brake_torque
        peak_torque = "0.036 kN m" => rated_force = "3 N" => the motor is rotary
        model = "Model" => kind = "linear"\nmodel = "Model" => the motor is linear
        rated_speed =␣ => ratd_speed =␣ => did you mean "rated_speed"?
        [[motor]] => [[motr]] => did you mean "motor"?
        [[motor]] => [motor] => in double brackets: [[motor]]
        key = "m1" => key = "m1"\nkey = "m2" => remove or rename
    "#;
    for [from, to, words] in rows(cases) {
        let error = motor(&from, &to).unwrap_err();
        let flat = error
            .split_whitespace()
            .filter(|w| *w != "│")
            .collect::<Vec<_>>()
            .join(" ");
        assert!(flat.contains(&words), "{to}: {words:?} is not in\n{error}");
    }
    let gearbox = |from: &str, to: &str| {
        assert!(GEARBOXES.contains(from), "{from}");
        let table = GEARBOXES.replacen(from, to, 1);
        open(&[("motors.csv", MOTORS), ("gearboxes.csv", &table)]).unwrap_err()
    };
    let cases = r#"
        ,97, => ,101, => above 1
        ,50,100, => ,50,40, => below its rated_output_torque
        ,100,190, => ,100,90, => below its peak_output_torque
        ,3400,7000, => ,3400,3000, => below its rated_input_speed
        ,0.67, => ,-0.67, => not a number of zero or more
        ,0.67, => ,, => input_inertia of "g1" is empty
        97,same, => 97,both, => "friction"
        5000/h: 2, => 5000/h: 1.1, => increases with the cycles
        ,yes, => ,perhaps, => "yes" or "no"
    "#;
    for [from, to, words] in rows(cases) {
        let error = gearbox(&from, &to);
        assert!(error.contains(&words), "{to}: {words:?} is not in\n{error}");
    }
}
