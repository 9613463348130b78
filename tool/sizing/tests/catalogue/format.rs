//! jred's own format: every column in CSV and in TOML, and the conditions within a row.

use std::f64::consts::{PI, SQRT_2};

use jred_sizing::catalogue::Commutation;
use jred_sizing::catalogue::{Brake, Catalogue, MotorKind, Sources};

use crate::support::{Folder, near};

/// Ratios of units are computed here in another order of operations than in the reader.
const UNIT: f64 = crate::support::budget::UNIT_CONVERSION;

pub(super) const MOTORS: &str = "\
key,maker,model,rated_torque [N m],rated_speed [rpm],standstill_torque [mN m],peak_torque [N m],max_speed [rad/s],max_power [kW],\
no_load_speed [rpm],rotor_inertia [kg cm^2],peak_corner_speed [rpm],peak_torque_at_max_speed [N m],peak_curve,continuous_curve,\
coulomb_friction [mN m],viscous_friction [N m/krpm],commutation,torque_constant [N m/A peak],voltage_constant [V/krpm],\
winding_resistance [Ohm],winding_inductance [mH],pole_pairs,rated_current [A rms],standstill_current [A peak],peak_current [A],\
no_load_current [mA],thermal_resistance_winding [K/W],thermal_resistance_housing [K/W],thermal_time_winding [s],\
thermal_time_housing [min],max_winding_temperature [C],brake_torque [N m],brake_inertia [kg cm^2],bus_voltage [V],mains_voltage [V],max_bus_voltage [kV],mass [kg],\
price [EUR],figures_from,source
m1,Maker,Model,8,3000,9000,36,500,3,6000,8.5,2500,10,0 rpm: 36 N m; 2500 rpm: 36 N m; 500 rad/s: 10 N m,0 rpm: 9 N m; 3000 rpm: 8 N m,\
50,2,sine,1.2,98.5,0.9,6.5,4,5.2,8.4,25,300,0.4,0.6,60,35,155,12,0.6,560,400,0.8,8.1,750.5,other,Sheet
";

pub(super) const MOTORS_TOML: &str = r#"
[[motor]]
key = "m1"
maker = "Maker"
model = "Model"
rated_torque = "8 N m"
rated_speed = "3000 rpm"
standstill_torque = "9 Nm"
peak_torque = "0.036 kN m"
max_speed = "500 rad/s"
max_power = "3000 W"
no_load_speed = "6000 rpm"
rotor_inertia = "8.5 kg·cm²"
peak_corner_speed = "2500 rpm"
peak_torque_at_max_speed = "10 N m"
peak_curve = ["0 rpm: 36 N m", "2500 rpm: 36 N m", "500 rad/s: 10 N m"]
continuous_curve = "0 rpm: 9 N m; 3000 rpm: 8 N m"
coulomb_friction = "0.05 N m"
viscous_friction = "2 N m/krpm"
commutation = "sine"
torque_constant = "1.2 N m/A peak"
voltage_constant = "98.5 mV/rpm"
winding_resistance = "0.9 Ω"
winding_inductance = "6500 uH"
pole_pairs = 4
rated_current = "5.2 A"
standstill_current = "8.4 A peak"
peak_current = "25 A"
no_load_current = "0.3 A"
thermal_resistance_winding = "0.4 K/W"
thermal_resistance_housing = "0.6 K/W"
thermal_time_winding = "1 min"
thermal_time_housing = "2100 s"
max_winding_temperature = "155 °C"
brake_torque = "12 N m"
brake_inertia = "0.6 kg cm^2"
bus_voltage = "560 V"
mains_voltage = "0.4 kV"
max_bus_voltage = "800 V"
mass = "8.1 kg"
price = 750.5
figures_from = "other"
source = "Sheet"
"#;

pub(super) const GEARBOXES: &str = "\
key,maker,model,ratio,reverses,stages,rated_output_torque [N m],peak_output_torque [N m],emergency_output_torque [N m],\
rated_input_speed [rpm],max_input_speed [rpm],input_inertia [kg cm^2],efficiency [%],back_driving [%],no_load_torque [mN m],\
stiffness [N m/arcmin],backlash [arcmin],shock_factors,mass [kg],price,figures_from,source
g1,Maker,Model,5,yes,1,50,100,190,3400,7000,0.67,97,same,300,9.5,8,1000/h: 1; 2000/h: 1.25; 5000/h: 2,4.4,900,,Sheet
g2,Maker,Model,40,,2,50,,,,7000,0,40,friction,,,,,,,,Sheet
g3,Maker,Model,30,no,,50,,,,7000,0,80,75,,,,,,,,Sheet
g4,Maker,Model,30,no,,50,,,,7000,0,80,self-locking,,,0,,,,,Sheet
";

