//! Properties of every mechanism with joints.

use jred::Domain;
use jred::machine::{Frames, Joint, Jointed, Machine, Mechanism, Reducible, Wrench};
use jred::mechanism::linkage::{Assembly, Linkage, LinkageError, Pair, Pose};
use jred::number::Transfer;

use super::{assert_near, budget, forces, largest};

/// Largest distance of any point from the origin of the mechanism, at least 1 mm: the scale of lengths.
pub(crate) fn size(mechanism: &impl Jointed, phi: f64, frames: &Frames) -> f64 {
    let joints = mechanism.joints(phi, frames).unwrap();
    let of = |joint: &Joint| match joint {
        Joint::Revolute(m) | Joint::Prismatic(m) | Joint::Fixed(m) | Joint::PinInSlot(m) => m
            .iter()
            .flat_map(|m| m.position(frames).map(|c| c.value))
            .collect(),
        Joint::Transmission(_) => Vec::new(),
    };
    largest(joints.iter().flat_map(of)).max(1e-3)
}

/// Both markers of every joint coincide, in position and in every transfer function; no joint does work.
#[track_caller]
pub(crate) fn joints_close(mechanism: &impl Jointed, phi: f64) {
    let frames = mechanism.frames(phi).unwrap();
    assert_eq!(
        frames.len(),
        mechanism.links().len(),
        "a frame for each link"
    );
    let joints = mechanism.joints(phi, &frames).unwrap();
    let taken: usize = joints.iter().map(Joint::constraints).sum();
    assert_eq!(taken, 3 * frames.len() - 1, "freedoms taken by the joints");
    let length = size(mechanism, phi, &frames);
    for (k, joint) in joints.iter().enumerate() {
        for (what, gap, scale) in gaps(joint, &frames, length) {
            // Derivatives grow near dead points, where many large terms cancel.
            let terms = [gap.value, gap.d1, gap.d2, gap.d3];
            for (order, (term, size)) in terms.iter().zip(order_sizes(&frames, scale)).enumerate() {
                let name = format!("φ = {phi}: joint {k}, {what}, derivative {order}");
                assert_near(&name, *term, 0.0, budget::JOINT_CLOSURE * size);
            }
        }
        let unit_reactions = joint.unit_reactions(&frames);
        for pair in &unit_reactions {
            let power: f64 = pair.iter().map(|w| power(w, &frames)).sum();
            let sizes = largest(pair.iter().map(|w| power_size(w, &frames)));
            let name = format!("φ = {phi}: work of joint {k}");
            assert_near(&name, power, 0.0, budget::JOINT_CLOSURE * sizes.max(length));
        }
    }
    let drive = joints[mechanism.drive()].coordinate(&frames);
    assert_near("drive coordinate′", drive.d1, 1.0, budget::JOINT_CLOSURE);
    assert_near("drive coordinate″", drive.d2, 0.0, budget::JOINT_CLOSURE);
}

/// Magnitude of the derivatives of each order anywhere in the mechanism, times `scale`.
fn order_sizes(frames: &Frames, scale: f64) -> [f64; 4] {
    let most = |f: fn(&Transfer) -> f64| {
        let of = |frame: &jred::machine::Frame| {
            f(&frame.psi)
                .abs()
                .max(f(&frame.x).abs())
                .max(f(&frame.y).abs())
        };
        largest(frames.iter().map(of)).max(1.0)
    };
    let [d1, d2, d3] = [most(|t| t.d1), most(|t| t.d2), most(|t| t.d3)];
    let second = d2.max(d1 * d1);
    [1.0, d1, second, d3.max(second * d1)].map(|size| size * scale)
}

