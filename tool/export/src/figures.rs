//! Properties and accuracy of a table in sentences: for the terminal, and as comments of source files.

use std::fmt::Write as _;

use jred::harmonic::terms;
use jred::slider_crank::terms as crank;
use jred::{CurveSet, curves};

use crate::candidate::Candidate;
use crate::choice::{LayoutChoice, LayoutName, Number};
use crate::export::Export;
use jred_file::model::coordinate::Coordinate;
use jred_file::number::rounding::{rounded, short};

/// Bit of the set, its word for a reader, its name in Rust.
const CURVES: [(CurveSet, &str, &str); 6] = [
    (curves::LOAD, "load", "LOAD"),
    (curves::VISCOUS, "viscous", "VISCOUS"),
    (curves::COULOMB, "coulomb", "COULOMB"),
    (curves::RECIPROCAL, "reciprocal", "RECIPROCAL"),
    (
        curves::CONSTANT_VISCOUS,
        "constant viscous",
        "CONSTANT_VISCOUS",
    ),
    (
        curves::CONSTANT_COULOMB,
        "constant coulomb",
        "CONSTANT_COULOMB",
    ),
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
    let names = CURVES.iter().filter(|(bit, _, _)| set & bit != 0);
    let mut names: Vec<String> = names
        .map(|(_, _, name)| format!("curves::{name}"))
        .collect();
    let (terms, path) = match layout {
        LayoutName::SliderCrank => (CRANK_TERMS, "slider_crank::terms"),
        _ => (TERMS, "harmonic::terms"),
    };
    let terms = terms.iter().filter(|(bit, _)| set & bit != 0);
    names.extend(terms.map(|(_, name)| format!("{path}::{name}")));
    if names.is_empty() {
        "curves::INERTIA".to_owned()
    } else {
        names.join(" | ")
    }
}

