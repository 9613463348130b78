//! The folders of `src/` are layers: each uses those before it only, as DESIGN.md draws them; so do the packages of the tool.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// Names of no layer: `math` is the door to libm.
const OUTSIDE: [&str; 2] = ["math", "sealed"];

/// Each layer, and those that it may use.
const LAYERS: [(&str, &[&str]); 8] = [
    ("number", &[]),
    ("curve", &["number"]),
    ("machine", &["number"]),
    ("friction", &["number", "machine"]),
    ("mechanism", &["number", "machine"]),
    ("tick", &["number", "curve"]),
    ("axis", &["number", "curve", "tick"]),
    (
        "tabulate",
        &["number", "curve", "machine", "mechanism", "tick"],
    ),
];

/// The text of all files of a folder, without comments.
fn sources(folder: &Path, into: &mut String) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, into);
        } else if path.extension().is_some_and(|e| e == "rs") {
            *into += &without_comments(&path);
        }
    }
}

fn without_comments(file: &Path) -> String {
    let text = fs::read_to_string(file).unwrap();
    let lines = text
        .lines()
        .map(|line| line.split("//").next().unwrap_or_default());
    lines.flat_map(|line| [line, "\n"]).collect()
}

/// The names in `{A, b::C, d::{E}}` or in `A::…`, those of the first level only.
fn names(text: &str) -> BTreeSet<&str> {
    let mut found = BTreeSet::new();
    let (mut depth, mut expected) = (0, true);
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let word = rest
            .find(|c: char| !c.is_alphanumeric() && c != '_')
            .unwrap_or(rest.len());
        match first {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' => expected = depth == 1,
            _ if word > 0 => {
                if expected {
                    found.insert(&rest[..word]);
                }
                expected = false;
            }
            _ => {}
        }
        if depth == 0 && word == 0 && first != ':' || depth == 0 && word > 0 {
            break;
        }
        rest = &rest[word.max(first.len_utf8())..];
    }
    found
}

#[test]
fn names_of_imports() {
    assert_eq!(
        names("{a::B, C, d::{E, F}, g};"),
        ["C", "a", "d", "g"].into()
    );
    assert_eq!(names("a::b(c)"), ["a"].into());
}

#[test]
fn a_layer_uses_those_before_it_only() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let folders = fs::read_dir(&root)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let folders = folders.filter(|path| path.is_dir());
    let folders: BTreeSet<_> = folders
        .map(|path| path.file_name().unwrap().to_string_lossy().into_owned())
        .collect();
    let layers: BTreeSet<_> = LAYERS
        .iter()
        .map(|(layer, _)| (*layer).to_owned())
        .collect();
    assert_eq!(folders, layers, "a folder without a place among the layers");

    // `crate::Name` is of the layer that src/lib.rs re-exports it from.
    let library = fs::read_to_string(root.join("lib.rs")).unwrap();
    // The sum of the layers' errors is the last layer's.
    let mut owner = BTreeMap::from([("error", "tabulate")]);
    for (layer, _) in LAYERS {
        owner.insert(layer, layer);
        for exports in library.split(&format!("use {layer}::")).skip(1) {
            let exports = exports.split(';').next().unwrap_or_default();
            let words = exports.split(|c: char| !c.is_alphanumeric() && c != '_');
            owner.extend(words.map(|name| (name, layer)));
        }
    }
    let mut upward = Vec::new();
    let mut used_layers = BTreeSet::new();
    for (layer, below) in LAYERS {
        let mut text = String::new();
        sources(&root.join(layer), &mut text);
        // Names in a macro are for its user.
        let text = text.replace("$crate::", "");
        for used in text.split("crate::").skip(1).flat_map(names) {
            let Some(other) = owner.get(used) else {
                assert!(
                    OUTSIDE.contains(&used),
                    "{layer} uses {used}, which is of no layer"
                );
                continue;
            };
            used_layers.insert((layer, *other));
            if *other != layer && !below.contains(other) {
                upward.push(format!("{layer} uses {used} of {other}"));
            }
        }
    }
    assert!(upward.is_empty(), "{}", upward.join("\n"));
    // Imports are really found.
    assert!(used_layers.contains(&("tabulate", "machine")));
    assert!(used_layers.contains(&("mechanism", "number")));
}

