//! `[[load]] table` on a link: what acts there is in the joints, as the plain load or the spring that it equals.

use std::f64::consts::TAU;
use std::fmt::Write;

use jred::machine::Reducible;
use jred_file::model::machine::MachineFile;

use super::parse;
use crate::reading::oblique_slider_crank;

const CRANK: f64 = 0.09;
const ROD: f64 = 0.3;

fn with(load: &str, csv: &str) -> MachineFile {
    let load = format!("[[load]]\ntable = \"loads.csv\"\n{load}\n");
    parse(&oblique_slider_crank("4 kg", &load), &[("loads.csv", csv)]).unwrap()
}

fn plain(slider: &str, loads: &str) -> MachineFile {
    parse(&oblique_slider_crank(slider, loads), &[]).unwrap()
}

fn places() -> impl Iterator<Item = f64> {
    (0..400).map(|k| TAU * (f64::from(k) * 0.618_033_988_749_895).fract())
}

/// Rows over a turn.
fn turn(header: &str, step: u32, row: impl Fn(f64) -> String) -> String {
    let mut csv = format!("{header}\n");
    for k in (0..=360).step_by(step as usize) {
        writeln!(csv, "{k},{}", row(f64::from(k).to_radians())).unwrap();
    }
    csv
}

/// Drive torque and every joint force of the mechanism agree, in motion both ways.
fn same_forces(a: &MachineFile, b: &MachineFile) {
    for phi in places() {
        for (omega, alpha) in [(7.0, 30.0), (-4.0, 11.0)] {
            let [a_forces, b_forces] =
                [a, b].map(|file| file.machine.forces(phi, omega, alpha).unwrap());
            let close = |what: &str, a: f64, b: f64| {
                assert!((a - b).abs() < 1e-9, "{what} at {phi}: {a} {b}");
            };
            close("drive", a_forces.drive, b_forces.drive);
            for k in 0..b.machine.mechanism().own_joints() {
                let [a, b] = [&a_forces, &b_forces].map(|forces| forces.reactions[k]);
                close("x", a.force[0], b.force[0]);
                close("y", a.force[1], b.force[1]);
                close("moment", a.moment, b.moment);
            }
            let reduced = a.machine.reduction(phi).unwrap().torque(omega, alpha);
            close("reduced", reduced.total(), a_forces.drive);
        }
    }
}

/// Constant rows of every column that acts on a link are the plain load, in every joint.
#[test]
fn constant_rows_load_the_joints_as_plain_loads() {
    let payload = turn("Position [deg],Payload [kg],Thrust [N]", 10, |_| {
        "2.5,80".into()
    });
    same_forces(
        &with("on = \"slider\"", &payload),
        &plain(
            "6.5 kg",
            "[[load]]\non = \"slider\"\nopposing_force = \"80 N\"\n",
        ),
    );
    let force = turn("Position [deg],Force [N]", 15, |_| "500".into());
    same_forces(
        &with(
            "on = \"rod\"\nat = [\"100 mm\", \"20 mm\"]\nangle = \"90 deg\"",
            &force,
        ),
        &plain(
            "4 kg",
            "[[load]]\non = \"rod\"\nat = [\"100 mm\", \"20 mm\"]\nforce = [\"0 N\", \"500 N\"]\n",
        ),
    );
    let both = turn(
        "Position [deg],Force x [N],Force y [kN],Moment [N m]",
        15,
        |_| "-300,0.2,7".into(),
    );
    same_forces(
        &with("on = \"rod\"\nat = [\"50 mm\", \"0 mm\"]", &both),
        &plain(
            "4 kg",
            "[[load]]\non = \"rod\"\nat = [\"50 mm\", \"0 mm\"]\nforce = [\"-300 N\", \"200 N\"]\n\
             [[load]]\non = \"rod\"\nmoment = \"7 N m\"\n",
        ),
    );
}

/// A force that falls in proportion to the slider's own displacement is a spring: drive torque and joint forces agree to
/// rounding, for a cubic curve through rows on a line is that line.
#[test]
fn a_force_over_displacement_is_a_spring() {
    let mut csv = String::from("s [mm],Force [N]\n");
    // x of the slider goes from 210 mm to 390 mm; the rows count from 200 mm.
    for s in (0..=200).step_by(20) {
        writeln!(csv, "{s},{}", -5 * (s - 60)).unwrap();
    }
    let table = with(
        "on = \"slider\"\nangle = \"0 deg\"\n\
         over = { point = \"slider\", along = \"x\", zero = \"200 mm\" }",
        &csv,
    );
    // F = −5 N/mm·(x − 260 mm): fixed at 900 mm, its length is 900 mm − x, without force at 640 mm.
    let spring = plain(
        "4 kg",
        "[[spring]]\nbetween = [\"slider\", { on = \"ground\", at = [\"900 mm\", \"0 mm\"] }]\n\
         stiffness = \"5 N/mm\"\nfree_length = \"640 mm\"\n",
    );
    same_forces(&table, &spring);
}

