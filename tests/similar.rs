//! Similar machines have similar forces: moved, turned, mirrored, in other units of length, mass and time; run backwards; a turn later; and with the
//! loads one by one.
//!
//! With the lengths λ, masses μ and times τ times as large, every joint force is μ·λ/τ² and every torque μ·λ²/τ² times as large (Buckingham). A
//! mirror image reverses every angle and moment, and φ.

use std::f64::consts::TAU;

use jred::Domain;
use jred::machine::{
    Action, Body, Element, Joint, Jointed, Link, Load, Machine, Marker, MassProperties, Mechanism,
    Reducible, Window,
};
use jred::mechanism::linkage::{Assembly, Linkage, Pair, Pose};
use proptest::prelude::*;

use crate::support::{assert_near, budget, config, jointed, largest, machines};
use crate::{four_bar, six_link, toggle_press};

/// Another frame of reference and other units.
#[derive(Clone, Copy, Debug)]
struct Change {
    shift: [f64; 2],
    angle: f64,
    mirrored: bool,
    length: f64,
    mass: f64,
    time: f64,
}

prop_compose! {
    fn change()(
        shift in [-2.0..2.0, -2.0..2.0], angle in -3.2..3.2, mirrored: bool,
        length in 0.1..10.0, mass in 0.01..100.0, time in 0.1..10.0,
    ) -> Change {
        Change { shift, angle, mirrored, length, mass, time }
    }
}

impl Change {
    /// Sign of angles.
    fn sign(&self) -> f64 {
        if self.mirrored { -1.0 } else { 1.0 }
    }

    fn force(&self) -> f64 {
        self.mass * self.length / (self.time * self.time)
    }

    /// A vector of the fixed frame.
    fn vector(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = self.angle.sin_cos();
        let y = self.sign() * y;
        [cos * x - sin * y, sin * x + cos * y]
    }

    /// A point of the fixed frame.
    fn point(&self, at: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.vector(at);
        [
            self.shift[0] + self.length * x,
            self.shift[1] + self.length * y,
        ]
    }

    /// A point of a link.
    fn local(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        [self.length * u, self.sign() * self.length * v]
    }

    fn marker(&self, marker: &Marker) -> Marker {
        let angle = self.sign() * marker.angle();
        match marker.body {
            Body::Ground => Marker::ground(self.point(marker.at)).with_angle(self.angle + angle),
            Body::Link(link) => Marker::on(link, self.local(marker.at)).with_angle(angle),
        }
    }

    fn joint(&self, joint: &Joint) -> Joint {
        let both = |pair: &[Marker; 2]| [self.marker(&pair[0]), self.marker(&pair[1])];
        match joint {
            Joint::Revolute(pair) => Joint::Revolute(both(pair)),
            Joint::Prismatic(pair) => Joint::Prismatic(both(pair)),
            Joint::Fixed(pair) => Joint::Fixed(both(pair)),
            Joint::PinInSlot(pair) => Joint::PinInSlot(both(pair)),
            Joint::Transmission(_) => unreachable!("links and pins only"),
        }
    }

    /// The mechanism in that frame, assembled from its joints.
    fn mechanism(&self, mechanism: &impl Jointed, phi: f64) -> Assembly<16, 32, 256> {
        let frames = mechanism.frames(phi).unwrap();
        let joints = mechanism.joints(phi, &frames).unwrap();
        let pairs: Vec<Pair> = joints.iter().map(|j| Pair::Joint(self.joint(j))).collect();
        let link = |link: &Link| {
            let inertia = self.mass * self.length * self.length * link.inertia();
            Link::new(MassProperties {
                mass: self.mass * link.mass(),
                inertia,
                com: self.local(link.com()),
            })
            .unwrap()
        };
        let links: Vec<Link> = mechanism.links().iter().map(link).collect();
        let pose = |frame: &jred::machine::Frame| {
            let [x, y] = self.point([frame.x.value, frame.y.value]);
            Pose {
                x,
                y,
                psi: self.angle + self.sign() * frame.psi.value,
            }
        };
        let drawing: Vec<Pose> = frames.iter().map(pose).collect();
        let linkage = Linkage::new(&links, &pairs, mechanism.drive()).unwrap();
        linkage
            .assemble(Domain::Turn, self.sign() * phi, &drawing)
            .unwrap()
    }
}

