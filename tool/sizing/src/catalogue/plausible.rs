//! Implausible values, mostly wrong units. They cause warnings, never errors: a catalogue may contain an unusual motor.
//!
//! The limits lie beyond the range of the built-in catalogue and of the 1037 motors and 2543 gearboxes of the Motor-Gearbox Database, from a 2 mm
//! micromotor to a 16 kW servo motor; see docs/catalogue.md.

use super::fault::Remarks;
use super::gearbox::Gearbox;
use super::motor::{Motor, MotorKind};
use jred_file::math;
use jred_file::number::rounding::figure;

/// Rotor inertia over rated torque to the power 5/3, (kg·m²)/(N·m)^(5/3): equal for similar shapes at equal shear stress.
const SLIMNESS: [f64; 2] = [5e-7, 3e-2];

/// Inertia over mass to the power 5/3 of a solid steel cylinder as long as its diameter, kg·m²/kg^(5/3): J = m·r²/2 with m = 2π·ρ·r³.
const CYLINDER: f64 = 3.7e-4;

/// Largest inertia of a rotor relative to a cylinder of the motor's mass: a thin ring has more than a cylinder.
const ROTOR: f64 = 30.0;

/// Largest inertia of a gearbox at its input relative to a cylinder of its mass.
const GEARS: f64 = 1.0;

/// Time in which the rated torque brings the bare rotor to rated speed (s).
const RUN_UP: [f64; 2] = [5e-4, 2.0];

/// Rated torque over mass (N·m/kg).
const TORQUE_DENSITY: [f64; 2] = [0.01, 30.0];

/// Rated torque times rated speed over the stated rated power: data sheets round the power to two digits.
const POWER: [f64; 2] = [0.93, 1.07];

/// Rated speed (rad/s): 0.5 rpm and 150 000 rpm.
const SPEED: [f64; 2] = [0.05, 15_700.0];

/// k_t·I over the torque that it should give: a winding saturates; an amplitude used as an RMS value gives 1.41.
const CURRENT_AND_TORQUE: [f64; 2] = [0.75, 1.35];

/// Allowed relative difference of voltage constant and torque constant.
const CONSTANTS: f64 = 0.15;

/// Efficiency per stage, or in total if the number of stages is not given.
const EFFICIENCY: f64 = 0.3;

/// Backlash (rad): 3°.
const BACKLASH: f64 = 0.053;

/// Output torque over mass (N·m/kg).
const GEARBOX_DENSITY: [f64; 2] = [0.01, 2000.0];

/// Inertia relative to a cylinder of the mass.
fn of_cylinder(inertia: f64, mass: Option<f64>) -> f64 {
    mass.map_or(0.0, |mass| {
        inertia / (CYLINDER * math::pow(mass, 5.0 / 3.0))
    })
}

/// Warns of an inertia too large for the mass.
fn mass(
    remarks: &mut Remarks,
    place: &dyn Fn() -> String,
    key: &str,
    column: &str,
    inertia: f64,
    mass: Option<f64>,
    most: f64,
) {
    let share = of_cylinder(inertia, mass);
    if share > most {
        remarks.add("inertias that do not match the mass", || {
            format!(
                "{}: {column} of \"{key}\" is {} kg cm^2 at {} kg, {} times that of a solid cylinder of this mass: are the units \
                 right (kg cm^2, kg m^2, g cm^2)?",
                place(),
                figure(inertia * 1e4),
                figure(mass.unwrap_or(0.0)),
                figure(share.round())
            )
        });
    }
}

fn outside(value: f64, [least, most]: [f64; 2]) -> bool {
    !(least..=most).contains(&value)
}

/// `place` names file and line.
pub(super) fn motor(remarks: &mut Remarks, place: &dyn Fn() -> String, motor: &Motor) {
    let key = &motor.key;
    let rated = motor.rated_torque.or(motor.standstill_torque);
    let speed = motor
        .rated_speed
        .or(motor.max_speed)
        .or(motor.no_load_speed);
    if motor.kind == MotorKind::Rotary {
        if let Some(torque) = rated {
            let slimness = motor.rotor_inertia / math::pow(torque, 5.0 / 3.0);
            if outside(slimness, SLIMNESS) {
                remarks.add("rotor inertias that do not match the torque", || {
                    format!(
                        "{}: rotor_inertia of \"{key}\" is {} kg cm^2 at {} N m rated torque, {} than for any known \
                         motor: are the units right (kg cm^2, kg m^2, g cm^2)?",
                        place(),
                        figure(motor.rotor_inertia * 1e4),
                        figure(torque),
                        if slimness < SLIMNESS[0] { "less" } else { "more" },
                    )
                });
            }
        }
        mass(
            remarks,
            place,
            key,
            "rotor_inertia",
            motor.rotor_inertia,
            motor.mass,
            ROTOR,
        );
        if let Some((torque, speed)) = rated.zip(speed) {
            let time = motor.rotor_inertia * speed / torque;
            if outside(time, RUN_UP) {
                remarks.add("motors with an implausible run-up time", || {
                    format!(
                        "{}: \"{key}\" would reach its rated speed in {} s at rated torque without load: check torque, \
                         speed and inertia and their units",
                        place(),
                        figure(time)
                    )
                });
            }
        }
        if speed.is_some_and(|speed| outside(speed, SPEED)) {
            remarks.add("motors with an implausible speed", || {
                format!(
                    "{}: the speed of \"{key}\" is {} rpm: are rpm and rad/s mixed up?",
                    place(),
                    figure(speed.unwrap_or(0.0) / jred_file::units::RPM)
                )
            });
        }
        let density = rated.zip(motor.mass).map(|(torque, mass)| torque / mass);
        if density.is_some_and(|density| outside(density, TORQUE_DENSITY)) {
            remarks.add("motors with an implausible torque for their mass", || {
                format!(
                    "{}: \"{key}\" has {} N m of rated torque per kg: check torque and mass and their units",
                    place(),
                    figure(density.unwrap_or(0.0))
                )
            });
        }
    }
    if let Some((stated, found)) = motor.stated_power.zip(motor.rated_power())
        && outside(found / stated, POWER)
    {
        remarks.add("motors whose rated power is not torque times speed", || {
            format!(
                "{}: rated_power of \"{key}\" is {} W, but rated torque times rated speed is {} W: check the three and their units",
                place(),
                figure(stated),
                figure(found)
            )
        });
    }
    winding(remarks, place, motor);
    curves(remarks, place, motor);
}