/// x and x′ of the slider.
fn slider(phi: f64) -> [f64; 2] {
    let (sin, cos) = phi.sin_cos();
    let root = (ROD * ROD - CRANK * CRANK * sin * sin).sqrt();
    [
        CRANK * cos + root,
        -CRANK * sin - CRANK * CRANK * sin * cos / root,
    ]
}

/// M(φ)·ψ′ of a moment on the rod, sin ψ = −(r/l)·sin φ; and F·cos ψ·x′ of a force on the slider. The curve through the rows errs by
/// at most 5/384·h⁴·max|f⁗|.
#[test]
fn the_reduced_torque_is_the_power_of_the_load() {
    let h = 5f64.to_radians();
    let moment = turn("phi [deg],M [N m]", 5, |phi| {
        format!("{:.17e}", 40.0 * phi.cos())
    });
    let file = with("on = \"rod\"", &moment);
    let none = plain("4 kg", "");
    let bound = 5.0 / 384.0 * h.powi(4) * 40.0;
    let mut most = 0.0f64;
    for phi in places() {
        let angular = -CRANK / ROD * phi.cos() / (1.0 - (CRANK / ROD * phi.sin()).powi(2)).sqrt();
        let [a, b] = [&file, &none].map(|file| file.machine.reduction(phi).unwrap());
        let found = a.process - b.process;
        let off = (found - 40.0 * phi.cos() * angular).abs();
        most = most.max(off);
        assert!(off < bound * 0.31, "{phi}: {off} {bound}");
    }
    assert!(most > 1e-3 * bound);
    // A force that turns with the rod, at its origin, the crank pin.
    let force = turn("phi [deg],Force [N]", 10, |_| "250".into());
    let file = with("on = \"rod\"\nangle_on_link = \"90 deg\"", &force);
    for phi in places() {
        let sin = -CRANK / ROD * phi.sin();
        let cos = (1.0 - sin * sin).sqrt();
        let [x, y] = [-CRANK * phi.sin(), CRANK * phi.cos()];
        let found = file.machine.reduction(phi).unwrap().process;
        let expected = 250.0 * (-sin * x + cos * y);
        assert!(
            (found - expected).abs() < 1e-10,
            "{phi}: {found} {expected}"
        );
    }
}

/// Rows over a part of the way: nothing outside, edges where the point passes the ends, and `between` picks one of the two ways past
/// them.
#[test]
fn outside_its_rows_a_table_may_be_zero() {
    let csv = "x [mm],Force [N]\n300,0\n320,-800\n340,-1000\n360,-900\n380,0\n";
    let load = "on = \"slider\"\nangle = \"0 deg\"\noutside = \"zero\"\n\
                over = { point = \"slider\", along = \"x\" }";
    let both_ways = with(load, csv);
    let edges: Vec<f64> = (0..).map_while(|k| both_ways.machine.edge(k)).collect();
    assert_eq!(edges.len(), 4);
    for edge in &edges {
        let [x, _] = slider(*edge);
        assert!((x - 0.3).abs().min((x - 0.38).abs()) < 1e-12, "{edge}");
    }
    let one_way = format!("{load}\nbetween = [\"180 deg\", \"360 deg\"]\nramp = \"1 deg\"");
    let one_way = with(&one_way, csv);
    let (mut inside, mut outside) = (0, 0);
    for phi in places() {
        let [x, way] = slider(phi);
        let [both, one] =
            [&both_ways, &one_way].map(|file| file.machine.reduction(phi).unwrap().process);
        if (0.3..=0.38).contains(&x) {
            // Force against the way out, between nothing and the largest row.
            let force = both / way;
            assert!((-1060.0..=1e-9).contains(&force), "{phi}: {force}");
            inside += 1;
        } else {
            assert!(both.abs() < 1e-12, "{phi}: {both}");
            outside += 1;
        }
        let growing = phi > TAU / 2.0 + 0.02 && phi < TAU - 0.02;
        assert!((one - if growing { both } else { 0.0 }).abs() < 1e-9 || phi.sin().abs() < 0.03);
    }
    assert!(inside > 100 && outside > 100);
    // At a row the force is that row's.
    let phi = ((CRANK * CRANK + 0.34 * 0.34 - ROD * ROD) / (2.0 * CRANK * 0.34)).acos();
    let [x, way] = slider(phi);
    assert!((x - 0.34).abs() < 1e-12);
    let process = both_ways.machine.reduction(phi).unwrap().process;
    assert!((process / way + 1000.0).abs() < 1e-8);
}

