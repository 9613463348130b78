//! The meaning of a table's words in double precision, by other formulas than the library's: basis functions instead of the power form, no floors.

use jred::number::Role;
use jred::table::Format;
use jred::{Phase, curves};

use super::rows::{Meaning, Plain, Rows};

/// Curves at one phase in machine units, with slopes per cell.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Exact {
    pub(crate) inertia: f64,
    pub(crate) inertia_slope: f64,
    pub(crate) load: f64,
    pub(crate) viscous: f64,
    pub(crate) coulomb: f64,
    pub(crate) reciprocal: f64,
}

/// The bits of the position in a cell that the fixed-point tick uses.
pub(crate) fn place_bits<F: Format>() -> u32 {
    match F::NAME {
        "spline" => !1,
        "cubic" => !0,
        "quadratic" => !0xffff,
        other => panic!("layout {other}"),
    }
}

impl<F: Plain> Rows<F> {
    /// All curves at `phase`, with the position rounded down to these bits.
    pub(crate) fn exact(&self, phase: Phase, bits: u32) -> Exact {
        let (cell, fraction) = phase.cell(self.cells);
        let u = f64::from(fraction & bits) / 4_294_967_296.0;
        let curve = |role: Role| {
            let column = self.column(role)?;
            Some(self.curve(role, cell as usize, column, u))
        };
        let of = |role, word: F::Word| word.value(role);
        let value = |role| curve(role).map_or(0.0, |[value, _]| value);
        let [inertia, inertia_slope] = curve(Role::Inertia).unwrap();
        Exact {
            inertia: inertia + of(Role::Inertia, self.constants.inertia),
            inertia_slope,
            load: value(Role::Load),
            viscous: value(Role::Viscous) + of(Role::Viscous, self.constants.viscous),
            coulomb: value(Role::Coulomb).abs() + of(Role::Coulomb, self.constants.coulomb),
            reciprocal: value(Role::Reciprocal),
        }
    }

    /// The column of a curve: those of the set in the order of their bits, after J.
    fn column(&self, role: Role) -> Option<usize> {
        let bits = [
            curves::LOAD,
            curves::VISCOUS,
            curves::COULOMB,
            curves::RECIPROCAL,
        ];
        let index = match role {
            Role::Inertia => return Some(0),
            Role::Load => 0,
            Role::Viscous => 1,
            Role::Coulomb => 2,
            Role::Reciprocal => 3,
        };
        let before = bits[..index].iter().filter(|bit| self.set & **bit != 0);
        (self.set & bits[index] != 0).then_some(1 + before.count())
    }

    /// Value and slope per cell.
    fn curve(&self, role: Role, cell: usize, column: usize, u: f64) -> [f64; 2] {
        let curves = 1 + (self.set & (curves::ALL | curves::RECIPROCAL)).count_ones() as usize;
        let word = |index: usize| self.words[index].value(role);
        let sum = |words: [f64; 4], weights: [f64; 4]| -> f64 {
            words
                .iter()
                .zip(weights)
                .map(|(word, weight)| word * weight)
                .sum()
        };
        if F::NAME == "spline" {
            let points = [0, 1, 2, 3].map(|row| word((cell + row) * curves + column));
            let v = 1.0 - u;
            let values = [
                v * v * v,
                4.0 - 6.0 * u * u + 3.0 * u * u * u,
                4.0 - 6.0 * v * v + 3.0 * v * v * v,
                u * u * u,
            ];
            let slopes = [
                -3.0 * v * v,
                9.0 * u * u - 12.0 * u,
                12.0 * v - 9.0 * v * v,
                3.0 * u * u,
            ];
            return [sum(points, values), sum(points, slopes)];
        }
        let (count, pitch) = match F::NAME {
            "cubic" => (4, 4 * curves),
            _ => (3, (3 * curves).div_ceil(4) * 4),
        };
        let x = u - if F::Word::FIXED { 0.5 } else { 0.0 };
        let words = [0, 1, 2, 3].map(|k| {
            let index = cell * pitch + column * count + k;
            if k < count { word(index) } else { 0.0 }
        });
        [
            sum(words, [1.0, x, x * x, x * x * x]),
            sum(words, [0.0, 1.0, 2.0 * x, 3.0 * x * x]),
        ]
    }
}