/// Format and set of curves as the arguments of a type in Rust.
pub(crate) fn rust_arguments(table: &Candidate) -> String {
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

/// Rust expression that loads the image.
pub(crate) fn rust_call(table: &Candidate) -> String {
    format!("image.model::<{}>()", rust_arguments(table))
}

/// The type of the pieces in Rust.
pub(crate) fn rust_type(pieces: &Candidate) -> String {
    let (arguments, count) = (rust_arguments(pieces), pieces.tables.len());
    format!("jred::Pieces<'static, {arguments}, {count}>")
}

/// The part of a number range that is left, in bits.
pub(crate) fn headroom(usage: f32) -> Option<f64> {
    (usage > 0.0).then(|| -f64::from(usage).log2())
}

/// Names and shares of the quantities in a fixed-point tick.
fn quantities(table: &Candidate, coordinate: Coordinate) -> [(&'static str, f32); 6] {
    let derivative = coordinate.pick("J'·omega^2/2", "m'·v^2/2");
    let viscous = coordinate.pick("b·omega", "b·v");
    [
        (coordinate.inertia(), table.usage(|u| u.inertia)),
        (derivative, table.usage(|u| u.velocity)),
        ("load", table.usage(|u| u.load)),
        (viscous, table.usage(|u| u.viscous)),
        ("c", table.usage(|u| u.coulomb)),
        ("sum", table.usage(|u| u.torque)),
    ]
}

impl Export {
    pub(crate) fn effort(&self) -> &'static str {
        self.coordinate.vocabulary().torque.word
    }

    /// Properties and accuracy of the table, for the terminal and for source comments.
    pub fn summary(&self) -> String {
        let chosen = self.chosen();
        let coordinate = self.coordinate;
        let (effort, inertia) = (coordinate.effort_unit(), coordinate.inertia_unit());
        let (word, speed) = (self.effort(), coordinate.speed_unit());
        let ([v, a], acceleration) =
            coordinate.pick((["omega", "alpha"], "rad/s^2"), (["v", "a"], "m/s^2"));
        let ticks = chosen.ticks();
        let mut names = vec![coordinate.inertia()];
        let has = CURVES
            .iter()
            .filter(|(bit, _, _)| chosen.curves() & bit != 0);
        names.extend(has.map(|(_, name, _)| *name));
        let mut text = String::new();
        let _ = writeln!(text, "{}: reduced machine at the drive link", self.title);
        let _ = writeln!(
            text,
            "{}, layout {}, {} {}, curves: {}; {} bytes of rows, {} bytes of image",
            chosen.number.name(),
            chosen.layout.name(),
            chosen.cells(),
            chosen.layout.counted(),
            names.join(", "),
            chosen.row_bytes(),
            chosen.bytes()
        );
        let _ = writeln!(
            text,
            "machine 0x{:08x}{}",
            self.machine,
            if self.task.machine.is_some() {
                ""
            } else {
                " (of its title; --machine-id sets another)"
            }
        );
        if self.whole().is_some() {
            let _ = writeln!(text, "in Rust: {}", rust_call(chosen));
        } else {
            text += &self.pieces(chosen);
        }
        if chosen.layout == LayoutName::SliderCrank {
            text += &self.closed();
        }
        if let Some(left_out) = self.left_out() {
            let _ = writeln!(text, "{left_out}");
        }
        if self.by_direction {
            text += "loads by direction: the friction is the mean of both directions, half of their difference is in the load; at rest it is that half\n";
        }
        let allowed = self.task.torque_error.map_or(String::new(), |allowed| {
            format!(" of {} {effort} allowed", rounded(allowed))
        });
        let _ = writeln!(
            text,
            "{word} error reached {} {effort}{allowed}, at {} {}, for |{v}| <= {} {speed}, |{a}| <= {} {acceleration}",
            rounded(chosen.error()),
            rounded(coordinate.shown(chosen.curve_error().1)),
            coordinate.unit(),
            rounded(self.task.omega),
            rounded(self.task.alpha),
        );
        let _ = writeln!(
            text,
            "measured in ticks: {word} within {} {effort} ({} of the largest, {} {effort}), {a} within {} {acceleration}",
            rounded(ticks.torque),
            short(ticks.torque / ticks.peak_torque),
            rounded(ticks.peak_torque),
            rounded(ticks.acceleration),
        );
        text += &self.proof_text();
        if self.task.forward {
            text += match (chosen.number.is_fixed(), self.task.reciprocal) {
                (true, true) => "forward dynamics: by the curve of 1/J, without a division\n",
                (true, false) => {
                    "forward dynamics: divides by J; --reciprocal auto adds a curve of 1/J instead\n"
                }
                (false, _) => "forward dynamics: divides by J, in single precision\n",
            };
        }
        if chosen.number.is_fixed() {
            let scale = chosen.scale();
            let _ = writeln!(
                text,
                "1.0 stands for: {word} {} {effort}, speed {} {speed}, inertia {} {inertia}, acceleration {} {acceleration}",
                rounded(scale.torque().into()),
                rounded(scale.speed().into()),
                rounded(scale.inertia().into()),
                rounded(scale.acceleration().into()),
            );
            let unused = quantities(chosen, coordinate);
            let unused = unused.iter().filter_map(|(name, usage)| {
                headroom(*usage).map(|bits| format!("{name} {bits:.1}"))
            });
            let unused: Vec<String> = unused.collect();
            let _ = writeln!(text, "unused bits: {}", unused.join(", "));
        }
        text
    }

    /// Parts of the drive train that are not in the table.
    pub(crate) fn left_out(&self) -> Option<String> {
        let named: Vec<String> = self
            .branches
            .iter()
            .map(|name| format!("\"{name}\""))
            .collect();
        let [first, rest @ ..] = named.as_slice() else {
            return None;
        };
        let branches = match rest {
            [] => format!("branch {first}"),
            _ => format!("branches {first}, {}", rest.join(", ")),
        };
        Some(format!(
            "not in the table: losses and friction of the {branches} of the drive train, which change sides with their own power; their inertia is in it"
        ))
    }

    /// The cost of a closed form, and how to get a table.
    fn closed(&self) -> String {
        let core = self.task.core;
        let of = |layout| core.instructions(Number::F32, layout).unwrap_or_default();
        let table = match self.task.layout {
            LayoutChoice::Auto => "; --layout spline, cubic or quadratic asks for a table",
            _ => "",
        };
        format!(
            "no table: needs jred's feature micromath\n\
             instructions at most on a {}: closed form {}, cubic {}, spline {}{table}\n",
            core.title(),
            of(LayoutName::SliderCrank),
            of(LayoutName::Cubic),
            of(LayoutName::Spline),
        )
    }

    /// The ranges of the pieces, and the size of each.
    fn pieces(&self, chosen: &Candidate) -> String {
        let mut text = format!(
            "in Rust: {} pieces, {}\n",
            chosen.tables.len(),
            rust_type(chosen)
        );
        let (coordinate, effort) = (self.coordinate, self.coordinate.effort_unit());
        for (number, table) in (1..).zip(&chosen.tables) {
            let [from, to] = table.range.map(|end| rounded(coordinate.shown(end)));
            let _ = writeln!(
                text,
                "piece {number}: {from} to {to} {}, {} {}, {} bytes of image, {} error {} {effort}",
                coordinate.unit(),
                table.found.cells,
                chosen.layout.counted(),
                table.bytes(),
                self.effort(),
                rounded(table.error),
            );
        }
        text
    }

    /// The number type and layout that were chosen.
    pub fn kind(&self) -> (Number, LayoutName) {
        let chosen = self.chosen();
        (chosen.number, chosen.layout)
    }
}
