//! The joints that close a group, and the index of each block of them.

use jred::machine::{Joint, Marker, Wrench};
use jred_file::math;

use super::Block;
use super::twists::{Twists, direction, pivot};

/// Rates at which each variable opens the remaining joints.
pub(super) struct System {
    pub(super) variables: usize,
    pub(super) closures: Vec<Closure>,
}

/// One remaining joint.
pub(super) struct Closure {
    /// For each of its constraints, the rate at which each variable opens it.
    pub(super) rows: Vec<Vec<f64>>,
    /// Squared relative speeds of its bodies for each variable, including motion that the joint allows.
    pub(super) full: Vec<f64>,
    /// Whether it is a contact or a mesh.
    pub(super) contact: bool,
}

impl Closure {
    pub(super) fn new(joint: &Joint, held: bool, motion: &Twists, length: f64) -> Self {
        let variables = 0..motion.variables;
        let [first, second] = joint.bodies();
        let at = pivot(joint, motion.frames);
        let gap = |k: usize| {
            let (a, b) = (
                motion.velocity(first, at, k),
                motion.velocity(second, at, k),
            );
            let turn = motion.twist(second, k)[2] - motion.twist(first, k)[2];
            [b[0] - a[0], b[1] - a[1], turn * length]
        };
        let across = |marker: &Marker| {
            let [cos, sin] = direction(marker, motion.frames);
            [-sin, cos, 0.0]
        };
        let (x, y, turn) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
        let (kept, opens): (Vec<[f64; 3]>, [f64; 3]) = match joint {
            _ if held => (vec![x, y, turn], [1.0; 3]),
            Joint::Fixed(_) => (vec![x, y, turn], [1.0; 3]),
            Joint::Revolute(_) => (vec![x, y], [1.0, 1.0, 0.0]),
            Joint::Prismatic([guide, _]) => (vec![across(guide), turn], [1.0; 3]),
            Joint::PinInSlot([_, slot]) => (vec![across(slot)], [1.0, 1.0, 0.0]),
            Joint::Transmission(wrenches) => return Self::transmission(wrenches, motion),
        };
        let row = |part: &[f64; 3]| {
            let value = |k| gap(k).iter().zip(part).map(|(g, p)| g * p).sum();
            variables.clone().map(value).collect()
        };
        let square = |k: usize| gap(k).iter().zip(opens).map(|(g, o)| g * g * o).sum();
        Self {
            rows: kept.iter().map(row).collect(),
            full: variables.clone().map(square).collect(),
            contact: false,
        }
    }

    /// Power of one unit of the transmission's effort.
    fn transmission(wrenches: &[Wrench; 2], motion: &Twists) -> Self {
        let (mut row, mut full) = (Vec::new(), Vec::new());
        for k in 0..motion.variables {
            let (mut power, mut most) = (0.0, 0.0);
            for wrench in wrenches {
                let v = motion.velocity(wrench.body, wrench.point, k);
                let turn = motion.twist(wrench.body, k)[2];
                let [f_x, f_y] = wrench.force;
                power += f_x * v[0] + f_y * v[1] + wrench.moment * turn;
                most +=
                    math::hypot(f_x, f_y) * math::hypot(v[0], v[1]) + (wrench.moment * turn).abs();
            }
            row.push(power);
            full.push(most * most);
        }
        Self {
            rows: vec![row],
            full,
            contact: true,
        }
    }
}

impl System {
    /// q of a block, with the determinant's sign.
    pub(super) fn index(&self, block: &Block) -> f64 {
        let closures = || block.closures.iter().map(|&k| &self.closures[k]);
        let alone = block.variables.len() == 1;
        let size = |v: usize| -> f64 {
            let square = closures().map(|closure| {
                let rows = closure.rows.iter().map(|row| row[v] * row[v]);
                if alone { closure.full[v] } else { rows.sum() }
            });
            square.sum::<f64>().sqrt()
        };
        // Columns of length one: the determinant is the ratio.
        let sizes: Vec<f64> = block.variables.iter().map(|&v| size(v)).collect();
        let scaled = |row: &Vec<f64>| -> Vec<f64> {
            let cells = block.variables.iter().zip(&sizes);
            let cell = |(&v, size): (&usize, &f64)| if *size > 0.0 { row[v] / size } else { 0.0 };
            cells.map(cell).collect()
        };
        let rows: Vec<Vec<f64>> = closures().flat_map(|c| c.rows.iter().map(scaled)).collect();
        if rows.len() == block.variables.len() {
            determinant(rows)
        } else {
            0.0
        }
    }
}

/// By Gaussian elimination with row pivoting.
fn determinant(mut rows: Vec<Vec<f64>>) -> f64 {
    let mut product = 1.0;
    for k in 0..rows.len() {
        let size = |row: &Vec<f64>| row[k].abs();
        let rest = rows.iter().enumerate().skip(k);
        let best = rest.max_by(|a, b| size(a.1).total_cmp(&size(b.1)));
        let pivot = best.map_or(k, |(row, _)| row);
        if pivot != k {
            rows.swap(pivot, k);
            product = -product;
        }
        let (done, below) = rows.split_at_mut(k + 1);
        let Some(row) = done.last() else {
            return 0.0;
        };
        if row[k] == 0.0 {
            return 0.0;
        }
        product *= row[k];
        for other in below {
            let factor = other[k] / row[k];
            for (value, top) in other.iter_mut().zip(row).skip(k) {
                *value -= factor * top;
            }
        }
    }
    product
}
