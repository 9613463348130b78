//! The type of a table in Rust.

use jred::harmonic::terms;
use jred::slider_crank::terms as crank;
use jred::{CurveSet, curves};

use crate::candidate::Candidate;
use crate::choice::LayoutName;
use crate::export::Export;

/// Bit of the set, its name in Rust.
const CURVES: [(CurveSet, &str); 6] = [
    (curves::LOAD, "LOAD"),
    (curves::VISCOUS, "VISCOUS"),
    (curves::COULOMB, "COULOMB"),
    (curves::RECIPROCAL, "RECIPROCAL"),
    (curves::CONSTANT_VISCOUS, "CONSTANT_VISCOUS"),
    (curves::CONSTANT_COULOMB, "CONSTANT_COULOMB"),
];

/// Bit of a term of harmonics, its name in Rust.
const TERMS: [(CurveSet, &str); 8] = [
    (terms::INERTIA_COS, "INERTIA_COS"),
    (terms::INERTIA_SIN, "INERTIA_SIN"),
    (terms::LOAD_COS, "LOAD_COS"),
    (terms::LOAD_SIN, "LOAD_SIN"),
    (terms::VISCOUS_COS, "VISCOUS_COS"),
    (terms::VISCOUS_SIN, "VISCOUS_SIN"),
    (terms::COULOMB_COS, "COULOMB_COS"),
    (terms::COULOMB_SIN, "COULOMB_SIN"),
];

/// Bit of a term of a slider-crank, its name in Rust.
const CRANK_TERMS: [(CurveSet, &str); 8] = [
    (crank::INERTIA_COS, "INERTIA_COS"),
    (crank::LOAD_SIN, "LOAD_SIN"),
    (crank::LOAD_COS, "LOAD_COS"),
    (crank::LOAD_CONSTANT, "LOAD_CONSTANT"),
    (crank::LOAD_ROD, "LOAD_ROD"),
    (crank::VISCOUS_SIN, "VISCOUS_SIN"),
    (crank::VISCOUS_COS, "VISCOUS_COS"),
    (crank::COULOMB_ROD, "COULOMB_ROD"),
];

/// The set as a constant expression in Rust.
fn rust_set(layout: LayoutName, set: CurveSet) -> String {
    let chosen = |names: &[(CurveSet, &str)], path: &str| -> Vec<String> {
        let names = names.iter().filter(|(bit, _)| set & bit != 0);
        names.map(|(_, name)| format!("{path}::{name}")).collect()
    };
    let mut names = chosen(&CURVES, "curves");
    let (terms, path) = match layout {
        LayoutName::SliderCrank => (CRANK_TERMS, "slider_crank::terms"),
        _ => (TERMS, "harmonic::terms"),
    };
    names.extend(chosen(&terms, path));
    if names.is_empty() {
        "curves::INERTIA".to_owned()
    } else {
        names.join(" | ")
    }
}

/// Format and set of curves as the arguments of a type in Rust.
fn rust_arguments(table: &Candidate) -> String {
    let format = table.layout.type_name(table.number);
    let set = rust_set(table.layout, table.curves());
    format!("{format}, {{ {set} }}")
}

/// The same with the crate's name before every name, for a file without imports.
pub(crate) fn full_rust_arguments(table: &Candidate) -> String {
    let mut text = format!("jred::{}", rust_arguments(table));
    for (name, full) in [
        ("<Q31>", "<jred::Q31>"),
        (" curves::", " jred::curves::"),
        (" slider_crank::", " jred::slider_crank::"),
        (" harmonic::", " jred::harmonic::"),
    ] {
        text = text.replace(name, full);
    }
    text
}

impl Export {
    /// Rust expression that loads the image, or the type of the pieces.
    pub fn rust(&self) -> String {
        let chosen = self.chosen();
        let arguments = rust_arguments(chosen);
        match self.whole() {
            Some(_) => format!("image.model::<{arguments}>()"),
            None => format!(
                "jred::Pieces<'static, {arguments}, {}>",
                chosen.tables.len()
            ),
        }
    }
}
