// Limits of sgmsh-30a + npt025mf-3 for the duty meter `jred::duty`.
// Written by `jred size --meter`. Do not edit: run it again.
//
// machine: press.toml, Servo press, 60 mm stroke, 10 kN
// motor: Yaskawa SGMSH-30A
// gearbox: Beckhoff AG3400 NPT025 MF i=3
// rules: general (General practice)
// assumed: weight or loads move the machine when the motor is switched off, and the catalogue states no holding brake of this motor; choose it with a brake of at least 2.493 N m, or hold the machine in another way
// assumed: corner of the peak torque not given; using peak torque up to rated speed
// assumed: peak torque at maximum speed not given; using a straight line to the rated torque
// assumed: standstill torque not given; using the rated torque
// not monitored by the meter: holding torque, brake torque, inertia ratio, winding temperature, gearbox emergency torque, gearbox radial load, belt pretension, RMS current, peak current, motor voltage, bus voltage, natural frequency
//
// SI units. Speed and torque are those of the motor; output is that of the gearbox.

/// 80 % of the S1 torque, up to 0.15 % of its largest value below it (N m over rad/s).
pub const CONTINUOUS: [[f32; 2]; 8] = [
    [314.159_24, 7.831_117_6],
    [335.430_45, 7.333_092],
    [359.974_15, 6.832_947_7],
    [384.517_82, 6.393_94],
    [417.242_74, 5.892_096],
    [449.967_68, 5.463_227],
    [490.873_84, 5.006_421_6],
    [523.598_75, 4.700_420_4],
];

/// 80 % of the peak torque (N m over rad/s).
pub const PEAK: [[f32; 2]; 2] = [[314.159_24, 23.519_976], [523.598_75, 7.839_993_5]];

/// 90 % of the motor's maximum speed (rad/s).
pub const SPEED: f32 = 471.238_9;

/// 100 % of the gearbox's rated input speed n1N (rad/s).
pub const MEAN_SPEED: f32 = 324.631_23;

/// 100 % of the gearbox's acceleration torque T2B (N m).
pub const OUTPUT_PEAK: f32 = 80.0;

/// 100 % of the gearbox's rated torque T2N (N m).
pub const OUTPUT_MEAN: f32 = 40.0;

// No limit `regenerative_power`: not applicable to this drive.

/// 100 % of the moves per hour up to which T2B is valid, beyond which sizing gives a warning (1/h).
pub const CYCLES_PER_HOUR: f32 = 1_000.0;

/// The cycle (s).
pub const CYCLE_TIME: f32 = 0.5;

/// Values the cycle was sized with: those of the meter after one cycle, if each move of the drive link counts as a
/// cycle of the gearbox.
pub const SIZED: jred::duty::Figures<f32> = jred::duty::Figures {
    rms_torque: 4.197_991_4,
    mean_speed: 113.097_336,
    output_mean: 20.047_035,
    motoring_power: 387.682_13,
    regenerative_power: 80.092_79,
    motoring_energy: 193.841_06,
    regenerative_energy: 40.046_394,
    duration: 0.5,
    peak_torque: 20.728_36,
    peak_speed: 265.071_87,
    output_peak: 59.155_457,
    peak_share: Some(0.881_306_23),
    cycles_per_hour: 7_200.0,
    cycles: 1,
    ticks: 0,
    invalid: 0,
};

/// The limits, for `jred::duty::Meter::new`.
///
/// # Errors
/// None: the curves are in order.
pub fn limits() -> Result<jred::duty::Limits<f32>, jred::duty::LimitError> {
    Ok(jred::duty::Limits::new()
        .with_continuous(jred::duty::Curve::new(&CONTINUOUS)?)
        .with_peak(jred::duty::Curve::new(&PEAK)?)
        .with_speed(SPEED)
        .with_mean_speed(MEAN_SPEED)
        .with_output_peak(OUTPUT_PEAK)
        .with_output_mean(OUTPUT_MEAN)
        .with_cycles_per_hour(CYCLES_PER_HOUR))
}
