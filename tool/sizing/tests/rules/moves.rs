//! Moves, their rate, and the frequency of the machine's excitation.

use super::{Stand, near};

const TABLE: &str = r#"
gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "gear-train"
flywheel = "0.01 kg m^2"
stage = [{ driver = { teeth = 20, inertia = "0.02 kg m^2" }, driven = { teeth = 40, inertia = "0.08 kg m^2" } }]
"#;

fn moves(motion: &str) -> (u32, f64, f64) {
    let stand = Stand::new(&format!("{TABLE}\n{motion}"));
    let mechanics = stand.cycle.mechanics();
    (
        mechanics.moves,
        mechanics.move_rate,
        mechanics.drive_frequency,
    )
}

fn cycle(segments: &[&str]) -> String {
    let segments = segments
        .iter()
        .map(|s| format!("[[motion.segment]]\n{s}\n"));
    format!(
        "[motion]\ntype = \"cycle\"\n{}",
        segments.collect::<String>()
    )
}

#[test]
fn a_turn_without_end_has_no_moves() {
    let (count, rate, frequency) =
        moves("[motion]\ntype = \"constant-speed\"\nspeed = \"150 rpm\"\n");
    assert_eq!((count, rate), (0, 0.0));
    near("frequency", frequency, 2.5, 1e-12);
}

#[test]
fn every_move_counts() {
    let law = "law = \"cycloidal\"";
    // Two moves with a pause between, one directly after the other, there and back.
    for (segments, count, shortest) in [
        (
            vec![
                format!("move = \"180 deg\"\nduration = \"0.4 s\"\n{law}"),
                "dwell = \"0.1 s\"".into(),
                format!("move = \"180 deg\"\nduration = \"0.3 s\"\n{law}"),
            ],
            2,
            0.3,
        ),
        (
            vec![format!("move = \"120 deg\"\nduration = \"0.4 s\"\n{law}"); 3],
            3,
            0.4,
        ),
        (
            vec![
                format!("move = \"90 deg\"\nduration = \"0.5 s\"\n{law}"),
                format!("move = \"-90 deg\"\nduration = \"0.2 s\"\n{law}"),
            ],
            2,
            0.2,
        ),
        (
            vec![
                "dwell = \"0.3 s\"".into(),
                format!("move = \"360 deg\"\nduration = \"0.7 s\"\n{law}"),
                "dwell = \"0.3 s\"".into(),
            ],
            1,
            0.7,
        ),
    ] {
        let total: f64 = segments
            .iter()
            .map(|s: &String| {
                let time = s
                    .split("duration = \"")
                    .nth(1)
                    .or_else(|| s.split("dwell = \"").nth(1))
                    .unwrap();
                time.split(' ').next().unwrap().parse::<f64>().unwrap()
            })
            .sum();
        let words: Vec<&str> = segments.iter().map(String::as_str).collect();
        let (found, rate, frequency) = moves(&cycle(&words));
        assert_eq!(found, count, "{segments:?}");
        near("rate", rate, f64::from(count) / total, 1e-12);
        // A cycloidal move of the angle Δ in t is fastest at 2Δ/t.
        let fastest = words
            .iter()
            .filter_map(|s| {
                let way: f64 = s
                    .split("move = \"")
                    .nth(1)?
                    .split(' ')
                    .next()?
                    .parse()
                    .ok()?;
                let time: f64 = s
                    .split("duration = \"")
                    .nth(1)?
                    .split(' ')
                    .next()?
                    .parse()
                    .ok()?;
                Some(2.0 * way.abs() / 360.0 / time)
            })
            .fold(0.0, f64::max);
        near(
            "frequency",
            frequency,
            (1.0f64 / shortest).max(fastest),
            1e-6,
        );
    }
}

/// A recorded motion that continues over the end of its cycle: one move from before the end to after the start.
#[test]
fn a_move_over_the_end_of_the_cycle_is_one() {
    use std::fmt::Write as _;
    let folder = super::Folder::new();
    let mut csv = "t [s],phi [deg]\n".to_owned();
    for k in 0..=200 {
        let t = f64::from(k) / 200.0;
        // At rest from 0.3 s to 0.7 s of every second.
        let z = ((t + 0.3) % 1.0 / 0.6).min(1.0);
        let turns = if t + 0.3 >= 1.0 { 1.0 } else { 0.0 };
        let phi = 360.0 * (turns + z * z * z * (10.0 - 15.0 * z + 6.0 * z * z));
        let _ = writeln!(csv, "{t:.4},{phi:.12}");
    }
    folder.file("over.csv", csv);
    let text = format!("{TABLE}\n[motion]\ntype = \"profile\"\nfile = \"over.csv\"\n");
    let file = jred_analysis::checked::parse("m.toml", &text, folder.path("")).unwrap();
    let duty = jred_analysis::duty::Duty::new(&file, file.motion.as_ref().unwrap(), 2000).unwrap();
    assert_eq!(duty.mechanics.moves, 1);
    near("moves a second", duty.mechanics.move_rate, 1.0, 1e-12);
    // 0.6 s, except for the overshoot of the interpolated curve at its ends.
    let fastest = duty.figures(|i| i.omega).peak() / std::f64::consts::TAU;
    near("frequency", duty.mechanics.drive_frequency, fastest, 1e-12);
    assert!(fastest > 1.0 / 0.6);
}
