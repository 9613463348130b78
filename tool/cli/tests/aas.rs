//! `--format aas`: the submodel IDTA 02021-1-0 against names, kinds, semantic ids and cardinalities of the published template.

use std::process::Command;

use serde_json::Value;

use crate::support::{Folder, jred, near, shipped};

/// The published template (admin-shell-io/submodel-templates, Sizing of Power Drive Trains 1.0, CC BY 4.0): parent, idShort, modelType, semanticId,
/// cardinality. `TransformationMechanism`, which is not written, is left out.
const TEMPLATE: &str = include_str!("data/idta-02021.csv");

struct Row<'t> {
    parent: &'t str,
    name: &'t str,
    kind: &'t str,
    id: &'t str,
    cardinality: &'t str,
}

fn template() -> Vec<Row<'static>> {
    let rows = TEMPLATE.lines().skip(1);
    let row = |line: &'static str| {
        let cells: Vec<&str> = line.split(',').collect();
        let [parent, name, kind, id, cardinality] = cells[..] else {
            panic!("{line}")
        };
        Row {
            parent,
            name,
            kind,
            id,
            cardinality,
        }
    };
    rows.map(row).collect()
}

fn children(element: &Value) -> &[Value] {
    let of = |key: &str| element[key].as_array().map(Vec::as_slice);
    let found = of("submodelElements").or(of("statements"));
    // The value of a sentence is its text in languages.
    let value = of("value").filter(|value| value.iter().all(|item| item["modelType"].is_string()));
    found.or(value).unwrap_or_default()
}

/// An element without the number that tells equal ones apart.
fn name(element: &Value) -> &str {
    element["idShort"]
        .as_str()
        .unwrap()
        .trim_end_matches(|c: char| c.is_ascii_digit())
}

fn compare(parent: &str, elements: &[Value]) {
    let template = template();
    let own: Vec<&Row> = template.iter().filter(|row| row.parent == parent).collect();
    for element in elements {
        // The contact's name is of another submodel.
        if parent == "ContactInformation" {
            continue;
        }
        let named = own.iter().find(|row| row.name == name(element));
        let row = named.unwrap_or_else(|| panic!("{parent} has no {}", name(element)));
        assert_eq!(row.kind, element["modelType"], "{parent}.{}", row.name);
        assert_eq!(
            row.id, element["semanticId"]["keys"][0]["value"],
            "{parent}.{}",
            row.name
        );
        if element["valueType"] == "xs:double" && element["value"].is_string() {
            assert!(
                element["value"]
                    .as_str()
                    .unwrap()
                    .parse::<f64>()
                    .unwrap()
                    .is_finite()
            );
        }
        compare(row.name, children(element));
    }
    for row in own {
        let count = elements
            .iter()
            .filter(|element| name(element) == row.name)
            .count();
        match row.cardinality {
            "One" => assert_eq!(count, 1, "{parent}.{}", row.name),
            "OneToMany" => assert!(count >= 1, "{parent}.{}", row.name),
            "ZeroToOne" => assert!(count <= 1, "{parent}.{}", row.name),
            _ => {}
        }
    }
}

/// The property of this name anywhere in an element.
fn found(element: &Value, name: &str) -> Option<f64> {
    if element["idShort"] == name {
        return element["value"].as_str().and_then(|text| text.parse().ok());
    }
    children(element)
        .iter()
        .find_map(|child| found(child, name))
}

/// Where Python has aas-core3.0, that library reads and verifies the text, too.
fn verified(path: &std::path::Path) {
    let code = "import json, sys\ntry:\n import aas_core3.jsonization as j, aas_core3.verification as v\nexcept ImportError:\n sys.exit(0)\n\
                e = [str(e.path) + ': ' + e.cause for e in v.verify(j.environment_from_jsonable(json.load(open(sys.argv[1]))))]\nsys.exit('\\n'.join(e) or 0)";
    if let Ok(run) = Command::new("python3")
        .args(["-c", code])
        .arg(path)
        .output()
    {
        assert!(
            run.status.success(),
            "{}",
            String::from_utf8_lossy(&run.stderr)
        );
    }
}

#[test]
fn a_sizing_is_the_submodel_of_the_standard() {
    let press = shipped("press.toml");
    let run = jred([&"size", &press, &"--format", &"aas"]).ends(0);
    let folder = Folder::new();
    verified(&folder.file("press.json", &run.out));
    let shell = run.json();
    let [submodel] = shell["submodels"].as_array().unwrap().as_slice() else {
        panic!("one axis has one submodel")
    };
    compare("", children(submodel));
    let answer = jred([&"size", &press, &"--format", &"json"]).ends(0).json();
    let best = &answer["fit"][0];
    for (name, path) in [
        ("RmsOfMotorTorque", ["torque [N m]", "rms"]),
        ("RmsOfPower", ["power [W]", "rms"]),
        ("MassInertiaRatio", ["inertia ratio", "max"]),
    ] {
        let expected = best["duty"][path[0]][path[1]].as_f64().unwrap();
        near(name, found(submodel, name).unwrap(), expected, 1e-12);
    }
    let bill = answer["bill of materials"].as_array().unwrap();
    let text = submodel.to_string();
    for part in bill {
        assert!(text.contains(part["order"].as_str().unwrap()), "{part}");
    }
}

#[test]
fn a_project_has_a_submodel_for_each_axis() {
    let file = shipped("packing-line/project.toml");
    let run = jred([&"project", &file, &"--format", &"aas"]).ends(0);
    let folder = Folder::new();
    verified(&folder.file("line.json", &run.out));
    let shell = run.json();
    let submodels = shell["submodels"].as_array().unwrap();
    assert_eq!(submodels.len(), 4);
    let mut ids: Vec<String> = submodels
        .iter()
        .map(|submodel| submodel["id"].to_string())
        .collect();
    ids.sort();
    ids.dedup();
    assert_eq!(ids.len(), 4);
    for submodel in submodels {
        compare("", children(submodel));
    }
}

#[test]
fn a_front_has_no_submodel() {
    let press = shipped("press.toml");
    let run = jred([
        &"size",
        &press,
        &"--pareto",
        &"mass,energy",
        &"--format",
        &"aas",
    ])
    .ends(2);
    assert!(
        run.err.contains("--format aas describes one drive"),
        "{}",
        run.err
    );
}
