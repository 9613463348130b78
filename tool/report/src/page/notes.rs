//! Notes of the report: self-check, method, sources.

use jred_analysis::duty::Duty;
use jred_file::number::rounding::{cleared, rounded, shown};
use jred_sizing::judge::Assessment;

/// Self-check, method, sources.
pub(super) fn notes(best: &Assessment, duty: &Duty) -> Vec<String> {
    let work = duty.integral(|i| i.terms.total() * i.omega);
    let kinetic = duty.integral(|i| (i.terms.acceleration + i.terms.velocity) * i.omega);
    let potential = duty.integral(|i| i.terms.potential * i.omega);
    let moved = duty.integral(|i| {
        let terms = &i.terms;
        let parts = [
            terms.acceleration,
            terms.velocity,
            terms.potential,
            terms.process,
        ];
        parts.iter().map(|part| part.abs()).sum::<f64>() * i.omega.abs()
    });
    let mut notes = vec![
        format!(
            "Self-check over the cycle: work at the drive link {} J, of which {} J into kinetic energy and {} J into \
             potential energy (zero for a closed cycle, unless a payload varies with the position).",
            rounded(cleared(work, moved)),
            shown(kinetic, moved),
            shown(potential, moved)
        ),
        "Losses: an efficiency divides the torque where power flows to the machine and multiplies it where power flows \
         back."
            .to_owned(),
        format!(
            "The cycle is evaluated exactly at {} instants. Integrals are by Gauss-Kronrod quadrature, with panels halved \
             until the error is known to be small; peaks between the instants are included.",
            duty.instants.len()
        ),
        "Share of mean square: mean of (part × whole) over mean of (whole × whole); the shares add up to 100 %. A \
         negative share reduces the RMS."
            .to_owned(),
    ];
    let drive = &best.drive;
    let mut source = |model: &str, source: &str| {
        notes.push(format!("Source of {model}: {source}"));
    };
    source(&drive.motor.model, &drive.motor.source);
    if let Some(gearbox) = drive.gearbox {
        source(&gearbox.model, &gearbox.source);
    }
    if let Some(amplifier) = drive.amplifier {
        source(&amplifier.model, &amplifier.source);
    }
    notes
}
