//! The measured cost of a torque on a core: instructions from an encoder's count.

use crate::choice::{LayoutName, Number};

/// The ceilings of `cargo xtask perf --user`, which no call exceeds for any arguments.
const CEILINGS: &str = include_str!("../../../benches/ceilings.txt");

/// Divisor of the fastest table's instructions: a table with fewer bytes may take a tenth more.
const AS_FAST: u32 = 10;

jred_file::words! {
    /// Core that a table is chosen for.
    pub enum Core default M4f {
        /// Cortex-M0 and M0+.
        M0 = "m0",
        /// Cortex-M3.
        M3 = "m3",
        /// Cortex-M4F, and M33 with single precision.
        M4f = "m4f",
        /// Cortex-M7.
        M7 = "m7",
    }
}

impl Core {
    /// Name in a sentence.
    pub const fn title(self) -> &'static str {
        match self {
            Self::M0 => "Cortex-M0",
            Self::M3 => "Cortex-M3",
            Self::M4f => "Cortex-M4F",
            Self::M7 => "Cortex-M7",
        }
    }

    /// Its name among the ceilings, and the name of the program compiled for it.
    const fn measured(self) -> [&'static str; 2] {
        match self {
            Self::M0 => ["cortex-m0", "user-release"],
            Self::M3 => ["cortex-m3", "user-release"],
            Self::M4f => ["cortex-m4", "user-release"],
            Self::M7 => ["cortex-m7", "user-release-tuned"],
        }
    }

    /// Largest number of instructions from an encoder's count to a torque, with a load, a curve of Coulomb friction and a constant viscous one;
    /// `None` for harmonics, whose ticks depend on their number.
    pub fn instructions(self, number: Number, layout: LayoutName) -> Option<u32> {
        let model = match (number, layout) {
            (_, LayoutName::Harmonic) => return None,
            (_, LayoutName::SliderCrank) => "crank_f32",
            (Number::F32, LayoutName::Cubic) => "cubic_f32",
            (Number::F32, LayoutName::Quadratic) => "quadratic_f32",
            (Number::F32, _) => "spline_f32",
            (Number::I32, LayoutName::Cubic) => "cubic_q31",
            (Number::I32, LayoutName::Quadratic) => "quadratic_q31",
            (Number::I32, LayoutName::Spline16) => "spline16_q31",
            (Number::I32, _) => "spline_q31",
            (Number::I16, _) => "rows_q15",
        };
        let [core, program] = self.measured();
        let name = format!("{program}-{model}_counts");
        CEILINGS.lines().find_map(|line| {
            let mut words = line.split_whitespace();
            let is_it = words.next() == Some(core) && words.next() == Some(name.as_str());
            is_it.then(|| words.next()?.parse().ok())?
        })
    }
}

/// The largest cost that counts as equal to the fastest.
pub(crate) fn as_fast(fastest: u32) -> u32 {
    fastest.saturating_add(fastest / AS_FAST)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every core has a figure for every table chosen by it, and no fixed-point table is slower than the spline in software's single precision.
    #[test]
    fn every_table_has_a_cost() {
        for core in [Core::M0, Core::M3, Core::M4f, Core::M7] {
            for number in Number::ALL {
                for layout in number.layouts() {
                    let cost = core.instructions(number, *layout);
                    assert_eq!(
                        cost.is_none(),
                        *layout == LayoutName::Harmonic,
                        "{core:?} {layout:?}"
                    );
                }
            }
        }
        let m0 = |number, layout| Core::M0.instructions(number, layout).unwrap();
        assert!(m0(Number::I16, LayoutName::Rows) * 20 < m0(Number::F32, LayoutName::Cubic));
    }
}
