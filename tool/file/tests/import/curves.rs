//! `type = "reduced-curves"` against closed forms, and against the machines that the curves come from.

use std::f64::consts::{PI, TAU};
use std::fmt::Write;

use jred::Domain;
use jred::machine::Reducible;
use jred_file::model::coordinate::Coordinate;

use super::of_curves;
use crate::support::budget;

/// J = 2 + 0.7·cos φ in kg cm², T_potential = −3·sin φ + 0.5·cos 2φ, T = 1.2 + 0.4·sin φ, b = 0.05 + 0.02·cos φ.
fn closed_form(rows: usize, closing: bool) -> String {
    let mut csv = String::from("phi [rad],J [kg cm^2],T_potential [N m],T [N m],b [N m s]\n");
    for k in 0..rows + usize::from(closing) {
        let phi = TAU * k as f64 / rows as f64;
        let weight = -3.0 * phi.sin() + 0.5 * (2.0 * phi).cos();
        writeln!(
            csv,
            "{phi:e},{:e},{weight:e},{:e},{:e}",
            2.0 + 0.7 * phi.cos(),
            1.2 + 0.4 * phi.sin(),
            0.05 + 0.02 * phi.cos()
        )
        .unwrap();
    }
    csv
}

/// Errors of J, J′, J″, U′, process at places between rows, each as a share of the amplitude.
fn errors(rows: usize, closing: bool) -> [f64; 5] {
    let file = of_curves(&closed_form(rows, closing), "turn").unwrap();
    assert_eq!(file.machine.domain(), Domain::Turn);
    let mut worst = [0.0f64; 5];
    for k in 0..997 {
        let phi = 4.0 * TAU * (f64::from(k) - 400.0) / 997.0;
        let r = file.machine.reduction(phi).unwrap();
        let [j, slope, bend] = r.inertias().map(|j| j * 1e4);
        let found = [
            (j - 2.0 - 0.7 * phi.cos()) / 0.7,
            (slope + 0.7 * phi.sin()) / 0.7,
            (bend + 0.7 * phi.cos()) / 0.7,
            (-r.potential_slope + 3.0 * phi.sin() - 0.5 * (2.0 * phi).cos()) / 3.0,
            (r.process - 1.2 - 0.4 * phi.sin()) / 0.4,
        ];
        for (worst, error) in worst.iter_mut().zip(found) {
            *worst = worst.max(error.abs());
        }
        assert!((r.viscous - 0.05 - 0.02 * phi.cos()).abs() < 0.02 * 0.02);
    }
    worst
}

/// The error of a cubic spline at equal steps: 5/384·h⁴ for the value, h³/24 for the slope, h²/8 for the second derivative of a
/// cosine, to two sides.
#[test]
fn a_cosine_has_the_error_of_a_cubic_spline() {
    for closing in [false, true] {
        let h = TAU / 60.0;
        let [value, slope, bend, weight, process] = errors(60, closing);
        println!(
            "J {value:.2e}, J' {slope:.2e}, J'' {bend:.2e}, weight {weight:.2e}, process {process:.2e}"
        );
        assert!(
            value < 5.0 / 384.0 * h.powi(4) && value > h.powi(4) / 1000.0,
            "{value:e}"
        );
        assert!(
            slope < h.powi(3) / 24.0 && slope > h.powi(3) / 2000.0,
            "{slope:e}"
        );
        assert!(
            bend < h.powi(2) / 8.0 && bend > h.powi(2) / 100.0,
            "{bend:e}"
        );
        // 0.5·cos 2φ beside 3·sin φ: 16 times the fourth derivative of a sixth of the amplitude.
        assert!(
            weight < 5.0 / 384.0 * h.powi(4) * (1.0 + 16.0 / 6.0),
            "{weight:e}"
        );
        assert!(process < 5.0 / 384.0 * h.powi(4), "{process:e}");
        let finer = errors(120, closing);
        for (order, (coarse, fine)) in [4, 3, 2, 4]
            .into_iter()
            .zip([value, slope, bend, weight].iter().zip(finer))
        {
            let ratio = coarse / fine / f64::from(1 << order);
            assert!((0.7..1.4).contains(&ratio), "order {order}: {ratio}");
        }
    }
}