/// Rows over a part of the turn come again with every turn.
#[test]
fn a_part_of_a_turn_comes_again() {
    let csv = "Position [deg],Force x [N]\n350,0\n360,-500\n370,-600\n380,-500\n390,0\n";
    let file = with("on = \"slider\"\noutside = \"zero\"", csv);
    let process = |degrees: f64| {
        let reduction = file.machine.reduction(degrees.to_radians()).unwrap();
        reduction.process
    };
    for degrees in [10.0_f64, 370.0, 730.0, -350.0] {
        let [_, way] = slider(degrees.to_radians());
        assert!((process(degrees) / way + 600.0).abs() < 1e-8, "{degrees}");
    }
    assert!([40.0, 200.0, 349.0].iter().all(|d| process(*d) == 0.0));
}

/// A table on a mechanism with edges of its own keeps them.
#[test]
fn the_edges_of_a_cam_stay() {
    let cam = include_str!("../../../../machines/cam-translating.toml");
    let edges = |text: &str, files: &[(&str, &str)]| -> Vec<f64> {
        let file = parse(text, files).unwrap();
        (0..).map_while(|k| file.machine.edge(k)).collect()
    };
    let csv = turn("Position [deg],Thrust [N m]", 20, |_| "5".into());
    let table = format!("{cam}\n[[load]]\ntable = \"loads.csv\"\n");
    let own = edges(cam, &[]);
    assert!(own.len() > 2);
    assert_eq!(edges(&table, &[("loads.csv", &csv)]), own);
}

/// A force over the way of the slider that is largest at its end: of a spring that the slider meets at 340 mm, F = −20 N/mm·(x − 340 mm). It need not
/// end at zero where the way ends, and a table that ends a little before keeps its last value.
#[test]
fn a_table_up_to_the_end_of_the_way_may_end_with_a_force() {
    let load = "on = \"slider\"\nangle = \"0 deg\"\noutside = \"zero\"\n\
                over = { point = \"slider\", along = \"x\" }";
    let rows = |places: &[f64]| {
        let rows = places
            .iter()
            .map(|x| format!("{x},{}\n", -20.0 * (x - 340.0)));
        format!("x [mm],Force [N]\n{}", rows.collect::<String>())
    };
    let whole = with(load, &rows(&[340.0, 350.0, 360.0, 370.0, 380.0, 390.0]));
    let short = with(load, &rows(&[340.0, 350.0, 360.0, 370.0, 380.0, 389.5]));
    let mut held = 0;
    for phi in places().chain([0.01, 0.05, -0.03]) {
        let [x, way] = slider(phi);
        let force = -20e3 * (x - 0.34).max(0.0);
        let process = |file: &MachineFile| file.machine.reduction(phi).unwrap().process;
        assert!(
            (process(&whole) - force * way).abs() < 1e-9,
            "{phi}: {force}"
        );
        let force = force.max(-20e3 * 0.0495);
        assert!(
            (process(&short) - force * way).abs() < 1e-9,
            "{phi}: {force}"
        );
        held += usize::from(x > 0.3895);
    }
    assert!(held > 3);
    let refused = |places: &[f64]| {
        let load = format!("[[load]]\ntable = \"loads.csv\"\n{load}\n");
        let text = oblique_slider_crank("4 kg", &load);
        format!(
            "{:?}",
            parse(&text, &[("loads.csv", &rows(places))]).unwrap_err()
        )
    };
    let early = refused(&[340.0, 350.0, 360.0, 370.0, 380.0]);
    assert!(
        early.contains("a jump") && early.contains("390 mm"),
        "{early}"
    );
    let late = refused(&[350.0, 360.0, 370.0, 380.0, 390.0]);
    assert!(late.contains("a jump") && late.contains("210 mm"), "{late}");
}
