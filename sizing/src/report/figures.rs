//! The figures of the report.

use jred::{Error, Reducible as _};

use super::term_names;
use crate::coordinate::{Coordinate, positions, whole_range};
use crate::drive::{Judged, RPM};
use crate::duty::Duty;
use crate::envelope::Envelope;
use crate::machine::MachineFile;
use crate::output::Columns;
use crate::plot::{Axes, Series, Style, bars, lines, lines_two_axes};
use crate::rules::Rules;

/// Intervals of the figures over the range.
const POSITIONS: usize = 360;

pub(super) fn line(name: &str, points: Vec<(f64, f64)>) -> Series<'_> {
    Series {
        name,
        points,
        style: Style::Line,
    }
}

fn dashed(name: &str, points: Vec<(f64, f64)>) -> Series<'_> {
    Series {
        name,
        points,
        style: Style::Dashed,
    }
}

/// J_red and J_red′ over the range.
pub(super) fn reduced_inertia(file: &MachineFile) -> Result<String, Error> {
    let machine = file.with_drive_train()?;
    let coordinate = Coordinate::of(machine.mechanism())?;
    let (mut inertia, mut slope) = (Vec::new(), Vec::new());
    for phi in whole_range(machine.domain(), POSITIONS) {
        let point = machine.reduction(phi)?;
        inertia.push((coordinate.shown(phi), point.inertia[0]));
        slope.push((coordinate.shown(phi), point.inertia[1]));
    }
    let (y, slope_y, names) = match coordinate {
        Coordinate::Angle => ("J_red [kg·m²]", "J_red′ [kg·m²/rad]", ["J_red", "J_red′"]),
        Coordinate::Length => ("m_red [kg]", "m_red′ [kg/m]", ["m_red", "m_red′"]),
    };
    let axes = Axes {
        title: "",
        x: coordinate.axis(),
        y,
    };
    Ok(lines_two_axes(
        &axes,
        &[line(names[0], inertia)],
        slope_y,
        &[dashed(names[1], slope)],
    ))
}

/// The parts of the reduced torque over the range; the viscous one at the size of the speed `speed`.
pub(super) fn reduced_torque(file: &MachineFile, speed: f64) -> Result<String, Error> {
    let coordinate = Coordinate::of(file.machine.mechanism())?;
    let mut parts = [const { Vec::new() }; 4];
    for phi in whole_range(file.machine.domain(), POSITIONS) {
        let point = file.machine.bare_reduction(phi)?;
        let values = [
            -point.potential_energy[1],
            point.process,
            -point.viscous * speed,
            -point.coulomb,
        ];
        for (part, value) in parts.iter_mut().zip(values) {
            part.push((coordinate.shown(phi), value));
        }
    }
    let names = [
        "weight −U′",
        "process",
        "viscous −b·ω at mean speed",
        "opposing −c",
    ];
    let series: Vec<Series> = names
        .into_iter()
        .zip(parts)
        .filter(|(_, points)| points.iter().any(|p| p.1 != 0.0))
        .map(|(name, points)| line(name, points))
        .collect();
    let axes = Axes {
        title: "",
        x: coordinate.axis(),
        y: match coordinate {
            Coordinate::Angle => "reduced torque [N·m]",
            Coordinate::Length => "reduced force [N]",
        },
    };
    Ok(lines(&axes, &series))
}

/// Motor torque and the load's part of it over the cycle, with RMS.
pub(super) fn torque_over_time(best: &Judged, duty: &Duty) -> String {
    let torque = duty
        .instants
        .iter()
        .map(|i| (i.t, best.drive.motor_point(i).torque));
    let rotor = duty.instants.iter().map(|i| {
        let alpha = i.input_alpha * best.drive.ratio();
        (i.t, best.drive.motor.rotor_inertia * alpha)
    });
    let rms = best.duty.torque.rms;
    let axes = Axes {
        title: "",
        x: "time [s]",
        y: "motor torque [N·m]",
    };
    lines(
        &axes,
        &[
            line("motor torque", torque.collect()),
            line("of which the rotor itself", rotor.collect()),
            dashed("RMS", vec![(0.0, rms), (duty.duration, rms)]),
        ],
    )
}

/// Motor speed over the cycle.
pub(super) fn speed_over_time(best: &Judged, duty: &Duty) -> String {
    let speed = duty
        .instants
        .iter()
        .map(|i| (i.t, best.drive.motor_point(i).speed / RPM));
    let axes = Axes {
        title: "",
        x: "time [s]",
        y: "motor speed [rpm]",
    };
    lines(&axes, &[line("motor speed", speed.collect())])
}

