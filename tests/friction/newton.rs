//! Against two discs with the contact force as an unknown.

use jred::friction::{
    Arrangement, Contact, Drive, Flow, Ramp, RampShape, Shaft, Stage, State, Variable,
};
use jred::machine::motion::Law;

use super::integrate;
use crate::support::{assert_near, budget};

/// A wheel of radius R on shaft 2 touches the disc of shaft 1 at the distance ρ(t) from its axis.
struct DiscAndWheel {
    rho: Ramp,
    wheel: f64,
    inertias: [f64; 2],
    torques: [f64; 2],
    /// Speed of the wheel's rim over that of the disc.
    kept: f64,
}

impl DiscAndWheel {
    fn rho(&self, t: f64) -> [f64; 2] {
        use jred::friction::{Course, OperatingPoint};
        let found = self.rho.at(OperatingPoint::at_time(t));
        [found.value, found.slope[0]]
    }

    /// ω̇₁, ω̇₂, F from J₁·ω̇₁ = T₁ − F·ρ, J₂·ω̇₂ = F·R + T₂ and the rim's speed R·ω₂ = kept·ρ·ω₁ differentiated.
    fn accelerations(&self, t: f64, omega: f64) -> [f64; 3] {
        let [rho, rate] = self.rho(t);
        let ([j1, j2], [t1, t2], r, k) = (self.inertias, self.torques, self.wheel, self.kept);
        // R·(F·R + T₂)/J₂ = k·(ρ′·ω₁ + ρ·(T₁ − F·ρ)/J₁)
        let force =
            (k * (rate * omega + rho * t1 / j1) - r * t2 / j2) / (r * r / j2 + k * rho * rho / j1);
        [(t1 - force * rho) / j1, (force * r + t2) / j2, force]
    }
}

#[test]
fn two_discs_with_a_contact_force() {
    for (kept, contact) in [
        (1.0, Contact::Ideal),
        (1.0, Contact::Slipping),
        (0.97, Contact::Slipping),
    ] {
        let (wheel, from, to) = (0.05, 0.03, 0.11);
        let discs = DiscAndWheel {
            rho: Ramp::new(
                Variable::Time,
                RampShape {
                    start: 0.1,
                    length: 0.8,
                    values: [from, to],
                },
                Law::Polynomial345,
            )
            .unwrap(),
            wheel,
            inertias: [0.012, 0.02],
            torques: [4.0, -1.2],
            kept,
        };
        let ratio = Ramp::new(
            Variable::Time,
            RampShape {
                start: 0.1,
                length: 0.8,
                values: [from / wheel, to / wheel],
            },
            Law::Polynomial345,
        )
        .unwrap();
        let stage = Stage::new(&ratio)
            .unwrap()
            .with_slip(1.0 - kept, Flow::FirstDrives)
            .unwrap();
        let drive = Drive::new(Arrangement::Chain, contact, &[stage]).unwrap();
        let [j, m] = [discs.inertias, discs.torques];
        let shafts = [Shaft::new(j[0], m[0]), Shaft::new(j[1], m[1])];
        let motion = |t: f64, y: &[f64]| {
            let state = State {
                t,
                angles: &y[..2],
                omega: y[2],
            };
            drive.forward(state, &shafts).unwrap()
        };
        let (h, steps) = (1e-4, 10_000);
        // One speed and two angles, with the loss; against two speeds, two angles, and the work of the slip.
        let one = integrate(
            |t, y: &[f64; 4]| {
                let found = motion(t, y);
                [
                    found.shafts[0].omega,
                    found.shafts[1].omega,
                    found.alpha,
                    found.loss,
                ]
            },
            0.0,
            [0.0, 0.0, 20.0, 0.0],
            h,
            steps,
        );
        let omega2 = kept * from / wheel * 20.0;
        let two = integrate(
            |t, y: &[f64; 5]| {
                let [a1, a2, force] = discs.accelerations(t, y[2]);
                let sliding = discs.rho(t)[0] * y[2] - wheel * y[3];
                [y[2], y[3], a1, a2, force * sliding]
            },
            0.0,
            [0.0, 0.0, 20.0, omega2, 0.0],
            h,
            steps,
        );
        let close =
            |what, a: f64, b: f64| assert_near(what, a, b, budget::NEWTON * b.abs().max(1e-3));
        close("α₁", one[0], two[0]);
        close("α₂", one[1], two[1]);
        close("ω₁", one[2], two[2]);
        let end = motion(1.0, &one);
        close("ω₂", end.shafts[1].omega, two[3]);
        close("work of the slip", one[3], two[4]);
        let [_, a2, force] = discs.accelerations(1.0, two[2]);
        close("ω̇₂", end.shafts[1].alpha, a2);
        close("contact force", end.contacts[0].torque / wheel, force);
        // The energy of the two discs: the drive's power minus the slip.
        let kinetic = |a: f64, b: f64| 0.5 * (j[0] * a * a + j[1] * b * b);
        let work = m[0] * two[0] + m[1] * two[1] - two[4];
        close(
            "energy",
            kinetic(two[2], two[3]) - kinetic(20.0, omega2),
            work,
        );
    }
}
