//! The same by NumPy, as an engineer would write it: `benches/size.py`.

use std::io;
use std::path::Path;
use std::process::Command;

use bytemuck::cast_slice;
use jred_sizing::cycle::LoadSample;
use jred_sizing::judge::Context;

use crate::{Ready, brute};

/// Points of an envelope between its ends.
const POINTS: usize = 64;

/// Runs the script and prints its time and how far its figures are from these.
pub(crate) fn compare(ready: &Ready) {
    match run(ready) {
        Ok(line) => println!("{line}"),
        Err(error) => println!("NumPy: left out ({error})"),
    }
}

fn run(ready: &Ready) -> io::Result<String> {
    let folder = tempfile::tempdir()?;
    let write = |name: &str, values: &[f64]| {
        std::fs::write(folder.path().join(name), cast_slice::<f64, u8>(values))
    };
    let samples = ready.cycle.samples();
    let loads: Vec<f64> = samples.iter().flat_map(LoadSample::loads).collect();
    let weights: Vec<f64> = samples.iter().map(|s| s.weight).collect();
    write("loads", &loads)?;
    write("weights", &weights)?;
    let mut drives = Vec::new();
    let mut expected = Vec::new();
    for (id, drive) in ready.catalogue.drives() {
        let index = id.motor();
        let context = Context::new(&ready.cycle, &ready.site, drive, &ready.motors[index]);
        drives.push(index as f64);
        drives.push(context.ratio);
        drives.extend(context.coefficients.0);
        if drives.len() % 7000 == 7 {
            let c = &context.coefficients;
            expected.push((expected.len() * 1000, brute::rms_torque(&ready.cycle, c)));
        }
    }
    write("drives", &drives)?;
    let mut envelopes = Vec::new();
    for motor in &ready.motors {
        let limit = motor.envelope.limit(false);
        let end = if limit.end().is_finite() {
            limit.end()
        } else {
            1e9
        };
        for k in 0..=POINTS {
            let speed = end * k as f64 / POINTS as f64;
            let torque = limit.torque(speed);
            envelopes.extend([speed, if torque.is_finite() { torque } else { 1e9 }]);
        }
    }
    write("envelopes", &envelopes)?;
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../benches/size.py");
    let output = Command::new("python3")
        .arg(script)
        .arg(folder.path())
        .output()?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        let last = said.lines().last().unwrap_or("no message").to_owned();
        return Err(io::Error::other(last));
    }
    let rms = std::fs::read(folder.path().join("rms"))?;
    let rms: Vec<f64> = rms
        .chunks_exact(8)
        .map(bytemuck::pod_read_unaligned)
        .collect();
    let off = expected
        .iter()
        .map(|&(k, rms_here)| (rms[k] / rms_here - 1.0).abs());
    let off = off.fold(0.0, f64::max);
    let said = String::from_utf8_lossy(&output.stdout);
    Ok(format!("{} (RMS within {off:.0e})", said.trim_end()))
}
