//! Files for PLCs and drives, as the command writes them. `python/tests/test_plc.py` runs the function blocks.
// Numbers that are written and read keep their bits.
#![allow(clippy::float_cmp)]

use jred::{Image, Spline};
use jred_analysis::checked;

use crate::support::{Folder, edited, jred_of, near, press_text, shipped};

/// The numbers of a text, one column after the other.
fn numbers(text: &str, separators: &[char]) -> Vec<f64> {
    let cells = text
        .split(separators)
        .map(|cell| cell.trim().to_lowercase());
    cells.filter_map(|cell| cell.parse().ok()).collect()
}

/// The press as its own cam in every form: the numbers are those of the CSV, and jred reads the array of CODESYS as the same motion.
#[test]
fn a_cam_has_the_same_numbers_in_every_form() {
    let folder = Folder::new();
    let press = folder.file("press.toml", press_text());
    let written = |form: &str| {
        let out = folder.path(&format!("cam.{form}"));
        let line = format!("gentlest {{}} --steps 300 --rows 121 --cam-form {form} --cam {{}}");
        jred_of(&line, [&press, &out]).ends(0);
        std::fs::read_to_string(out).unwrap()
    };
    let csv = numbers(&written("csv"), &[',', '\n']);
    assert_eq!(csv.len(), 4 * 121);
    let rows: Vec<&[f64]> = csv.chunks(4).collect();
    let masters: Vec<f64> = rows.iter().map(|row| row[0]).collect();
    let degrees: Vec<f64> = (0..=120).map(|k| f64::from(3 * k)).collect();
    assert_eq!(masters, degrees);
    let codesys = written("codesys");
    let array = codesys
        .split_once(":= [")
        .unwrap()
        .1
        .split_once(']')
        .unwrap()
        .0;
    assert_eq!(numbers(array, &[',', '(', ')', ' ', '=']), csv);
    let points: Vec<f64> = rows.iter().flat_map(|row| [row[0], row[1]]).collect();
    let sew = written("sew");
    assert_eq!(
        numbers(sew.split_once('\n').unwrap().1, &[';', '\n']),
        points
    );
    assert_eq!(numbers(&written("kollmorgen"), &[';', '\n']), points);
    let lenze = written("lenze");
    let lenze: Vec<&str> = lenze
        .lines()
        .map(|line| line.split("//").next().unwrap())
        .collect();
    assert_eq!(numbers(&lenze.join("\n"), &[' ', '\n']), points);
    for form in ["twincat", "rockwell", "siemens"] {
        let text = written(form);
        let parts = text.split([';', ',', ')']);
        let values = |member: &str| -> Vec<f64> {
            let of = parts.clone().filter_map(|part| {
                let (target, value) = part.rsplit_once(" := ")?;
                let target = target.trim().split('[').next()?.rsplit('(').next()?;
                let long = part.rsplit_once(" := ")?.0.trim();
                (target.ends_with(member) || long.ends_with(member))
                    .then(|| value.to_lowercase().parse().ok())?
            });
            of.collect()
        };
        let names = match form {
            "twincat" => ["MasterPos", "SlavePos"],
            "rockwell" => [".Master", ".Slave"],
            _ => ["Master", "Slave"],
        };
        for (k, name) in names.into_iter().enumerate() {
            let found = values(name);
            let expected: Vec<f64> = rows.iter().map(|row| row[k]).collect();
            assert_eq!(found.len(), expected.len(), "{form} {name}");
            for (found, expected) in found.iter().zip(&expected) {
                match form {
                    "rockwell" => assert_eq!(*found as f32, *expected as f32),
                    _ => assert_eq!(found, expected),
                }
            }
        }
    }

    // Read back as a motion.
    let text = press_text();
    let begin = text.find("[motion]").unwrap();
    let end = text.find("# Start from rest").unwrap();
    let motion = "[motion]\ntype = \"profile\"\nfile = \"cam.codesys\"\nmaster_time = \"0.5 s\"\ncyclic = false\n\
                  columns = { position = \"dY [deg]\", master = \"dX [deg]\", slope = \"dV [1]\", bend = \"dA [1/deg]\" }\n";
    let read = folder.file("read.toml", edited(&text, &text[begin..end], motion));
    let file = checked::read(&read).unwrap();
    let motion = file.required_motion().unwrap();
    for row in &rows {
        let t = row[0] / 360.0 * 0.5;
        let found = motion.at(t);
        assert!((found.phi.to_degrees() - row[1]).abs() < 1e-9, "{t}");
        assert!(
            (found.omega.to_degrees() * 0.5 / 360.0 - row[2]).abs() < 1e-9,
            "{t}"
        );
    }
}

