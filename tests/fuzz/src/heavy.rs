//! The heaviest inputs that each command accepts, and the memory limit for them.

use std::fmt::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Memory limit of a command (MB): resident, and data and heap requested from the system.
pub const CEILING: u64 = 500;

/// Limits of the processor time (s) of a quick command and a slow one: far above normal use, and far below an unbounded search.
const SECONDS: [u32; 2] = [60, 900];

/// A command with its heaviest input.
#[derive(Clone, Copy, Debug)]
pub struct Heavy {
    /// Its words, `_` for a space within one. Machine files are those of `machines/`, or those of [`Inputs::write`].
    pub words: &'static str,
    /// Whether it takes a second or two and runs with every test; `jred-fuzz heavy` runs all.
    pub quick: bool,
    /// The expected exit code.
    pub code: i32,
}

/// The commands. Others are bounded by their machine file, of at most 1 MiB.
pub const COMMANDS: [Heavy; 32] = [
    quick("size press.toml --steps 200000"),
    quick("size press.toml --steps 64 --catalogue drives --format csv"),
    quick("size press.toml --steps 64 --motors motors.csv --direct-only"),
    quick("ratio press.toml --steps 200000"),
    quick("check excavator-bucket.toml"),
    quick("steady slow-steady.toml --torque 699.706_N_m --delta 0.00163033"),
    quick("gentlest slow-gentlest.toml --ends zero --drive sgm7a-25a+npt025mf-4"),
    quick("fastest slow-fastest.toml --torque 44.6344_N_m --motor-speed 10148.7_rpm").violated(),
    slow("size excavator-bucket.toml --motion best"),
    slow("reduce press.toml --positions 1000000"),
    slow("reduce press.toml --positions 1000000 --format csv"),
    slow("reduce press.toml --positions 1000000 --format json"),
    slow("reduce press.toml --positions 256410 --points --speed 60_rpm --format csv"),
    slow("size press.toml --steps 200000 --explain"),
    slow("size press.toml --steps 200000 --explain --format json"),
    slow("size press.toml --steps 200000 --all --format json"),
    slow("size press.toml --steps 200000 --all --format csv"),
    slow("size press.toml --steps 200000 --report OUT"),
    slow("size press.toml --steps 64 --catalogue drives --pareto power,energy"),
    slow("sensitivity press.toml --steps 200000"),
    slow("sensitivity hoist.toml"),
    slow("sensitivity excavator-bucket.toml"),
    slow("sensitivity press.toml --steps 100000 --format json"),
    slow("split --ratio 500 --stages 4 --pinion 0.2_kg_cm^2 --points 10000"),
    slow("simulate long.toml --report OUT"),
    slow("tolerance press.toml --tolerance slider.mass=5% --samples 20000 --out OUT"),
    slow("vary press.toml --vary slider.mass=50,60kg --steps 200000"),
    slow("bus hoist.toml hoist.toml --steps 200000").violated(),
    slow("export press.toml --torque-error 1e-9_N_m --max-cells 65535 --format c --out OUT")
        .violated(),
    slow("export press.toml --max-bytes 100000000 --max-cells 65535 --format json --out OUT"),
    slow("export scotch-yoke.toml --torque-error 1e-9_N_m --max-cells 65535 --layout harmonic")
        .violated(),
    slow("export press.toml --torque-error 1e-6_N_m --max-cells 65535 --pieces auto --format rust")
        .violated(),
];

const fn quick(words: &'static str) -> Heavy {
    Heavy {
        words,
        quick: true,
        code: 0,
    }
}

const fn slow(words: &'static str) -> Heavy {
    Heavy {
        quick: false,
        ..quick(words)
    }
}

impl Heavy {
    /// It ends with 1: a rule is violated, or a torque error not reached.
    const fn violated(self) -> Self {
        Self { code: 1, ..self }
    }
}

/// A folder of inputs.
#[derive(Debug)]
pub struct Inputs(tempfile::TempDir);

/// Resources used by a command.
#[derive(Clone, Copy, Debug)]
pub struct Taken {
    /// Its exit code; `None`: it was killed.
    pub code: Option<i32>,
    /// Peak resident memory (MB), as last read before the end.
    pub memory: u64,
    /// Its duration.
    pub time: Duration,
}

