//! Warnings of `jred check` and `jred size`: implausible values, and noise of recordings.

use std::f64::consts::TAU;
use std::fmt::Write;

use jred_analysis::warnings::warnings;
use jred_file::model::motion::{Motion, Recording, Repetition};
use jred_file::number::rounding::significant;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

use crate::reading::{machine_path, parse, parse_in, read, refuses, text_of};
use crate::support::{self, edited, phrases};

const CRANK: &str = r#"gravity = ["9.81 m/s^2", "0 m/s^2"]
[mechanism]
type = "slider-crank"
crank = { length = "30 mm", mass = "9 kg", inertia = "0.018 kg m^2", com = ["6 mm", "0 mm"] }
rod = { length = "180 mm", mass = "6.5 kg", inertia = "0.03 kg m^2", com = ["55 mm", "0 mm"] }
slider = { mass = "42 kg" }
"#;

#[track_caller]
fn warns(text: &str, words: &[&str]) {
    let found = warnings(&read(text)).unwrap().join("\n");
    for word in words {
        assert!(found.contains(word), "{word:?} is not in {found:?}");
    }
    assert_eq!(found.is_empty(), words.is_empty(), "{found}");
}

#[test]
fn wrong_units_are_implausible() {
    warns(CRANK, &[]);
    let cases = r#"
        // √(300/6.5) m for a rod of 180 mm.
        0.03 kg m^2 => 300 kg m^2 => rod has 300 kg m^2 at 6.5 kg | 6.794 m | 0.18 m long
        0.03 kg m^2 => 0.03 kg mm^2 => the rod has | are the units right
        0.03 kg m^2 => 0 kg m^2 => rod has a mass of 6.5 kg and no moment of inertia | 0.018 kg m^2
        9.81 m/s^2 => 981 m/s^2 => gravity is 981 m/s^2
        9.81 m/s^2 => 9.81 mm/s^2 => gravity is 0.00981 m/s^2
        ["55 mm" => ["900 m" => centre of mass of the rod is 900 m away
        "180 mm" => "400 m" => has a length of 400 m, 13330 times
        42 kg => 0.003 g => has a mass of 9 kg | slider with 3.000e-6 kg
    "#;
    for [from, to, words] in support::rows(cases) {
        warns(&edited(CRANK, &from, &to), &phrases(&words));
    }
}

/// A way of 500 mm in a microsecond; one in 5 ms reaches 188 m/s, one in 10 ms 29 km/s² at the most.
#[test]
fn implausible_motions() {
    let text = |duration: &str| {
        format!(
            "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"belt-axis\"\nstroke = [\"0 mm\", \"600 mm\"]\n\
             pulley = {{ diameter = \"100 mm\", inertia = \"1e-4 kg m^2\" }}\ncarriage = {{ mass = \"5 kg\" }}\n\
             [motion]\ntype = \"cycle\"\nof = {{ point = \"carriage\", along = \"x\" }}\nstart = \"0 mm\"\n\
             segment = [{{ law = \"polynomial-345\", move = \"500 mm\", duration = \"{duration}\" }}, \
             {{ law = \"polynomial-345\", move = \"-500 mm\", duration = \"{duration}\" }}]\n"
        )
    };
    warns(&text("10 ms"), &[]);
    // 15/8 of 500 mm/5 ms.
    warns(
        &text("5 ms"),
        &["a speed of 187.5 m/s at 0.0025 s, more than 100"],
    );
    warns(&text("1000 ns"), &["a speed of 937500 m/s at 5.000e-7 s"]);
}

/// The limits are wide: no shipped machine is warned of.
#[test]
fn shipped_machines_are_plausible() {
    for entry in std::fs::read_dir(machine_path("")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|e| e == "toml") {
            let text = std::fs::read_to_string(&path).unwrap();
            let file = parse_in(&text, path.parent().unwrap()).unwrap();
            let found = warnings(&file).unwrap();
            let implausible = found.iter().filter(|w| {
                w.contains("is its unit")
                    || w.contains("are the units")
                    || w.contains("no moment of inertia")
            });
            assert_eq!(implausible.count(), 0, "{}: {found:?}", path.display());
        }
    }
}

const ROWS: usize = 2000;
const OMEGA: f64 = 5.0 * TAU;

/// A second of φ = sin 5·2πt, and its derivatives.
fn exact(t: f64) -> [f64; 3] {
    let (sin, cos) = (OMEGA * t).sin_cos();
    [sin, OMEGA * cos, -OMEGA * OMEGA * sin]
}

/// Rows of it, or of its speed, with normal errors of this size (the sum of twelve even ones).
fn rows(order: usize, sigma: f64) -> (Vec<f64>, Vec<f64>) {
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let mut normal = || (0..12).map(|_| random.random_range(-0.5..0.5)).sum::<f64>();
    let times: Vec<f64> = (0..=ROWS).map(|k| k as f64 / ROWS as f64).collect();
    let values = times.iter().map(|t| exact(*t)[order] + sigma * normal());
    let values = values.collect();
    (times, values)
}

fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let all: Vec<f64> = values.collect();
    (all.iter().map(|x| x * x).sum::<f64>() / all.len() as f64).sqrt()
}