#[test]
fn a_cam_too_long_names_the_limit_and_the_cure() {
    let folder = Folder::new();
    let [press, out] = [
        folder.file("press.toml", press_text()),
        folder.path("cam.scl"),
    ];
    let line = "gentlest {} --steps 300 --cam-form siemens --rows 20000 --cam {}";
    let run = jred_of(line, [&press, &out]).ends(2);
    run.says(&[
        "the cam has 20000 rows, and the form siemens takes at most 10000",
        "use --rows 10000",
    ]);
    assert!(!out.exists());
    // As delivered they take fewer; the default fits.
    for (form, more, limit) in [
        ("siemens", 1000, "use a TO_Cam_10k"),
        ("sew", 1024, "raise gc_u"),
    ] {
        let line = format!("gentlest {{}} --steps 300 --cam-form {form} --cam {{}}");
        let run = jred_of(&line, [&press, &out]).ends(0);
        assert!(!run.message().contains("as delivered"), "{}", run.message());
        let rows = more + 1;
        let run = jred_of(&format!("{line} --rows {rows}"), [&press, &out]).ends(0);
        let fault = format!("the cam has {rows} rows; the form {form} takes {more} as delivered");
        run.says(&[&fault, limit, &format!("or use --rows {more}")]);
    }
    let run = jred_of("gentlest {} --cam-form siemens", [&press]).ends(2);
    run.says(&["--cam <FILE>"]);
}

/// The command names the block, the C table or the cam if it has not the name of its file.
#[test]
fn a_name_that_is_not_that_of_the_file_is_said() {
    let folder = Folder::new();
    let press = folder.file("press.toml", press_text());
    let changed = "the name in it is";
    let block = "export {} --torque-error '2 N m' --format";
    let cam = "gentlest {} --steps 300 --cam-form codesys --cam {}";
    for (line, file, name) in [
        (
            format!("{block} st --out {{}}"),
            "1-press.st",
            Some("machine_1_press"),
        ),
        (format!("{block} c --out {{}}"), "Größe.h", Some("Groesse")),
        (
            format!("{block} st --name other --out {{}}"),
            "1-press.st",
            None,
        ),
        (format!("{block} st --out {{}}"), "press.st", None),
        (cam.to_owned(), "Größe.st", Some("Groesse")),
        (cam.replace("codesys", "csv"), "Größe.csv", None),
    ] {
        let run = jred_of(&line, [&press, &folder.path(file)]).ends(0);
        let said = name.map(|name| format!("{changed} {name}"));
        assert_eq!(run.out.contains(changed), said.is_some(), "{}", run.out);
        assert!(run.out.contains(&said.unwrap_or_default()), "{}", run.out);
    }
}

/// The literals of the function block are the words of the image, bit for bit.
#[test]
fn a_function_block_has_the_numbers_of_the_image() {
    let folder = Folder::new();
    let press = folder.file("press.toml", press_text());
    let [st, image] = [folder.path("press.st"), folder.path("press.jred")];
    let line = "export {} --torque-error '1 N m' --layout spline --out {}";
    jred_of(line, [&press, &image]).ends(0);
    jred_of(
        "export {} --torque-error '1 N m' --format st --out {}",
        [&press, &st],
    )
    .ends(0);
    let bytes = std::fs::read(image).unwrap();
    let words: Vec<u32> = bytes
        .chunks_exact(4)
        .map(|word| u32::from_le_bytes(word.try_into().unwrap()))
        .collect();
    let table = Image::new(&words).unwrap().table::<Spline<f32>>().unwrap();
    let text = std::fs::read_to_string(st).unwrap();
    let array = |name: &str| {
        let text = text.split_once(&format!("    {name} : ARRAY[")).unwrap().1;
        numbers(
            text.split_once('[').unwrap().1.split_once(']').unwrap().0,
            &[',', '\n'],
        )
    };
    let columns = ["INERTIAS", "LOADS", "COULOMBS"].map(array);
    let width = columns.len();
    for (k, word) in table.words().iter().enumerate() {
        let found = columns[k % width][k / width];
        assert_eq!(found.to_bits(), f64::from(*word).to_bits());
    }
    assert_eq!(table.words().len(), width * columns[0].len());
    // No line has more than 32 numbers.
    assert!(text.lines().all(|line| line.matches(',').count() <= 32));
}

