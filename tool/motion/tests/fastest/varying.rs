//! Inertia that depends on the angle.

use jred_motion::fastest::Binding;

use super::scales::lossless_press;
use super::{close, fastest, motor, task};

/// Without friction and losses the energy is the work of a constant torque: E = T·x from the start, T·(L − x) to the end, so the torque reverses
/// half-way, and the time is ∫√(J/2E) dφ.
#[test]
fn the_work_of_a_constant_torque_is_the_energy() {
    let file = lossless_press();
    let torque = 60.0;
    for (from, to) in [(0.2, 2.8), (3.0, -4.0)] {
        let length: f64 = f64::abs(to - from);
        let direction = f64::signum(to - from);
        let half = |start: f64, direction: f64| {
            // x = s²: dx/√x = 2 ds.
            let steps = 4000;
            let end = (0.5 * length).sqrt();
            let f = |s: f64| {
                let inertia = file
                    .bare_reduction(start + direction * s * s)
                    .unwrap()
                    .inertia;
                2.0 * (0.5 * inertia / torque).sqrt()
            };
            let h = end / f64::from(steps);
            let simpson = |k: i32| {
                let s = f64::from(k) * h;
                h / 6.0 * (f(s) + 4.0 * f(s + 0.5 * h) + f(s + h))
            };
            (0..steps).map(simpson).sum::<f64>()
        };
        let found = fastest(&file, &motor([torque; 2], 1e4), &task(from, to));
        close(
            found.time,
            half(from, direction) + half(to, -direction),
            1e-9,
        );
        let [driving, braking] = &found.phases[..] else {
            panic!("{:?}", found.phases)
        };
        assert_eq!(
            [driving.limit, braking.limit],
            [Binding::Driving, Binding::Braking]
        );
        close(driving.phi[1], 0.5 * (from + to), 1e-9);
    }
}
