//! `jred reduce --reactions` and `--energy`: every force of a slider-crank by hand, link by link, without a linear system; energies and generalised
//! forces against the reduced curves.

use crate::support::{Columns, budget, jred_of, near_column, press_file, within};

/// The press of `machines/press.toml`: lengths, masses, inertias, centres of mass, gravity along +x.
const R: f64 = 0.03;
const L: f64 = 0.18;
const CRANK: [f64; 3] = [9.0, 0.018, 0.006];
const ROD: [f64; 3] = [6.5, 0.03, 0.055];
const SLIDER: f64 = 42.0;
const G: f64 = 9.81;

/// Joint forces of the press at φ, ω, α: T, crank pivot, crank pin, slider pin, guide.
struct Hand {
    drive: f64,
    pivot: [f64; 2],
    crank_pin: [f64; 2],
    slider_pin: [f64; 2],
    guide: f64,
    shaking: [f64; 2],
}

/// Newton for the slider, then the rod's moments about A, then its forces, then the crank.
fn by_hand(phi: f64, omega: f64, alpha: f64, friction: f64, bearing: f64, train: f64) -> Hand {
    let (s, c) = phi.sin_cos();
    let sin = -R / L * s;
    let cos = (1.0 - sin * sin).sqrt();
    // ψ̇ and ψ̈ from L·cos ψ·ψ̇ = −R·cos φ·ω and its derivative.
    let psi1 = -R * c * omega / (L * cos);
    let psi2 = (-R * (c * alpha - s * omega * omega) + L * sin * psi1 * psi1) / (L * cos);
    let pin = [
        -R * (s * alpha + c * omega * omega),
        R * (c * alpha - s * omega * omega),
    ];
    let slider_speed = -R * s * omega - L * sin * psi1;
    let slider = pin[0] - L * (sin * psi2 + cos * psi1 * psi1);
    let rod = [
        pin[0] - ROD[2] * (sin * psi2 + cos * psi1 * psi1),
        pin[1] + ROD[2] * (cos * psi2 - sin * psi1 * psi1),
    ];
    let crank = pin.map(|a| a * CRANK[2] / R);
    // Friction opposes the slider's motion; the pressing force is outside its window at the angles of the test.
    let load = if slider_speed == 0.0 {
        0.0
    } else {
        -friction * slider_speed.signum()
    };
    let s_x = SLIDER * (slider - G) - load;
    // About A: J·ψ̈ + r_c × m·(a − g) = −AB × S.
    let moment = ROD[1] * psi2 + ROD[2] * ROD[0] * (cos * rod[1] - sin * (rod[0] - G));
    let s_y = (L * sin * s_x - moment) / (L * cos);
    let crank_pin = [ROD[0] * (rod[0] - G) + s_x, ROD[0] * rod[1] + s_y];
    let pivot = [
        CRANK[0] * (crank[0] - G) + crank_pin[0],
        CRANK[0] * crank[1] + crank_pin[1],
    ];
    let drive = (CRANK[1] + 0.05 + train) * alpha
        + bearing * omega
        + CRANK[2] * CRANK[0] * (c * crank[1] - s * (crank[0] - G))
        + R * (c * crank_pin[1] - s * crank_pin[0]);
    Hand {
        drive,
        pivot,
        crank_pin,
        slider_pin: [s_x, s_y],
        guide: -s_y,
        shaking: [
            -(CRANK[0] * crank[0] + ROD[0] * rod[0] + SLIDER * slider),
            -(CRANK[0] * crank[1] + ROD[0] * rod[1]),
        ],
    }
}

#[test]
fn every_force_of_the_press_by_hand() {
    let (omega, alpha) = (20.0, -150.0);
    let found = jred_of(
        "reduce {} --reactions --speed '20 rad/s' --accel '-150 rad/s^2' --format csv",
        [&press_file()],
    )
    .ends(0)
    .columns();
    // 0.0006 kg m² at the driver, ratio 3, 0.03 kg m² and 0.6 kg of belt at 120 mm at the driven side.
    let train = 0.0006 * 9.0 + 0.03 + 0.6 * 0.12 * 0.12;
    let rows: Vec<usize> = (0..31).collect(); // up to 300°, before the pressing force
    let hand: Vec<Hand> = rows
        .iter()
        .map(|&k| {
            by_hand(
                (10.0 * k as f64).to_radians(),
                omega,
                alpha,
                150.0,
                0.4,
                train,
            )
        })
        .collect();
    let compare = |column: &str, f: &dyn Fn(&Hand) -> f64| {
        let found: Vec<f64> = rows.iter().map(|&k| found.get(column)[k]).collect();
        let expected: Vec<f64> = hand.iter().map(f).collect();
        // At a dead centre sin φ is a rounding error, and so is the direction of friction.
        let ends = |k: &usize| !k.is_multiple_of(18);
        let keep = |values: &[f64]| -> Vec<f64> {
            rows.iter()
                .filter(|k| ends(k))
                .map(|&k| values[k])
                .collect()
        };
        near_column(
            column,
            &keep(&found),
            &keep(&expected),
            10.0 * budget::CLOSED_FORM,
        );
    };
    compare("T_drive [N m]", &|h| h.drive);
    compare("crank pivot F_x [N]", &|h| h.pivot[0]);
    compare("crank pivot F_y [N]", &|h| h.pivot[1]);
    compare("crank pivot F [N]", &|h| h.pivot[0].hypot(h.pivot[1]));
    compare("crank pin F_x [N]", &|h| h.crank_pin[0]);
    compare("crank pin F_y [N]", &|h| h.crank_pin[1]);
    compare("slider pin F_x [N]", &|h| h.slider_pin[0]);
    compare("slider pin F_y [N]", &|h| h.slider_pin[1]);
    compare("guide F_y [N]", &|h| h.guide);
    compare("shaking F_x [N]", &|h| h.shaking[0]);
    compare("shaking F_y [N]", &|h| h.shaking[1]);
    for k in &rows {
        within("guide F_x", found.get("guide F_x [N]")[*k], 0.0, 1e-9);
        within("guide M", found.get("guide M [N m]")[*k], 0.0, 1e-9);
    }
    for name in ["crank pivot M [N m]", "slider pin M [N m]"] {
        assert!(
            !found.names.contains(&name.to_owned()),
            "a pin carries no moment"
        );
    }
}

