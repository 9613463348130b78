//! Programs in C and C++, which print what examples in Rust print.

use std::process::Command;

use anyhow::{Context, Result};

use super::gcc::{LIBRARY, Language, cross, folder, host, host_folder};
use crate::cores::Core;
use crate::expected;
use crate::run::{done, program, qemu, target_dir, text, workspace};

struct Program {
    source: &'static str,
    language: Language,
    name: &'static str,
    /// The example in Rust whose output it has; without one its exit code counts.
    example: Option<&'static str>,
}

const PROGRAMS: [Program; 9] = [
    Program {
        source: "ffi/examples/press.c",
        language: Language::C,
        name: "press",
        example: Some("01_tick"),
    },
    Program {
        source: "ffi/examples/press.cpp",
        language: Language::Cpp,
        name: "press_cpp",
        example: Some("01_tick"),
    },
    Program {
        source: "ffi/examples/plan.c",
        language: Language::C,
        name: "plan",
        example: Some("09_plan"),
    },
    Program {
        source: "ffi/examples/plan.cpp",
        language: Language::Cpp,
        name: "plan_cpp",
        example: Some("09_plan"),
    },
    Program {
        source: "ffi/examples/axis.c",
        language: Language::C,
        name: "axis",
        example: Some("07_axis"),
    },
    Program {
        source: "ffi/tests/both.c",
        language: Language::C,
        name: "both",
        example: None,
    },
    Program {
        source: "ffi/tests/classes.cpp",
        language: Language::Cpp,
        name: "classes",
        example: None,
    },
    // Images of no model, of which it checks that each is refused.
    Program {
        source: "ffi/tests/refused.c",
        language: Language::C,
        name: "refused",
        example: None,
    },
    // A table exchanged in mid-tick, by an interrupt.
    Program {
        source: "ffi/tests/exchange.c",
        language: Language::C,
        name: "exchange",
        example: None,
    },
];

impl Program {
    fn check(&self, run: &mut Command, on: &str) -> Result<()> {
        let on = format!("{on}, {}", self.name);
        let Some(example) = self.example else {
            return done(run).context(on);
        };
        let output = text(run).with_context(|| on.clone())?;
        expected::compare(example, &output, &on)
    }
}

/// Compiles and checks the programs on the host.
pub(crate) fn on_host() -> Result<()> {
    done(workspace("build").args(["--quiet", "--package", "jred-ffi"]))?;
    let library = target_dir().join("debug").join(LIBRARY);
    let folder = host_folder();
    std::fs::create_dir_all(&folder)?;
    for made in &PROGRAMS {
        let mut gcc = host(made.language);
        gcc.arg(made.source)
            .arg(&library)
            .args(["-lm", "-lpthread", "-ldl", "-o"]);
        done(gcc.arg(folder.join(made.name)))?;
    }
    for made in &PROGRAMS {
        made.check(&mut program(folder.join(made.name)), "host")?;
    }
    Ok(())
}

/// Compiles the programs for `core` with its library, and checks them in QEMU.
pub(crate) fn on(core: &Core) -> Result<()> {
    let folder = folder(core);
    let startup = folder.join("startup.o");
    let mut gcc = cross(core, Language::C);
    gcc.args(["-O2", "-c", "ffi/examples/startup.c", "-o"]);
    done(gcc.arg(&startup))?;
    for made in &PROGRAMS {
        let mut gcc = cross(core, made.language);
        gcc.args(["-Os", made.source])
            .arg(&startup)
            .arg(folder.join(LIBRARY))
            .arg("-o");
        done(gcc.arg(folder.join(made.name)))?;
    }
    for made in &PROGRAMS {
        made.check(&mut qemu(core, &folder.join(made.name)), core.name)?;
    }
    Ok(())
}
