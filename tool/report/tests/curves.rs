//! The curves of a machine, written as CSV and read back as a machine.

use std::f64::consts::TAU;

use jred::machine::Reducible as _;
use jred_analysis::checked;
use jred_analysis::reduce::{Over, Request, Sets, reduce};
use jred_report::table::output;
use jred_report::table::output::Format;

use crate::support::{Folder, budget, press_file};

const MACHINE: &str = r#"
gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "reduced-curves"
file = "curves.csv"
range = "turn"
"#;

/// The CSV of `jred reduce` is read back as the same machine.
#[test]
fn an_exported_machine_comes_back() {
    let file = checked::read(&press_file()).unwrap();
    let folder = Folder::new();
    let request = |positions| Request {
        over: Over::Angle,
        positions,
        sets: Sets {
            curves: true,
            links: true,
            ..Sets::default()
        },
        state: None,
    };
    let mut before: Option<[f64; 2]> = None;
    for rows in [360, 720] {
        let csv = output::write(&reduce(&file, &request(rows)).unwrap(), Format::Csv, "");
        folder.file("curves.csv", csv);
        let back = checked::parse("machine.toml", MACHINE, folder.path("")).unwrap();
        let original = file.with_drive_train().unwrap();
        let (mut j_error, mut slope_error, mut weight_error) = (0.0f64, 0.0f64, 0.0f64);
        let (mut j_most, mut slope_most, mut weight_most) = (0.0f64, 0.0f64, 0.0f64);
        for k in 0..1999 {
            let phi = TAU * (f64::from(k) + 0.5) / 1999.0;
            let [a, b] = [
                original.reduction(phi).unwrap(),
                back.machine.reduction(phi).unwrap(),
            ];
            j_error = j_error.max((a.inertia - b.inertia).abs());
            slope_error = slope_error.max((a.inertia_slope - b.inertia_slope).abs());
            weight_error = weight_error.max((a.potential_slope - b.potential_slope).abs());
            j_most = j_most.max(a.inertia);
            slope_most = slope_most.max(a.inertia_slope.abs());
            weight_most = weight_most.max(a.potential_slope.abs());
            // Coulomb friction has bends at the dead centres, which a smooth curve rounds.
            assert!(
                (a.coulomb - b.coulomb).abs() <= 0.02 * (1.0 + a.coulomb),
                "{phi}"
            );
        }
        let found = [j_error / j_most, slope_error / slope_most];
        println!(
            "{rows} rows: J {:.1e}, J' {:.1e}, weight {:.1e}",
            found[0],
            found[1],
            weight_error / weight_most
        );
        assert!(
            found[0] < budget::IMPORTED[0] && found[1] < budget::IMPORTED[1],
            "{found:?}"
        );
        assert!(weight_error < budget::IMPORTED[0] * weight_most);
        if let Some([j, slope]) = before {
            assert!((10.0..25.0).contains(&(j / found[0])), "order 4");
            assert!((5.0..12.0).contains(&(slope / found[1])), "order 3");
        }
        before = Some(found);
        let facts: Vec<String> = back
            .machine
            .mechanism()
            .facts()
            .iter()
            .map(|f| f.text.clone())
            .collect();
        assert!(
            facts
                .iter()
                .any(|text| text.contains("of the largest slope in the file")),
            "{facts:?}"
        );
    }
}
