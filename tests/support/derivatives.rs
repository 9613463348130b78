//! Derivatives against differences: of every link's transfer functions, of J and of U.

use jred::machine::Machine;
use jred::machine::Mechanism;
use std::f64::consts::{PI, TAU};

use super::{assert_near, budget, derivative, largest};

/// Largest step of the differences (rad).
const STEP: f64 = 1.0 / 128.0;

/// Every entry of `curve` is the derivative of the one before it. The tolerance includes the differences' own error: their change with half the step,
/// and the bend of the derivative where the motion has an edge.
#[track_caller]
fn chain<const N: usize>(name: &str, phi: f64, curve: impl Fn(f64) -> [f64; N]) {
    let places = [-1.0, -0.5, 0.0, 0.5, 1.0].map(|k| curve(phi + k * STEP));
    for order in 1..N {
        let f = |x: f64| curve(x)[order - 1];
        let [coarse, fine] = [STEP, STEP / 2.0].map(|step| derivative(f, phi, step));
        let bend = places.map(|place| place[order]);
        let bend = bend[0] - 4.0 * bend[1] + 6.0 * bend[2] - 4.0 * bend[3] + bend[4];
        let size = largest(places.map(|place| place[order]));
        let before = largest(places.iter().flat_map(|place| place[..order].to_vec()));
        let allowed = budget::RICHARDSON * size
            + budget::DIFFERENCES * before
            + 4.0 * (coarse - fine).abs()
            + 2.0 * bend.abs();
        let name = format!("{name}, derivative {order} at φ = {phi}");
        assert_near(&name, places[2][order], fine, allowed);
    }
}

/// The transfer functions of every link, J′ and J″, and U′ are derivatives.
#[track_caller]
pub(crate) fn derivatives<M: Mechanism>(machine: &Machine<M>, phi: f64) {
    let frames = |x| machine.mechanism().frames(x).unwrap();
    for (link, here) in frames(phi).iter().enumerate() {
        let start = here.psi.value;
        for (what, which) in ["x", "y", "ψ"].iter().zip(0..) {
            chain(&format!("{what} of link {link}"), phi, |x| {
                let frame = frames(x)[link];
                let t = [frame.x, frame.y, frame.psi][which];
                // From this angle on: ψ may cross ±π, and turns add up.
                let value = match which {
                    2 => (t.value - start + PI).rem_euclid(TAU) - PI,
                    _ => t.value,
                };
                [value, t.d1, t.d2, t.d3]
            });
        }
    }
    let reduced = |x| machine.bare_reduction(x).unwrap();
    chain("J", phi, |x| reduced(x).inertias());
    chain("U", phi, |x| {
        let point = reduced(x);
        [point.potential_energy, point.potential_slope]
    });
}
