//! Growing linkages: a chain of two-link groups, and one indivisible group.
use jred::Domain;
use jred::error::Error;
use jred::machine::{Joint, Link, Marker, MassProperties};
use jred::mechanism::linkage::{Assembly, Linkage, Pair, Pose};

use crate::support::{O, pin};

fn link(mass: f64) -> Result<Link, Error> {
    Ok(Link::new(MassProperties {
        mass,
        inertia: mass * 0.01,
        com: [0.03, 0.01],
    })?)
}

/// The six-link mechanism of equations (81): crank 0.1, rocker 0.45 about (−0.25, 0), rod 0.6, guide y = −0.35 m.
pub(crate) const SIX_LINK: [f64; 5] = [0.1, 0.45, 0.6, 0.25, 0.35];

/// Links of the six-link mechanism: crank, block, rocker, rod, slider.
pub(crate) fn six_links() -> Result<[Link; 5], Error> {
    Ok([link(1.0)?, link(0.5)?, link(2.0)?, link(1.0)?, link(3.0)?])
}

/// The six-link mechanism as a general linkage.
pub(crate) fn six_link() -> Result<Assembly<5, 7, 256>, Error> {
    let [crank, rocker, rod, centres, guide] = SIX_LINK;
    let slide = |a, b| Pair::Joint(Joint::Prismatic([a, b]));
    let pairs = [
        pin(Marker::ground(O), Marker::on(0, O)),
        pin(Marker::on(0, [crank, 0.0]), Marker::on(1, O)),
        slide(Marker::on(2, O), Marker::on(1, O)),
        pin(Marker::ground([-centres, 0.0]), Marker::on(2, O)),
        pin(Marker::on(2, [rocker, 0.0]), Marker::on(3, O)),
        pin(Marker::on(3, [rod, 0.0]), Marker::on(4, O)),
        slide(Marker::ground([0.0, -guide]), Marker::on(4, O)),
    ];
    let drawing = [
        [0.0, 0.0, 0.0],
        [crank, 0.0, 0.0],
        [-centres, 0.0, 0.0],
        [0.2, 0.0, -0.6],
        [0.7, -guide, 0.0],
    ];
    let drawing = drawing.map(|[x, y, psi]| Pose { x, y, psi });
    Ok(Linkage::new(&six_links()?, &pairs, 0)?.assemble(Domain::Turn, 0.0, &drawing)?)
}

/// Stations of the growing linkages.
const STATIONS: usize = 64;

/// A crank-rocker whose rocker moves the next rocker in parallel, and so on: `stages` two-link groups, 1 + 2·stages links.
pub(crate) fn chain<const LINKS: usize, const PAIRS: usize>(
    stages: usize,
) -> Result<Assembly<LINKS, PAIRS, STATIONS>, Error> {
    let (crank, rocker, gap) = (0.05, 0.2, 0.3);
    let up = core::f64::consts::FRAC_PI_2;
    let mut links = vec![link(1.0)?];
    let mut pairs = vec![pin(Marker::ground(O), Marker::on(0, O))];
    let mut drawing = vec![[0.0, 0.0, up]];
    let mut from = Marker::on(0, [crank, 0.0]);
    let mut at = [0.0, crank];
    for stage in 0..stages {
        let (coupler, lever) = (1 + 2 * stage, 2 + 2 * stage);
        let pivot = [gap * (stage + 1) as f64, 0.0];
        let end = [pivot[0], rocker];
        let [x, y] = [end[0] - at[0], end[1] - at[1]];
        links.extend([link(0.5)?, link(1.0)?]);
        pairs.extend([
            pin(from, Marker::on(coupler, O)),
            pin(
                Marker::on(coupler, [x.hypot(y), 0.0]),
                Marker::on(lever, [rocker, 0.0]),
            ),
            pin(Marker::ground(pivot), Marker::on(lever, O)),
        ]);
        drawing.extend([[at[0], at[1], y.atan2(x)], [pivot[0], 0.0, up]]);
        (from, at) = (Marker::on(lever, [rocker, 0.0]), end);
    }
    assemble(&links, &pairs, &drawing, up)
}

/// A chain of `m` links pinned to each other on m + 2 legs, with one foot moved by a crank of 5 mm: one group of 4·m + 2 coordinates, 2·m + 3 links,
/// 3·m + 4 pins.
pub(crate) fn group<const LINKS: usize, const PAIRS: usize>(
    m: usize,
) -> Result<Assembly<LINKS, PAIRS, STATIONS>, Error> {
    let (crank, length) = (0.005, 0.2);
    let start = |k: usize| [length * k as f64, 0.3];
    let mut links = vec![link(0.1)?; 1 + m];
    let mut drawing: Vec<[f64; 3]> = (0..m).map(|k| [start(k)[0], start(k)[1], 0.0]).collect();
    // The pins of the chain, then a leg to each end and to each middle: its place on the chain, and the place of its foot.
    let mut pairs = Vec::new();
    for k in 1..m {
        pairs.push(pin(Marker::on(k, [length, 0.0]), Marker::on(k + 1, O)));
    }
    let mut legs = vec![(1, O, [-0.3, -0.15])];
    legs.extend((0..m).map(|k| (k + 1, [0.5 * length, -0.05], [0.06, -0.25])));
    legs.push((m, [length, 0.0], [0.1, -0.3]));
    for (number, (on, pin_at, foot)) in legs.into_iter().enumerate() {
        let leg = links.len();
        let [x, y] = start(on - 1);
        let foot_at = [x + pin_at[0] + foot[0], y + pin_at[1] + foot[1]];
        let (reach, psi) = (foot[0].hypot(foot[1]), (-foot[1]).atan2(-foot[0]));
        links.push(link(0.2)?);
        drawing.push([foot_at[0], foot_at[1], psi]);
        pairs.push(pin(Marker::on(leg, [reach, 0.0]), Marker::on(on, pin_at)));
        if number == 0 {
            let centre = [foot_at[0] - crank, foot_at[1]];
            drawing.insert(0, [centre[0], centre[1], 0.0]);
            pairs.insert(0, pin(Marker::ground(centre), Marker::on(0, O)));
            pairs.push(pin(Marker::on(0, [crank, 0.0]), Marker::on(leg, O)));
        } else {
            pairs.push(pin(Marker::ground(foot_at), Marker::on(leg, O)));
        }
    }
    assemble(&links, &pairs, &drawing, 0.0)
}

fn assemble<const LINKS: usize, const PAIRS: usize>(
    links: &[Link],
    pairs: &[Pair],
    drawing: &[[f64; 3]],
    phi: f64,
) -> Result<Assembly<LINKS, PAIRS, STATIONS>, Error> {
    let drawing: Vec<Pose> = drawing
        .iter()
        .map(|&[x, y, psi]| Pose { x, y, psi })
        .collect();
    Ok(Linkage::new(links, pairs, 0)?.assemble(Domain::Turn, phi, &drawing)?)
}
