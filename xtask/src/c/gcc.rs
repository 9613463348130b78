//! C compilers and their options, for the host and for each core.

use std::path::PathBuf;
use std::process::Command;

use crate::cores::Core;
use crate::run::{program, target_dir};

/// A library for C, as cargo names it.
pub(crate) const LIBRARY: &str = "libjred_ffi.a";

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Language {
    C,
    Cpp,
}

/// Warnings that the headers must not cause.
const WARNINGS: [&str; 6] = [
    "-Wall",
    "-Wextra",
    "-Wconversion",
    "-Wshadow",
    "-Wcast-qual",
    "-Werror",
];

const INCLUDE: [&str; 2] = ["-Iffi/include", "-Iffi/c99"];

/// Folder of the library for `core` and its programs.
pub(crate) fn folder(core: &Core) -> PathBuf {
    folder_of(core.name)
}

/// Folder of programs for the host.
pub(crate) fn host_folder() -> PathBuf {
    folder_of("host")
}

fn folder_of(name: &str) -> PathBuf {
    target_dir().join("c").join(name)
}

/// The host's compiler; warnings are errors.
pub(crate) fn host(language: Language) -> Command {
    let (name, standard) = match language {
        Language::C => ("cc", "-std=c99"),
        Language::Cpp => ("c++", "-std=c++11"),
    };
    let mut gcc = program(name);
    gcc.args([standard, "-Wpedantic", "-O2"]).args(WARNINGS);
    if language == Language::C {
        gcc.arg("-Wstrict-prototypes");
    }
    gcc.args(INCLUDE);
    gcc
}

/// The compiler for `core`, with newlib and the memory map of the emulated boards; warnings are errors.
pub(crate) fn cross(core: &Core, language: Language) -> Command {
    let mut gcc = program(match language {
        Language::C => "arm-none-eabi-gcc",
        Language::Cpp => "arm-none-eabi-g++",
    });
    gcc.args(match language {
        Language::C => ["-std=c99"].as_slice(),
        Language::Cpp => &["-std=c++11", "-fno-exceptions", "-fno-rtti"],
    });
    gcc.args(core.gcc)
        .arg("-mthumb")
        .args(WARNINGS)
        .args(INCLUDE)
        .args(["-ffunction-sections", "-fdata-sections", "-nostartfiles"])
        .args(["--specs=nano.specs", "--specs=rdimon.specs"])
        .args(["-L.", "-Tffi/examples/cortex-m.ld"])
        .args(["-Wl,--gc-sections", "-Wl,-z,noexecstack"]);
    if core.name == "cortex-m0" {
        gcc.arg("-Wl,--defsym=__small_ram=1");
    }
    gcc
}
