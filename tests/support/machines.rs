//! Machines to test with: random slider-cranks, and a machine whose curves are plain sines.
use jred::Domain;
use jred::machine::{Action, Link, Load, Machine, MassProperties, Mechanism, Reducible, Reduction};
use jred::mechanism::{Branch, SliderCrank, SliderCrankDimensions};
use proptest::prelude::*;

use super::golden::Case;
use super::link_of;

/// A random slider-crank with every kind of load.
#[derive(Clone, Debug)]
pub(crate) struct Spec {
    /// Crank length (m).
    pub(crate) crank: f64,
    /// Rod length over the shortest possible.
    pub(crate) rod_ratio: f64,
    /// Offset over crank length.
    pub(crate) offset_ratio: f64,
    /// Which branch.
    pub(crate) left: bool,
    /// Masses (kg).
    pub(crate) mass: [f64; 3],
    /// Centres of mass over crank length, u and v for crank and rod.
    pub(crate) com: [f64; 4],
    /// Direction of gravity (rad).
    pub(crate) down: f64,
    /// Force on the slider (N), opposing force (N), viscous coefficient (N·s/m), viscous moment (N·m·s/rad).
    pub(crate) loads: [f64; 4],
    /// Inertia of the flywheel over that of the slider on the crank's pin.
    pub(crate) flywheel: f64,
}

prop_compose! {
    /// Random machines of the size of a small press.
    pub(crate) fn spec()(
        crank in 0.02..0.2,
        rod_ratio in 1.3..5.0,
        offset_ratio in -0.6..0.6,
        left in any::<bool>(),
        mass in [0.1..3.0, 0.1..3.0, 0.2..5.0],
        com in [-0.5..1.0, -0.3..0.3, 0.0..2.0, -0.3..0.3],
        down in 0.0..6.2,
        loads in [-300.0..300.0, 0.0..100.0, 0.0..50.0, 0.0..0.02],
        flywheel in 0.05..2.0,
    ) -> Spec {
        Spec { crank, rod_ratio, offset_ratio, left, mass, com, down, loads, flywheel }
    }
}

impl Spec {
    /// Rod length (m).
    pub(crate) fn rod(&self) -> f64 {
        self.rod_ratio * self.crank * (1.0 + self.offset_ratio.abs())
    }

    /// The links: crank, rod, slider.
    pub(crate) fn links(&self) -> [Link; 3] {
        let (r, [m1, m2, m3], [u1, v1, u2, v2]) = (self.crank, self.mass, self.com);
        [
            link_of(m1, 0.1 * m1 * r * r, [u1 * r, v1 * r]),
            link_of(m2, 0.1 * m2 * self.rod() * self.rod(), [u2 * r, v2 * r]),
            Link::point_mass(m3).unwrap(),
        ]
    }

    /// The mechanism.
    pub(crate) fn mechanism(&self) -> SliderCrank {
        let branch = if self.left {
            Branch::Left
        } else {
            Branch::Right
        };
        let offset = self.offset_ratio * self.crank;
        SliderCrank::new(
            SliderCrankDimensions {
                crank: self.crank,
                rod: self.rod(),
                offset,
            },
            branch,
            self.links(),
        )
        .unwrap()
    }

    /// Gravity (m/s²).
    pub(crate) fn gravity(&self) -> [f64; 2] {
        [9.81 * self.down.cos(), 9.81 * self.down.sin()]
    }

    /// Without gravity and loads.
    pub(crate) fn bare(&self) -> Machine<SliderCrank> {
        let flywheel = self.flywheel * self.mass[2] * self.crank * self.crank;
        Machine::new(self.mechanism())
            .with_flywheel(flywheel)
            .unwrap()
    }

    /// With gravity.
    pub(crate) fn heavy(&self) -> Machine<SliderCrank> {
        self.bare().with_gravity(self.gravity()).unwrap()
    }

