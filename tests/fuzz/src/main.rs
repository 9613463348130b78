//! `jred-fuzz HARNESS [--seconds N] [--seed N]`: inputs of one harness, or with `command` machine files through every command, for any time. Compiled
//! with `--cfg fuzzing` it is a program for libFuzzer, which `scripts/fuzz` runs.
#![cfg_attr(not(fuzzing), forbid(unsafe_code))]
#![cfg_attr(fuzzing, no_main)]
#![cfg_attr(
    fuzzing,
    allow(unsafe_code, reason = "libFuzzer calls a function by its C name")
)]

#[cfg(fuzzing)]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    static HARNESS: std::sync::OnceLock<jred_fuzz::harness::Harness> = std::sync::OnceLock::new();
    let harness = HARNESS.get_or_init(|| {
        let name = std::env::var("JRED_HARNESS").expect("JRED_HARNESS names a harness");
        jred_fuzz::harness::named(&name).expect("JRED_HARNESS names a harness")
    });
    (harness.run)(bytes);
});

#[cfg(not(fuzzing))]
fn main() -> std::process::ExitCode {
    use clap::Parser as _;
    program::run(&program::Options::parse())
}

#[cfg(not(fuzzing))]
mod program {
    use std::panic::{AssertUnwindSafe, catch_unwind};
    use std::path::{Path, PathBuf};
    use std::process::ExitCode;
    use std::time::{Duration, Instant};

    use jred_fuzz::heavy::{COMMANDS, Inputs};
    use jred_fuzz::machine::Machines;
    use jred_fuzz::{command, files, harness, mutate};
    use rand::SeedableRng as _;
    use rand::rngs::ChaCha8Rng;

    /// Runs random inputs.
    #[derive(clap::Parser)]
    pub(super) struct Options {
        /// Harness: image, plan, machine, values (of machine files), profile, catalogue, rows, arguments, command, or heavy (the largest inputs of
        /// each command).
        harness: String,
        /// How long.
        #[arg(long, default_value_t = 60)]
        seconds: u64,
        /// Seed of the random numbers.
        #[arg(long, default_value_t = 1)]
        seed: u64,
        /// The program `jred`, for `command` and `heavy`.
        #[arg(long, default_value = "target/release/jred")]
        jred: PathBuf,
        /// Instead of running: write what inputs are made from into this folder, for a fuzzer to begin with.
        #[arg(long)]
        seeds: Option<PathBuf>,
        /// Folder for what is found.
        #[arg(long, default_value = "target/fuzz")]
        found: PathBuf,
    }

    pub(super) fn run(options: &Options) -> ExitCode {
        let mut rng = ChaCha8Rng::seed_from_u64(options.seed);
        let machines = || Machines::new(&files(&["machines"], ".toml"));
        let end = Instant::now() + Duration::from_secs(options.seconds);
        let (mut inputs, mut understood, mut found, mut slowest) =
            (0u64, 0u64, 0u64, Duration::ZERO);
        let mut tally = |input: &[u8], what: Result<bool, String>, took: Duration| {
            inputs += 1;
            understood += u64::from(what == Ok(true));
            if took > slowest {
                slowest = took;
                keep(
                    &options.found,
                    &format!("{}-slowest", options.harness),
                    input,
                );
            }
            if let Err(what) = what {
                found += 1;
                keep(
                    &options.found,
                    &format!("{}-{}-{inputs}", options.harness, options.seed),
                    input,
                );
                println!("input {inputs}: {what}");
            }
        };
        let jred = std::path::absolute(&options.jred).unwrap_or_else(|_| options.jred.clone());
        let commands = ["command", "heavy"].contains(&options.harness.as_str());
        if commands && !jred.is_file() {
            eprintln!(
                "there is no program {}: cargo build --release, or name it with --jred",
                jred.display()
            );
            return ExitCode::from(2);
        }
        if options.harness == "heavy" {
            return heavy(&jred);
        }
        if options.harness == "command" || options.harness == "values" {
            let machines = machines();
            let machine = harness::named("machine").expect("a harness");
            while Instant::now() < end {
                let text = machines.mutated(&mut rng);
                let start = Instant::now();
                let what = if options.harness == "command" {
                    command::run(command::any(&mut rng), &jred, &text).map(|code| code < 2)
                } else {
                    caught(machine.run, text.as_bytes())
                };
                tally(text.as_bytes(), what, start.elapsed());
            }
        } else if let Some(harness) = harness::named(&options.harness) {
            let seeds = (harness.seeds)();
            if let Some(folder) = &options.seeds {
                for (k, seed) in seeds.iter().enumerate() {
                    keep(folder, &format!("seed-{k}"), seed);
                }
                return ExitCode::SUCCESS;
            }
            while Instant::now() < end {
                let input = mutate::mutated(&mut rng, &seeds);
                let start = Instant::now();
                let what = caught(harness.run, &input);
                tally(&input, what, start.elapsed());
            }
        } else {
            eprintln!("there is no harness {:?}", options.harness);
            return ExitCode::from(2);
        }
        println!(
            "{}: {inputs} inputs, {understood} understood, {found} found, the slowest took {slowest:.1?}",
            options.harness
        );
        ExitCode::from(u8::from(found > 0))
    }

    /// A table of the resources that every command uses at its largest input.
    fn heavy(jred: &Path) -> ExitCode {
        let inputs = Inputs::write();
        let mut found = 0u8;
        for command in COMMANDS {
            match inputs.run(command, jred) {
                Ok(taken) => println!(
                    "{:>4} MB {:>6.1} s  {}",
                    taken.memory,
                    taken.time.as_secs_f64(),
                    command.words
                ),
                Err(what) => {
                    found = 1;
                    println!("{what}");
                }
            }
        }
        ExitCode::from(found)
    }

    /// A panic as text.
    fn caught(run: fn(&[u8]) -> bool, input: &[u8]) -> Result<bool, String> {
        catch_unwind(AssertUnwindSafe(|| run(input)))
            .map_err(|_| "it panicked, see above".to_owned())
    }

    fn keep(folder: &Path, name: &str, input: &[u8]) {
        std::fs::create_dir_all(folder).expect("a folder for what is found");
        std::fs::write(folder.join(name), input).expect("a place for what is found");
    }
}
