//! Former faults, and a fixed number of random inputs each, the same in every run. `jred-fuzz` and `scripts/fuzz` try more.

#[path = "../../../tool/support/skip.rs"]
mod skip;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

#[cfg(target_os = "linux")]
use jred_fuzz::heavy;
use jred_fuzz::machine::Machines;
use jred_fuzz::{at, command, files, harness, mutate};
use rand::SeedableRng as _;
use rand::rngs::ChaCha8Rng;
use skip::skip;

const SEED: u64 = 0x0051;

/// Runs a harness over its corpus and `inputs` mutated seeds. At least 1/64 must be accepted, and some refused, or the test shows nothing: inputs
/// that are not read are never refused.
fn bounded(name: &str, inputs: u32) {
    let harness = harness::named(name).unwrap();
    let seeds = (harness.seeds)();
    for seed in seeds.iter().chain(&harness.corpus()) {
        (harness.run)(seed);
    }
    let mut rng = ChaCha8Rng::seed_from_u64(SEED);
    let understood = (0..inputs).filter(|_| (harness.run)(&mutate::mutated(&mut rng, &seeds)));
    let understood = understood.count();
    assert!(
        understood >= inputs as usize / 64 && understood < inputs as usize,
        "{understood} of {inputs}"
    );
}

/// Every folder of the corpus belongs to a harness, and every harness with `kept` has one.
#[test]
fn folders_of_the_corpus() {
    let folders = std::fs::read_dir(at("tests/fuzz/corpus")).unwrap();
    let folders = folders.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let folders: BTreeSet<String> = folders.collect();
    let kept = harness::ALL.iter().filter(|harness| harness.kept);
    let names = kept.map(|harness| harness.name).chain(["command"]);
    assert_eq!(folders, names.map(ToOwned::to_owned).collect());
    for harness in harness::ALL.iter().filter(|harness| harness.kept) {
        assert!(!harness.corpus().is_empty(), "{}", harness.name);
    }
}

#[test]
fn images() {
    bounded("image", 2000);
}

#[test]
fn plans() {
    bounded("plan", 2000);
}

#[test]
#[ignore = "more than five seconds of a processor"]
fn machines() {
    bounded("machine", 400);
}

#[test]
fn profiles() {
    bounded("profile", 100);
}

#[test]
fn catalogues() {
    bounded("catalogue", 2000);
}

#[test]
fn rows() {
    bounded("rows", 2000);
}

#[test]
fn arguments() {
    bounded("arguments", 2000);
}

#[test]
#[ignore = "more than five seconds of a processor"]
fn values_of_machines() {
    let machines = Machines::new(&files(&["machines"], ".toml"));
    let harness = harness::named("machine").unwrap();
    let mut rng = ChaCha8Rng::seed_from_u64(SEED);
    let understood = (0..60).filter(|_| (harness.run)(machines.mutated(&mut rng).as_bytes()));
    assert!(understood.count() >= 20);
}

/// The program `jred`, a neighbour of this test.
fn jred() -> Option<PathBuf> {
    let this = std::env::current_exe().unwrap();
    let jred = this.parent().and_then(Path::parent).unwrap().join("jred");
    if jred.exists() {
        return Some(jred);
    }
    skip("commands: the program jred is not built (cargo build -p jred-cli)");
    None
}

/// The largest inputs that commands accept, for those that take a second or two.
#[cfg(target_os = "linux")]
#[test]
#[ignore = "more than five seconds of a processor"]
fn heavy_inputs() {
    let Some(jred) = jred() else { return };
    let inputs = heavy::Inputs::write();
    for command in heavy::COMMANDS.into_iter().filter(|heavy| heavy.quick) {
        let taken = inputs.run(command, &jred);
        let taken = taken.unwrap_or_else(|what| panic!("{what}"));
        assert!(taken.memory > 0, "{command:?}: {taken:?}");
    }
    // Larger ones are refused by a message, not by the system.
    for (words, why) in [
        ("size press.toml --steps 200001", "16..=200000"),
        ("size press.toml --motors motors.csv", "drives are too many"),
        (
            "size press.toml --motors motors.csv --gearboxes drives/gearboxes.csv",
            "100000 rows",
        ),
        (
            "export press.toml --torque-error 1_N_m --max-cells 60000 --pieces 1deg,2deg,3deg,4deg,5deg,6deg,7deg,8deg,9deg",
            "are too many cells",
        ),
    ] {
        let command = heavy::Heavy {
            words,
            quick: true,
            code: 0,
        };
        let refused = inputs.run(command, &jred).unwrap_err();
        assert!(refused.contains("code: Some(2)"), "{refused}");
        assert!(refused.contains(why), "{refused}");
    }
}

/// Machine files through every command. The program `jred` is next to this test: cargo builds both.
#[test]
#[ignore = "more than five seconds of a processor"]
fn commands() {
    let Some(jred) = jred() else { return };
    let machines = Machines::new(&files(&["machines"], ".toml"));
    let mut rng = ChaCha8Rng::seed_from_u64(SEED);
    let mut codes = [0; 3];
    // The first line of a kept input is the command.
    for found in files(&["tests/fuzz/corpus/command"], ".toml") {
        let text = String::from_utf8(found).unwrap();
        let (command, machine) = text.split_once('\n').unwrap();
        let command = command.strip_prefix("# ").unwrap();
        command::run(command, &jred, machine)
            .unwrap_or_else(|what| panic!("{what}\nof\n{machine}"));
    }
    for _ in 0..40 {
        let text = machines.mutated(&mut rng);
        let code = command::run(command::any(&mut rng), &jred, &text)
            .unwrap_or_else(|what| panic!("{what}\nof\n{text}"));
        codes[code as usize] += 1;
    }
    assert!(codes[0] > 0 && codes[2] > 0, "{codes:?}");
}