#[test]
fn what_a_plc_does_not_take_is_refused() {
    let press = shipped("press.toml");
    for (more, words) in [
        (
            "--name press__1",
            ["single underscores", "use --name press_1"],
        ),
        (
            "--name Ton",
            ["a word of the languages of PLCs", "use --name my_Ton"],
        ),
        (
            "--name speed",
            ["a variable of this name", "use --name my_speed"],
        ),
        (
            "--name a_name_of_more_than_thirty_two_characters",
            [
                "it has 41 characters, and a PLC takes 27",
                "use --name a_name_of_more_than_thirty",
            ],
        ),
        (
            "--layout cubic",
            ["one spline table, in LREAL", "remove --layout"],
        ),
        (
            "--type i32",
            ["one spline table, in LREAL", "remove --type"],
        ),
        (
            "--pieces auto",
            ["one spline table, in LREAL", "remove --pieces"],
        ),
        (
            "--rated-torque '4 N m'",
            ["'--torque-error <TORQUE_ERROR>'", "cannot be used with"],
        ),
    ] {
        for form in ["st", "plcopen"] {
            let line = format!("export {{}} --torque-error '1 N m' --format {form} {more}");
            jred_of(&line, [&press]).ends(2).says(&words);
        }
    }
    let line = "export {} --format c --rated-torque '4 N m'";
    let run = jred_of(line, [&press]).ends(2);
    run.says(&["applies to --format cia402", "remove --rated-torque"]);
    for option in [
        "--forward",
        "--prove",
        "--pieces auto",
        "--omega 1rad/s",
        "--alpha 1rad/s^2",
        "--max-bytes 99",
    ] {
        let line = format!("export {{}} --format cia402 --rated-torque '1 N m' {option}");
        let run = jred_of(&line, [&press]).ends(2);
        run.says(&["cannot be used with"]);
    }
    for option in ["--rows 9", "--counts-per-turn 9"] {
        let line = format!("export {{}} --torque-error '1 N m' {option}");
        let run = jred_of(&line, [&press]).ends(2);
        run.says(&["cannot be used with", "'--torque-error <TORQUE_ERROR>'"]);
    }
    let run = jred_of("export {} --format cia402 --torque-error '1 N m'", [&press]).ends(2);
    run.says(&[
        "thousandths of the rated torque, which is not given",
        "object 0x6076",
    ]);
}

/// A disc of this inertia (kg·m²) behind a ratio of 2, turned by 90° in 0.2 s.
fn disc(inertia: f64) -> String {
    format!(
        "title = \"disc\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\n\
         [mechanism.table]\ninertia = \"{inertia} kg m^2\"\n\
         [[drive_train]]\ntype = \"gear-train\"\n[[drive_train.stage]]\n\
         driver = {{ teeth = 20, inertia = \"0 kg m^2\" }}\ndriven = {{ teeth = 40, inertia = \"0 kg m^2\" }}\n\
         [motion]\ntype = \"cycle\"\n[[motion.segment]]\nlaw = \"polynomial-345\"\nmove = \"90 deg\"\nduration = \"0.2 s\"\n"
    )
}

/// The disc takes 10/√3·s/t²·J/i at most: 1.134 N m with s = π/2, t = 0.2 s, J = 0.01 kg m² and i = 2.
#[test]
fn a_torque_that_no_drive_takes_is_said() {
    let folder = Folder::new();
    let [light, heavy] = [("light.toml", 0.01), ("heavy.toml", 0.5)]
        .map(|(name, inertia)| folder.file(name, disc(inertia)));
    let run = |file, more: &str| {
        let line = format!("export {{}} --format cia402 --rows 201 {more}");
        jred_of(&line, [file]).ends(0).message()
    };
    let message = run(&light, "--rated-torque '0.1 N m'");
    for words in ["11336 per mille", "5000 (0x6072)", "--drive MOTOR+GEARBOX"] {
        assert!(message.contains(words), "{message}");
    }
    assert!(!run(&light, "--rated-torque '0.25 N m'").contains("per mille"));
    // Directly coupled the motor has at most 23.9 N m.
    let message = run(&heavy, "--drive sgm7a-25a");
    assert!(
        message.contains("above the peak torque of motor and amplifier, 23.9 N m"),
        "{message}"
    );
    assert!(!run(&heavy, "--drive sgm7a-25a+tp004mf-4").contains("above"));
}

/// Time, counts and per mille of a table for a drive.
fn offsets(text: &str) -> Vec<Vec<f64>> {
    let rows = text.lines().filter(|line| !line.starts_with(['#', 't']));
    rows.map(|line| numbers(line, &[','])).collect()
}