const OTHERS: &str = r#"
[[amplifier]]
key = "a1"
maker = "Maker"
model = "Model"
rated_current = "6 A"
peak_current = "18 A rms"
peak_time = "3000 ms"
bus_voltage = "560 V"
mains_voltage = "400 V"
capacitance = "470 uF"
chopper_voltage = "760 V"
max_voltage = "820 V"
min_resistance = "22 Ohm"
constant_loss = "20 W"
loss_per_current = "8 W/A"
mass = "2300 g"
source = "Sheet"

[[resistor]]
key = "r1"
maker = "Maker"
model = "Model"
resistance = "33 Ohm"
rated_power = "0.2 kW"
peak_power = "15 kW"
pulse_energy = "6 kJ"
source = "Sheet"

[[motor]]
key = "l1"
maker = "Maker"
model = "Slide"
kind = "linear"
rated_force = "200 N"
peak_force = "0.6 kN"
rated_speed = "3 m/s"
max_speed = "5000 mm/s"
moving_mass = "2.4 kg"
friction_force = "4 N"
viscous_friction = "3 N s/m"
torque_constant = "60 N/A"
voltage_constant = "35 V s/m"
peak_curve = "0 m/s: 600 N; 5 m/s: 100 N"
source = "Sheet"
"#;

pub(super) fn open(files: &[(&str, &str)]) -> Result<Catalogue, String> {
    let folder = Folder::new();
    for (name, text) in files {
        folder.file(name, text);
    }
    let sources = Sources {
        catalogues: vec![folder.path("")],
        ..Sources::default()
    };
    Catalogue::open(&sources).map_err(|e| format!("{:?}", miette::Report::new(e)))
}

#[test]
fn every_column_of_a_motor() {
    let rpm = jred_file::units::RPM;
    let catalogue = open(&[("motors.csv", MOTORS)]).unwrap();
    let motor = &catalogue.motors[0];
    let winding = &motor.winding;
    let thermal = &motor.thermal;
    let figures = [
        (motor.rated_torque, 8.0),
        (motor.rated_speed, 3000.0 * rpm),
        (motor.standstill_torque, 9.0),
        (motor.peak_torque, 36.0),
        (motor.max_speed, 500.0),
        (motor.max_power, 3000.0),
        (motor.no_load_speed, 6000.0 * rpm),
        (Some(motor.rotor_inertia), 8.5e-4),
        (motor.corner_speed, 2500.0 * rpm),
        (motor.torque_at_max_speed, 10.0),
        (Some(motor.friction[0]), 0.05),
        (Some(motor.friction[1]), 2.0 / (1000.0 * rpm)),
        // An amplitude of 1 A is 1/√2 A RMS, so k_t per RMS ampere is √2 times as large.
        (winding.torque_constant, 1.2 * SQRT_2),
        (winding.voltage_constant, 98.5 / (1000.0 * rpm)),
        (winding.resistance, 0.9),
        (winding.inductance, 6.5e-3),
        (winding.pole_pairs, 4.0),
        (winding.rated_current, 5.2),
        (winding.standstill_current, 8.4 / SQRT_2),
        (winding.peak_current, 25.0),
        (winding.no_load_current, 0.3),
        (thermal.winding_resistance, 0.4),
        (thermal.housing_resistance, 0.6),
        (thermal.winding_time, 60.0),
        (thermal.housing_time, 2100.0),
        (thermal.max_temperature, 155.0),
        (motor.bus_voltage, 560.0),
        (motor.mains_voltage, 400.0),
        (motor.max_bus_voltage, 800.0),
        (motor.mass, 8.1),
        (motor.price, 750.5),
        (motor.brake.map(|b| b.torque), 12.0),
        (motor.brake.map(|b| b.inertia), 6e-5),
    ];
    for (index, (found, expected)) in figures.into_iter().enumerate() {
        near(&format!("figure {index}"), found.unwrap(), expected, UNIT);
    }
    assert_eq!(winding.commutation, Commutation::Sine);
    assert_eq!(motor.kind, MotorKind::Rotary);
    assert!(!motor.from_maker);
    let flat = |points: &[[f64; 2]]| points.iter().flatten().copied().collect::<Vec<f64>>();
    let peak = [0.0, 36.0, 2500.0 * rpm, 36.0, 500.0, 10.0];
    crate::support::near_column("peak curve", &flat(&motor.peak_curve), &peak, UNIT);
    let s1 = [0.0, 9.0, 3000.0 * rpm, 8.0];
    crate::support::near_column("S1 curve", &flat(&motor.continuous_curve), &s1, UNIT);
}