/// Rows as uneven as those of a program with its own steps, from any position on, over a turn.
#[test]
fn rows_may_be_uneven_and_begin_anywhere() {
    let mut csv = String::from("\u{feff}# by hand\nphi [deg];J [kg m^2]\n");
    let mut phi = -130.0;
    for k in 0..70 {
        let j = 0.02 + 0.005 * f64::to_radians(phi).sin();
        let (phi_text, j_text) = (format!("{phi}"), format!("{j:.12}"));
        writeln!(
            csv,
            "{};{}",
            phi_text.replace('.', ","),
            j_text.replace('.', ",")
        )
        .unwrap();
        phi += 360.0 / 70.0 * (1.0 + 0.5 * (f64::from(k) * 1.3).sin());
        if phi > 226.0 {
            break;
        }
    }
    let file = of_curves(&csv, "turn").unwrap();
    for k in 0..500 {
        let phi = f64::from(k) * 0.05 - 7.0;
        let [j, slope, _] = file.machine.reduction(phi).unwrap().inertias();
        assert!((j - 0.02 - 0.005 * phi.sin()).abs() < 0.005 * 1e-5, "{phi}");
        assert!((slope - 0.005 * phi.cos()).abs() < 0.005 * 1e-3, "{phi}");
    }
}

/// A drive link that slides, on its stroke: m = 5 + 2·s/m + …, a cubic, comes back exactly; so do a spring's force and the work
/// that it stores.
#[test]
fn a_cubic_over_a_stroke_is_exact() {
    let mass = |s: f64| 5.0 + 2.0 * s - 3.0 * s * s + 10.0 * s * s * s;
    let mut csv = String::from("s [mm],m [kg],F_potential [N],c [N]\n");
    for k in 0..=20 {
        let s = 0.1 + 0.02 * f64::from(k);
        writeln!(csv, "{},{:e},{:e},12", s * 1e3, mass(s), -400.0 * (s - 0.2)).unwrap();
    }
    let file = of_curves(&csv, "stroke").unwrap();
    let mechanism = file.machine.mechanism();
    assert_eq!(mechanism.coordinate(), Coordinate::Length);
    let start = file.machine.reduction(0.1).unwrap().potential_energy;
    for k in 0..=300 {
        let s = (0.1 + 0.4 * f64::from(k) / 300.0).min(0.5);
        let r = file.machine.reduction(s).unwrap();
        let expected = [mass(s), 2.0 - 6.0 * s + 30.0 * s * s, -6.0 + 60.0 * s];
        for (found, expected) in r.inertias().into_iter().zip(expected) {
            assert!(
                (found - expected).abs() < budget::SPLINE_EXACT * 1e2,
                "{s}: {found} {expected}"
            );
        }
        assert!((r.potential_slope - 400.0 * (s - 0.2)).abs() < 1e-9);
        let stored = 200.0 * ((s - 0.2) * (s - 0.2) - 0.01);
        assert!((r.potential_energy - start - stored).abs() < 1e-9);
        assert!((r.coulomb - 12.0).abs() < 1e-12);
    }
    // A column of this name may be an angle or a length: its unit says which.
    let named = of_curves(&csv.replace("s [mm]", "position [mm]"), "stroke").unwrap();
    let mechanism = named.machine.mechanism();
    assert_eq!(mechanism.coordinate(), Coordinate::Length);
}

/// The machine that comes back asks the same of the drive by d'Alembert's principle, through the gearing of the curves.
#[test]
fn dalembert_finds_the_torque_of_the_curves() {
    let file = of_curves(&closed_form(90, true), "turn").unwrap();
    for k in 0..200 {
        let (phi, omega, alpha) = (f64::from(k) * 0.1 * PI, 12.0 - f64::from(k % 25), 300.0);
        let forces = file.machine.forces(phi, omega, alpha).unwrap();
        let expected = file
            .machine
            .reduction(phi)
            .unwrap()
            .torque(omega, alpha)
            .total();
        assert!(
            (forces.drive - expected).abs() < 1e-11,
            "{} {expected}",
            forces.drive
        );
    }
}
