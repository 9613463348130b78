//! The data of a kernel: a table image, linear tables, or the machine's dimensions.

use std::f64::consts::TAU;

use anyhow::{Result, anyhow};
use jred::Scale;
use jred::number::Bases;

use crate::image::{Layout, image};
use crate::kernels::Kernel;
use crate::machine::{
    ALPHA, COULOMB, Curves, Example, MASS, OMEGA, RADIUS, RATIO, VISCOUS, WEIGHT,
};
use crate::number::{Number, acceleration_base};

/// The data of a kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Data {
    /// A table image of the library.
    Jred {
        layout: Layout,
        set: jred::CurveSet,
        cells: u32,
    },
    /// J, ½·J′, G in linear tables, single precision.
    LinearF32,
    /// The same, per-unit, with 31 fraction bits.
    LinearQ31,
    /// The same, with 15 fraction bits, two numbers per word.
    LinearQ15,
    /// r, λ, m, J₀, m·g, b, c.
    Dimensions,
}

/// Cells of the linear tables.
const CELLS: u32 = 256;

/// Data for the on-target program.
pub(crate) struct Words {
    pub(crate) words: Vec<u32>,
    /// Number of table bytes among them.
    pub(crate) table_bytes: usize,
}

/// The scale of `kernel` in fixed point: slightly above the largest speed and acceleration, a tenth above the torque for them; adapted to the cells
/// of a table of the library.
pub(crate) fn scale(kernel: &Kernel, example: &Example) -> Result<Scale> {
    const MARGIN: f64 = 1.02;
    let mut torque = 0.0f64;
    for k in 0..720 {
        let phi = f64::from(k) / 720.0 * TAU;
        let curves = example.curves(phi);
        let moving = curves.inertia * ALPHA + curves.half_slope.abs() * OMEGA * OMEGA;
        torque = torque.max(moving + curves.load.abs() + VISCOUS * OMEGA + COULOMB);
    }
    let torque = 1.1 * torque;
    let inertia = torque / (ALPHA * MARGIN);
    let bases = Bases {
        torque: torque as f32,
        speed: (OMEGA * MARGIN) as f32,
        inertia: inertia as f32,
    };
    let scale = Scale::new(bases).map_err(|e| anyhow!("{e}"))?;
    Ok(match kernel.data {
        Data::Jred { cells, layout, .. } if layout != Layout::Rows16 => scale.for_cells(cells, TAU),
        _ => scale,
    })
}

/// The data of `kernel`.
pub(crate) fn words(kernel: &Kernel, example: &Example, scale: &Scale) -> Result<Words> {
    match (kernel.data, kernel.number) {
        (Data::Jred { layout, set, cells }, number) => {
            image(example, number, layout, set, cells, scale)
        }
        (Data::Dimensions, _) => {
            let dimensions = [
                RADIUS,
                RATIO,
                MASS,
                example.rotating,
                WEIGHT,
                VISCOUS,
                COULOMB,
            ];
            let words = dimensions.map(|d| (d as f32).to_bits()).to_vec();
            Ok(Words {
                words,
                table_bytes: 0,
            })
        }
        (Data::LinearF32, _) => Ok(linear(
            example,
            scale,
            kernel.number,
            &[f64::from(CELLS) / TAU],
        )),
        (Data::LinearQ31, _) => Ok(linear(example, scale, kernel.number, &[])),
        (Data::LinearQ15, _) => {
            let mut linear = linear(example, scale, kernel.number, &[]);
            let pack = |pair: &[u32]| pair[0] & 0xffff | pair.get(1).unwrap_or(&0) << 16;
            // N, b and c keep their words; a table begins on a new word.
            let tables = linear.words.split_off(3);
            let packed = tables
                .chunks(CELLS as usize + 1)
                .flat_map(|table| table.chunks(2).map(pack));
            linear.words.extend(packed);
            linear.table_bytes /= 2;
            Ok(linear)
        }
    }
}

/// One of the curves.
type Curve = fn(&Curves) -> f64;

/// N, `more`, b, c, then the three tables of N + 1 values.
fn linear(example: &Example, scale: &Scale, number: Number, more: &[f64]) -> Words {
    let [torque, speed] = [scale.torque(), scale.speed()].map(f64::from);
    let inertia = f64::from(scale.inertia());
    let mut words = vec![CELLS];
    words.extend(more.iter().map(|value| (*value as f32).to_bits()));
    words.push(number.word(VISCOUS, torque / speed));
    words.push(number.word(COULOMB, torque));
    let tables: [(Curve, f64); 3] = [
        (|c| c.inertia, inertia),
        (|c| c.half_slope, torque / (speed * speed)),
        (|c| c.load, torque),
    ];
    for (curve, base) in tables {
        words.extend((0..=CELLS).map(|k| {
            let phi = f64::from(k) / f64::from(CELLS) * TAU;
            number.word(curve(&example.curves(phi)), base)
        }));
    }
    debug_assert!(ALPHA < acceleration_base(scale));
    Words {
        table_bytes: 3 * (CELLS as usize + 1) * 4,
        words,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernels::KERNELS;

    #[test]
    fn every_kernel_has_data_that_fits_the_program() {
        let example = Example::new();
        for kernel in KERNELS {
            let scale = scale(kernel, &example).unwrap();
            let data = words(kernel, &example, &scale).unwrap();
            let points = 3 * crate::machine::motions().len();
            assert!(
                data.words.len() + points + 2 <= 2700,
                "{}: {}",
                kernel.name,
                data.words.len()
            );
            assert!(data.table_bytes <= 4 * data.words.len());
        }
    }
}
