//! Shared by the benchmarks: the four-bar linkage in two descriptions.
#![allow(dead_code, reason = "every benchmark uses its own part")]
use jred::Domain;
use jred::error::Error;
use jred::machine::{Joint, Link, Marker, MassProperties};
use jred::mechanism::linkage::{Assembly, Linkage, Pair, Pose};
use jred::mechanism::{FourBar, FourBarDimensions, Side};

pub(crate) const O: [f64; 2] = [0.0, 0.0];

pub(crate) const fn pin(a: Marker, b: Marker) -> Pair {
    Pair::Joint(Joint::Revolute([a, b]))
}

/// Dimensions (m).
const DIMENSIONS: FourBarDimensions = FourBarDimensions {
    crank: 0.08,
    coupler: 0.32,
    rocker: 0.24,
    pivot: [0.3, 0.05],
};

fn links() -> Result<[Link; 3], Error> {
    Ok([
        Link::new(MassProperties {
            mass: 0.9,
            inertia: 0.002,
            com: [0.03, 0.0],
        })?,
        Link::new(MassProperties {
            mass: 0.6,
            inertia: 0.006,
            com: [0.16, 0.01],
        })?,
        Link::new(MassProperties {
            mass: 1.4,
            inertia: 0.011,
            com: [0.12, 0.0],
        })?,
    ])
}

/// The four-bar in closed form.
pub(crate) fn four_bar() -> Result<FourBar, Error> {
    Ok(FourBar::new(DIMENSIONS, Side::Left, links()?)?)
}

/// The same, described only by its links and pins.
pub(crate) fn four_bar_linkage<const STATIONS: usize>() -> Result<Assembly<3, 4, STATIONS>, Error> {
    let FourBarDimensions {
        crank,
        coupler,
        rocker,
        pivot,
    } = DIMENSIONS;
    let pairs = [
        pin(Marker::ground(O), Marker::on(0, O)),
        pin(Marker::on(0, [crank, 0.0]), Marker::on(1, O)),
        pin(Marker::on(1, [coupler, 0.0]), Marker::on(2, [rocker, 0.0])),
        pin(Marker::ground(pivot), Marker::on(2, O)),
    ];
    let drawing = [[0.0, 0.0, 0.0], [0.08, 0.0, 0.8], [0.3, 0.05, 1.7]];
    let drawing = drawing.map(|[x, y, psi]| Pose { x, y, psi });
    Ok(Linkage::new(&links()?, &pairs, 0)?.assemble(Domain::Turn, 0.0, &drawing)?)
}