/// A load of a machine.
#[derive(Clone, Copy, Debug)]
enum Source {
    Gravity([f64; 2]),
    Load(usize, Action, [f64; 2], Option<[f64; 3]>),
    Spring([Marker; 2], f64, f64),
    Damper([Marker; 2], f64),
}

impl Source {
    /// One or more of each kind.
    fn all(last: usize, size: f64) -> [Self; 7] {
        let ends = [
            Marker::on(last, [0.2 * size, 0.1 * size]),
            Marker::ground([-3.0 * size, 2.5 * size]),
        ];
        let at = [0.4 * size, -0.3 * size];
        [
            Self::Gravity([3.0, -9.3]),
            Self::Load(
                last,
                Action::Force([-40.0, 25.0]),
                at,
                Some([0.4, 4.0, 0.7]),
            ),
            Self::Load(1, Action::Moment(3.0), [0.0; 2], None),
            Self::Spring(ends, 300.0, 2.0 * size),
            Self::Load(last, Action::OpposingForce(15.0), at, None),
            Self::Load(1, Action::ViscousMoment(0.2), [0.0; 2], None),
            Self::Damper(ends, 40.0),
        ]
    }

    /// Whether it takes power in both directions of motion.
    fn dissipates(&self) -> bool {
        match self {
            Self::Gravity(_) | Self::Spring(..) => false,
            Self::Load(_, action, ..) => !matches!(action, Action::Force(_) | Action::Moment(_)),
            Self::Damper(..) => true,
        }
    }

    fn under(&self, change: &Change) -> Self {
        let (force, length, time) = (change.force(), change.length, change.time);
        let both = |ends: &[Marker; 2]| [change.marker(&ends[0]), change.marker(&ends[1])];
        match *self {
            Self::Gravity(g) => Self::Gravity(change.vector(g).map(|g| g * length / (time * time))),
            Self::Load(link, action, at, window) => {
                let action = match action {
                    Action::Force(f) => Action::Force(change.vector(f).map(|f| f * force)),
                    Action::Moment(m) => Action::Moment(change.sign() * m * force * length),
                    Action::OpposingForce(f) => Action::OpposingForce(f * force),
                    Action::ViscousMoment(c) => Action::ViscousMoment(c * force * length * time),
                    other => unreachable!("{other:?}"),
                };
                let mirrored = |[from, to, ramp]: [f64; 3]| {
                    if change.mirrored {
                        [-to, -from, ramp]
                    } else {
                        [from, to, ramp]
                    }
                };
                Self::Load(link, action, change.local(at), window.map(mirrored))
            }
            Self::Spring(ref ends, k, free) => {
                Self::Spring(both(ends), k * force / length, free * length)
            }
            Self::Damper(ref ends, d) => Self::Damper(both(ends), d * force * time / length),
        }
    }

    fn on<M: Mechanism>(&self, machine: Machine<M>) -> Machine<M> {
        match *self {
            Self::Gravity(g) => machine.with_gravity(g),
            Self::Load(link, action, at, window) => {
                let load = Load::new(link, action).and_then(|l| l.at(at)).unwrap();
                machine.with_load(match window {
                    Some([from, to, ramp]) => {
                        load.within(Window::new(Domain::Turn, [from, to], ramp).unwrap())
                    }
                    None => load,
                })
            }
            Self::Spring(ends, k, free) => {
                machine.with_element(Element::spring(ends, k, free).unwrap())
            }
            Self::Damper(ends, d) => machine.with_element(Element::damper(ends, d).unwrap()),
        }
        .unwrap()
    }
}

fn loaded<M: Mechanism>(mechanism: M, sources: &[Source]) -> Machine<M> {
    sources
        .iter()
        .fold(Machine::new(mechanism), |machine, source| {
            source.on(machine)
        })
}

/// Drive torque, and x, y and moment of every reaction.
fn forces(machine: &Machine<impl Jointed>, phi: f64, omega: f64, alpha: f64) -> Vec<f64> {
    let forces = machine.forces(phi, omega, alpha).unwrap();
    let reactions = forces
        .reactions
        .iter()
        .flat_map(|r| [r.force[0], r.force[1], r.moment]);
    std::iter::once(forces.drive).chain(reactions).collect()
}

