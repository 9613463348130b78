//! Properties and accuracy of a table in sentences: for the terminal, and as comments of source files.

use std::fmt::Write as _;

use jred::{CurveSet, curves};

use super::{effort_name, headroom};
use jred_export::{Candidate, Export, LayoutChoice, LayoutName, Number};
use jred_file::model::coordinate::Coordinate;
use jred_file::number::rounding::{bound, rounded, short};

/// Bit of the set, its word for a reader.
const CURVES: [(CurveSet, &str); 6] = [
    (curves::LOAD, "load"),
    (curves::VISCOUS, "viscous"),
    (curves::COULOMB, "coulomb"),
    (curves::RECIPROCAL, "reciprocal"),
    (curves::CONSTANT_VISCOUS, "constant viscous"),
    (curves::CONSTANT_COULOMB, "constant coulomb"),
];

/// Names and shares of the quantities in a fixed-point tick.
fn quantities(table: &Candidate, coordinate: Coordinate) -> [(&'static str, f32); 6] {
    let derivative = match coordinate {
        Coordinate::Angle => "J'·omega^2/2",
        Coordinate::Length => "m'·v^2/2",
    };
    let viscous = match coordinate {
        Coordinate::Angle => "b·omega",
        Coordinate::Length => "b·v",
    };
    [
        (coordinate.inertia(), table.usage(|u| u.inertia)),
        (derivative, table.usage(|u| u.velocity)),
        ("load", table.usage(|u| u.load)),
        (viscous, table.usage(|u| u.viscous)),
        ("c", table.usage(|u| u.coulomb)),
        ("sum", table.usage(|u| u.torque)),
    ]
}

/// Properties and accuracy of the table, for the terminal and for source comments.
pub(super) fn summary(export: &Export) -> String {
    let chosen = export.chosen();
    let coordinate = export.coordinate;
    let (effort, inertia) = (coordinate.effort_unit(), coordinate.inertia_unit());
    let (word, speed) = (effort_name(export.coordinate), coordinate.speed_unit());
    let ([v, a], acceleration) = match coordinate {
        Coordinate::Angle => (["omega", "alpha"], "rad/s^2"),
        Coordinate::Length => (["v", "a"], "m/s^2"),
    };
    let ticks = chosen.ticks();
    let mut names = vec![coordinate.inertia()];
    let has = CURVES.iter().filter(|(bit, _)| chosen.curves() & bit != 0);
    names.extend(has.map(|(_, name)| *name));
    let mut text = String::new();
    let _ = writeln!(text, "{}: reduced machine at the drive link", export.title);
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
        export.machine,
        if export.task.machine.is_some() {
            ""
        } else {
            " (of its title; --machine-id sets another)"
        }
    );
    if export.whole().is_some() {
        let _ = writeln!(text, "in Rust: {}", export.rust());
    } else {
        text += &pieces(export, chosen);
    }
    if chosen.layout == LayoutName::SliderCrank {
        text += &closed(export);
    }
    if let Some(left_out) = left_out(export) {
        let _ = writeln!(text, "{left_out}");
    }
    if export.by_direction {
        text += "loads by direction: the friction is the mean of both directions, half of their difference is in the load; at rest it is that half\n";
    }
    let allowed = export.task.torque_error.map_or(String::new(), |allowed| {
        format!(" of {} {effort} allowed", rounded(allowed))
    });
    let _ = writeln!(
        text,
        "{word} error reached {} {effort}{allowed}, at {} {}, for |{v}| <= {} {speed}, |{a}| <= {} {acceleration}",
        rounded(chosen.error()),
        rounded(coordinate.shown(chosen.curve_error().1)),
        coordinate.unit(),
        rounded(export.task.omega),
        rounded(export.task.alpha),
    );
    let _ = writeln!(
        text,
        "measured in ticks: {word} within {} {effort} ({} of the largest, {} {effort}), {a} within {} {acceleration}",
        rounded(ticks.torque),
        short(ticks.torque / ticks.peak_torque),
        rounded(ticks.peak_torque),
        rounded(ticks.acceleration),
    );
    text += &proof_text(export);
    if export.task.forward {
        text += match (chosen.number.is_fixed(), export.task.reciprocal) {
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
        let unused = unused
            .iter()
            .filter_map(|(name, usage)| headroom(*usage).map(|bits| format!("{name} {bits:.1}")));
        let unused: Vec<String> = unused.collect();
        let _ = writeln!(text, "unused bits: {}", unused.join(", "));
    }
    text
}

/// Parts of the drive train that are not in the table.
pub(super) fn left_out(export: &Export) -> Option<String> {
    let named: Vec<String> = export
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
fn closed(export: &Export) -> String {
    let core = export.task.core;
    let of = |layout| core.instructions(Number::F32, layout).unwrap_or_default();
    let table = match export.task.layout {
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
fn pieces(export: &Export, chosen: &Candidate) -> String {
    let mut text = format!(
        "in Rust: {} pieces, {}\n",
        chosen.tables.len(),
        export.rust()
    );
    let (coordinate, effort) = (export.coordinate, export.coordinate.effort_unit());
    for (number, table) in (1..).zip(&chosen.tables) {
        let [from, to] = table.range.map(|end| rounded(coordinate.shown(end)));
        let _ = writeln!(
            text,
            "piece {number}: {from} to {to} {}, {} {}, {} bytes of image, {} error {} {effort}",
            coordinate.unit(),
            table.found.cells,
            chosen.layout.counted(),
            table.bytes(),
            effort_name(export.coordinate),
            rounded(table.error),
        );
    }
    text
}

/// The proof of the error, if requested.
fn proof_text(export: &Export) -> String {
    let (coordinate, word) = (export.coordinate, effort_name(export.coordinate));
    let effort = coordinate.effort_unit();
    match export.proof() {
        None => String::new(),
        Some(Err(why)) => format!("not proven: {why}\n"),
        Some(Ok(proof)) => {
            let ticks = match proof.ticked {
                Some(ticked) => format!("ticks within {} {effort}", bound(ticked)),
                None => "the arithmetic of its ticks is not proven".to_owned(),
            };
            format!(
                "proven over every position: {word} error of the table within {} {effort}, largest near {} {}; {ticks}\n",
                bound(proof.bound),
                rounded(coordinate.shown(proof.worst)),
                coordinate.unit(),
            )
        }
    }
}

/// A message that the proven error exceeds the allowed one, with the position.
pub fn exceeded(export: &Export) -> String {
    let coordinate = export.coordinate;
    let effort = coordinate.effort_unit();
    match (export.proof(), export.task.torque_error) {
        (Some(Ok(proof)), Some(allowed)) => format!(
            "the proven {} error, {} {effort} near {} {}, is above the {} {effort} allowed",
            effort_name(export.coordinate),
            bound(proof.stated()),
            rounded(coordinate.shown(proof.worst)),
            coordinate.unit(),
            rounded(allowed)
        ),
        _ => String::new(),
    }
}
