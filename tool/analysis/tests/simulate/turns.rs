//! Weights that move over many turns of the drive link.

use crate::reading::text_of;
use crate::simulate::simulate;
use crate::support::largest;

/// The slide falls through several turns: the potential energy goes on, and the balance closes.
#[test]
fn the_energy_of_a_screw_balances_over_many_turns() {
    let columns = simulate(&text_of("ball-screw.toml"));
    let angle = columns.get("phi [deg]");
    let turns = (angle[0] - angle.last().unwrap()) / 360.0;
    assert!(turns > 5.0, "only {turns} turns");
    let energy = largest(&columns.get("kinetic energy [J]"));
    let balance = largest(&columns.get("energy balance [J]"));
    assert!(balance <= 1e-8 * energy, "{balance} of {energy}");
    let potential = columns.get("potential energy [J]");
    let fallen = potential[0] - potential.last().unwrap();
    let expected = 140.0 * 9.81 * 0.02 * turns;
    assert!(
        (fallen - expected).abs() <= 1e-9 * expected,
        "{fallen} is not {expected}"
    );
}

/// The cabin runs down through several turns: the potential energy goes on, and the balance closes.
#[test]
fn the_energy_of_a_hoist_balances_over_many_turns() {
    let columns = simulate(&text_of("hoist.toml"));
    let angle = columns.get("phi [deg]");
    let turns = (angle[0] - angle.last().unwrap()) / 360.0;
    assert!(turns > 2.0, "only {turns} turns");
    let energy = largest(&columns.get("kinetic energy [J]"));
    let balance = largest(&columns.get("energy balance [J]"));
    assert!(balance <= 1e-8 * energy, "{balance} of {energy}");
}
