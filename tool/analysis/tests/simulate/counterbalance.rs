//! A spring that balances a press.

use jred::machine::Mechanism as _;
use jred::machine::Reducible as _;
use jred_analysis::simulate::simulate;
use jred_file::model::simulation::Shaft;

use crate::reading::read;
use crate::support::machines::{COUNTERBALANCE, balanced_press};
use crate::support::{budget, close};

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
        close(*energy, total[0], budget::CONSERVED * most);
    }
    // The energy of the spring is in it, and it is not small.
    let turns = (phi.last().unwrap() - phi[0]) / 360.0;
    assert!(turns > 1.0, "{turns} turns");
    for (phi, potential) in phi.iter().zip(&potential) {
        let phi = phi.to_radians();
        let slider = with.machine.mechanism().frames(phi).unwrap()[2].x.value;
        let stretch = (0.4 - slider) - 0.33;
        let bare = without.machine.reduction(phi).unwrap().potential_energy;
        close(*potential, bare + 1500.0 * stretch * stretch, 1e-9);
    }
    let swing = |energies: &[f64]| {
        energies.iter().copied().fold(f64::MIN, f64::max)
            - energies.iter().copied().fold(f64::MAX, f64::min)
    };
    assert!(swing(&potential) > 1.0);
}