impl Inputs {
    /// Writes machine files, catalogues at their limits, and a long simulation.
    ///
    /// # Panics
    /// A file cannot be written.
    pub fn write() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        let machines = ["machines", "tests/fuzz/heavy"]
            .map(|name| std::fs::read_dir(crate::at(name)).unwrap());
        for entry in machines.into_iter().flatten() {
            let path = entry.unwrap().path();
            if path.is_file() {
                std::fs::copy(&path, at(path.file_name().unwrap().to_str().unwrap())).unwrap();
            }
        }
        let press = std::fs::read_to_string(at("press.toml")).unwrap();
        std::fs::write(at("long.toml"), long(&press)).unwrap();
        std::fs::create_dir(at("drives")).unwrap();
        // 1413 motors, with each of as many gearboxes and without: just below two million drives.
        std::fs::write(at("drives/motors.csv"), motors(1413)).unwrap();
        std::fs::write(at("drives/gearboxes.csv"), gearboxes(1413)).unwrap();
        std::fs::write(at("motors.csv"), motors(99_000)).unwrap();
        Self(folder)
    }

    /// Runs a command with data limited to the ceiling.
    ///
    /// # Errors
    /// The fault in how it ended.
    ///
    /// # Panics
    /// It cannot be started.
    pub fn run(&self, heavy: Heavy, jred: &Path) -> Result<Taken, String> {
        let at = |name: &str| self.0.path().join(name);
        // The rows of a study need a file that does not exist yet.
        let _ = std::fs::remove_file(at("OUT"));
        // In kibibytes.
        let limit = format!(
            "ulimit -d {} && ulimit -t {} && exec \"$@\"",
            CEILING * 1_000_000 / 1024,
            SECONDS[usize::from(!heavy.quick)]
        );
        let start = Instant::now();
        let mut child = Command::new("sh")
            .args(["-c", &limit, "sh"])
            .arg(jred)
            .args(heavy.words.split(' ').map(|word| word.replace('_', " ")))
            .current_dir(self.0.path())
            .env("RAYON_NUM_THREADS", "2")
            .stdout(Stdio::null())
            .stderr(std::fs::File::create(at("stderr")).unwrap())
            .spawn()
            .unwrap();
        let mut memory = 0;
        let code = loop {
            memory = resident(child.id()).max(memory);
            match child.try_wait().unwrap() {
                Some(status) => break status.code(),
                None => std::thread::sleep(Duration::from_millis(2)),
            }
        };
        let taken = Taken {
            code,
            memory,
            time: start.elapsed(),
        };
        if code == Some(heavy.code) && memory <= CEILING {
            return Ok(taken);
        }
        let said = std::fs::read_to_string(at("stderr")).unwrap_or_default();
        Err(format!(
            "jred {}: {taken:?}, but exit code {} within {CEILING} MB and the processor time is expected\n{said}",
            heavy.words, heavy.code
        ))
    }
}

/// Peak resident memory of a process so far (MB); zero if the system does not report it.
fn resident(process: u32) -> u64 {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|line| line.trim().strip_suffix(" kB")?.parse::<u64>().ok());
    kilobytes.unwrap_or(0) * 1024 / 1_000_000
}

/// The press, simulated for the largest accepted number of rows.
fn long(press: &str) -> String {
    let head = press.split("[simulation]").next().unwrap_or_default();
    format!(
        "{head}[simulation]\nstart_angle = \"0 deg\"\nstart_speed = \"60 rpm\"\nduration = \"10 s\"\n\
         output_step = \"0.1 ms\"\ntorque = \"100 N m\"\n"
    )
}

fn motors(count: u32) -> String {
    let columns = "key,maker,model,rated_torque [N m],rated_speed [rpm],peak_torque [N m],rotor_inertia [kg cm^2],source\n";
    let mut table = columns.to_owned();
    for k in 0..count {
        let (torque, inertia) = (1 + k % 40, 1 + k % 90);
        let _ = writeln!(
            table,
            "m{k},A,B,{torque},3000,{},{inertia},none",
            3 * torque
        );
    }
    table
}

fn gearboxes(count: u32) -> String {
    let columns = "key,maker,model,ratio,rated_output_torque [N m],peak_output_torque [N m],rated_input_speed [rpm],max_input_speed [rpm],input_inertia [kg cm^2],efficiency [%],source\n";
    let mut table = columns.to_owned();
    for k in 0..count {
        let (ratio, torque) = (2 + k % 50, 50 + k % 60);
        let _ = writeln!(
            table,
            "g{k},A,B,{ratio},{torque},{},3000,7000,0.5,97,none",
            2 * torque
        );
    }
    table
}
