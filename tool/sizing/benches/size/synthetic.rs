//! A catalogue of the size and the statistics of the public Motor-Gearbox Database, for where that is not at hand.

use jred_sizing::catalogue::Commutation;
use jred_sizing::catalogue::{Catalogue, Gearbox, Motor, Thermal, Winding};
use rand::SeedableRng as _;
use rand::rngs::ChaCha8Rng;
use rand_distr::{Distribution as _, LogNormal, Uniform};

/// Motors and gearboxes: every motor with every gearbox and without makes 499·(171 + 1) = 85,828 drives, as many as the
/// database has.
const GEARBOXES: usize = 171;
const MOTORS: usize = 499;

/// The catalogue, the same on every run. Medians are those of the database, spreads about: continuous torque k_t·I 14 mN·m,
/// rotor inertia 9.2e-5·T^1.36, motor constant k_t/√R 0.20·T^0.76, no-load speed 1070 rad/s, friction stated for every fifth;
/// gearboxes of one to five stages of 3 to 5.3, each with an efficiency of 0.9, output torque 1 N·m.
pub(crate) fn catalogue() -> Catalogue {
    let built_in = Catalogue::load(None, None).unwrap_or_default();
    let (Some(motor), Some(gearbox)) = (built_in.motors.first(), built_in.gearboxes.first()) else {
        return built_in;
    };
    let mut rng = ChaCha8Rng::seed_from_u64(85_828);
    Catalogue {
        motors: (0..MOTORS).map(|k| of_motor(motor, k, &mut rng)).collect(),
        gearboxes: (0..GEARBOXES)
            .map(|k| of_gearbox(gearbox, k, &mut rng))
            .collect(),
        ..Catalogue::default()
    }
}

/// Log-normal about a median.
fn about(median: f64, spread: f64, rng: &mut ChaCha8Rng) -> f64 {
    LogNormal::new(0.0, spread).map_or(median, |d| median * d.sample(rng))
}

fn within(low: f64, high: f64, rng: &mut ChaCha8Rng) -> f64 {
    Uniform::new(low, high).map_or(low, |d| d.sample(rng))
}

fn of_motor(like: &Motor, k: usize, rng: &mut ChaCha8Rng) -> Motor {
    let torque = about(0.0142, 1.9, rng);
    let voltage = [6.0, 12.0, 24.0, 24.0, 36.0, 48.0][k % 6];
    let constant = voltage / about(1070.0, 0.9, rng);
    let motor_constant = about(0.199 * torque.powf(0.756), 0.18, rng);
    let current = torque / constant;
    let mut motor = like.clone();
    motor.key = format!("motor-{k}");
    motor.rated_torque = Some(torque);
    motor.rated_speed = None;
    motor.standstill_torque = None;
    motor.peak_torque = None;
    motor.max_speed = (!k.is_multiple_of(7)).then(|| voltage / constant * within(0.6, 1.6, rng));
    motor.max_power = None;
    motor.rotor_inertia = about(9.2e-5 * torque.powf(1.362), 0.79, rng);
    motor.corner_speed = None;
    motor.torque_at_max_speed = None;
    motor.peak_curve = Vec::new();
    motor.continuous_curve = Vec::new();
    motor.friction = if k.is_multiple_of(5) {
        [0.01 * torque, 1e-5 * torque]
    } else {
        [0.0; 2]
    };
    motor.winding = Winding {
        torque_constant: Some(constant),
        voltage_constant: Some(constant),
        resistance: Some((constant / motor_constant).powi(2)),
        rated_current: Some(current),
        commutation: Commutation::Block,
        ..Winding::default()
    };
    motor.thermal = Thermal {
        winding_resistance: Some(about(2.8, 1.0, rng)),
        housing_resistance: Some(about(17.6, 1.0, rng)),
        ..Thermal::default()
    };
    motor.brake = None;
    motor.bus_voltage = Some(voltage);
    motor
}

fn of_gearbox(like: &Gearbox, k: usize, rng: &mut ChaCha8Rng) -> Gearbox {
    let stages = 1 + (k % 5) as i32;
    let torque = about(1.0, 1.5, rng);
    let mut gearbox = like.clone();
    gearbox.key = format!("gearbox-{k}");
    gearbox.ratio = within(3.0, 5.3, rng).powi(stages);
    gearbox.rated_torque = Some(0.7 * torque);
    gearbox.peak_torque = Some(torque);
    gearbox.emergency_torque = None;
    gearbox.rated_speed = None;
    gearbox.max_speed = None;
    gearbox.inertia = about(1.1e-8, 2.0, rng);
    gearbox.efficiency = 0.9f64.powi(stages);
    gearbox.back_efficiency = gearbox.efficiency;
    gearbox.no_load_torque = 0.0;
    gearbox
}