fn press(set: &str, over: &str, format: &str) -> crate::support::Run {
    jred_of(
        "reduce {} {} --over {} --positions 180 --format {}",
        [&press_file(), &set, &over, &format],
    )
    .ends(0)
}

/// The curves over time.
fn curves() -> Columns {
    jred_of(
        "reduce {} --over time --positions 180 --format csv",
        [&press_file()],
    )
    .ends(0)
    .columns()
}

/// Two methods for the drive torque over the motion, both with the drive train.
#[test]
fn the_drive_torque_is_that_of_the_reduced_equation() {
    let forces = press("--reactions", "time", "csv").columns();
    let curves = curves();
    let torque = "T_drive [N m]";
    near_column(
        torque,
        &forces.get(torque),
        &curves.get(torque),
        budget::CLOSED_FORM,
    );
}

#[test]
fn the_largest_values_are_found_between_the_rows() {
    let few = jred_of(
        "reduce {} --reactions --positions 4 --format json",
        [&press_file()],
    )
    .ends(0)
    .json();
    let all = press("--reactions", "angle", "json").json();
    let rows = Columns::of_json(&all);
    for (found, again) in few["largest"]
        .as_array()
        .unwrap()
        .iter()
        .zip(all["largest"].as_array().unwrap())
    {
        assert_eq!(found, again);
        let name = found["quantity"].as_str().unwrap();
        let most = crate::support::largest(&rows.get(name));
        let value = found["value"].as_f64().unwrap().abs();
        assert!(
            value >= most && value < 1.05 * most,
            "{name}: {value} and {most}"
        );
    }
    let text = press("--reactions", "angle", "table").out;
    let lines = text.lines().filter(|line| line.starts_with("  largest "));
    let lines = lines.collect::<Vec<_>>().join("\n");
    assert!(
        lines.contains("T_drive") && lines.contains("guide F") && lines.contains(" N at phi = ")
    );
    assert!(!lines.contains("guide M"), "{lines}");
}

/// The loads' generalised forces, from the forces themselves, sum up to the reduced torque; both energies are those of J and U.
#[test]
fn energies_and_generalised_forces() {
    let energy = press("--energy", "time", "csv").columns();
    let curves = curves();
    let [j, u, omega] = ["J_red [kg m^2]", "U [J]", "omega [rad/s]"].map(|name| curves.get(name));
    let kinetic: Vec<f64> = j.iter().zip(&omega).map(|(j, w)| 0.5 * j * w * w).collect();
    near_column(
        "E",
        &energy.get("E_kinetic [J]"),
        &kinetic,
        budget::CLOSED_FORM,
    );
    near_column("U", &energy.get("E_potential [J]"), &u, budget::CLOSED_FORM);
    let parts = ["potential", "process", "viscous", "coulomb"];
    let columns = parts.map(|part| curves.get(&format!("T_drive {part} [N m]")));
    let total: Vec<f64> = (0..180)
        .map(|k| -columns.iter().map(|c| c[k]).sum::<f64>())
        .collect();
    near_column(
        "Q",
        &energy.get("Q total [N m]"),
        &total,
        budget::CLOSED_FORM,
    );
    let weight: Vec<f64> = columns[0].iter().map(|x| -x).collect();
    near_column(
        "weight",
        &energy.get("Q weight [N m]"),
        &weight,
        budget::CLOSED_FORM,
    );
    let friction: Vec<f64> = columns[3].iter().map(|x| -x).collect();
    near_column(
        "friction",
        &energy.get("Q guide friction [N m]"),
        &friction,
        budget::CLOSED_FORM,
    );
}
