//! Forces in the joints: against the reduced equation, in equilibrium, against golden tables.

use jred::machine::Machine;
use jred::machine::{Body, Forces, Joint, Jointed, Wrench};

use super::golden::Table;
use super::jointed::size;
use super::{assert_near, budget, largest};

/// The drive torque by d'Alembert equals that of the reduced equation, and the forces on the whole mechanism balance.
#[track_caller]
pub(crate) fn dalembert<M: Jointed>(machine: &Machine<M>, phi: f64, omega: f64, alpha: f64) {
    let forces = machine.forces(phi, omega, alpha).unwrap();
    let terms = machine.torque(phi, omega, alpha).unwrap();
    // Where terms cancel, the roundings are relative to the largest force at the size of the mechanism.
    let frames = machine.mechanism().frames(phi).unwrap();
    let length = size(machine.mechanism(), phi, &frames);
    let joint_torques = forces
        .reactions
        .iter()
        .flat_map(|r| [r.force[0] * length, r.force[1] * length, r.moment]);
    let scale = largest(terms.values().into_iter().chain(joint_torques));
    let name = format!("drive torque at φ = {phi}");
    assert_near(
        &name,
        forces.drive,
        terms.total(),
        budget::DALEMBERT * scale,
    );
}

/// Every link is in equilibrium: forces, and moments about the point of each reaction on it.
#[track_caller]
#[allow(clippy::float_cmp, reason = "the same point, not one close to it")]
pub(crate) fn balance<M: Jointed>(machine: &Machine<M>, phi: f64, omega: f64, alpha: f64) {
    let mechanism = machine.mechanism();
    let frames = mechanism.frames(phi).unwrap();
    let joints = mechanism.joints(phi, &frames).unwrap();
    let forces = machine.forces(phi, omega, alpha).unwrap();
    let mut wrenches = Vec::new();
    for (joint, reaction) in joints.iter().zip(&forces.reactions) {
        let [first, second] = joint.bodies();
        let on_second = Wrench {
            body: second,
            point: reaction.point,
            force: reaction.force,
            moment: reaction.moment,
        };
        let on_first = match joint {
            Joint::Transmission([a, b]) => {
                let [[x, y], [u, v]] = [reaction.force, b.force];
                let of = x * u + y * v + reaction.moment * b.moment;
                a.times(of / (u * u + v * v + b.moment * b.moment))
            }
            _ => on_second.times(-1.0).acting_on(first),
        };
        wrenches.extend([on_first, on_second]);
        // Pins, sliders and teeth are at the joint.
        if let Joint::Revolute([_, at]) | Joint::Fixed([_, at]) | Joint::Prismatic([_, at]) = joint
        {
            assert_eq!(reaction.point, at.position(&frames).map(|c| c.value));
        }
    }
    let driven = joints[mechanism.drive()];
    let flywheel = machine.flywheel() * driven.coordinate(&frames).acceleration(omega, alpha);
    let [on_first, on_second] = driven.unit_drive(&frames);
    wrenches.extend([
        on_first.times(forces.drive - flywheel),
        on_second.times(forces.drive - flywheel),
    ]);
    for (k, (link, frame)) in mechanism.links().iter().zip(&frames).enumerate() {
        let centre = frame.point(link.com());
        let [a_x, a_y] = centre.map(|c| c.acceleration(omega, alpha));
        let [g_x, g_y] = machine.gravity();
        wrenches.push(Wrench {
            body: Body::Link(k),
            point: centre.map(|c| c.value),
            force: [link.mass() * (g_x - a_x), link.mass() * (g_y - a_y)],
            moment: -link.inertia() * frame.psi.acceleration(omega, alpha),
        });
    }
    let loads = machine.loads().iter();
    wrenches.extend(loads.map(|load| load.wrench(&frames[load.link()], phi, omega)));
    let elements = machine.elements().iter();
    wrenches.extend(elements.flat_map(|element| element.wrenches(&frames, omega).unwrap()));

    let length = size(mechanism, phi, &frames);
    for link in 0..frames.len() {
        let on: Vec<&Wrench> = wrenches
            .iter()
            .filter(|w| w.body == Body::Link(link))
            .collect();
        let largest_force = largest(on.iter().flat_map(|w| w.force));
        for axis in 0..2 {
            let sum: f64 = on.iter().map(|w| w.force[axis]).sum();
            let scale = largest(
                wrenches
                    .iter()
                    .flat_map(|w| w.force.into_iter().chain([w.moment / length])),
            );
            assert_near(
                "force on a link",
                sum,
                0.0,
                budget::DALEMBERT * scale.max(largest_force),
            );
        }
        for about in on.iter().map(|w| w.point) {
            let moments: Vec<f64> = on.iter().map(|w| w.moment_about(about)).collect();
            let sizes = wrenches.iter().flat_map(|w| {
                let reach = length.max(w.point[0].abs()).max(w.point[1].abs());
                [w.force[0] * reach, w.force[1] * reach, w.moment]
            });
            let name = format!("moment on link {link} about {about:?} at φ = {phi}");
            assert_near(
                &name,
                moments.iter().sum(),
                0.0,
                budget::DALEMBERT * largest(sizes),
            );
        }
    }
}

/// Drive torque and pin forces against a golden table of a motion; `pins` names the columns of joint 0, 1, …
#[track_caller]
pub(crate) fn golden<M: Jointed>(
    machine: &Machine<M>,
    table: &Table,
    pins: &[&str],
) -> Vec<Forces> {
    let [phi, omega, alpha] = ["phi", "omega", "alpha"].map(|name| table.column(name));
    let forces: Vec<Forces> = (0..phi.len())
        .map(|k| machine.forces(phi[k], omega[k], alpha[k]).unwrap())
        .collect();
    let compare = |column: &str, f: &dyn Fn(&Forces) -> f64| {
        let found: Vec<f64> = forces.iter().map(f).collect();
        table.compare(column, &found, budget::REACTIONS);
    };
    compare("T_drive", &|f| f.drive);
    for (joint, name) in pins.iter().enumerate() {
        compare(&format!("{name}x"), &|f| f.reactions[joint].force[0]);
        compare(&format!("{name}y"), &|f| f.reactions[joint].force[1]);
    }
    forces
}