/// The same motor in TOML, in other units.
#[test]
fn a_motor_in_toml_is_the_same() {
    let of = |files| open(files).unwrap().motors[0].clone();
    let mut csv = of(&[("motors.csv", MOTORS)]);
    let mut toml = of(&[("own.toml", MOTORS_TOML)]);
    for motor in [&mut csv, &mut toml] {
        let winding = &mut motor.winding;
        let rounded = [
            &mut motor.max_power,
            &mut motor.peak_torque,
            &mut motor.standstill_torque,
            &mut winding.inductance,
            &mut winding.voltage_constant,
            &mut winding.no_load_current,
        ];
        for figure in rounded {
            *figure = figure.map(|x| (x * 1e9).round() / 1e9);
        }
        motor.friction[0] = (motor.friction[0] * 1e9).round() / 1e9;
    }
    assert_eq!(csv, toml);
    assert_eq!(
        csv.brake,
        Some(Brake {
            torque: 12.0,
            inertia: 0.6 * 1e-4,
            ..Default::default()
        })
    );
}

#[test]
fn every_column_of_a_gearbox() {
    let catalogue = open(&[("motors.csv", MOTORS), ("gearboxes.csv", GEARBOXES)]).unwrap();
    let g = &catalogue.gearboxes[0];
    let arcmin = PI / (180.0 * 60.0);
    let rpm = jred_file::units::RPM;
    let figures = [
        (Some(g.ratio), 5.0),
        (g.rated_torque, 50.0),
        (g.peak_torque, 100.0),
        (g.emergency_torque, 190.0),
        (g.rated_speed, 3400.0 * rpm),
        (g.max_speed, 7000.0 * rpm),
        (Some(g.inertia), 0.67e-4),
        (Some(g.efficiency), 0.97),
        (Some(g.back_efficiency), 0.97),
        (Some(g.no_load_torque), 0.3),
        (g.stiffness, 9.5 / arcmin),
        (g.backlash, 8.0 * arcmin),
        (g.mass, 4.4),
        (g.price, 900.0),
    ];
    for (index, (found, expected)) in figures.into_iter().enumerate() {
        near(&format!("figure {index}"), found.unwrap(), expected, UNIT);
    }
    assert!(g.reverses && !catalogue.gearboxes[1].reverses);
    assert_eq!(g.stages, Some(1));
    assert_eq!(
        g.shock_factors,
        [[1000.0, 1.0], [2000.0, 1.25], [5000.0, 2.0]]
    );
    // 2 − 1/η: with η below a half a gearbox is self-locking.
    near(
        "friction",
        catalogue.gearboxes[1].back_efficiency,
        2.0 - 1.0 / 0.4,
        UNIT,
    );
    near(
        "a share",
        catalogue.gearboxes[2].back_efficiency,
        0.75,
        UNIT,
    );
    assert_eq!(catalogue.gearboxes[3].back_efficiency, 0.0);
    assert_eq!(catalogue.gearboxes[3].inertia, 0.0);
    assert_eq!(catalogue.gearboxes[3].backlash, Some(0.0));
    assert_eq!(catalogue.gearboxes[2].stiffness, None);
    assert!(catalogue.gearboxes.iter().all(|g| !g.efficiency_assumed));
}

#[test]
fn amplifiers_resistors_and_linear_motors() {
    let catalogue = open(&[("own.toml", OTHERS)]).unwrap();
    let a = &catalogue.amplifiers[0];
    let figures = [
        (Some(a.rated_current), 6.0),
        (Some(a.peak_current), 18.0),
        (a.peak_time, 3.0),
        (a.bus_voltage, 560.0),
        (a.mains_voltage, 400.0),
        (a.capacitance, 470e-6),
        (a.chopper_voltage, 760.0),
        (a.max_voltage, 820.0),
        (a.min_resistance, 22.0),
        (Some(a.losses[0]), 20.0),
        (Some(a.losses[1]), 8.0),
        (a.mass, 2.3),
    ];
    for (index, (found, expected)) in figures.into_iter().enumerate() {
        near(
            &format!("amplifier {index}"),
            found.unwrap(),
            expected,
            UNIT,
        );
    }
    let r = &catalogue.resistors[0];
    let figures = [
        (Some(r.resistance), 33.0),
        (Some(r.rated_power), 200.0),
        (r.peak_power, 15e3),
        (r.pulse_energy, 6e3),
    ];
    for (index, (found, expected)) in figures.into_iter().enumerate() {
        near(&format!("resistor {index}"), found.unwrap(), expected, UNIT);
    }
    let l = &catalogue.motors[0];
    assert_eq!(l.kind, MotorKind::Linear);
    assert_eq!(
        (l.rated_torque, l.peak_torque, l.rated_speed, l.max_speed),
        (Some(200.0), Some(600.0), Some(3.0), Some(5.0))
    );
    assert_eq!((l.rotor_inertia, l.friction), (2.4, [4.0, 3.0]));
    assert_eq!(l.peak_curve, [[0.0, 600.0], [5.0, 100.0]]);
    assert!(l.from_maker);
}