/// The torque-speed plane: envelope, limits of the rules, the duty's points, and the RMS point.
pub(super) fn torque_speed_plane(best: &Judged, duty: &Duty, rules: &Rules) -> String {
    let envelope = Envelope::of(best.drive.motor);
    let top = envelope.max_speed();
    let curve = |torque: &dyn Fn(f64) -> f64| -> Vec<(f64, f64)> {
        let speeds = (0..=200).map(|k| top * f64::from(k) / 200.0);
        let mut points: Vec<(f64, f64)> = speeds.map(|n| (n / RPM, torque(n))).collect();
        points.push((top / RPM, 0.0));
        points
    };
    let points = duty.instants.iter().map(|i| {
        let point = best.drive.motor_point(i);
        (point.speed.abs() / RPM, point.torque.abs())
    });
    let axes = Axes {
        title: "",
        x: "speed |n| [rpm]",
        y: "torque |T| [N·m]",
    };
    // A dot would be lost among the duty's: a cross.
    let (n, rms) = (best.duty.mean_speed / RPM, best.duty.torque.rms);
    let (dn, dt) = (0.012 * top / RPM, 0.03 * best.drive.motor.peak_torque);
    let gap = (f64::NAN, f64::NAN);
    let cross = vec![
        (n - dn, rms),
        (n + dn, rms),
        gap,
        (n, rms - dt),
        (n, rms + dt),
    ];
    let allowed = |n: f64| rules.peak_torque * envelope.peak_torque(n);
    let continuous = |n: f64| rules.rms_torque * envelope.continuous_torque(n);
    lines(
        &axes,
        &[
            line("peak torque", curve(&|n| envelope.peak_torque(n))),
            line("S1 torque", curve(&|n| envelope.continuous_torque(n))),
            dashed("allowed peak", curve(&allowed)),
            dashed("allowed RMS", curve(&continuous)),
            Series {
                name: "duty",
                points: points.collect(),
                style: Style::Dots,
            },
            line("RMS at mean speed", cross),
        ],
    )
}

/// Peak and RMS of every term of the torque at the drive link.
pub(super) fn terms(duty: &Duty) -> String {
    let names = term_names();
    let groups: Vec<(&str, Vec<(&str, f64)>)> = names
        .iter()
        .enumerate()
        .map(|(k, name)| {
            let figures = duty.figures(|i| i.terms.values()[k]);
            (
                name.as_str(),
                vec![("largest magnitude", figures.peak()), ("RMS", figures.rms)],
            )
        })
        .collect();
    let axes = Axes {
        title: "",
        x: "",
        y: "torque [N·m]",
    };
    bars(&axes, &groups)
}

/// Mean and largest share of every link in the reduced inertia.
pub(super) fn links(file: &MachineFile) -> Result<String, Error> {
    let machine = file.with_drive_train()?;
    let names = machine.mechanism().link_names();
    let mut shares = vec![(0.0f64, 0.0f64); names.len()];
    for phi in positions(machine.domain(), POSITIONS) {
        let inertias = machine.link_inertias(phi)?;
        for (share, inertia) in shares.iter_mut().zip(inertias) {
            share.0 += inertia[0] / POSITIONS as f64;
            share.1 = share.1.max(inertia[0]);
        }
    }
    let ratio = file.drive_train.ratio();
    let train = file.drive_train.inertia_at_input() * ratio * ratio;
    let fixed = [("flywheel", file.flywheel), ("drive train", train)];
    let mut groups: Vec<(&str, Vec<(&str, f64)>)> = names
        .iter()
        .zip(&shares)
        .map(|(name, share)| (name.as_str(), vec![("mean", share.0), ("largest", share.1)]))
        .collect();
    let turning = fixed.iter().filter(|f| f.1 > 0.0);
    groups.extend(turning.map(|f| (f.0, vec![("mean", f.1), ("largest", f.1)])));
    let axes = Axes {
        title: "",
        x: "",
        y: match Coordinate::of(machine.mechanism())? {
            Coordinate::Angle => "share of J_red [kg·m²]",
            Coordinate::Length => "share of m_red [kg]",
        },
    };
    Ok(bars(&axes, &groups))
}

/// The plots of a simulation, with their headings.
pub(super) fn simulation(run: &Columns) -> Vec<(&'static str, String)> {
    let column = |name: &str| -> Vec<(f64, f64)> {
        let index = run.names().iter().position(|n| n == name);
        let value = |row: &[Option<f64>], k: usize| row.get(k).copied().flatten();
        let rows = run.rows().iter();
        rows.filter_map(|row| Some((value(row, 0)?, value(row, index?)?)))
            .collect()
    };
    let plot = |y: &str, names: &[&str]| {
        let series: Vec<Series> = names.iter().map(|n| line(n, column(n))).collect();
        let axes = Axes {
            title: "",
            x: "time [s]",
            y,
        };
        lines(&axes, &series)
    };
    let energies = [
        "kinetic energy [J]",
        "potential energy [J]",
        "motor work [J]",
        "process work [J]",
        "losses [J]",
    ];
    vec![
        (
            "Speed of the drive link",
            plot("ω [rad/s]", &["omega [rad/s]"]),
        ),
        ("Angle of the drive link", plot("φ [deg]", &["phi [deg]"])),
        (
            "Motor torque",
            plot("torque [N·m]", &["motor torque [N m]"]),
        ),
        ("Energies", plot("energy [J]", &energies)),
        (
            "Energy balance: zero but for the integrator's error",
            plot("energy [J]", &["energy balance [J]"]),
        ),
    ]
}
