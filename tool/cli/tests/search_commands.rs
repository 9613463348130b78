//! Output of `jred size` and `jred ratio` for searches: ranking, filters, fronts, ratios.

use crate::support::{jred, jred_of, near, press_file, shipped, within};
use jred_analysis::checked;
use jred_analysis::duty::{Duty, STEPS};
use jred_sizing::catalogue::Catalogue;
use jred_sizing::select::ratio::{Gear, Moments};

/// The options of the command.
#[test]
fn options_of_size() {
    let press = press_file();
    let run = jred_of("size {} --rank energy --motor sgm* --format json", [&press]).ends(0);
    let json = run.json();
    assert!(
        json["ranking"]
            .as_str()
            .unwrap()
            .contains("least energy supplied"),
        "{}",
        json["ranking"]
    );
    let fit = json["fit"].as_array().unwrap();
    // Within each certainty.
    let certainties = |d: &serde_json::Value| d["certainty"].as_str().unwrap().to_owned();
    for class in fit.chunk_by(|a, b| certainties(a) == certainties(b)) {
        let energies = class
            .iter()
            .map(|d| d["duty"]["motoring energy [J]"].as_f64().unwrap());
        assert!(energies.is_sorted(), "{class:?}");
    }
    assert!(fit.len() > 1);
    assert!(
        fit.iter()
            .all(|d| d["motor"].as_str().unwrap().starts_with("sgm"))
    );

    let listed = jred([&"size", &press, &"--pareto", &"power,energy"]).ends(0);
    assert!(
        listed.out.contains(" * ")
            && listed
                .out
                .contains("* figures not from the maker's own document"),
        "{}",
        listed.out
    );
    let run = jred_of("size {} --pareto power,energy --format csv", [&press]).ends(0);
    assert!(
        run.out.starts_with(
            "motor,gearbox,amplifier,ratio,mass [kg],price,rated power [W],energy [J]\n"
        ),
        "{}",
        run.out
    );
    let rows: Vec<Vec<f64>> = run
        .out
        .lines()
        .skip(1)
        .map(|l| l.split(',').skip(6).map(|x| x.parse().unwrap()).collect())
        .collect();
    assert!(
        !rows.is_empty()
            && rows
                .windows(2)
                .all(|w| w[0][0] <= w[1][0] && w[0][1] >= w[1][1]),
        "{}",
        run.out
    );

    let price = jred([&"size", &press, &"--rank", &"price"]).ends(0);
    assert!(
        price
            .message()
            .contains("no suitable drive has data for the price"),
        "{}",
        price.err
    );
    jred([&"size", &press, &"--pareto", &"mass"])
        .ends(2)
        .says(&["two or three different objectives"]);
    jred([&"size", &press, &"--pareto", &"mass,colour"])
        .ends(2)
        .says(&["power, mass, price, energy, margin, temperature"]);
    jred([&"size", &press, &"--ratio", &"9..3"])
        .ends(2)
        .says(&["no ratio lies between 9 and 3"]);
    jred([&"size", &press, &"--maker", &"Nobody"])
        .ends(2)
        .says(&["no motor in the catalogue", "passes the filter"]);
    jred([&"size", &press, &"--max-mass", &"5 mm"])
        .ends(2)
        .says(&["must be a mass"]);
}

