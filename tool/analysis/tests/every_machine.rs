//! Properties of every machine file in `machines/`, whatever its mechanism.

use crate::reading::machines;
use jred::Domain;
use jred::machine::{Jointed, Mechanism, Reducible};
use jred_file::number::numerics::integral;

/// Places over the drive link's range, none of them special.
fn places(domain: Domain, count: u32) -> impl Iterator<Item = f64> {
    (1..=count).map(move |k| domain.position((f64::from(k) * 0.618_033_988_749_895).fract()))
}

/// Speed and acceleration of the drive link (rad/s, or m/s).
const OMEGA: f64 = 7.0;
const ALPHA: f64 = -40.0;

#[test]
fn dalembert_agrees_with_the_reduced_equation() {
    for (path, file) in machines() {
        let machine = &file.machine;
        let mut size = 0.0_f64;
        let mut worst = (0.0_f64, 0.0);
        let determined = |phi: &f64| machine.mechanism().determined(*phi);
        for phi in places(machine.domain(), 200).filter(determined) {
            let forces = machine.forces(phi, OMEGA, ALPHA).unwrap();
            let terms = machine.bare_reduction(phi).unwrap().torque(OMEGA, ALPHA);
            size = terms
                .values()
                .iter()
                .fold(size, |most, t| most.max(t.abs()));
            let error = (forces.drive - terms.total()).abs();
            if error > worst.0 {
                worst = (error, phi);
            }
        }
        let (error, phi) = worst;
        println!("{}: {:.1e} of {size:.3}", path.display(), error / size);
        assert!(
            size > 0.0 && error <= 1e-10 * size,
            "{}: {error:e} at {phi}",
            path.display()
        );
    }
}

/// The drive's work over a turn at constant speed equals that of loads and friction: the kinetic energy comes back, and
/// so does the potential energy, but for what the machine has lifted.
#[test]
fn energy_balances_over_a_cycle() {
    for (path, file) in machines() {
        let machine = &file.machine;
        let domain = machine.domain();
        let [from, to] = [domain.position(0.0), domain.position(1.0)];
        let ends = [from, to].map(|phi| machine.bare_reduction(phi).unwrap());
        let kinetic = 0.5 * OMEGA * OMEGA * (ends[1].inertia - ends[0].inertia);
        let potential = ends[1].potential_energy - ends[0].potential_energy;
        // d'Alembert's torque knows neither J nor U; close to a change point there are no forces, and the reduced equation stands in.
        let drive = |phi: f64| {
            if machine.mechanism().determined(phi) {
                machine.forces(phi, OMEGA, 0.0).unwrap().drive
            } else {
                let reduction = machine.bare_reduction(phi).unwrap();
                reduction.torque(OMEGA, 0.0).total()
            }
        };
        let torque = places(domain, 50).fold(0.0_f64, |most, phi| most.max(drive(phi).abs()));
        let size = (torque * domain.span())
            .max(kinetic.abs())
            .max(potential.abs());
        let unbalanced = |phi: f64| {
            let r = machine.bare_reduction(phi).unwrap();
            drive(phi) + r.process - r.viscous * OMEGA - r.coulomb
        };
        let unbalanced = |phi: f64| Ok::<f64, jred::error::Error>(unbalanced(phi));
        let work = integral(unbalanced, [from, to], 48, 1e-11 * size).unwrap();
        let gap = work - kinetic - potential;
        println!(
            "{}: {:.1e} of {size:.3e} J",
            path.display(),
            gap.abs() / size
        );
        assert!(
            gap.abs() <= 1e-9 * size,
            "{}: {gap:e} J of {size:e} J",
            path.display()
        );
        if domain == Domain::Turn {
            assert!(
                kinetic.abs() <= 1e-9 * size,
                "{}: J does not repeat",
                path.display()
            );
        }
    }
}

/// The reactions of every joint of every machine do no work: of the largest power of one of their parts, over all places.
#[test]
fn joints_do_no_work() {
    for (path, file) in machines() {
        let mechanism = file.machine.mechanism();
        let names = mechanism.joint_names();
        assert_eq!(mechanism.links().len(), mechanism.names().len());
        // A curve's link has a bearing and a gearing, which are no parts of the machine.
        let curves = mechanism.names().len() - mechanism.link_names().len();
        let count = names.len() + 2 * curves;
        let mut most = vec![1e-3_f64; count];
        let mut works = Vec::new();
        for phi in places(mechanism.domain(), 60) {
            let frames = mechanism.frames(phi).unwrap();
            let joints = mechanism.joints(phi, &frames).unwrap();
            assert_eq!(joints.len(), count, "{}", path.display());
            for (k, joint) in joints.iter().enumerate() {
                for pair in &joint.unit_reactions(&frames) {
                    let mut power = 0.0;
                    for wrench in pair {
                        let frame = wrench.body.frame(&frames);
                        let turn = frame.psi.d1;
                        let v = [
                            frame.x.d1 - turn * (wrench.point[1] - frame.y.value),
                            frame.y.d1 + turn * (wrench.point[0] - frame.x.value),
                        ];
                        let parts = [
                            wrench.force[0] * v[0],
                            wrench.force[1] * v[1],
                            wrench.moment * turn,
                        ];
                        power += parts.iter().sum::<f64>();
                        most[k] = parts.iter().fold(most[k], |most, p| most.max(p.abs()));
                    }
                    works.push((k, phi, power));
                }
            }
        }
        for (k, phi, power) in works {
            let (name, size) = (names.get(k).map_or("a curve", String::as_str), most[k]);
            assert!(
                power.abs() <= 1e-11 * size,
                "{}: {name} works at φ = {phi}: {power:e} of {size:e}",
                path.display()
            );
        }
    }
}