/// The estimates are the noise that was put in, and what the curve makes of it, to 10 %: of 2000 rows the middle magnitude scatters by 2 %.
#[test]
fn noise_is_measured() {
    for (order, sigma) in [(0, 1e-4), (0, 1e-6), (1, 0.05)] {
        let (times, values) = rows(order, sigma);
        let recording = Recording {
            times: &times,
            values: &values,
            cutoff: None,
            closing: Repetition::Open,
        };
        let motion = match order {
            0 => Motion::positions(&recording),
            _ => Motion::speeds(&recording, 0.0),
        }
        .unwrap();
        let noise = motion.noise().unwrap();
        assert_eq!(noise.of_speeds, order == 1);
        assert!((noise.rows / sigma - 1.0).abs() < 0.1, "{:e}", noise.rows);
        // Away from the ends, where a curve that is not periodic is less certain.
        let inner = &times[100..ROWS - 100];
        let alpha = rms(inner.iter().map(|t| motion.at(*t).alpha - exact(*t)[2]));
        assert!(
            (noise.acceleration / alpha - 1.0).abs() < 0.1,
            "{:e} {alpha:e}",
            noise.acceleration
        );
        let omega = rms(inner.iter().map(|t| motion.at(*t).omega - exact(*t)[1]));
        assert!(
            (noise.speed / omega - 1.0).abs() < 0.1,
            "{:e} {omega:e}",
            noise.speed
        );
        // Smoothed as proposed, the acceleration is that of the motion to some per cent.
        if let Some(cutoff) = motion.quiet_cutoff(&noise) {
            let smooth = Recording {
                cutoff: Some(TAU * cutoff),
                ..recording
            };
            let smooth = match order {
                0 => Motion::positions(&smooth),
                _ => Motion::speeds(&smooth, 0.0),
            }
            .unwrap();
            let off = rms(inner.iter().map(|t| smooth.at(*t).alpha - exact(*t)[2]));
            let size = rms(inner.iter().map(|t| exact(*t)[2]));
            assert!(off < 0.1 * size, "{cutoff} Hz: {off:e} of {size:e}");
        } else {
            panic!("no frequency");
        }
    }
}

/// A recording without noise, however coarse, is warned of nothing; one with noise names its cure, which ends the warning.
#[test]
fn noisy_records_name_their_cure() {
    let machine = |more: &str| {
        format!(
            "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\ntable = {{ inertia = \"1 kg m^2\" }}\n\
             [motion]\ntype = \"profile\"\nfile = \"log.csv\"\ncyclic = false\n{more}\n"
        )
    };
    let folder = tempfile::tempdir().unwrap();
    let found = |csv: &str, more: &str| {
        std::fs::write(folder.path().join("log.csv"), csv).unwrap();
        warnings(&parse_in(&machine(more), folder.path()).unwrap()).unwrap()
    };
    let csv = |rows: usize, sigma: f64| {
        let (times, values) = self::rows(0, sigma);
        let mut csv = "t [s],phi [rad]\n".to_owned();
        for (t, phi) in times.iter().zip(values).step_by(ROWS / rows) {
            writeln!(csv, "{t:e},{phi:e}").unwrap();
        }
        csv
    };
    for rows in [20, 40, 200, 2000] {
        assert_eq!(found(&csv(rows, 0.0), ""), Vec::<String>::new(), "{rows}");
    }
    let noisy = csv(2000, 1e-3);
    let warning = found(&noisy, "").join("\n");
    assert!(
        warning.contains("the recorded positions have noise of about 0.05"),
        "{warning}"
    );
    let line = warning
        .split("write smoothing = ")
        .nth(1)
        .unwrap()
        .split('"')
        .nth(1)
        .unwrap();
    assert_eq!(
        found(&noisy, &format!("smoothing = \"{line}\"")),
        Vec::<String>::new()
    );
}

