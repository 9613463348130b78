//! The lowest natural frequency, against the eigenvalues of the chain of masses and springs.

use std::f64::consts::TAU;

use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleVerdict;

use super::{Stand, budget, near, press_text};
use jred_report::list::rule_words::{note, sentence};

/// Natural frequencies (Hz) in rising order of a chain of masses with springs between neighbours; the first mass may be fixed.
fn chain(held: bool, masses: &[f64], springs: &[f64]) -> Vec<f64> {
    let n = masses.len();
    let mut matrix = vec![vec![0.0; n]; n];
    for (k, spring) in springs.iter().enumerate() {
        for (a, b, sign) in [
            (k, k, 1.0),
            (k + 1, k + 1, 1.0),
            (k, k + 1, -1.0),
            (k + 1, k, -1.0),
        ] {
            matrix[a][b] += sign * spring / (masses[a] * masses[b]).sqrt();
        }
    }
    if held {
        matrix.remove(0);
        for row in &mut matrix {
            row.remove(0);
        }
    }
    let mut values: Vec<f64> = eigenvalues(matrix)
        .iter()
        .map(|x| x.max(0.0).sqrt() / TAU)
        .collect();
    values.sort_by(f64::total_cmp);
    values
}

/// Eigenvalues of a symmetric matrix, by Jacobi's rotations.
fn eigenvalues(mut a: Vec<Vec<f64>>) -> Vec<f64> {
    let n = a.len();
    for _ in 0..20 {
        for p in 0..n {
            for q in p + 1..n {
                let (sin, cos) = (0.5 * (2.0 * a[p][q]).atan2(a[q][q] - a[p][p])).sin_cos();
                for row in &mut a {
                    (row[p], row[q]) = (cos * row[p] - sin * row[q], sin * row[p] + cos * row[q]);
                }
                let (first, second) = a.split_at_mut(q);
                for (x, y) in first[p].iter_mut().zip(&mut second[0]) {
                    (*x, *y) = (cos * *x - sin * *y, sin * *x + cos * *y);
                }
            }
        }
    }
    (0..n).map(|k| a[k][k]).collect()
}

fn stand(stiffness: &str) -> Stand {
    let mut stand = Stand::new(&format!("{}\n{stiffness}\n", press_text()));
    stand.gearbox.stiffness = Some(9000.0);
    stand
}

#[test]
fn the_motor_holds_its_position() {
    let shaft = 15_000.0;
    for (section, shaft) in [
        ("", f64::INFINITY),
        ("[stiffness]\nshaft = \"15 kN m/rad\"", shaft),
        (
            "[stiffness]\nshaft = \"135 kN m/rad\"\nat = \"drive-link\"",
            shaft,
        ),
    ] {
        let stand = stand(section);
        let load = stand.duty.figures(|i| i.input_inertia).max;
        let rotor = (8e-4 + 0.8e-4) * 25.0;
        // Two springs need a coupling of nearly zero mass between them.
        let (masses, springs) = if shaft.is_finite() {
            (vec![rotor, 1e-6 * load, load], vec![9000.0, shaft])
        } else {
            (vec![rotor, load], vec![9000.0])
        };
        let fixed = chain(true, &masses, &springs)[0];
        let free = chain(false, &masses, &springs)[1];
        let found = stand.found(true, Rule::NaturalFrequency);
        near("fixed", found.value, fixed, budget::COUPLING);
        // 360° in 0.4 s by the press's law, or the speed of the crank.
        let fastest = stand.duty.figures(|i| i.omega).peak() / TAU;
        near("drive", found.rating, fastest.max(1.0 / 0.4), 1e-6);
        let check = stand.check(true, &stand.file.rules, Rule::NaturalFrequency);
        let shown: f64 = note(&check)
            .split('(')
            .nth(1)
            .unwrap()
            .split(' ')
            .next()
            .unwrap()
            .parse()
            .unwrap();
        near("free", shown, free, 1e-3);
        assert_eq!(
            note(&check).contains("using rigid shafts"),
            section.is_empty(),
            "{}",
            note(&check)
        );
    }
}

/// Ten times the drive frequency, or a warning; a limit if the rules have one. The largest inertia has the lowest frequency.
#[test]
fn ten_times_the_drive_frequency() {
    let mut stand = stand("");
    let lowest = |stiffness: f64, stand: &Stand| {
        stand
            .duty
            .instants
            .iter()
            .map(|i| (stiffness / i.input_inertia).sqrt() / TAU)
            .fold(f64::MAX, f64::min)
    };
    let drive = stand.found(true, Rule::NaturalFrequency).rating;
    for factor in [9.9, 10.1] {
        let wanted = factor * drive;
        let stiffness = 9000.0 * (wanted / lowest(9000.0, &stand)).powi(2);
        stand.gearbox.stiffness = Some(stiffness);
        let found = stand.found(true, Rule::NaturalFrequency);
        near("lowest", found.value, lowest(stiffness, &stand), 1e-12);
        let check = stand.check(true, &stand.file.rules, Rule::NaturalFrequency);
        let expected = if factor < 10.0 {
            RuleVerdict::Warn
        } else {
            RuleVerdict::Pass
        };
        assert_eq!(check.verdict, expected, "{}", sentence(&check));
        near("limit", check.limit.unwrap(), 10.0 * drive, 1e-12);
        near("margin", check.margin.unwrap(), 1.0 - 10.0 / factor, 1e-9);
        let strict = super::read(&format!(
            "{}\n[rules]\nnatural_frequency = 10\n",
            press_text()
        ));
        let check = stand.check(true, &strict.rules, Rule::NaturalFrequency);
        assert_eq!(check.verdict == RuleVerdict::Fail, factor < 10.0);
    }
}

#[test]
fn nothing_known_is_not_checked() {
    let stand = Stand::press();
    for geared in [false, true] {
        let check = stand.check(geared, &stand.file.rules, Rule::NaturalFrequency);
        assert_eq!(check.verdict, RuleVerdict::NotChecked);
        assert!(note(&check).contains("stiffness"), "{}", note(&check));
    }
    // Coupled directly: only the shaft.
    let stand = Stand::new(&format!(
        "{}\n[stiffness]\nshaft = \"2 kN m/rad\"\n",
        press_text()
    ));
    assert!(stand.found(false, Rule::NaturalFrequency).is_known());
}