/// The list of ratios: the library's figures, ordered by power.
#[test]
fn the_command_lists_ratios() {
    let run = jred([&"ratio", &press_file(), &"--format", &"json"]).ends(0);
    let json = run.json();
    let rows = json["rows"].as_array().unwrap();
    let file = checked::read(&press_file()).unwrap();
    let duty = Duty::new(&file, file.motion.as_ref().unwrap(), STEPS).unwrap();
    let catalogue = Catalogue::load(None, None).unwrap();
    assert!(rows.len() >= catalogue.motors.len());
    let powers: Vec<f64> = rows
        .iter()
        .filter_map(|row| row["rated power [W]"].as_f64())
        .collect();
    assert!(powers.is_sorted());
    for motor in &catalogue.motors {
        let row = rows
            .iter()
            .find(|row| row["motor"] == motor.key.as_str())
            .unwrap();
        let moments = Moments::new(&duty, motor, Gear::IDEAL);
        near(
            "best",
            row["best ratio"].as_f64().unwrap(),
            moments.best_ratio().unwrap(),
            1e-14,
        );
        let range = moments.range(0.8 * motor.rated_torque.unwrap());
        match range {
            None => assert!(row["RMS ratio from"].is_null()),
            Some([from, _]) => within("from", row["RMS ratio from"].as_f64().unwrap(), from, 1e-13),
        }
    }
    jred([&"ratio", &press_file(), &"--efficiency", &"120%"])
        .ends(2)
        .says(&["at most 1"]);
}

/// At constant speed there is no best ratio: the range of the RMS torque is open above, which a note explains.
#[test]
fn an_open_range_of_ratios_is_said_to_be_open() {
    let conveyor = shipped("conveyor.toml");
    let table = jred([&"ratio", &conveyor, &"--motor", &"sgmsh-30a"]).ends(0);
    assert!(table.out.contains(" or more"), "{}", table.out);
    assert!(table.out.contains("nothing accelerates"), "{}", table.out);
    let form = [
        &"ratio" as &dyn AsRef<std::ffi::OsStr>,
        &conveyor,
        &"--motor",
        &"sgmsh-30a",
        &"--format",
        &"json",
    ];
    let json = jred(form).ends(0).json();
    let row = &json["rows"][0];
    assert!(row["RMS ratio from"].as_f64().unwrap() > 0.0, "{row}");
    assert!(row["RMS ratio to"].is_null(), "{row}");
}

/// The table fits on a page, explains missing ranges, and can be limited.
#[test]
fn the_table_of_ratios_is_narrow_and_can_be_cut() {
    let press = press_file();
    let full = jred([&"ratio", &press]).ends(0).out;
    let table = |text: &str| -> Vec<String> {
        let lines = text.lines().skip(1);
        lines
            .take_while(|l| !l.starts_with("alpha:"))
            .map(str::to_owned)
            .collect()
    };
    let lines = table(&full);
    assert!(lines.len() > 30);
    for line in &lines {
        assert!(
            line.chars().count() <= 120,
            "{} columns: {line}",
            line.chars().count()
        );
    }
    let rows = jred([&"ratio", &press, &"--format", &"json"])
        .ends(0)
        .json();
    let rows = rows["rows"].as_array().unwrap();
    let mut reasons = 0;
    for row in rows {
        assert_eq!(
            row["ratio from"].is_null(),
            row["why none"].is_string(),
            "{row}"
        );
        reasons += usize::from(row["why none"].is_string());
    }
    assert!(reasons > 3, "{reasons}");
    let cut = jred([&"ratio", &press, &"--top", &"2", &"--format", &"json"])
        .ends(0)
        .json();
    let held: Vec<_> = rows
        .iter()
        .filter(|row| row["why none"].is_null())
        .take(2)
        .collect();
    assert_eq!(
        cut["rows"].as_array().unwrap().iter().collect::<Vec<_>>(),
        held
    );
    let notes = cut["notes"].to_string();
    assert!(
        notes.contains(&format!("motors without a suitable ratio: {reasons}")),
        "{notes}"
    );
    let some = jred([&"ratio", &press, &"--motor", &"FXM*", &"--format", &"json"])
        .ends(0)
        .json();
    let some = some["rows"].as_array().unwrap();
    let named = |row: &&serde_json::Value| row["motor"].as_str().unwrap().starts_with("fxm");
    assert_eq!(some.len(), rows.iter().filter(named).count());
    assert!(some.iter().all(|row| named(&row)) && !some.is_empty());
    jred([&"ratio", &press, &"--motor", &"nobody*"])
        .ends(2)
        .says(&["passes the filter"]);
    jred([&"ratio", &press, &"--top", &"0"]).ends(2);
}
