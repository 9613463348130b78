//! Units of input and output, and the sense of a drive train.

use serde_json::Value;

use crate::support::{Folder, jred_in, press_text, typed};

const INCH: f64 = 0.0254;
const POUND: f64 = 0.453_592_37;
const POUND_FORCE: f64 = POUND * 9.80665;

/// The SI value of a unit of results, from the definitions; 1 for units that both systems have.
fn size(unit: &str) -> f64 {
    match unit {
        _ if unit.starts_with("lb in") => POUND_FORCE * INCH,
        "lb" => POUND,
        "lbf" => POUND_FORCE,
        "in" | "in/s" | "in/s^2" | "in/rad" => INCH,
        "hp" => 550.0 * 12.0 * INCH * POUND_FORCE,
        "oz in" => POUND_FORCE / 16.0 * INCH,
        "mm" | "mm/s" | "mN m" => 1e-3,
        "kg cm^2" => 1e-4,
        "kW" | "kN" | "kN m" => 1e3,
        _ => 1.0,
    }
}

fn rows(text: &str) -> Vec<Vec<String>> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .from_reader(text.as_bytes());
    let records = reader.records();
    records
        .map(|record| record.unwrap().iter().map(str::to_owned).collect())
        .collect()
}

fn unit(title: &str) -> &str {
    let unit = title
        .rsplit_once('[')
        .and_then(|(_, unit)| unit.strip_suffix(']'));
    unit.unwrap_or_default()
}

/// Every number of a table is the same quantity in both systems, and JSON has one.
#[test]
fn imperial_tables_are_the_tables_in_si() {
    let folder = Folder::new();
    folder.file("press.toml", press_text());
    let run = |line: &str| {
        let run = jred_in(&folder.path(""), &typed(line));
        assert!(run.code <= 1, "{line}: {}", run.err);
        run.out
    };
    let mut compared = 0;
    for command in [
        "reduce press.toml",
        "reduce press.toml --points --reactions --energy",
        "size press.toml --top 3",
        "simulate press.toml",
        "catalogue list",
        "catalogue list gearboxes",
        "require press.toml",
    ] {
        let [si, imperial] = ["si", "imperial"]
            .map(|units| rows(&run(&format!("{command} --format csv --units {units}"))));
        assert_eq!(si.len(), imperial.len(), "{command}");
        let mut converted = 0;
        for (k, title) in si[0].iter().enumerate() {
            let (from, to) = (unit(title), unit(&imperial[0][k]));
            let name = |title: &str| title.split('[').next().unwrap_or_default().to_owned();
            assert_eq!(name(title), name(&imperial[0][k]), "{command}");
            for metric in [
                "N m", "kg", "kg m^2", "kg cm^2", "N", "mm", "m", "m/s", "kW",
            ] {
                assert_ne!(to, metric, "{command}: {title}");
            }
            converted += usize::from(from != to);
            for (a, b) in si[1..].iter().zip(&imperial[1..]) {
                let (Ok(a), Ok(b)) = (a[k].parse::<f64>(), b[k].parse::<f64>()) else {
                    assert_eq!(a[k], b[k], "{command}: {title}");
                    continue;
                };
                if from.ends_with('C') && from != to {
                    assert!(
                        (a * 1.8 + 32.0 - b).abs() < 1e-9 * b.abs(),
                        "{command}: {title}"
                    );
                    continue;
                }
                let [a, b] = [a * size(from), b * size(to)];
                assert!(
                    (a - b).abs() <= 1e-12 * a.abs(),
                    "{command}: {title}: {a} {b}"
                );
                compared += usize::from(from != to);
            }
        }
        assert!(converted > 0, "{command}");
    }
    assert!(compared > 1000);
    for command in [
        "reduce press.toml",
        "size press.toml --top 3",
        "check press.toml",
    ] {
        let json = |units: &str| run(&format!("{command} --format json --units {units}"));
        assert_eq!(json("si"), json("imperial"), "{command}");
    }
}

