//! Splines of 16 bits per point, against those of 32 bits.

use crate::support::rows::{Meaning, Rows};
use crate::support::{assert_near, budget, grid, scale_of};
use jred::number::Role;
use jred::{CurveSet, Domain, Q31, Scale, Spline, Spline16, curves};

use super::Smooth;

/// One, three, four and five curves: words that are half empty, and full ones.
const SETS: [CurveSet; 4] = [
    curves::INERTIA,
    curves::LOAD | curves::COULOMB,
    curves::ALL,
    curves::ALL | curves::RECIPROCAL,
];

fn scale() -> Scale {
    scale_of(1.0, 2.0, 1.0)
}

/// The roles of a row, in the order of their bits.
fn roles(set: CurveSet) -> Vec<Role> {
    let others = [
        (curves::LOAD, Role::Load),
        (curves::VISCOUS, Role::Viscous),
        (curves::COULOMB, Role::Coulomb),
        (curves::RECIPROCAL, Role::Reciprocal),
    ];
    let has = others.into_iter().filter(|(bit, _)| set & bit != 0);
    std::iter::once(Role::Inertia)
        .chain(has.map(|(_, role)| role))
        .collect()
}

/// The same curves in both widths.
struct Pair {
    wide: Rows<Spline<Q31>>,
    narrow: Rows<Spline16>,
}

impl Pair {
    fn of(domain: Domain, set: CurveSet, cells: u32) -> Self {
        let machine = Smooth(domain);
        Self {
            wide: Rows::of(&machine, set, cells, &scale()).unwrap(),
            narrow: Rows::of(&machine, set, cells, &scale()).unwrap(),
        }
    }

    fn gain(&self, role: Role) -> i32 {
        self.narrow.constants.gains[role as usize].into()
    }

    /// The points of one curve in units of 32 bits: those of 16 bits, and the exact ones.
    fn points(&self, role: Role) -> (Vec<i32>, Vec<i32>) {
        let roles = roles(self.wide.set);
        let column = roles.iter().position(|r| *r == role).unwrap();
        let narrow = self.narrow.words.chunks(roles.len().div_ceil(2));
        let half = |row: &[i32]| match column % 2 {
            0 => row[column / 2] << 16 >> 16,
            _ => row[column / 2] >> 16,
        };
        let wide = self.wide.words.chunks(roles.len());
        (
            narrow.map(|row| half(row) * self.gain(role)).collect(),
            wide.map(|row| row[column]).collect(),
        )
    }
}

fn domains() -> [Domain; 2] {
    [Domain::Turn, Domain::stroke(-0.4, 1.3).unwrap()]
}

/// Half a unit of 16 bits away from the exact point; a point of J, which is rounded together with others, two more.
#[test]
fn points_use_their_bits_and_are_rounded() {
    for (domain, set) in domains().into_iter().flat_map(|d| SETS.map(|s| (d, s))) {
        for cells in [32, 37, 250] {
            let pair = Pair::of(domain, set, cells);
            for role in roles(set) {
                let gain = pair.gain(role);
                let (found, exact) = pair.points(role);
                assert_eq!([found.len(), exact.len()], [cells as usize + 3; 2]);
                let most = exact.iter().map(|x| x.abs()).max().unwrap();
                assert!(most <= 32_767 * gain, "{role:?}: {most}, gain {gain}");
                assert!(most > 32_700 * (gain - 1), "{role:?}: {most}, gain {gain}");
                let units = if role == Role::Inertia { 5 } else { 1 };
                for (found, exact) in found.iter().zip(&exact) {
                    let error = 2 * (found - exact).abs();
                    assert!(error <= units * gain + 1, "{role:?}: {found}, {exact}");
                }
            }
        }
    }
}

/// The value is c₀ + 4c₁ + c₂ of points with an error of half a unit; no slope has weights above 9 in total.
#[test]
fn curves_are_off_by_what_their_points_are() {
    for (domain, set) in domains().into_iter().flat_map(|d| SETS.map(|s| (d, s))) {
        for cells in [32, 37, 250] {
            let pair = Pair::of(domain, set, cells);
            let (narrow, wide) = (pair.narrow.table(), pair.wide.table());
            let h = domain.span() / f64::from(cells);
            for (phase, _) in grid(domain, 7 * cells) {
                let [a, b] = [narrow.at(phase), wide.at(phase)];
                for (role, a, b, weight) in [
                    (Role::Inertia, a.inertia, b.inertia, 5.0 * 6.0),
                    (
                        Role::Inertia,
                        h * a.inertia_slope,
                        h * b.inertia_slope,
                        5.0 * 9.0,
                    ),
                    (Role::Load, a.load, b.load, 6.0),
                    (Role::Viscous, a.viscous, b.viscous, 6.0),
                    (Role::Coulomb, a.coulomb, b.coulomb, 6.0),
                ] {
                    let unit = pair.gain(role).value(role);
                    let bound = 0.5 * weight * unit + budget::Q31_READ[1];
                    assert_near("curve", a, b, bound);
                }
            }
        }
    }
}

/// ∫ Bᵢ′·Bⱼ′ du of the cubic B-splines at i and j, by |i − j|.
fn products() -> [f64; 4] {
    // The slopes of the four pieces; three Gauss points are exact for products of parabolas.
    let slopes = |u: f64| {
        [
            0.5 * u * u,
            0.5 * (1.0 + 2.0 * u - 3.0 * u * u),
            0.5 * (3.0 * u * u - 4.0 * u),
            -0.5 * (1.0 - u) * (1.0 - u),
        ]
    };
    let root = 0.5 * 0.6f64.sqrt();
    let places = [(0.5 - root, 5.0), (0.5, 8.0), (0.5 + root, 5.0)];
    [0, 1, 2, 3].map(|apart| {
        let product = |u| -> f64 {
            let slopes = slopes(u);
            (apart..4).map(|k| slopes[k] * slopes[k - apart]).sum()
        };
        places.map(|(u, w)| w / 18.0 * product(u)).iter().sum()
    })
}

/// Moving a point of J by a unit never reduces the mean square error of the slope, up to the small weight of the value.
#[test]
fn no_other_rounding_of_a_point_has_a_better_slope() {
    let products = products();
    for (set, cells) in SETS.into_iter().flat_map(|set| [(set, 64), (set, 250)]) {
        let pair = Pair::of(Domain::Turn, set, cells);
        let unit = f64::from(pair.gain(Role::Inertia));
        let (found, exact) = pair.points(Role::Inertia);
        let cells = cells as usize;
        assert_eq!(found[..3], found[cells..]);
        let errors: Vec<f64> = found
            .iter()
            .zip(&exact)
            .map(|(found, exact)| f64::from(found - exact) / unit)
            .collect();
        for k in 0..cells {
            let at = |k: usize| errors[k % cells];
            let gradient: f64 = (1..4)
                .map(|d| products[d] * (at(k + d) + at(k + cells - d)))
                .sum::<f64>()
                + products[0] * at(k);
            let least = 0.5 * products[0] + budget::ROUNDED_VALUE * at(k).abs().max(1.0);
            assert!(gradient.abs() <= least, "{k}: {gradient}, at most {least}");
        }
    }
}
