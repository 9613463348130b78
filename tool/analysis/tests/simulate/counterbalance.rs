//! A spring that balances a press.

use jred::machine::Mechanism as _;
use jred::machine::Reducible as _;
use jred_analysis::simulate::simulate;
use jred_file::model::simulation::Shaft;

use crate::reading::read;
use crate::support::{budget, press_text};

/// A press without friction, with a counterbalance spring below its ram, moving freely.
fn balanced_press(spring: &str) -> String {
    let press = press_text();
    let mechanism = press.split("[[load]]").next().unwrap();
    format!(
        "{mechanism}\n{spring}\n[simulation]\nstart_angle = \"100 deg\"\nstart_speed = \"500 rpm\"\nduration = \"2 s\"\n\
         output_step = \"10 ms\"\ntorque = \"0 N m\"\ntolerance = 1e-12\n"
    )
}

const COUNTERBALANCE: &str = r#"[[spring]]
name = "counterbalance"
between = ["slider", { on = "ground", at = ["400 mm", "0 mm"] }]
stiffness = "3 N/mm"
free_length = "330 mm"
"#;

#[track_caller]
fn within(found: f64, expected: f64, tolerance: f64) {
    let error = (found - expected).abs();
    assert!(
        error <= tolerance,
        "{found} is {error:e} from {expected}, more than {tolerance:e}"
    );
}

#[test]
fn a_press_with_a_counterbalance_spring_keeps_its_energy() {
    let [with, without] = [COUNTERBALANCE, ""].map(|spring| read(&balanced_press(spring)));
    let simulation = with.simulation.as_ref().unwrap();
    assert_eq!(simulation.at, Shaft::Motor);
    let columns = simulate(&with, simulation).unwrap().whole().unwrap();
    let column = |name: &str| -> Vec<f64> {
        let index = columns.names().iter().position(|n| n == name).unwrap();
        columns
            .rows()
            .iter()
            .map(|row| row[index].unwrap())
            .collect()
    };
    let (phi, kinetic, potential) = (
        column("phi [deg]"),
        column("kinetic energy [J]"),
        column("potential energy [J]"),
    );
    let total: Vec<f64> = kinetic.iter().zip(&potential).map(|(k, u)| k + u).collect();
    let most = kinetic.iter().copied().fold(0.0, f64::max);
    for energy in &total {
        within(*energy, total[0], budget::CONSERVED * most);
    }
    // The energy of the spring is in it, and it is not small.
    let turns = (phi.last().unwrap() - phi[0]) / 360.0;
    assert!(turns > 1.0, "{turns} turns");
    for (phi, potential) in phi.iter().zip(&potential) {
        let phi = phi.to_radians();
        let slider = with.machine.mechanism().frames(phi).unwrap()[2].x.value;
        let stretch = (0.4 - slider) - 0.33;
        let bare = without.machine.reduction(phi).unwrap().potential_energy;
        within(*potential, bare + 1500.0 * stretch * stretch, 1e-9);
    }
    let swing = |energies: &[f64]| {
        energies.iter().copied().fold(f64::MIN, f64::max)
            - energies.iter().copied().fold(f64::MAX, f64::min)
    };
    assert!(swing(&potential) > 1.0);
}
