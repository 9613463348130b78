//! Travels and rests of motions in closed form.
#![expect(
    clippy::disallowed_methods,
    reason = "functions of another library than the code's"
)]

use super::*;
use std::f64::consts::TAU;

/// ψ = φ + 1.5·sin φ turns without end and moves back where cos φ < −2/3.
#[test]
fn a_link_that_turns_on_and_goes_back() {
    let angle = |phi: f64| {
        let phi = Transfer::variable(phi);
        Ok(phi + phi.sin_cos().0 * 1.5)
    };
    let found = travel(Domain::Turn, false, &angle).unwrap();
    let turn = (-2.0f64 / 3.0).acos();
    assert_eq!(found.way, TravelKind::Turns);
    assert!((found.stroke - TAU).abs() < 1e-12, "{found:?}");
    let back = 2.0 * (turn + 1.5 * turn.sin()) - TAU;
    assert!((found.back - back).abs() < 1e-12, "{found:?}");
    assert_eq!(found.dead_centres.len(), 2);
    for (centre, place) in found.dead_centres.iter().zip([turn, TAU - turn]) {
        assert!((centre[0] - place).abs() < 1e-9);
        assert!((centre[1] - (place + 1.5 * place.sin())).abs() < 1e-9);
    }
}

/// The same against the drive.
#[test]
fn a_slide_that_advances_the_other_way() {
    let way = |phi: f64| {
        let phi = Transfer::variable(phi);
        Ok((phi * 2.0).sin_cos().0 * 1e-3 - phi * 1e-3)
    };
    let found = travel(Domain::Turn, true, &way).unwrap();
    assert_eq!(found.way, TravelKind::Advances);
    assert!((found.stroke + 1e-3 * TAU).abs() < 1e-15);
    // cos 2φ > 1/2 twice a turn, over ±π/6: forward by 2·(sin(π/3) − π/6).
    let back = 2.0 * 2.0 * ((TAU / 6.0).sin() - TAU / 12.0) * 1e-3;
    assert!((found.back - back).abs() < 1e-15, "{found:?}");
}

/// Rests that end with a jump, a slope or softly have the given edges.
#[test]
fn edges_of_a_rest() {
    for power in 1..5 {
        for edge in [0.3, 1.7] {
            let speed = |phi: f64| {
                let x = (phi - edge).max(0.0);
                Ok(x.powi(power) * (1.0 - 0.4 * x))
            };
            let still = stillness(&speed, [edge - 0.1, edge], 1e-9).unwrap();
            let found = rest_edge(&speed, [edge - 0.1, edge + 0.01], still).unwrap();
            let off = (found - edge).abs();
            let most = if power < 4 { 1e-8 } else { 1e-6 };
            assert!(off < most, "power {power}: {off:e}");
        }
    }
    let jump = |phi: f64| Ok(if phi > 0.3 { 1.0 } else { 0.0 });
    let found = rest_edge(&jump, [0.2, 0.31], 1e-9).unwrap();
    assert!((found - 0.3).abs() < 1e-12, "{found}");
}

/// A rest that is still except for rounding ends where its speed exceeds the rounding.
#[test]
fn edges_of_a_rest_with_noise() {
    let speed = |phi: f64| {
        let x = (phi - 0.3).max(0.0);
        Ok(x * x + 1e-13 * (phi * 1e7).sin().abs())
    };
    let still = stillness(&speed, [0.1, 0.3], 1e-9).unwrap();
    assert!(still > 5e-12 && still < 1e-10, "{still:e}");
    let found = rest_edge(&speed, [0.2, 0.31], still).unwrap();
    assert!((found - 0.3).abs() < 2e-7, "{found}");
}
