//! `examples/no_panic.rs` and `no_panic_axis.rs`, which link only if no panic can be reached, call everything that a tick can need.
//!
//! Trait implementations are not checked: operators of an angle are used in the program without a name, and those of a format or a number are part of
//! every tick.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// The layers used by firmware with a finished image.
const LAYERS: [&str; 4] = ["src/number", "src/curve", "src/tick", "src/axis"];

/// The type of `impl<…> Type<…> {` as the prefix of a path to its functions, without the block's own parameters: `Type`, or `Type::<f32>` if the
/// block is for that one only.
fn implemented(header: &str) -> Vec<String> {
    let rest = header.trim_start().strip_prefix("impl").unwrap();
    // `dynamics!` in src/tick/model.rs writes one block for both.
    if rest.contains("dynamics!") {
        return ["Model", "AnyModel"].map(ToOwned::to_owned).into();
    }
    let (parameters, rest) = match rest.strip_prefix('<') {
        Some(rest) => {
            let mut depth = 1;
            let end = rest.find(|c| {
                depth += i32::from(c == '<') - i32::from(c == '>');
                depth == 0
            });
            rest.split_at(end.unwrap() + 1)
        }
        None => ("", rest),
    };
    // `quantity!` in src/number/quantity.rs writes the same for a speed, an acceleration and torques.
    let name = rest.trim_end_matches([' ', '{']).trim();
    let name = &name.replace("$name", "Speed");
    if name.contains(" for ") {
        return Vec::new();
    }
    let bare = name.split('<').next().unwrap_or(name);
    vec![if parameters.is_empty() && !name.ends_with("<'_>") {
        name.replace('<', "::<")
    } else {
        bare.to_owned()
    }]
}

/// The public functions of a file, as `Type::name` or `name`; without crate-private ones.
fn public(text: &str, into: &mut BTreeSet<String>) {
    let (mut types, mut head) = (Vec::new(), String::new());
    for line in text.lines() {
        let code = line.trim_start();
        // A long one takes two lines.
        let begins = code.starts_with("impl") && code.ends_with(['{', '>']);
        if begins || !head.is_empty() {
            head.push(' ');
            head.push_str(code);
            if head.ends_with('{') {
                types = implemented(head.trim_start());
                head.clear();
            }
        } else if line == "}" {
            types.clear();
        }
        let Some(rest) = code
            .strip_prefix("pub fn ")
            .or_else(|| code.strip_prefix("pub const fn "))
        else {
            continue;
        };
        let name = rest.split(['(', '<']).next().unwrap();
        if line.starts_with("pub") {
            into.insert(name.to_owned());
        } else {
            assert!(!types.is_empty(), "{line}: of no type that is found");
            into.extend(types.iter().map(|of| format!("{of}::{name}")));
        }
    }
}

pub(crate) fn public_of(folder: &Path, into: &mut BTreeSet<String>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            public_of(&path, into);
        } else {
            public(&fs::read_to_string(path).unwrap(), into);
        }
    }
}

/// Whether a program calls the function by its path, with or without parameters: `Type::name(…)`, `Type::name::<…>(…)`.
fn calls(program: &str, function: &str) -> bool {
    program.match_indices(function).any(|(at, _)| {
        let before = program[..at].chars().next_back().unwrap_or(' ');
        let after = &program[at + function.len()..];
        !before.is_alphanumeric()
            && !"_:.".contains(before)
            && (after.starts_with('(') || after.starts_with("::<"))
    })
}

#[test]
fn functions_are_found() {
    let mut found = BTreeSet::new();
    public(
        "impl<R: Real> A<R> {\n    pub fn b(\n    pub(crate) fn c()\n}\nimpl A<f32> {\n    pub const fn d()\n}\npub fn e<T>()",
        &mut found,
    );
    assert_eq!(found, ["A::b", "A::<f32>::d", "e"].map(String::from).into());
    assert!(calls("A::b(1)", "A::b") && calls("f(A::b::<2>(1))", "A::b"));
    for other in ["A::bc(1)", "BA::b(1)", "x::b(1)", "A::b"] {
        assert!(!calls(other, "A::b"), "{other}");
    }
    assert!(!calls("A::e(1); x.e(2)", "e"));
}

#[test]
fn the_gate_calls_all_that_a_tick_can_need() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut all = BTreeSet::new();
    for layer in LAYERS {
        public_of(&root.join(layer), &mut all);
    }
    for known in [
        "Model::torque",
        "Pieces::acceleration",
        "Phase::from_counts",
        "Image::new",
    ] {
        assert!(all.contains(known), "{known} is found");
    }
    let gate = ["no_panic", "no_panic_axis"]
        .map(|name| fs::read_to_string(root.join(format!("examples/{name}.rs"))).unwrap())
        .concat();
    // "//! - `A`, `B::c`: the reason": a function, or a type with all of its functions.
    let lines = gate.lines().filter_map(|line| line.strip_prefix("//! - `"));
    let excepted: BTreeSet<_> = lines
        .flat_map(|line| {
            let (names, reason) = line.split_once("`: ").expect("names and a reason");
            assert!(reason.len() > 10, "{names}: why not?");
            names.split("`, `")
        })
        .collect();
    let is = |function: &str, name: &str| {
        function == name
            || function
                .strip_prefix(name)
                .is_some_and(|rest| rest.starts_with("::"))
    };
    let program: String = gate
        .lines()
        .filter_map(|line| line.split("//").next())
        .flat_map(|line| [line.trim(), "\n"])
        .collect();
    let mut wrong = Vec::new();
    for function in &all {
        let called = calls(&program, function);
        let stands = excepted.iter().any(|name| is(function, name));
        if !called && !stands {
            wrong.push(format!("{function} is not called, and no reason is given"));
        }
        if called && stands {
            wrong.push(format!(
                "{function} is called, but a reason is given why not"
            ));
        }
    }
    for name in excepted {
        if !all.iter().any(|function| is(function, name)) {
            wrong.push(format!("{name} is excepted, but there is no such function"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
