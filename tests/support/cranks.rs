//! Random slider-cranks with every load that their closed form supports.

use jred::error::Error;
use jred::machine::{Action, Load, Machine};
use jred::mechanism::{Branch, SliderCrank, SliderCrankDimensions};
use jred::slider_crank::{form, set_in_use};
use jred::table::{Shape, Table, words_len};
use jred::{AnyModel, CurveSet, SliderCrankForm};
use proptest::prelude::*;

use super::link_of;

/// Largest speed and acceleration of a tick.
pub(crate) const OMEGA: f64 = 60.0;
pub(crate) const ALPHA: f64 = 400.0;

/// A slider-crank by numbers from 0 to 1, or from −1 to 1.
#[derive(Clone, Debug)]
pub(crate) struct Given {
    pub(crate) rod: f64,
    /// (r + |e|)/l
    pub(crate) steepness: f64,
    /// Share of r in it; the rest is e.
    share: f64,
    offset: f64,
    left: bool,
    links: [[f64; 4]; 3],
    gravity: [f64; 2],
    flywheel: f64,
    loads: Vec<(u8, usize, [f64; 4])>,
}

prop_compose! {
    /// Steepness from `least` to `most`.
    pub(crate) fn cranks(least: f64, most: f64)(
        rod in 0.02f64..1.0, steepness in least..most, share in 0.2f64..1.0,
        offset in prop_oneof![Just(-1.0), Just(1.0), Just(0.0)], left: bool,
        links in [
            [0.0f64..1.0, 0.0..1.0, -1.0..1.0, -1.0..1.0],
            [0.0f64..1.0, 0.0..1.0, -1.0..1.0, -1.0..1.0],
            [0.0f64..1.0, 0.0..1.0, -1.0..1.0, -1.0..1.0],
        ],
        gravity in [-9.81f64..9.81, -9.81..9.81], flywheel in 0.0f64..1.0,
        loads in prop::collection::vec((0u8..6, 0usize..3, [-1.0f64..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0]), 0..6),
    ) -> Given {
        Given { rod, steepness, share, offset, left, links, gravity, flywheel, loads }
    }
}

impl Given {
    pub(crate) fn dimensions(&self) -> SliderCrankDimensions {
        let crank = self.rod * self.steepness * self.share;
        SliderCrankDimensions {
            crank,
            rod: self.rod,
            offset: self.offset * (self.rod * self.steepness - crank),
        }
    }

    /// Centres of mass off the links' lines, a weight in any direction.
    pub(crate) fn machine(&self) -> Machine<SliderCrank> {
        let lengths = self.dimensions();
        let link = |k: usize, length: f64| {
            let [mass, inertia, u, v] = self.links[k];
            link_of(
                5.0 * mass,
                2.0 * inertia * length * length,
                [u * length, v * length],
            )
        };
        let links = [
            link(0, lengths.crank),
            link(1, lengths.rod),
            link(2, lengths.rod),
        ];
        let branch = if self.left {
            Branch::Left
        } else {
            Branch::Right
        };
        let mechanism = SliderCrank::new(lengths, branch, links).unwrap();
        // At least a tenth of the slider's and the rod's J; lighter ones are covered by another test.
        let least = 0.1 * (5.0 * lengths.crank * lengths.crank);
        let mut machine = Machine::new(mechanism)
            .with_gravity(self.gravity)
            .and_then(|machine| machine.with_flywheel(least * (1.0 + 10.0 * self.flywheel)))
            .unwrap();
        for (kind, link, [a, b, u, v]) in &self.loads {
            let mut at = [0.5 * self.rod * u, 0.5 * self.rod * v];
            let action = match kind {
                0 => Action::Force([100.0 * a, 100.0 * b]),
                1 => Action::Moment(10.0 * a),
                2 => Action::OpposingMoment(a.abs()),
                3 => Action::ViscousForce(20.0 * a.abs()),
                4 => Action::ViscousMoment(0.1 * a.abs()),
                _ => {
                    // On the rod only its crank pin.
                    if *link == SliderCrank::ROD {
                        at = [0.0, 0.0];
                    }
                    Action::OpposingForce(100.0 * a.abs())
                }
            };
            let load = Load::new(*link, action)
                .and_then(|load| load.at(at))
                .unwrap();
            machine = machine.with_load(load).unwrap();
        }
        machine
    }
}

/// Coefficients and set.
pub(crate) fn words_of(machine: &Machine<SliderCrank>) -> Result<(Vec<f32>, CurveSet), Error> {
    let set = set_in_use(machine)?;
    let mut words = vec![0.0; words_len::<SliderCrankForm>(0, set)];
    form(machine, set, &mut words)?;
    Ok((words, set))
}

pub(crate) fn model_of(
    words: &[f32],
    set: CurveSet,
) -> Result<AnyModel<'_, SliderCrankForm>, Error> {
    let table = Table::new(words, Shape::slider_crank(set))?;
    Ok(AnyModel::new(table)?)
}