/// A disc on the motor's shaft: the torque is inertia times the acceleration that the second differences of the counts give.
#[test]
fn torque_offsets_follow_newtons_law_in_their_own_columns() {
    let folder = Folder::new();
    let disc = folder.file("disc.toml", disc(0.01));
    let line = "export {} --format cia402 --rated-torque '0.05 N m' --counts-per-turn 1000000000 --rows 201 --rotor-inertia '5 kg cm^2'";
    let run = jred_of(line, [&disc]).ends(0);
    let rows = offsets(&run.out);
    assert_eq!(rows.len(), 201);
    // Of the disc behind a ratio of 2, and of the rotor.
    let inertia = 0.01 / 4.0 + 5e-4;
    let mut largest = 0.0f64;
    for three in rows.windows(3) {
        let [before, here, after] = [&three[0], &three[1], &three[2]];
        let h = after[0] - here[0];
        let counts = after[1] - 2.0 * here[1] + before[1];
        let alpha = counts / 1e9 * std::f64::consts::TAU / (h * h);
        let torque = here[2] * 0.05e-3;
        largest = largest.max(torque.abs());
        // Two counts in the difference, half of a per mille, and h²/12 of the fourth derivative.
        assert!(
            (torque - inertia * alpha).abs() < 1e-4 + 2e-3 * largest,
            "{here:?} {alpha}"
        );
    }
    assert!(largest > 0.4, "{largest}");
    let comments: Vec<&str> = run
        .out
        .lines()
        .filter(|line| line.starts_with('#'))
        .collect();
    assert!(
        comments
            .iter()
            .any(|line| line.contains("0x6076 = 50 mN m"))
    );
    assert!(
        comments
            .iter()
            .any(|line| line.contains("frame: the input of the machine file's drive train"))
    );
}

/// At the motor of a drive: Yaskawa SGM7A-25A (7.96 N m, 3.19 kg cm²) behind Beckhoff TP004 MF i=4 (0.57 kg cm², 97 %), while it accelerates.
#[test]
fn torque_offsets_of_a_drive_are_those_of_its_motor() {
    let folder = Folder::new();
    let disc = folder.file("disc.toml", disc(2.0));
    let line = "export {} --format cia402 --drive sgm7a-25a+tp004mf-4 --counts-per-turn 100000000 --rows 201";
    let run = jred_of(line, [&disc]).ends(0);
    let rows = offsets(&run.out);
    // A quarter of a turn, times 2, which reverses, times 4.
    assert_eq!(rows[200][1], -2e8);
    let inertia = 2.0 / 4.0 / 16.0 / 0.97 + 3.19e-4 + 0.57e-4;
    let mut largest = 0.0f64;
    for three in rows[..95].windows(3) {
        let [before, here, after] = [&three[0], &three[1], &three[2]];
        let counts = after[1] - 2.0 * here[1] + before[1];
        let alpha = counts / 1e8 * std::f64::consts::TAU / 1e-6;
        let torque = here[2] * 7.96e-3;
        largest = largest.max(torque.abs());
        // h²/12 of the fourth derivative is 2.5e-4 of the largest acceleration.
        assert!((torque - inertia * alpha).abs() < 0.005 + 1e-3 * largest);
    }
    // Of the law, 10/√3 of the way over the square of the time.
    let alpha = 10.0 / 3.0f64.sqrt() * 2.0 * std::f64::consts::TAU / 0.04;
    near("largest", largest, inertia * alpha, 1e-3);
    assert!(run.out.contains("0x6076 = 7960 mN m"), "{}", run.out);
    let frame = "# frame: the motor of sgm7a-25a + tp004mf-4";
    assert!(run.out.contains(frame), "{}", run.out);
    let both = "export {} --format cia402 --drive sgm7a-25a --rated-torque '10 N m' --rows 3";
    let run = jred_of(both, [&disc]).ends(0);
    assert!(run.out.contains("0x6076 = 10000 mN m"), "{}", run.out);
    let run = jred_of("export {} --drive sgm7a-25a", [&disc]).ends(2);
    run.says(&["--drive applies to --format cia402", "remove --drive"]);
    let run = jred_of("export {} --max-bytes 900 --motors m.csv", [&disc]).ends(2);
    run.says(&["--motors applies to --format cia402"]);
    let wrong = "export {} --format cia402 --drive sgm7a-25a --rotor-inertia '1 kg cm^2'";
    jred_of(wrong, [&disc]).ends(2).says(&["--rotor-inertia"]);
    let wrong = "export {} --format cia402 --drive nothing";
    jred_of(wrong, [&disc]).ends(2).says(&["nothing"]);
}
