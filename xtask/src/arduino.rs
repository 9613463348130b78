//! `cargo xtask arduino`: the library as a folder that the Arduino IDE and PlatformIO find.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use clap::Args;

use crate::cores::{CORES, Core, firmware};
use crate::expected;
use crate::run::{done, program, qemu, root, target_dir, text, workspace};

/// Makes the library for Arduino and PlatformIO: headers, a sketch, and a library for each core, with every set of curves.
///
/// Copy the folder into the `libraries` of Arduino, or into `lib` of a PlatformIO project.
#[derive(Args)]
pub(crate) struct Options {
    /// The folder; target/arduino/jred without it.
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// Only check it, with few sets of curves: compile the sketch as Arduino does, and run it on every core in QEMU.
    #[arg(long, conflicts_with = "out")]
    check: bool,
}

/// A precompiled library. The specification of Arduino libraries names its folder: `{build.mcu}`, and below it `{build.fpu}-{build.float-abi}`, without
/// which the first one serves.
struct Precompiled {
    folder: String,
    core: &'static Core,
    target: &'static str,
    float: Vec<String>,
}

/// That of every core; and where Arduino passes floats in integer registers.
fn precompiled() -> Vec<Precompiled> {
    let every = CORES.iter().map(|core| Precompiled {
        folder: core.name.replace("m0", "m0plus"),
        core,
        target: core.target,
        float: core.gcc[1..]
            .iter()
            .map(|option| (*option).to_owned())
            .collect(),
    });
    let softfp = [("cortex-m4", "fpv4-sp-d16"), ("cortex-m7", "fpv5-d16")];
    let softfp = softfp.iter().filter_map(|(name, fpu)| {
        Some(Precompiled {
            folder: format!("{name}/{fpu}-softfp"),
            core: CORES.iter().find(|core| core.name == *name)?,
            target: "thumbv7em-none-eabi",
            float: vec!["-mfloat-abi=softfp".to_owned(), format!("-mfpu={fpu}")],
        })
    });
    every.chain(softfp).collect()
}

pub(crate) fn run(options: &Options) -> Result<()> {
    if options.check {
        return check();
    }
    let folder = target_dir().join("arduino/jred");
    let folder = options.out.as_ref().unwrap_or(&folder);
    make(folder, &[])?;
    println!("{}", folder.display());
    Ok(())
}

/// Makes the folder with few sets of curves, compiles and links its sketch as Arduino does, and runs it on every core in QEMU.
pub(crate) fn check() -> Result<()> {
    let folder = target_dir().join("arduino/check/jred");
    make(&folder, &["--cfg=few_sets"])?;
    for made in precompiled() {
        let sketch = made.link(&folder)?;
        let output = text(&mut qemu(made.core, &sketch))?;
        expected::compare("07_axis", &output, &format!("{}, sketch", made.folder))?;
    }
    Ok(())
}

fn make(folder: &Path, rustc: &[&str]) -> Result<()> {
    let _ = std::fs::remove_dir_all(folder);
    let copies = [
        ("ffi/include/jred.h", "src/jred.h"),
        ("ffi/include/jred_axis.h", "src/jred_axis.h"),
        ("ffi/include/jred.hpp", "src/jred.hpp"),
        ("ffi/c99/jred99.h", "src/jred99.h"),
        ("ffi/arduino/library.properties", "library.properties"),
        ("ffi/arduino/library.json", "library.json"),
        ("ffi/arduino/link.py", "link.py"),
        ("ffi/arduino/README.md", "README.md"),
        (
            "ffi/arduino/examples/axis/axis.ino",
            "examples/axis/axis.ino",
        ),
        ("ffi/examples/axis.h", "examples/axis/axis.h"),
        ("ffi/examples/press.h", "examples/axis/press.h"),
        ("LICENSE-MIT", "LICENSE-MIT"),
        ("LICENSE-APACHE", "LICENSE-APACHE"),
    ];
    for (from, to) in copies {
        let content = std::fs::read_to_string(root().join(from)).context(from)?;
        let content = content
            .replace("@VERSION@", env!("CARGO_PKG_VERSION"))
            .replace("@URL@", env!("CARGO_PKG_REPOSITORY"));
        write(&folder.join(to), content.as_bytes())?;
    }
    for made in precompiled() {
        let library = std::fs::read(made.compile(rustc)?)?;
        write(
            &folder.join("src").join(&made.folder).join("libjred.a"),
            &library,
        )?;
    }
    Ok(())
}

fn write(path: &Path, content: &[u8]) -> Result<()> {
    let folder = path.parent().context("no folder")?;
    std::fs::create_dir_all(folder)?;
    std::fs::write(path, content).with_context(|| path.display().to_string())
}

impl Precompiled {
    fn compile(&self, rustc: &[&str]) -> Result<PathBuf> {
        let flags = format!("target.{}.rustflags = {:?}", self.target, self.core.rustc);
        let mut cargo = workspace("rustc");
        cargo
            .args(["--quiet", "--package", "jred-ffi", "--profile", "firmware"])
            .args(["--target", self.target, "--config", &flags, "--"])
            .args(rustc);
        done(&mut cargo)?;
        Ok(firmware(self.target).join("libjred_ffi.a"))
    }

    /// The sketch as the Arduino builder compiles and links it: `src` is the only folder of headers, and `-L` names the folder of the library.
    fn link(&self, folder: &Path) -> Result<PathBuf> {
        let [source, sketch, object] =
            ["examples/axis/axis.ino", "sketch", "startup.o"].map(|name| folder.join(name));
        let compile = |name: &str| {
            let mut gcc = program(name);
            gcc.args([self.core.gcc[0], "-mthumb", "-Os", "-nostartfiles"])
                .args(&self.float)
                .args(["-ffunction-sections", "-fdata-sections"]);
            gcc
        };
        let mut gcc = compile("arm-none-eabi-gcc");
        gcc.args(["-std=c99", "-c", "ffi/examples/startup.c", "-o"]);
        done(gcc.arg(&object))?;
        let cpp = || {
            let mut gcc = compile("arm-none-eabi-g++");
            gcc.args(["-std=gnu++11", "-fno-exceptions", "-fno-rtti"])
                // Only because the output is compared to the last bit, and the sketch computes its set-point itself.
                .arg("-ffp-contract=off")
                .args(["-Iffi/tests/arduino", "-include", "Arduino.h", "-I"])
                .arg(folder.join("src"))
                .args(["-x", "c++"])
                .arg(&source);
            gcc
        };
        done(cpp().args(["-DMACHINE", "-fsyntax-only"]))?;
        let mut gcc = cpp();
        gcc.arg("ffi/tests/arduino/main.cpp")
            .args(["-x", "none"])
            .arg(object)
            .arg("-L")
            .arg(folder.join("src").join(&self.folder))
            .args(["-ljred", "-L.", "-Tffi/examples/cortex-m.ld"])
            .args(["--specs=nano.specs", "--specs=rdimon.specs"])
            .args(["-Wl,--gc-sections", "-Wl,-z,noexecstack", "-o"])
            .arg(&sketch);
        if self.core.name == "cortex-m0" {
            gcc.arg("-Wl,--defsym=__small_ram=1");
        }
        done(&mut gcc)?;
        Ok(sketch)
    }
}