    /// With gravity and loads.
    pub(crate) fn machine(&self) -> Machine<SliderCrank> {
        let [force, friction, viscous, moment] = self.loads;
        let on = |link, action| Load::new(link, action).unwrap();
        self.heavy()
            .with_load(on(SliderCrank::SLIDER, Action::Force([force, 0.0])))
            .and_then(|m| {
                m.with_load(on(
                    SliderCrank::CRANK,
                    Action::OpposingMoment(0.01 * friction),
                ))
            })
            .and_then(|m| m.with_load(on(SliderCrank::SLIDER, Action::ViscousForce(viscous))))
            .and_then(|m| m.with_load(on(SliderCrank::ROD, Action::ViscousMoment(moment))))
            .unwrap()
    }
}

/// J = mean + swing·cos φ, load = load·sin φ, constant b and c: curves in closed form.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wave {
    /// Mean reduced inertia (kg·m²).
    pub(crate) mean: f64,
    /// Its swing (kg·m²).
    pub(crate) swing: f64,
    /// Amplitude of the load torque (N·m).
    pub(crate) load: f64,
    /// b (N·m·s/rad).
    pub(crate) viscous: f64,
    /// c (N·m).
    pub(crate) coulomb: f64,
    /// Range.
    pub(crate) domain: Domain,
}

impl Wave {
    /// Inertia only, over a turn.
    pub(crate) const fn bare(mean: f64, swing: f64) -> Self {
        Self {
            mean,
            swing,
            load: 0.0,
            viscous: 0.0,
            coulomb: 0.0,
            domain: Domain::Turn,
        }
    }
}

impl Reducible for Wave {
    fn domain(&self) -> Domain {
        self.domain
    }

    fn reduction(&self, phi: f64) -> Result<Reduction, jred::machine::PoseError> {
        let (sin, cos) = phi.sin_cos();
        Ok(Reduction::new([
            self.mean + self.swing * cos,
            -self.swing * sin,
            -self.swing * cos,
        ])
        .with_process(self.load * sin)
        .with_viscous(self.viscous)
        .with_coulomb(self.coulomb))
    }
}

/// A mechanism in gravity of this direction (rad), with these loads on one link.
pub(crate) fn loaded<M: Mechanism>(
    mechanism: M,
    down: f64,
    link: usize,
    loads: [Action; 3],
) -> Machine<M> {
    let gravity = [9.81 * down.cos(), 9.81 * down.sin()];
    let machine = Machine::new(mechanism).with_gravity(gravity).unwrap();
    loads.into_iter().fold(machine, |machine, action| {
        let load = Load::new(link, action).unwrap();
        machine.with_load(load).unwrap()
    })
}

/// The slider-crank of the golden data, with its loads.
pub(crate) fn golden_slider_crank(case: &Case) -> Machine<SliderCrank> {
    let input = |path| case.input(path);
    let links = [
        Link::new(MassProperties {
            mass: input("/m1"),
            inertia: input("/I1"),
            com: [input("/crank_com/0"), input("/crank_com/1")],
        }),
        Link::new(MassProperties {
            mass: input("/m2"),
            inertia: input("/I2"),
            com: [input("/coupler_com/0"), input("/coupler_com/1")],
        }),
        Link::new(MassProperties {
            mass: input("/m3"),
            inertia: 0.0,
            com: [input("/slider_com/0"), input("/slider_com/1")],
        }),
    ]
    .map(Result::unwrap);
    let branch = if input("/branch") > 0.0 {
        Branch::Right
    } else {
        Branch::Left
    };
    let mechanism = SliderCrank::new(
        SliderCrankDimensions {
            crank: input("/r"),
            rod: input("/l"),
            offset: input("/e"),
        },
        branch,
        links,
    )
    .unwrap();
    let force = Action::Force([input("/F_slider/F/0"), input("/F_slider/F/1")]);
    let at = [input("/F_slider/at/0"), input("/F_slider/at/1")];
    let force = Load::new(SliderCrank::SLIDER, force).and_then(|f| f.at(at));
    let moment = Load::new(SliderCrank::CRANK, Action::Moment(input("/M_crank")));
    Machine::new(mechanism)
        .with_gravity([input("/gravity/0"), input("/gravity/1")])
        .and_then(|m| m.with_load(force?))
        .and_then(|m| m.with_load(moment?))
        .unwrap()
}