fn winding(remarks: &mut Remarks, place: &dyn Fn() -> String, motor: &Motor) {
    let (key, winding) = (&motor.key, &motor.winding);
    let Some(k_t) = winding.torque_constant else {
        return;
    };
    let pairs = [
        ("rated", motor.rated_torque, winding.rated_current),
        (
            "standstill",
            motor.standstill_torque,
            winding.standstill_current,
        ),
    ];
    for (what, torque, current) in pairs {
        let Some((torque, current)) = torque.zip(current) else {
            continue;
        };
        if outside(k_t * current / torque, CURRENT_AND_TORQUE) {
            remarks.add("motors whose torque constant, current and torque contradict each other", || {
                format!(
                    "{}: torque_constant times {what}_current of \"{key}\" is {}, but its {what} torque is {}: are RMS \
                     values and amplitudes, or units, mixed up?",
                    place(),
                    figure(k_t * current),
                    figure(torque)
                )
            });
        }
    }
    let Some(k_e) = winding.voltage_constant else {
        return;
    };
    let due = k_t / winding.commutation.torque_per_voltage_constant();
    if outside(k_e / due, [1.0 - CONSTANTS, 1.0 + CONSTANTS]) {
        remarks.add("motors whose voltage constant does not match the torque constant", || {
            format!(
                "{}: voltage_constant of \"{key}\" is {} V s/rad, but {} V s/rad follows from its torque_constant: RMS \
                 value or amplitude, line to line or line to neutral?",
                place(),
                figure(k_e),
                figure(due)
            )
        });
    }
}

/// Compares curves with single figures.
fn curves(remarks: &mut Remarks, place: &dyn Fn() -> String, motor: &Motor) {
    let first = motor.peak_curve.first().map(|point| point[1]);
    if let Some((curve, peak)) = first.zip(motor.peak_torque)
        && outside(curve / peak, [0.98, 1.02])
    {
        remarks.add("motors whose peak curve and peak torque differ", || {
            format!(
                "{}: peak_curve of \"{}\" starts at {}, but its peak torque is {}: using the curve",
                place(),
                motor.key,
                figure(curve),
                figure(peak)
            )
        });
    }
}

/// `place` names file and line.
pub(super) fn gearbox(remarks: &mut Remarks, place: &dyn Fn() -> String, gearbox: &Gearbox) {
    let key = &gearbox.key;
    mass(
        remarks,
        place,
        key,
        "input_inertia",
        gearbox.inertia,
        gearbox.mass,
        GEARS,
    );
    let stages = f64::from(gearbox.stages.unwrap_or(1));
    if math::pow(gearbox.efficiency, 1.0 / stages) < EFFICIENCY {
        remarks.add("gearboxes with an implausible efficiency", || {
            format!(
                "{}: efficiency of \"{key}\" is {} %: are [%] and a plain share mixed up?",
                place(),
                figure(gearbox.efficiency * 100.0)
            )
        });
    }
    if gearbox.backlash.is_some_and(|play| play > BACKLASH) {
        remarks.add("gearboxes with an implausible backlash", || {
            format!(
                "{}: backlash of \"{key}\" is {} arcmin, more than 3 degrees: is the unit right?",
                place(),
                figure(gearbox.backlash.unwrap_or(0.0).to_degrees() * 60.0)
            )
        });
    }
    let torque = gearbox.rated_torque.or(gearbox.peak_torque);
    let density = torque.zip(gearbox.mass).map(|(torque, mass)| torque / mass);
    if density.is_some_and(|density| outside(density, GEARBOX_DENSITY)) {
        remarks.add("gearboxes with an implausible torque for their mass", || {
            format!(
                "{}: \"{key}\" has {} N m of output torque per kg: check torque and mass and their units",
                place(),
                figure(density.unwrap_or(0.0))
            )
        });
    }
    if let Some((peak, rated)) = gearbox.peak_torque.zip(gearbox.rated_torque)
        && peak < rated
    {
        remarks.add("gearboxes whose peak torque is below the rated one", || {
            format!(
                "{}: the peak torque of \"{key}\", {} N m, is below its rated torque, {} N m",
                place(),
                figure(peak),
                figure(rated)
            )
        });
    }
}