/// Names, values and scales of the gaps of a joint, all of which must be zero.
fn gaps(joint: &Joint, frames: &Frames, length: f64) -> Vec<(&'static str, Transfer, f64)> {
    let apart = |[a, b]: &[jred::machine::Marker; 2]| {
        let ([x_a, y_a], [x_b, y_b]) = (a.position(frames), b.position(frames));
        [x_b - x_a, y_b - y_a]
    };
    let across = |marker: &jred::machine::Marker, [x, y]: [Transfer; 2]| {
        let [cos, sin] = marker.axis(frames);
        cos * y - sin * x
    };
    let turned = |[a, b]: &[jred::machine::Marker; 2]| {
        let angle = b.direction(frames) - a.direction(frames);
        let whole = (angle.value / std::f64::consts::TAU).round() * std::f64::consts::TAU;
        angle - Transfer::constant(whole)
    };
    match joint {
        Joint::Revolute(m) => {
            let [x, y] = apart(m);
            vec![("x", x, length), ("y", y, length)]
        }
        Joint::Prismatic(m) => vec![
            ("off the guide", across(&m[0], apart(m)), length),
            ("turned", turned(m), 1.0),
        ],
        Joint::Fixed(m) => {
            let [x, y] = apart(m);
            vec![
                ("x", x, length),
                ("y", y, length),
                ("turned", turned(m), 1.0),
            ]
        }
        Joint::PinInSlot(m) => vec![("off the slot", across(&m[1], apart(m)), length)],
        Joint::Transmission(_) => Vec::new(),
    }
}

/// Power of a wrench at ω = 1.
fn power(wrench: &Wrench, frames: &Frames) -> f64 {
    let (x, y, turn) = speeds(wrench, frames);
    wrench.force[0] * x + wrench.force[1] * y + wrench.moment * turn
}

fn power_size(wrench: &Wrench, frames: &Frames) -> f64 {
    let (x, y, turn) = speeds(wrench, frames);
    largest([
        wrench.force[0] * x,
        wrench.force[1] * y,
        wrench.moment * turn,
    ])
}

/// Velocity of the point of application, as a point of the body, and the body's angular velocity, at ω = 1.
fn speeds(wrench: &Wrench, frames: &Frames) -> (f64, f64, f64) {
    let frame = wrench.body.frame(frames);
    let arm = [
        wrench.point[0] - frame.x.value,
        wrench.point[1] - frame.y.value,
    ];
    let turn = frame.psi.d1;
    (frame.x.d1 - turn * arm[1], frame.y.d1 + turn * arm[0], turn)
}

/// Every link moves continuously over the drive's range, and a turn ends where it began (angles up to whole turns of a link whose motion repeats).
#[track_caller]
pub(crate) fn turns(mechanism: &impl Mechanism, steps: u32) {
    let domain = mechanism.domain();
    let step = domain.span() / f64::from(steps);
    let mut before = mechanism.frames(domain.position(0.0)).unwrap();
    for k in 1..=steps {
        let phi = domain.position(f64::from(k) / f64::from(steps));
        let now = mechanism.frames(phi).unwrap();
        for (link, (a, b)) in before.iter().zip(&now).enumerate() {
            for (what, f) in [
                ("x", [a.x, b.x]),
                ("y", [a.y, b.y]),
                ("psi", [a.psi, b.psi]),
            ] {
                // The trapezoidal rule and its remainder: a jump is far larger.
                let [from, to] = f;
                let expected = 0.5 * (from.d1 + to.d1) * step;
                let bound = (0.25 * (to.d2 - from.d2).abs() + 0.1 * (from.d2.abs() + to.d2.abs()))
                    * step
                    * step
                    + 1e-9 * (1.0 + from.value.abs());
                assert_near(
                    &format!("link {link}, {what} at φ = {phi}"),
                    to.value - from.value,
                    expected,
                    bound.max(0.05 * expected.abs()),
                );
            }
        }
        before = now;
    }
    if domain == Domain::Turn {
        let first = mechanism.frames(0.3).unwrap();
        let again = mechanism.frames(0.3 + std::f64::consts::TAU).unwrap();
        for (link, (a, b)) in first.iter().zip(&again).enumerate() {
            for (a, b) in [(a.x, b.x), (a.y, b.y), (a.psi, b.psi)] {
                assert_near(
                    &format!("link {link} a turn later"),
                    b.d1,
                    a.d1,
                    1e-9 * (1.0 + a.d1.abs()),
                );
            }
        }
    }
}

