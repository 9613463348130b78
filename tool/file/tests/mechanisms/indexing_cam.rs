//! `type = "indexing-cam"`.

use std::f64::consts::TAU;

use jred::machine::Mechanism as _;
use jred::machine::Reducible as _;

use super::{close, machine, parse, refuses_edits};

const DOC: &str = include_str!("../../../../docs/mechanisms/indexing-cam.md");

fn example() -> &'static str {
    let (_, rest) = DOC.split_once("\n```toml\n").unwrap();
    rest.split("\n```").next().unwrap()
}

/// J of a disc and of eight parts, by hand; ψ′ in the middle of an index is C_v·h/β.
#[test]
fn the_table_is_read_in_si_units() {
    let file = machine("indexing-cam.toml");
    let cam = file.machine.mechanism();
    assert_eq!(cam.kind(), "indexing-cam");
    assert_eq!(cam.link_names(), ["cam", "table"]);
    assert_eq!(
        cam.joint_names(),
        ["cam bearing", "table bearing", "cam and followers"]
    );
    let table = 95.0 * 0.8 * 0.8 / 8.0 + 8.0 * (0.02 + 4.5 * 0.32 * 0.32);
    close(cam.links()[1].inertia(), table);
    close(cam.links()[0].inertia(), 0.02);
    let (h, beta) = (TAU / 8.0, TAU / 3.0);
    let most = 4.0 * std::f64::consts::PI / (4.0 + std::f64::consts::PI) * h / beta;
    let middle = file.machine.reduction(0.5 * beta).unwrap();
    close(middle.inertia, 0.02 + table * most * most);
    close(middle.coulomb, 1.5 + 12.0 * most);
    let dwell = file.machine.reduction(4.0).unwrap();
    close(dwell.inertia, 0.02);
    close(dwell.coulomb, 1.5);
    let angle = |phi| cam.frames(phi).unwrap()[1].psi.value;
    close(angle(3.0), h);
    close(angle(3.0 + TAU), 2.0 * h);
}

#[test]
fn the_documented_example_is_read() {
    let file = parse(example()).unwrap();
    let facts = file.machine.mechanism().facts();
    assert_eq!(
        facts[0].text,
        "45 deg of the table in 120 deg of the cam shaft, then 240 deg of dwell"
    );
    // C_v·h/β = 1.7596·0.375 and C_a·h/β² = 5.528·0.17905.
    assert!(
        facts[1].text.starts_with("0.6599 (speed"),
        "{}",
        facts[1].text
    );
    assert!(facts[1].text.contains(" 0.9898 (acc"), "{}", facts[1].text);
    let back = example().replace("stops = 8", "stops = 8\nreverses = true\nindexes = 2");
    let file = parse(&back).unwrap();
    let angle = |phi| file.machine.mechanism().frames(phi).unwrap()[1].psi.value;
    close(angle(TAU - 0.1), -2.0 * TAU / 8.0);
}

#[test]
fn wrong_entries_are_refused_with_their_cure() {
    let edits = r#"
        stops = 8 => stops = 0 => must be between 1 and 360
        stops = 8 => => `stops` in [mechanism] is missing
        "120 deg" => "0 deg" => greater than zero
        "120 deg" => "370 deg" => more than the 360 deg of the cam shaft
        stops = 8 => stops = 8\nindexes = 4 => is 120 deg, more than the 90 deg of the cam shaft
        "modified-sine" => "sine" => did you mean "simple-sine"?
        law = "modified-sine" => law = "sine-constant-cosine"\nsine = "80 %"\ncosine = "30 %" =>
            `sine`, `constant` and `cosine` in [mechanism] add up to 110 % of the duration
        law = "modified-sine" => law = "sine-constant-cosine" => add up to 0 % of the duration
        cam = { inertia = "0.02 kg m^2" } => cam = { inertia = "0.02 kg m^2", com = ["1 mm", "0 mm"] } =>
            its centre of mass is on its axis
    "#;
    refuses_edits(example(), edits);
}
