//! CMSIS-DSP and C for comparison: fetched, compiled, and linked into the on-target program.
//!
//! None of it is part of this project. The package is the source distribution on PyPI, checked by its SHA-256. It is compiled as in its build without
//! CMSIS-Core (`__GNUC_PYTHON__`), because none of the functions used here contains an intrinsic. gcc's own libgcc and newlib are linked with it,
//! under names that rustc's routines cannot replace.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};
use sha2::{Digest, Sha256};

use crate::cores::Core;
use crate::kernels::{KERNELS, Origin};
use crate::run::{output, root, target_dir};

const ARCHIVE: &str = "cmsisdsp-1.10.3.tar.gz";
const SHA256: &str = "307d32298faa7c58db912851027fce35f886fec7eb1a27c4b309ce1a97f47519";
/// Prints the address of the package index in pip's configuration.
const INDEX: &str = "import subprocess, sys; from pip._internal.models.index import PyPI; \
    own = subprocess.output([sys.executable, '-m', 'pip', 'config', 'get', 'global.index-url'], \
    capture_output=True, text=True).stdout.strip(); print(own or PyPI.simple_url)";
/// The package's name in the index.
const PACKAGE: &str = "cmsisdsp";
const GCC: &str = "arm-none-eabi-gcc";
/// Functions of kernels.c that create a machine from the data.
const BUILDERS: [&str; 5] = [
    "peer_tables_f32",
    "peer_linear_f32",
    "peer_linear_q31",
    "peer_linear_q15",
    "peer_dimensions",
];
/// Sources of the package that the kernels need.
const SOURCES: [&str; 6] = [
    "InterpolationFunctions/arm_linear_interp_f32.c",
    "InterpolationFunctions/arm_linear_interp_q31.c",
    "InterpolationFunctions/arm_linear_interp_q15.c",
    "FastMathFunctions/arm_sin_f32.c",
    "FastMathFunctions/arm_cos_f32.c",
    "CommonTables/arm_common_tables.c",
];

fn curl(url: &str) -> Result<Vec<u8>> {
    output(Command::new("curl").args([
        "--silent",
        "--show-error",
        "--fail",
        "--location",
        "--max-time",
        "120",
        url,
    ]))
}

fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes)
        .iter()
        .fold(String::new(), |mut text, byte| {
            let _ = write!(text, "{byte:02x}");
            text
        })
}

/// The package's sources, downloaded on first use.
pub(crate) fn fetch() -> Result<PathBuf> {
    output(Command::new(GCC).arg("--version"))
        .context("apt-get install gcc-arm-none-eabi libnewlib-arm-none-eabi")?;
    let folder = target_dir().join("peers");
    let sources = folder.join(ARCHIVE.trim_end_matches(".tar.gz"));
    let archive = folder.join(ARCHIVE);
    std::fs::create_dir_all(&folder)?;
    if !archive.exists() {
        eprintln!("downloading {ARCHIVE} into {}", folder.display());
        let index = output(Command::new("python3").args(["-c", INDEX])).context("pip is needed")?;
        let index = String::from_utf8(index)?;
        let index = format!("{}/{PACKAGE}/", index.trim().trim_end_matches('/'));
        let page = String::from_utf8_lossy(&curl(&index)?).into_owned();
        let bytes = curl(link(&page).with_context(|| format!("no {ARCHIVE} in {index}"))?)?;
        let found = sha256(&bytes);
        ensure!(
            found == SHA256,
            "{ARCHIVE} has the SHA-256 {found}, not {SHA256}"
        );
        std::fs::write(&archive, bytes)?;
    }
    if !sources.exists() {
        output(
            Command::new("tar")
                .arg("xzf")
                .arg(&archive)
                .arg("-C")
                .arg(&folder),
        )?;
    }
    Ok(sources)
}

/// The address of the archive in the index page.
fn link(page: &str) -> Option<&str> {
    page.split('"')
        .filter_map(|part| part.split('#').next())
        .find(|part| part.ends_with(&format!("/{ARCHIVE}")))
}

/// The object with all peers for `core`.
pub(crate) fn compile(core: &Core, sources: &Path) -> Result<PathBuf> {
    let folder = target_dir().join("peers").join(core.name);
    std::fs::create_dir_all(&folder)?;
    let object = folder.join("peers.o");
    let mut files = vec![root().join("xtask/peers/kernels.c")];
    files.extend(SOURCES.map(|file| sources.join("Source").join(file)));
    let mut objects = Vec::new();
    for file in files {
        let to = folder
            .join(file.file_name().context("a file")?)
            .with_extension("o");
        output(
            Command::new(GCC)
                .args(core.gcc)
                .args([
                    "-mthumb",
                    "-O3",
                    "-std=gnu11",
                    "-fno-math-errno",
                    "-ffunction-sections",
                    "-fdata-sections",
                ])
                .args(["-D__GNUC_PYTHON__", "-w", "-c", "-I"])
                .arg(sources.join("Include"))
                .arg("-I")
                .arg(sources.join("PrivateInclude"))
                .arg(&file)
                .arg("-o")
                .arg(&to),
        )?;
        objects.push(to);
    }
    output(
        Command::new(GCC)
            .args(core.gcc)
            .args(["-mthumb", "-nostdlib", "-r", "-o"])
            .arg(&object)
            .args(&objects)
            .args(["-lm", "-lc", "-lgcc"]),
    )?;
    // Only the kernels stay visible.
    let mut objcopy = Command::new("arm-none-eabi-objcopy");
    for kernel in KERNELS
        .iter()
        .filter(|kernel| kernel.origin == Origin::Peer)
    {
        objcopy.arg(format!("--keep-global-symbol={}", kernel.name));
    }
    for build in BUILDERS {
        objcopy.arg(format!("--keep-global-symbol={build}"));
    }
    output(objcopy.arg(&object))?;
    Ok(object)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_archive_is_found_in_the_index() {
        let page = r#"<a href="https://host/a/cmsisdsp-1.10.2.tar.gz#sha256=0">x</a>
            <a href="https://host/b/cmsisdsp-1.10.3.tar.gz#sha256=1">y</a>"#;
        assert_eq!(link(page), Some("https://host/b/cmsisdsp-1.10.3.tar.gz"));
        assert_eq!(link("<a href=\"other\">"), None);
    }

    #[test]
    fn a_digest_is_that_of_the_standard() {
        assert_eq!(
            sha256(b"abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
        );
    }
}