/// Texts and pages have no newton, kilogram or metre left; quotations from the machine file are its own.
#[test]
fn imperial_texts_and_pages_have_no_metric_unit() {
    let folder = Folder::new();
    folder.file("press.toml", press_text());
    let metric = |text: &str| {
        let is_metric = |at: usize| {
            let rest = &text[at..];
            let number = text[..at].ends_with(|c: char| c.is_ascii_digit());
            let units = [" N m", " N·m", " kg", " kN", " N ", " mm", " kW", " °C"];
            number && units.iter().any(|unit| rest.starts_with(unit))
        };
        let at = text
            .match_indices(' ')
            .map(|(at, _)| at)
            .find(|at| is_metric(*at));
        at.map(|at| {
            text[at.saturating_sub(40)..]
                .chars()
                .take(80)
                .collect::<String>()
        })
    };
    for command in [
        "size press.toml",
        "size press.toml --explain --top 5",
        "simulate press.toml",
        "require press.toml",
        "steady press.toml --torque '60 lb in'",
        "balance press.toml --steps 200 --counterweight 'crank, 40 kg, 200 mm'",
        "ratio press.toml",
        "check press.toml",
    ] {
        let run = jred_in(
            &folder.path(""),
            &typed(&format!("{command} --units imperial")),
        );
        assert!(run.code <= 1, "{command}: {}", run.err);
        // The title and lines to copy are as they are.
        let lines = run.out.lines().skip(1).filter(|line| !line.contains('='));
        let lines: Vec<&str> = lines.collect();
        assert_eq!(metric(&lines.join("\n")), None, "{command}");
    }
    let run = jred_in(
        &folder.path(""),
        &typed("size press.toml --units imperial --report r.html"),
    );
    assert!(run.code <= 1, "{}", run.err);
    let page = std::fs::read_to_string(folder.path("r.html")).unwrap();
    for label in ["[N·m]", "[N m]", "[kg·m²]", "[kg m^2]", "[kW]", "[°C]"] {
        assert!(!page.contains(label), "{label}");
    }
    for label in ["[lb·in]", "[lb·in·s²]", "[hp]"] {
        assert!(page.contains(label), "{label}");
    }
}

/// The same machine in inches and pounds: 10 in are 254 mm, 1 lb in s² is 0.45359237·9.80665·0.0254 kg m².
#[test]
fn a_machine_in_inches_is_the_machine_in_millimetres() {
    let folder = Folder::new();
    let machine = |crank: &str, rod: &str, inertia: &str, mass: &str, force: &str, speed: &str| {
        format!(
            "title = \"x\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"slider-crank\"\nflywheel = \"{inertia}\"\n\
             [mechanism.crank]\nlength = \"{crank}\"\nmass = \"{mass}\"\ninertia = \"{inertia}\"\n\
             [mechanism.rod]\nlength = \"{rod}\"\nmass = \"{mass}\"\ninertia = \"{inertia}\"\n\
             [mechanism.slider]\nmass = \"{mass}\"\n\
             [[load]]\non = \"slider\"\nopposing_force = \"{force}\"\n\
             [motion]\ntype = \"constant-speed\"\nspeed = \"{speed}\"\n"
        )
    };
    let inertia = format!("{:?} kg m^2", 2.0 * POUND_FORCE * INCH);
    let mass = format!("{:?} kg", 3.0 * POUND);
    let force = format!("{:?} N", 40.0 * POUND_FORCE);
    folder.file(
        "si.toml",
        machine("101.6 mm", "304.8 mm", &inertia, &mass, &force, "60 rpm"),
    );
    folder.file(
        "us.toml",
        machine("4 in", "1 ft", "2 lb in s^2", "48 oz", "40 lb", "60 min-1"),
    );
    let columns = |file: &str| {
        let run = jred_in(
            &folder.path(""),
            &typed(&format!("reduce {file} --format json")),
        );
        assert_eq!(run.code, 0, "{}", run.err);
        let value: Value = serde_json::from_str(&run.out).unwrap();
        value["rows"].as_array().unwrap().clone()
    };
    let [si, us] = ["si.toml", "us.toml"].map(columns);
    assert!(si.len() > 10 && si.len() == us.len());
    for (a, b) in si.iter().zip(&us) {
        for (a, b) in a.as_array().unwrap().iter().zip(b.as_array().unwrap()) {
            let [a, b] = [a, b].map(|x| x.as_f64().unwrap());
            assert!((a - b).abs() <= 1e-12 * a.abs().max(1.0), "{a} {b}");
        }
    }
}