/// A row that is wrong is named with its number, in positions and in speeds; so is a cycle that closes at another speed than it starts with.
/// Corners of the acceleration, at rows and between them, are a motion's own.
#[test]
fn a_row_that_stands_out_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let written = |cyclic: bool, column: &str, rows: &[[f64; 2]]| {
        let mut csv = format!("t [s],{column}\n");
        for [t, y] in rows {
            writeln!(csv, "{t:e},{y:e}").unwrap();
        }
        std::fs::write(folder.path().join("log.csv"), csv).unwrap();
        format!(
            "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\ntable = {{ inertia = \"1 kg m^2\" }}\n\
             [motion]\ntype = \"profile\"\nfile = \"log.csv\"\ncyclic = {cyclic}\n"
        )
    };
    let found = |cyclic: bool, column: &str, rows: &[[f64; 2]]| {
        let text = written(cyclic, column, rows);
        warnings(&parse_in(&text, folder.path()).unwrap()).unwrap()
    };
    let sampled = |f: &dyn Fn(f64) -> f64| -> Vec<[f64; 2]> {
        let times = (0..=200).map(|k| f64::from(k) * 0.01);
        times.map(|t| [t, f(t)]).collect()
    };
    let sine = sampled(&|t| (TAU * 0.5 * t).sin());
    let speeds = sampled(&|t| 20.0 + (TAU * t).sin());
    let outlier = |rows: &[[f64; 2]], k: usize, by: f64| {
        let mut rows = rows.to_vec();
        rows[k][1] += by;
        rows
    };
    for cyclic in [false, true] {
        assert_eq!(found(cyclic, "phi [rad]", &sine), [""; 0]);
        assert_eq!(found(false, "omega [rad/s]", &speeds), [""; 0]);
        for k in [10, 51, 120] {
            // The second derivative of the spline through a row that is off by 0.01 rad is 6·(√3 − 1) times 0.01/h², and the sine's own.
            let bent = 6.0 * (3.0_f64.sqrt() - 1.0) * 0.01 / 0.01_f64.powi(2);
            let reached = bent + (0.5 * TAU).powi(2) * sine[k][1];
            let reaches = format!(
                "reaches {} rad/s^2, elsewhere 9.87 rad/s^2",
                significant(reached, 3)
            );
            let said = found(cyclic, "phi [rad]", &outlier(&sine, k, 0.01)).join("\n");
            let named = format!("row {}, {} s after", k + 1, significant(sine[k][0], 3));
            assert!(said.starts_with(&named), "{said}");
            assert!(said.contains(&reaches), "{said}");
            let said = found(false, "omega [rad/s]", &outlier(&speeds, k, 0.2)).join("\n");
            assert!(
                said.starts_with(&named) && said.contains("a speed 0.2 rad/s off"),
                "{said}"
            );
        }
    }
    // Half a parabola: the cycle ends a turn further with twice the mean speed.
    let parabola = sampled(&|t| TAU * (t / 2.0).powi(2));
    let said = found(true, "phi [rad]", &parabola).join("\n");
    assert!(
        said.starts_with("the first row, at which the cycle closes"),
        "{said}"
    );
    assert_eq!(found(false, "phi [rad]", &parabola), [""; 0]);
    // A trapezoid of the speed whose corners lie anywhere between the rows, and noise of any size.
    for corner in [0.5, 0.501, 0.5025, 0.505, 0.5075, 0.509] {
        let position = |t: f64| match t {
            t if t < corner => t * t,
            t if t < 2.0 - corner => corner * (2.0 * t - corner),
            t => 2.0 * corner * (2.0 - corner) - (2.0 - t).powi(2),
        };
        assert_eq!(found(false, "phi [rad]", &sampled(&position)), [""; 0]);
    }
    for sigma in [1e-6, 1e-4, 1e-2] {
        let (times, values) = rows(0, sigma);
        let rows: Vec<[f64; 2]> = times.into_iter().zip(values).map(Into::into).collect();
        let said = found(false, "phi [rad]", &rows).join("\n");
        assert!(!said.contains("row"), "{said}");
    }
    // Rounded to 0.1 mm, at rest half of the time: it is the noise of all rows, and none of them is wrong.
    let rounded = sampled(&|t| {
        let z = t.min(1.0);
        (1e4 * z.powi(3) * (10.0 - 15.0 * z + 6.0 * z * z)).round() / 1e4
    });
    let said = found(false, "phi [rad]", &rounded).join("\n");
    assert!(
        said.contains("have noise of about") && !said.contains("off the curve"),
        "{said}"
    );
    // The same instant twice.
    let mut twice = sine.clone();
    twice.insert(51, [0.5 + 1e-9, sine[50][1]]);
    let text = written(false, "phi [rad]", &twice);
    let fault = parse_in(&text, folder.path()).unwrap_err();
    let fault = format!("{fault:?}");
    assert!(
        fault.contains("row 52 is 1e-9 s after the previous row"),
        "{fault}"
    );
}