/// The packages of the tool, and the modules of each in the order of its data: each uses those before it only.
const TOOL: [(&str, &[&str]); 8] = [
    (
        "enclosure",
        &[
            "interval",
            "series",
            "taylor_form",
            "link_frame",
            "matrix",
            "error",
            "equation",
            "closure",
            "curves",
            "difference",
            "tick",
            "proof",
        ],
    ),
    (
        "file",
        &[
            "plain", "math", "number", "units", "text", "model", "argument", "keys", "read",
        ],
    ),
    (
        "analysis",
        &[
            "duty", "contact", "reduce", "warnings", "inspect", "simulate", "steady", "identify",
            "check", "checked",
        ],
    ),
    (
        "export",
        &[
            "name",
            "place",
            "enclose",
            "choice",
            "failure",
            "cost",
            "task",
            "directions",
            "reference",
            "ticks",
            "proof_result",
            "candidate",
            "search",
            "harmonic",
            "slider_crank",
            "pieces",
            "fault",
            "export",
            "proof",
            "rust_type",
            "form",
            "structured_text",
            "plcopen",
            "wide_table",
            "function_block",
            "block_test",
            "plc",
            "cam",
            "cia402",
            "plan",
            "c_source",
        ],
    ),
    (
        "sizing",
        &[
            "threads",
            "cell",
            "catalogue",
            "motor",
            "cycle",
            "thermal",
            "bus",
            "judge",
            "select",
            "study",
            "explain",
            "meter",
            "settings",
        ],
    ),
    (
        "motion",
        &[
            "memo",
            "skyline",
            "balance",
            "path_dynamics",
            "moves",
            "trace",
            "collocation",
            "fastest",
            "gentlest",
            "co_design",
            "drive_simulation",
            "contact",
            "plan",
        ],
    ),
    (
        "report",
        &[
            "units", "table", "answer", "list", "schemas", "plot", "drawing", "page",
        ],
    ),
    (
        "cli",
        &[
            "browser", "busy", "output", "terminal", "options", "rows", "commands", "embedded",
        ],
    ),
];

#[test]
fn no_crate_of_ours_holds_unsafe_code() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let tools = fs::read_dir(root.join("tool")).unwrap();
    let packages = tools.map(|entry| entry.unwrap().path());
    let others = [
        "",
        "xtask",
        "examples/log",
        "examples/bits",
        "examples/closed_loop",
        "examples/template",
        "tests/fuzz",
    ];
    let others = others.map(|name| root.join(name));
    // `ffi`, the boundary to C, is made of names for the linker and of pointers.
    let mut seen = 0;
    for package in packages.chain(others) {
        for name in ["lib.rs", "main.rs"] {
            let file = package.join("src").join(name);
            if file.is_file() {
                let text = fs::read_to_string(&file).unwrap();
                // With an attribute of its own where libFuzzer calls it by a C name.
                assert!(text.contains("forbid(unsafe_code)"), "{file:?}");
                seen += 1;
            }
        }
    }
    assert_eq!(seen, 17);
}

#[test]
fn a_module_of_the_tool_uses_those_before_it_only() {
    let tool = Path::new(env!("CARGO_MANIFEST_DIR")).join("tool");
    // The library's own package is published without the tool.
    if !tool.exists() {
        return;
    }
    let mut upward = Vec::new();
    for (package, order) in TOOL {
        let root = tool.join(package).join("src");
        let entries = fs::read_dir(&root).unwrap();
        let paths = entries.map(|entry| entry.unwrap().path());
        let modules: BTreeSet<_> = paths
            .map(|path| path.file_stem().unwrap().to_string_lossy().into_owned())
            .filter(|name| name != "lib" && name != "main")
            .collect();
        let known: BTreeSet<_> = order.iter().map(|name| (*name).to_owned()).collect();
        assert_eq!(modules, known, "{package}: a module without a place");
        for (place, module) in order.iter().enumerate() {
            let mut text = String::new();
            let file = root.join(module).with_extension("rs");
            if file.exists() {
                text += &without_comments(&file);
            }
            if root.join(module).exists() {
                sources(&root.join(module), &mut text);
            }
            for used in text.split("crate::").skip(1).flat_map(names) {
                if order.iter().skip(place + 1).any(|later| *later == used) {
                    upward.push(format!("{package}: {module} uses {used}"));
                }
            }
        }
    }
    assert!(upward.is_empty(), "{}", upward.join("\n"));
}
