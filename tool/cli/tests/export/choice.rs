//! Which layout is taken: one of the fastest on the core, as benches/ceilings.txt has them.

use serde_json::Value;

use super::export_of;
use crate::support::shipped;

fn chosen(file: &str, more: &[&str]) -> Value {
    let file = shipped(file);
    let more = [more, &["--format", "json"]].concat();
    export_of(&file, &more, None).ends(0).json()
}

/// The figures of the file, found anew.
fn ceiling(core: &str, name: &str) -> u64 {
    let text = include_str!("../../../../benches/ceilings.txt");
    let line = text
        .lines()
        .find(|line| line.starts_with(core) && line.contains(&format!("{name} ")));
    line.unwrap()
        .split_whitespace()
        .last()
        .unwrap()
        .parse()
        .unwrap()
}

/// A slider-crank without loads over a part of the turn gets a table, which takes fewer instructions than its closed form, and the form
/// if it is asked for, or for fewer bytes.
#[test]
fn a_bare_slider_crank_gets_the_faster_table() {
    let asked = ["--torque-error", "0.1 N m"];
    for core in ["m0", "m3", "m4f", "m7"] {
        let found = chosen(
            "shaking-feeder.toml",
            &[&asked[..], &["--core", core]].concat(),
        );
        let cost = |value: &Value| value["instructions"].as_u64();
        let alternatives = found["alternatives"].as_array().unwrap();
        let fastest = alternatives
            .iter()
            .filter(|other| other["meets"] == true && other["type"] == "f32")
            .filter_map(cost)
            .min()
            .unwrap();
        let taken = cost(&found).unwrap();
        assert!(
            taken <= fastest + fastest / 10,
            "{core}: {taken} of {fastest}"
        );
        assert_ne!(found["layout"], "slider-crank");
    }
    let m4f = chosen("shaking-feeder.toml", &asked);
    let layout = m4f["layout"].as_str().unwrap();
    assert_eq!(
        m4f["instructions"].as_u64().unwrap(),
        ceiling("cortex-m4", &format!("user-release-{layout}_f32_counts"))
    );
    for more in [&["--layout", "slider-crank"][..], &["--max-bytes", "200"]] {
        let found = chosen("shaking-feeder.toml", &[&asked[..], more].concat());
        assert_eq!(found["layout"], "slider-crank");
    }
}