/// A microsecond in ten million seconds, whose times have the digits of 2e-9 s; and an end of a load that is rounded.
#[test]
fn what_is_too_short_for_its_digits() {
    let text = |pause: &str| {
        format!(
            "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\ntable = {{ inertia = \"1 kg m^2\" }}\n\
             [motion]\ntype = \"point-to-point\"\nsegment = [{{ dwell = \"{pause}\" }}, \
             {{ law = \"polynomial-345\", move = \"1e-6 deg\", duration = \"1 us\" }}]\n"
        )
    };
    warns(&text("60 min"), &[]);
    warns(
        &text("9e6 s"),
        &[
            "segment 2 lasts 1.000e-6 s in a motion of 9.000e6 s",
            "rounded by 0.001998",
        ],
    );
    let load = |from: f64| {
        format!(
            "{CRANK}[[load]]\non = \"slider\"\nforce = [\"-1 N\", \"0 N\"]\nbetween = [\"{from} deg\", \"{} deg\"]\nramp = \"0.0004 deg\"\n",
            from + 0.001
        )
    };
    read(&load(320.0));
    refuses(
        &load(5e8),
        &["so far from zero", "rounded by 1.1", "first turn"],
    );
    let still = text("1 s").replace("1e-6 deg", "1e-9 deg");
    refuses(
        &still,
        &["is 1e-9 deg, too small for any machine: nothing moves"],
    );
}

/// A move back that is missing or too short is a warning where nothing says that the axis ends, and an error where it does.
#[test]
fn an_axis_that_never_comes_back_is_a_warning() {
    let said = |text: &str| warnings(&parse(text).unwrap()).unwrap();
    for (name, back, wrong) in [
        ("belt-axis.toml", "move = \"-600 mm\"", "move = \"-60 mm\""),
        (
            "rack.toml",
            "move = \"-1909.86 deg\"",
            "move = \"1909.86 deg\"",
        ),
        (
            "vertical-axis.toml",
            "move = \"340 mm\"",
            "move = \"34 mm\"",
        ),
    ] {
        let text = text_of(name);
        assert_eq!(said(&text), [""; 0], "{name}");
        let forgotten = text.replace(back, wrong);
        assert_ne!(forgotten, text);
        let found = said(&forgotten);
        let [warning] = found.as_slice() else {
            panic!("{name}: {found:?}");
        };
        assert!(warning.contains("never comes back"), "{warning}");
        assert!(warning.contains("stroke"), "{warning}");
    }
    // 600 mm - 60 mm.
    let text = text_of("belt-axis.toml").replace("-600 mm", "-60 mm");
    assert!(said(&text)[0].contains("carriage goes on by 540 mm"));
    let ends = text.replace(
        "type = \"belt-axis\"",
        "type = \"belt-axis\"\nstroke = [\"0 mm\", \"600 mm\"]",
    );
    refuses(&ends, &["add up to 540 mm", "add a move of -540 mm"]);
    // A conveyor goes on as it should.
    assert_eq!(said(&text_of("belt-conveyor.toml")), [""; 0]);
}
