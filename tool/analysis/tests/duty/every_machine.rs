//! The integrals of every shipped machine at the default tolerance against those at the smallest.

use std::path::Path;

use crate::reader;
use crate::support::{budget, shipped};
use jred_analysis::duty::{Duty, Instant, LEAST_TOLERANCE, Sampling};

/// The integrands that figures are made of.
const INTEGRANDS: [fn(&Instant) -> f64; 14] = [
    |i| i.input_torque,
    |i| i.input_torque.powi(2),
    |i| i.input_alpha.powi(2),
    |i| i.input_alpha * i.input_torque,
    |i| i.input_speed,
    |i| i.input_speed.powi(2),
    |i| i.input_torque * i.input_speed,
    |i| (i.input_torque * i.input_speed).powi(2),
    |i| i.input_speed.abs() * i.input_torque.abs().powi(3),
    |i| i.input_speed.abs() * i.input_torque.abs().powf(10.0 / 3.0),
    |i| i.input_inertia,
    |i| i.input_inertia.powi(2),
    |i| i.terms.total().powi(2),
    |i| (i.input_torque * i.input_speed).max(0.0),
];

#[test]
fn every_machine_has_the_integrals_of_a_smaller_tolerance() {
    let folder = shipped("press.toml");
    let folder = folder.parent().unwrap();
    let mut machines = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|end| end != "toml") {
            continue;
        }
        let text = std::fs::read_to_string(&path).unwrap();
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let file = reader::parse(&name, &text, folder as &Path).unwrap();
        let Some(motion) = file.motion.as_ref().filter(|_| file.variator.is_none()) else {
            continue;
        };
        let of = |tolerance: f64, steps: usize| {
            Duty::new(&file, motion, Sampling { tolerance, steps })
                .unwrap_or_else(|fault| panic!("{name}: {fault}"))
        };
        let fine = of(LEAST_TOLERANCE, 2000);
        for duty in [of(1e-9, 2000), of(1e-9, 16)] {
            for (number, integrand) in INTEGRANDS.iter().enumerate() {
                let [found, exact] = [&duty, &fine].map(|duty| duty.integral(integrand));
                let size = fine.integral(|i| integrand(i).abs());
                let off = (found - exact).abs() / size.max(f64::MIN_POSITIVE);
                assert!(
                    off <= budget::DUTY,
                    "{name}, {number}: {found} {exact} {off:e}"
                );
            }
        }
        machines += 1;
    }
    assert!(machines > 30, "{machines}");
}