/// No verdict depends on the sense in which the motor turns; with `sense = "forward"` nothing does.
#[test]
fn the_sense_of_a_drive_train_changes_no_verdict() {
    let folder = Folder::new();
    let machine = |ratio: &str| {
        let stage = format!(
            "ratio = {ratio}\ninput_inertia = \"2 kg cm^2\"\noutput_inertia = \"8 kg cm^2\"\n"
        );
        format!(
            "{}\n[[drive_train]]\ntype = \"friction\"\n{stage}",
            press_text()
        )
    };
    let run = |text: &str, command: &str| {
        folder.file("m.toml", text);
        let run = jred_in(&folder.path(""), &typed(command));
        (run.code, run.out)
    };
    let [forward, backward] = [machine("0.5"), machine("-0.5")];
    let ignored = format!("{backward}sense = \"forward\"\n");
    for command in ["size m.toml --format csv", "require m.toml", "bus m.toml"] {
        assert_eq!(run(&forward, command), run(&backward, command), "{command}");
        assert_eq!(run(&forward, command), run(&ignored, command), "{command}");
    }
    // A motor torque with a sign turns the machine the other way round.
    let simulate = "simulate m.toml --format csv";
    assert_ne!(run(&forward, simulate), run(&backward, simulate));
    assert_eq!(run(&forward, simulate), run(&ignored, simulate));
    let gears = "[[drive_train]]\ntype = \"gear-train\"\n[[drive_train.stage]]\n\
                 driver = { teeth = 20, inertia = \"2 kg cm^2\" }\ndriven = { teeth = 40, inertia = \"8 kg cm^2\" }\n";
    let internal = format!("{}\n{gears}mesh = \"internal\"\n", press_text());
    let external = format!(
        "{}\n{}",
        press_text(),
        gears.replace("train\"\n", "train\"\nsense = \"forward\"\n")
    );
    assert_eq!(run(&internal, simulate), run(&external, simulate));
}

/// A comma separates ratios; the reader is told where it can be a decimal sign.
#[test]
fn a_comma_in_a_list_of_ratios() {
    let folder = Folder::new();
    folder.file("press.toml", press_text());
    let run = |ratios: &str| {
        let run = jred_in(
            &folder.path(""),
            &[
                "require",
                "press.toml",
                "--format",
                "csv",
                "--ratios",
                ratios,
            ],
        );
        assert_eq!(run.code, 0, "{}", run.err);
        let rows = rows(&run.out);
        let column = rows[0]
            .iter()
            .position(|title| title.contains("ratio"))
            .unwrap();
        let mut found: Vec<String> = rows[1..].iter().map(|row| row[column].clone()).collect();
        found.dedup();
        (found.join(" "), run.err)
    };
    let (list, warned) = run("3,5");
    assert_eq!(list, "3 5");
    assert!(
        warned.contains("warning: --ratios 3,5 names two ratios; write 3.5 if it is one"),
        "{warned}"
    );
    for plain in ["3, 5", "3,5,7", "3.5,7"] {
        assert_eq!(run(plain).1, "", "{plain}");
    }
    assert_eq!(run("3,5; 7,5"), ("3.5 7.5".to_owned(), String::new()));
}