/// The reduced inertia's slope is the derivative of its value, and its energy the sum over the links.
#[track_caller]
pub(crate) fn energy<M: Jointed>(machine: &Machine<M>, phi: f64, omega: f64) {
    let reduced = machine.bare_reduction(phi).unwrap();
    let frames = machine.mechanism().frames(phi).unwrap();
    let of = |(link, frame): (&jred::machine::Link, &jred::machine::Frame)| {
        let [x, y] = frame.point(link.com()).map(|c| c.velocity(omega));
        let turn = frame.psi.velocity(omega);
        0.5 * link.mass() * (x * x + y * y) + 0.5 * link.inertia() * turn * turn
    };
    let links: f64 = machine
        .mechanism()
        .links()
        .iter()
        .zip(&frames)
        .map(of)
        .sum();
    let total = links + 0.5 * machine.flywheel() * omega * omega;
    let found = 0.5 * reduced.inertia * omega * omega;
    assert_near(
        "kinetic energy",
        found,
        total,
        budget::DALEMBERT * total.abs(),
    );
    let _ = machine.domain();
}

/// The mechanism's joints, assembled by the general solver from a slightly inaccurate drawing at `phi`.
pub(crate) fn as_linkage(
    mechanism: &impl Jointed,
    phi: f64,
) -> Result<Assembly<16, 32, 256>, LinkageError> {
    let frames = mechanism.frames(phi)?;
    let joints = mechanism.joints(phi, &frames)?;
    let pairs: Vec<Pair> = joints.iter().copied().map(Pair::Joint).collect();
    let drawing: Vec<Pose> = frames
        .iter()
        .enumerate()
        .map(|(k, frame)| {
            let off = 1e-3 * if k % 2 == 0 { 1.0 } else { -1.0 };
            Pose {
                x: frame.x.value * (1.0 + off),
                y: frame.y.value * (1.0 - off),
                psi: frame.psi.value + 10.0 * off,
            }
        })
        .collect();
    let drive = joints[mechanism.drive()].coordinate(&frames).value;
    assert_near("drive coordinate", drive, phi, 1e-12 * (1.0 + phi.abs()));
    Linkage::new(mechanism.links(), &pairs, mechanism.drive())?.assemble(
        mechanism.domain(),
        phi,
        &drawing,
    )
}

/// Every frame of two mechanisms with the same links, with all transfer functions.
#[track_caller]
pub(crate) fn same_frames(one: &impl Mechanism, other: &impl Mechanism, phi: f64, budget: f64) {
    let [a, b] = [one.frames(phi).unwrap(), other.frames(phi).unwrap()];
    assert_eq!(a.len(), b.len());
    let length = largest(a.iter().flat_map(|f| [f.x.value, f.y.value])).max(1e-3);
    for (link, (a, b)) in a.iter().zip(&b).enumerate() {
        for (what, x, y, scale) in [
            ("x", a.x, b.x, length),
            ("y", a.y, b.y, length),
            ("psi", a.psi, b.psi, 1.0),
        ] {
            let sizes = order_sizes(&one.frames(phi).unwrap(), scale);
            let pairs = [(x.value, y.value), (x.d1, y.d1), (x.d2, y.d2), (x.d3, y.d3)];
            for (order, ((x, y), size)) in pairs.iter().zip(sizes).enumerate() {
                let name = format!("φ = {phi}: {what} of link {link}, derivative {order}");
                // Whole turns depend on the start of the drawing.
                let whole = if what == "psi" && order == 0 {
                    ((x - y) / std::f64::consts::TAU).round() * std::f64::consts::TAU
                } else {
                    0.0
                };
                assert_near(&name, *y + whole, *x, budget * size);
            }
        }
    }
}

/// All checks above that concern one instant: the joints close, the forces balance, the energies agree.
#[track_caller]
pub(crate) fn holds<M: Jointed>(machine: &Machine<M>, phi: f64, omega: f64, alpha: f64) {
    joints_close(machine.mechanism(), phi);
    forces::dalembert(machine, phi, omega, alpha);
    forces::balance(machine, phi, omega, alpha);
    energy(machine, phi, omega);
}