/// Each figure close to another, relative to the largest torque, which includes a force at the mechanism's size.
#[track_caller]
fn same(what: &str, found: &[f64], expected: &[f64], size: f64) {
    assert_eq!(found.len(), expected.len());
    for (k, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert_near(
            &format!("{what}: figure {k}"),
            *found,
            *expected,
            budget::SIMILAR * size,
        );
    }
}

/// All checks for one mechanism.
fn holds(mechanism: &impl Jointed, change: &Change, [phi, omega, alpha]: [f64; 3]) {
    let frames = mechanism.frames(phi).unwrap();
    let length = jointed::size(mechanism, phi, &frames);
    let sources = Source::all(mechanism.links().len() - 1, length);
    let machine = loaded(mechanism, &sources);
    let here = forces(&machine, phi, omega, alpha);

    // Loads one by one, forward and backward: the contribution of each to the inertia forces.
    let bare = loaded(mechanism, &[]);
    let inertia = forces(&bare, phi, omega, alpha);
    let alone = |source: &Source, omega: f64| -> Vec<f64> {
        let with = forces(&loaded(mechanism, &[*source]), phi, omega, alpha);
        with.iter()
            .zip(&inertia)
            .map(|(with, bare)| with - bare)
            .collect()
    };
    let mut sum = inertia.clone();
    let mut back = inertia.clone();
    let mut size = largest(inertia.iter().copied());
    for source in &sources {
        let adds = alone(source, omega);
        size = size.max(largest(adds.iter().copied()));
        let sign = if source.dissipates() { -1.0 } else { 1.0 };
        assert!(
            !source.dissipates() || adds[0] * omega >= 0.0,
            "{source:?} gives power"
        );
        for ((sum, back), adds) in sum.iter_mut().zip(&mut back).zip(adds) {
            *sum += adds;
            *back += sign * adds;
        }
    }
    same("loads one by one", &sum, &here, size);
    same(
        "backwards",
        &forces(&machine, phi, -omega, alpha),
        &back,
        size,
    );
    let turn = forces(&machine, phi + TAU, omega, alpha);
    same("a turn later", &turn, &here, size);

    // In another frame, in other units.
    let image = change.mechanism(mechanism, phi);
    let sources: Vec<Source> = sources.iter().map(|s| s.under(change)).collect();
    let image = loaded(&image, &sources);
    let (sign, time) = (change.sign(), change.time);
    let [there, turned, speeding] = [
        sign * phi,
        sign * omega / time,
        sign * alpha / (time * time),
    ];
    let torque = change.force() * change.length;
    let mut expected = vec![sign * here[0]];
    let mut found = forces(&image, there, turned, speeding);
    found[0] /= torque;
    for (expects, figures) in here[1..].chunks(3).zip(found[1..].chunks_mut(3)) {
        let [x, y] = change.vector([expects[0], expects[1]]);
        expected.extend([x, y, sign * expects[2]]);
        figures[0] /= change.force();
        figures[1] /= change.force();
        figures[2] /= torque;
    }
    same("elsewhere", &found, &expected, size);
    let [a, b] = [
        machine.reduction(phi).unwrap(),
        image.reduction(there).unwrap(),
    ];
    let total = b.torque(turned, speeding).total() / torque;
    same("reduced", &[total], &expected[..1], size);
    let unit = change.mass * change.length * change.length;
    let found = b.inertias().map(|inertia| inertia / unit);
    let [inertia, slope, curvature] = a.inertias();
    let expected = [inertia, sign * slope, curvature];
    same("J, J′, J″", &found, &expected, largest(expected));
}

proptest! {
    #![proptest_config(config(60, 0x0517))]

    #[test]
    fn similar_machines_have_similar_forces(
        slider in machines::spec(), bar in four_bar::spec(), six in six_link::spec(), toggle in toggle_press::spec(),
        change in change(), motion in [-7.0..7.0_f64, 1.0..40.0, -500.0..500.0],
    ) {
        holds(&slider.mechanism(), &change, motion);
        holds(bar.machine().mechanism(), &change, motion);
        holds(six.machine().mechanism(), &change, motion);
        holds(toggle.machine().mechanism(), &change, motion);
    }
}
